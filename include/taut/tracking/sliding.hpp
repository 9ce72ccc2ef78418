// Which of the joints at their limits slide: a linear complementarity problem, by Lemke's method.
#pragma once

#include <cmath>
#include <limits>

#include "taut/numerics/band_lu.hpp"
#include "taut/tracking/moves.hpp"

namespace taut {

/// 0 <= v, w >= 0, v w = 0: v are the rates of slip of joints at their limits, w = (T_small - rho T_big)' the
/// rates at which they leave them. Jacks and slack runs follow as they must.
///
/// Lemke's complementary pivoting (Cottle, Pang and Stone, The Linear Complementarity Problem, algorithm
/// 4.4.5). Every pivot factors the laws of the moves at work afresh, bordered by the covering variable:
/// memory for one matrix of the active moves in place of a tableau of all pairs, and no rounding handed on
/// from pivot to pivot.
template <class CondensedType, class Laws = JointLaws<CondensedType>>
class Sliding {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  static constexpr int max_active = max_active_moves<Cap>;
  static constexpr int max_candidates = 2 * Cap::joints;
  using Tensions = FixedArray<Real, Cap::segments>;
  using Actives = FixedList<Active, max_active>;
  using Candidates = FixedList<Candidate, max_candidates>;

  enum class Outcome {
    solved,
    ray,     ///< no solution was found: in friction problems there is no equilibrium, or a mechanism
    pivots,  ///< the bound on pivots was reached
  };

  /// `others` are the active moves besides slips, `rate` the rates of tension with every joint stuck, of
  /// which less than `none` is rounding. Another `attempt` (0, 1, ...) takes another covering vector: where
  /// the problem is in none of the classes for which Lemke's method is sure, one may lead to a ray and
  /// another to a solution.
  Outcome solve(const CondensedType& model, const Laws& joints, const Actives& others,
                const Candidates& candidates, const Tensions& rate, Real none, int attempt) {
    model_ = &model;
    joints_ = &joints;
    candidates_ = &candidates;
    basis_ = others;
    others_ = others.size();
    rate_ = rate;
    cover_all(attempt);
    of_.clear();
    at_.fill(Real(0));
    cover_ = 0;
    int entering = -1;
    for (int i = 0; i < candidates.size(); ++i) {
      const Real needed = -w_without_cover(i) / covering(i);
      if (needed <= cover_) continue;
      cover_ = needed;
      entering = i;
    }
    if (cover_ <= none) return Outcome::solved;
    largest_ = cover_;

    bool slips = true;  // what enters: the slip of the candidate, or its distance from the limit
    for (int count = 0; count < 8 + 8 * candidates.size(); ++count) {
      if (slips && !enter(entering)) return Outcome::ray;
      if (!find_direction(entering, slips)) return Outcome::ray;
      if (!go_to_the_next(entering, slips)) return Outcome::ray;
      if (cover_ == 0) return Outcome::solved;
    }
    return Outcome::pivots;
  }

  /// How many candidates slide, and which.
  int size() const { return of_.size(); }
  int operator[](int i) const { return of_[i]; }

 private:
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  static constexpr int max_basis = max_active + 1;

  /// Ones at first. Then more for joints between segments that both lose tension: those are apt to be at both
  /// limits, long before the others have raised their tension. In the end numbers without a pattern.
  void cover_all(int attempt) {
    for (int i = 0; i < candidates_->size(); ++i) {
      const auto& sides = joints_->sides((*candidates_)[i].joint);
      const bool losing = rate_[sides[0]] + rate_[sides[1]] < 0;
      const int scattered = attempt == 0 ? 0 : (i + 1) * (7 + 6 * attempt) % 17;
      const int doubled = attempt < 3 ? 2 * attempt * (losing ? 1 : 0) : (i + 3) * (5 + 2 * attempt) % 13;
      covering_[i] = (Real(1) + static_cast<Real>(scattered) / Real(8)) * static_cast<Real>(1 << doubled);
    }
  }
  Real covering(int i) const { return covering_[i]; }
  Law<Real> limit(int i) const { return joints_->limit((*candidates_)[i]); }
  Real w_without_cover(int i) const { return limit(i).of(rate_); }
  Real w(int i) const { return w_without_cover(i) + covering(i) * cover_; }
  Real stiffness(const Move& move) const { return model_->coupling(move.lengthened, move.lengthened); }
  bool is_in_basis(int candidate) const {
    for (const int i : of_)
      if (i == candidate) return true;
    return false;
  }

  /// A joint that would have to slide both ways at once is the end of a ray.
  bool enter(int candidate) {
    for (const int i : of_)
      if ((*candidates_)[i].joint == (*candidates_)[candidate].joint) return false;
    at_[of_.size()] = 0;
    of_.add(static_cast<std::int16_t>(candidate));
    basis_.add(joints_->sliding((*candidates_)[candidate]));
    return true;
  }
  void leave(int place) {
    for (int i = place; i + 1 < of_.size(); ++i) {
      of_[i] = of_[i + 1];
      at_[i] = at_[i + 1];
      basis_[others_ + i] = basis_[others_ + i + 1];
    }
    of_.drop_last();
    basis_.drop_last();
  }

  /// Changes of the moves, the cover and all rates while one variable enters the basis.
  bool find_direction(int entering, bool slips) {
    const int n = basis_.size();
    BandLu<Real, max_basis> bordered;
    bordered.reset(n + 1, n);
    for (int i = 0; i < n; ++i) {
      const Law<Real> law = joints_->of(basis_[i]);
      for (int k = 0; k < n; ++k) bordered.add(i, k, resistance(*model_, law, basis_[k].move));
    }
    for (int k = 0; k < n; ++k) {
      const Move& move = basis_[k].move;
      bordered.set_column_scale(k, Real(1) / stiffness(move));
      if (!slips) bordered.add(n, k, resistance(*model_, limit(entering), move));
    }
    for (int i = others_; i < n; ++i) bordered.add(i, n, covering(of_[i - others_]));
    bordered.set_column_scale(n, Real(1));
    if (slips) {
      const Active& last = basis_[n - 1];
      bordered.add(n, n - 1, static_cast<Real>(last.sense) * stiffness(last.move));
    } else {
      bordered.add(n, n, covering(entering));
    }
    if (bordered.factor() >= 0) return false;
    change_.fill(Real(0));
    change_[n] = 1;
    bordered.solve(change_);

    Tensions e;
    e.fill(Real(0));
    for (int k = 0; k < n; ++k) basis_[k].move.impose(change_[k], e);
    rate_change_.fill(Real(0));
    model_->coupling.add(model_->segments, e, rate_change_);
    return true;
  }

  /// Goes along the direction until a variable of the basis is zero; that one leaves, and its complement is
  /// the next to enter. False on a ray.
  bool go_to_the_next(int& entering, bool& slips) {
    const int n = basis_.size();
    const Real cover_change = change_[n];
    Real step = std::numeric_limits<Real>::max();
    int leaving = -1;
    bool leaving_slips = false;
    const auto consider = [&](Real value, Real falling, int candidate, bool is_slip) {
      if (falling >= -64 * epsilon) return;
      const Real reach = value > 0 ? value / -falling : Real(0);
      if (reach >= step) return;
      step = reach;
      leaving = candidate;
      leaving_slips = is_slip;
    };
    for (int i = 0; i < candidates_->size(); ++i) {
      if (i == entering || is_in_basis(i)) continue;
      consider(w(i), limit(i).of(rate_change_) + covering(i) * cover_change, i, false);
    }
    for (int i = 0; i < of_.size(); ++i) {
      if (slips && of_[i] == entering) continue;
      const Active& active = basis_[others_ + i];
      const Real unit = static_cast<Real>(active.sense) * stiffness(active.move);
      consider(unit * at_[i], unit * change_[others_ + i], i, true);
    }
    // Among ties the cover leaves: the problem is solved.
    const Real tie = 1024 * epsilon * largest_;
    if (cover_change < 0 && cover_ / -cover_change <= step + tie / -cover_change) {
      cover_ = 0;
      return true;
    }
    if (leaving < 0) return false;
    cover_ += step * cover_change;
    for (int i = 0; i < of_.size(); ++i) at_[i] += step * change_[others_ + i];
    for (int i = 0; i < model_->segments; ++i) rate_[i] += step * rate_change_[i];
    if (leaving_slips) {
      entering = of_[leaving];
      leave(leaving);
    } else {
      entering = leaving;
    }
    slips = !leaving_slips;
    return true;
  }

  const CondensedType* model_ = nullptr;
  const Laws* joints_ = nullptr;
  const Candidates* candidates_ = nullptr;
  FixedList<std::int16_t, Cap::joints> of_;  // candidates whose slip is in the basis
  FixedArray<Real, Cap::joints> at_;         // their slips
  Actives basis_;                            // the other moves, then those slips
  int others_ = 0;
  FixedArray<Real, max_candidates> covering_;
  Real cover_ = 0;
  Real largest_ = 0;
  Tensions rate_;
  FixedArray<Real, max_basis> change_;  // of the moves of the basis and the cover
  Tensions rate_change_;
};

}  // namespace taut
