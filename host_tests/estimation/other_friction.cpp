// Friction that nobody measures, and a jack that turned: which joint has slid back last depends on friction,
// so that a force is no straight line in it. Error bars against a closed form between rigid saddles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "estimation/jacked_chain.hpp"
#include "taut/estimation/turned_forces.hpp"

namespace other_friction_test {
using namespace estimation;

namespace {

/// Of all frictions within two standard deviations: how far their forces leave the error bars of the same
/// width at most, in standard deviations, beyond what the jack's readings leave open.
double farthest(const Jacked& jacked, const std::vector<Chain>& chains) {
  double worst = 0;
  for (const Chain& chain : chains)
    for (int i = 0; i < segments; ++i) {
      const double off = std::fabs(jacked[i].force - chain[i]) - 20 * jack_sd;
      worst = std::max(worst, off / jacked[i].deviation);
    }
  return worst;
}
std::vector<Chain> likely_chains() {
  std::vector<Chain> chains;
  for (double x = -2; x <= 2.001; x += 0.25) chains.emplace_back(mu + x * likely);
  return chains;
}
template <class Deed>
void each(std::vector<Chain>& chains, const Deed& deed) {
  for (Chain& chain : chains) deed(chain);
}

/// As far as all pull alike, and the estimator to lock-off.
void pull_and_lock(Jacked& jacked, std::vector<Chain>& chains, bool overstressed) {
  jacked.go(0, full, 60);
  jacked.go(full, full, 20);
  each(chains, [](Chain& chain) { chain.pull(full); });
  if (overstressed) {
    jacked.go(full, 0.92 * full, 8);
    jacked.go(0.92 * full, 0.92 * full, 20);
    each(chains, [](Chain& chain) { chain.pull(0.92 * full); });
  }
  jacked.lock();
}

}  // namespace

TEST_CASE(
    "after lock-off error bars hold the forces of every friction that is likely, wherever the last joint "
    "slid") {
  double longest = 0;
  for (const bool overstressed : {false, true})
    for (double seating = 1e-3; seating < 0.02; seating *= 1.15) {
      CAPTURE(overstressed);
      CAPTURE(seating);
      const auto jacked = std::make_unique<Jacked>(seating, Said{});
      auto chains = likely_chains();
      pull_and_lock(*jacked, chains, overstressed);
      each(chains, [&](Chain& chain) { chain.lock(seating); });
      // Where the jack came back before, the place where it locks is known to first order.
      CHECK(farthest(*jacked, chains) < (overstressed ? 5 : 2.2));
      // The structure is taken back by the jack: what slid back sticks at first.
      const double held = (*jacked)[segments - 1].force;
      for (const double part : {0.985, 1.0, 1.02}) {
        const double force = part * full;
        if (force < 1.02 * held) continue;
        jacked->go(force, force, 30);
        each(chains, [&](Chain& chain) { chain.pull(force); });
        CHECK(farthest(*jacked, chains) < 2.6);
      }
      for (int i = 0; i < segments; ++i) longest = std::max(longest, (*jacked)[i].deviation / full);
    }
  // They are no wider than friction makes them.
  CHECK(longest < 0.2);
}

TEST_CASE("behind a wedge that may be drawn in by half as much more, or less, error bars hold both") {
  double said = 0, needed = 0;
  for (const bool overstressed : {false, true})
    for (double seating = 1e-3; seating < 0.02; seating *= 1.15) {
      CAPTURE(overstressed);
      CAPTURE(seating);
      const double sd = seating / 2;
      const auto jacked = std::make_unique<Jacked>(seating, Said{1e-6, jack_sd, 0, 0, 0, 0.5});
      std::vector<Chain> chains;
      std::vector<double> drawn;
      for (double x = -2; x <= 2.001; x += 0.25) {
        chains.emplace_back(mu);
        drawn.push_back(std::max(seating + x * sd, 1e-9));
      }
      pull_and_lock(*jacked, chains, overstressed);
      for (std::size_t k = 0; k < chains.size(); ++k) chains[k].lock(drawn[k]);
      CHECK(farthest(*jacked, chains) < 2.6);
      for (int i = 0; i < segments; ++i) {
        double most = 0;
        for (const Chain& chain : chains) most = std::max(most, std::fabs((*jacked)[i].force - chain[i]));
        said += (*jacked)[i].deviation;
        needed += most / 2;
      }
    }
  // As a whole they are as wide as the draw-in makes them, and 1.23 times: the longer side counts.
  CHECK(said < 1.3 * needed);
}

TEST_CASE("what friction holds of turns within turns stays as uncertain as the loads were there") {
  constexpr double sd = 3e-3 * full;
  // Each turn lies within the one before, and some last for one row.
  const std::vector<double> stages = {0.3,  0.6,  0.9, 1,    1,    0.96, 0.9,  0.84, 0.84, 0.88, 0.93,
                                      0.95, 0.93, 0.9, 0.87, 0.86, 0.86, 0.88, 0.91, 0.92, 0.91, 0.9};
  Score score;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    support::Random random(seed);
    const auto jacked = std::make_unique<Jacked>(0, Said{1e-6, sd});
    Chain chain(mu);
    for (const double part : stages) {
      chain.pull(part * full);
      jacked->stage(part * full + sd * support::gaussian(random));
      add_to(score, *jacked, chain);
    }
  }
  MESSAGE("seeds from 1: ", 100 * score.share(), " % are held, rms ", score.rms(), ", worst ", score.worst);
  CHECK(score.held > 0.93 * score.count);
  CHECK(score.square < 1.2 * score.count);
}

TEST_CASE("behind a wedge error bars hold what joints have that are not alike, though the far end is known") {
  constexpr double scatter = 0.2;
  const auto scores =
      lock_off({0.2 * mu, 2e-3 * full, 2e-3 * full, scatter}, 30, [](support::Random& random) {
        const double common = mu * (1 + 0.2 * support::gaussian(random));
        std::vector<double> each;
        for (int j = 0; j + 1 < segments; ++j)
          each.push_back(common * std::max(0.1, 1 + scatter * support::gaussian(random)));
        return each;
      });
  for (const Score* score : {&scores.at_once, &scores.later, &scores.again}) {
    CHECK(score->share() > 0.92);
    CHECK(score->rms() < 1.15);
  }
}

TEST_CASE("a far end that is read behind a wedge teaches no more than a straight line in friction holds") {
  // Friction and the gain of the jack's cell are known together until then.
  constexpr double uncertain = 0.4;
  const auto scores =
      lock_off({uncertain * mu, 2e-3 * full, 2e-4 * full, 0, 0.05}, 60, [](support::Random& random) {
        return std::vector<double>(segments - 1,
                                   mu * std::max(0.1, 1 + uncertain * support::gaussian(random)));
      });
  for (const Score* score : {&scores.at_once, &scores.later, &scores.again}) CHECK(score->share() > 0.92);
  CHECK(scores.at_once.rms() < 1.15);
  CHECK(scores.later.rms() < 1.15);
  // Pulled again, some far ends are ten deviations off: friction off by 40 % is no straight line any more.
  CHECK(scores.again.rms() < 1.25);
}

TEST_CASE("a force since a turn is the lower of sticking and sliding if it fell, and the higher if it rose") {
  taut::TurnedForces<double, PlaneCapacity, 2> turned;
  turned.clear();
  // Before it has turned nothing is known of that.
  CHECK(turned.leader_of(0) < 0);
  turned.set_move(1, 1, 1);
  // Sticking at 100 it would have 10 less with a standard deviation of friction more, which is 0.1.
  turned.turn(0, 100, 0);
  turned.turn_with_friction(0, -100, 1, 0);
  CHECK(turned.leader_of(0) == 1);
  const auto deviation = [&](double force, double slides, double sd = 0.1) {
    return turned.deviation(0, force, slides, sd);
  };
  // It has fallen to 98 and hardly depends on friction: with two deviations more, it would have stuck at 80.
  CHECK(deviation(98, 1) == doctest::Approx(-9));
  // It has fallen to 70: it slides with any friction that is likely.
  CHECK(deviation(70, 30) == doctest::Approx(3));
  // It has risen to 104: with two deviations less, it would have stuck at 120.
  CHECK(deviation(104, 1) == doctest::Approx(-8));
  // It has not moved: what was known at the turn is known.
  CHECK(deviation(100, -100) == doctest::Approx(-10));
  // Once friction is known four times as well, so is what it makes of the force.
  CHECK(deviation(100, -100, 0.025) == doctest::Approx(-2.5));
  // What was found two deviations away counts if it is more.
  turned.find(0, 50);
  turned.find(0, -20);
  CHECK(deviation(70, 30) == doctest::Approx(5));
  CHECK(deviation(70, -80) == doctest::Approx(-8));
  // Of friction that is off by itself, too, it follows both: a kink two of those deviations away counts.
  turned.turn(0, 100, 0);
  turned.turn_with_friction(0, -100, 1, 0.03);
  CHECK(turned.of_friction(0, 0.1) == doctest::Approx(0.2));
  CHECK(deviation(80, 30) == doctest::Approx(-10));
  CHECK(deviation(40, 30) == doctest::Approx(6));
  turned.follow(0, 0.02);
  turned.follow(0, 0.08);
  CHECK(turned.of_friction(0, 0.1) == doctest::Approx(0.3));
}

}  // namespace other_friction_test
