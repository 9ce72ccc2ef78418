// Friction that a gauge has taught, and a jack that reverses then: when joints slide back depends on it.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"

namespace gauge_then_reversal_test {
using namespace estimation;

TEST_CASE("a jack reverses with the friction that a gauge has taught, not with that of the scene") {
  using Model = taut::Condensed<double, PlaneCapacity>;
  using Estimator = CellEstimator;
  Ground ground;
  taut::Cable<double> cable = support::steel_cable(0.15);
  cable.law = taut::FrictionLaw::capstan;
  cable.mu_sd = 0.06;
  cable.shared_mu = true;
  cable.cell[1].sd = 2e-3 * full;
  support::rigid_saddles(ground.known, cable, support::chain_points(8));
  ground.set_true_mu(std::vector<double>(16, 0.21));
  const auto known = std::make_unique<Model>(), actual = std::make_unique<Model>();
  const auto truth = std::make_unique<taut::Tracker<Model>>();
  const auto estimator = std::make_unique<Estimator>();
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::find_friction_prior(ground.known, prior);
  taut::LoadCell<double> gauge;
  gauge.sd = 0.2 * full;
  const std::vector<taut::LoadCell<double>> gauges = {gauge};
  REQUIRE(support::condense(ground.known, *known).ok());
  REQUIRE(support::condense(ground.actual, *actual).ok());
  REQUIRE(truth->start(*actual).status.ok());
  REQUIRE(estimator->start(*known, prior, {}, gauges).status.ok());
  support::Random random(1);
  double worst = 0;
  const auto go = [&](double part) {
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1].force = part * full;
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1].has_force = true;
    readings.ends[0][1].force = part * full + cable.cell[1].sd * support::gaussian(random);
    REQUIRE(truth->advance(sample).status.ok());
    REQUIRE(estimator->advance(readings).status.ok());
  };
  for (int i = 1; i <= 100; ++i) {
    go(i / 100.0);
    estimator->take_segment(0, truth->tension(0), taut::Gauge{0});
  }
  CHECK(std::fabs(estimator->mu(0) - 0.21) < 0.02);
  // Down, until joints next to the far end are about to slide back.
  for (int i = 1; i <= 60; ++i) {
    go(1 - i / 100.0);
    for (int s = 0; s < known->segments && i > 10; ++s)
      worst = std::fmax(worst, std::fabs(estimator->force(s) - truth->tension(s)) / full);
  }
  // What mu is off by still, 0.01, is about as much of the full force.
  CHECK(worst < 0.02);
}

}  // namespace gauge_then_reversal_test
