// An end that is marked as locked once its jack has been let out, and not before.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "estimation/jacked_chain.hpp"

namespace late_lock_test {
using namespace estimation;

namespace {

constexpr double seating = 4e-3;

/// A jacking up to the full load, with noise, and its truth.
class Visit {
 public:
  explicit Visit(std::uint64_t seed) : random_(seed), said_(said()), jacked_(seating, said_), chain_(mu) {}

  void pull(double to, int rows, double dt = 1) {
    const double from = at_;
    for (int i = 1; i <= rows; ++i) {
      at_ = from + (to - from) * i / rows;
      chain_.pull(at_);
      read(false, dt);
    }
  }
  void hold(int rows, double dt = 1) {
    for (int i = 0; i < rows; ++i) read(false, dt);
  }
  /// The wedge takes hold, unseen by the log.
  void wedge() { chain_.lock(seating); }
  /// The jack is let out behind it to a part of its load; the log says so, or not.
  void let_out(double part, int rows, bool is_locked, double dt = 1) {
    const double from = at_;
    for (int i = 1; i <= rows; ++i) {
      at_ = from * (1 + (part - 1) * i / rows);
      read(is_locked, dt);
    }
  }
  bool is_late() const { return jacked_.raises(taut::Alarm::Kind::late_lock); }
  /// How many of the forces are in their bars.
  int held() const {
    Score score;
    add_to(score, jacked_, chain_);
    return score.held;
  }

 private:
  static Said said() {
    Said said;
    said.jack_sd = 2e-3 * full;
    return said;
  }
  void read(bool is_locked, double dt) {
    jacked_.row(at_ + said_.jack_sd * support::gaussian(random_), is_locked, dt, -1);
  }

  support::Random random_;
  Said said_;
  Jacked jacked_;
  Chain chain_;
  double at_ = 0;
};

}  // namespace

TEST_CASE("an end that is locked while its load falls may have been so before: an alarm, and bars have it") {
  for (const double part : {0.4, 0.2, 0.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(part);
      CAPTURE(seed);
      const auto visit = std::make_unique<Visit>(seed);
      visit->pull(full, 100);
      visit->hold(40);
      visit->wedge();
      visit->let_out(part, static_cast<int>(100 * (1 - part)), false);
      CHECK_FALSE(visit->is_late());
      visit->let_out(0, 20, true);
      CHECK(visit->is_late());
      CHECK(visit->held() == segments);
    }
}

TEST_CASE(
    "so it is where the jack was let out in a row, and rests without load, as in a log of load stages") {
  for (const int rows : {1, 2, 4})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(rows);
      CAPTURE(seed);
      const auto visit = std::make_unique<Visit>(seed);
      for (const double stage : {0.25, 0.5, 0.75, 1.0}) visit->pull(stage * full, 1, 60);
      visit->hold(2, 60);
      visit->wedge();
      visit->let_out(0, 1, false, 60);
      visit->let_out(1, rows - 1, false, 60);
      visit->let_out(1, 3, true, 60);
      CHECK(visit->is_late());
      CHECK(visit->held() == segments);
    }
}

TEST_CASE("an end that is locked in a hold, after a release too, is locked when the log says so") {
  for (const double release : {1.0, 0.95, 0.5})
    for (const double dt : {1.0, 60.0})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(release);
        CAPTURE(dt);
        CAPTURE(seed);
        const auto visit = std::make_unique<Visit>(seed);
        visit->pull(full, dt > 1 ? 4 : 100, dt);
        visit->hold(dt > 1 ? 1 : 20, dt);
        if (release < 1) visit->pull(release * full, dt > 1 ? 1 : 40, dt);
        visit->hold(dt > 1 ? 0 : 20, dt);
        visit->wedge();
        visit->let_out(0, 10, true, dt);
        CHECK_FALSE(visit->is_late());
        visit->let_out(1, 5, true, dt);
        CHECK_FALSE(visit->is_late());
      }
}

}  // namespace late_lock_test
