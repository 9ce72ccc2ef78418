// L D L^T factorization of a symmetric positive definite matrix within its skyline, in fixed storage.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// A symmetric matrix of at most Max unknowns whose row i is zero before first(i); entries from there to the
/// diagonal are stored, at most `Entries` in all. Elimination fills nothing outside. Unlike a band, one long
/// row costs only itself.
template <class Scalar, int Max, int Entries>
class Skyline {
 public:
  /// Starts a matrix of n unknowns; first(i) is the first column of row i. Returns how many entries are
  /// missing, 0 if none.
  template <class First>
  int reset(int n, First first) {
    n_ = n;
    int used = 0;
    for (int i = 0; i < n; ++i) {
      first_[i] = first(i);
      used += i - first_[i] + 1;
      diagonal_[i] = used - 1;
    }
    if (used > Entries) return used - Entries;
    for (int k = 0; k < used; ++k) entry(k) = 0;
    return 0;
  }

  /// Adds to entry (i, j) of the lower triangle; the upper one is not stored and left out.
  void add(int i, int j, Scalar value) {
    if (j <= i) at(i, j) += value;
  }
  int size() const { return n_; }

  /// Factors in place. Returns -1, or the first unknown whose pivot is lost in the rounding of its diagonal:
  /// nothing holds it against the unknowns before it.
  int factor() {
    ratio_ = 1;
    for (int i = 0; i < n_; ++i) {
      const Scalar stiffness = at(i, i);
      for (int j = first_[i]; j < i; ++j)
        for (int k = larger(first_[i], first_[j]); k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      for (int j = first_[i]; j < i; ++j) {
        const Scalar scaled = at(i, j);
        at(i, j) /= at(j, j);
        at(i, i) -= scaled * at(i, j);
      }
      if (!(at(i, i) > lost_below * stiffness)) {
        is_negative_ = at(i, i) < -lost_below * std::fabs(stiffness);
        return i;
      }
      ratio_ = std::fmax(ratio_, stiffness / at(i, i));
    }
    return -1;
  }

  /// Solves A x = b in place.
  template <class Vector>
  void solve(Vector& x) const {
    for (int i = 0; i < n_; ++i)
      for (int j = first_[i]; j < i; ++j) x[i] -= at(i, j) * x[j];
    for (int i = 0; i < n_; ++i) x[i] /= at(i, i);
    transposed(x, n_);
  }

  /// After factor() returned `unknown`: the motion that nothing resists.
  template <class Vector>
  void null_vector(int unknown, Vector& x) const {
    for (int i = 0; i < n_; ++i) x[i] = 0;
    for (int j = first_[unknown]; j < unknown; ++j) x[j] = -at(unknown, j);
    x[unknown] = 1;
    transposed(x, unknown);
  }

  /// Then: whether its pivot is no rounding but negative. That motion does not come back by itself.
  bool is_negative() const { return is_negative_; }

  /// Largest loss of a diagonal to elimination: digits of the factorization that are spent, at least.
  Scalar condition() const { return ratio_; }

 private:
  static constexpr Scalar lost_below = 32 * std::numeric_limits<Scalar>::epsilon();

  static int larger(int a, int b) { return a > b ? a : b; }
  Scalar& entry(int k) { return entries_[static_cast<std::size_t>(k)]; }
  const Scalar& entry(int k) const { return entries_[static_cast<std::size_t>(k)]; }
  Scalar& at(int i, int j) { return entry(diagonal_[i] - (i - j)); }
  const Scalar& at(int i, int j) const { return entry(diagonal_[i] - (i - j)); }

  /// L^T x = b for the leading n unknowns.
  template <class Vector>
  void transposed(Vector& x, int n) const {
    for (int i = n - 1; i >= 0; --i)
      for (int j = first_[i]; j < i; ++j) x[j] -= at(i, j) * x[i];
  }

  // Only those of a matrix are cleared, by reset(), and most are never touched.
  std::array<Scalar, static_cast<std::size_t>(Entries)> entries_;
  FixedArray<int, Max> first_;
  FixedArray<int, Max> diagonal_;
  int n_ = 0;
  Scalar ratio_ = 1;
  bool is_negative_ = false;
};

}  // namespace taut
