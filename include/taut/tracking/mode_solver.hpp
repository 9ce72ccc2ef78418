// Which joints stick or slide, and which segments go slack: the one decision of an event.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "taut/numerics/complementarity.hpp"
#include "taut/tracking/active_set.hpp"

namespace taut {

/// The rate problem of an event, Eq. (10): for every joint at a limit and every segment of a span without
/// tension
///     0 <= v  _|_  w = (T_small - rho T_big)' >= 0,        0 <= h  _|_  t = T' - L >= 0,
/// where v are rates of slip, h rates of length that a segment has too much, T' = b' + C (v, h) after jacks
/// and slack spans have followed.
///
/// Lemke's path (Cottle, Pang and Stone, The Linear Complementarity Problem, 4.4): a covering variable z
/// makes the point feasible, and one pair after the other changes sides until z is zero. Among ties
/// perturbation() decides. No M is made: a column is what a slip variable does through the factors of the
/// set, those of the piece before serve on, and a slip that would make them singular waits for another. In
/// the form with the tensions of all spans at zero as unknowns, M = [F, -U; R, 0] gives
///     z'Mz = T'FT + sum (1 - rho) v T_big >= 0:
/// copositive, and q'z >= 0 where that vanishes; the path then ends in a solution (theorem 4.4.13). That
/// covers every start from zero tension for rho in (0, 1] and jacks that satisfy the cones. It does not cover
/// rates of spans under tension, where friction may leave no rate at all: then the path ends on a ray.
template <class CondensedType, class Laws>
class ModeSolver {
 public:
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Set = ActiveSet<CondensedType, Laws>;
  using Tensions = typename Set::Tensions;
  using Values = typename Set::Values;
  static constexpr int max_pairs = Cap::segments + 2 * Cap::joints;

  enum class Outcome : std::uint8_t {
    solved,
    ray,      ///< no rates satisfy friction and equilibrium at once
    pivots,   ///< the bound on pivots was reached
    singular  ///< two states differ by less than rounding
  };

  /// A slip of a joint at its limit, or a segment (`way` stick) of a span without tension.
  struct Pair {
    std::int16_t index = 0;
    JointState way = JointState::stick;
    bool is_slack = false;  ///< a segment that has length to spare already
    bool is_segment() const { return way == JointState::stick; }
    SlipMode slip() const { return {index, way}; }
  };

  /// Tensions and slips of the set, or their rates.
  struct Response {
    Tensions T;
    Values values;
  };

  /// Begins with no pair. `set` has the slips that follow whatever happens, and the slips that go on for
  /// sure. `covering` is the number of the covering vector: where one path ends on a ray, one with another
  /// vector may end in a solution.
  void begin(const CondensedType& model, const Laws& laws, Set& set, int covering = 0) {
    covering_ = covering;
    model_ = &model;
    laws_ = &laws;
    set_ = &set;
    equalities_ = 0;
    pairs_.clear();
    least_.fill(Real(0));
    stiffest_ = set.stiffest();
  }
  void add_slip(const SlipMode& slip) { pairs_.add({slip.joint, slip.way}); }
  /// `least` is the rate of tension that jacks and friction give it at least. `is_slack`: where all goes on
  /// it has length to spare at first.
  void add_segment(int segment, Real least, bool is_slack = false) {
    least_[segment] = least;
    pairs_.add({static_cast<std::int16_t>(segment), JointState::stick, is_slack});
  }
  const FixedList<Pair, max_pairs>& pairs() const { return pairs_; }
  /// After solve(): whether the pair slides, or the segment has more and more length to spare.
  bool is_active(int pair) const { return place_[pair] != inactive; }
  Real value(int pair) const { return value_[pair]; }
  const Tensions& rates() const { return T_; }
  /// After a ray: whether it is a motion that no tension resists, and the pair that moves. Where there was no
  /// pivot at the end: the pair that waited for one, or would leave. Otherwise -1.
  bool is_free() const { return is_free_; }
  int last_pair() const { return last_; }

  /// Solves for the rates `stuck` that tensions have with every joint stuck; `due` are the rates of the laws
  /// in the set. Rates below `none` are zero. `go_on`: slips in the set that have their sign stay, those that
  /// have not turn round or leave, and only the limits that are violated then are covered: an ordinary event
  /// is one pivot. Otherwise the set has no slips and the problem is solved from zero.
  ///
  /// At most most_pivots() of all pairs, each with one to three solutions of the set. On success the set has
  /// the slips that slide and the segments that go slack.
  Outcome solve(const Tensions& stuck, const Values& due, Real none, bool go_on) {
    const Outcome outcome = begin_path(
        due, none, go_on, [&](Tensions& T) { T = stuck; }, [](Tensions&, Values&) { return false; });
    return outcome == Outcome::pivots ? follow_path() : outcome;
  }
  /// The first part of solve(), up to where follow_path() goes on: then `pivots` is returned. `find_stuck(T)`
  /// gives the rates with every joint stuck; `find_known(T, values)`, asked once, tensions and slips where
  /// all goes on with the set as it is, or false if that has not been worked out.
  template <class FindStuck, class FindKnown>
  Outcome begin_path(const Values& due, Real none, bool go_on, const FindStuck& find_stuck,
                     const FindKnown& find_known) {
    none_ = none;
    pivots_ = 0;
    z_ = z_tie_ = 0;
    is_pending_ = is_free_ = false;
    last_ = -1;
    covers_all_ = !go_on;
    value_.fill(Real(0));
    tie_.fill(Real(0));
    place_.fill(inactive);
    equalities_ = 0;
    while (equalities_ < set_->size() && (*set_)[equalities_].sense == 0) ++equalities_;
    for (int p = 0; go_on && p < pairs_.size(); ++p)
      if (pairs_[p].is_slack && !enter(p)) return Outcome::singular;
    const Real softest = Real(1) / stiffest_;
    for (int p = 0; p < pairs_.size(); ++p)
      scale_[segment_of(p)] = std::sqrt(static_cast<float>(stiffness(active_of(p)) * softest));
    if (go_on) {
      bool any = false;
      if (!keep_what_goes_on(due, find_stuck, find_known, any)) return Outcome::singular;
      if (!any) return Outcome::solved;
    } else {
      find_stuck(T_);
      if (!begin_from_zero(due)) return Outcome::singular;
    }
    perturb();
    return Outcome::pivots;
  }
  /// After begin_path(): from there to the end.
  Outcome follow_path();

 private:
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  static constexpr std::int16_t inactive = -1;
  /// Pivots of the set, relative to its entries: below, the slip waits until another makes room for it.
  static constexpr Real least_pivot = Real(1e-10);
  /// Of the covering variable along the path: less is rounding.
  static constexpr Real least_slope = Real(1e-13);
  /// The response to the covering variable is carried on while its rounding has grown no more than that:
  /// less than the least rate that counts.
  static constexpr Real most_growth = 4096;
  /// A covering variable that is so small a part of what it was at first is zero.
  static constexpr Real rounding = Real(1e-12);

  // Pairs as slip variables and rows.

  ActiveConstraint active_of(int p) const {
    const Pair& pair = pairs_[p];
    ActiveConstraint active =
        pair.is_segment()
            ? ActiveConstraint{SlipVariable::of(SlipVariable::Kind::slack_length, pair.index, pair.index),
                               pair.index, 0}
            : laws_->sliding(pair.slip());
    active.pair = static_cast<std::int16_t>(p);
    return active;
  }
  /// t or w of a pair at tensions T.
  Real row(int p, const Tensions& T) const {
    const Pair& pair = pairs_[p];
    return pair.is_segment() ? T[pair.index] : laws_->limit(pair.slip()).of(T);
  }
  Real stiffness(const ActiveConstraint& active) const { return set_->stiffness(active.variable); }
  /// Symmetric scaling to a unit diagonal: what a unit of the covering variable adds to a row [-].
  Real cover(int p) const {
    if (!covers_[p]) return 0;
    if (covering_ == 0) return scale(p);
    return scale(p) * (Real(1) + Real(3) * scattered<Real>(p + covering_ * max_pairs));
  }
  Real scale(int p) const { return static_cast<Real>(scale_[segment_of(p)]); }
  /// Which its slip variable lengthens: those that lengthen the same one have the same stiffness.
  int segment_of(int p) const {
    return pairs_[p].is_segment() ? pairs_[p].index : laws_->sides(pairs_[p].index)[0];
  }
  Real perturbation(int p) const { return scale(p) * taut::perturbation<Real>(p); }
  /// What a variable's value, in the sense in which it slides, is in its own segment [N].
  Real along(const ActiveConstraint& active, Real value) const {
    return signed_by(active, value) * stiffness(active);
  }
  /// The value that is one there [m/N].
  Real unit(const ActiveConstraint& active) const {
    return signed_by(active, set_->flexibility(active.variable));
  }
  static Real signed_by(const ActiveConstraint& active, Real value) {
    return active.sense < 0 ? -value : value;
  }

  // The start.

  /// All segments of the pairs are without tension and take what length they like.
  [[gnu::noinline]] bool begin_from_zero(const Values& due) {
    covers_.fill(true);
    set_->truncate(equalities_);
    for (int p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].is_segment() && !enter(p)) return false;
    Values values, dues;
    values.fill(Real(0));
    dues.fill(Real(0));
    for (int i = 0; i < set_->size(); ++i) dues[i] = i < equalities_ ? due[i] : least_[(*set_)[i].on];
    set_->settle(*laws_, dues, T_, values);
    keep_values(values, value_, Real(1));
    return true;
  }
  /// Slips in the set whose rates have the wrong sign leave, and enter the other way, once, where that limit
  /// holds too. `any`: whether a limit is violated then.
  template <class FindStuck, class FindKnown>
  [[gnu::noinline]] bool keep_what_goes_on(const Values& due, const FindStuck& find_stuck,
                                           const FindKnown& find_known, bool& any) {
    covers_.fill(false);
    FixedArray<bool, max_pairs> has_left;
    has_left.fill(false);
    name_all();
    bool is_first = true;
    for (int rounds = 2 * (set_->size() - equalities_); rounds >= 0; --rounds) {
      Values values;
      values.fill(Real(0));
      if (!is_first || !find_known(T_, values)) {
        find_stuck(T_);
        set_->settle(*laws_, due, T_, values);
      }
      is_first = any = false;
      FixedArray<bool, Set::capacity> leaves;
      for (int i = 0; i < set_->size(); ++i) {
        leaves[i] = i >= equalities_ && along((*set_)[i], values[i]) < -none_;
        any = any || leaves[i];
      }
      if (!any) {
        keep_values(values, value_, Real(1));
        break;
      }
      FixedArray<bool, max_pairs> turns;
      turns.fill(false);
      for (int i = equalities_; i < set_->size(); ++i) {
        const int p = leaves[i] ? (*set_)[i].pair : -1;
        if (p < 0) continue;
        has_left[p] = true;
        const int other = pairs_[p].is_segment() ? -1 : other_way(p);
        if (other >= 0) turns[other] = !has_left[other];
      }
      if (!set_->remove_if(*laws_, [&](int i) { return leaves[i]; })) return false;
      place_.fill(inactive);
      name_all();
      for (int p = 0; p < pairs_.size(); ++p)
        if (turns[p]) static_cast<void>(enter(p, Set::small));
    }
    any = false;
    for (int p = 0; p < pairs_.size(); ++p) {
      covers_[p] = place_[p] == inactive && row(p, T_) < -none_;
      any = any || covers_[p];
    }
    return true;
  }
  /// Finds the pairs of the slips that are in the set.
  void name_all() {
    for (int i = equalities_; i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      const int p = active.slides() ? find(active.variable.index, active.sense > 0) : active.pair;
      if (p < 0) continue;
      set_->set_pair(i, p);
      place_[p] = 0;
    }
  }
  int other_way(int p) const { return find(pairs_[p].index, pairs_[p].way != JointState::forward); }
  int find(int joint, bool forward) const {
    for (int p = 0; p < pairs_.size(); ++p)
      if (!pairs_[p].is_segment() && pairs_[p].index == joint &&
          (pairs_[p].way == JointState::forward) == forward)
        return p;
    return -1;
  }
  void keep_values(const Values& values, FixedArray<Real, max_pairs>& of_pair, Real times) {
    for (int i = equalities_; i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      if (active.pair >= 0) of_pair[active.pair] += times * along(active, values[i]);
    }
  }
  /// The second part of all values.
  void perturb() {
    T_tie_.fill(Real(0));
    if (covers_all_) {
      for (int p = 0; p < pairs_.size(); ++p)
        if (pairs_[p].is_segment())
          set_->carry(pairs_[p].index, -perturbation(p) * unit(active_of(p)), T_tie_);
      Values values, dues;
      values.fill(Real(0));
      dues.fill(Real(0));
      set_->settle(*laws_, dues, T_tie_, values);
      keep_values(values, tie_, Real(1));
    }
    for (int i = equalities_; i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      if (active.pair >= 0 && !is_lengthened(active.pair)) tie_[active.pair] = perturbation(active.pair);
    }
  }

  // The path.

  /// At first the response to the covering variable alone: there is one storage for both.
  struct Direction : Response {
    Real z = 0, entering = 0, pending = 0;
    bool enters = false;       // the entering variable, rather than its row
    bool is_of_cover = false;  // the response of the present set to a unit of the covering variable
    int pair = -1;
    Real growth = 1;  // of its rounding since it was worked out through the factors
  };
  Real tie_of_row(int p) const {
    const Real of_tensions = row(p, T_tie_);
    return is_lengthened(p) ? of_tensions : of_tensions + perturbation(p) + cover(p) * z_tie_;
  }
  Real value_of_row(int p) const {
    const Real of_tensions = row(p, T_);
    return is_lengthened(p) ? of_tensions - least_[pairs_[p].index] : of_tensions + cover(p) * z_;
  }

  void respond(const ActiveConstraint& to, Response& response) const {
    response.T.fill(Real(0));
    set_->carry(to.variable, unit(to), response.T);
    settle_rates(response, false);
  }
  void respond_to_cover(Response& response) const {
    response.T.fill(Real(0));
    response.values.fill(Real(0));
    bool any = covers_all_;
    for (int i = equalities_; i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      any = any || (active.pair >= 0 && covers_[active.pair]);
    }
    if (!any) return;
    if (covers_all_)
      for (int p = 0; p < pairs_.size(); ++p)
        if (pairs_[p].is_segment()) set_->carry(pairs_[p].index, -cover(p) * unit(active_of(p)), response.T);
    settle_rates(response, true);
  }
  void settle_rates(Response& response, bool is_cover) const {
    Values dues;
    dues.fill(Real(0));
    for (int i = equalities_; is_cover && i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      if (active.pair >= 0) dues[i] = -direct(active.pair);
    }
    response.values.fill(Real(0));
    set_->settle(*laws_, dues, response.T, response.values);
  }
  /// What a unit of the covering variable adds to the row itself.
  Real direct(int p) const { return is_lengthened(p) ? Real(0) : cover(p); }
  /// From zero, segments are covered and perturbed by lengths that they all have too much.
  bool is_lengthened(int p) const { return covers_all_ && pairs_[p].is_segment(); }

  /// Along which the laws of the set hold, that of the pending slip, and that of the entering one.
  bool find(Direction& direction) {
    Response other;  // one storage: what is pending is worked out twice where something else enters
    if (!direction.is_of_cover) {
      respond_to_cover(direction);
      direction.growth = 1;
    }
    direction.is_of_cover = false;
    const int e = direction.pair, k = pending_;
    const Real rz = row(e, direction.T) + direct(e);
    Real by_z = 0, by_entering = 0, by_pending = 0;
    Real rk = 0, kk = 0, re = 0, ke = 0;
    if (is_pending_) {
      respond(active_of(k), other);
      rk = row(e, other.T);
      kk = row(k, other.T);
    }
    if (direction.enters) {
      respond(active_of(e), other);
      re = row(e, other.T);
      if (is_pending_) ke = row(k, other.T);
    }
    if (!is_pending_) {
      if (direction.enters) {
        by_entering = std::fabs(rz);
        by_z = rz < 0 ? re : -re;
      } else {
        by_z = rz < 0 ? Real(-1) : Real(1);
        if (rz == 0) return false;
      }
    } else {
      const Real kz = row(k, direction.T) + direct(k);
      if (direction.enters) {
        // The cross product of the two rows, in the order entering, pending, z.
        by_entering = rk * kz - rz * kk;
        by_pending = rz * ke - re * kz;
        by_z = re * kk - rk * ke;
        if (by_entering < 0) {
          by_entering = -by_entering;
          by_pending = -by_pending;
          by_z = -by_z;
        }
      } else {
        by_pending = kz;
        by_z = -kk;
        if (by_pending * rk + by_z * rz < 0) {
          by_pending = -by_pending;
          by_z = -by_z;
        }
      }
    }
    const Real most = larger(std::fabs(by_z), larger(std::fabs(by_entering), std::fabs(by_pending)));
    if (!(most > 0)) return false;
    by_z = std::fabs(by_z) > least_slope * most ? by_z / most : Real(0);
    by_entering /= most;
    by_pending /= most;
    direction.z = by_z;
    direction.entering = by_entering;
    direction.pending = by_pending;
    for (int i = 0; i < model_->segments; ++i) direction.T[i] *= by_z;
    for (int i = 0; i < set_->size(); ++i) direction.values[i] *= by_z;
    const auto add_other = [&](Real times) {
      axpy(model_->segments, times, &other.T[0], &direction.T[0]);
      axpy(set_->size(), times, &other.values[0], &direction.values[0]);
    };
    if (direction.enters) add_other(by_entering);
    if (!is_pending_) return true;
    if (direction.enters) respond(active_of(k), other);
    add_other(by_pending);
    return true;
  }

  /// Goes along the direction until something is zero; that leaves, and its complement is the next to enter.
  /// `pivots` means: not at the end yet.
  Outcome go(Direction& direction) {
    const Real largest_rate = largest(model_->segments, &direction.T[0], std::fabs(direction.z));
    const Real least_rate = Real(1e-11) * largest_rate, zero = Real(1e-13) * largest_ + none_;
    Blocking blocking;
    const auto consider = [&](Real rate, Leaves what, int pair) {
      if (!(rate < -least_rate)) return;
      const Real value = what == Leaves::row ? value_of_row(pair) : value_[pair];
      const Real step = value > zero ? value / -rate : Real(0);
      const Real same = Real(1e-13) * larger(step, blocking.step) + zero;
      if (blocking.what != Leaves::nothing && !(step <= blocking.step + same)) return;
      const Real step_tie = (what == Leaves::row ? tie_of_row(pair) : tie_[pair]) / -rate;
      if (blocking.what == Leaves::nothing || step < blocking.step - same || step_tie < blocking.step_tie)
        blocking = {what, pair, step, step_tie};
    };
    for (int i = equalities_; i < set_->size(); ++i) {
      const ActiveConstraint& active = (*set_)[i];
      if (active.pair < 0) continue;
      const Real rate = along(active, direction.values[i]);
      consider(rate, Leaves::active, active.pair);
    }
    if (is_pending_) consider(direction.pending, Leaves::pending, pending_);
    for (int p = 0; p < pairs_.size(); ++p) {
      if (place_[p] != inactive || p == direction.pair) continue;
      const Real rate = row(p, direction.T) + direct(p) * direction.z;
      consider(rate, Leaves::row, p);
    }
    // Among ties the cover leaves: the problem is solved.
    if (direction.z < 0) {
      const Real step = z_ / -direction.z;
      const Real same = Real(1e-13) * larger(step, blocking.step) + zero;
      if (blocking.what == Leaves::nothing || step <= blocking.step + same)
        blocking = {Leaves::cover, -1, step, Real(0)};
    }
    if (blocking.what == Leaves::nothing) {
      const Real most = largest(model_->segments, &direction.T[0]);
      is_free_ = direction.z == 0 && direction.enters && most <= Real(1e-9);
      last_ = direction.pair;
      return Outcome::ray;
    }
    step_along(direction, blocking);
    return change_sides(direction, blocking);
  }
  enum class Leaves : std::uint8_t { nothing, active, pending, row, cover };
  struct Blocking {
    Leaves what = Leaves::nothing;
    int pair = -1;
    Real step = 0, step_tie = 0;
  };
  void step_along(const Direction& direction, const Blocking& blocking) {
    axpy(model_->segments, blocking.step, &direction.T[0], &T_[0]);
    axpy(model_->segments, blocking.step_tie, &direction.T[0], &T_tie_[0]);
    keep_values(direction.values, value_, blocking.step);
    keep_values(direction.values, tie_, blocking.step_tie);
    z_ += blocking.step * direction.z;
    z_tie_ += blocking.step_tie * direction.z;
    if (is_pending_) {
      value_[pending_] += blocking.step * direction.pending;
      tie_[pending_] += blocking.step_tie * direction.pending;
    }
    if (direction.enters) {
      value_[direction.pair] += blocking.step * direction.entering;
      tie_[direction.pair] += blocking.step_tie * direction.entering;
    }
  }
  Outcome change_sides(Direction& direction, const Blocking& blocking) {
    const bool was_pending = is_pending_;
    int waiting[2] = {-1, -1}, count = 0;
    if (is_pending_ && blocking.what != Leaves::pending) waiting[count++] = pending_;
    if (direction.enters) waiting[count++] = direction.pair;
    if (blocking.what == Leaves::pending) place_[pending_] = inactive;
    is_pending_ = false;
    if (blocking.what == Leaves::active && !leave(blocking.pair)) {
      last_ = blocking.pair;
      return Outcome::singular;
    }
    // The one with the larger pivot first.
    for (int i = 0; i < count; ++i) {
      bool entered = false;
      for (int k = 0; k < count && !entered; ++k) {
        if (waiting[k] < 0 || !enter(waiting[k], least_pivot)) continue;
        waiting[k] = -1;
        entered = true;
      }
      if (!entered) break;
    }
    for (int k = 0; k < count; ++k) {
      if (waiting[k] < 0) continue;
      if (is_pending_) {
        last_ = pending_;
        return Outcome::singular;
      }
      is_pending_ = true;
      pending_ = waiting[k];
      place_[pending_] = 1;
    }
    if (blocking.what == Leaves::cover || z_ <= rounding * largest_) {
      if (!is_pending_) return Outcome::solved;
      is_pending_ = false;
      if (enter(pending_)) return Outcome::solved;
      // A slip that changes nothing need not be.
      place_[pending_] = inactive;
      return Outcome::solved;
    }
    if (blocking.what == Leaves::row && !was_pending && !is_pending_) carry_cover(direction);
    direction.pair = blocking.pair;
    direction.enters = blocking.what == Leaves::row;
    return Outcome::pivots;
  }
  /// What entered keeps its row at zero along the direction, and nothing left: by a unit of the covering
  /// variable that is the response of the new set.
  void carry_cover(Direction& direction) {
    direction.growth /= std::fabs(direction.z);
    if (!(direction.growth <= most_growth)) return;
    const Real by = Real(1) / direction.z;
    for (int i = 0; i < model_->segments; ++i) direction.T[i] *= by;
    for (int i = 0; i < set_->size(); ++i) direction.values[i] *= by;
    if (direction.enters) {
      const int last = set_->size() - 1;
      direction.values[last] = unit((*set_)[last]) * direction.entering * by;
    }
    direction.is_of_cover = true;
  }
  bool enter(int p, Real least = Set::singular) {
    if (!set_->append(*laws_, active_of(p), least)) return false;
    place_[p] = 0;
    return true;
  }
  bool leave(int p) {
    place_[p] = inactive;
    value_[p] = tie_[p] = 0;
    for (int i = equalities_; i < set_->size(); ++i)
      if ((*set_)[i].pair == p) return set_->remove(*laws_, i);
    return false;
  }

  const CondensedType* model_ = nullptr;
  const Laws* laws_ = nullptr;
  Set* set_ = nullptr;
  FixedList<Pair, max_pairs> pairs_;
  FixedArray<bool, max_pairs> covers_;
  FixedArray<std::int8_t, max_pairs> place_;  // inactive, in the set (0), pending (1)
  FixedArray<float, Cap::segments> scale_;    // a float has digits enough, and its roots cost one instruction
  FixedArray<Real, max_pairs> value_, tie_;   // of h and v [N]; the second part decides among ties
  Tensions least_;                            // L
  Tensions T_, T_tie_;
  int equalities_ = 0;  // the first slips of the set: they follow whatever happens
  int pending_ = 0;     // a slip that is at work but would make the set singular
  int pivots_ = 0;
  int covering_ = 0;
  int last_ = -1;
  bool is_free_ = false;
  bool is_pending_ = false;
  bool covers_all_ = true;
  Real z_ = 0, z_tie_ = 0, none_ = 0, largest_ = 0, stiffest_ = 0;
};

template <class CondensedType, class Laws>
auto ModeSolver<CondensedType, Laws>::follow_path() -> Outcome {
  int leaving = -1;
  const auto is_first = [&](Real value, Real tie, Real by, Real& needed, Real& needed_tie) {
    const Real first = -value / by, second = -tie / by;
    const bool is = first > needed + none_ || (first >= needed - none_ && second > needed_tie);
    if (!is) return false;
    needed = first;
    needed_tie = second;
    return true;
  };
  Real needed = 0, needed_tie = -(std::numeric_limits<Real>::max)();
  Direction direction;
  respond_to_cover(direction);
  for (int p = 0; p < pairs_.size(); ++p) {
    if (place_[p] != inactive) continue;
    const Real by = row(p, direction.T) + direct(p);
    if (row(p, T_) < -none_ && by > 0 && is_first(row(p, T_), tie_of_row(p), by, needed, needed_tie))
      leaving = p;
  }
  bool leaves_set = false;
  for (int i = equalities_; i < set_->size(); ++i) {
    const ActiveConstraint& active = (*set_)[i];
    if (active.pair < 0) continue;
    const Real by = along(active, direction.values[i]);
    if (value_[active.pair] < -none_ && by > 0 &&
        is_first(value_[active.pair], tie_[active.pair], by, needed, needed_tie)) {
      leaving = active.pair;
      leaves_set = true;
    }
  }
  if (leaving < 0) return Outcome::solved;
  largest_ = needed;
  direction.z = 1;
  step_along(direction, {Leaves::cover, -1, needed, needed_tie});
  direction.pair = leaving;
  direction.enters = direction.is_of_cover = !leaves_set;
  if (leaves_set && !leave(leaving)) return Outcome::singular;

  for (pivots_ = 1; pivots_ <= most_pivots(pairs_.size()); ++pivots_) {
    if (!find(direction)) return Outcome::singular;
    const Outcome outcome = go(direction);
    if (outcome != Outcome::pivots) return outcome;
  }
  return Outcome::pivots;
}

}  // namespace taut
