// LU that grows by rows and columns, against Eigen's dense one.
#include "taut/numerics/bordered_lu.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/dense.hpp"

namespace bordered_lu_test {
using namespace support;

namespace {

constexpr int most = 16;
using Lu = taut::BorderedLu<double, most>;

/// Appends the rows and columns `order` of A; returns the smallest pivot.
double append(Lu& lu, const Matrix& A, const std::vector<int>& order) {
  double least = 1;
  for (std::size_t n = static_cast<std::size_t>(lu.size()); n < order.size(); ++n) {
    const auto at = [&](int i) { return order[static_cast<std::size_t>(i)]; };
    const int last = order[n];
    least = std::fmin(
        least, lu.append([&](int i) { return A(at(i), last); }, [&](int i) { return A(last, at(i)); }));
  }
  return least;
}

std::vector<int> ascending(int n) {
  std::vector<int> order;
  for (int i = 0; i < n; ++i) order.push_back(i);
  return order;
}

/// A matrix whose pivots are of order one in any order.
Matrix random_regular(Random& random, int n) {
  return random_matrix(random, n, n) + (n + 1) * Matrix::Identity(n, n);
}

}  // namespace

TEST_CASE("solutions of random matrices that grew by rows and columns agree with Eigen's") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 1 + random.below(most);
    const Matrix A = random_regular(random, n);
    const Vector b = random_vector(random, n);
    Lu lu;
    lu.clear();
    CHECK(append(lu, A, ascending(n)) > 0.1);
    CHECK(lu.size() == n);
    Vector x = b;
    lu.solve(x);
    CHECK(largest(x - solved(A, b)) <= 1e-14);
  }
}

TEST_CASE("after truncation the leading block is solved by itself, and what lies behind it stays") {
  Random random(3);
  const Matrix A = random_regular(random, 9);
  const Vector b = random_vector(random, 9);
  Lu lu;
  lu.clear();
  append(lu, A, ascending(9));
  lu.truncate(5);
  Vector x = b;
  lu.solve(x);
  CHECK(largest(x.head(5) - solved(A.topLeftCorner(5, 5), b.head(5))) <= 1e-14);
  CHECK(x.tail(4) == b.tail(4));
}

TEST_CASE("factors that are made anew in the same order have the same bits, whatever came in between") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Matrix A = random_regular(random, most);
    const Vector b = random_vector(random, most);
    const std::vector<int> order{5, 2, 11, 0, 7, 9, 1};
    Lu straight, detour;
    straight.clear();
    append(straight, A, order);
    detour.clear();
    append(detour, A, {5, 2, 11, 3, 4, 10, 6, 8});
    detour.truncate(3);
    append(detour, A, order);
    Vector x = b, y = b;
    straight.solve(x);
    detour.solve(y);
    for (int i = 0; i < 7; ++i) CHECK(x[i] == y[i]);
  }
}

TEST_CASE("the pivot is measured by the largest entry of its row and column") {
  Matrix A(2, 2);
  A << 2, 8, 1, 5;  // the second pivot is 5 - 1 / 2 x 8 = 1
  Lu lu;
  lu.clear();
  CHECK(lu.append([&](int i) { return A(i, 0); }, [&](int i) { return A(0, i); }) == 1);
  CHECK(lu.append([&](int i) { return A(i, 1); }, [&](int i) { return A(1, i); }) == 0.125);
}

TEST_CASE("the pivot of a row that depends on the others is rounding, and zeros have none at all") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 2 + random.below(most - 2);
    Matrix A = Matrix::Zero(n, n);
    A.topRows(n - 1) = random_regular(random, n).topRows(n - 1);
    Vector parts = random_vector(random, n - 1);
    for (int i = 0; i + 1 < n; ++i) A.row(n - 1) += parts[i] * A.row(i);
    Lu lu;
    lu.clear();
    CHECK(append(lu, A, ascending(n)) <= 1e-13);
    lu.truncate(n - 1);
    A(n - 1, n - 1) += 1;  // now it does not
    CHECK(append(lu, A, ascending(n)) >= 1e-3);
  }
  Lu lu;
  lu.clear();
  CHECK(append(lu, Matrix::Zero(1, 1), {0}) == 0);
}

}  // namespace bordered_lu_test
