// Load cells at both ends of a cable that differ in gain, against closed forms of a chain that slides.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"

namespace gains_test {
using namespace estimation;

namespace {

using Model = Site<double>::Model;
using Estimator = CellEstimator;

constexpr double noise = 0.001 * full;

/// What is true of a jacking.
struct Truth {
  double jack_gain = 0, far_gain = 0;
  bool releases = true;
};

/// In how many rows of a ramp and a release the alarm is raised; `gain_sd` is what is said of both cells.
int rows_with_alarm(const Truth& truth, double gain_sd, double tolerance, std::uint64_t seed) {
  static Plane scene;
  static Model model;
  static taut::FrictionPrior<double, PlaneCapacity> known;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.06;
  cable.shared_mu = true;
  for (auto& cell : cable.cell) {
    cell.sd = noise;
    cell.gain_sd = gain_sd;
  }
  support::rigid_saddles(scene, cable, support::chain_points(6));
  REQUIRE(support::condense(scene, model).ok());
  taut::find_friction_prior(scene, known);
  // All of friction from end to end; in truth there is a tenth more of it in the exponent.
  double held = 1;
  for (int j = 0; j < model.joints; ++j) held *= std::pow(model.rho[j], 1.1);
  taut::AlarmLimits<double> limits;
  limits.gain = tolerance;
  const auto estimator = std::make_unique<Estimator>();
  REQUIRE(estimator->start(model, known, limits).status.ok());
  std::vector<double> loads;
  for (int i = 1; i <= 150; ++i) loads.push_back(full * i / 150);
  for (int i = 1; i <= 150 && truth.releases; ++i) loads.push_back(full * (1 - 0.9 * i / 150));
  Random random(seed);
  double far = 0;
  int rows = 0;
  for (const double load : loads) {
    far = std::min(std::max(far, load * held), load / held);
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, false, (1 + truth.jack_gain) * load + noise * gaussian(random), 0};
    readings.ends[0][0] = {true, false, (1 + truth.far_gain) * far + noise * gaussian(random), 0};
    REQUIRE(estimator->advance(readings).status.ok());
    for (const taut::Alarm& alarm : estimator->alarms()) {
      if (alarm.kind != taut::Alarm::Kind::gain) continue;
      CHECK(alarm.cable == 0);
      CHECK(alarm.place == 0);
      ++rows;
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("cells that differ by twice what they may are found once the cable slides back") {
  for (const double way : {1.0, -1.0})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      CAPTURE(way);
      CAPTURE(seed);
      CHECK(rows_with_alarm({0.02 * way, 0}, 0.01, 0.01, seed) > 10);
      CHECK(rows_with_alarm({0, 0.02 * way}, 0.01, 0.01, seed) > 10);
      // While it only pulls, another mu explains them.
      CHECK(rows_with_alarm({0.02 * way, 0, false}, 0.01, 0.01, seed) == 0);
      // What they have in common nobody sees.
      CHECK(rows_with_alarm({0.02 * way, 0.02 * way}, 0.01, 0.01, seed) == 0);
      CHECK(rows_with_alarm({0.02 * way, 0}, 0.01, 0.03, seed) == 0);
    }
}

TEST_CASE("cells that do not differ are not told") {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) told += rows_with_alarm({}, 0.01, 0.01, seed) > 0 ? 1 : 0;
  CHECK(told <= 2);
}

TEST_CASE("gains that are known exactly are not doubted") {
  CHECK(rows_with_alarm({0.02, 0}, 0, 0.01, 1) == 0);
}

}  // namespace gains_test
