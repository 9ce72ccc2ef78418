// LU factorization of a general matrix that grows by a row and a column at a time, in fixed storage.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "taut/numerics/larger.hpp"
#include "taut/scene/fixed_list.hpp"

namespace taut {

/// A = L U with unit lower triangular L, at most Max unknowns, without pivoting: a new last row and column
/// leave the factors of the others as they are, to the last bit.
///
/// An active set grows by one constraint at a time, so that an event costs n^2 operations in place of n^3;
/// and factors built anew in the order of entry have the same bits. Whoever appends chooses an order whose
/// pivots are not small, and corrects solutions with residuals.
template <class Scalar, int Max>
class BorderedLu {
 public:
  void clear() { size_ = 0; }
  int size() const { return size_; }
  /// Forgets all rows and columns from `size` on. No cost.
  void truncate(int size) { size_ = size; }

  /// Appends column(i) = A(i, n) for i <= n and row(i) = A(n, i) for i < n, where n is the present size:
  /// 2 n^2 operations. Returns the pivot in units of the largest entry of row and column; the caller
  /// truncates if it is too small.
  template <class Column, class Row>
  Scalar append(Column column, Row row) {
    const int n = size_;
    Scalar largest = std::fabs(column(n));
    for (int i = 0; i < n; ++i) {
      Scalar u = column(i), l = row(i);
      largest = larger(largest, larger(std::fabs(u), std::fabs(l)));
      for (int k = 0; k < i; ++k) {
        u -= at(i, k) * at(k, n);
        l -= at(n, k) * at(k, i);
      }
      at(i, n) = u;
      at(n, i) = l / at(i, i);
    }
    Scalar pivot = column(n);
    for (int k = 0; k < n; ++k) pivot -= at(n, k) * at(k, n);
    at(n, n) = pivot;
    ++size_;
    return largest > 0 ? std::fabs(pivot) / largest : Scalar(0);
  }

  /// Solves A x = b in place: 2 n^2 operations.
  template <class Vector>
  void solve(Vector& x) const {
    for (int i = 1; i < size_; ++i) {
      Scalar sum = x[i];
      for (int k = 0; k < i; ++k) sum -= at(i, k) * x[k];
      x[i] = sum;
    }
    for (int i = size_ - 1; i >= 0; --i) {
      Scalar sum = x[i];
      for (int k = i + 1; k < size_; ++k) sum -= at(i, k) * x[k];
      x[i] = sum / at(i, i);
    }
  }

 private:
  Scalar& at(int i, int j) { return entries_[i * Max + j]; }
  const Scalar& at(int i, int j) const { return entries_[i * Max + j]; }

  FixedArray<Scalar, Max * Max> entries_;
  int size_ = 0;
};

}  // namespace taut
