// What is estimated depends on the scene, not on what else its capacity has room for.
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "support/random.hpp"
#include "support/saddles.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/find_friction_prior.hpp"

namespace capacities_test {
namespace {

struct Exact : taut::Capacity {
  static constexpr int nodes = 5, cables = 1, jacks = 1, segments = 4, joints = 3;
  static constexpr bool lags = false;
};
struct Wide : taut::Capacity {
  static constexpr int nodes = 30, cables = 3, segments = 20, joints = 20, loads = 4, temperatures = 2;
};

/// Forces and standard deviations of all segments, row by row, of a cable that is pulled, let out twice,
/// pulled again and locked, with a cell at its far end.
template <class Scalar, class Cap>
std::vector<Scalar> answers_with() {
  using SceneType = taut::Scene<double, 2, Cap>;
  using Model = taut::Condensed<Scalar, Cap>;
  using Prior = taut::FrictionPrior<Scalar, Cap>;
  using Estimator = taut::Estimator<Model, 12, 4>;
  constexpr double full = 2e5, noise = 500;
  const auto scene = std::make_unique<SceneType>();
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.06;
  cable.shared_mu = true;
  cable.cell[0].sd = cable.cell[1].sd = noise;
  cable.cell[1].gain_sd = 0.01;
  cable.seating = 0.003;
  support::rigid_saddles(*scene, cable, support::chain_points(4));
  const auto condensed = std::make_unique<Model>();
  REQUIRE(std::make_unique<taut::Condensation<Scalar, SceneType>>()->run(*scene, *condensed).ok());
  const auto prior = std::make_unique<Prior>();
  taut::find_friction_prior(*scene, *prior);
  const auto estimator = std::make_unique<Estimator>();
  REQUIRE(estimator->start(*condensed, *prior).status.ok());
  support::Random random(20261128);
  std::vector<Scalar> answers;
  double load = 0;
  for (int row = 0; row < 160; ++row) {
    const bool falls = (row >= 60 && row < 75) || (row >= 95 && row < 115);
    load += falls ? -0.02 * full : row < 130 ? 0.015 * full : 0;
    typename Estimator::ReadingsType readings;
    readings.sample.jack[0][1].locked = row >= 145;
    readings.ends[0][0] = {true, false, static_cast<Scalar>(0.85 * load + noise * gaussian(random)), 0};
    readings.ends[0][1] = {true, false, static_cast<Scalar>(load + noise * gaussian(random)), 0};
    REQUIRE(estimator->advance(readings).status.ok());
    for (int i = 0; i < condensed->segments; ++i) {
      const auto told = estimator->estimate(i);
      answers.push_back(told.force);
      answers.push_back(told.deviation);
    }
  }
  return answers;
}

}  // namespace

TEST_CASE_TEMPLATE("a scene has the same forces and deviations, bit for bit, in a wider capacity", Scalar,
                   float, double) {
  const auto exact = answers_with<Scalar, Exact>(), wide = answers_with<Scalar, Wide>();
  REQUIRE(exact.size() == wide.size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) others += exact[i] == wide[i] ? 0 : 1;
  CHECK(others == 0);
}

TEST_CASE("a load cell that lags is refused by its cable where the capacity has none") {
  using Model = taut::Condensed<double, Exact>;
  const auto scene = std::make_unique<taut::Scene<double, 2, Exact>>();
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.cell[1].sd = 500;
  cable.cell[1].lag = 0.5;
  support::rigid_saddles(*scene, cable, support::chain_points(4));
  const auto condensed = std::make_unique<Model>();
  REQUIRE(std::make_unique<taut::Condensation<double, taut::Scene<double, 2, Exact>>>()
              ->run(*scene, *condensed)
              .ok());
  const auto prior = std::make_unique<taut::FrictionPrior<double, Exact>>();
  taut::find_friction_prior(*scene, *prior);
  const auto estimator = std::make_unique<taut::Estimator<Model, 12, 4>>();
  const taut::Status status = estimator->start(*condensed, *prior).status;
  CHECK(status.code == taut::Code::capacity_exceeded);
  CHECK(status.place == taut::Place::cable);
  CHECK(status.index == 0);
}

}  // namespace capacities_test
