// The mean of readings that a line explains against the readings one by one.
#include "taut/estimation/load_block.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/random.hpp"

using taut::LineState;
using Block = taut::LoadBlock<double, 8>;

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
Block block_of(const std::vector<Reading>& readings) {
  Block block;
  block.begin(Block::capacity);
  for (const Reading& each : readings) block.add(each.level, each.step, each.level);
  return block;
}
/// A line like the ones of a filter: fitted to some readings, its covariance positive definite.
LineState<double> random_line(support::Random& random, double slope_sd) {
  const double level_sd = random.between(0.05, 0.5), correlation = random.between(0, 0.9);
  return {support::gaussian(random), 0.1 * support::gaussian(random), level_sd * level_sd,
          correlation * level_sd * slope_sd, slope_sd * slope_sd};
}
/// Recursive least squares, reading by reading.
LineState<double> one_by_one(LineState<double> line, const std::vector<Reading>& readings) {
  for (const Reading& each : readings) {
    const double dt = each.step;
    line.level += dt * line.slope;
    line.level_variance += dt * (2 * line.covariance + dt * line.slope_variance);
    line.covariance += dt * line.slope_variance;
    const double S = line.level_variance + 1, r = each.level - line.level;
    const double level_gain = line.level_variance / S, slope_gain = line.covariance / S;
    line.level += level_gain * r;
    line.slope += slope_gain * r;
    line.slope_variance -= slope_gain * line.covariance;
    line.level_variance -= level_gain * line.level_variance;
    line.covariance -= level_gain * line.covariance;
  }
  return line;
}

}  // namespace

TEST_CASE("of a line whose slope is known the mean says what the readings say one by one") {
  support::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const auto line = random_line(random, 0);
    const auto readings = random_readings(random);
    const auto expected = one_by_one(line, readings);
    const auto fit = block_of(readings).fit(line, readings.back().level);
    CHECK(fit.level == doctest::Approx(expected.level).epsilon(1e-12));
    CHECK(fit.variance == doctest::Approx(expected.level_variance).epsilon(1e-12));
  }
}

TEST_CASE("one reading is that reading") {
  support::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const auto line = random_line(random, 0.3);
    auto readings = random_readings(random);
    readings.resize(1);
    const auto expected = one_by_one(line, readings);
    const auto fit = block_of(readings).fit(line, readings[0].level);
    CHECK(fit.level == doctest::Approx(expected.level).epsilon(1e-12));
    CHECK(fit.variance == doctest::Approx(expected.level_variance).epsilon(1e-12));
    CHECK(fit.off == doctest::Approx(fit.last_off).epsilon(1e-12));
    CHECK(fit.spread == doctest::Approx(fit.last_spread).epsilon(1e-12));
  }
}

TEST_CASE(
    "of a line fitted to 32 readings or more the mean of eight loses less than a percent of what they say") {
  // Eight wait together only then.
  for (int age = 32; age < 1000; age *= 2) {
    CAPTURE(age);
    // Recursive least squares from nothing: variances of a straight line through `age` readings.
    const double n = age;
    const LineState<double> line = {0, 0, 2 * (2 * n - 1) / (n * (n + 1)), 6 / (n * (n + 1)),
                                    12 / (n * (n * n - 1))};
    const std::vector<Reading> readings(8, {1, 0});
    const double best = one_by_one(line, readings).level_variance;
    const double variance = block_of(readings).fit(line, 0).variance;
    CHECK(variance >= best);
    CHECK(variance < 1.01 * best);
  }
}

TEST_CASE("how far the mean and the last reading are off has the spread that is foretold") {
  support::Random random(3);
  const LineState<double> line = {5, 0.2, 0.3, 0.02, 0.01};
  double off = 0, last_off = 0;
  constexpr int trials = 20000;
  for (int trial = 0; trial < trials; ++trial) {
    // A true line drawn from what is known.
    const double a = support::gaussian(random), b = support::gaussian(random);
    const double slope = line.slope + 0.1 * a;
    const double level = line.level + 0.02 / 0.1 * a + std::sqrt(0.3 - 0.04) * b;
    std::vector<Reading> readings;
    double time = 0;
    for (const double step : {1.0, 1.5, 0.7, 1.0, 1.2}) {
      time += step;
      readings.push_back({step, level + slope * time + support::gaussian(random)});
    }
    const auto fit = block_of(readings).fit(line, readings.back().level);
    off += fit.off * fit.off / fit.spread;
    last_off += fit.last_off * fit.last_off / fit.last_spread;
  }
  // A chi-square over 20,000 varies by 1 %.
  CHECK(off / trials == doctest::Approx(1).epsilon(0.04));
  CHECK(last_off / trials == doctest::Approx(1).epsilon(0.04));
}
