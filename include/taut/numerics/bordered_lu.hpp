// LU factorization of a general matrix that grows by a row and a column at a time, in fixed storage.
#pragma once

#include <cmath>
#include <type_traits>

#include "taut/numerics/axpy.hpp"
#include "taut/numerics/bits.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// A = L U with unit lower triangular L, at most Max unknowns, without pivoting: a new last row and column
/// leave the factors of the others as they are, to the last bit.
///
/// An active set grows by one constraint at a time, so that an event costs n^2 operations in place of n^3;
/// and factors built anew in the order of entry have the same bits. Whoever appends chooses an order whose
/// pivots are not small, and corrects solutions with residuals. Columns are contiguous, and one division a
/// pivot is all there is.
template <class Scalar, int Max>
class BorderedLu {
 public:
  void clear() { size_ = 0; }
  int size() const { return size_; }
  /// Forgets all rows and columns from `size` on. No cost.
  void truncate(int size) { size_ = size; }

  /// Appends column(i) = A(i, n) for i <= n and row(i) = A(n, i) for i < n, where n is the present size:
  /// 2 n^2 operations. Returns the pivot, with its sign, in units of the largest entry of row and column; the
  /// caller truncates if it is too small.
  template <class Column, class Row>
  Scalar append(Column column, Row row) {
    const int n = size_;
    Scalar* const u = &at(0, n);
    Scalar largest = 0;
    for (int i = 0; i <= n; ++i) {
      u[i] = column(i);
      largest = larger(largest, std::fabs(u[i]));
    }
    for (int k = 0; k < n; ++k) axpy(n - 1 - k, -u[k], &at(k, k) + 1, u + k + 1);
    FixedArray<Scalar, Max> l;
    for (int i = 0; i < n; ++i) {
      const Scalar entry = row(i);
      largest = larger(largest, std::fabs(entry));
      l[i] = (entry - dot(i, &l[0], &at(0, i))) * at(i, i);
      at(n, i) = l[i];
    }
    const Scalar pivot = u[n] - dot(n, &l[0], u);
    u[n] = Scalar(1) / pivot;
    ++size_;
    return largest > 0 ? pivot / largest : Scalar(0);
  }

  /// Solves A x = b in place, in the numbers of x: 2 n^2 operations.
  template <class Vector>
  void solve(Vector& x) const {
    using Number = std::decay_t<decltype(x[0])>;
    // Most often little is due, and where nothing is, nothing follows.
    int first = 0;
    while (first < size_ && bits_of(x[first]) == 0) ++first;
    for (int k = first; k + 1 < size_; ++k) axpy(size_ - 1 - k, -x[k], &at(k, k) + 1, &x[k] + 1);
    for (int k = size_ - 1; k >= 0; --k) {
      x[k] *= static_cast<Number>(at(k, k));
      axpy(k, -x[k], &at(0, k), &x[0]);
    }
  }

 private:
  /// Four sums, whose order no compiler may choose: none waits for the one before.
  static Scalar dot(int n, const Scalar* a, const Scalar* b) {
    Scalar sums[4] = {};
    int i = 0;
    for (; i + 4 <= n; i += 4)
      for (int k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) sums[0] += a[i] * b[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  /// Below the diagonal L, above it U, on it one over the pivot.
  Scalar& at(int i, int j) { return entries_[j * Max + i]; }
  const Scalar& at(int i, int j) const { return entries_[j * Max + i]; }

  FixedArray<Scalar, Max * Max> entries_;
  int size_ = 0;
};

}  // namespace taut
