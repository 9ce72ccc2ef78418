// Loads beside the jacks that change while a jack is at work: friction comes to rest at a force that is not
// known exactly, and remembers it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "estimation/followers.hpp"
#include "estimation/ramp.hpp"

namespace other_loads_test {
using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Known = taut::FrictionPrior<double, PlaneCapacity>;
using Row = taut::Sample<double, PlaneCapacity>;

/// A row of a log; whether the jack's force is off in it.
struct Step {
  double force = 0, factor = 0;
  bool is_off = false;
};
/// A ramp, other loads that come on while the jack rests or goes on, and a ramp up or down after that.
std::vector<Step> steps(double during, double after) {
  std::vector<Step> all;
  Step at;
  const auto go = [&](double force, double factor, bool is_off, int count) {
    const Step from = at;
    for (int i = 1; i <= count; ++i) {
      at = {from.force + (force - from.force) * i / count, from.factor + (factor - from.factor) * i / count,
            is_off};
      all.push_back(at);
    }
  };
  go(0.5, 0, false, 10);
  go(0.52, 0, true, 1);
  go(during, 0.9, true, 12);
  go(after, 0.9, false, 20);
  return all;
}

}  // namespace

TEST_CASE("derivatives by the load that friction came to rest at are those of trackers with other loads") {
  static Plane scene;
  static Model model;
  static Known known;
  support::truss_string(scene, support::steel_cable(0.2), 6);
  REQUIRE(support::condense(scene, model).ok());
  taut::find_friction_prior(scene, known);
  int remembered = 0, compared = 0;
  for (const double during : {0.52, 0.6})
    for (const double after : {0.9, 0.3})
      for (const double sign : {1.0, -1.0}) {
        CAPTURE(during);
        CAPTURE(after);
        CAPTURE(sign);
        const auto trackers = three_followers(model, known);
        auto& [less, at, more] = *trackers;
        const double h = 1e-4;
        bool was_off = false;
        int row = 0;
        for (const Step& step : steps(during, after)) {
          CAPTURE(row);
          ++row;
          if (was_off && !step.is_off) REQUIRE(at.end_load_error(2).ok());
          for (int way = -1; way <= 1; ++way) {
            Row sample;
            sample.jack[0][1].force = step.force * full + (step.is_off ? way * h : 0);
            sample.factor[1] = sign * step.factor;
            REQUIRE((*trackers)[static_cast<std::size_t>(way + 1)].advance(sample).status.ok());
          }
          if (!was_off && step.is_off) {
            at.begin_load_error({2, 1, 1, 0});
            Row here;
            here.jack[0][1].force = step.force * full;
            REQUIRE(at.advance(here).status.ok());
          }
          was_off = step.is_off;
          for (int i = 0; i < model.segments; ++i) {
            const double up = (more.tension(i) - at.tension(i)) / h,
                         down = (at.tension(i) - less.tension(i)) / h,
                         found = step.factor > 0 || step.is_off ? at.sensitivity(2, i) : 0;
            // At an event the two differ.
            if (std::fabs(up - down) > 1e-3) continue;
            CHECK(std::fabs(found - up) < 1e-3);
            ++compared;
            remembered += !step.is_off && step.factor > 0 && std::fabs(up) > 0.1 ? 1 : 0;
          }
        }
      }
  // Else nothing was tested.
  CHECK(compared > 1000);
  CHECK(remembered > 20);
}

namespace {

struct Tally {
  long held = 0, all = 0;
  double square = 0;

  template <class Scalar>
  void add(const Site<Scalar>& site) {
    for (int i = 0; i < site.segments(); ++i) {
      const double part = site.error(i) / full;
      held += site.holds_truth(i) ? 1 : 0;
      square += part * part;
      ++all;
    }
  }
  double share() const { return static_cast<double>(held) / static_cast<double>(all); }
  double rms() const { return std::sqrt(square / static_cast<double>(all)); }
};

}  // namespace

TEST_CASE_TEMPLATE("the error bars hold while other loads change in holds and ramps, and long after", Scalar,
                   double, float) {
  static Ground ground;
  for (const bool has_cell : {true, false}) {
    CAPTURE(has_cell);
    std::array<Tally, 4> tallies;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      Random random(seed);
      truss_of_unknown_mu(ground, 0.03, random);
      Instruments instruments;
      instruments.has_cell = has_cell;
      const auto site = std::make_unique<Site<Scalar>>(ground, instruments, full, seed);
      Deed deed;
      const auto go = [&](double force, double factor, int rows) {
        go_on(deed, force, factor, rows, [&] { site->advance(deed); });
        REQUIRE(site->good());
      };
      go(0.6, 0, 80);
      go(0.6, 0, 30);
      const double sign = random.coin() ? 1 : -1;
      go(0.6, sign, 30);
      tallies[0].add(*site);
      go(0.6, sign, 30);
      tallies[1].add(*site);
      go(0.8, -sign, 60);
      tallies[2].add(*site);
      go(0.8, -sign, 30);
      tallies[3].add(*site);
    }
    for (const Tally& tally : tallies) {
      const auto stage = &tally - tallies.data();
      CAPTURE(stage);
      CHECK(tally.share() > 0.9);
      CHECK(tally.rms() < (has_cell ? 0.005 : 0.04));
    }
  }
}

TEST_CASE_TEMPLATE("loads that begin to change with the jack on its way do so from where it was a row ago",
                   Scalar, double, float) {
  static Ground ground;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 1e-3;
  cable.shared_mu = true;
  support::truss_string(ground.known, cable, 6);
  ground.set_true_mu(std::vector<double>(16, 0.2));
  Instruments instruments;
  instruments.jack = 5e-4;
  instruments.has_cell = false;
  for (const double way : {1.0, -1.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(way);
      CAPTURE(seed);
      const auto site = std::make_unique<Site<Scalar>>(ground, instruments, full, seed);
      Deed at;
      const auto advance = [&] { site->advance(at); };
      go_on(at, 0.6, 0, 60, advance);
      if (way < 0) go_on(at, 0.4, 0, 20, advance);
      for (int row = 1; row <= 3; ++row) {
        CAPTURE(row);
        go_on(at, at.force[1] / full + 0.01 * way, 0.1 * row, 1, advance);
        for (int i = 0; i < site->segments(); ++i) {
          CAPTURE(i);
          CHECK(std::fabs(site->error(i)) < 6 * instruments.jack * full);
        }
      }
      REQUIRE(site->good());
    }
}

}  // namespace other_loads_test
