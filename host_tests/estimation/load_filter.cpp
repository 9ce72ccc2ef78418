// The load filter against loads that are known: what it says of them, how surely, and what noise does to it.
#include "taut/estimation/load_filter.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "support/random.hpp"

namespace load_filter_test {
using taut::ConditionedLoad;
using taut::LoadFilter;

namespace {

constexpr double sigma = 1000;  ///< of a reading [N]

/// Standard normal numbers, and others.
class Noise {
 public:
  explicit Noise(int seed) : random_(static_cast<std::uint64_t>(seed) + 1) {}
  double operator()() { return support::gaussian(random_); }
  /// Log-uniform in [low, high).
  double of_magnitude(double low, double high) {
    return std::exp(random_.between(std::log(low), std::log(high)));
  }
  double between(double low, double high) { return random_.between(low, high); }
  int below(int bound) { return random_.below(bound); }

 private:
  support::Random random_;
};

/// What the filter says, in standard deviations of a reading.
struct Said {
  double load, sd, confirmed, reversal;
  bool reversed, refused, behind;
};

template <class Scalar>
class Bench {
 public:
  explicit Bench(double sd = 1) { filter_.start(static_cast<Scalar>(sd * sigma)); }
  Said take(double reading, double dt = 0.5) {
    const ConditionedLoad<Scalar> now =
        filter_.take(static_cast<Scalar>(reading * sigma), static_cast<Scalar>(dt));
    return {double(now.load) / sigma,
            double(now.sd) / sigma,
            double(now.confirmed) / sigma,
            double(now.reversal) / sigma,
            now.reversed,
            now.refused,
            now.behind};
  }

 private:
  LoadFilter<Scalar> filter_;
};

bool covers(const Said& said, double truth) { return std::fabs(said.load - truth) <= 1.96 * said.sd; }

/// A load in time, in standard deviations of a reading.
struct Path {
  std::vector<double> load;
  double now = 0;
  void go(double slope, int samples) {
    for (int i = 0; i < samples; ++i) {
      now = std::max(0.0, now + slope);
      load.push_back(now);
    }
  }
};

/// Ramps from 0.02 to 5 sigma a sample, holds, steps and releases, of 10 to 1000 samples each.
Path random_path(Noise& noise) {
  Path path;
  path.now = noise.below(2) == 0 ? 0 : noise.between(0, 100);
  const int pieces = 3 + noise.below(8);
  for (int p = 0; p < pieces; ++p) {
    const int samples = static_cast<int>(noise.of_magnitude(10, 1000));
    const int kind = noise.below(8);
    const double sign = noise.below(5) < 3 ? 1 : -1;
    if (kind < 3) path.go(0, samples);
    if (kind >= 3 && kind < 6) path.go(sign * noise.of_magnitude(0.02, 5), samples);
    if (kind == 6) {
      path.now = std::max(0.0, path.now + sign * noise.between(20, 200));
      path.go(0, samples);
    }
    if (kind == 7) path.go(-noise.between(1, 5), samples);
  }
  return path;
}

}  // namespace

TEST_CASE("the filter is small and can be stored byte by byte") {
  // Four lines are 180 of them, sixteen readings that wait and their times 128, what follows them 52, how far
  // the load has come 16.
  static_assert(sizeof(LoadFilter<float>) <= 432);
  static_assert(std::is_trivially_copyable_v<LoadFilter<float>>);
  Noise noise(1);
  LoadFilter<float> filter, restored;
  filter.start(1);
  for (int i = 0; i < 300; ++i) filter.take(static_cast<float>(50 + noise()), 1);
  std::memcpy(&restored, &filter, sizeof(filter));
  for (int i = 0; i < 300; ++i) {
    const auto reading = static_cast<float>(50 + 0.3 * i + noise());
    const auto a = filter.take(reading, 1), b = restored.take(reading, 1);
    REQUIRE(a.load == b.load);
    REQUIRE(a.confirmed == b.confirmed);
  }
}

TEST_CASE_TEMPLATE("exact readings are the load, and every change of direction is a turn", Scalar, float,
                   double) {
  LoadFilter<Scalar> filter;
  filter.start(0);
  const std::array<int, 9> readings = {3, 5, 5, 2, 2, 1, 4, -1, 6};
  const std::array<int, 9> turns = {-1, -1, -1, 5, -1, -1, 1, 4, 0};
  for (std::size_t i = 0; i < readings.size(); ++i) {
    CAPTURE(i);
    const auto now = filter.take(static_cast<Scalar>(readings[i]), 1);
    CHECK(now.load == std::max(0, readings[i]));
    CHECK(now.confirmed == now.load);
    CHECK(now.sd == 0);
    CHECK(now.reversed == (turns[i] >= 0));
    if (now.reversed) CHECK(now.reversal == turns[i]);
  }
}

TEST_CASE_TEMPLATE("the load does not lag behind a ramp", Scalar, float, double) {
  for (const double slope : {0.02, 0.1, 0.5, 2.0, 5.0, 100.0}) {
    CAPTURE(slope);
    double error = 0, behind = 0;
    int samples = 0;
    for (int seed = 0; seed < 200; ++seed) {
      Noise noise(seed);
      Bench<Scalar> bench;
      for (int i = 0; i < 500; ++i) {
        const double truth = 20 + slope * i;
        const Said said = bench.take(truth + noise());
        if (i < 20) continue;
        error += said.load - truth;
        behind += truth - said.confirmed;
        ++samples;
      }
    }
    // 200 independent ramps, each with an error of about 0.2: 0.1 is seven times what chance would do.
    CHECK(std::fabs(error / samples) < 0.1);
    CHECK(behind / samples > 0);
    CHECK(behind / samples < 6);
  }
}

TEST_CASE("times that are not even are allowed for: a ramp is followed without lag, and known as well") {
  // Around one, a logger's jitter, and now and then a pause of up to a minute.
  double error = 0, square = 0, of_even = 0;
  int samples = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Noise noise(seed);
    Bench<double> bench, even;
    double time = 0;
    for (int i = 0; i < 500; ++i) {
      const double dt = noise.below(50) == 0 ? noise.between(2, 60) : noise.between(0.8, 1.2);
      time += dt;
      const double truth = 20 + 0.3 * time;
      const Said said = bench.take(truth + noise(), dt);
      const double as_even = 20 + 0.3 * i;
      const double off = even.take(as_even + noise(), 1).load - as_even;
      if (i < 50) continue;
      error += said.load - truth;
      square += (said.load - truth) * (said.load - truth);
      of_even += off * off;
      ++samples;
    }
  }
  CHECK(std::fabs(error / samples) < 0.05);
  // A pause makes the slope a little better known, and a bend after it likelier.
  CHECK(std::sqrt(square / samples) < 1.2 * std::sqrt(of_even / samples));
}

/// Calls check(what the filter says, what it said before, the way that the load went until then: up or down)
/// at every sample of 300 random logs with outliers.
template <class Check>
void follow_random_logs(const Check& check) {
  for (int seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    Noise noise(seed);
    const Path path = random_path(noise);
    Bench<double> bench;
    Said before{};
    double way = 1;
    for (const double truth : path.load) {
      const bool is_outlier = !before.refused && noise.below(200) == 0;
      const Said said = bench.take(truth + noise() + (is_outlier ? noise.between(-100, 100) : 0));
      check(said, before, way);
      if (said.reversed) way = -way;
      before = said;
    }
  }
}

TEST_CASE(
    "the confirmed load goes one way until it turns, and never turns short of where it had surely been") {
  int turns = 0;
  follow_random_logs([&](const Said& said, const Said& before, double way) {
    if (said.reversed) {
      REQUIRE(way * (said.reversal - before.confirmed) >= 0);
      REQUIRE(way * (said.reversal - said.confirmed) >= 0);
      ++turns;
    } else {
      REQUIRE(way * (said.confirmed - before.confirmed) >= 0);
      if (said.refused) REQUIRE(said.confirmed == before.confirmed);
    }
  });
  CHECK(turns > 300);
}

TEST_CASE("a load is behind if it has not come as far as it surely had, the way that it goes") {
  int behind = 0, samples = 0;
  follow_random_logs([&](const Said& said, const Said&, double way) {
    const double further = (said.reversed ? -way : way) * (said.load - said.confirmed);
    // The filter compares in single precision.
    if (std::fabs(further) > 1e-4) REQUIRE(said.behind == (further < 0));
    if (said.load == 0 && said.confirmed == 0) REQUIRE_FALSE(said.behind);
    behind += said.behind ? 1 : 0;
    ++samples;
  });
  CHECK(behind > samples / 100);
  CHECK(behind < samples / 4);
}

TEST_CASE("a load that begins to rise after a hold is followed without lag") {
  for (const double slope : {0.02, 0.1, 0.5, 2.0, 5.0, 20.0}) {
    CAPTURE(slope);
    double error = 0;
    for (int seed = 0; seed < 200; ++seed) {
      Noise noise(seed);
      Bench<double> bench;
      for (int i = 0; i < 700; ++i) {
        const double truth = 20 + slope * std::max(0, i - 200);
        const Said said = bench.take(truth + noise());
        if (i >= 220) error += said.load - truth;
      }
    }
    CHECK(std::fabs(error / (200 * 480)) < 0.1);
  }
}

TEST_CASE("where a ramp ends the confirmed load does not overshoot") {
  // With 1 % noise 0.2 % of the load is 0.2 sigma.
  int overshot = 0, turns = 0;
  constexpr int seeds = 4000;
  for (int seed = 0; seed < seeds; ++seed) {
    Noise noise(seed);
    Bench<float> bench;
    const double slope = noise.of_magnitude(0.02, 5);
    double most = 0;
    for (int i = 0; i < 400; ++i) {
      const Said said = bench.take(std::max(0.0, 100 - slope * std::max(0, 150 - i)) + noise());
      most = std::max(most, said.confirmed);
      turns += said.reversed ? 1 : 0;
    }
    overshot += most > 100.2 ? 1 : 0;
  }
  CHECK(overshot <= seeds / 1000);
  CHECK(turns <= seeds / 1000);
}

TEST_CASE_TEMPLATE("in a hold of a million samples nothing drifts", Scalar, float, double) {
  Noise noise(3);
  Bench<Scalar> bench;
  double confirmed = 0, square = 0;
  int turns = 0, astray = 0;
  Said said = {};
  for (int i = 0; i < 1000000; ++i) {
    said = bench.take(100 + noise());
    REQUIRE(said.confirmed >= confirmed);
    confirmed = said.confirmed;
    turns += said.reversed ? 1 : 0;
    if (i < 20000) continue;
    square += (said.load - 100) * (said.load - 100);
    astray += std::fabs(said.load - 100) > 0.2 ? 1 : 0;
  }
  CHECK(turns == 0);
  CHECK(std::fabs(said.load - 100) < 0.2);
  CHECK(std::fabs(confirmed - 100) < 0.2);
  // The memory is 2048 readings: a line through them is known to 2 / sqrt(2048) = 0.044.
  CHECK(std::sqrt(square / 980000) < 0.05);
  // A reading beyond 4 sigma, one in 16,000, may be a bend until the next one: a few samples each.
  CHECK(astray < 1000);
}

namespace {

/// How far the load that is told is from that of a hold once it is well known, root mean square.
template <class Scalar>
double error_of_hold(double load) {
  Noise noise(4);
  LoadFilter<Scalar> filter;
  filter.start(1);
  double square = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto now = filter.take(static_cast<Scalar>(load + noise()), 1);
    if (i >= 20000) square += (double(now.load) - load) * (double(now.load) - load);
  }
  return std::sqrt(square / 80000);
}

}  // namespace

TEST_CASE("a hold in float is known as well when the load is a million times the noise") {
  // Readings have steps of 1/16, and so has the answer.
  CHECK(error_of_hold<float>(1e6) < 0.05 + 1.0 / 16);
}

TEST_CASE("in double a hold is known as well when the load is a hundred million times the noise") {
  // The lines are in single precision, which has steps of 8 there.
  CHECK(error_of_hold<double>(1e8) < 0.05);
}

TEST_CASE("a reading that is finite in double alone is refused and does no harm") {
  Noise noise(5);
  LoadFilter<double> filter;
  filter.start(1e-3);
  for (int i = 0; i < 300; ++i) {
    const bool bad = i % 50 == 49;
    const auto now = filter.take(bad ? 1e305 : 50 + 1e-3 * noise(), 1);
    REQUIRE(now.refused == bad);
    REQUIRE(std::fabs(now.load - 50) < 5e-3);
  }
}

TEST_CASE("slow creep of a hold is followed") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    Noise noise(5);
    Bench<float> bench;
    double error = 0;
    int turns = 0;
    for (int i = 0; i < 100000; ++i) {
      const double truth = 100 + sign * i / 5000;
      const Said said = bench.take(truth + noise());
      turns += said.reversed ? 1 : 0;
      if (i < 5000) continue;
      error += std::fabs(said.load - truth);
      REQUIRE(std::fabs(said.confirmed - truth) < 2);
    }
    CHECK(error / 95000 < 0.05);
    CHECK(turns == (sign < 0 ? 1 : 0));
  }
}

TEST_CASE_TEMPLATE("after a gap of any length the load is what is read", Scalar, float, double) {
  for (const double gap : {1e3, 1e6, 1e9, 1e12, 1e20, 1e30, 1e38}) {
    CAPTURE(gap);
    Noise noise(9);
    LoadFilter<Scalar> filter;
    filter.start(1);
    for (int i = 0; i < 300; ++i) filter.take(static_cast<Scalar>(0.3 * i + noise()), 1);
    Scalar dt = static_cast<Scalar>(gap);
    ConditionedLoad<Scalar> now;
    for (int i = 0; i < 50; ++i, dt = 1) {
      now = filter.take(static_cast<Scalar>(200 + noise()), dt);
      REQUIRE(std::isfinite(now.load));
      REQUIRE(std::isfinite(now.sd));
    }
    CHECK(std::fabs(double(now.load) - 200) < 1);
    CHECK(double(now.confirmed) > 190);
    CHECK(double(now.confirmed) < 201);
  }
}

TEST_CASE("a step is refused once and then not smeared") {
  for (const double height : {20.0, 50.0, 200.0, -20.0, -50.0, -90.0}) {
    CAPTURE(height);
    std::array<int, 4> refused = {}, far_off = {};
    int turns = 0;
    constexpr int seeds = 500;
    for (int seed = 0; seed < seeds; ++seed) {
      Noise noise(seed);
      Bench<double> bench;
      for (int i = 0; i < 54; ++i) {
        const double truth = i < 50 ? 100 : 100 + height;
        const Said said = bench.take(truth + noise());
        turns += said.reversed ? 1 : 0;
        if (i < 50) continue;
        const auto since = static_cast<std::size_t>(i - 50);
        refused[since] += said.refused ? 1 : 0;
        far_off[since] += std::fabs(said.load - truth) > 3 ? 1 : 0;
      }
    }
    CHECK(refused[1] <= seeds / 100);
    CHECK(refused[2] == 0);
    // A single reading is beyond 3 sigma once in 370.
    CHECK(far_off[2] <= seeds / 100);
    CHECK(far_off[3] <= seeds / 100);
    CHECK(turns == (height < 0 ? seeds : 0));
  }
}

TEST_CASE("in a coarse log every row is a new stage") {
  Noise noise(6);
  Bench<double> bench;
  for (const double truth : {50.0, 120.0, 180.0, 300.0, 280.0, 400.0, 500.0, 520.0, 700.0, 450.0, 300.0}) {
    CAPTURE(truth);
    const double reading = truth + noise();
    const Said said = bench.take(reading);
    CHECK_FALSE(said.refused);
    CHECK(std::fabs(said.load - reading) < 1);
  }
}

TEST_CASE("single outliers are refused and move nothing") {
  for (const double slope : {0.0, 0.05, 1.0}) {
    CAPTURE(slope);
    int missed = 0, moved = 0, refused_in_vain = 0, turns = 0;
    for (int seed = 0; seed < 200; ++seed) {
      Noise noise(seed);
      Bench<float> bench;
      double confirmed = 0;
      bool was_outlier = false;
      for (int i = 0; i < 1000; ++i) {
        const double truth = 100 + slope * i;
        const bool outlier = i > 20 && !was_outlier && noise.between(0, 1) < 0.005;
        const std::array<double, 4> readings = {0, 2 * truth, truth + 50, truth - 50};
        const double reading = outlier ? readings[static_cast<std::size_t>(noise.below(4))] : truth;
        const Said said = bench.take(reading + noise());
        if (outlier) {
          missed += said.refused ? 0 : 1;
          moved += said.confirmed != confirmed || said.reversed ? 1 : 0;
        } else {
          refused_in_vain += said.refused ? 1 : 0;
        }
        turns += said.reversed ? 1 : 0;
        confirmed = said.confirmed;
        was_outlier = outlier;
      }
    }
    CHECK(missed == 0);
    CHECK(moved == 0);
    CHECK(turns == 0);
    // Of 200,000 Gaussian readings 0.1 are beyond 5 sigma; young lines are less certain.
    CHECK(refused_in_vain <= 10);
  }
}

TEST_CASE("turns are counted right and placed well") {
  for (const double slope : {0.1, 0.3, 1.0, 5.0, 20.0})
    for (const int hold : {0, 100}) {
      CAPTURE(slope);
      CAPTURE(hold);
      const int samples = static_cast<int>(std::max(20.0, 20 / slope));
      int wrong = 0, turns = 0, near = 0;
      double square = 0;
      for (int seed = 0; seed < 1000; ++seed) {
        Noise noise(seed);
        Bench<double> bench;
        Path path;
        path.now = 40;
        std::vector<double> corners;
        for (int leg = 0; leg < 5; ++leg) {
          path.go(leg % 2 == 0 ? slope : -slope, samples);
          corners.push_back(path.now);
          if (leg < 4) path.go(0, hold);
        }
        std::size_t turn = 0;
        for (const double truth : path.load) {
          const Said said = bench.take(truth + noise());
          if (!said.reversed) continue;
          if (turn < 4) {
            const double error = said.reversal - corners[turn];
            square += error * error;
            near += std::fabs(error) < 3 ? 1 : 0;
            ++turns;
          }
          ++turn;
        }
        wrong += turn != 4 ? 1 : 0;
      }
      CHECK(wrong == 0);
      CHECK(near >= 0.99 * turns);
      // A hundred readings are known to 0.1; slopes below 0.2 hide where the hold ended.
      if (hold > 0) CHECK(std::sqrt(square / turns) < 0.3);
    }
}

TEST_CASE("a hold does not turn") {
  int turns = 0;
  for (int seed = 0; seed < 20; ++seed) {
    Noise noise(seed);
    Bench<float> bench;
    for (int i = 0; i < 100000; ++i) turns += bench.take(100 + noise()).reversed ? 1 : 0;
  }
  CHECK(turns == 0);
}

TEST_CASE("an unloaded cell stays at zero") {
  Noise noise(7);
  Bench<float> bench;
  for (int i = 0; i < 10000; ++i) {
    const Said said = bench.take(noise());
    REQUIRE(said.load >= 0);
    REQUIRE(said.confirmed >= 0);
    REQUIRE(said.confirmed < 0.2);
    REQUIRE_FALSE(said.reversed);
  }
}

TEST_CASE_TEMPLATE("intervals of 95 % hold the truth in 93 to 97.5 % of the samples of random logs", Scalar,
                   float, double) {
  // 300 logs of some 1400 samples. Errors last as long as the pieces do: the share is known to about 0.5 %.
  long samples = 0, covered = 0;
  for (int seed = 0; seed < 300; ++seed) {
    Noise noise(seed);
    const Path path = random_path(noise);
    const double step = noise.below(2) == 0 ? 0 : noise.between(0.01, 2);
    Bench<Scalar> bench(std::sqrt(1 + step * step / 12));
    for (const double truth : path.load) {
      const double reading = truth + noise();
      const Said said = bench.take(step > 0 ? step * std::round(reading / step) : reading);
      covered += covers(said, truth) ? 1 : 0;
      ++samples;
    }
  }
  const double share = double(covered) / double(samples);
  CAPTURE(share);
  CHECK(share > 0.93);
  CHECK(share < 0.975);
}

TEST_CASE_TEMPLATE("what is not finite is refused and does no harm", Scalar, float, double) {
  using Limits = std::numeric_limits<Scalar>;
  for (const Scalar sd : {Scalar(0), Scalar(1)}) {
    CAPTURE(sd);
    Noise noise(8);
    LoadFilter<Scalar> filter;
    filter.start(sd);
    for (int i = 0; i < 1000; ++i) {
      const double truth = 50 + 0.2 * i;
      const bool bad = i % 10 == 0;
      const Scalar reading = !bad          ? static_cast<Scalar>(truth + double(sd) * noise())
                             : i % 20 == 0 ? Limits::quiet_NaN()
                             : i % 30 == 0 ? Limits::infinity()
                                           : -Limits::infinity();
      const auto now = filter.take(reading, 1);
      REQUIRE(std::isfinite(now.load));
      REQUIRE(std::isfinite(now.sd));
      REQUIRE(std::isfinite(now.confirmed));
      REQUIRE(now.refused == bad);
      REQUIRE_FALSE(now.reversed);
      // An exact reading that is missing leaves the one before, 0.2 lower.
      if (i > 20) REQUIRE(std::fabs(double(now.load) - truth) < 0.21 + 5 * double(now.sd));
    }
  }
}

TEST_CASE_TEMPLATE("readings in no time are as far apart as those before, wherever they come", Scalar, float,
                   double) {
  for (const Scalar none : {Scalar(0), Scalar(-5), Scalar(1e-35), std::numeric_limits<Scalar>::quiet_NaN()})
    for (const double jump : {0.0, 30.0, 300.0})
      for (const int where : {0, 1, 2, 5, 12, 40, 90}) {
        CAPTURE(none);
        CAPTURE(jump);
        CAPTURE(where);
        Noise noise(8);
        LoadFilter<Scalar> filter, even;
        filter.start(1);
        even.start(1);
        for (int i = 0; i < 120; ++i) {
          const auto reading =
              static_cast<Scalar>(50 + 2 * (i < 60 ? i : 60) + (i >= where ? jump : 0) + noise());
          const auto now = filter.take(reading, i == where ? none : Scalar(1)),
                     as_even = even.take(reading, 1);
          REQUIRE(std::isfinite(now.load));
          REQUIRE(std::isfinite(now.sd));
          if (i <= where || where < 12) REQUIRE(std::fabs(double(now.load - as_even.load)) < 3);
        }
      }
}

}  // namespace load_filter_test
