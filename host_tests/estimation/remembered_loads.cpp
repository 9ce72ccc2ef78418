// What friction holds back came to rest at a load that was not known exactly: what its error is known by
// later, from a far end that is read while the cable sticks, and from the load itself.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/jacked_chain.hpp"
#include "estimation/ramp.hpp"

namespace remembered_loads_test {
using namespace estimation;

namespace {

struct Held {
  Score before, after;                       ///< a while of sticking
  double error_before = 0, error_after = 0;  ///< sums of squares [N^2]
  std::vector<double> narrower;              ///< bars after the hold by those before
  double median() {
    std::nth_element(narrower.begin(), narrower.begin() + static_cast<std::ptrdiff_t>(narrower.size() / 2),
                     narrower.end());
    return narrower[narrower.size() / 2];
  }
};

/// A ramp of few rows that turns at once, and a hold: the forces at the far end, where nothing slides any
/// more, before the hold and after it. read(force) is what the cell there shows.
template <class Read>
Held hold_after_turn(const Said& said, const Read& read) {
  Held held;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    support::Random random(seed);
    const auto jacked = std::make_unique<Jacked>(0, said);
    Chain chain(mu * std::max(0.1, 1 + said.mu_sd / mu * support::gaussian(random)));
    double at = 0;
    const auto go = [&](double to, int rows) {
      for (int i = 1; i <= rows; ++i) {
        const double force = at + (to - at) * i / rows;
        chain.pull(force);
        jacked->row(force + said.jack_sd * support::gaussian(random), false, 1, read(chain[0], random));
      }
      at = to;
    };
    const auto add = [&](Score& score, double& error) {
      for (int i = 0; i < 3; ++i) {
        const double off = (*jacked)[i].force - chain[i];
        score.add(off / (*jacked)[i].deviation);
        error += off * off;
      }
      return (*jacked)[0].deviation;
    };
    go(full * random.between(0.9, 1), 16);
    go(at * 0.92, 4);
    const double before = add(held.before, held.error_before);
    go(at, 100);
    held.narrower.push_back(add(held.after, held.error_after) / before);
  }
  MESSAGE("seeds 1 to 200: ", 100 * held.before.share(), " %, after the hold ", 100 * held.after.share(),
          " % are held, errors ", std::sqrt(held.error_after / held.error_before), ", bars ", held.median(),
          " times those before");
  return held;
}

/// The same with a load cell that scatters, and friction known to `mu_sd`.
Held hold_beside_cell(double mu_sd) {
  Said said;
  said.mu_sd = mu_sd;
  said.jack_sd = 5e-3 * full;
  said.far_sd = 1e-3 * full;
  return hold_after_turn(said, [&](double force, support::Random& random) {
    return force + said.far_sd * support::gaussian(random);
  });
}

}  // namespace

TEST_CASE("a far end that is read while the cable sticks tells of the load at which it came to rest") {
  Held held = hold_beside_cell(1e-6);
  CHECK(held.before.share() > 0.93);
  CHECK(held.after.share() > 0.93);
  CHECK(held.after.rms() > 0.7);
  CHECK(held.error_after < 0.25 * held.error_before);
  CHECK(held.median() < 0.25);
}

TEST_CASE("with friction that is not known either, bars hold what a far end has corrected") {
  Held held = hold_beside_cell(likely);
  CHECK(held.before.share() > 0.92);
  CHECK(held.after.share() > 0.93);
  CHECK(held.error_after < held.error_before);
}

TEST_CASE("the same number on a display again and again says once what it says") {
  Said said;
  said.mu_sd = 1e-6;
  said.jack_sd = 5e-3 * full;
  const double step = 0.01 * full;
  said.far_sd = step / std::sqrt(12);
  const Held held =
      hold_after_turn(said, [&](double force, support::Random&) { return step * std::round(force / step); });
  CHECK(held.after.share() > 0.93);
  CHECK(held.after.rms() < 1.1);
}

TEST_CASE("once a hold shows where a ramp has ended, bars are those of the hold though other loads change") {
  static Ground ground;
  Instruments instruments;
  instruments.has_cell = false;
  Score score;
  double square = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    // Friction is known, but for what makes an estimator of it.
    truss_of_unknown_mu(ground, 1e-4, random);
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
    Deed deed;
    const auto go = [&](double force, double factor, int rows) {
      go_on(deed, force, factor, rows, [&] { site->advance(deed); });
      REQUIRE(site->good());
    };
    // In the very row in which the ramp is over the other load begins to change.
    go(1, 0, 12);
    go(1, random.between(-0.5, 0.5), 60);
    for (int i = 0; i + 1 < site->segments(); ++i) {
      const double deviation = site->estimator().deviation(i);
      square += deviation * deviation;
      score.add(site->error(i) / deviation);
    }
  }
  const double bar = std::sqrt(square / score.count) / full;
  MESSAGE("seeds 1 to 200: bars of ", bar, " of the load, ", 100 * score.share(), " % are held");
  // A row of the ramp is a twelfth.
  CHECK(bar < 0.01);
  CHECK(score.share() > 0.93);
}

}  // namespace remembered_loads_test
