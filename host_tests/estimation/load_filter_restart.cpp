// The load filter where it begins again at a load that is known, and where readings come to scatter
// otherwise.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "taut/estimation/load_filter.hpp"

namespace load_filter_restart_test {
using taut::ConditionedLoad;
using taut::LoadFilter;

namespace {

/// A line through readings by weighted least squares: level and slope, with a prior of both at time zero.
class Line {
 public:
  Line(double level, double level_sd, double slope_sd) {
    add(Eigen::RowVector2d(1, 0), level, level_sd);
    add(Eigen::RowVector2d(0, 1), 0, slope_sd);
  }
  void read(double time, double reading, double sd) { add(Eigen::RowVector2d(1, time), reading, sd); }
  double at(double time) const { return Eigen::RowVector2d(1, time) * information_.ldlt().solve(sum_); }
  double deviation(double time) const {
    const Eigen::RowVector2d row(1, time);
    return std::sqrt(row * information_.inverse() * row.transpose());
  }

 private:
  void add(const Eigen::RowVector2d& row, double measured, double sd) {
    information_ += row.transpose() * row / (sd * sd);
    sum_ += row.transpose() * measured / (sd * sd);
  }
  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
};

/// Standard deviation of the slope after a jump, in those of a reading per sample.
constexpr double any_slope = 10;

template <class Scalar>
double in(Scalar number) {
  return static_cast<double>(number);
}
bool are_close(double a, double b, double allowed) { return std::fabs(a - b) <= allowed; }

/// A path of loads that has ramps up and down, holds and a step, at every row.
std::vector<double> site_path() {
  std::vector<double> path;
  double load = 0;
  const auto go = [&](double slope, int rows) {
    for (int i = 0; i < rows; ++i) path.push_back(load += slope);
  };
  go(40, 100);
  go(0, 60);
  go(-25, 80);
  go(0, 50);
  load += 3000;
  go(0, 50);
  go(10, 100);
  return path;
}

}  // namespace

TEST_CASE_TEMPLATE("from a load that was held, the first readings teach what least squares does", Scalar,
                   float, double) {
  constexpr double sd = 20, dt = 0.5, held = 5000;
  for (const double held_sd : {2.0, 100.0, 600.0})
    for (const double off : {-60.0, 0.0, 90.0}) {
      CAPTURE(held_sd);
      CAPTURE(off);
      LoadFilter<Scalar> filter;
      filter.start_at(Scalar(sd), Scalar(held), Scalar(held_sd));
      Line line(held, held_sd, any_slope * sd / dt);
      for (int i = 1; i <= 2; ++i) {
        const double reading = held + off + 30 * i;
        const auto now = filter.take(static_cast<Scalar>(reading), Scalar(dt));
        line.read(dt * i, reading, sd);
        CHECK(are_close(in(now.load), line.at(dt * i), 1e-3 * sd));
        CHECK(are_close(in(now.sd), line.deviation(dt * i), 1e-3 * sd));
        CHECK_FALSE(now.refused);
      }
    }
}

TEST_CASE("from a load that was held it goes up, and does not reverse unless it goes down") {
  constexpr double sd = 10, held = 2000;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    LoadFilter<double> up, down;
    for (LoadFilter<double>* filter : {&up, &down}) {
      // What came before is forgotten.
      filter->start(sd);
      for (int i = 0; i < 200; ++i) filter->take(5000 - 25 * i + sd * support::gaussian(random), 1);
      filter->start_at(sd, held, sd);
    }
    ConditionedLoad<double> now;
    double last = held;
    for (int i = 0; i < 100; ++i) {
      now = up.take(held + 8 * i + sd * support::gaussian(random), 1);
      REQUIRE_FALSE(now.reversed);
      REQUIRE(now.confirmed >= last);
      last = now.confirmed;
    }
    CHECK(now.confirmed > held + 8 * 99 - 8 * sd);
    int reversals = 0;
    for (int i = 0; i < 100; ++i) {
      now = down.take(held - 8 * i + sd * support::gaussian(random), 1);
      if (!now.reversed) continue;
      ++reversals;
      CHECK(now.reversal == held);
    }
    CHECK(reversals == 1);
    CHECK(now.confirmed < held - 8 * 99 + 8 * sd);
  }
}

TEST_CASE("readings that are exact begin again at the load that was held, too") {
  LoadFilter<double> filter;
  filter.start_at(0, 700, 5);
  auto now = filter.take(900, 1);
  CHECK(now.load == 900);
  CHECK_FALSE(now.reversed);
  filter.start_at(0, 700, 5);
  now = filter.take(650, 1);
  CHECK(now.load == 650);
  CHECK(now.reversed);
  CHECK(now.reversal == 700);
  // They stay exact.
  filter.change_sd(3);
  CHECK(filter.sd() == 0);
}

TEST_CASE_TEMPLATE("readings from before and after a change count by their own scatter", Scalar, float,
                   double) {
  constexpr double before = 20, dt = 2, held = 3000, held_sd = 35;
  for (const double after : {5.0, 12.0, 40.0, 200.0}) {
    CAPTURE(after);
    LoadFilter<Scalar> filter;
    filter.start_at(Scalar(before), Scalar(held), Scalar(held_sd));
    Line line(held, held_sd, any_slope * before / dt);
    filter.take(Scalar(held + 50), Scalar(dt));
    line.read(dt, held + 50, before);
    REQUIRE_FALSE(filter.has_waiting());
    filter.change_sd(static_cast<Scalar>(after));
    CHECK(filter.sd() == static_cast<Scalar>(after));
    const auto now = filter.take(Scalar(held + 160), Scalar(dt));
    line.read(2 * dt, held + 160, after);
    CHECK(are_close(in(now.load), line.at(2 * dt), 1e-3 * before));
    CHECK(are_close(in(now.sd), line.deviation(2 * dt), 1e-3 * before));
  }
}

TEST_CASE("a change of the scatter leaves the load, its deviation and what is confirmed as they were") {
  const std::vector<double> path = site_path();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  int compared = 0, between_lines = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    LoadFilter<double> filter;
    constexpr double sd = 50;
    filter.start(sd);
    for (std::size_t i = 0; i < path.size(); ++i) {
      CAPTURE(i);
      const auto now = filter.take(path[i] + sd * support::gaussian(random), 1);
      if (filter.has_waiting() || i == 0) continue;
      // Where nothing is read it says again what it knows.
      LoadFilter<double> same = filter;
      const auto expected = same.take(nan, 1);
      if (now.refused) continue;
      for (const double after : {0.3 * sd, 4 * sd}) {
        CAPTURE(after);
        LoadFilter<double> changed = filter;
        changed.change_sd(after);
        const auto told = changed.take(nan, 1);
        REQUIRE(are_close(told.load, expected.load, 1e-3 * sd));
        REQUIRE(are_close(told.sd, expected.sd, 1e-4 * expected.sd));
        REQUIRE(told.confirmed == expected.confirmed);
        REQUIRE(told.behind == expected.behind);
        ++compared;
        if (told.behind) ++between_lines;
      }
    }
  }
  CHECK(compared > 3000);
  CHECK(between_lines > 100);
}

TEST_CASE("after a change the load turns where it did, as well known as by a filter begun so") {
  // Its corners and means from before the change are used after it.
  for (const double after : {25.0, 200.0}) {
    CAPTURE(after);
    constexpr double before = 50;
    double worst_reversal = 0, beyond = 0;
    int reversals = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      support::Random random(seed);
      LoadFilter<double> filter;
      filter.start(before);
      const double top = 2400;
      const auto noise = [&](double sd) { return sd * support::gaussian(random); };
      for (int i = 0; i < 60; ++i) filter.take(40 * i + noise(before), 1);
      for (int i = 0; i < 5; ++i) filter.take(top + noise(before), 1);
      if (filter.has_waiting()) continue;
      filter.change_sd(after);
      for (int i = 0; i < 100; ++i) {
        const double load = top - (i < 3 ? 0.0 : 40 * (i - 3.0));
        const auto now = filter.take(load + noise(after), 1);
        if (reversals == 0) beyond = std::max(beyond, now.confirmed - top);
        if (!now.reversed) continue;
        ++reversals;
        worst_reversal = std::max(worst_reversal, std::fabs(now.reversal - top));
      }
    }
    CHECK(reversals > 150);
    CHECK(reversals < 205);
    CHECK(worst_reversal < 4 * std::max(before, after));
    CHECK(beyond < 3 * before);
  }
}

TEST_CASE_TEMPLATE("with the scatter changed early the load is in the end that of a filter begun so", Scalar,
                   float, double) {
  for (const double ratio : {0.25, 3.0, 10.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(ratio);
      CAPTURE(seed);
      constexpr double sd = 40;
      support::Random random(seed);
      LoadFilter<Scalar> changed, begun_so;
      changed.start(Scalar(sd / ratio));
      begun_so.start(Scalar(sd));
      bool has_changed = false;
      ConditionedLoad<Scalar> a, b;
      for (int i = 0; i < 1500; ++i) {
        const double load = i < 300 ? 10 * i : 3000;
        const auto reading = static_cast<Scalar>(load + sd * support::gaussian(random));
        a = changed.take(reading, 1);
        b = begun_so.take(reading, 1);
        if (i < 40 || has_changed || changed.has_waiting()) continue;
        changed.change_sd(Scalar(sd));
        has_changed = true;
      }
      REQUIRE(has_changed);
      // In a hold of 1200 readings a line knows it to 2 sd / sqrt(1200).
      CHECK(are_close(in(a.load), in(b.load), 0.1 * sd));
      CHECK(are_close(in(a.sd), in(b.sd), 0.5 * in(b.sd)));
      CHECK(are_close(in(b.load), 3000, 0.25 * sd));
      CHECK(are_close(in(a.confirmed), in(b.confirmed), 0.5 * sd));
    }
}

TEST_CASE("there is no change to a scatter that is none") {
  LoadFilter<double> filter;
  filter.start(5);
  filter.take(100, 1);
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    filter.change_sd(none);
    CHECK(filter.sd() == 5);
  }
}

}  // namespace load_filter_restart_test
