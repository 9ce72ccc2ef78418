// A cable that warms while its jacks are locked, and no column says so: what the strain does to the forces,
// and what a cell at the far end makes of it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <vector>

#include "estimation/followers.hpp"
#include "estimation/ramp.hpp"

namespace drift_test {
using namespace estimation;

namespace {

constexpr double alpha = 1.2e-5;

/// The last load pattern has no forces, and warms the cable by a kelvin if it `warms`.
void make_scene(Plane& scene, const taut::Cable<double>& cable, bool elastic, bool warms) {
  if (elastic)
    support::truss_string(scene, cable, 6);
  else
    support::rigid_saddles(scene, cable, support::chain_points(7));
  const int load = scene.add_load();
  if (warms) REQUIRE(scene.add_temperature(load, 0, 1) >= 0);
}

using Model = taut::Condensed<double, PlaneCapacity>;
using Known = taut::FrictionPrior<double, PlaneCapacity>;
using Row = taut::Sample<double, PlaneCapacity>;

/// A row, after which an unknown is the strain of the cable; from the next one on it is warmer or colder.
struct Warmed {
  Row row;
  double kelvin = 0;
  bool begins = false, is_warm = false;
};
/// Up and locked; colder and back, so that hardly a joint is at its limit; then warmed, and jacked once more
/// in further rows.
std::vector<Warmed> two_visits(std::size_t end) {
  std::vector<Warmed> rows;
  Warmed at;
  const auto go = [&](double force, bool locked, int steps) {
    const double from = at.row.jack[0][end].force;
    for (int i = 1; i <= steps; ++i) {
      at.row.jack[0][end] = {from + (force * full - from) * i / steps, locked};
      rows.push_back(at);
    }
  };
  go(0.9, false, 20);
  go(0.88, false, 3);
  go(0.88, true, 2);
  at.kelvin = -3;
  go(0.88, true, 1);
  at.kelvin = -2;
  at.begins = true;
  go(0.88, true, 1);
  at.begins = false;
  at.is_warm = true;
  go(0.88, true, 3);
  go(0, true, 2);
  go(0.88, true, 2);
  go(0.885, false, 3);
  go(0.9, false, 5);
  go(1, false, 10);
  go(0.4, false, 20);
  return rows;
}

}  // namespace

TEST_CASE("derivatives by the strain of a locked cable are those of trackers with other temperatures") {
  static Plane scene;
  static Model model;
  static Known known;
  int held = 0, free = 0;
  for (const bool elastic : {false, true})
    for (const std::size_t end : {0U, 1U}) {
      CAPTURE(elastic);
      CAPTURE(end);
      taut::Cable<double> cable =
          support::steel_cable(0.2, end == 0 ? support::jacked_start : support::jacked_end);
      cable.alpha = alpha;
      cable.temperature_sd = 10;
      make_scene(scene, cable, elastic, true);
      REQUIRE(support::condense(scene, model).ok());
      taut::find_friction_prior(scene, known);
      CHECK(known.drift_sd[0] == alpha * 10);
      const auto trackers = three_followers(model, known);
      const double kelvin = 1e-4;
      int row = 0;
      for (const Warmed& warmed : two_visits(end)) {
        CAPTURE(row);
        ++row;
        for (int way = -1; way <= 1; ++way) {
          Row sample = warmed.row;
          sample.factor[model.loads - 1] = warmed.kelvin + (warmed.is_warm ? kelvin * way : 0);
          REQUIRE((*trackers)[static_cast<std::size_t>(way + 1)].advance(sample).status.ok());
        }
        Follower &colder = (*trackers)[0], &at = (*trackers)[1], &warmer = (*trackers)[2];
        if (warmed.begins) REQUIRE(at.strain(2, 0, end, known.length).ok());
        if (!warmed.is_warm) continue;
        for (int i = 0; i < model.segments; ++i) {
          // Where a joint is at its limit, warming and cooling differ: it sticks one way.
          const auto differs = [&](const Follower& one, const Follower& other) {
            return std::fabs(at.sensitivity(2, i) - (one.tension(i) - other.tension(i)) / (kelvin * alpha));
          };
          CHECK(std::fmin(differs(warmer, at), differs(at, colder)) <
                1e-5 * support::cable_E * support::cable_A);
          ++(warmed.row.jack[0][end].locked ? held : free);
        }
      }
    }
  // Else nothing was tested.
  CHECK(held > 100);
  CHECK(free > 500);
}

TEST_CASE("between rigid saddles a strain takes E A times as much of every force") {
  static Plane scene;
  static Model model;
  static Known known;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.alpha = alpha;
  cable.temperature_sd = 10;
  make_scene(scene, cable, false, true);
  REQUIRE(support::condense(scene, model).ok());
  taut::find_friction_prior(scene, known);
  static Follower tracker;
  REQUIRE(tracker.start(model).status.ok());
  for (const Warmed& warmed : two_visits(1)) {
    Row sample = warmed.row;
    sample.factor[model.loads - 1] = warmed.kelvin;
    REQUIRE(tracker.advance(sample).status.ok());
    if (!warmed.begins) continue;
    REQUIRE(tracker.strain(2, 0, 1, known.length).ok());
    const double stiffness = support::cable_E * support::cable_A;
    for (int i = 0; i < model.segments; ++i)
      CHECK(tracker.sensitivity(2, i) == doctest::Approx(-stiffness).epsilon(1e-9).scale(0));
  }
}

namespace {

/// Locked after a ramp and a hold, and warmed slowly by so many kelvin.
template <class Scalar, class Check>
void warm(Site<Scalar>& site, double kelvin, const Check& check) {
  ramp(site, 0, 0.8, 150);
  for (int i = 0; i < 40; ++i) site.advance(0.8 * full);
  Deed deed;
  deed.force[1] = 0.8 * full;
  deed.locked[1] = true;
  for (int i = 0; i < 20; ++i) site.advance(deed);
  for (int i = 1; i <= 200; ++i) {
    deed.factor = kelvin * i / 200;
    site.advance(deed);
    REQUIRE(site.good());
    check();
  }
}
void make_ground(Ground& ground, bool elastic, double temperature_sd, double actual_mu) {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.04;
  cable.shared_mu = true;
  cable.alpha = alpha;
  cable.seating = 0.004;
  cable.temperature_sd = temperature_sd;
  make_scene(ground.known, cable, elastic, false);
  make_scene(ground.actual, cable, elastic, true);
  for (double& mu : ground.actual.mu) mu = actual_mu;
}

}  // namespace

TEST_CASE_TEMPLATE("with a cell at the far end the forces follow a cable that warms unseen, and mu stays",
                   Scalar, double, float) {
  static Ground ground;
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    long held = 0, all = 0;
    double moved = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      make_ground(ground, elastic, 8, std::fmax(0.02, 0.2 + 0.04 * gaussian(random)));
      const double kelvin = 8 * gaussian(random);
      const auto site = std::make_unique<Site<Scalar>>(ground, Instruments{}, full, seed);
      double mu = std::numeric_limits<double>::quiet_NaN(), before = 0;
      int row = 0;
      warm(*site, kelvin, [&] {
        if (std::isnan(mu)) {
          mu = static_cast<double>(site->estimator().mu(0));
          before = site->true_force(0);
        }
        CHECK(static_cast<double>(site->estimator().mu(0)) == mu);
        CHECK(raised(site->estimator().alarms(), taut::Alarm::Kind::sensor) == 0);
        CHECK(raised(site->estimator().alarms(), taut::Alarm::Kind::misfit) == 0);
        if (++row % 50 != 0) return;
        for (int i = 0; i < site->segments(); ++i) {
          held += site->holds_truth(i) ? 1 : 0;
          ++all;
        }
      });
      moved = std::fmax(moved, std::fabs(site->true_force(0) - before));
    }
    // Else nothing was tested.
    CHECK(moved > (elastic ? 0.05 : 0.1) * full);
    CHECK(held > 0.9 * static_cast<double>(all));
  }
}

TEST_CASE("without a cell at the far end what warms unseen is in the interval") {
  static Ground ground;
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    long held = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Random random(seed);
      make_ground(ground, elastic, 8, std::fmax(0.02, 0.2 + 0.04 * gaussian(random)));
      Instruments instruments;
      instruments.has_cell = false;
      const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
      warm(*site, 8 * gaussian(random), [] {});
      for (int i = 0; i < site->segments(); ++i) {
        held += site->holds_truth(i) ? 1 : 0;
        ++all;
      }
    }
    CHECK(held > 0.9 * static_cast<double>(all));
  }
}

TEST_CASE_TEMPLATE(
    "what warms unseen is told where the scene says nothing of it, and neither gains nor mu are known",
    Scalar, double, float) {
  static Ground ground;
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    int told = 0, told_at_rest = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      make_ground(ground, elastic, 0, std::fmax(0.02, 0.2 + 0.04 * gaussian(random)));
      for (auto& cell : ground.known.cables[0].cell) cell.gain_sd = 0.01;
      for (const double kelvin : {0.0, elastic ? -15.0 : -3.0, elastic ? 15.0 : 3.0}) {
        CAPTURE(kelvin);
        const auto site = std::make_unique<Site<Scalar>>(ground, Instruments{}, full, seed);
        bool any = false;
        warm(*site, kelvin,
             [&] { any |= raised(site->estimator().alarms(), taut::Alarm::Kind::misfit) > 0; });
        (kelvin == 0 ? told_at_rest : told) += any ? 1 : 0;
      }
    }
    CHECK(told >= 38);
    CHECK(told_at_rest <= 1);
  }
}

TEST_CASE("a strain is no extension: the wedge stays where it is") {
  static Ground ground;
  make_ground(ground, true, 8, 0.2);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{}, full, 1);
  double extension = std::numeric_limits<double>::quiet_NaN();
  warm(*site, 10, [&] {
    taut::Response<double, PlaneCapacity> response;
    site->estimator().respond(response, &site->rows());
    if (std::isnan(extension)) extension = response.extension[0][1];
    // The draw-in is corrected with the strain: by less than it is uncertain.
    CHECK(std::fabs(response.extension[0][1] - extension) < 3 * 0.25 * 0.004);
  });
}

TEST_CASE("put back from its saved state after every row, a cable that drifts goes on with the same bits") {
  static Ground ground;
  for (const bool elastic : {false, true}) {
    make_ground(ground, elastic, 8, 0.22);
    const auto plain = std::make_unique<Site<float>>(ground, Instruments{}, full, 5),
               restarted = std::make_unique<Site<float>>(ground, Instruments{}, full, 5);
    std::vector<float> expected;
    const auto answers = [](const Site<float>& site, std::vector<float>& all) {
      for (int i = 0; i < site.segments(); ++i) {
        all.push_back(site.estimator().force(i));
        all.push_back(site.estimator().deviation(i));
      }
    };
    warm(*plain, 10, [&] { answers(*plain, expected); });
    std::vector<float> found;
    warm(*restarted, 10, [&] {
      answers(*restarted, found);
      restarted->restart();
    });
    CHECK(found == expected);
  }
}

}  // namespace drift_test
