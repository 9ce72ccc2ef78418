// The load filter where readings do not come evenly: pauses, bursts, other rates, and anything at all.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "estimation/watched_filter.hpp"
#include "support/random.hpp"
#include "taut/estimation/load_filter.hpp"

namespace load_gaps_test {
using support::gaussian;
using support::Random;
using taut::ConditionedLoad;
using taut::LoadFilter;

namespace {

// Loads are in standard deviations of a reading, times in the step that is usual at first.

template <class Number>
Number of_magnitude(Random& random, Number low, Number high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

/// A jack that has gone up for a hundred samples.
class Ramp {
 public:
  Ramp(int seed, double slope) : random_(static_cast<std::uint64_t>(seed) + 1), slope_(slope) {
    filter_.start(1);
    for (int i = 0; i < 100; ++i) at(20 + slope_ * i, 1);
  }
  double end() const { return 20 + slope_ * 99; }
  /// The load comes there.
  const ConditionedLoad<float>& at(double load, double dt) { return read(load + gaussian(random_), dt); }
  const ConditionedLoad<float>& read(double reading, double dt) {
    now_ = filter_.take(static_cast<float>(reading), static_cast<float>(dt));
    return now_;
  }
  const ConditionedLoad<float>& now() const { return now_; }

 private:
  Random random_;
  double slope_;
  LoadFilter<float> filter_;
  ConditionedLoad<float> now_;
};

/// Of many samples: how many intervals of 95 % hold the truth, and how many readings were refused.
struct Tally {
  int samples = 0, covered = 0, refused = 0;
  double worst = 0;
  void add(const ConditionedLoad<float>& now, double truth) {
    const double off = std::fabs(static_cast<double>(now.load) - truth);
    ++samples;
    covered += off <= 1.96 * static_cast<double>(now.sd) ? 1 : 0;
    refused += now.refused ? 1 : 0;
    worst = std::max(worst, off);
  }
  double share() const { return static_cast<double>(covered) / samples; }
};

constexpr float none = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("after a pause the load is what is read: whether it stayed, went on or came back meanwhile") {
  for (const double gap : {10.0, 60.0, 600.0, 3600.0, 1e5})
    for (const double slope : {1.0, 2.0, 20.0})
      for (const double moved : {0.0, 1.0, -1.0}) {
        CAPTURE(gap);
        CAPTURE(slope);
        CAPTURE(moved);
        Tally first, then;
        for (int seed = 0; seed < 400; ++seed) {
          Ramp ramp(seed, slope);
          const double truth = ramp.end() + (moved < 0 ? -15 : moved * slope * gap);
          first.add(ramp.at(truth, gap), truth);
          for (int i = 0; i < 5; ++i) then.add(ramp.at(truth, 1), truth);
        }
        CHECK(first.refused == 0);
        // Single readings in 400: the largest is off by 3 sigma; one in 400,000 is by 4.5.
        CHECK(first.worst < 4.5);
        CHECK(first.share() > 0.93);
        CHECK(then.refused == 0);
      }
}

TEST_CASE("a reading that is refused leaves the load where it was, and less certain") {
  for (const double reading : {static_cast<double>(none), 1e30, 500.0}) {
    CAPTURE(reading);
    double square = 0;
    for (int seed = 0; seed < 100; ++seed) {
      Ramp ramp(seed, 1);
      const ConditionedLoad<float> before = ramp.now();
      const ConditionedLoad<float> now = ramp.read(reading, 1);
      REQUIRE(now.refused);
      const double moved = static_cast<double>((now.load - before.load) / before.sd);
      square += moved * moved / 100;
      CHECK(now.confirmed == before.confirmed);
      CHECK(now.sd > before.sd);
      // It may have gone on meanwhile.
      CHECK(std::fabs(now.load - static_cast<float>(ramp.end() + 1)) < 3 * now.sd);
    }
    // Readings that have waited until now may move it a little.
    CHECK(std::sqrt(square) < 0.3);
  }
}

TEST_CASE("while nothing is read the load stays, and becomes less certain until it is read again") {
  for (int seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Ramp ramp(seed, 2);
    const ConditionedLoad<float> before = ramp.read(static_cast<double>(none), 1);
    float sd = before.sd;
    for (int i = 0; i < 3600; ++i) {
      const ConditionedLoad<float> now = ramp.read(static_cast<double>(none), 1);
      REQUIRE(now.refused);
      REQUIRE(now.load == before.load);
      REQUIRE(now.sd >= sd);
      sd = now.sd;
    }
    // As far again as the ramp had come, or a likelier part of it.
    CHECK(sd > 50);
    CHECK(sd < 250);
    const ConditionedLoad<float> now = ramp.at(ramp.end(), 1);
    CHECK_FALSE(now.refused);
    CHECK(std::fabs(now.load - static_cast<float>(ramp.end())) < 4.5f);
    CHECK(now.sd < 1.1f);
  }
}

TEST_CASE("bursts between long pauses are followed") {
  Tally tally;
  for (int seed = 0; seed < 100; ++seed) {
    Ramp ramp(seed, 1);
    for (int burst = 0; burst < 40; ++burst)
      for (int i = 0; i < 3; ++i) {
        // Every tenth pause the jack goes on.
        const double truth = ramp.end() + 20 * (burst / 10);
        tally.add(ramp.at(truth, i == 0 ? 43200 : 1), truth);
      }
  }
  CHECK(tally.refused == 0);
  CHECK(tally.worst < 6);
  CHECK(tally.share() > 0.93);
}

TEST_CASE("readings that come at another rate from now on are followed as those before") {
  for (const double rate : {1e-3, 0.1, 10.0, 3600.0, 1e6}) {
    CAPTURE(rate);
    Tally tally;
    for (int seed = 0; seed < 200; ++seed) {
      Ramp ramp(seed, 1);
      double truth = ramp.end();
      for (int i = 0; i < 200; ++i) tally.add(ramp.at(truth, rate), truth);
      // A ramp and a hold in the new time.
      for (int i = 0; i < 100; ++i) {
        truth += 0.5;
        tally.add(ramp.at(truth, rate), truth);
      }
      for (int i = 0; i < 100; ++i) tally.add(ramp.at(truth, rate), truth);
    }
    CHECK(tally.refused < tally.samples / 10000);
    CHECK(tally.worst < 6);
    CHECK(tally.share() > 0.93);
  }
}

TEST_CASE("intervals of 95 % hold the truth where times are as uneven as can be") {
  // Steps that vary by a factor of twenty either way, and pauses of up to ten minutes.
  const std::array<double, 2> spreads = {1.5, 0};
  for (const double spread : spreads) {
    CAPTURE(spread);
    Tally tally;
    for (int seed = 0; seed < 400; ++seed) {
      Random random(static_cast<std::uint64_t>(seed) + 1);
      LoadFilter<float> filter;
      filter.start(1);
      double load = 50, slope = 0, left = 0;
      for (int i = 0; i < 1000; ++i) {
        const bool pauses = spread == 0 && random.below(100) == 0;
        const double dt = pauses ? random.between(2, 600) : std::exp(spread * gaussian(random));
        for (double time = dt; time > 0;) {
          if (left <= 0) {
            left = of_magnitude(random, 20.0, 2000.0);
            slope =
                random.below(3) == 0 ? 0 : (random.coin() || load < 30 ? 1 : -1) * random.between(0.02, 1.5);
          }
          const double part = std::min(time, left);
          load = std::max(0.0, load + slope * part);
          time -= part;
          left -= part;
        }
        const auto reading = static_cast<float>(load + gaussian(random));
        tally.add(filter.take(reading, static_cast<float>(dt)), load);
      }
    }
    CHECK(tally.share() > 0.93);
    CHECK(tally.refused < tally.samples / 10000);
  }
}

namespace {

/// Loads and times of every size, even for a while, then not; what is no reading, and what can be none.
class Erratic {
 public:
  Erratic(Random& random, double sd) : random_(random), sd_(sd), wildness_(random.below(3)) {}
  double step() {
    if (random_.below(calm()) == 0) {
      const std::array<double, 4> steps = {1, 1e-6, random_.between(0.1, 10), any_step()};
      step_ = steps[static_cast<std::size_t>(random_.below(4))];
    }
    return wildness_ == 2 && random_.below(3) == 0 ? any_step() : step_;
  }
  double reading() {
    if (random_.below(calm()) == 0) {
      const int what = random_.below(4);
      if (what < 2) load_ = what == 0 ? 0 : sd_ * of_magnitude(random_, 1.0, 4e8);
      slope_ = what < 3 ? 0 : sd_ * random_.between(-1, 1) * of_magnitude(random_, 1e-2, 3e3);
    }
    load_ = std::min(std::max(0.0, load_ + slope_), 4e8 * sd_);
    const int odd = random_.below(200);
    if (odd == 0) return std::numeric_limits<double>::quiet_NaN();
    if (odd == 1) return 9.9e37;
    if (odd == 2) return sd_ * of_magnitude(random_, 1.0, 4e8);
    // The same again, without noise, now and then.
    return load_ + (random_.below(4) > 0 ? sd_ * gaussian(random_) : 0);
  }

 private:
  int calm() const { return wildness_ == 0 ? 100 : 10; }
  double any_step() { return of_magnitude(random_, 1e-6, 1e8); }

  Random& random_;
  double sd_;
  int wildness_;
  double step_ = 1, load_ = 0, slope_ = 0;
};

}  // namespace

TEST_CASE_TEMPLATE("whatever is read and whenever, every answer is finite and among the last readings",
                   Scalar, float, double) {
  for (int seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const double sd = of_magnitude(random, 1e-2, 1e4);
    Erratic erratic(random, sd);
    estimation::WatchedFilter<Scalar> filter(static_cast<Scalar>(sd));
    for (int i = 0; i < 2000; ++i) {
      CAPTURE(i);
      const double reading = erratic.reading(), step = erratic.step();
      filter.take(static_cast<Scalar>(reading), static_cast<Scalar>(step));
      REQUIRE(filter.is_sound());
      REQUIRE(filter.refuses_rightly());
      REQUIRE(filter.is_among_readings());
    }
  }
}

}  // namespace load_gaps_test
