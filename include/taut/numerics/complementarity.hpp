// Linear complementarity: w = q + M z >= 0, z >= 0, w z = 0, by Lemke's method in fixed storage.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Numbers from 0 to 1 in general position, the same everywhere.
template <class Scalar>
Scalar scattered(int i) {
  const auto number = (static_cast<std::uint32_t>(i) + 1U) * 2654435769U;
  return static_cast<Scalar>(number >> 8) / Scalar(1 << 24);
}
/// The rule against cycling of every path of Lemke's here: each value carries a second, infinitely smaller
/// part, which is this number for the pair i at the start and decides among ties. The numbers are in general
/// position, between 1 and 2 and the same everywhere, so no two bases tie and none comes back: the number of
/// bases bounds the path (Cottle, Pang and Stone, The Linear Complementarity Problem, 4.9). That counts most
/// at a start from zero tension, where all pairs tie.
template <class Scalar>
Scalar perturbation(int i) {
  return Scalar(1) + scattered<Scalar>(i);
}
/// The bound where rounding takes part: pivots of a path through so many pairs.
constexpr int most_pivots(int pairs) { return 16 + 16 * pairs; }

/// Lemke's complementary pivoting for at most Max pairs with M written out (Cottle, Pang and Stone, algorithm
/// 4.4.5): one tableau of 2 n^2 numbers, every pivot costs as much. For problems from outside of a condensed
/// scene; ModeSolver follows the same path through a factorization that it keeps.
template <class Scalar, int Max>
class Lemke {
 public:
  enum class Outcome {
    solved,
    ray,     ///< no solution was found: in friction problems there is no equilibrium, or a mechanism
    pivots,  ///< the bound on pivots was reached
  };

  /// Starts a problem of n pairs with M = 0, q = 0.
  void reset(int n) {
    n_ = n;
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < columns(); ++c) at(i, c) = 0;
  }
  void set_M(int row, int column, Scalar value) { at(row, n_ + column) = -value; }
  void set_q(int row, Scalar value) { at(row, 2 * n_ + 1) = value; }

  /// Solves in place, in at most most_pivots(n) pivots. Another `attempt` (0, 1, ...) takes another covering
  /// vector: where M is in none of the classes for which Lemke's method is sure, one may lead to a ray and
  /// another to a solution.
  Outcome solve(int attempt = 0) {
    scale();
    for (int i = 0; i < n_; ++i) {
      at(i, i) = 1;
      at(i, cover()) = -covering(attempt, i);
      at(i, tie()) = perturbation<Scalar>(i);
      basic_[i] = i;
    }
    int row = 0;
    for (int i = 1; i < n_; ++i)
      if (less(i, -at(i, cover()), row, -at(row, cover()))) row = i;
    if (n_ == 0 || at(row, last()) >= -64 * epsilon) return Outcome::solved;
    int entering = cover();
    for (int count = 0; count < most_pivots(n_); ++count) {
      const int leaving = basic_[row];
      pivot(row, entering);
      if (leaving == cover()) return Outcome::solved;
      entering = leaving < n_ ? leaving + n_ : leaving - n_;
      row = ratio_test(entering);
      if (row < 0) return Outcome::ray;
    }
    return Outcome::pivots;
  }

  /// z_i of the solution.
  Scalar z(int i) const {
    for (int row = 0; row < n_; ++row)
      if (basic_[row] == n_ + i) return at(row, last()) > 0 ? at(row, last()) * scale_[i] : Scalar(0);
    return 0;
  }
  /// Whether z_i is basic: its complement w_i is held at zero.
  bool is_active(int i) const {
    for (int row = 0; row < n_; ++row)
      if (basic_[row] == n_ + i) return true;
    return false;
  }

 private:
  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  static constexpr Scalar solved_tie = sizeof(Scalar) == sizeof(float) ? Scalar(1e-5) : Scalar(1e-11);

  // Columns: w_0.. w_{n-1}, z_0.. z_{n-1}, the covering variable, the right-hand side and its second part.
  // Rows: w - M z - 1 cover = q.
  int columns() const { return 2 * n_ + 3; }
  int cover() const { return 2 * n_; }
  int last() const { return 2 * n_ + 1; }
  int tie() const { return 2 * n_ + 2; }
  Scalar& at(int row, int column) { return table_[row * (2 * Max + 3) + column]; }
  const Scalar& at(int row, int column) const { return table_[row * (2 * Max + 3) + column]; }

  /// Ones at first, then numbers between 1 and 3 without a pattern.
  static Scalar covering(int attempt, int i) {
    const int number = (i + 1) * (7 + 6 * attempt) % 17;
    return Scalar(1) + (attempt == 0 ? Scalar(0) : static_cast<Scalar>(number) / Scalar(8));
  }

  /// Measures every z so that the diagonal of M is one, and q by its largest entry.
  void scale() {
    Scalar largest = 0;
    for (int i = 0; i < n_; ++i) largest = std::fmax(largest, std::fabs(at(i, last())));
    for (int i = 0; i < n_; ++i) {
      const Scalar diagonal = std::fabs(at(i, n_ + i));
      const Scalar unit = diagonal > 0 ? Scalar(1) / diagonal : Scalar(1);
      for (int row = 0; row < n_; ++row) at(row, n_ + i) *= unit;
      scale_[i] = unit * largest;
      if (largest > 0) at(i, last()) /= largest;
    }
  }

  void pivot(int row, int entering) {
    const Scalar inverse = Scalar(1) / at(row, entering);
    for (int c = 0; c < columns(); ++c) at(row, c) *= inverse;
    at(row, entering) = 1;
    for (int i = 0; i < n_; ++i) {
      const Scalar factor = at(i, entering);
      if (i == row || factor == 0) continue;
      for (int c = 0; c < columns(); ++c) at(i, c) -= factor * at(row, c);
      at(i, entering) = 0;
    }
    basic_[row] = entering;
  }

  /// Whether row a / pa comes before row b / pb.
  bool less(int a, Scalar pa, int b, Scalar pb) const {
    const Scalar first = at(a, last()) / pa, second = at(b, last()) / pb;
    if (std::fabs(first - second) > Scalar(256) * epsilon * (Scalar(1) + std::fabs(first)))
      return first < second;
    return at(a, tie()) / pa < at(b, tie()) / pb;
  }

  int ratio_test(int entering) const {
    Scalar largest = 0;
    for (int i = 0; i < n_; ++i) largest = std::fmax(largest, std::fabs(at(i, entering)));
    const Scalar least = 64 * epsilon * larger(Scalar(1), largest);
    int best = -1;
    for (int i = 0; i < n_; ++i) {
      if (at(i, entering) <= least) continue;
      if (best < 0 || less(i, at(i, entering), best, at(best, entering))) best = i;
    }
    if (best < 0) return -1;
    // Among ties the covering variable leaves: the problem is solved. Dependent rows tie but for the rounding
    // of all pivots.
    for (int i = 0; i < n_; ++i)
      if (basic_[i] == cover() && at(i, entering) > least &&
          at(i, last()) / at(i, entering) <=
              at(best, last()) / at(best, entering) * (Scalar(1) + solved_tie) + solved_tie)
        return i;
    return best;
  }

  FixedArray<Scalar, Max*(2 * Max + 3)> table_;
  FixedArray<Scalar, Max> scale_;
  FixedArray<int, Max> basic_;
  int n_ = 0;
};

}  // namespace taut
