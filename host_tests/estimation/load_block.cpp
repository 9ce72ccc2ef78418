// Readings that wait against the same readings one by one.
#include "taut/estimation/load_block.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/random.hpp"

namespace load_block_test {
using taut::LineState;
using Block = taut::LoadBlock<double, double, 16>;

namespace {

struct Reading {
  double step, level;
};
std::vector<Reading> random_readings(support::Random& random) {
  std::vector<Reading> readings;
  const int count = 1 + random.below(Block::capacity);
  for (int i = 0; i < count; ++i) readings.push_back({random.between(0.5, 2), support::gaussian(random)});
  return readings;
}
/// A line like the ones of a filter: fitted to some readings, its covariance positive definite.
LineState<double> random_line(support::Random& random, double slope_sd) {
  const double level_sd = random.between(0.05, 0.5), correlation = random.between(0, 0.9);
  return {support::gaussian(random), 0.1 * support::gaussian(random), level_sd * level_sd,
          correlation * level_sd * slope_sd, slope_sd * slope_sd};
}
/// Recursive least squares from nothing: variances of a straight line through `age` readings.
LineState<double> fitted_to(int age) {
  const double n = age;
  return {0, 0, 2 * (2 * n - 1) / (n * (n + 1)), 6 / (n * (n + 1)), 12 / (n * (n * n - 1))};
}
void advance(LineState<double>& line, double dt) {
  line.level += dt * line.slope;
  line.level_variance += dt * (2 * line.covariance + dt * line.slope_variance);
  line.covariance += dt * line.slope_variance;
}
/// Variances after a reading with this variance, with any gains (Joseph's form).
void take(LineState<double>& line, double level_gain, double slope_gain, double noise) {
  const double P = line.level_variance, C = line.covariance, left = 1 - level_gain;
  line.slope_variance += slope_gain * (slope_gain * (P + noise) - 2 * C);
  line.covariance = left * (C - slope_gain * P) + level_gain * slope_gain * noise;
  line.level_variance = left * left * P + level_gain * level_gain * noise;
}
/// The same with the best gains, which take the reading `y`.
void take(LineState<double>& line, double y, double noise) {
  const double S = line.level_variance + noise, r = y - line.level;
  const double level_gain = line.level_variance / S, slope_gain = line.covariance / S;
  line.level += level_gain * r;
  line.slope += slope_gain * r;
  take(line, level_gain, slope_gain, noise);
}
LineState<double> one_by_one(LineState<double> line, const std::vector<Reading>& readings) {
  for (const Reading& each : readings) {
    advance(line, each.step);
    take(line, each.level, 1);
  }
  return line;
}

}  // namespace

TEST_CASE("the line takes the first reading by recursive least squares") {
  support::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const auto line = random_line(random, 0.3);
    auto readings = random_readings(random);
    readings.resize(1);
    const double dt = readings[0].step, y = readings[0].level;
    const auto expected = one_by_one(line, readings);
    Block block;
    block.begin(line, dt, Block::capacity);
    const double innovation = block.add(y, dt, y);
    CHECK(innovation == doctest::Approx(y - line.level - dt * line.slope).epsilon(1e-12));
    CHECK(block.level == doctest::Approx(expected.level).epsilon(1e-12));
    CHECK(block.slope == doctest::Approx(expected.slope).epsilon(1e-12));
    CHECK(block.variance() == doctest::Approx(expected.level_variance).epsilon(1e-12));
  }
}

TEST_CASE("mean, middle and span are those of the readings, and of any of them that are kept") {
  support::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const auto readings = random_readings(random);
    Block block;
    block.begin(random_line(random, 0.3), 1, Block::capacity);
    for (const Reading& each : readings) block.add(each.level, each.step, each.level);
    const auto check = [&](std::size_t first, std::size_t count) {
      double time = 0, times = 0, levels = 0;
      for (std::size_t i = first; i < first + count; ++i) {
        time += readings[i].step;
        times += time;
        levels += readings[i].level;
      }
      CHECK(block.size == static_cast<int>(count));
      CHECK(block.span == doctest::Approx(time).epsilon(1e-12));
      CHECK(block.times * block.share() == doctest::Approx(times / double(count)).epsilon(1e-12));
      CHECK(block.sum == doctest::Approx(levels).epsilon(1e-12));
    };
    const int all = static_cast<int>(readings.size());
    check(0, readings.size());
    for (int first = 0; first < all; ++first)
      for (int count = 1; first + count <= all; ++count) {
        block.keep(first, count, [](double reading) { return reading; });
        check(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
      }
  }
}

namespace {

/// How much larger the variance of a line is than it could be once `count` readings have waited that came
/// after `age` others.
struct Loss {
  double together, meanwhile;
};
Loss loss_of(int age, int count) {
  const LineState<double> line = fitted_to(age);
  const double best =
      one_by_one(line, std::vector<Reading>(static_cast<std::size_t>(count), {1, 0})).level_variance;
  // Their mean, at the middle of them, and on to the last one.
  LineState<double> together = line;
  advance(together, 0.5 * (count + 1));
  take(together, 0, 1.0 / count);
  advance(together, 0.5 * (count - 1));
  // One by one with the gains of the first.
  Block block;
  block.begin(line, 1, Block::capacity);
  LineState<double> follows = line;
  for (int i = 0; i < count; ++i) {
    advance(follows, 1);
    take(follows, block.level_gain, block.slope_gain, 1);
  }
  CHECK(together.level_variance >= best);
  CHECK(follows.level_variance >= best);
  CHECK(follows.level_variance < block.variance());
  return {together.level_variance / best - 1, follows.level_variance / best - 1};
}

}  // namespace

TEST_CASE(
    "half as many readings as a line was fitted to lose less than three percent as their mean, and less than "
    "eight on the line that follows them") {
  // So many wait together, up to sixteen.
  for (int age = 4; age <= 2 * Block::capacity; ++age) {
    CAPTURE(age);
    const Loss loss = loss_of(age, age / 2);
    CHECK(loss.together < 0.03);
    CHECK(loss.meanwhile < 0.08);
  }
  for (int age = 4 * Block::capacity; age < 1000; age *= 2) {
    CAPTURE(age);
    const Loss loss = loss_of(age, Block::capacity);
    CHECK(loss.together < 0.007);
    CHECK(loss.meanwhile < 0.015);
  }
}

TEST_CASE(
    "of a line fitted to 32 readings or more the mean of eight loses less than a percent of what they say, "
    "and the line that follows them less than two") {
  for (int age = 32; age < 1000; age *= 2) {
    CAPTURE(age);
    const Loss loss = loss_of(age, 8);
    CHECK(loss.together < 0.01);
    CHECK(loss.meanwhile < 0.02);
  }
}

namespace {

/// Squares in foretold variances, in the mean over many true lines drawn from what is known after `age`
/// readings: of the last innovation of a full block, and of the fading sum then.
struct Spread {
  double innovation = 0, drift = 0;
};
Spread spread_after(int age) {
  support::Random random(3);
  const LineState<double> line = fitted_to(age);
  const double slope_sd = std::sqrt(line.slope_variance), along = line.covariance / slope_sd;
  const double across = std::sqrt(line.level_variance - along * along);
  Spread spread;
  constexpr int trials = 20000;
  for (int trial = 0; trial < trials; ++trial) {
    const double a = support::gaussian(random), b = support::gaussian(random);
    const double slope = line.slope + slope_sd * a, level = line.level + along * a + across * b;
    Block block;
    block.begin(line, 1, Block::capacity);
    double time = 0, last = 0;
    for (int i = 0; i < Block::capacity; ++i) {
      const double step = i % 5 == 2 ? 0.9 : i % 5 == 4 ? 1.1 : 1.0;
      time += step;
      const double y = level + slope * time + support::gaussian(random);
      last = block.add(y, step, y);
    }
    spread.innovation += last * last / block.spread / trials;
    spread.drift += block.drift * block.drift / block.drift_variance / trials;
  }
  return spread;
}

}  // namespace

TEST_CASE("innovations and their fading sum have the spread that is foretold") {
  // A chi-square over 20,000 varies by 1 %; the last innovation is by a few per cent smaller than the first.
  const Spread spread = spread_after(64);
  CHECK(spread.innovation == doctest::Approx(1).epsilon(0.04));
  CHECK(spread.drift == doctest::Approx(1).epsilon(0.05));
  // The gains of the first reading correct too much then: one innovation makes up for another.
  const Spread youngest = spread_after(2 * Block::capacity);
  CHECK(youngest.innovation == doctest::Approx(1).epsilon(0.04));
  CHECK(youngest.drift < 1);
  CHECK(youngest.drift > 0.75);
}

}  // namespace load_block_test
