// The filter on unknown constants against least squares over all that was measured.
#include "taut/estimation/belief.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/random.hpp"

namespace belief_test {
namespace {

constexpr int unknowns = 4, jacks = 2;
using Belief = taut::Belief<double, unknowns, jacks>;
using Vector = Eigen::VectorXd;

/// Unknowns and then errors of the jacks' readings, with their prior.
struct LeastSquares {
  Eigen::MatrixXd information;
  Vector sum;

  explicit LeastSquares(const Vector& prior_sd)
      : information(prior_sd.array().square().inverse().matrix().asDiagonal()),
        sum(Vector::Zero(prior_sd.size())) {}
  void add(const Vector& row, double measured, double sd) {
    information += row * row.transpose() / (sd * sd);
    sum += row * measured / (sd * sd);
  }
  Eigen::MatrixXd covariance() const { return information.inverse(); }
  Vector mean() const { return information.ldlt().solve(sum); }
};

Vector random_vector(support::Random& random, int size) {
  Vector v(size);
  for (int i = 0; i < size; ++i) v[i] = support::gaussian(random);
  return v;
}
/// All unknowns are of friction.
void begin(Belief& belief, const Vector& prior_sd) {
  belief.clear();
  for (int p = 0; p < unknowns; ++p) belief.add(prior_sd[p]);
  belief.end_friction();
}
Belief::PredictionType prediction_of(double value, const Vector& H, const Vector& by_jack) {
  Belief::PredictionType prediction;
  prediction.value = value;
  for (int p = 0; p < unknowns; ++p) prediction.H[p] = H[p];
  for (int k = 0; k < jacks; ++k) prediction.by_jack[k] = by_jack[k];
  return prediction;
}
void check_same(const Belief& belief, const LeastSquares& expected) {
  const Eigen::MatrixXd covariance = expected.covariance();
  const Vector mean = expected.mean();
  for (int p = 0; p < unknowns; ++p) {
    const double sd = std::sqrt(covariance(p, p));
    REQUIRE(std::fabs(belief.mean(p) - mean[p]) < 1e-9 * sd);
    for (int q = 0; q < unknowns; ++q)
      REQUIRE(std::fabs(belief.save().covariance[p][q] - covariance(p, q)) <
              1e-9 * sd * std::sqrt(covariance(q, q)));
  }
}

}  // namespace

TEST_CASE("readings of several rows and instruments teach what least squares over all of them does") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    const Vector prior_sd = random_vector(random, unknowns).cwiseAbs() + Vector::Constant(unknowns, 0.1);
    Belief belief;
    begin(belief, prior_sd);
    // Every row has jack errors of its own; they are unknowns of the whole problem here.
    constexpr int rows = 5;
    Vector sds(unknowns + rows * jacks);
    sds.head(unknowns) = prior_sd;
    for (int i = unknowns; i < sds.size(); ++i) sds[i] = random.between(0.1, 2);
    LeastSquares expected(sds);
    for (int row = 0; row < rows; ++row) {
      belief.begin_row();
      const int first = unknowns + row * jacks;
      Belief::JackReadings readings;
      for (int k = 0; k < jacks; ++k)
        readings.add({support::gaussian(random), sds[first + k] * sds[first + k]});
      for (int instrument = 0; instrument < 3; ++instrument) {
        const Vector H = random_vector(random, unknowns), by_jack = random_vector(random, jacks);
        const double value = support::gaussian(random), sd = random.between(0.1, 2);
        // A measured number in truth, with no jack error and all unknowns zero, but for its own noise.
        double reading = value + sd * support::gaussian(random);
        Vector whole = Vector::Zero(sds.size());
        whole.head(unknowns) = H;
        double off = reading - value;
        for (int k = 0; k < jacks; ++k) {
          reading += by_jack[k] * readings[k].beyond;
          whole[first + k] = -by_jack[k];
        }
        REQUIRE(belief.innovate(prediction_of(value, H, by_jack), readings, {reading, sd, 0}));
        belief.update(readings);
        expected.add(whole, off, sd);
        check_same(belief, expected);
        const Eigen::MatrixXd covariance = expected.covariance();
        for (int p = 0; p < unknowns; ++p)
          for (int k = 0; k < jacks; ++k)
            REQUIRE(std::fabs(belief.with_load(p, k) - covariance(p, first + k)) <
                    1e-9 * std::sqrt(covariance(p, p)) * sds[first + k]);
      }
    }
  }
}

TEST_CASE("where the model is linearized does not matter to a number that is linear") {
  support::Random random(7);
  const Vector prior_sd = Vector::Constant(unknowns, 0.5), H = random_vector(random, unknowns),
               none = Vector::Zero(jacks);
  Belief belief;
  begin(belief, prior_sd);
  Belief::Values at;
  for (int p = 0; p < unknowns; ++p) at[p] = 0.3 * support::gaussian(random);
  belief.linearize_at(at);
  double value = 10;
  for (int p = 0; p < unknowns; ++p) value += H[p] * at[p];
  REQUIRE(belief.innovate(prediction_of(value, H, none), {}, {10.7, 0.4, 0}));
  belief.update({});
  LeastSquares expected(prior_sd);
  expected.add(H, 0.7, 0.4);
  check_same(belief, expected);
}

TEST_CASE("a reading is refused beyond five sigma of its innovation, and then nothing has changed") {
  const Vector prior_sd = Vector::Constant(unknowns, 1.0), H = Vector::Constant(unknowns, 2.0),
               by_jack = Vector::Constant(jacks, 0.5);
  Belief::JackReadings readings;
  for (int k = 0; k < jacks; ++k) readings.add({0, 4});
  // 3 x 3 + 4 unknowns x (2 x 1)^2 + 2 jacks x (0.5 x 2)^2
  const double sigma = std::sqrt(9.0 + 16.0 + 2.0);
  for (const double way : {-1.0, 1.0}) {
    Belief belief;
    begin(belief, prior_sd);
    const auto prediction = prediction_of(100, H, by_jack);
    CHECK_FALSE(belief.innovate(prediction, readings, {100 + 5.001 * way * sigma, 3, 0}));
    for (int p = 0; p < unknowns; ++p) {
      CHECK(belief.mean(p) == 0);
      CHECK(belief.variance(p) == 1);
    }
    CHECK(belief.innovate(prediction, readings, {100 + 4.999 * way * sigma, 3, 0}));
    // The mean of several is not refused for less than one of them would be.
    CHECK(belief.innovate(prediction, readings, {100 + 7 * way * sigma, 3, 2 * sigma * sigma}));
  }
}

TEST_CASE("a row that corrects some unknowns alone says nothing of the jacks' errors") {
  Belief belief;
  begin(belief, Vector::Constant(unknowns, 1.0));
  const auto prediction = prediction_of(0, Vector::Constant(unknowns, 1.0), Vector::Constant(jacks, 0.5));
  Belief::JackReadings readings;
  for (int k = 0; k < jacks; ++k) readings.add({0, 4});
  belief.begin_row();
  REQUIRE(belief.innovate(prediction, readings, {1, 1, 0}));
  belief.update_alone([](int p) { return p == 0; });
  CHECK_FALSE(belief.has_errors());
  REQUIRE(belief.innovate(prediction, readings, {1, 1, 0}));
  belief.update(readings);
  CHECK(belief.has_errors());
}

TEST_CASE("a mean stays within its bounds") {
  Belief belief;
  begin(belief, Vector::Constant(unknowns, 1.0));
  belief.bound(0, -0.1, 0.2);
  Vector H = Vector::Zero(unknowns);
  H[0] = 1;
  REQUIRE(belief.innovate(prediction_of(0, H, Vector::Zero(jacks)), {}, {2, 0.1, 0}));
  belief.update({});
  CHECK(belief.mean(0) == 0.2);
}

TEST_CASE("readings that scatter more than they were taken to have taught as much less") {
  // As if they had been taken with the larger deviation, whatever the prior says of some of them.
  Vector unequal = Vector::Constant(unknowns, 0.05);
  unequal[0] = 1e3;
  for (const Vector& prior :
       {Vector(Vector::Constant(unknowns, 1e4)), Vector(Vector::Constant(unknowns, 0.3)), unequal})
    for (const double times : {1.7, 4.0, 30.0}) {
      CAPTURE(times);
      CAPTURE(prior[1]);
      support::Random random(5);
      Belief belief;
      begin(belief, prior);
      LeastSquares expected(prior);
      for (int i = 0; i < 40; ++i) {
        const Vector H = random_vector(random, unknowns);
        const double measured = support::gaussian(random);
        belief.begin_row();
        REQUIRE(belief.innovate(prediction_of(0, H, Vector::Zero(jacks)), {}, {measured, 1, 0}));
        belief.update({});
        expected.add(H, measured, std::sqrt(times));
      }
      belief.inflate(times);
      const Eigen::MatrixXd covariance = expected.covariance();
      for (int p = 0; p < unknowns; ++p)
        for (int q = 0; q < unknowns; ++q)
          CHECK(std::fabs(belief.save().covariance[p][q] - covariance(p, q)) <
                1e-6 * std::sqrt(covariance(p, p) * covariance(q, q)));
    }
}

TEST_CASE("what was never measured stays as well known as it was beforehand") {
  const Vector prior = Vector::LinSpaced(unknowns, 1, 2);
  Belief belief;
  begin(belief, prior);
  Vector H = Vector::Zero(unknowns);
  H[0] = H[1] = 1;
  REQUIRE(belief.innovate(prediction_of(0, H, Vector::Zero(jacks)), {}, {0.3, 0.5, 0}));
  belief.update({});
  belief.inflate(100);
  for (int p = 2; p < unknowns; ++p)
    CHECK(belief.variance(p) == doctest::Approx(prior[p] * prior[p]).epsilon(1e-12));
  // Together they are still known better.
  CHECK(belief.save().covariance[0][1] < 0);
}

TEST_CASE("a sum that was measured well is no news of its parts, however often noise is found to be larger") {
  Vector prior = Vector::Constant(unknowns, 1e-3);
  prior[0] = 0.05;
  prior[1] = 0.01;
  Belief belief;
  begin(belief, prior);
  Vector H = Vector::Zero(unknowns);
  H[0] = H[1] = 1;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 20; ++i) {
      belief.begin_row();
      REQUIRE(belief.innovate(prediction_of(0, H, Vector::Zero(jacks)), {}, {0, 1e-3, 0}));
      belief.update({});
    }
    belief.inflate(2);
  }
  // With the sum known each has the variance 1 / (1 / 0.05^2 + 1 / 0.01^2), and no less.
  const double both = 1 / (1 / (0.05 * 0.05) + 1 / (0.01 * 0.01));
  CHECK(belief.variance(0) == doctest::Approx(both).epsilon(1e-3));
  CHECK(belief.variance(1) == doctest::Approx(both).epsilon(1e-3));
}

TEST_CASE("what is known not to be above zero leaves the mean and covariance of all draws that are not") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    const Vector prior_sd = random_vector(random, unknowns).cwiseAbs() + Vector::Constant(unknowns, 0.1);
    Belief belief;
    begin(belief, prior_sd);
    const Vector H = random_vector(random, unknowns);
    const double error_sd = random.between(0.1, 1),
                 all = H.cwiseProduct(prior_sd).squaredNorm() + error_sd * error_sd,
                 above = random.between(0, 2);
    const double value = above * std::sqrt(all);
    Belief::Values derivatives;
    for (int p = 0; p < unknowns; ++p) derivatives[p] = H[p];
    const auto expected = [&](const Belief& by) {
      double number = value;
      for (int p = 0; p < unknowns; ++p) number += H[p] * by.mean(p);
      return number;
    };
    REQUIRE(belief.bring_below_zero(0, derivatives, error_sd * error_sd, [&] { return expected(belief); }));

    Vector sum = Vector::Zero(unknowns);
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(unknowns, unknowns);
    int left = 0;
    for (int draw = 0; draw < 400000; ++draw) {
      const Vector x = random_vector(random, unknowns).cwiseProduct(prior_sd);
      if (value + H.dot(x) + error_sd * support::gaussian(random) > 0) continue;
      sum += x;
      square += x * x.transpose();
      ++left;
    }
    REQUIRE(left > 5000);
    const Vector mean = sum / left;
    const Eigen::MatrixXd covariance = square / left - mean * mean.transpose();
    for (int p = 0; p < unknowns; ++p) {
      CHECK(std::fabs(belief.mean(p) - mean[p]) < 0.06 * prior_sd[p]);
      for (int q = 0; q < unknowns; ++q)
        CHECK(std::fabs(belief.covariance(p, q) - covariance(p, q)) < 0.06 * prior_sd[p] * prior_sd[q]);
    }
  }
}

TEST_CASE("a bound that is narrower than before, or than what was measured since, is all that counts of it") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    support::Random random(seed);
    const Vector prior_sd = random_vector(random, unknowns).cwiseAbs() + Vector::Constant(unknowns, 0.1),
                 H = random_vector(random, unknowns), row = random_vector(random, unknowns);
    const double error = random.between(0.01, 0.1),
                 sd = std::sqrt(H.cwiseProduct(prior_sd).squaredNorm() + error);
    Belief::Values derivatives;
    for (int p = 0; p < unknowns; ++p) derivatives[p] = H[p];
    const auto bring = [&](Belief& belief, double value) {
      REQUIRE(belief.bring_below_zero(0, derivatives, error, [&] {
        double number = value;
        for (int p = 0; p < unknowns; ++p) number += H[p] * belief.mean(p);
        return number;
      }));
    };
    const auto measure = [&](Belief& belief) {
      belief.begin_row();
      const auto prediction = prediction_of(0, row, Vector::Zero(jacks));
      REQUIRE(belief.innovate(prediction, {}, {0.1, 0.5, 0}));
      belief.update({});
    };
    Belief in_steps, at_once;
    begin(in_steps, prior_sd);
    begin(at_once, prior_sd);
    for (double part = 0.1; part < 1.05; part += 0.1) {
      bring(in_steps, part * sd);
      if (part > 0.55 && part < 0.65) measure(in_steps);
    }
    measure(at_once);
    bring(at_once, sd);
    for (int p = 0; p < unknowns; ++p) {
      CHECK(in_steps.mean(p) == doctest::Approx(at_once.mean(p)).epsilon(1e-9));
      for (int q = 0; q < unknowns; ++q)
        CHECK(std::fabs(in_steps.covariance(p, q) - at_once.covariance(p, q)) <
              1e-9 * prior_sd[p] * prior_sd[q]);
    }
    // What cannot be is left aside.
    const double mean = at_once.mean(0), variance = at_once.variance(0);
    CHECK_FALSE(at_once.bring_below_zero(0, derivatives, error, [&] { return 6 * sd; }));
    CHECK(at_once.mean(0) == doctest::Approx(mean).epsilon(1e-9));
    CHECK(at_once.variance(0) == doctest::Approx(variance).epsilon(1e-9));
  }
}

}  // namespace belief_test
