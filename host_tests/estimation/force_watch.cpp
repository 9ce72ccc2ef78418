// Forces beyond their limits: when an alarm begins and ends, and the peak that it keeps.
#include "taut/estimation/force_watch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "estimation/ramp.hpp"

namespace force_watch_test {
using namespace estimation;

namespace {

using Watch = taut::ForceWatch<double, 2>;
using Side = Watch::Side;

/// Where the forces of one segment are after another, and the peak then.
struct Watched {
  Watch watch;
  taut::AlarmLimits<double> limits;

  Side at(double force, bool is_held = false) { return watch.take(1, force, is_held, limits); }
};
taut::AlarmLimits<double> between(double least, double most) {
  taut::AlarmLimits<double> limits;
  limits.least_force = least;
  limits.most_force = most;
  return limits;
}

TEST_CASE("a force that hovers at its upper limit is one episode, which ends a hundredth below") {
  Watched watched{{}, between(-1, 1000)};
  CHECK(watched.at(1000) != Side::above);
  CHECK(watched.watch.peak(1) == 0);
  for (const double force : {1001.0, 999.0, 1012.0, 990.5, 1003.0}) CHECK(watched.at(force) == Side::above);
  CHECK(watched.watch.peak(1) == 1012);
  CHECK(watched.watch.peak(0) == 0);
  CHECK(watched.at(989.5) != Side::above);
  CHECK(watched.watch.peak(1) == 0);
  CHECK(watched.at(999.5) != Side::above);
  CHECK(watched.at(1002) == Side::above);
  CHECK(watched.watch.peak(1) == 1002);
}

TEST_CASE("too low counts once the segment has come up to the limit, and ends a hundredth above") {
  Watched watched{{}, between(100, -1)};
  for (const double force : {0.0, 50.0, 99.9}) CHECK(watched.at(force) == Side::not_yet);
  CHECK(watched.at(100) == Side::within);
  for (const double force : {99.0, 100.5, 97.0, 98.0, 100.9}) CHECK(watched.at(force) == Side::below);
  CHECK(watched.watch.peak(1) == 97);
  CHECK(watched.at(101.1) == Side::within);
  CHECK(watched.at(99.5) == Side::below);
  CHECK(watched.watch.peak(1) == 99.5);
}

TEST_CASE("what wedges hold below the limit is too low, and stays so when the jack is back") {
  Watched watched{{}, between(100, -1)};
  CHECK(watched.at(80) == Side::not_yet);
  CHECK(watched.at(80, true) == Side::below);
  CHECK(watched.at(85) == Side::below);
  CHECK(watched.watch.peak(1) == 80);
}

TEST_CASE("limits closer to each other than their bands hide no force that is beyond one") {
  Watched watched{{}, between(995, 1000)};
  CHECK(watched.at(1010) == Side::above);
  CHECK(watched.at(994) == Side::below);
  CHECK(watched.watch.peak(1) == 994);
  CHECK(watched.at(1001) == Side::above);
  CHECK(watched.watch.peak(1) == 1001);
}

TEST_CASE("a band of zero is no band") {
  Watched watched{{}, between(-1, 1000)};
  watched.limits.band = 0;
  CHECK(watched.at(1001) == Side::above);
  CHECK(watched.at(1000) != Side::above);
}

TEST_CASE("a restored estimator keeps the episode and its peak") {
  static Ground ground;
  support::rigid_saddles(ground.known, support::steel_cable(0.2), support::chain_points(7));
  static taut::Condensed<double, PlaneCapacity> model;
  REQUIRE(support::condense(ground.known, model).ok());
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::find_friction_prior(ground.known, prior);
  using Estimator = taut::Estimator<taut::Condensed<double, PlaneCapacity>, most_unknowns>;
  const auto estimator = std::make_unique<Estimator>(), restored = std::make_unique<Estimator>();
  const auto limits = between(-1, full);
  REQUIRE(estimator->start(model, prior, limits).status.ok());
  const auto pull = [](Estimator& each, double force) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, false, force, 0};
    REQUIRE(each.advance(readings).status.ok());
    return raised(each.alarms(), taut::Alarm::Kind::force_high);
  };
  const int last = model.segments - 1;
  CHECK(pull(*estimator, 0.999 * full) == 0);
  CHECK(pull(*estimator, 1.02 * full) > 0);
  REQUIRE(restored->restore(model, prior, estimator->save(), limits).ok());
  CHECK(restored->peak(last) == estimator->peak(last));
  CHECK(std::fabs(restored->peak(last) - 1.02 * full) < 1e-9 * full);
  CHECK(pull(*restored, 0.995 * full) > 0);
  CHECK(pull(*restored, 0.985 * full) == 0);
  CHECK(restored->peak(last) == 0);
}

}  // namespace

}  // namespace force_watch_test
