// What SinceLockOff calls a misfit of a far end that a wedge holds.
#include "taut/estimation/since_lock_off.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "support/random.hpp"

namespace since_lock_off_test {
namespace {

using support::gaussian;
using support::Random;

/// A far end at 100 kN, known to be no better than that, whose cell scatters by 300 N; the jack's by 500 N.
template <class Scalar>
struct FarEnd {
  static constexpr double sd = 300, jack_sd = 500;

  explicit FarEnd(std::uint64_t seed) : random(seed) {}
  /// Whether it misfits in a row in which it is off by so much [N].
  bool read(double off, double jack = 0, double model = 0) {
    since.follow_jack(static_cast<Scalar>(jack + jack_sd * gaussian(random)), static_cast<Scalar>(jack_sd));
    take(1e5 + off + sd * gaussian(random), model);
    return since.misfit() > 0;
  }
  void take(double reading, double model = 0) {
    since.take(static_cast<Scalar>(reading), static_cast<Scalar>(8e4 + model), static_cast<Scalar>(sd), 0);
  }

  Random random;
  taut::SinceLockOff<Scalar> since;
};

}  // namespace

TEST_CASE_TEMPLATE("a far end that stays what it was fits, at any force and with any friction", Scalar, float,
                   double) {
  int misfits = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    FarEnd<Scalar> end(seed);
    bool any = false;
    for (int row = 0; row < 300; ++row) any |= end.read(0);
    misfits += any ? 1 : 0;
  }
  // One in 150 000 windows by (37), some twenty of which are independent.
  CHECK(misfits <= 4);
}

TEST_CASE_TEMPLATE("what goes off slowly is seen once it is off by four deviations of a reading", Scalar,
                   float, double) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (const double way : {-1.0, 1.0}) {
      FarEnd<Scalar> end(seed);
      bool any = false;
      for (int row = 1; row <= 100; ++row) any |= end.read(way * 4 * FarEnd<Scalar>::sd * row / 100);
      seen += any ? 1 : 0;
    }
  CHECK(seen >= 0.95 * 400);
}

TEST_CASE("a wedge that is drawn in while the jack lets go is at rest afterwards") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    FarEnd<double> end(seed);
    bool any = false;
    for (int row = 1; row <= 60; ++row) any |= end.read(-200.0 * row, 2e5 * (1 - row / 60.0));
    for (int row = 1; row <= 100; ++row) any |= end.read(-12e3);
    CHECK_FALSE(any);
    for (int row = 1; row <= 40; ++row) any |= end.read(-12e3 - 6 * FarEnd<double>::sd);
    CHECK(any);
  }
}

TEST_CASE("where no cell is at the jack, what jumps in the first rows is drawn in") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    FarEnd<double> end(seed);
    for (const double off : {0.0, 0.0, -9e3, -12e3, -12e3})
      end.take(1e5 + off + FarEnd<double>::sd * gaussian(end.random));
    for (int row = 1; row <= 100; ++row) {
      end.take(1e5 - 12e3 + FarEnd<double>::sd * gaussian(end.random));
      CHECK(end.since.misfit() == 0);
    }
  }
}

TEST_CASE("a single wrong reading is none of what strains the cable") {
  for (const int wrong : {0, 2, 3, 4, 9, 40})
    for (const double by : {-9e4, 4e3, 9e37}) {
      CAPTURE(wrong);
      CAPTURE(by);
      FarEnd<double> end(1);
      for (int row = 0; row < 80; ++row) CHECK_FALSE(end.read(row == wrong ? by : 0));
    }
}

TEST_CASE(
    "what other loads change is known to that change, and what friction is found to be changes nothing") {
  FarEnd<double> loaded(1), learned(1);
  for (int row = 0; row < 20; ++row) CHECK_FALSE(loaded.read(0));
  // The model has two thirds of it.
  for (int row = 0; row < 80; ++row) CHECK_FALSE(loaded.read(3e3, 0, 2e3));
  for (int row = 0; row < 20; ++row) CHECK_FALSE(learned.read(0));
  learned.since.correct(5e3);
  for (int row = 0; row < 80; ++row) CHECK_FALSE(learned.read(0, 0, 5e3));
  bool any = false;
  for (int row = 0; row < 40; ++row) any |= learned.read(2e3, 0, 5e3);
  CHECK(any);
}

}  // namespace since_lock_off_test
