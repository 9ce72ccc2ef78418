// Instruments behind a low-pass filter: what stood in front of it, and forces that come from there.
#include "taut/estimation/lagging_reading.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/jacked_chain.hpp"

namespace lagging_reading_test {
using namespace estimation;

namespace {

/// What a filter shows of a force that goes from one value to the next in even lines, a line every `dt`: its
/// differential equation in small steps (Runge and Kutta), which knows nothing of exponentials.
class Filter {
 public:
  explicit Filter(double lag, double shown = 0) : lag_(lag), shown_(shown), force_(shown) {}
  double go_on(double force, double dt) {
    constexpr int steps = 400;
    const double h = dt / steps, from = force_;
    for (int i = 0; i < steps; ++i) {
      const auto rate = [&](double t, double y) { return (from + (force - from) * t / dt - y) / lag_; };
      const double t = i * h, a = rate(t, shown_), b = rate(t + h / 2, shown_ + h / 2 * a),
                   c = rate(t + h / 2, shown_ + h / 2 * b), d = rate(t + h, shown_ + h * c);
      shown_ += h / 6 * (a + 2 * b + 2 * c + d);
    }
    force_ = force;
    return shown_;
  }

 private:
  double lag_, shown_, force_;
};

/// What is made of a reading that counts; a next one `dt` later.
double undone(taut::LaggingReading<double>& reading, double lag, double shown, double dt) {
  reading.wait(dt);
  REQUIRE(reading.undo(lag, shown));
  return shown;
}

}  // namespace

TEST_CASE(
    "in a ramp the force is that of an eighth of a lag before, or of at most a lag where rows are slow") {
  for (const double lag : {0.1, 1.0, 7.0})
    for (const double pace : {0.25, 0.6, 1.0, 2.0, 5.0}) {
      CAPTURE(lag);
      CAPTURE(pace);
      const double dt = pace * lag;
      Filter filter(lag, 50);
      taut::LaggingReading<double> reading;
      CHECK(undone(reading, lag, filter.go_on(50, dt), dt) == doctest::Approx(50));
      // The mean age of what the filter has weighed: of weights that fade, by the trapezoidal rule.
      double age = 0, sum = 0;
      for (int i = 0; i <= 4000; ++i) {
        const double t = dt * i / 4000, weight = (i % 4000 == 0 ? 0.5 : 1) * std::exp(-t / lag);
        age += weight * t;
        sum += weight;
      }
      age /= sum;
      CHECK(age < (pace == 0.25 ? 0.125 : 1.0) * lag);
      double shown = 50;
      for (int i = 1; i <= 20; ++i) {
        shown = filter.go_on(50 + 100 * i, dt);
        CHECK(undone(reading, lag, shown, dt) == doctest::Approx(50 + 100 * (i - age / dt)).epsilon(1e-5));
        CHECK(reading.late() == doctest::Approx(age).epsilon(1e-5));
      }
      // What is read is late by a lag.
      CHECK(shown == doctest::Approx(50 + 100 * (20 - 1 / pace)).epsilon(0.02));
    }
}

TEST_CASE("a force is never found beyond where it was since the reading before, whatever way it went") {
  support::Random random(20261129);
  for (int i = 0; i < 300; ++i) {
    const double lag = std::pow(10, random.between(-1, 1)), dt = lag * std::pow(10, random.between(-0.6, 1)),
                 start = random.between(0, 100);
    Filter filter(lag, start);
    taut::LaggingReading<double> reading;
    undone(reading, lag, filter.go_on(start, dt), dt);
    double force = start;
    for (int row = 0; row < 20; ++row) {
      double least = force, most = force, shown = 0;
      const int parts = 1 + random.below(4);
      for (int part = 0; part < parts; ++part) {
        if (random.coin()) force = random.between(0, 100);
        least = std::min(least, force);
        most = std::max(most, force);
        shown = filter.go_on(force, dt / parts);
      }
      const double found = undone(reading, lag, shown, dt);
      CHECK(found >= least - 1e-3);
      CHECK(found <= most + 1e-3);
    }
  }
}

TEST_CASE("a force that rests is found with the first reading whose stride it has rested in") {
  constexpr double lag = 1;
  for (const double dt : {0.25, 1.0, 3.0, 20.0}) {
    CAPTURE(dt);
    Filter filter(lag);
    taut::LaggingReading<double> reading;
    undone(reading, lag, filter.go_on(0, dt), dt);
    for (int i = 1; i <= 5; ++i) undone(reading, lag, filter.go_on(10 * i, dt), dt);
    for (int i = 0; i < 5; ++i)
      CHECK(undone(reading, lag, filter.go_on(50, dt), dt) == doctest::Approx(50).epsilon(1e-6));
  }
}

TEST_CASE("load stages are left as they are read") {
  constexpr double lag = 1;
  taut::LaggingReading<double> reading;
  for (int stage = 1; stage <= 5; ++stage)
    CHECK(undone(reading, lag, 1000.0 * stage, 60) == doctest::Approx(1000.0 * stage));
}

TEST_CASE("of readings that come close those count that are a quarter of a lag apart, with the same forces") {
  constexpr double lag = 1, dt = 0.05;
  taut::LaggingReading<double> all, few;
  support::Random random(20261129);
  double shown = 0;
  int counted = 0;
  for (int i = 0; i < 200; ++i) {
    shown += random.between(0, 3);
    double by_all = shown, by_few = shown;
    all.wait(dt);
    few.wait(dt);
    const bool counts = all.undo(lag, by_all);
    if (!counts) continue;
    ++counted;
    REQUIRE(few.undo(lag, by_few));
    CHECK(by_all == by_few);
  }
  CHECK(counted == 40);
}

TEST_CASE("a display that shows a mean is taken for a filter of half its time: a turn is found to a tenth") {
  // The integral of a force that goes up to 10 in 10 s, and down half as fast for 5 s.
  const auto integral = [](double t) {
    const double up = std::min(std::max(t, 0.0), 10.0), down = std::min(std::max(t - 10, 0.0), 5.0),
                 rest = std::max(t - 15, 0.0);
    return up * up / 2 + 10 * down - down * down / 4 + 7.5 * rest;
  };
  constexpr double mean_of = 1;
  for (const double dt : {0.02, 0.125, 0.25, 0.5}) {
    CAPTURE(dt);
    taut::LaggingReading<double> reading;
    double most_shown = 0, most = 0, last = 0;
    for (int i = 1; i * dt < 25; ++i) {
      double force = (integral(i * dt) - integral(i * dt - mean_of)) / mean_of;
      most_shown = std::max(most_shown, force);
      reading.wait(dt);
      if (reading.undo(mean_of / 2, force)) most = std::max(most, force);
      last = force;
    }
    CHECK(most_shown < 9.85);
    CHECK(std::fabs(most - 10) < 0.1);
    CHECK(last == doctest::Approx(7.5));
  }
}

TEST_CASE("a reading that is given again in its row is the same force") {
  taut::LaggingReading<double> reading;
  for (const double shown : {10.0, 15.0, 22.0}) {
    const double found = undone(reading, 1, shown, 0.5);
    CHECK(undone(reading, 1, shown, 0) == found);
  }
}

namespace {

struct Filtered {
  Score pulled, let_out, rests;
  double square = 0;  ///< of errors, part of the full load
  int count = 0;
  double error() const { return std::sqrt(square / count); }
};

/// Ramps that turn at once, are let out and rest, with cells behind filters of a second, ten rows a second:
/// friction keeps what the load was at the turn. `lag` is what is said.
Filtered jack_behind_filter(double lag, bool reloads = false) {
  constexpr double dt = 0.1, second = 1;
  Said said;
  said.mu_sd = likely;
  said.jack_sd = said.far_sd = 2e-3 * full;
  said.lag = lag;
  Filtered found;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    support::Random random(seed);
    const auto jacked = std::make_unique<Jacked>(0, said);
    Chain chain(mu * std::max(0.1, 1 + likely / mu * support::gaussian(random)));
    Filter jack(second), far(second);
    double load = 0;
    const auto go = [&](double to, int rows, Score& score) {
      const double from = load;
      for (int i = 1; i <= rows; ++i) {
        load = from + (to - from) * i / rows;
        chain.pull(load);
        const double noise = said.jack_sd * support::gaussian(random),
                     far_noise = said.far_sd * support::gaussian(random);
        const double read_far = far.go_on(chain[0], dt) + far_noise;
        jacked->row(jack.go_on(load, dt) + noise, false, dt, std::max(read_far, 0.0));
        if (reloads && i % 7 == 0) jacked->reload();
        if (2 * i < rows) continue;
        add_to(score, *jacked, chain);
        for (int s = 0; s < segments; ++s, ++found.count)
          found.square += std::pow(((*jacked)[s].force - chain[s]) / full, 2);
      }
    };
    go(full, 400, found.pulled);
    go(0.8 * full, 40, found.let_out);
    go(0.8 * full, 60, found.rests);
  }
  MESSAGE("seeds 1 to 40, lag ", lag, " s: ", 100 * found.pulled.share(), " % are held on the way up, ",
          100 * found.let_out.share(), " % on the way down, ", 100 * found.rests.share(),
          " % at rest; errors ", 100 * found.error(), " % of the load");
  return found;
}

}  // namespace

TEST_CASE("forces are right behind filters, in ramps and after turns, if their lag is said") {
  const Filtered said = jack_behind_filter(1), unsaid = jack_behind_filter(0);
  CHECK(said.pulled.share() > 0.93);
  CHECK(said.let_out.share() > 0.93);
  CHECK(said.rests.share() > 0.93);
  CHECK(said.error() < 0.01);
  // Or else it is the lie of an instrument.
  CHECK(unsaid.pulled.share() < 0.5);
  CHECK(unsaid.error() > 2 * said.error());
}

TEST_CASE("what is known of a filter is saved with all else: the same forces after a power failure") {
  CHECK(jack_behind_filter(1).error() == jack_behind_filter(1, true).error());
}

}  // namespace lagging_reading_test
