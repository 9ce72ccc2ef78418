// A logger that reads its channels in turn: each row has the jack's load or that of the far end. While the
// load goes on, what the far end says of friction shows with the next reading of the jack.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "estimation/jacked_chain.hpp"

namespace cells_in_turn_test {
using namespace estimation;

namespace {

struct Ramps {
  Score score;
  double square = 0;  ///< of errors beside the load
  int count = 0;
  double error() const { return std::sqrt(square / count); }
};

/// Ramps of a chain whose friction is known to 30 %. `load(i)` is the part of the full load by row `i`;
/// forces count from the tenth row on, in rows in which the jack is read.
template <class Load>
Ramps ramps_in_turn(int rows, const Load& load) {
  const double never = std::numeric_limits<double>::quiet_NaN();
  Said said;
  said.mu_sd = likely;
  said.jack_sd = said.far_sd = 2e-3 * full;
  Ramps ramps;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    support::Random random(seed);
    const auto jacked = std::make_unique<Jacked>(0, said);
    Chain chain(mu * std::max(0.1, 1 + likely / mu * support::gaussian(random)));
    for (int i = 1; i <= rows; ++i) {
      const double force = full * load(i);
      chain.pull(force);
      const bool is_jack = i % 2 == 0;
      const double jack = force + said.jack_sd * support::gaussian(random),
                   far = chain[0] + said.far_sd * support::gaussian(random);
      jacked->row(is_jack ? jack : never, false, 1, is_jack ? -1 : std::max(far, 0.0));
      if (i < rows / 2 || !is_jack) continue;
      add_to(ramps.score, *jacked, chain);
      for (int s = 0; s + 1 < segments; ++s, ++ramps.count) {
        const double off = ((*jacked)[s].force - chain[s]) / force;
        ramps.square += off * off;
      }
    }
  }
  MESSAGE("seeds 1 to 200: ", 100 * ramps.score.share(), " % are held, rms ", ramps.score.rms(), ", errors ",
          100 * ramps.error(), " % of the load");
  return ramps;
}

/// A jack that rests and then has 40 % of its load within three of its readings, 3 s apart, as it is shown;
/// whether the cable has that load, too. Each reading of the far end comes so long after one of the jack.
/// Returns how far its last segment is off at most from the third of these readings on, as a
/// part of the full load.
double jump_in_turn(std::uint64_t seed, double after, bool is_pulled) {
  const double never = std::numeric_limits<double>::quiet_NaN();
  Said said;
  said.mu_sd = likely;
  said.jack_sd = said.far_sd = 2e-3 * full;
  support::Random random(seed);
  const auto jacked = std::make_unique<Jacked>(0, said);
  Chain chain(mu * std::max(0.1, 1 + likely / mu * support::gaussian(random)));
  const auto noise = [&] { return said.jack_sd * support::gaussian(random); };
  const auto load = [](double rows) { return full * std::clamp(0.2 * (rows - 12), 0.0, 0.4); };
  double off = 0;
  for (int i = 0; i < 20; ++i) {
    if (is_pulled) chain.pull(load(i));
    jacked->row(load(i) + noise(), false, 3 - after, -1);
    if (i >= 15) off = std::max(off, std::fabs((*jacked)[segments - 1].force - chain[segments - 1]) / full);
    if (is_pulled) chain.pull(load(i + after / 3));
    jacked->row(never, false, after, std::max(0.0, chain[0] + noise()));
  }
  return off;
}

}  // namespace

TEST_CASE(
    "a load that comes at once is believed if the far end, read in turn, has seen it, and no other one") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    for (const double after : {0.3, 1.5, 2.9}) {
      CAPTURE(seed);
      CAPTURE(after);
      CHECK(jump_in_turn(seed, after, true) < 0.03);
      CHECK(jump_in_turn(seed, after, false) < 0.03);
    }
}

TEST_CASE("a far end that is read between readings of its jack teaches friction on the way up") {
  const Ramps ramps = ramps_in_turn(120, [](int i) { return i / 120.0; });
  CHECK(ramps.score.share() > 0.93);
  CHECK(ramps.error() < 0.005);
}

// (The load itself is off in rows after each stroke, as it is where all is read in all rows.)
TEST_CASE("it does where the load goes up in strokes of a pump, with rests between them") {
  const Ramps ramps = ramps_in_turn(200, [](int i) { return (i / 5 * 5 + std::min(i % 5, 2) * 2.5) / 200; });
  CHECK(ramps.error() < 0.01);
}

}  // namespace cells_in_turn_test
