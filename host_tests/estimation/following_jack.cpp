// When a jack is taken to follow the other one of its cable: it rests, and then its load is in proportion.
#include "taut/estimation/following_jack.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/random.hpp"

namespace following_jack_test {
namespace {

/// Two jacks that pull one cable, in rows that are read with an error.
class Jacks {
 public:
  explicit Jacks(double sd = 2e-3) : sd_(sd) {}
  double less() const { return less_; }
  /// One goes on to this load [-]; of the other one less_at(load) is read then. Returns in how many rows
  /// quotients were a measurement, and keeps the last of them.
  template <class LessAt>
  int pull(double load, int rows, const LessAt& less_at) {
    const double from = more_;
    int measured = 0;
    for (int i = 1; i <= rows; ++i) {
      more_ = from + (load - from) * i / rows;
      less_ = less_at(more_);
      measured += row(true);
    }
    return measured;
  }
  /// The valve of the other one is shut, and friction leaves it this part of the load.
  int pull_alone(double load, int rows, double left) {
    const double held = less_;
    return pull(load, rows, [&](double more) { return std::max(held, left * more); });
  }
  /// Then the other one catches up, in rows in which it pulls more; and one more in which it does not.
  void catch_up(int rows) {
    for (int i = 0; i < rows; ++i)
      static_cast<void>(following_.take({1, 1, variance(), more_, false, false}));
    less_ = more_;
    static_cast<void>(row(false));
  }
  double quotient = 0;

 private:
  double variance() const { return 2 * sd_ * sd_; }
  bool row(bool rises) {
    const double quotient_read =
        less_ * (1 + sd_ * support::gaussian(random_)) / (more_ * (1 + sd_ * support::gaussian(random_)));
    if (!following_.take({0, quotient_read, variance(), more_, rises, false})) return false;
    quotient = following_.measured().quotient;
    return true;
  }

  taut::FollowingJack<double> following_;
  support::Random random_{11};
  double sd_, more_ = 0.01, less_ = 0.01;
};

/// Of a cable on which friction leaves this part.
constexpr double left = 0.8;

}  // namespace

TEST_CASE("a jack that rests, and then is level where it was before, follows the other one") {
  Jacks jacks;
  CHECK(jacks.pull_alone(0.5, 60, left) == 0);
  jacks.catch_up(20);
  CHECK(jacks.pull_alone(1, 80, left) > 2);
  CHECK(jacks.quotient == doctest::Approx(left).epsilon(0.003));
}

TEST_CASE("one that was level once alone does not, and none that went on in proportion from the start") {
  Jacks jacks;
  // It rests first.
  CHECK(jacks.pull(0.2, 20, [](double load) { return load; }) == 0);
  CHECK(jacks.pull_alone(1, 100, left) == 0);
  Jacks together;
  for (const double load : {0.3, 0.6, 1.0}) {
    CHECK(together.pull(load, 80, [](double more) { return left * more; }) == 0);
    CHECK(together.pull(load, 20, [](double more) { return left * more; }) == 0);
  }
}

TEST_CASE("a pump that begins later, as often as it does, and goes on as fast does not make it follow") {
  for (const double late : {0.02, 0.05, 0.1, 0.2}) {
    CAPTURE(late);
    Jacks jacks;
    double from = 0.01;
    for (const double load : {0.3, 0.6, 1.0}) {
      CHECK(jacks.pull(load, 100, [&](double more) { return std::max(from, more - late * load); }) == 0);
      jacks.catch_up(20);
      from = jacks.less();
    }
  }
}

TEST_CASE("where the other pump begins to work a jack that follows follows no more") {
  Jacks jacks;
  CHECK(jacks.pull_alone(0.5, 60, left) == 0);
  jacks.catch_up(20);
  CHECK(jacks.pull_alone(0.8, 60, left) > 0);
  // As many rows as it takes to be seen, and the ones before them.
  const double from = jacks.less();
  CHECK(jacks.pull(1, 60, [&](double more) { return from + 1.5 * (more - 0.8); }) <= 3);
  CHECK(jacks.quotient == doctest::Approx(left).epsilon(0.03));
}

}  // namespace following_jack_test
