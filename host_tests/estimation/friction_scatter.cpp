// What mu that scatters from joint to joint adds to the variance of forces, against chains drawn joint by
// joint.
#include "taut/estimation/friction_scatter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "estimation/scattered_chain.hpp"

using namespace estimation;

namespace {

/// Variances are small numbers: compared by their ratio.
bool are_close(double a, double b, double part) { return std::fabs(a - b) <= part * std::fabs(b); }

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
                     said = scatter.variance(i, chain.sensitivity(force, way));
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
      const double said = scatter.variance(i, chain.sensitivity(force, way));
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
      cable, 0, [](int) { return Scalar(2); }, [](int) { return Scalar(0.5); });
  for (int i = 0; i <= n; ++i) {
    CAPTURE(i);
    const int way = i < n - i ? i : n - i;
    const double of_sum = 0.25 * i * (n - i) / n, by_unknown = 2.0 * way;
    // A derivative of the force of -3 by what is summed.
    const auto S = static_cast<Scalar>(-3 * by_unknown);
    CHECK(are_close(static_cast<double>(scatter.variance(i, [S](int) { return S; })), 9 * of_sum, 1e-6));
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
    CHECK(are_close(scatter.variance(i, one), expected.variance(i > stuck ? i - 1 : i, one), 1e-9));
  }
  // Nor if none can, or none scatters.
  without.scatter = 0;
  for (double& contact_factor : chain.contact_factor) contact_factor = 0;
  for (const ScatteredChain* none : {&chain, &without}) {
    none->find(scatter, 0, 0, 0);
    for (int i = 0; i <= none->joints(); ++i) CHECK(scatter.variance(i, one) == 0);
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
    CHECK(are_close(both.variance(i, by_number), 4 * alone[0].variance(i, one), 1e-9));
  for (int i = 0; i < 3; ++i) CHECK(both.variance(first.joints() + 1 + i, by_number) == 0);
  for (int i = 0; i <= second.joints(); ++i)
    CHECK(are_close(both.variance(segment + i, by_number), 9 * alone[1].variance(i, one), 1e-9));
  both.clear();
  for (int i = 0; i < ChainCapacity::segments; ++i) CHECK(both.variance(i, by_number) == 0);
}
