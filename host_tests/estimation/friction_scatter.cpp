// What mu that scatters from joint to joint adds to the variance of forces, against chains drawn joint by
// joint.
#include "taut/estimation/friction_scatter.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "estimation/scattered_chain.hpp"

namespace friction_scatter_test {
using namespace estimation;

namespace {

/// Variances are small numbers: compared by their ratio.
bool are_close(double a, double b, double part) { return std::fabs(a - b) <= part * std::fabs(b); }

constexpr double nominal_mu = 0.2;

/// A cable over saddles that turn it by `turns`, jacked at its end.
Ground over_saddles(const std::vector<double>& turns, double mu_sd, double scatter) {
  Ground ground;
  taut::Cable<double> cable = support::steel_cable(nominal_mu);
  cable.law = taut::FrictionLaw::capstan;
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  cable.scatter = scatter;
  std::vector<support::PlanePoint> points{{0, 0}};
  double angle = -1;
  for (std::size_t i = 0; i <= turns.size(); ++i) {
    if (i > 0) angle += turns[i - 1];
    points.push_back({points.back()[0] + 3 * std::cos(angle), points.back()[1] + 3 * std::sin(angle)});
  }
  support::rigid_saddles(ground.known, cable, points);
  ground.actual = ground.known;
  return ground;
}

/// Every joint has a part of its own on top of what they share.
std::vector<double> draw_mu(support::Random& random, std::size_t joints, double mu_sd, double scatter) {
  const double common = nominal_mu + mu_sd * support::gaussian(random);
  std::vector<double> mu;
  for (std::size_t j = 0; j < joints; ++j)
    mu.push_back(std::fmax(0, common * (1 + scatter * support::gaussian(random))));
  return mu;
}

/// Segment forces under a jack that pulls `full`: Euler's law, joint by joint, with a mu of its own each.
std::vector<double> euler(const std::vector<double>& turns, const std::vector<double>& mu) {
  std::vector<double> force(turns.size() + 1, full);
  for (std::size_t j = turns.size(); j-- > 0;) force[j] = force[j + 1] * std::exp(-mu[j] * turns[j]);
  return force;
}

}  // namespace

TEST_CASE("the variance is that of joints drawn one by one, given what all of them hold together") {
  for (const bool jacked_at_start : {true, false})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      CAPTURE(seed);
      CAPTURE(jacked_at_start);
      ScatteredChain chain = ScatteredChain::random(seed);
      // Forces come from the only jack, however near the anchored end is.
      chain.ends[jacked_at_start ? 1 : 0] = taut::End::anchored;
      const Strays drawn = draw_strays(chain, jacked_at_start, seed);
      ChainScatter scatter;
      chain.find(scatter, 0, 0, 0);
      double before = 0, whole = 0;
      for (int j = 0; j < chain.joints(); ++j) whole += chain.weight(j);
      for (int i = 0; i <= chain.joints(); ++i) {
        CAPTURE(i);
        const double way = jacked_at_start ? before : whole - before, force = drawn.force(i),
                     said = variance_of(scatter, i, chain.sensitivity(force, way));
        // Chance is 0.7 % of the variance, what is not of first order 1 %. All joints together do not stray.
        if (i > 0 && i < chain.joints())
          CHECK(are_close(said, force * force * drawn.variance(i), 0.03));
        else
          CHECK(said < 1e-12 * force * force);
        if (i < chain.joints()) before += chain.weight(i);
      }
    }
}

TEST_CASE("of two jacks the friction on the way from the nearer one counts") {
  for (std::uint64_t seed = 11; seed <= 14; ++seed) {
    CAPTURE(seed);
    const ScatteredChain chain = ScatteredChain::random(seed);
    const Strays from_start = draw_strays(chain, true, seed), from_end = draw_strays(chain, false, seed);
    ChainScatter scatter;
    chain.find(scatter, 0, 0, 0);
    double before = 0, whole = 0;
    for (int j = 0; j < chain.joints(); ++j) whole += chain.weight(j);
    for (int i = 0; i <= chain.joints(); ++i) {
      CAPTURE(i);
      const bool starts = before < whole - before;
      const Strays& drawn = starts ? from_start : from_end;
      const double way = starts ? before : whole - before, force = drawn.force(i);
      const double said = variance_of(scatter, i, chain.sensitivity(force, way));
      if (i == 0 || i == chain.joints())
        CHECK(said == 0);
      else
        CHECK(are_close(said, force * force * drawn.variance(i), 0.03));
      if (i < chain.joints()) before += chain.weight(i);
    }
  }
}

TEST_CASE_TEMPLATE("with equal joints the variance is that of a Brownian bridge", Scalar, float, double) {
  // Of n steps of variance d^2 the first i have i (n - i) / n of it.
  constexpr int n = 8;
  const ChainLayout cable{0, 0, n};
  taut::FrictionScatter<Scalar, ChainCapacity> scatter;
  scatter.clear();
  scatter.find(
      cable, 0, Scalar(1), [](int) { return Scalar(2); }, [](int) { return Scalar(0.5); });
  for (int i = 0; i <= n; ++i) {
    CAPTURE(i);
    const int way = i < n - i ? i : n - i;
    const double of_sum = 0.25 * i * (n - i) / n, by_unknown = 2.0 * way;
    // A derivative of the force of -3 by what is summed.
    const auto S = static_cast<Scalar>(-3 * by_unknown);
    CHECK(are_close(static_cast<double>(variance_of(scatter, i, [S](int) { return S; })), 9 * of_sum, 1e-6));
  }
}

TEST_CASE("what scatters is a part of the friction that there is, as far as that is known") {
  const ScatteredChain chain = ScatteredChain::random(41);
  ChainScatter scatter;
  scatter.clear();
  chain.find_in(scatter, 0, 0, 0, 0.2);
  for (int i = 1; i < chain.joints(); ++i) {
    CHECK(scatter.variance(i, 0) > 0);
    CHECK(are_close(scatter.variance(i, 0.1), 2.25 * scatter.variance(i, 0), 1e-9));
    CHECK(are_close(scatter.variance(i, -0.1), 0.25 * scatter.variance(i, 0), 1e-9));
  }
}

TEST_CASE("the mean of friction on the ways from an end strays as joints drawn one by one do") {
  constexpr int n = 9;
  constexpr double part = 0.2, mu = 0.15;
  const ChainLayout cable{0, 0, n, {taut::End::anchored, taut::End::jacked}};
  ChainScatter scatter;
  scatter.clear();
  scatter.find(
      cable, 0, mu, [](int) { return 1.0; }, [](int) { return part * mu; });
  support::Random random(6);
  for (int m = 1; m <= n; ++m) {
    CAPTURE(m);
    double square = 0;
    constexpr int draws = 40000;
    for (int draw = 0; draw < draws; ++draw) {
      std::array<double, n> s{};
      double whole = 0;
      for (double& each : s) whole += each = part * mu * support::gaussian(random);
      // Given what all hold together; from the end, segment by segment.
      double way = 0, ways = 0;
      for (int j = 0; j < m; ++j) ways += way += s[static_cast<std::size_t>(j)] - whole / n;
      square += std::pow(ways / (m * (m + 1) / 2.0), 2);
    }
    // Chance is 0.7 %.
    CHECK(are_close(scatter.variance_of_mean(n - m, m, part, 0), square / draws, 0.03));
  }
}

TEST_CASE("without a far-end reading the deviation is the error of the forces of joints drawn one by one") {
  const std::vector<double> equal(6, 0.3), unequal{0.35, 0.2, 0.5, 0.1, 0.42, 0.3};
  for (const auto* turns : {&equal, &unequal})
    for (const double mu_sd : {0.0, 0.005, 0.03}) {
      constexpr double scatter = 0.2;
      CAPTURE(mu_sd);
      CAPTURE(turns == &equal);
      Instruments instruments;
      instruments.jack = 1e-6;
      instruments.has_cell = false;
      const Ground ground = over_saddles(*turns, mu_sd, scatter);
      const auto site = std::make_unique<Site<double>>(ground, instruments, full, 1);
      ramp(*site, 0, 1, 100);
      REQUIRE(site->good());
      support::Random random(77);
      std::vector<double> square(turns->size() + 1);
      constexpr int draws = 40000;
      for (int draw = 0; draw < draws; ++draw) {
        const auto truth = euler(*turns, draw_mu(random, turns->size(), mu_sd, scatter));
        for (std::size_t i = 0; i < truth.size(); ++i)
          square[i] += std::pow(site->estimator().force(static_cast<int>(i)) - truth[i], 2);
      }
      for (std::size_t i = 0; i + 1 < square.size(); ++i) {
        CAPTURE(i);
        const double rms = std::sqrt(square[i] / draws),
                     said = site->estimator().deviation(static_cast<int>(i));
        // Chance is 0.4 %, second order 0.5 %. On the way, joints that differ stray by other parts than the
        // shared unknown has them.
        CHECK(are_close(said, rms, i == 0 || turns == &equal ? 0.02 : 0.15));
      }
    }
}

TEST_CASE(
    "with a far-end reading intervals hold the forces of joints drawn one by one as often as they say") {
  const std::vector<double> turns{0.35, 0.2, 0.5, 0.1, 0.42, 0.3};
  for (const double mu_sd : {0.0, 0.03}) {
    CAPTURE(mu_sd);
    constexpr double scatter = 0.2;
    Instruments instruments;
    instruments.jack = instruments.cell = 0.002;
    support::Random random(5);
    int held_far = 0, held = 0, all = 0;
    constexpr int sites = 300;
    for (int number = 0; number < sites; ++number) {
      Ground ground = over_saddles(turns, mu_sd, scatter);
      const auto mu = draw_mu(random, turns.size(), mu_sd, scatter);
      ground.set_true_mu(mu);
      const auto site =
          std::make_unique<Site<double>>(ground, instruments, full, static_cast<std::uint64_t>(number));
      ramp(*site, 0, 1, 100);
      REQUIRE(site->good());
      // The last row's load has an error of its own.
      const auto truth = euler(turns, mu);
      for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
        const int segment = static_cast<int>(i);
        const bool holds = std::fabs(site->estimator().force(segment) - truth[i]) <
                           1.96 * site->estimator().deviation(segment);
        if (i == 0)
          held_far += holds ? 1 : 0;
        else
          held += holds ? 1 : 0, ++all;
      }
    }
    CHECK(100.0 * held_far / sites > 92);
    CHECK(100.0 * held / all > 92);
    CHECK(100.0 * held / all < 98.5);
  }
}

TEST_CASE("a joint that cannot slide is as if it were not there") {
  ScatteredChain chain = ScatteredChain::random(21), without = chain;
  const int stuck = 3;
  chain.contact_factor[stuck] = 0;
  without.contact_factor.erase(without.contact_factor.begin() + stuck);
  without.mu.erase(without.mu.begin() + stuck);
  ChainScatter scatter, expected;
  chain.find(scatter, 0, 0, 0);
  without.find(expected, 0, 0, 0);
  const auto one = [](int) { return 1.0; };
  for (int i = 0; i <= chain.joints(); ++i) {
    CAPTURE(i);
    CHECK(are_close(variance_of(scatter, i, one), variance_of(expected, i > stuck ? i - 1 : i, one), 1e-9));
  }
  // Nor if none can, or none scatters.
  without.scatter = 0;
  for (double& contact_factor : chain.contact_factor) contact_factor = 0;
  for (const ScatteredChain* none : {&chain, &without}) {
    none->find(scatter, 0, 0, 0);
    for (int i = 0; i <= none->joints(); ++i) CHECK(variance_of(scatter, i, one) == 0);
  }
}

TEST_CASE("every cable has its own joints, segments and unknown; one that shares nothing has no variance") {
  const ScatteredChain first = ScatteredChain::random(31), second = ScatteredChain::random(32);
  // Between them lies a cable of three segments that is left out.
  const int segment = first.joints() + 1 + 3, joint = first.joints() + 2;
  ChainScatter alone[2], both;
  first.find(alone[0], 0, 0, 0);
  second.find(alone[1], 0, 0, 0);
  both.clear();
  first.find_in(both, 0, 0, 5);
  second.find_in(both, segment, joint, 7);
  const auto one = [](int) { return 1.0; };
  const auto by_number = [](int p) { return p == 5 ? 2.0 : p == 7 ? 3.0 : 1e9; };
  for (int i = 0; i <= first.joints(); ++i)
    CHECK(are_close(variance_of(both, i, by_number), 4 * variance_of(alone[0], i, one), 1e-9));
  for (int i = 0; i < 3; ++i) CHECK(variance_of(both, first.joints() + 1 + i, by_number) == 0);
  for (int i = 0; i <= second.joints(); ++i)
    CHECK(are_close(variance_of(both, segment + i, by_number), 9 * variance_of(alone[1], i, one), 1e-9));
  both.clear();
  for (int i = 0; i < ChainCapacity::segments; ++i) CHECK(variance_of(both, i, by_number) == 0);
}

}  // namespace friction_scatter_test
