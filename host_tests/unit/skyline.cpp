// L D L^T within a skyline, against Eigen's dense LU.
#include "taut/condensation/skyline.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "support/dense.hpp"

namespace skyline_test {
using namespace support;

namespace {

constexpr int most = 20;
using Full = taut::Skyline<double, most, most*(most + 1) / 2>;

std::vector<int> random_profile(Random& random, int n) {
  std::vector<int> first;
  for (int i = 0; i < n; ++i) first.push_back(random.below(i + 1));
  return first;
}

/// Positive definite and zero outside of the profile: B B^T of a lower triangle has more entries, L L^T of a
/// skyline has none.
Matrix random_within(Random& random, const std::vector<int>& first) {
  const int n = static_cast<int>(first.size());
  Matrix L = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = first[static_cast<std::size_t>(i)]; j < i; ++j) L(i, j) = random.between(-1, 1);
    L(i, i) = random.between(0.5, 1.5);
  }
  return product(L, L.transpose());
}

template <class Skyline>
int load(Skyline& skyline, const Matrix& A, const std::vector<int>& first) {
  const int missing =
      skyline.reset(static_cast<int>(A.rows()), [&](int i) { return first[static_cast<std::size_t>(i)]; });
  if (missing > 0) return missing;
  for (int i = 0; i < A.rows(); ++i)
    for (int j = first[static_cast<std::size_t>(i)]; j < A.cols(); ++j) skyline.add(i, j, A(i, j));
  return 0;
}

}  // namespace

TEST_CASE("solutions within random skylines agree with Eigen's up to the condition number") {
  const auto skyline = std::make_unique<Full>();
  int solvable = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto first = random_profile(random, 1 + random.below(most));
    const Matrix A = random_within(random, first);
    const double condition = rcond(A);
    if (condition < 1e-9) continue;
    ++solvable;
    const Vector expected = random_vector(random, static_cast<int>(A.rows()));
    REQUIRE(load(*skyline, A, first) == 0);
    REQUIRE(skyline->factor() == -1);
    Vector x = product(A, expected);
    skyline->solve(x);
    CHECK(largest(x - solved(A, product(A, expected))) <= 1e-14 / condition);
    CHECK(largest(x - expected) <= 1e-14 / condition);
  }
  CHECK(solvable >= 200);
}

TEST_CASE("the upper triangle is left out, and what is added twice counts twice") {
  const auto skyline = std::make_unique<Full>();
  skyline->reset(2, [](int) { return 0; });
  skyline->add(0, 0, 1);
  skyline->add(0, 0, 1);
  skyline->add(1, 0, 1);
  skyline->add(0, 1, 77);
  skyline->add(1, 1, 3);
  REQUIRE(skyline->factor() == -1);
  Vector x(2);
  x << 4, 7;  // (2 1; 1 3) (1, 2)
  skyline->solve(x);
  CHECK(x[0] == doctest::Approx(1).epsilon(1e-15));
  CHECK(x[1] == doctest::Approx(2).epsilon(1e-15));
}

TEST_CASE("a profile of more entries than there is room for says how many are missing") {
  taut::Skyline<double, 4, 7> small;
  CHECK(small.reset(4, [](int) { return 0; }) == 3);                    // 1 + 2 + 3 + 4
  CHECK(small.reset(4, [](int i) { return i > 0 ? i - 1 : 0; }) == 0);  // 1 + 2 + 2 + 2
  CHECK(small.reset(3, [](int) { return 0; }) == 0);
}

TEST_CASE("a motion that nothing resists is found, with the last of the unknowns that take part") {
  const auto skyline = std::make_unique<Full>();
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 3 + random.below(most - 2);
    Vector lost(n);
    for (int i = 0; i < n; ++i) lost[i] = (random.coin() ? 1 : -1) * random.between(0.5, 1);
    const int last = 1 + random.below(n - 1);  // those behind it do not take part
    lost.tail(n - 1 - last).setZero();
    const Matrix B = random_matrix(random, n, n);
    const Matrix across = Matrix::Identity(n, n) - product(lost, lost.transpose()) / lost.squaredNorm();
    const Matrix A = product(across, product(product(B, B.transpose()) + Matrix::Identity(n, n), across));
    load(*skyline, A, std::vector<int>(static_cast<std::size_t>(n), 0));
    REQUIRE(skyline->factor() == last);
    Vector x(n);
    skyline->null_vector(last, x);
    CHECK(x[last] == 1);
    CHECK(largest(x - lost / lost[last]) <= 1e-9);
  }
}

TEST_CASE("a chain of springs that hangs on nothing moves as one") {
  const auto skyline = std::make_unique<Full>();
  skyline->reset(6, [](int i) { return i > 0 ? i - 1 : 0; });
  for (int i = 0; i < 6; ++i) {
    skyline->add(i, i, i == 0 || i == 5 ? 3 : 6);
    if (i > 0) skyline->add(i, i - 1, -3);
  }
  REQUIRE(skyline->factor() == 5);
  Vector x(6);
  skyline->null_vector(5, x);
  for (int i = 0; i < 6; ++i) CHECK(x[i] == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("the condition is the largest loss of a diagonal") {
  const auto skyline = std::make_unique<Full>();
  for (const double small : {1.0, 1e-4, 1e-9}) {
    skyline->reset(2, [](int) { return 0; });
    skyline->add(0, 0, 1);
    skyline->add(1, 0, 1);
    skyline->add(1, 1, 1 + small);  // of which elimination leaves `small`
    REQUIRE(skyline->factor() == -1);
    CHECK(skyline->condition() == doctest::Approx((1 + small) / small).epsilon(1e-6));
  }
}

}  // namespace skyline_test
