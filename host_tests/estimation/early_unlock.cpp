// An end that is marked as unlocked when its pump begins to work, and not once its wedge is free.
#include <doctest/doctest.h>

#include <cstdint>

#include "estimation/each_seed.hpp"
#include "estimation/jacked_chain.hpp"

namespace early_unlock_test {
using namespace estimation;

namespace {

constexpr double seating = 4e-3;

/// A visit that ends behind a wedge, its cell at nothing, and the next one, with its truth.
class NextVisit {
 public:
  NextVisit(std::uint64_t seed, double pace)
      : random_(seed), jacked_(seating, said()), chain_(mu), dt_(pace) {
    for (int i = 1; i <= 50; ++i) {
      chain_.pull(full * i / 50);
      read(full * i / 50, false, 1);
    }
    chain_.lock(seating);
    for (int i = 0; i < 10; ++i) read(0, true, 1);
  }
  double held() const { return chain_[segments - 1]; }
  /// The jack goes there while the log has the end unlocked; the wedge holds until it has pulled as much.
  void go(double to, int rows) {
    const double from = at_;
    for (int i = 1; i <= rows; ++i) {
      at_ = from + (to - from) * i / rows;
      is_free_ = is_free_ || at_ > held();
      if (is_free_) chain_.pull(at_);
      read(at_, false, dt_);
      add_to(score_, jacked_, chain_);
    }
  }
  /// The wedge is taken out at once, and the jack stands there.
  void stand_free(double load, int rows) {
    is_free_ = true;
    at_ = load;
    go(load, rows);
  }
  /// The jack is let out, the wedge as it was.
  void lock_again() {
    at_ = 0;
    for (int i = 0; i < 5; ++i) {
      read(0, true, dt_);
      add_to(score_, jacked_, chain_);
    }
  }
  int notices() const { return notices_; }
  /// Of all rows of this visit.
  const Score& score() const { return score_; }
  Score here() const { return score_of(jacked_, chain_); }
  double off() const { return largest_error(jacked_, chain_); }

 private:
  static Said said() {
    Said said;
    said.jack_sd = 2e-3 * full;
    return said;
  }
  void read(double force, bool is_locked, double dt) {
    jacked_.row_of_jack(force + said().jack_sd * support::gaussian(random_), is_locked, dt);
    notices_ += jacked_.raises(taut::Alarm::Kind::early_unlock) ? 1 : 0;
  }

  support::Random random_;
  Jacked jacked_;
  Chain chain_;
  double dt_, at_ = 0;
  bool is_free_ = false;
  int notices_ = 0;
  Score score_;
};

/// Calls check(visit, are_stages) of visits with a row a second, and of others with load stages.
template <class Check>
void for_each_visit(const Check& check) {
  for (const double pace : {1.0, 60.0}) {
    CAPTURE(pace);
    for_each_seed<NextVisit>(pace, [&](NextVisit& visit) { check(visit, pace > 1); });
  }
}

}  // namespace

TEST_CASE(
    "a wedge holds until its jack pulls what it holds, whatever the log says: one notice, and true forces") {
  for (const int rows : {10, 60}) {
    CAPTURE(rows);
    for_each_seed<NextVisit>(1.0, [&](NextVisit& visit) {
      visit.go(0.9 * visit.held(), rows);
      CHECK(visit.score().worst < 4);
      CHECK(visit.notices() == 1);
      visit.go(1.05 * full, 10);
      CHECK(visit.score().worst < 4);
      CHECK(visit.notices() == 1);
    });
  }
}

TEST_CASE("so it does in load stages, and where the jack is let out again before it has pulled as much") {
  for_each_visit([](NextVisit& visit, bool are_stages) {
    visit.go(0.7 * visit.held(), are_stages ? 2 : 40);
    visit.lock_again();
    CHECK(visit.score().worst < 4);
    visit.go(0.6 * visit.held(), are_stages ? 1 : 40);
    CHECK(visit.notices() == 2);
    visit.go(1.05 * full, are_stages ? 2 : 40);
    CHECK(visit.score().worst < 4);
    CHECK(visit.off() < 0.1);
  });
}

TEST_CASE("an end that is unlocked where its jack pulls as much is let out with it, without a notice") {
  for_each_visit([](NextVisit& visit, bool are_stages) {
    visit.go(1.005 * visit.held(), 1);
    visit.go(0.5 * full, are_stages ? 2 : 40);
    CHECK(visit.notices() == 0);
    CHECK(visit.off() < 0.1);
  });
}

TEST_CASE("a jack that jumps to a load below, or stands there in a load stage, has let the end out") {
  for_each_visit([](NextVisit& visit, bool) {
    // It takes some rows to tell a jump from a loose plug.
    visit.stand_free(0.8 * visit.held(), 30);
    CHECK(visit.notices() == 0);
    CHECK(visit.here().held == segments);
  });
}

}  // namespace early_unlock_test
