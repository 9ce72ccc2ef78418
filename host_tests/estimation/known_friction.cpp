// A cable whose friction is known: its far end has nothing to teach, and is looked at all the same.
#include <doctest/doctest.h>

#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace known_friction_test {
using namespace estimation;

namespace {

/// A ramp and a release of a cable with known mu, where the far end reads gain times the force, or from
/// `until` on always the same. Returns how many alarms it raises.
int alarms_of(double gain, int until, std::uint64_t seed) {
  SaddleSite known;
  known.mu_sd = 0;
  Random random(seed);
  known.begin(random);
  const auto estimator = std::make_unique<ReadSite::Estimator>();
  REQUIRE(estimator->start(known.model, known.prior).status.ok());
  REQUIRE(estimator->unknowns() < 4);
  int alarms = 0, notices = 0;
  double reading = 0;
  for (int i = 1; i <= 120; ++i) {
    const double load = full * (i <= 60 ? i / 60.0 : 1 - (i - 60) / 100.0);
    known.pull(load);
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, false, load + known.noise * gaussian(random), 0};
    if (i <= until) reading = gain * known.force.front() + known.noise * gaussian(random);
    readings.ends[0][0] = {true, false, reading, 0};
    REQUIRE(estimator->advance(readings).status.ok());
    alarms += of_far_end(estimator->alarms());
    notices += raised(estimator->alarms(), taut::Alarm::Kind::no_information);
  }
  CHECK(notices == 0);
  return alarms;
}

}  // namespace

TEST_CASE("where mu is known a far end that contradicts is found, and one that agrees is not blamed") {
  int blamed = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    blamed += alarms_of(1, 120, seed) > 0 ? 1 : 0;
    CHECK(alarms_of(0.8, 120, seed) > 0);
    CHECK(alarms_of(0, 120, seed) > 0);
    CHECK(alarms_of(1, 30, seed) > 0);
  }
  CHECK(blamed <= 2);
}

}  // namespace known_friction_test
