// What Consistency calls a misfit, on innovations whose variances are known.
#include "taut/estimation/consistency.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "support/random.hpp"

namespace consistency_test {
using taut::Consistency;

namespace {

/// Readings after which nothing of the first ones is left in the mean, and two means have nothing in common.
constexpr int settled = 160;
/// A mean with the weights 15^i / 16^(i + 1) has the variance of that of so many readings.
constexpr double last_readings = 31;

/// Its mean: where nothing scatters, nothing is chance.
template <class Scalar>
Scalar mean_of(const std::vector<Scalar>& innovations) {
  Consistency<Scalar> fit;
  for (const Scalar each : innovations) fit.take(each, 0, 0);
  return fit.misfit();
}
/// The variance of the mean of `count` white innovations of variance one, by the weight of each.
template <class Scalar>
double variance_of_mean(int count) {
  double variance = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<Scalar> one(static_cast<std::size_t>(count));
    one[static_cast<std::size_t>(i)] = 1;
    const auto weight = static_cast<double>(mean_of(one));
    variance += weight * weight;
  }
  return variance;
}
/// The least mean of `count` innovations with these variances that is a misfit.
template <class Scalar>
double least_misfit(int count, double of_model, double of_noise) {
  double fits = 0, is_off = 100;
  while (is_off - fits > 1e-6 * is_off) {
    const double middle = 0.5 * (fits + is_off);
    Consistency<Scalar> fit;
    for (int i = 0; i < count; ++i)
      fit.take(static_cast<Scalar>(middle), static_cast<Scalar>(of_model), static_cast<Scalar>(of_noise));
    (fit.misfit() > 0 ? is_off : fits) = middle;
  }
  return is_off;
}

struct Variances {
  double of_model, of_noise;
  double of_mean() const { return of_model + of_noise / last_readings; }
};
/// An instrument that is what it says: noise of its own in every reading, and one error of the model.
class Stream {
 public:
  Stream(const Variances& variances, std::uint64_t seed)
      : variances_(variances),
        random_(seed),
        common_(std::sqrt(variances.of_model) * support::gaussian(random_)) {}
  void take(int readings, double shift) {
    for (int i = 0; i < readings; ++i)
      fit_.take(shift + common_ + std::sqrt(variances_.of_noise) * support::gaussian(random_),
                variances_.of_model, variances_.of_noise);
  }
  double misfit() const { return fit_.misfit(); }

 private:
  Variances variances_;
  support::Random random_;
  double common_;
  Consistency<double> fit_;
};

/// Of this many windows; 4.5 standard deviations are 7 in a million, and 1 in 10,000 are 20.
constexpr int windows = 200000;
constexpr int allowed = 20;

}  // namespace

TEST_CASE("of white innovations fewer than 1 in 10,000 windows are a misfit") {
  const std::uint64_t seed = 1;
  CAPTURE(seed);
  Stream stream({0, 4}, seed);
  int misfits = 0;
  for (int i = 0; i < windows; ++i) {
    stream.take(settled, 0);
    misfits += stream.misfit() > 0 ? 1 : 0;
  }
  CHECK(misfits < allowed);
}

TEST_CASE("while the first window fills, it is a misfit no more often") {
  for (const int readings : {8, 12, 15, 16, 20, 24, 31}) {
    CAPTURE(readings);
    int misfits = 0;
    for (std::uint64_t seed = 1; seed <= windows; ++seed) {
      Stream stream({0, 4}, seed);
      stream.take(readings, 0);
      misfits += stream.misfit() > 0 ? 1 : 0;
    }
    CHECK(misfits < allowed);
  }
}

TEST_CASE("an error of the model that all readings share is no misfit more often than that") {
  for (const Variances& variances : {Variances{4, 0}, Variances{4, 4}, Variances{1, 9}}) {
    CAPTURE(variances.of_model);
    CAPTURE(variances.of_noise);
    int misfits = 0;
    for (std::uint64_t seed = 1; seed <= windows; ++seed) {
      Stream stream(variances, seed);
      stream.take(40, 0);
      misfits += stream.misfit() > 0 ? 1 : 0;
    }
    CHECK(misfits < allowed);
  }
}

TEST_CASE("a model that says nothing of an error that readings share is told of it") {
  // Else the two above could be without a test.
  int misfits = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    support::Random random(seed);
    const double common = 2 * support::gaussian(random);
    Consistency<double> fit;
    for (int i = 0; i < 40; ++i) fit.take(common + support::gaussian(random), 0, 1);
    misfits += fit.misfit() > 0 ? 1 : 0;
  }
  // Of a Gaussian of variance 4 so many lie beyond 4.5 / sqrt(31).
  CHECK(std::fabs(misfits / 1000.0 - 0.686) < 0.05);
}

TEST_CASE_TEMPLATE("the mean counts as many readings as its weights do", Scalar, float, double) {
  for (const int count : {settled, 1000}) {
    CAPTURE(count);
    const double brute = variance_of_mean<Scalar>(count);
    CHECK(std::fabs(last_readings * brute - 1) < 1e-3);
    for (const double of_model : {0.0, 0.5}) {
      const double expected = 4.5 * std::sqrt(of_model + brute);
      CHECK(std::fabs(least_misfit<Scalar>(count, of_model, 1) / expected - 1) < 1e-3);
    }
  }
}

TEST_CASE_TEMPLATE("the first readings count as many as there are", Scalar, float, double) {
  for (int count = 8; count <= 64; ++count) {
    CAPTURE(count);
    const double expected = 4.5 * std::sqrt(variance_of_mean<Scalar>(count));
    // A mean that is asked for too little is a false alarm; one that is asked for more comes a little later.
    CHECK(least_misfit<Scalar>(count, 0, 1) > 0.99 * expected);
    CHECK(least_misfit<Scalar>(count, 0, 1) < 1.45 * expected);
  }
}

TEST_CASE("a shift of six deviations is found within the window, wherever it begins") {
  constexpr int seeds = 2000;
  for (const Variances& variances : {Variances{0, 4}, Variances{1, 9}})
    for (const int before : {0, 3, settled}) {
      CAPTURE(variances.of_model);
      CAPTURE(before);
      // Of the mean of sixteen; and of the settled one, which has forgotten the readings before it later.
      const double shift = 6 * std::sqrt(variances.of_model + variances.of_noise / 16),
                   least_shift = 6 * std::sqrt(variances.of_mean());
      int found = 0, found_least = 0;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Stream stream(variances, seed), least(variances, seed);
        stream.take(before, 0);
        least.take(before, 0);
        bool is_found = false, is_least_found = false;
        for (int i = 0; i < 31; ++i) {
          stream.take(1, shift);
          is_found |= stream.misfit() > 0;
        }
        for (int i = 0; i < settled; ++i) {
          least.take(1, -least_shift);
          is_least_found |= least.misfit() > 0;
        }
        found += is_found ? 1 : 0;
        found_least += is_least_found ? 1 : 0;
      }
      CHECK(found > 0.9 * seeds);
      CHECK(found_least > 0.9 * seeds);
    }
}

TEST_CASE("a misfit is as large as what readings are off, whichever way") {
  constexpr int seeds = 1000;
  const Variances variances = {1, 9};
  for (const double shift : {-20.0, 20.0}) {
    CAPTURE(shift);
    double mean = 0, square = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Stream stream(variances, seed);
      stream.take(settled, shift);
      const double off = stream.misfit() - std::fabs(shift);
      mean += off / seeds;
      square += off * off / seeds;
    }
    CHECK(std::fabs(mean) < 4 * std::sqrt(variances.of_mean() / seeds));
    CHECK(std::fabs(square / variances.of_mean() - 1) < 0.2);
  }
  // Exactly, where nothing scatters.
  Consistency<double> fit;
  for (int i = 0; i < 40; ++i) fit.take(-3, 0.125, 0);
  CHECK(fit.misfit() == 3);
}

TEST_CASE("a misfit ends when readings fit again, and does not come back") {
  const Variances variances = {0, 4};
  const double shift = 6 * std::sqrt(variances.of_noise / 16);
  constexpr int seeds = 1000;
  int ended = 0, ended_at_once = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CAPTURE(seed);
    Stream stream(variances, seed);
    stream.take(settled, shift);
    REQUIRE(stream.misfit() > 0);
    stream.take(2, 0);
    ended_at_once += stream.misfit() > 0 ? 0 : 1;
    stream.take(29, 0);
    bool is_over = true;
    for (int i = 0; i < settled; ++i) {
      is_over &= !(stream.misfit() > 0);
      stream.take(1, 0);
    }
    ended += is_over ? 1 : 0;
  }
  CHECK(ended >= 0.99 * seeds);
  // Two readings do not outweigh thirty.
  CHECK(ended_at_once <= 0.01 * seeds);
}

TEST_CASE_TEMPLATE("nothing is said before eight readings", Scalar, float, double) {
  Consistency<Scalar> fit;
  CHECK(fit.misfit() == 0);
  for (int i = 1; i <= 7; ++i) {
    fit.take(Scalar(1e6), 1, 1);
    CHECK(fit.misfit() == 0);
  }
  fit.take(Scalar(1e6), 1, 1);
  CHECK(fit.misfit() == Scalar(1e6));
}

TEST_CASE("variances that change count as much as the readings that they belong to") {
  // Readings are off by four and were to be trusted; the model does not claim to be any better by now.
  Consistency<double> fit;
  for (int i = 0; i < settled; ++i) fit.take(4, 0, 1);
  REQUIRE(fit.misfit() == 4);
  // One reading of which little is known says nothing of those before.
  fit.take(4, 1, 1);
  CHECK(fit.misfit() == 4);
  fit.take(4, 0, 25);
  CHECK(fit.misfit() == 4);
  for (int i = 0; i < settled; ++i) fit.take(4, 1, 1);
  CHECK(fit.misfit() == 0);
  // Nor the other way round.
  fit.take(4, 0, 1);
  CHECK(fit.misfit() == 0);
  // Half of the variance is forgotten after eleven readings: 0.5 is less than (4 / 4.5)^2.
  for (int i = 0; i < 10; ++i) fit.take(4, 0, 1);
  CHECK(fit.misfit() == 4);
}

}  // namespace consistency_test
