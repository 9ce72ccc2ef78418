// Which cells CellWatch calls frozen.
#include "taut/estimation/cell_watch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "support/random.hpp"

namespace cell_watch_test {
namespace {

template <class Scalar>
taut::CellWatch<Scalar> watch_of(double sd) {
  taut::CellWatch<Scalar> watch;
  watch.start(static_cast<Scalar>(sd));
  return watch;
}
/// A reading of what should be `force`, as an estimator takes it.
template <class Scalar>
void take(taut::CellWatch<Scalar>& watch, double reading, double force, double of_model = 0) {
  const auto given = static_cast<Scalar>(reading);
  static_cast<void>(watch.follow_noise(given, 1));
  if (watch.stays_frozen(given)) return;
  const Scalar sd = watch.sd;
  watch.take(given, static_cast<Scalar>(force), static_cast<Scalar>(of_model), sd * sd);
}

}  // namespace

TEST_CASE_TEMPLATE(
    "a cell that keeps a value is frozen as soon as the force has gone by ten deviations and 2 %", Scalar,
    float, double) {
  struct Case {
    double sd, force, least;
  };
  // Two percent of the force at the end, or ten deviations: the larger.
  for (const Case& each : {Case{1, 1000, 1000 / 0.98 - 1000}, Case{5, 1000, 50}, Case{0.5, 100, 5}}) {
    CAPTURE(each.sd);
    CAPTURE(each.force);
    auto watch = watch_of<Scalar>(each.sd);
    for (int i = 0; i < 5; ++i) take(watch, each.force, each.force);
    take(watch, each.force, each.force + 0.99 * each.least);
    CHECK_FALSE(watch.is_frozen);
    take(watch, each.force, each.force + 1.01 * each.least);
    CHECK(watch.is_frozen);
    CHECK(watch.stays_frozen(static_cast<Scalar>(each.force)));
    CHECK_FALSE(watch.stays_frozen(static_cast<Scalar>(each.force + 1)));
  }
}

TEST_CASE("it is frozen from the third reading on, not before, whichever way the force goes") {
  for (const double way : {-1.0, 1.0}) {
    CAPTURE(way);
    auto watch = watch_of<double>(1);
    take(watch, 1000, 1000);
    CHECK_FALSE(watch.is_frozen);
    take(watch, 1000, 1000 + 300 * way);
    CHECK_FALSE(watch.is_frozen);
    take(watch, 1000, 1000 + 600 * way);
    CHECK(watch.is_frozen);
  }
  // Zero is a value as any other: a cable that was let go.
  auto watch = watch_of<double>(1);
  for (const double force : {0.0, 300.0}) take(watch, 0, force);
  CHECK_FALSE(watch.is_frozen);
  take(watch, 0, 600);
  CHECK(watch.is_frozen);
}

TEST_CASE("the way counts from where the value was first read, however slowly the force goes") {
  auto watch = watch_of<double>(1);
  int row = 0;
  for (; row < 1000 && !watch.is_frozen; ++row) take(watch, 1000, 1000 + 0.5 * row);
  // 20.5 beyond 1000 is more than 2 %.
  CHECK(row == 42);
}

TEST_CASE("a cell that froze after a long noisy ramp is found as soon as one that never scattered") {
  for (const double dt : {0.05, 0.2, 1.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(dt);
      CAPTURE(seed);
      support::Random random(seed);
      auto watch = watch_of<double>(10);
      int row = 0;
      for (; row < 90; ++row) {
        const double force = 1000 + 0.8 * row, reading = force + 10 * support::gaussian(random);
        static_cast<void>(watch.follow_noise(reading, dt));
        watch.take(reading, force, 0, watch.sd * watch.sd);
      }
      const double stuck = watch.last, began = watch.expected;
      double force = began;
      while (!watch.is_frozen && row < 1000) {
        force = 1000 + 0.8 * row++;
        static_cast<void>(watch.follow_noise(stuck, dt));
        watch.take(stuck, force, 0, watch.sd * watch.sd);
      }
      CHECK(force - began < 10 * 10 + 1);
    }
}

TEST_CASE("a cell that rests because the force rests is not frozen") {
  auto watch = watch_of<double>(1);
  for (int i = 0; i < 100000; ++i) {
    take(watch, 1000, 1000);
    REQUIRE_FALSE(watch.is_frozen);
  }
  // Nor where what it reads is off: that is a misfit.
  for (const double reading : {0.0, 900.0}) {
    CAPTURE(reading);
    auto off = watch_of<double>(1);
    for (int i = 0; i < 300; ++i) take(off, reading, 1000);
    CHECK_FALSE(off.is_frozen);
    CHECK(off.fit.misfit() == doctest::Approx(1000 - reading));
  }
  // Nor where its force is uncertain by less than that.
  support::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    take(watch, 1000, 1000 + 3 * support::gaussian(random));
    REQUIRE_FALSE(watch.is_frozen);
  }
  // Ten deviations of a small force are no two percent of a large one, and the other way round.
  auto large = watch_of<double>(1), noisy = watch_of<double>(100);
  for (int i = 0; i < 100; ++i) {
    take(large, 1e5, 1e5 + 19 * i);
    take(noisy, 1000, 1000 + 9 * i);
  }
  CHECK_FALSE(large.is_frozen);
  CHECK_FALSE(noisy.is_frozen);
}

TEST_CASE("a cell that reads nearly the same is not frozen") {
  auto watch = watch_of<double>(1);
  for (int i = 0; i < 1000; ++i) {
    take(watch, 1000 + 1e-9 * (i % 2), 1000 + i);
    REQUIRE_FALSE(watch.is_frozen);
  }
}

TEST_CASE("a new value ends it, and what it read while it was frozen is no misfit") {
  auto watch = watch_of<double>(1);
  const auto freeze = [&] {
    for (int i = 0; i < 15; ++i) take(watch, 1000, 1000 + 1.3 * i);
    CHECK_FALSE(watch.is_frozen);
    CHECK(watch.fit.misfit() > 5);
    for (int i = 15; i < 18; ++i) take(watch, 1000, 1000 + 1.3 * i);
    CHECK(watch.is_frozen);
    // That widens no interval any more.
    CHECK(watch.fit.misfit() == 0);
  };
  freeze();
  // Where the force goes on at another rate.
  watch.noise.bend();
  take(watch, 1050, 1050);
  CHECK_FALSE(watch.is_frozen);
  CHECK_FALSE(watch.stays_frozen(1050));
  CHECK(watch.fit.misfit() == 0);
  for (int i = 0; i < 40; ++i) {
    take(watch, 1050 + i, 1050 + i);
    REQUIRE(watch.fit.misfit() == 0);
  }
  // It can freeze again.
  freeze();
}

TEST_CASE("a misfit of a cell that lives is not forgotten with its next value") {
  auto watch = watch_of<double>(1);
  for (int i = 0; i < 300; ++i) take(watch, 1010 + i, 1000 + i);
  CHECK(watch.fit.misfit() == doctest::Approx(10));
}

TEST_CASE("a single reading, however absurd, is no misfit; a second one to the same side is") {
  for (const double absurd : {1e3, 1e9, -1e30}) {
    CAPTURE(absurd);
    auto watch = watch_of<double>(1);
    for (int i = 0; i < 40; ++i) take(watch, 1000, 1000);
    take(watch, 1000 + absurd, 1000);
    CHECK(watch.fit.misfit() == 0);
    for (int i = 0; i < 40; ++i) {
      take(watch, 1000 + (i % 2 == 0 ? -absurd : absurd), 1000);
      take(watch, 1000, 1000);
    }
    CHECK(watch.fit.misfit() == 0);
    take(watch, 1000 + absurd, 1000);
    take(watch, 1000 + absurd, 1000);
    CHECK(watch.fit.misfit() > std::fabs(absurd) / 32);
  }
}

TEST_CASE("a display in coarse steps is not frozen where its noise level knows of them, and else is") {
  for (const double step : {100.0, 1000.0, 5000.0}) {
    CAPTURE(step);
    const double from = 10 * step;
    auto knows = watch_of<double>(step / std::sqrt(12.0)), does_not = watch_of<double>(0.01 * step);
    bool was_frozen = false;
    // Up and down again, by many rows a step.
    for (int i = 0; i <= 4000; ++i) {
      const double force = from + 0.01 * step * (i < 2000 ? i : 4000 - i),
                   reading = step * std::floor(force / step);
      take(knows, reading, force);
      take(does_not, reading, force);
      REQUIRE_FALSE(knows.is_frozen);
      was_frozen |= does_not.is_frozen;
    }
    CHECK(was_frozen);
  }
  // Steps of three deviations are finer than ten; of twelve, they are not.
  for (const double step : {3.0, 12.0}) {
    CAPTURE(step);
    auto watch = watch_of<double>(1);
    bool was_frozen = false;
    for (int i = 0; i < 1000; ++i) {
      const double force = 100 + 0.1 * i;
      take(watch, step * std::floor(force / step), force);
      was_frozen |= watch.is_frozen;
    }
    CHECK(was_frozen == (step > 10));
  }
}

TEST_CASE("noise that is found in the readings counts, not only what was said of it") {
  // It scatters by 100 and keeps a value by chance, while the force goes by 300: of one deviation that is
  // far.
  for (const double truth : {1.0, 100.0}) {
    CAPTURE(truth);
    auto watch = watch_of<double>(1);
    support::Random random(3);
    for (int i = 0; i < 2000; ++i) take(watch, 1000 + truth * support::gaussian(random), 1000);
    for (int i = 0; i < 4; ++i) take(watch, 1000, 1000 + 100 * i);
    CHECK(watch.is_frozen == (truth < 10));
  }
}

TEST_CASE("a start forgets everything") {
  auto watch = watch_of<double>(1);
  for (int i = 0; i < 40; ++i) take(watch, 1000, 1000 + 100 * i);
  CHECK(watch.is_frozen);
  watch.is_told = true;
  watch.start(2);
  CHECK_FALSE(watch.is_frozen);
  CHECK_FALSE(watch.is_told);
  CHECK(watch.fit.misfit() == 0);
  CHECK(watch.sd == 2);
  take(watch, 1000, 5000);
  take(watch, 1000, 1000);
  CHECK_FALSE(watch.is_frozen);
}

TEST_CASE("a cell does not live only if the force surely has gone on, not where that is in doubt") {
  // At a turn the far end rests while it is not known yet which joints stick.
  for (const double deviation : {100.0, 10.0}) {
    auto watch = watch_of<double>(1);
    for (int i = 0; i < 5; ++i) take(watch, 1000, 1000);
    take(watch, 1000, 1100, deviation * deviation);
    CHECK(watch.is_frozen == (deviation < 50));
  }
}

}  // namespace cell_watch_test
