// The scatter that NoiseLevel finds in readings against noise whose scatter is known.
#include "taut/estimation/noise_level.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "support/random.hpp"
#include "taut/estimation/jack_load.hpp"

namespace noise_level_test {
using taut::NoiseLevel;

namespace {

constexpr int seeds = 200;

/// What many levels say, each after its own noise.
struct Levels {
  double mean = 0, square_error = 0;
  double rms_error() const { return std::sqrt(square_error); }
};
/// Levels that were told `said`, after `count` readings that read(i, random) tells; they should find `truth`.
template <class Scalar, class Read>
Levels levels_after(int count, double dt, double said, double truth, Read read) {
  Levels levels;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    support::Random random(seed);
    NoiseLevel<Scalar> level;
    level.start(static_cast<Scalar>(said));
    for (int i = 0; i < count; ++i) level.take(static_cast<Scalar>(read(i, random)), static_cast<Scalar>(dt));
    const double found = static_cast<double>(level.sd());
    levels.mean += found / seeds;
    levels.square_error += (found - truth) * (found - truth) / seeds;
  }
  return levels;
}
/// A line of slope one, with this noise.
auto white(double sd) {
  return [sd](int i, support::Random& random) { return 100 + i + sd * support::gaussian(random); };
}

/// Noise of standard deviation one that is remembered for a second.
class Remembered {
 public:
  explicit Remembered(double dt) : kept_(std::exp(-dt)) {}
  double operator()(int i, support::Random& random) {
    const double fresh = support::gaussian(random);
    now_ = i == 0 ? fresh : kept_ * now_ + std::sqrt(1 - kept_ * kept_) * fresh;
    return now_;
  }
  /// Standard deviation of second differences of readings so many apart, over that of white noise of one.
  double scatter(int apart) const {
    const double a = std::pow(kept_, apart);
    return std::sqrt((3 - 4 * a + a * a) / 3);
  }
  /// Standard deviation of white noise whose means over a long time scatter as much.
  double as_white() const { return std::sqrt((1 + kept_) / (1 - kept_)); }

 private:
  double kept_, now_ = 0;
};

}  // namespace

TEST_CASE_TEMPLATE("white noise of more than what was said is found", Scalar, float, double) {
  for (const double truth : {2.0, 3.0})
    for (const double dt : {0.05, 0.5, 5.0})
      for (const int count : {400, 3000}) {
        CAPTURE(truth);
        CAPTURE(dt);
        CAPTURE(count);
        const Levels levels = levels_after<Scalar>(count, dt, 1, truth, white(truth));
        // Each to 12 %, and the larger of two of them; in the mean of all seeds much better.
        CHECK(std::fabs(levels.mean / truth - 1) < 0.1);
        CHECK(levels.rms_error() / truth < 0.2);
      }
}

TEST_CASE("what was said stands where it is right") {
  for (const double dt : {0.05, 0.5, 5.0})
    for (const int count : {10, 30, 100, 300, 1000, 3000}) {
      CAPTURE(dt);
      CAPTURE(count);
      const Levels levels = levels_after<double>(count, dt, 1, 1, white(1));
      CHECK(levels.mean >= 1);
      CHECK(levels.mean < 1.02);
    }
}

TEST_CASE("readings that scatter less than was said change nothing") {
  const Levels levels = levels_after<double>(1000, 0.5, 1, 1, white(0.3));
  CHECK(levels.square_error == 0);
}

TEST_CASE("a level that has settled is known to 12 %") {
  // Readings so close together that no mean of them is known yet.
  const Levels levels = levels_after<double>(240, 1e-3, 0.25, 1, white(1));
  CHECK(std::fabs(levels.mean - 1) < 0.06);
  CHECK(levels.rms_error() > 0.07);
  CHECK(levels.rms_error() < 0.13);
}

TEST_CASE("a ramp is no noise: to the last bit") {
  for (const double slope : {0.5, -64.0}) {
    CAPTURE(slope);
    NoiseLevel<double> held, ramped;
    held.start(0.25);
    ramped.start(0.25);
    support::Random random(1);
    for (int i = 0; i < 1000; ++i) {
      // In steps that a double holds even on top of the ramp, and in means of a power of two of readings.
      const double noise = std::round(1024 * support::gaussian(random)) / 1024;
      held.take(noise, 0.5);
      ramped.take(noise + slope * i, 0.5);
      REQUIRE(held.sd() == ramped.sd());
    }
    CHECK(held.sd() > 0.5);
  }
}

TEST_CASE("now and then a corner or an outlier changes nothing") {
  // Ramps and holds of 300 readings, and every 300th reading is wrong altogether.
  const auto load = [](int i) {
    const int whole = i / 600, rest = i % 600;
    return 2e4 * whole + (rest < 300 ? 2e4 * rest / 300.0 : 2e4);
  };
  for (const double truth : {1.0, 3.0}) {
    CAPTURE(truth);
    const Levels levels = levels_after<double>(3000, 0.5, 1, truth, [&](int i, support::Random& random) {
      const double wrong = i % 300 == 170 ? 1e4 : 0;
      return load(i) + wrong + truth * support::gaussian(random);
    });
    CHECK(levels.mean >= truth);
    CHECK(levels.mean < (truth > 1 ? 1.25 * truth : 1.02));
  }
}

TEST_CASE("noise that is remembered counts as white noise that averages out as slowly") {
  for (const double dt : {0.1, 0.2, 0.5}) {
    CAPTURE(dt);
    Remembered noise(dt);
    // What was said is what it scatters by.
    const Levels levels = levels_after<double>(static_cast<int>(1200 / dt), dt, 1, noise.as_white(), noise);
    CHECK(std::fabs(levels.mean / noise.as_white() - 1) < 0.2);
    CHECK(levels.rms_error() / noise.as_white() < 0.4);
  }
}

TEST_CASE("noise that is remembered is found within three seconds if what was said is all of it") {
  for (const double dt : {0.02, 0.05}) {
    CAPTURE(dt);
    const Levels levels = levels_after<double>(static_cast<int>(3 / dt), dt, 1, 0, Remembered(dt));
    // At most 5.2 counts: here 6.3 and 10 would be right. Before it is found it is one.
    CHECK(levels.mean > 3.1);
  }
}

TEST_CASE("noise that is remembered for very long counts at most ten times") {
  // A load that wanders: it would average out never.
  double at = 0;
  const Levels levels = levels_after<double>(3000, 0.02, 0.1, 1, [&](int i, support::Random& random) {
    at = i == 0 ? 0 : at + 0.1 * support::gaussian(random);
    return at;
  });
  // Second differences of a walk scatter as all its steps between the three do, those of white noise as six.
  const double of_distant = 0.1 * std::sqrt(2 * 50 / 6.0);
  CHECK(std::fabs(levels.mean / (std::pow(4.5, 1.5) * of_distant) - 1) < 0.1);
}

TEST_CASE("noise that alternates counts by its scatter, although it averages out at once") {
  // Differences of white noise: their second differences are third ones, 1 - 3 + 3 - 1.
  const double expected = std::sqrt((1 + 9 + 9 + 1) / 6.0);
  double last = 0;
  const Levels levels = levels_after<double>(1000, 0.5, 1, expected, [&](int, support::Random& random) {
    const double before = last;
    last = support::gaussian(random);
    return last - before;
  });
  CHECK(std::fabs(levels.mean / expected - 1) < 0.1);
}

TEST_CASE("a load that goes up and down lasts by its amplitude, whatever its period") {
  for (const double period : {6.0, 7.0, 9.0, 12.0, 16.0, 20.0})
    for (const double amplitude : {2.0, 5.0}) {
      CAPTURE(period);
      CAPTURE(amplitude);
      double mean = 0;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        support::Random random(seed);
        NoiseLevel<double> level;
        level.start(1);
        for (int i = 0; i < 400; ++i)
          level.take(1e3 + 5 * i + amplitude * std::sin(2 * support::pi * i / period + 0.1 * double(seed)) +
                         support::gaussian(random),
                     0.1);
        mean += level.lasting() / seeds;
      }
      CHECK(mean > 0.6 * amplitude);
      // Second differences reach four amplitudes, of which the larger of two is 0.85 in the median at most;
      // as if they were noise, times the root of two.
      CHECK(mean < 4 * 0.85 * 0.3882 * std::sqrt(2.0) * amplitude);
    }
}

TEST_CASE("what averages out does not last") {
  for (const double sd : {0.3, 1.0, 2.0}) {
    CAPTURE(sd);
    int lasts = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      support::Random random(seed);
      NoiseLevel<double> level;
      level.start(1);
      for (int i = 0; i < 1000; ++i, ++all) {
        level.take(white(sd)(i, random), 0.1);
        lasts += level.lasting() > 0 ? 1 : 0;
      }
    }
    // By chance, as what is asked for is three standard deviations of a median.
    CHECK(lasts < 0.05 * all);
  }
}

TEST_CASE("the error of a display lasts while it shows the same, and no longer") {
  const double step = 10, sd = step / std::sqrt(12.0);
  NoiseLevel<double> level;
  level.start(sd);
  support::Random random(3);
  const auto show = [&](double load) {
    level.take(step * std::round((load + 0.02 * step * support::gaussian(random)) / step), 0.2);
    return level.lasting();
  };
  // Three steps and a half a reading: rounding is as good as chance.
  for (int i = 0; i < 200; ++i) CHECK(show(3.57 * step * i) == 0);
  for (int i = 0; i < 15; ++i) show(714.3 * step);
  for (int i = 0; i < 100; ++i) CHECK(show(714.3 * step) >= sd);
  for (int i = 0; i < 15; ++i) show((714.3 - 3.57 * i) * step);
  for (int i = 15; i < 100; ++i) CHECK(show((714.3 - 3.57 * i) * step) == 0);
}

TEST_CASE("readings that cease to change are no noise that is remembered") {
  // A cell that freezes in a ramp, after as many readings as there may be.
  double largest = 0;
  for (const double dt : {0.05, 0.2, 1.0})
    for (const int before : {30, 90, 300})
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        support::Random random(seed);
        NoiseLevel<double> level;
        level.start(1);
        double reading = 0;
        for (int i = 0; i < before + 400; ++i) {
          if (i < before) reading = 100 + i + support::gaussian(random);
          level.take(reading, dt);
          if (i >= before) largest = std::fmax(largest, level.sd());
        }
      }
  CAPTURE(largest);
  // Ten times that is how far the force goes on before the cell is taken for dead.
  CHECK(largest < 1.6);
}

TEST_CASE("across steps in time that are not even nothing is compared") {
  for (const double longer : {1.2, 1.3}) {
    CAPTURE(longer);
    NoiseLevel<double> level;
    level.start(1);
    support::Random random(5);
    for (int i = 0; i < 2000; ++i) level.take(10 * support::gaussian(random), i % 2 == 0 ? 1 : longer);
    // A quarter is even enough.
    if (longer < 1.25)
      CHECK(level.sd() > 5);
    else
      CHECK(level.sd() == 1);
  }
}

TEST_CASE("a ramp stays no noise where its readings become rare, or pause") {
  NoiseLevel<double> held, ramped;
  held.start(0.25);
  ramped.start(0.25);
  support::Random random(2);
  double time = 0;
  for (int i = 0; i < 2000; ++i) {
    const double dt = i % 50 == 0 ? 16 : i < 1000 ? 0.5 : 2;
    time += dt;
    const double noise = std::round(1024 * support::gaussian(random)) / 1024;
    held.take(noise, dt);
    ramped.take(noise + 32 * time, dt);
    REQUIRE(held.sd() == ramped.sd());
  }
  CHECK(held.sd() > 0.5);
}

TEST_CASE("a level that comes and goes is larger than any before only once") {
  taut::NoiseLevel<double> noise;
  noise.start(10);
  CHECK(noise.rises_to(20) == 4);
  CHECK(noise.rises_to(10) == 1);
  CHECK(noise.rises_to(20) == 1);
  CHECK(noise.rises_to(30) == 2.25);
}

TEST_CASE("a path of short pieces is no noise: ramps and holds of thirty readings") {
  int wrong = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    support::Random random(seed);
    taut::LoadCell<double> cell;
    cell.sd = 500;
    taut::JackLoad<double, 2> jack;
    jack.start(cell);
    double load = 1e5;
    for (const double rate : {0.0, 1000.0, 0.0, 3000.0, 0.0, -3000.0, 0.0, 2000.0, 0.0})
      for (int i = 0; i < 30; ++i) {
        load += rate;
        taut::EndReading<double> given;
        given.has_force = true;
        given.force = load + cell.sd * support::gaussian(random);
        taut::Corners<double> corners;
        static_cast<void>(jack.take(false, given, 1, cell, 1e7, {}, corners));
        wrong += jack.noise.sd() > 1.5 * cell.sd ? 1 : 0;
        ++all;
      }
  }
  // A few readings in a row are off by chance.
  CHECK(wrong < 0.01 * all);
}

TEST_CASE("the steps of a display are no memory: the load stays near what is shown, however often it turns") {
  const double step = 1000, noise = 20;
  taut::LoadCell<double> cell;
  cell.sd = std::sqrt(step * step / 12 + noise * noise);
  double farthest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    taut::JackLoad<double, 2> jack;
    jack.start(cell);
    double from = 0;
    for (int leg = 0; leg < 12; ++leg) {
      const double part = random.between(0, 1), to = leg % 2 == 1 ? 2e4 + 1e4 * part : 3.5e4 + 1.5e4 * part;
      const int moves = 20 + random.below(40), holds = 10 + random.below(40);
      for (int i = 1; i <= moves + holds; ++i) {
        const double load = i < moves ? from + (to - from) * i / moves : to;
        taut::EndReading<double> given;
        given.has_force = true;
        given.force = step * std::round((load + noise * support::gaussian(random)) / step);
        taut::Corners<double> corners;
        static_cast<void>(jack.take(false, given, 1, cell, 1e7, {}, corners));
        if (!jack.at.refused) farthest = std::fmax(farthest, std::fabs(jack.at.load - given.force) / step);
      }
      from = to;
    }
  }
  // Where r was asked of readings most of whose neighbours stood on one step, 7.4.
  MESSAGE("at most " << farthest << " steps from what is shown");
  CHECK(farthest < 3.5);
}

}  // namespace noise_level_test
