// A jack's load cell that keeps one value: where that is found, and where it is not.
#include "taut/estimation/standing_cell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/jacked_chain.hpp"
#include "support/random.hpp"
#include "taut/estimation/jack_load.hpp"

namespace standing_cell_test {
namespace {

constexpr double full = 1e5;
// Times in a jacking [s]: a ramp to a fifth, a hold, a ramp to the end, a hold.
constexpr double rested = 20, begun = 20 + rested, come = begun + 80, ended = come + 40;

double load_at(double time) {
  if (time < 20) return 0.2 * full * time / 20;
  if (time < begun) return 0.2 * full;
  if (time < come) return full * (0.2 + 0.8 * (time - begun) / (come - begun));
  return full;
}

struct Cell {
  double noise = 200, step = 0;       // [N]
  double freezes = 1e9, thaws = 1e9;  // [s]
};

struct Found {
  int frozen = 0, first = -1;  // rows
  double meanwhile = 0;        // error / deviation of the load
  double after = 0;            // and from the second row on after it came back, in the ramp
};

/// One jacking that is read `rate` times a second.
Found jack(const Cell& cell, double rate, std::uint64_t seed) {
  support::Random random(seed);
  taut::LoadCell<double> known;
  known.sd = std::fmax(cell.noise, cell.step / 3);
  taut::JackLoad<double, 2> jack;
  jack.start(known);
  Found found;
  double shown = 0;
  for (int row = 1; row <= ended * rate; ++row) {
    const double time = row / rate, load = load_at(time);
    const double noise = cell.noise * support::gaussian(random);
    const bool is_frozen = time >= cell.freezes && time < cell.thaws;
    if (!is_frozen) shown = load + noise;
    taut::EndReading<double> given;
    given.has_force = true;
    given.force = cell.step > 0 ? cell.step * std::round(shown / cell.step) : shown;
    taut::Corners<double> corners;
    static_cast<void>(jack.take(false, given, 1 / rate, known, 1e7, {}, corners));
    const double off = std::fabs(jack.at.load - load) / jack.at.sd;
    if (jack.standing.is_frozen()) {
      if (found.first < 0) found.first = row;
      ++found.frozen;
      found.meanwhile = std::fmax(found.meanwhile, off);
    } else if (time > cell.thaws + 1.5 / rate && time < come) {
      found.after = std::fmax(found.after, off);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("a cell that had noise at rest and keeps one value is found after twelve readings") {
  for (const double rate : {1.0, 5.0, 20.0}) {
    CAPTURE(rate);
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      CAPTURE(seed);
      Cell cell;
      cell.freezes = begun + 10;
      cell.thaws = begun + 50;
      const Found each = jack(cell, rate, seed);
      if (each.frozen == 0) continue;
      ++found;
      // The first of the twelve is the last one before it froze.
      CHECK(each.first <= cell.freezes * rate + 12);
      CHECK(each.frozen >= 40 * rate - 13);
      CHECK(each.meanwhile < 4);
      CHECK(each.after < 6);
    }
    // Twenty readings at rest are few.
    CHECK(found >= (rate > 1 ? 50 : 25));
  }
}

TEST_CASE(
    "a cell that lives is never found frozen: with noise, steps of any size, and where its noise ends") {
  for (const double rate : {1.0, 5.0, 20.0})
    for (const double step : {0.0, 20.0, 100.0, 200.0, 400.0, 1000.0, 5000.0})
      for (const double noise : {0.0, 20.0, 200.0}) {
        if (step == 0 && noise == 0) continue;
        CAPTURE(rate);
        CAPTURE(step);
        CAPTURE(noise);
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
          CAPTURE(seed);
          Cell cell;
          cell.step = step;
          cell.noise = noise;
          CHECK(jack(cell, rate, seed).frozen == 0);
        }
      }
  // The pump shakes the gauge in ramps, and its display stands still in every hold: nothing was seen at rest.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    taut::StandingCell<double> standing;
    support::Random random(seed);
    int frozen = 0;
    for (int stage = 1; stage <= 10; ++stage) {
      for (int i = 0; i < 30; ++i)
        frozen += standing.take(1e4 * stage + 300 * i + 500 * support::gaussian(random), 1, false) ? 1 : 0;
      for (int i = 0; i < 60; ++i) frozen += standing.take(1e4 * (stage + 1), 1, true) ? 1 : 0;
    }
    CHECK(frozen == 0);
  }
}

TEST_CASE("readings of nobody who has seen noise are no sign") {
  taut::StandingCell<float> standing;
  for (int i = 0; i < 1000; ++i) CHECK_FALSE(standing.take(0, 1, true));
}

TEST_CASE("a jack's cell that stands still in a ramp, without any rest before, is told by the far end") {
  for (const int rows : {3, 25})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(rows);
      CAPTURE(seed);
      support::Random random(seed);
      estimation::Said said;
      said.jack_sd = said.far_sd = 1e-3 * estimation::full;
      const auto jacked = std::make_unique<estimation::Jacked>(4e-3, said);
      estimation::Chain chain(estimation::mu);
      const auto noise = [&] { return said.jack_sd * support::gaussian(random); };
      double shown = 0;
      bool is_told = false;
      estimation::Score score;
      for (int i = 1; i <= 60; ++i) {
        chain.pull(estimation::full * i / 60);
        if (i < 20 || i >= 20 + rows) shown = estimation::full * i / 60 + noise();
        jacked->row(shown, false, 1, chain[0] + noise());
        is_told |= jacked->raises(taut::Alarm::Kind::frozen);
        // Of a row that may be one in which the load rests bars do not know yet.
        if (i > 20) add_to(score, *jacked, chain);
      }
      CHECK(score.worst < 5);
      CHECK(is_told == (rows > 10));
    }
}

}  // namespace standing_cell_test
