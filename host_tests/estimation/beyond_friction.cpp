// Forces that other loads have changed while friction was not known well: neighbours stay within what
// friction holds, or bars reach there.
#include "taut/estimation/beyond_friction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "estimation/score.hpp"

namespace beyond_friction_test {
using namespace estimation;

namespace {

struct Said {
  Score forces;
  int apart = 0;  ///< neighbours whose forces no friction that is likely holds apart so far, bars and all
};

/// How many neighbours are farther apart than their bars, and friction three deviations higher, allow.
template <class Estimator>
int count_apart(const Estimator& estimator, const Plane& scene,
                const taut::FrictionPrior<double, PlaneCapacity>& prior) {
  int apart = 0;
  for (int j = 0; j < scene.cables[0].joints(); ++j) {
    const auto before = estimator.estimate(j), after = estimator.estimate(j + 1);
    const double highest = estimator.mu(j) + 3 * estimator.mu_deviation(j),
                 rho = prior.limit(0, j, highest).rho,
                 gap = std::fmax(rho * after.force - before.force, rho * before.force - after.force);
    apart += gap > 1.001 * std::fmax(before.deviation, after.deviation) ? 1 : 0;
  }
  return apart;
}

Said jack_beside_a_roof() {
  Said said;
  static Ground ground;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    truss_of_unknown_mu(ground, 0.06, random);
    const auto site = std::make_unique<Site<double>>(ground, Instruments(), full, seed);
    taut::FrictionPrior<double, PlaneCapacity> prior;
    taut::find_friction_prior(ground.known, prior);
    Deed deed;
    const auto go = [&](double force, double factor, int rows) {
      go_on(deed, force, factor, rows, [&] {
        site->advance(deed);
        for (int s = 0; s < site->segments(); ++s) {
          const auto found = site->estimator().estimate(s);
          said.forces.add((found.force - site->true_force(s)) / found.deviation);
        }
        said.apart += count_apart(site->estimator(), ground.known, prior);
      });
      REQUIRE(site->good());
    };
    double load = 0, factor = 0;
    for (int move = 0; move < 6; ++move) {
      const bool rests = move % 2 == 1;
      if (rests)
        factor += random.between(-3, 3);
      else
        load = move < 4 ? load + random.between(0.15, 0.3) : load * random.between(0.7, 1.2);
      const int rows = random.coin() ? 1 : 12;
      go(load, factor, rows);
      go(load, factor, random.coin() ? 1 : 6);
    }
  }
  return said;
}

}  // namespace

TEST_CASE("bars reach to where friction can hold neighbouring forces apart, whatever other loads did") {
  const Said said = jack_beside_a_roof();
  MESSAGE("seeds 1 to 150: ", 100 * said.forces.share(), " % held, rms ", said.forces.rms(), ", worst ",
          said.forces.worst, "; apart ", said.apart);
  CHECK(said.forces.share() > 0.9);
  CHECK(said.apart == 0);
}

}  // namespace beyond_friction_test
