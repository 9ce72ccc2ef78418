// LU factorization with partial pivoting of a general band matrix, in fixed storage.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "taut/numerics/larger.hpp"

namespace taut {

/// A square matrix of at most Max unknowns that is zero outside a band, its factorization and solutions.
///
/// Columns are stored whole, one after the other, so that any bandwidth up to a full matrix fits; the loops
/// touch the band alone: n b^2 operations to factor, n b to solve. Rows and columns are scaled before pivots
/// are compared, since stiffnesses [N/m] and constraint coefficients [-] stand side by side.
template <class Scalar, int Max>
class BandLu {
 public:
  /// Starts an n x n matrix of zeros with entries only where |row - column| <= band.
  void reset(int n, int band) {
    n_ = n;
    band_ = band;
    for (int j = 0; j < n; ++j)
      for (int i = first(j, 2 * band); i <= last(j, band); ++i) at(i, j) = 0;
  }

  void add(int row, int column, Scalar value) { at(row, column) += value; }
  int size() const { return n_; }
  Scalar diagonal(int i) const { return at(i, i); }
  /// The scale of a column: its solution is of this order [unit of the unknown].
  void set_column_scale(int column, Scalar scale) { column_scale_[index(column)] = scale; }

  /// Factors P R A C = L U. Returns -1, or the column at which the matrix turned out singular.
  int factor() {
    scale();
    for (int k = 0; k < n_; ++k) {
      const int below = last(k, band_);
      int pivot = k;
      for (int i = k + 1; i <= below; ++i)
        if (std::fabs(at(i, k)) > std::fabs(at(pivot, k))) pivot = i;
      pivot_[index(k)] = static_cast<std::int16_t>(pivot);
      if (!(std::fabs(at(pivot, k)) > singular_below)) return k;
      const int right = last(k, 2 * band_);
      if (pivot != k)
        for (int j = k; j <= right; ++j) swap(at(k, j), at(pivot, j));
      const Scalar inverse = Scalar(1) / at(k, k);
      for (int i = k + 1; i <= below; ++i) at(i, k) *= inverse;
      for (int j = k + 1; j <= right; ++j) {
        const Scalar factor = at(k, j);
        if (factor == 0) continue;
        const Scalar* const l = &at(0, k);
        Scalar* const u = &at(0, j);
        for (int i = k + 1; i <= below; ++i) u[i] -= l[i] * factor;
      }
    }
    return -1;
  }

  /// Solves A x = b in place.
  template <class Vector>
  void solve(Vector& x) const {
    for (int i = 0; i < n_; ++i) x[i] *= row_scale_[index(i)];
    for (int k = 0; k < n_; ++k) {
      swap(x[k], x[pivot_[index(k)]]);
      for (int i = k + 1; i <= last(k, band_); ++i) x[i] -= at(i, k) * x[k];
    }
    back_substitute(x, n_);
    for (int i = 0; i < n_; ++i) x[i] *= column_scale_[index(i)];
  }

  /// After factor() returned `column`: a vector that the matrix maps to (nearly) nothing.
  template <class Vector>
  void null_vector(int column, Vector& x) const {
    for (int i = 0; i < n_; ++i) x[i] = 0;
    for (int i = first(column, 2 * band_); i < column; ++i) x[i] = -at(i, column);
    back_substitute(x, column);
    x[column] = 1;
    for (int i = 0; i < n_; ++i) x[i] *= column_scale_[index(i)];
  }

  /// Largest scaled entry over smallest pivot: a lower bound of the condition number, good to an order or
  /// two.
  Scalar pivot_ratio() const {
    Scalar smallest = std::fabs(at(0, 0)), largest = smallest;
    for (int k = 1; k < n_; ++k) {
      smallest = std::fmin(smallest, std::fabs(at(k, k)));
      largest = larger(largest, std::fabs(at(k, k)));
    }
    return largest / smallest;
  }

 private:
  static constexpr Scalar singular_below = 32 * std::numeric_limits<Scalar>::epsilon();

  static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static void swap(Scalar& a, Scalar& b) {
    const Scalar kept = a;
    a = b;
    b = kept;
  }
  int first(int j, int reach) const { return j > reach ? j - reach : 0; }
  int last(int j, int reach) const { return j + reach < n_ ? j + reach : n_ - 1; }
  Scalar& at(int i, int j) { return entries_[index(j) * index(Max) + index(i)]; }
  const Scalar& at(int i, int j) const { return entries_[index(j) * index(Max) + index(i)]; }

  void scale() {
    for (int i = 0; i < n_; ++i) row_scale_[index(i)] = 0;
    for (int j = 0; j < n_; ++j)
      for (int i = first(j, band_); i <= last(j, band_); ++i) {
        at(i, j) *= column_scale_[index(j)];
        row_scale_[index(i)] = larger(row_scale_[index(i)], std::fabs(at(i, j)));
      }
    for (int i = 0; i < n_; ++i)
      row_scale_[index(i)] = row_scale_[index(i)] > 0 ? Scalar(1) / row_scale_[index(i)] : Scalar(1);
    for (int j = 0; j < n_; ++j)
      for (int i = first(j, band_); i <= last(j, band_); ++i) at(i, j) *= row_scale_[index(i)];
  }

  /// U x = b for the leading `n` unknowns.
  template <class Vector>
  void back_substitute(Vector& x, int n) const {
    for (int k = n - 1; k >= 0; --k) {
      x[k] /= at(k, k);
      for (int i = first(k, 2 * band_); i < k; ++i) x[i] -= at(i, k) * x[k];
    }
  }

  std::array<Scalar, static_cast<std::size_t>(Max) * static_cast<std::size_t>(Max)> entries_;
  std::array<Scalar, static_cast<std::size_t>(Max)> row_scale_;
  std::array<Scalar, static_cast<std::size_t>(Max)> column_scale_;
  std::array<std::int16_t, static_cast<std::size_t>(Max)> pivot_;
  int n_ = 0;
  int band_ = 0;
};

}  // namespace taut
