// The stages of a tensioning, on loads whose stages are known by construction.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "lib/report/load_stages.hpp"

using namespace taut::host;
using Kind = LoadStage::Kind;

namespace {

/// A jack that does as it is told, read every `step` seconds. Strokes are proportional to the force.
class Pump {
 public:
  explicit Pump(double step, double noise = 0, std::uint64_t seed = 1)
      : step_(step), noise_(0, noise), random_(seed) {}

  Pump& pull(double to, double seconds) {
    const double from = force_;
    const int rows = std::max(1, static_cast<int>(std::lround(seconds / step_)));
    for (int i = 1; i <= rows; ++i) row(from + (to - from) * i / rows, step_);
    return *this;
  }
  Pump& hold(double seconds) {
    for (int i = 0; i < std::lround(seconds / step_); ++i) row(force_, step_);
    return *this;
  }
  Pump& lock(int rows) {
    locked_ = true;
    for (int i = 0; i < rows; ++i) row(force_, step_);
    return *this;
  }
  /// One row, and so long since the one before.
  Pump& row(double force, double seconds) {
    force_ = force;
    time_ += seconds;
    JackRow row;
    row.row = ++rows_;
    row.time = time_;
    row.force = noise_.stddev() > 0 ? force + noise_(random_) : force;
    row.locked = locked_;
    row.stroke = 1e-6 * force;
    row.expected = 1.1e-6 * force;
    row.anchored = 0.9 * force;
    stages_.add(row);
    return *this;
  }
  std::vector<LoadStage> stages() const { return stages_.stages(); }
  std::optional<LoadStage> passed(double force, std::size_t after) const {
    return stages_.passing(force, 0.05, after);
  }

 private:
  double step_;
  std::normal_distribution<double> noise_;
  std::mt19937_64 random_;
  double force_ = 0, time_ = 0;
  std::size_t rows_ = 0;
  bool locked_ = false;
  LoadStages stages_;
};

struct Expected {
  Kind kind;
  double force;
};

void check_stages(const std::vector<LoadStage>& found, const std::vector<Expected>& expected, double within) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i].kind == expected[i].kind);
    CHECK(found[i].force == doctest::Approx(expected[i].force).epsilon(within));
  }
}

}  // namespace

TEST_CASE("stages that the jack held are found at every rate of the log, with noise and without") {
  for (const double step : {0.1, 1.0, 5.0, 15.0})
    for (const double noise : {0.0, 500.0, 1500.0, 3000.0}) {
      CAPTURE(step);
      CAPTURE(noise);
      Pump pump(step, noise, 20261124);
      for (const double force : {2e5, 4e5, 6e5, 8e5, 1e6}) pump.pull(force, 160).hold(90);
      check_stages(
          pump.stages(),
          {{Kind::hold, 2e5}, {Kind::hold, 4e5}, {Kind::hold, 6e5}, {Kind::hold, 8e5}, {Kind::hold, 1e6}},
          0.01);
    }
}

TEST_CASE("holds are told from ramps at any ratio of both, and whatever comes after") {
  for (const double hold : {40.0, 300.0, 3600.0})
    for (const double last : {0.0, 36000.0}) {
      CAPTURE(hold);
      CAPTURE(last);
      Pump pump(2);
      for (const double force : {2e5, 6e5, 1e6}) pump.pull(force, 300).hold(hold);
      pump.pull(0, 4).hold(last);
      const auto stages = pump.stages();
      REQUIRE(stages.size() >= 4);
      check_stages({stages.begin(), stages.begin() + 3},
                   {{Kind::hold, 2e5}, {Kind::hold, 6e5}, {Kind::hold, 1e6}}, 0.01);
    }
}

TEST_CASE("a slow ramp is no stage, though its rows lie close together") {
  Pump pump(1);
  pump.pull(3e5, 100).hold(200).pull(1e6, 3000);
  check_stages(pump.stages(), {{Kind::hold, 3e5}, {Kind::last, 1e6}}, 0.01);
}

TEST_CASE("in a log with a row a stage every row is one") {
  Pump pump(1);
  for (const double force : {2e5, 4e5, 6e5, 8e5, 1e6, 9e5}) pump.row(force, 600);
  const auto stages = pump.stages();
  REQUIRE(stages.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(stages[i].first_row == i + 1);
}

TEST_CASE("in a log with a row a stage every row is one, too, if there are three dozen of them") {
  Pump pump(1);
  for (int i = 1; i <= 36; ++i) pump.row(1e6 * i / 36, 600);
  const auto stages = pump.lock(1).stages();
  // Below a thirtieth of the largest force there is none.
  REQUIRE(stages.size() == 36);
  CHECK(stages[0].first_row == 2);
  CHECK(stages[34].first_row == 36);
  CHECK(stages[35].kind == Kind::locked);
  // At a row a second, it is one pull.
  Pump fast(1);
  for (int i = 1; i <= 36; ++i) fast.row(1e6 * i / 36, 1);
  CHECK(fast.lock(1).stages().size() == 3);
}

TEST_CASE("a jack that waits for its turn without force has the stages of one that pulls at once") {
  Pump at_once(1), later(1);
  for (int i = 0; i < 50; ++i) later.row(0, 600);
  for (const double force : {2.5e5, 5e5, 7.5e5, 1e6}) {
    at_once.row(force, 200);
    later.row(force, 200);
  }
  CHECK(at_once.stages().size() == 4);
  CHECK(later.stages().size() == 4);
}

TEST_CASE("a force that was passed without a rest is found after the row that is given, and no other") {
  Pump pump(1);
  pump.pull(1e6, 100).pull(6e5, 40);
  const auto up = pump.passed(7e5, 0), down = pump.passed(7e5, 100);
  REQUIRE(up);
  CHECK(up->kind == Kind::passed);
  CHECK(up->force == doctest::Approx(7e5).epsilon(0.01));
  CHECK(up->last_row <= 71);
  REQUIRE(down);
  CHECK(down->force == doctest::Approx(7e5).epsilon(0.01));
  CHECK(down->first_row >= 129);
  CHECK_FALSE(pump.passed(5e5, 100));
  CHECK_FALSE(pump.passed(1.2e6, 0));
}

TEST_CASE("an overstress without a rest is a turn; a ramp in one go begins with a reference at a tenth") {
  Pump pump(1);
  pump.pull(1e6, 1000).pull(9e5, 100).lock(5);
  const auto stages = pump.stages();
  REQUIRE(stages.size() == 4);
  CHECK(stages[0].kind == Kind::reference);
  CHECK(stages[0].force >= 1e5);
  CHECK(stages[0].force < 1.1e5);
  check_stages({stages.begin() + 1, stages.end()},
               {{Kind::turn, 1e6}, {Kind::turn, 9e5}, {Kind::locked, 8.1e5}}, 0.01);
}

TEST_CASE("forces and strokes of a hold are means over its rows") {
  Pump pump(1, 1000, 7);
  pump.pull(5e5, 100).hold(400);
  const auto stages = pump.stages();
  const LoadStage& hold = stages.back();
  CHECK(hold.kind == Kind::hold);
  // The noise of 400 rows.
  CHECK(hold.force == doctest::Approx(5e5).epsilon(5 * 1000 / std::sqrt(400.0) / 5e5 + 2e-3));
  REQUIRE(hold.stroke);
  REQUIRE(hold.expected);
  CHECK(*hold.expected / *hold.stroke == doctest::Approx(1.1));
}

TEST_CASE("idle rows before the first pull are no stage, and a jack that never pulled has none") {
  Pump idle(1);
  idle.hold(500);
  CHECK(idle.stages().empty());
  Pump pump(1);
  pump.hold(500).pull(1e6, 200).hold(100);
  const auto stages = pump.stages();
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].kind == Kind::reference);
  CHECK(stages[1].kind == Kind::hold);
}

TEST_CASE("a million rows of ripple stay within the list, and the holds are found in them") {
  Pump pump(0.01, 20000, 3);  // more than a step of noise
  for (const double force : {5e5, 1e6}) pump.pull(force, 1000).hold(4000);
  const auto stages = pump.stages();
  CHECK(stages.size() <= LoadStages::most_stages);
  CHECK_FALSE(stages.empty());
}

TEST_CASE("of more stages than there is room for the first and the last are kept") {
  Pump pump(1);
  for (int i = 0; i < 60; ++i) pump.row(i % 2 == 0 ? 1e6 : 5e5, 600);
  pump.lock(1);
  const auto stages = pump.stages();
  REQUIRE(stages.size() == LoadStages::most_stages);
  CHECK(stages.front().first_row == 1);
  CHECK(stages.back().kind == Kind::locked);
}
