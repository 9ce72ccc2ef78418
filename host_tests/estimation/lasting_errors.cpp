// Errors of readings that do not average out, the steps of a display and the strokes of a pump, against a
// truth that has them: what the error bars of forces and friction are worth.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "taut/estimation/lasting_error.hpp"

namespace lasting_errors_test {
using namespace estimation;

namespace {

/// How many intervals of 95 % hold the truth, of friction and of the forces of a hold [%].
struct Held {
  int mu = 0, forces = 0, sites = 0, all = 0;
  double of_mu() const { return 100.0 * mu / sites; }
  double of_forces() const { return 100.0 * forces / all; }
};

/// Sites whose friction differs as is said; a ramp of 60 readings, then a hold. swing(i) is by what part of
/// it the force goes up and down.
template <class Swing>
Held after_a_hold(const Instruments& instruments, const Swing& swing) {
  constexpr double nominal = 0.2, mu_sd = 0.06;
  Held held;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    support::Random random(seed);
    Ground ground;
    taut::Cable<double> cable = support::steel_cable(nominal);
    cable.law = taut::FrictionLaw::capstan;
    cable.mu_sd = mu_sd;
    cable.shared_mu = true;
    support::rigid_saddles(ground.known, cable, support::chain_points(7));
    const double actual = std::fmax(0.02, nominal + mu_sd * support::gaussian(random)),
                 level = random.between(0.8, 1);
    ground.set_true_mu(std::vector<double>(16, actual));
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
    int row = 0;
    const auto go = [&](double part) { site->advance(full * level * part * (1 + swing(row++))); };
    for (int i = 1; i <= 60; ++i) go(i / 60.0);
    for (int i = 0; i < 400; ++i) {
      go(1);
      for (int s = 0; i >= 100 && s < site->segments(); ++s, ++held.all)
        held.forces += site->holds_truth(s) ? 1 : 0;
    }
    REQUIRE(site->good());
    ++held.sites;
    const double off = site->estimator().mu(0) - actual;
    held.mu += std::fabs(off) < 1.96 * site->estimator().mu_deviation(0) ? 1 : 0;
  }
  return held;
}

}  // namespace

TEST_CASE("displays that hardly change in a hold: error bars hold, of friction too") {
  Instruments instruments;
  instruments.jack = instruments.cell = 0.001;
  instruments.step = 0.01;
  const Held held = after_a_hold(instruments, [](int) { return 0.0; });
  CHECK(held.of_forces() > 92);
  CHECK(held.of_mu() > 90);
}

TEST_CASE("a force that goes up and down, and friction that keeps its peaks: error bars hold") {
  Instruments instruments;
  instruments.jack = instruments.cell = 0.002;
  for (const double period : {7.3, 18.4}) {
    CAPTURE(period);
    const Held held = after_a_hold(
        instruments, [period](int row) { return 0.005 * std::sin(2 * support::pi * row / period); });
    CHECK(held.of_forces() > 90);
  }
}

TEST_CASE("where readings scatter as they should, nothing is kept from averaging out") {
  Instruments instruments;
  instruments.jack = instruments.cell = 0.002;
  const Held held = after_a_hold(instruments, [](int) { return 0.0; });
  CHECK(held.of_forces() > 92);
  CHECK(held.of_forces() < 99.5);
  CHECK(held.of_mu() > 88);
}

TEST_CASE("readings that are off alike leave what they have in common, and their noise over their number") {
  for (const double lasting : {0.01, 1.0, 100.0})
    for (const double beforehand : {1e3, 1e9}) {
      CAPTURE(lasting);
      CAPTURE(beforehand);
      const double noise = 25;
      double known = beforehand;
      for (int n = 1; n <= 1000; ++n) {
        const double counted = taut::counted_variance(known, noise, lasting);
        if (counted > 0) known = known * counted / (known + counted);
        // Of a mean of n readings, by Bayes.
        const double mean = lasting + noise / n, exact = beforehand * mean / (beforehand + mean);
        CHECK(known > exact * (1 - 1e-9));
        if (beforehand == 1e9) CHECK(known < exact * 1.01);
      }
    }
  CHECK(taut::counted_variance(100.0, 25.0, 0.0) == 25);
  CHECK(taut::counted_variance(100.0, 25.0, 100.0) == 0);
  CHECK(taut::counted_variance(1.0, 25.0, 100.0) == 0);
  // Of cables of 100 MN, in single precision.
  CHECK(std::isfinite(taut::counted_variance(1e15F, 1e12F, 9e14F)));
}

}  // namespace lasting_errors_test
