// The load behind a reading that has the friction of a ram, against a ram that is simulated.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "taut/estimation/jack_load.hpp"

namespace ram_test {
namespace {

using Load = taut::ConditionedLoad<double>;
using Cell = taut::LoadCell<double>;
using Jack = taut::JackLoad<double, 2>;

constexpr double huge = 1e12;

/// A ram whose pressure, in units of force, is given; its force follows.
class Ram {
 public:
  Ram(double up, double down) : up_(up), down_(down) {}
  /// The pressure is what the force needs to go up, or what it needs to go down, or in between.
  double press(double reading) {
    force_ = std::min(std::max(force_, reading / up_), reading / down_);
    return force_;
  }
  double force() const { return force_; }

 private:
  double up_, down_, force_ = 0;
};

Cell cell_of(double up, double down, double sd = 0) {
  Cell cell;
  cell.sd = sd;
  cell.up = up;
  cell.down = down;
  return cell;
}
/// Takes a reading, and returns what is known of the load then.
Load take(Jack& jack, const Cell& cell, double reading, bool* reverses = nullptr) {
  taut::EndReading<double> given;
  given.has_force = true;
  given.force = reading;
  taut::Corners<double> corners;
  const bool was_refused = jack.at.refused;
  const bool is_told = jack.take(false, given, 1, cell, huge, {}, corners);
  // An outlier is this one or the one before.
  if (is_told) CHECK((jack.at.refused || was_refused));
  CHECK(corners.reverses == jack.at.reversed);
  if (reverses != nullptr) *reverses = corners.reverses;
  return jack.at;
}
bool are_close(double a, double b, double allowed) { return std::fabs(a - b) <= allowed; }

/// A way of the pressure between 0 and `most` with turns anywhere, between the branches too.
template <class Visit>
void press_at_random(support::Random& random, double most, int pieces, const Visit& visit) {
  double reading = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double to = piece == 0 ? random.between(0.5, 1) * most
                      : random.coin()
                          ? random.between(0.05, 1) * most
                          : std::min(most, std::max(0.05 * most, reading * random.between(0.9, 1.1)));
    const int rows = 20 + random.below(60);
    const double from = reading;
    for (int i = 1; i <= rows; ++i) visit(reading = from + (to - from) * i / rows);
    if (random.coin())
      for (int i = 0; i < 30; ++i) visit(reading);
  }
}

}  // namespace

TEST_CASE("exact readings of a ram give back its force, wherever its pressure turns") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    const double up = random.between(1, 1.1), down = random.between(0.85, 1);
    Ram ram(up, down);
    const Cell cell = cell_of(up, down);
    REQUIRE(cell.has_branches());
    Jack jack;
    jack.start(cell);
    press_at_random(random, 1000, 20, [&](double reading) {
      const double force = ram.press(reading);
      const Load now = take(jack, cell, reading);
      REQUIRE(are_close(now.load, force, 1e-9));
      REQUIRE(are_close(now.confirmed, force, 1e-9));
      REQUIRE_FALSE(now.behind);
    });
  }
}

TEST_CASE("the force turns where it rests, however often the pressure turns meanwhile") {
  const double up = 1.05, down = 0.9;
  const Cell cell = cell_of(up, down);
  Jack jack;
  jack.start(cell);
  // Branches of a force of 1000 are 1050 and 900, of 800 are 840 and 720.
  struct Row {
    double reading, force, turn;
  };
  const double none = -1;
  const std::vector<Row> rows = {
      {525, 500, none},  {1050, 1000, none}, {1000, 1000, 1000}, {950, 1000, none}, {1020, 1000, 1000},
      {910, 1000, 1000}, {900, 1000, none},  {810, 900, none},   {720, 800, none},  {750, 800, 800},
      {839, 800, none},  {730, 800, 800},    {735, 800, 800},    {840, 800, none},  {1260, 1200, none}};
  for (const Row& row : rows) {
    CAPTURE(row.reading);
    bool reverses = false;
    const Load now = take(jack, cell, row.reading, &reverses);
    CHECK(are_close(now.load, row.force, 1e-9));
    CHECK(reverses == (row.turn != none));
    if (reverses) CHECK(are_close(now.reversal, row.turn, 1e-9));
  }
}

TEST_CASE(
    "noisy readings of a ram tell a force that moves as surely as they say, and as those of a plain cell") {
  // Root mean squares: of a force that moves, for both, and of one that rests between the branches.
  struct Tally {
    double square = 0;
    long held = 0, all = 0;
    void add(double error, double sd) {
      square += error * error;
      held += std::fabs(error) <= 1.96 * sd ? 1 : 0;
      ++all;
    }
    double rms() const { return std::sqrt(square / static_cast<double>(all)); }
    double share() const { return static_cast<double>(held) / static_cast<double>(all); }
  };
  Tally moves, plain_moves, rests;
  const double sd = 4;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    support::Random random(seed), noise(1000 + seed), noise_plain(2000 + seed);
    const double up = 1.04, down = 0.95;
    Ram ram(up, down);
    const Cell cell = cell_of(up, down, sd), plain = cell_of(1, 1, sd);
    REQUIRE_FALSE(plain.has_branches());
    Jack jack, of_plain;
    jack.start(cell);
    of_plain.start(plain);
    press_at_random(random, 1000, 10, [&](double reading) {
      const double before = ram.force(), force = ram.press(reading);
      const Load now = take(jack, cell, reading + sd * support::gaussian(noise)),
                 as_plain = take(of_plain, plain, force + sd * support::gaussian(noise_plain));
      if (force != before) {
        moves.add(now.load - force, now.sd);
        plain_moves.add(as_plain.load - force, as_plain.sd);
      } else if (reading < 0.999 * up * force && reading > 1.001 * down * force) {
        rests.add(now.load - force, now.sd);
      }
    });
  }
  CHECK(moves.all > 10000);
  CHECK(moves.share() > 0.93);
  CHECK(plain_moves.share() > 0.9);
  CHECK(moves.rms() < 1.05 * plain_moves.rms());
  // The branches are 23 standard deviations of a reading apart.
  CHECK(rests.all > 10000);
  CHECK(rests.rms() < 1.5 * sd);
}

TEST_CASE("what is known of a reading is known of the force on the branch: value, deviation, and turn") {
  const Cell cell = cell_of(1.25, 0.8);
  const auto reading_of = [](double load, double confirmed) {
    Load reading;
    reading.load = load;
    reading.confirmed = confirmed;
    reading.sd = 10;
    reading.behind = load < confirmed;
    return reading;
  };
  Jack jack;
  jack.start(cell);
  Load load = jack.behind_branches(reading_of(500, 450), cell);
  CHECK(load.load == doctest::Approx(400));
  CHECK(load.confirmed == doctest::Approx(360));
  CHECK(load.sd == doctest::Approx(8));
  CHECK(jack.pulls);
  // The pressure may have turned. The force rests as long as that of the other branch is above it: 360 is
  // confirmed, of which the other branch has 288.
  load = jack.behind_branches(reading_of(300, 450), cell);
  CHECK(load.load == doctest::Approx(360));
  CHECK(load.confirmed == doctest::Approx(360));
  CHECK_FALSE(load.behind);
  load = jack.behind_branches(reading_of(280, 450), cell);
  CHECK(load.load == doctest::Approx(350));
  CHECK(load.behind);
  // It has turned.
  Load turned = reading_of(240, 248);
  turned.behind = false;
  turned.reversed = true;
  turned.reversal = 450;
  load = jack.behind_branches(turned, cell);
  CHECK_FALSE(jack.pulls);
  CHECK(load.reversal == doctest::Approx(360));
  CHECK(jack.turned == doctest::Approx(360));
  CHECK(load.load == doctest::Approx(300));
  CHECK(load.confirmed == doctest::Approx(310));
  CHECK(load.sd == doctest::Approx(12.5));
  // Let out, and perhaps pulled again: 248 is confirmed, of which the upper branch has 387.5.
  Load again = reading_of(300, 248);
  again.behind = true;
  load = jack.behind_branches(again, cell);
  CHECK(load.load == doctest::Approx(310));
  CHECK_FALSE(load.behind);
  again.load = 400;
  load = jack.behind_branches(again, cell);
  CHECK(load.load == doctest::Approx(320));
  CHECK(load.behind);
}

TEST_CASE("for measurements a row has the raw reading on a branch, and what was known between the branches") {
  const double sd = 4, up = 1.25, down = 0.8;
  const Cell cell = cell_of(up, down, sd);
  Jack jack;
  jack.start(cell);
  support::Random random(1);
  for (int i = 1; i <= 100; ++i) {
    const double reading = up * 10 * i + sd * support::gaussian(random);
    take(jack, cell, reading);
    if (i < 10) continue;
    jack.driven.force = 7;
    CHECK(jack.raw == doctest::Approx(reading / up));
    CHECK(jack.reading(cell).beyond == doctest::Approx(reading / up - 7));
    // Its noise, which is not less on a branch than that of the reading by the larger one.
    CHECK(jack.reading(cell).variance > 0.99 * (sd / up) * (sd / up));
  }
  // The pressure is let out to the middle between the branches.
  const auto rest = [&] { return take(jack, cell, 1000 + sd * support::gaussian(random)); };
  for (int i = 0; i < 50; ++i) rest();
  for (int i = 0; i < 50; ++i) {
    const Load now = rest();
    CHECK_FALSE(jack.pulls);
    CHECK(now.load == jack.turned);
    CHECK(are_close(now.load, 1000, 3 * sd));
    CHECK(jack.reading(cell).beyond == now.load - 7);
    CHECK(jack.reading(cell).variance == now.sd * now.sd);
  }
}

TEST_CASE("a jack that is put back on a locked end is read on the upper branch") {
  const double up = 1.05, down = 0.9;
  const Cell cell = cell_of(up, down);
  Jack jack;
  jack.start(cell);
  for (const double force : {500.0, 1000.0}) take(jack, cell, up * force);
  // Let out before it is locked, so that the lower branch was the last.
  take(jack, cell, down * 800);
  CHECK_FALSE(jack.pulls);
  taut::Corners<double> corners;
  REQUIRE_FALSE(jack.take(true, {}, 1, cell, huge, {}, corners));
  CHECK(corners.locks);
  CHECK(jack.locked);
  taut::HeldByWedge<double> held;
  held.driven = held.load = 780;
  taut::EndReading<double> given;
  given.has_force = true;
  for (const double force : {850.0, 1100.0, 1200.0}) {
    given.force = up * force;
    corners = {};
    REQUIRE_FALSE(jack.take(false, given, 1, cell, huge, held, corners));
    CHECK_FALSE(jack.locked);
    CHECK(jack.pulls);
    CHECK_FALSE(corners.any());
    CHECK(are_close(jack.at.load, force, 1e-9));
    CHECK(are_close(jack.target(), force, 1e-9));
  }
}

TEST_CASE("the load that a ram pulls after its end was locked is that of its reading") {
  // Locked at a force of 1000, and jacked again: a lift-off at 1000, and on to 1100.
  for (const double up : {1.0, 1.05}) {
    CAPTURE(up);
    const double sd = 2;
    const Cell cell = cell_of(up, 0.95, sd);
    Jack jack;
    jack.start(cell);
    support::Random random(2);
    for (int i = 1; i <= 100; ++i) take(jack, cell, up * 10 * i + sd * support::gaussian(random));
    taut::Corners<double> corners;
    REQUIRE_FALSE(jack.take(true, {}, 1, cell, huge, {}, corners));
    CHECK(corners.locks);
    taut::HeldByWedge<double> held;
    held.driven = held.load = 1000;
    held.deviation = sd;
    for (int i = 0; i <= 100; ++i) {
      CAPTURE(i);
      taut::EndReading<double> given;
      given.has_force = true;
      given.force = up * (1000 + i) + sd * support::gaussian(random);
      corners = {};
      static_cast<void>(jack.take(false, given, 1, cell, huge, held, corners));
      CHECK(are_close(jack.at.load, 1000 + i, 4 * sd));
      CHECK(are_close(jack.at.confirmed, 1000 + i, 10 * sd));
      CHECK(jack.target() > 1000 - 4 * sd);
      CHECK_FALSE(corners.reverses);
    }
  }
}

TEST_CASE("the raw load on a branch has the noise of the reading by the branch") {
  for (const double up : {1.0, 1.05, 1.25}) {
    CAPTURE(up);
    const double sd = 4;
    const Cell cell = cell_of(up, 0.8, sd);
    Jack jack;
    jack.start(cell);
    support::Random random(1);
    for (int i = 1; i <= 100; ++i) take(jack, cell, up * 10 * i + sd * support::gaussian(random));
    CHECK(are_close(std::sqrt(jack.reading(cell).variance), jack.filter.sd() / up, 1e-9));
  }
}

}  // namespace ram_test
