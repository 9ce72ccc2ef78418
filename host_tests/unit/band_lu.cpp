// Band LU against Eigen's dense one.
#include "taut/numerics/band_lu.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "support/dense.hpp"

namespace band_lu_test {
using namespace support;

namespace {

constexpr int most = 24;
using Lu = taut::BandLu<double, most>;

Matrix random_band(Random& random, int n, int band) {
  Matrix A = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (std::abs(i - j) <= band) A(i, j) = random.between(-1, 1);
  return A;
}

/// Gives `A` to `lu` with the columns scaled by `scale`.
void load(Lu& lu, const Matrix& A, int band, const Vector& scale) {
  const int n = static_cast<int>(A.rows());
  lu.reset(n, band);
  for (int i = 0; i < n; ++i) {
    lu.set_column_scale(i, scale[i]);
    for (int j = 0; j < n; ++j)
      if (std::abs(i - j) <= band) lu.add(i, j, A(i, j));
  }
}
void load(Lu& lu, const Matrix& A, int band) { load(lu, A, band, Vector::Ones(A.rows())); }

}  // namespace

TEST_CASE("solutions of random band matrices agree with Eigen's up to the condition number") {
  const auto lu = std::make_unique<Lu>();
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 1 + random.below(most), band = random.below(n);
    const Matrix A = random_band(random, n, band);
    const Vector b = random_vector(random, n);
    const double condition = rcond(A);
    if (condition < 1e-10) continue;
    load(*lu, A, band);
    REQUIRE(lu->factor() == -1);
    Vector x = b;
    lu->solve(x);
    const Vector expected = solved(A, b);
    // Backward stable: the error is rounding times condition, with room for growth of the pivots.
    CHECK((x - expected).lpNorm<Eigen::Infinity>() <= 1e-13 / condition * expected.lpNorm<Eigen::Infinity>());
    CHECK((A * x - b).lpNorm<Eigen::Infinity>() <= 1e-12 * (x.lpNorm<Eigen::Infinity>() + 1));
  }
}

TEST_CASE("a matrix that needs its rows exchanged is solved") {
  const auto lu = std::make_unique<Lu>();
  Matrix A(3, 3);
  A << 0, 2, 0, 1, 0, 4, 0, 5, 0.5;
  load(*lu, A, 1);
  REQUIRE(lu->factor() == -1);
  Vector x(3);
  x << 2, 5, 5.5;  // A (1, 1, 1)
  lu->solve(x);
  for (int i = 0; i < 3; ++i) CHECK(x[i] == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("a factorization is used for as many right-hand sides as wanted") {
  const auto lu = std::make_unique<Lu>();
  Random random(7);
  const Matrix A = random_band(random, 10, 2) + 4 * Matrix::Identity(10, 10);
  load(*lu, A, 2);
  REQUIRE(lu->factor() == -1);
  for (int round = 0; round < 5; ++round) {
    const Vector expected = random_vector(random, 10);
    Vector x = A * expected;
    lu->solve(x);
    CHECK((x - expected).norm() <= 1e-13);
  }
}

TEST_CASE("what a larger matrix left behind does not disturb a smaller one") {
  const auto lu = std::make_unique<Lu>();
  Random random(8);
  load(*lu, random_band(random, most, most - 1), most - 1);
  (void)lu->factor();
  const Matrix A = random_band(random, 6, 1) + 3 * Matrix::Identity(6, 6);
  load(*lu, A, 1);
  REQUIRE(lu->factor() == -1);
  Vector x = A * Vector::Ones(6);
  lu->solve(x);
  CHECK((x - Vector::Ones(6)).norm() <= 1e-13);
}

TEST_CASE("a singular matrix is recognised, and the vector it maps to nothing is found") {
  const auto lu = std::make_unique<Lu>();
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 3 + random.below(most - 2);
    Matrix A = random_band(random, n, n - 1);
    // All unknowns take part, so that rounding of A is not blown up on the way to the last pivot.
    Vector lost(n);
    for (int i = 0; i < n; ++i) lost[i] = (random.coin() ? 1 : -1) * random.between(0.5, 1);
    A -= A * lost * lost.transpose() / lost.squaredNorm();  // now A lost = 0
    load(*lu, A, n - 1);
    const int column = lu->factor();
    REQUIRE(column >= 0);
    Vector x(n);
    lu->null_vector(column, x);
    CHECK(x.norm() > 0);
    CHECK((A * x).norm() <= 1e-10 * x.norm());
    CHECK(std::fabs(x.dot(lost)) >= (1 - 1e-8) * x.norm() * lost.norm());
  }
}

TEST_CASE("a row or a column of zeros is singular") {
  const auto lu = std::make_unique<Lu>();
  Matrix A = Matrix::Identity(5, 5);
  A(2, 2) = 0;
  load(*lu, A, 1);
  CHECK(lu->factor() == 2);
}

TEST_CASE("stiffnesses and coefficients of one side by side lose no digits") {
  const auto lu = std::make_unique<Lu>();
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 12, band = 3;
    const Matrix well = random_band(random, n, band) + 4 * Matrix::Identity(n, n);
    const Vector expected = random_vector(random, n);
    Vector rows(n), columns(n);
    for (int i = 0; i < n; ++i) {
      rows[i] = std::exp2(random.below(80) - 40);
      columns[i] = std::exp2(random.below(80) - 40);
    }
    const Matrix A = rows.asDiagonal() * well * columns.asDiagonal();
    load(*lu, A, band, columns.cwiseInverse());
    REQUIRE(lu->factor() == -1);
    Vector x = rows.asDiagonal() * (well * expected);
    lu->solve(x);
    // In the scaled unknowns the matrix is well conditioned, and powers of two change no digit.
    CHECK((columns.asDiagonal() * x - expected).norm() <= 1e-13);
  }
}

TEST_CASE("the pivot ratio grows with the condition number") {
  const auto lu = std::make_unique<Lu>();
  for (const double small : {1.0, 1e-4, 1e-8}) {
    Matrix A(2, 2);
    A << 1, 1, 1, 1 + small;  // condition about 4 / small
    load(*lu, A, 1);
    REQUIRE(lu->factor() == -1);
    CHECK(lu->pivot_ratio() >= 0.1 / small);
    CHECK(lu->pivot_ratio() <= 10 / small);
  }
}

TEST_CASE("single precision solves to single precision") {
  const auto lu = std::make_unique<taut::BandLu<float, 8>>();
  lu->reset(8, 1);
  for (int i = 0; i < 8; ++i) {
    lu->set_column_scale(i, 1);
    lu->add(i, i, 2);
    if (i > 0) lu->add(i, i - 1, -1);
    if (i < 7) lu->add(i, i + 1, -1);
  }
  REQUIRE(lu->factor() == -1);
  Eigen::VectorXf x = Eigen::VectorXf::Zero(8);
  x[7] = 9;  // the solution of the chain pulled at its end is 1, 2, ..., 8
  lu->solve(x);
  for (int i = 0; i < 8; ++i) CHECK(double(x[i]) == doctest::Approx(i + 1).epsilon(1e-6));
}

}  // namespace band_lu_test
