// A single reading off the line of those before it: a load that begins to move, or a mistake.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>

#include "estimation/jacked_chain.hpp"
#include "estimation/read_jack.hpp"
#include "support/random.hpp"

namespace lone_readings_test {
namespace {

constexpr double noise = 100, held = 1e5;  // [N]

/// A ramp of twenty rows, and so many at rest.
class Held {
 public:
  Held(double step, int rows, support::Random& random) : step_(step) {
    for (int i = 1; i <= 20 + rows; ++i) CHECK_FALSE(tells(std::fmin(i, 20) * held / 20, random));
  }
  /// Whether the row tells an outlier.
  bool tells(double load, support::Random& random) { return tells(load + noise * support::gaussian(random)); }
  bool tells(double reading) { return read.tells(reading, step_); }

  estimation::Read read{noise};

 private:
  double step_;
};

}  // namespace

TEST_CASE("a single reading off a hold is not followed, nor does the load turn, and the next row tells") {
  int followed = 0, turned = 0, untold = 0, all = 0;
  for (const double step : {0.2, 1.0, 10.0, 60.0})
    for (const double off : {-30.0, -10.0, 10.0, 12.0, 30.0, 150.0})
      for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        CAPTURE(step);
        CAPTURE(off);
        CAPTURE(seed);
        support::Random random(seed);
        Held jack(step, 8 + static_cast<int>(seed), random);
        const double before = jack.read.followed();
        const bool had_turned = jack.read.has_turned();
        CHECK_FALSE(jack.tells(held + off * noise));
        followed += std::fabs(jack.read.followed() - before) > noise ? 1 : 0;
        untold += jack.tells(held, random) ? 0 : 1;
        for (int i = 0; i < 10; ++i) CHECK_FALSE(jack.tells(held, random));
        CHECK(std::fabs(jack.read.load() - held) < 4 * noise);
        turned += jack.read.has_turned() != had_turned || std::fabs(jack.read.followed() - held) > 5 * noise
                      ? 1
                      : 0;
        ++all;
      }
  MESSAGE("seeds from 1: of ", all, " followed ", followed, ", turned ", turned, ", not told ", untold);
  // Where the reading before is off by three deviations that way, two are the beginning of a ramp.
  CHECK(followed <= all / 50);
  CHECK(turned <= all / 100);
  CHECK(untold <= all / 25);
}

TEST_CASE("a load that begins to move is where it is read at once, and followed from the next row on") {
  for (const double way : {-1.0, 1.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(way);
      CAPTURE(seed);
      support::Random random(seed);
      Held jack(1, 30, random);
      double load = held;
      CHECK_FALSE(jack.tells(load += way * 8 * noise, random));
      CHECK(jack.read.at().alone);
      CHECK(std::fabs(jack.read.load() - load) < 4 * noise);
      for (int i = 0; i < 8; ++i) {
        CHECK_FALSE(jack.tells(load += way * 8 * noise, random));
        CHECK(jack.read.at().is_sure());
        CHECK(jack.read.has_turned() == (way < 0));
        CHECK(std::fabs(jack.read.followed() - load) < 11 * noise);
      }
    }
}

TEST_CASE("a peak of a single reading, from which the load comes half-way back, is a turn") {
  estimation::Read read(noise);
  for (int i = 0; i < 20; ++i) CHECK_FALSE(read.tells(held));
  CHECK_FALSE(read.tells(held + 12.5 * noise));
  REQUIRE(read.at().alone);
  CHECK_FALSE(read.tells(held + 7 * noise));
  CHECK(read.at().reversed);
  CHECK(read.at().reversal == doctest::Approx(held + 12.5 * noise).epsilon(0.002));
}

TEST_CASE("forces that friction holds are, after a single wrong reading, what they were in truth") {
  using estimation::Chain;
  using estimation::full;
  using estimation::jack_sd;
  using estimation::Jacked;
  using estimation::segments;
  for (const double off : {-12.0, -8.0, 8.0, 12.0, 100.0})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(off);
      CAPTURE(seed);
      support::Random random(seed);
      estimation::Said said;
      said.jack_sd = 200 * jack_sd;
      const auto jacked = std::make_unique<Jacked>(0, said);
      Chain chain(estimation::mu);
      const auto row = [&](double load, double error) {
        chain.pull(load);
        jacked->row(load + said.jack_sd * error, false, 1, -1);
      };
      for (int i = 1; i <= 60; ++i) row(full * std::fmin(i, 40) / 40, support::gaussian(random));
      const double before = (*jacked)[0].force;
      row(full, off);
      for (int i = 0; i < 10; ++i) row(full, support::gaussian(random));
      // The load is known to a fifth of its noise; a reading that is believed moves them by eight and more.
      CHECK(std::fabs((*jacked)[0].force - before) < said.jack_sd);
    }
}

TEST_CASE("however long a pause is, a load has turned nowhere that its cable cannot go") {
  for (const double pause : {3600.0, 36000.0, 1e6})
    for (const bool locks : {true, false}) {
      CAPTURE(pause);
      CAPTURE(locks);
      support::Random random(1);
      estimation::Read read(noise);
      for (int i = 1; i <= 40; ++i)
        static_cast<void>(read.tells(5000 * i + noise * support::gaussian(random), 0.1));
      static_cast<void>(read.tells(2e5 - 10 * noise, pause));
      double farthest = read.reversal();
      if (locks) {
        static_cast<void>(read.locks_after_turn(0.1));
        farthest = read.reversal();
      }
      for (int i = 1; i <= 10 && !locks; ++i) {
        static_cast<void>(read.tells(2e5 - 10 * noise - 1000 * i, 0.1));
        farthest = std::fmax(farthest, read.reversal());
      }
      // At commit 2e9fa1a 4.5e7 to 1.2e10 N: lock-off had no answer then.
      CHECK(farthest <= estimation::Read::most);
    }
}

}  // namespace lone_readings_test
