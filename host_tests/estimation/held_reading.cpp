// Load cells that are read more seldom than rows are written: the logger writes their last value again.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace held_reading_test {
using namespace estimation;

namespace {

using Held = taut::HeldReading<double>;

/// So many rows `dt` apart have this reading; how many of them count no more.
int write(Held& held, double reading, int rows, double dt) {
  int again = 0;
  for (int i = 0; i < rows; ++i) again += held.take(reading, dt, 1e7) == Held::Again::yes ? 1 : 0;
  return again;
}

/// A load cell that is read once in `pace` seconds.
class Logged {
 public:
  explicit Logged(double pace) : pace_(pace) {}
  double write(double time, double reading) {
    if (time >= next_) written_ = reading;
    while (time >= next_) next_ += pace_;
    return written_;
  }

 private:
  double pace_, next_ = 0, written_ = 0;
};

/// A cable over rigid saddles, pulled in parts with holds, let out and pulled again; both of its cells are
/// written again, each at a pace of its own, with five rows a second.
class Jacking {
 public:
  Jacking(bool has_far, std::uint64_t seed)
      : random_(seed), end_(random_.between(0.3, 2)), start_(random_.between(0.3, 2)) {
    site.has_far = has_far;
    site.begin(random_);
    REQUIRE(estimator.start(site.model, site.prior).status.ok());
  }
  Jacking(const Jacking&) = delete;
  Jacking& operator=(const Jacking&) = delete;
  ~Jacking() = default;

  void go(double part, double seconds) {
    const double from = part_;
    const int rows = static_cast<int>(seconds / dt);
    for (int i = 1; i <= rows; ++i) {
      part_ = from + (part - from) * i / rows;
      time_ += dt;
      site.pull(part_ * full);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = dt;
      const auto read = [&](Logged& cell, double force) -> taut::EndReading<double> {
        return {true, false, cell.write(time_, force + site.noise * gaussian(random_)), 0};
      };
      readings.ends[0][1] = read(end_, site.force.back());
      if (site.has_far) readings.ends[0][0] = read(start_, site.force.front());
      REQUIRE(estimator.advance(readings).status.ok());
      alarms += of_far_end(estimator.alarms());
      if (part_ > 0.05) site.add_to(score, estimator);
    }
  }

  SaddleSite site;
  taut::Estimator<SaddleSite::Model, most_unknowns> estimator;
  Score score;
  int alarms = 0;

 private:
  static constexpr double dt = 0.2;

  Random random_;
  Logged end_, start_;
  double part_ = 0, time_ = 0;
};

}  // namespace

TEST_CASE("a reading that a logger writes again counts once, as long as others were there") {
  Random random(1);
  for (const int rows : {2, 3, 10})
    for (const double step : {0.0, 500.0, 5000.0}) {
      CAPTURE(rows);
      CAPTURE(step);
      Held held;
      double load = 1e5;
      int missed = 0;
      for (int i = 0; i < 60; ++i) {
        load += step;
        const int again = write(held, load + 300 * gaussian(random), rows, 0.1);
        if (i >= 30) missed += rows - 1 - again;
      }
      CHECK(missed == 0);
      // One that stays for longer has ceased to live: that has to be seen.
      CHECK(write(held, load, 20 * rows, 0.1) <= rows);
    }
}

TEST_CASE("the steps of a display, rest without noise and load stages are readings") {
  Held ramp, stages;
  Random random(2);
  int again = 0;
  for (const double step : {1000.0, 647.127, 6471.27})
    for (const double pace : {150.0, 15.0, 1500.0}) {
      // Written with one decimal.
      Held display;
      for (int i = 0; i < 400; ++i) {
        const double shown = step * std::round((1e5 + pace * i + 0.2 * step * gaussian(random)) / step);
        again += write(display, std::round(10 * shown) / 10, 1, 0.1);
      }
    }
  CHECK(again == 0);
  for (int part = 1; part <= 6; ++part) {
    for (int i = 1; i <= 10; ++i) again += write(ramp, 1e4 * part + 777.7 * i, 1, 0.5);
    again += write(ramp, 1e4 * part + 7777, 20, 0.5);
  }
  CHECK(again == 0);
  // Written down where a stage begins to be held, and where it ends.
  for (int stage = 1; stage <= 12; ++stage) again += write(stages, 1e4 * stage + 123.4 * (stage % 7), 2, 300);
  CHECK(again == 0);
}

TEST_CASE("what cannot be a force does not make the steps of a display small") {
  for (const double absurd : {9.9e37, -9.9e37, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(absurd);
    Random random(3);
    SaddleSite site;
    site.begin(random);
    taut::HeldCells<double, PlaneCapacity> cells;
    int again = 0;
    for (int i = 0; i < 400; ++i) {
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 0.1;
      const double shown = 1000 * std::round((1e5 + 15 * i + 100 * gaussian(random)) / 1000);
      readings.ends[0][1] = {true, false, i % 50 == 49 ? absurd : shown, 0};
      again += cells.take(readings, site.model) ? 1 : 0;
    }
    CHECK(again == 0);
  }
}

TEST_CASE(
    "of the first values of a cell that is read seldom bars have where the load can have gone meanwhile") {
  double worst = 0, later = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    SaddleSite site;
    site.has_far = false;
    site.begin(random);
    taut::Estimator<SaddleSite::Model, most_unknowns> estimator;
    REQUIRE(estimator.start(site.model, site.prior).status.ok());
    Logged cell(2);
    for (int row = 0; row < 100; ++row) {
      const double time = 0.1 * row;
      site.pull(0.1 * full * time);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 0.1;
      readings.ends[0][1] = {true, false, cell.write(time, site.force.back() + site.noise * gaussian(random)),
                             0};
      REQUIRE(estimator.advance(readings).status.ok());
      const auto found = estimator.estimate(site.joints);
      const double off = std::fabs(found.force - site.force.back()) / found.deviation;
      // Until the second value nothing tells that the load goes, and only the third change how the cell is
      // read.
      if (row >= 20 && row < 35) worst = std::fmax(worst, off);
      if (row >= 60) later = std::fmax(later, off);
    }
  }
  MESSAGE("the second value is at worst ", worst, " deviations off until it is believed, later ones ", later);
  CHECK(worst < 4);
  CHECK(later < 3);
}

TEST_CASE("no far end is compared with a load of the jack that may be one of before") {
  double worst = 0;
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    SaddleSite site;
    site.begin(random);
    taut::Estimator<SaddleSite::Model, most_unknowns> estimator;
    REQUIRE(estimator.start(site.model, site.prior).status.ok());
    Logged cell(2);
    for (int row = 0; row < 150; ++row) {
      const double time = 0.1 * row, load = std::fmin(0.1 * full * time, full);
      site.pull(load);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 0.1;
      readings.ends[0][1] = {true, false, cell.write(time, load + site.noise * gaussian(random)), 0};
      readings.ends[0][0] = {true, false, site.force.front() + site.noise * gaussian(random), 0};
      REQUIRE(estimator.advance(readings).status.ok());
      alarms += of_far_end(estimator.alarms());
      worst = std::fmax(worst, std::fabs(estimator.mu(0) - site.mean_mu()) / estimator.mu_deviation(0));
    }
  }
  MESSAGE("mu is off by at most ", worst, " deviations; alarms ", alarms);
  CHECK(worst < 4);
  CHECK(alarms == 0);
}

TEST_CASE("with cells that are written again bars hold, and next to no cell is blamed") {
  for (const bool has_far : {true, false}) {
    CAPTURE(has_far);
    Score all;
    int alarms = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const auto jacking = std::make_unique<Jacking>(has_far, seed);
      for (const double part : {0.4, 0.7, 1.03}) {
        jacking->go(part, 40);
        jacking->go(part, 20);
      }
      jacking->go(0.8, 15);
      jacking->go(0.8, 20);
      jacking->go(1, 20);
      all.add(jacking->score);
      alarms += jacking->alarms;
    }
    MESSAGE("seeds 1 to 60, far end ", has_far, ": ", 100 * all.share(), " % are held, errors ", all.rms(),
            " deviations, rms, the worst ", all.worst, ", alarms ", alarms);
    CHECK(all.share() > 0.93);
    CHECK(all.rms() < 1.3);
    CHECK(alarms < 10);
  }
}

}  // namespace held_reading_test
