// Lemke's method against all combinations of active pairs.
#include "taut/numerics/complementarity.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "support/dense.hpp"

namespace complementarity_test {
using namespace support;

namespace {

constexpr int most = 12;
using Lemke = taut::Lemke<double, most>;
using Outcome = Lemke::Outcome;

Outcome solve(Lemke& lemke, const Matrix& M, const Vector& q, int attempt = 0) {
  const int n = static_cast<int>(q.size());
  lemke.reset(n);
  for (int i = 0; i < n; ++i) {
    lemke.set_q(i, q[i]);
    for (int j = 0; j < n; ++j) lemke.set_M(i, j, M(i, j));
  }
  return lemke.solve(attempt);
}

Vector z_of(const Lemke& lemke, int n) {
  Vector z(n);
  for (int i = 0; i < n; ++i) z[i] = lemke.z(i);
  return z;
}

/// Every z of w = q + M z >= 0, z >= 0, w z = 0 that is determined by which of its parts are not zero.
std::vector<Vector> all_solutions(const Matrix& M, const Vector& q) {
  std::vector<Vector> found;
  const int n = static_cast<int>(q.size());
  for (int code = 0; code < (1 << n); ++code) {
    Matrix A = Matrix::Identity(n, n);
    Vector b = Vector::Zero(n);
    for (int i = 0; i < n; ++i)
      if ((code >> i) % 2 == 1) {
        A.row(i) = M.row(i);
        b[i] = -q[i];
      }
    if (rcond(A) < 1e-12) continue;
    const Vector z = solved(A, b), w = q + product(M, z);
    if (z.minCoeff() >= -1e-10 && w.minCoeff() >= -1e-10) found.push_back(z);
  }
  return found;
}

/// Positive definite, not symmetric: there is one solution.
Matrix random_definite(Random& random, int n) {
  const Matrix B = random_matrix(random, n, n), skew = random_matrix(random, n, n);
  return product(B, B.transpose()) + 0.2 * Matrix::Identity(n, n) + skew - skew.transpose();
}

}  // namespace

TEST_CASE("the solution is the one of all combinations, where there is one only") {
  const auto lemke = std::make_unique<Lemke>();
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 1 + random.below(6);
    const Matrix M = random_definite(random, n);
    const Vector q = random_vector(random, n);
    const auto found = all_solutions(M, q);
    REQUIRE(found.size() == 1);
    REQUIRE(solve(*lemke, M, q) == Outcome::solved);
    CHECK(largest(z_of(*lemke, n) - found[0]) <= 1e-12 * (1 + largest(found[0])));
    for (int i = 0; i < n; ++i) CHECK(lemke->is_active(i) == (found[0][i] > 1e-10));
  }
}

TEST_CASE("larger problems are solved, with every covering vector") {
  const auto lemke = std::make_unique<Lemke>();
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Matrix M = random_definite(random, most);
    const Vector q = random_vector(random, most);
    for (const int attempt : {0, 1, 2}) {
      REQUIRE(solve(*lemke, M, q, attempt) == Outcome::solved);
      const Vector z = z_of(*lemke, most), w = q + product(M, z);
      const double rounding = 1e-12 * (1 + largest(z));
      CHECK(z.minCoeff() >= 0);
      CHECK(w.minCoeff() >= -rounding);
      CHECK(largest(z.cwiseProduct(w)) <= rounding * (1 + largest(z)));
    }
  }
}

TEST_CASE("where nothing pushes nothing is active") {
  const auto lemke = std::make_unique<Lemke>();
  Random random(5);
  const Vector q = random_vector(random, 6).cwiseAbs();
  REQUIRE(solve(*lemke, random_definite(random, 6), q) == Outcome::solved);
  for (int i = 0; i < 6; ++i) {
    CHECK(lemke->z(i) == 0);
    CHECK_FALSE(lemke->is_active(i));
  }
}

TEST_CASE("a problem without a solution ends on a ray") {
  const auto lemke = std::make_unique<Lemke>();
  Matrix M(2, 2);
  M << -1, 0, 0, -1;
  Vector q(2);
  q << -1, -1;  // w = -1 - z
  CHECK(all_solutions(M, q).empty());
  for (const int attempt : {0, 1, 2}) CHECK(solve(*lemke, M, q, attempt) == Outcome::ray);
}

TEST_CASE("many pairs at zero at once are no obstacle") {
  const auto lemke = std::make_unique<Lemke>();
  for (int n = 1; n <= most; ++n) {
    CAPTURE(n);
    // Every z with a sum of 2 is a solution.
    REQUIRE(solve(*lemke, Matrix::Ones(n, n), Vector::Constant(n, -2)) == Outcome::solved);
    CHECK(z_of(*lemke, n).sum() == doctest::Approx(2).epsilon(1e-12));
    CHECK(z_of(*lemke, n).minCoeff() >= 0);
  }
}

TEST_CASE("a path that goes round in circles by the first of the tied rows comes to its end") {
  // Kostreva, Cycling in linear complementarity problems, 1979, for every odd size.
  const auto lemke = std::make_unique<Lemke>();
  for (int n = 3; n <= most; n += 2) {
    CAPTURE(n);
    Matrix M = Matrix::Identity(n, n);
    for (int i = 0; i < n; ++i) M(i, (i + 1) % n) = 2;
    REQUIRE(solve(*lemke, M, Vector::Constant(n, -1)) == Outcome::solved);
    CHECK(largest(z_of(*lemke, n) - Vector::Constant(n, 1.0 / 3)) <= 1e-14);
  }
}

TEST_CASE("the units of the unknowns do not matter") {
  const auto lemke = std::make_unique<Lemke>();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 5;
    const Matrix M = random_definite(random, n);
    const Vector q = random_vector(random, n);
    REQUIRE(solve(*lemke, M, q) == Outcome::solved);
    const Vector z = z_of(*lemke, n);
    Vector units(n);
    for (int i = 0; i < n; ++i) units[i] = std::exp2(random.below(60) - 30);
    REQUIRE(solve(*lemke, M * units.asDiagonal(), 1024 * q) == Outcome::solved);
    CHECK(largest(units.asDiagonal() * z_of(*lemke, n) / 1024 - z) <= 1e-12 * (1 + largest(z)));
  }
}

}  // namespace complementarity_test
