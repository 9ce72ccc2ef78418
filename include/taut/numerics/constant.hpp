// What constant expressions of C++17 lack: square roots, unit vectors, eigenvalues.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "taut/numerics/larger.hpp"

namespace taut {

/// |x|, but for the sign of a zero.
template <class Scalar>
constexpr Scalar magnitude(Scalar x) {
  return x < 0 ? -x : x;
}

/// Neither infinite nor NaN.
template <class Scalar>
constexpr bool is_finite(Scalar x) {
  return magnitude(x) <= std::numeric_limits<Scalar>::max();
}

/// The square root of x >= 0 to its last digit or the one before, by Newton's method: for constants, slow.
template <class Scalar>
constexpr Scalar constant_square_root(Scalar x) {
  if (!(x > 0)) return 0;
  Scalar root = larger(x, Scalar(1));
  for (int i = 0; i < 2 * std::numeric_limits<Scalar>::max_exponent; ++i) {
    const Scalar next = (root + x / root) / 2;
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

/// The Euclidean norm, without overflow: for constants.
template <class Scalar, std::size_t N>
constexpr Scalar constant_norm(const std::array<Scalar, N>& vector) {
  Scalar largest = 0, sum = 0;
  for (const Scalar x : vector) largest = larger(largest, magnitude(x));
  if (!(largest > 0)) return 0;
  for (const Scalar x : vector) sum += x / largest * (x / largest);
  return largest * constant_square_root(sum);
}

/// vector / |vector|, or zero: for constants.
template <class Scalar, std::size_t N>
constexpr std::array<Scalar, N> constant_unit(std::array<Scalar, N> vector) {
  const Scalar norm = constant_norm(vector);
  for (Scalar& x : vector) x = norm > 0 ? x / norm : Scalar(0);
  return vector;
}

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix, by Jacobi's cyclic rotations: for
/// constants.
template <class Scalar, std::size_t N>
struct ConstantEigen {
  using Matrix = std::array<std::array<Scalar, N>, N>;
  std::array<Scalar, N> values{};  ///< in no order
  Matrix vectors{};                ///< vectors[i][k] is component i of the one of values[k]

  static constexpr ConstantEigen of(Matrix a) {
    constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    constexpr int most_sweeps = 30;  // quadratic convergence: six are usual
    ConstantEigen result;
    for (std::size_t i = 0; i < N; ++i) result.vectors[i][i] = 1;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool is_diagonal = true;
      for (std::size_t p = 0; p + 1 < N; ++p)
        for (std::size_t q = p + 1; q < N; ++q) {
          if (magnitude(a[p][q]) <= epsilon * epsilon * (magnitude(a[p][p]) + magnitude(a[q][q]))) continue;
          is_diagonal = false;
          result.rotate(a, p, q);
        }
      if (is_diagonal) break;
    }
    for (std::size_t i = 0; i < N; ++i) result.values[i] = a[i][i];
    return result;
  }

 private:
  /// The rotation in the plane of p and q that makes a[p][q] zero.
  constexpr void rotate(Matrix& a, std::size_t p, std::size_t q) {
    const Scalar cot = (a[q][q] - a[p][p]) / (2 * a[p][q]);  // of twice the angle
    const Scalar tan = (cot < 0 ? -1 : 1) / (magnitude(cot) + constant_square_root(cot * cot + 1));
    const Scalar cos = 1 / constant_square_root(tan * tan + 1), sin = tan * cos;
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar x = a[i][p], y = a[i][q];
      a[i][p] = cos * x - sin * y;
      a[i][q] = sin * x + cos * y;
    }
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar x = a[p][i], y = a[q][i];
      a[p][i] = cos * x - sin * y;
      a[q][i] = sin * x + cos * y;
      const Scalar u = vectors[i][p], v = vectors[i][q];
      vectors[i][p] = cos * u - sin * v;
      vectors[i][q] = sin * u + cos * v;
    }
    a[p][q] = a[q][p] = 0;
  }
};

}  // namespace taut
