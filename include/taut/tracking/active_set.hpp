// The slip variables at work with their laws, and how they follow: a factorization that grows with them.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "taut/numerics/bits.hpp"
#include "taut/numerics/bordered_lu.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/tracking/slip_variables.hpp"

namespace taut {

/// The slips that are not frozen, each with the law that it obeys, in the order in which they entered.
///
/// With R the coefficients of the laws and W the tensions that unit slips make, settle() solves
/// R W m = due - R T, Eq. (12). The factors of R W are those of the order of entry: a slip variable that
/// enters costs one row and one column, and factors made anew in the same order have the same bits.
///
/// On a structure every slip changes every tension: BorderedLu. Between rigid saddles a segment knows
/// nothing of the others, and each chain of segments linked by sliding joints has one unknown.
template <class CondensedType, class Laws>
class ActiveSet {
 public:
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  /// Laws are linear in the tensions: no more of them can be independent.
  static constexpr int capacity = Cap::segments;
  using Tensions = FixedArray<Real, Cap::segments>;
  using Values = FixedArray<Real, capacity>;
  using ActiveConstraints = FixedList<ActiveConstraint, capacity>;

  /// Begins with an empty set, and looks the model through once. The model must outlive it.
  void begin(const CondensedType& model) {
    model_ = &model;
    stiffest_ = 0;
    for (int i = 0; i < model.segments; ++i) stiffest_ = larger(stiffest_, model.coupling(i, i));
    if (!(stiffest_ > 0)) stiffest_ = 1;
    for (int i = 0; i < model.segments; ++i)
      flexibility_[i] = model.coupling(i, i) > 0 ? Real(1) / model.coupling(i, i) : Real(0);
    if constexpr (may_be_either) is_diagonal_ = has_diagonal_coupling();
    clear();
  }
  /// Empties the set.
  void clear() {
    held_ = 0;
    active_.clear();
    renumber();
  }
  int size() const { return active_.size(); }
  bool is_full() const { return size() >= model_->segments; }
  const ActiveConstraint& operator[](int i) const { return active_[i]; }
  const ActiveConstraints& actives() const { return active_; }

  /// Adds a slip variable at the end. False, and nothing is changed, if its law does not depend on it while
  /// all others follow: their combination moves freely. Structure: O(size^2), saddles: O(segments).
  bool append(const Laws& laws, const ActiveConstraint& active, Real least_pivot = singular) {
    if (is_full()) return false;
    if (is_chains()) {
      if (closes_a_loop(active)) return false;
      active_.add(active);
      renumber();
      return true;
    } else {
      return append_row(laws, active, least_pivot);
    }
  }
  void set_pair(int i, int pair) { active_[i].pair = static_cast<std::int16_t>(pair); }
  /// Takes a slip variable away: O(size^3) at worst, for the oldest of many.
  bool remove(const Laws& laws, int i) {
    return remove_if(laws, [i](int k) { return k == i; });
  }
  /// Takes those away of which leaves(number) is true. Those that entered after the first of them are
  /// appended anew; if one has a small pivot, the others come first. False if they depend on each other
  /// without them, and then the set is of no use.
  template <class Leaves>
  bool remove_if(const Laws& laws, Leaves leaves) {
    int first = 0;
    while (first < size() && !leaves(first)) ++first;
    ActiveConstraints later;
    for (int k = first + 1; k < size(); ++k)
      if (!leaves(k)) later.add(active_[k]);
    truncate(first);
    if (is_chains()) {
      for (const ActiveConstraint& each : later) active_.add(each);
      renumber();
      return true;
    } else {
      return append_by_pivot(laws, later);
    }
  }
  /// Keeps the first `count` slip variables.
  void truncate(int count) {
    while (size() > count) active_.drop_last();
    renumber();
  }
  /// Lets the slips follow until their laws are what is due [N]: T and `values` (as they are ordered here)
  /// change. At most `passes` of iterative refinement; each O(size^2 + segments^2), between saddles
  /// O(segments).
  void settle(const Laws& laws, const Values& due, Tensions& T, Values& values, int passes = 1) const {
    if (size() == 0) return;
    const Real most = largest(size(), &due[0], largest(model_->segments, &T[0]));
    if (is_chains())
      settle_chains(laws, due, T, values);
    else
      settle_all(laws, due, T, values, passes);
    // What a law gives outright has no rounding. More than rounding must be seen by whoever tests the laws.
    for (int i = 0; i < size(); ++i) {
      Real& on = T[active_[i].slides() ? 0 : active_[i].on];
      if (!active_[i].slides() && std::fabs(on - due[i]) <= Real(4096) * epsilon * most) on = due[i];
    }
  }

  /// Adds to every segment a spring of this part of its own stiffness: a node that only its cables hold is
  /// free while they are slack, and a decision at zero tension is well posed nevertheless. To be set while
  /// the set is empty.
  void hold(Real part) { held_ = is_chains() ? Real(0) : part; }
  bool is_held() const { return is_positive(held_); }
  /// Adds the tensions that elongations make.
  void carry(const Tensions& e, Tensions& T) const {
    model_->coupling.add(model_->segments, e, T);
    if (held_ == 0) return;
    for (int i = 0; i < model_->segments; ++i) T[i] += held_ * model_->coupling(i, i) * e[i];
  }
  /// Adds the tensions that a slip variable makes.
  void carry(const SlipVariable& variable, Real by, Tensions& T) const {
    carry(variable.lengthened, by, T);
    if (variable.shortened >= 0) carry(variable.shortened, -by, T);
  }
  /// Adds the tensions that an elongation of one segment makes.
  void carry(int segment, Real by, Tensions& T) const {
    model_->coupling.add(model_->segments, segment, by, T);
    if (is_held()) T[segment] += held_ * model_->coupling(segment, segment) * by;
  }
  /// What an elongation by an active variable is in its own segment [N/m].
  Real stiffness(int i) const { return stiffness(active_[i].variable); }
  Real stiffness(const SlipVariable& variable) const {
    const Real before = model_->coupling(variable.lengthened, variable.lengthened);
    if (is_positive(before)) return before;
    const Real after =
        variable.shortened < 0 ? Real(0) : model_->coupling(variable.shortened, variable.shortened);
    return after > 0 ? after : stiffest_;
  }
  /// One over that [m/N], without a division.
  Real flexibility(const SlipVariable& variable) const {
    const Real before = flexibility_[variable.lengthened];
    if (is_positive(before)) return before;
    const Real after = variable.shortened < 0 ? Real(0) : flexibility_[variable.shortened];
    return after > 0 ? after : Real(1) / stiffest_;
  }
  /// The largest of a segment in its own direction [N/m]; 1 where statics give all forces, and lengths none.
  Real stiffest() const { return stiffest_; }

 private:
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  /// Pivots, relative to their row and column: no digit is left; the next one would be better first.
  static constexpr Real singular = Real(1e-12), small = Real(1e-4);

  static constexpr bool may_be_either = Cap::saddles && !has_rigid_saddles<Cap>;
  static constexpr bool has_chains = has_rigid_saddles<Cap> || may_be_either;
  static constexpr bool has_rows = !has_rigid_saddles<Cap>;
  bool is_chains() const {
    if constexpr (may_be_either)
      return is_diagonal_;
    else
      return has_chains;
  }
  bool has_diagonal_coupling() const {
    for (int i = 0; i < model_->segments; ++i)
      for (int k = 0; k < i; ++k)
        if (model_->coupling(i, k) != 0) return false;
    return true;
  }

  // A structure.

  Real entry(const TensionConstraint<Real>& law, const SlipVariable& variable) const {
    const Real by = resistance(*model_, law, variable);
    return (is_held() ? by + held_ * alone(law, variable) : by) * flexibility(variable);
  }
  /// What a slip variable changes a law by through the segments' own stiffness.
  Real alone(const TensionConstraint<Real>& law, const SlipVariable& variable) const {
    const auto own = [&](int segment) {
      const Real by = segment == variable.lengthened  ? Real(1)
                      : segment == variable.shortened ? Real(-1)
                                                      : Real(0);
      return by * model_->coupling(segment, segment);
    };
    return law.second < 0 ? own(law.first) : own(law.first) - law.weight * own(law.second);
  }
  bool append_row(const Laws& laws, const ActiveConstraint& active, Real least_pivot) {
    const int n = size();
    active_.add(active);
    const TensionConstraint<Real> law = laws.of(active);
    const Real pivot = factors_.append([&](int i) { return entry(laws.of(active_[i]), active.variable); },
                                       [&](int i) { return entry(law, active_[i].variable); });
    if ((is_to_resist(active) ? signed_by_law(laws, active, pivot) : std::fabs(pivot)) > least_pivot)
      return true;
    truncate(n);
    return false;
  }
  /// In second-order theory: an equilibrium from which a jack or a joint that slides runs away by itself is
  /// none. Where a cable has no tension its nodes may hang free.
  static bool is_to_resist(const ActiveConstraint& active) {
    return CondensedType::has_level &&
           (active.slides() || active.variable.kind == SlipVariable::Kind::extension);
  }
  static Real signed_by_law(const Laws& laws, const ActiveConstraint& active, Real pivot) {
    return laws.of(active).first == active.variable.lengthened ? pivot : -pivot;
  }
  bool append_by_pivot(const Laws& laws, ActiveConstraints& later) {
    for (int rounds = 0, count = later.size(); rounds <= count && !later.empty(); ++rounds) {
      ActiveConstraints deferred;
      for (const ActiveConstraint& each : later)
        if (!append(laws, each, rounds == 0 ? small : singular)) deferred.add(each);
      later = deferred;
    }
    return later.empty();
  }
  /// Once with the springs, or, to the last digit, without them: iterative refinement.
  void settle_all(const Laws& laws, const Values& due, Tensions& T, Values& values, int passes) const {
    Real before = (std::numeric_limits<Real>::max)();
    for (int pass = 0; pass < passes; ++pass) {
      Values change;
      for (int i = 0; i < size(); ++i) change[i] = due[i] - laws.of(active_[i]).of(T);
      if (passes > 1) {
        const Real off = largest(size(), &change[0]);
        if (pass > 0 && (off <= epsilon * largest(model_->segments, &T[0]) || off > before / 4)) return;
        before = off;
      }
      factors_.solve(change);
      Tensions e;
      e.fill(Real(0));
      for (int i = 0; i < size(); ++i) {
        const Real by = change[i] * flexibility(active_[i].variable);
        values[i] += by;
        active_[i].variable.impose(by, e);
      }
      if (passes == 1)
        carry(e, T);
      else
        model_->coupling.add(model_->segments, e, T);
    }
  }

  // Between rigid saddles.

  struct Links {
    FixedArray<std::int16_t, has_chains ? Cap::segments : 0> fixed;   // variable whose law gives the tension
    FixedArray<std::int16_t, has_chains ? Cap::segments : 0> length;  // variable that is no slip
    FixedArray<std::int16_t, has_chains ? Cap::joints : 0> slip;
  };

  void renumber() {
    if (is_chains()) {
      links_.fixed.fill(-1);
      links_.length.fill(-1);
      links_.slip.fill(-1);
      for (int i = 0; i < size(); ++i) {
        const auto number = static_cast<std::int16_t>(i);
        const ActiveConstraint& active = active_[i];
        if (!active.slides()) links_.fixed[active.on] = number;
        if (active.variable.kind != SlipVariable::Kind::slip)
          links_.length[active.variable.lengthened] = number;
        else if constexpr (Cap::joints > 0)
          links_.slip[active.variable.index] = number;
      }
    } else {
      factors_.truncate(size());
    }
  }
  /// One cable as a row of segments that begins where no active slip links the first to the last.
  struct Row {
    int first_segment, first_joint, count, begin;
    bool closed;
    int segment(int i) const { return first_segment + (Cap::hoops ? (begin + i) % count : i); }
    /// The joint after segment `i`, -1 at the end of an open cable.
    int joint(int i) const {
      if (Cap::hoops && closed) return first_joint + (begin + i + 1) % count;
      return i + 1 < count ? first_joint + i : -1;
    }
  };
  Row row_of(int c) const {
    const auto& cable = model_->cables[c];
    Row row{cable.first_segment, cable.first_joint, cable.segments(), 0, cable.closed};
    if constexpr (Cap::joints > 0 && Cap::hoops)
      for (int i = 0; row.closed && i < row.count; ++i)
        if (links_.slip[cable.first_joint + i] < 0) {
          row.begin = i;
          break;
        }
    return row;
  }
  int slip_after(const Row& row, int i) const {
    const int joint = i + 1 < row.count ? row.joint(i) : -1;
    return Cap::joints == 0 || joint < 0 ? -1 : links_.slip[joint];
  }
  /// The active slip after segment `i` if a ratio of tensions links the two segments, else -1.
  int ratio_after(const Row& row, int i) const {
    const int slip = slip_after(row, i);
    return slip >= 0 && active_[slip].slides() ? slip : -1;
  }
  /// Whether two laws would give the tension of one chain, or a ring slide as a whole.
  bool closes_a_loop(const ActiveConstraint& active) const {
    if (!active.slides()) return links_.fixed[active.on] >= 0 || chain_is_fixed(active.on);
    const SlipVariable& variable = active.variable;
    if (chain_is_fixed(variable.lengthened) && chain_is_fixed(variable.shortened)) return true;
    return same_chain(variable.lengthened, variable.shortened);
  }
  template <class Visit>
  void for_each_chain(const Row& row, Visit visit) const {
    for (int a = 0; a < row.count;) {
      int b = a;
      while (ratio_after(row, b) >= 0) ++b;
      visit(a, b);
      a = b + 1;
    }
  }
  bool chain_is_fixed(int segment) const {
    bool fixed = false;
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Row row = row_of(c);
      for_each_chain(row, [&](int a, int b) {
        bool here = false, any = false;
        for (int i = a; i <= b; ++i) {
          here = here || row.segment(i) == segment;
          any = any || links_.fixed[row.segment(i)] >= 0;
        }
        fixed = fixed || (here && any);
      });
    }
    return fixed;
  }
  bool same_chain(int one, int other) const {
    bool same = false;
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Row row = row_of(c);
      for_each_chain(row, [&](int a, int b) {
        int found = 0;
        for (int i = a; i <= b; ++i) found += row.segment(i) == one || row.segment(i) == other ? 1 : 0;
        same = same || found == 2;
      });
    }
    return same;
  }
  void settle_chains(const Laws& laws, const Values& due, Tensions& T, Values& values) const {
    Tensions e;
    e.fill(Real(0));
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Row row = row_of(c);
      for_each_chain(row, [&](int a, int b) { settle_chain(laws, row, a, b, due, T, e); });
      for (int a = 0; a < row.count;) {
        int b = a;
        while (slip_after(row, b) >= 0) ++b;
        follow(row, a, b, e, values);
        a = b + 1;
      }
    }
  }
  /// T_i = ratio_i tau + offset_i along a chain. A law gives one of them; if none does, the elongations
  /// cancel: Eq. (13).
  void settle_chain(const Laws& laws, const Row& row, int a, int b, const Values& due, Tensions& T,
                    Tensions& e) const {
    Real weights = 0, sum = 0, tau = 0;
    bool found = false;
    for (const bool settles : {false, true}) {
      if (settles && !found) {
        if (a == b) return;
        tau = sum / weights;
      }
      Real ratio = 1, offset = 0;
      for (int i = a; i <= b; ++i) {
        const int segment = row.segment(i), fixed = links_.fixed[segment];
        const Real flexibility = flexibility_[segment];
        if (settles) {
          const Real settled = ratio * tau + offset;
          e[segment] = (settled - T[segment]) * flexibility;
          T[segment] = settled;
        } else {
          if (fixed >= 0) {
            tau = (due[fixed] - offset) / ratio;
            found = true;
          }
          weights += ratio * flexibility;
          sum += (T[segment] - offset) * flexibility;
        }
        if (i == b) break;
        const int k = ratio_after(row, i);
        const Real rho = laws.rho(active_[k].variable.index);
        const bool forward = active_[k].sense > 0;
        const Real next = forward ? Real(1) / rho : rho;
        ratio *= next;
        offset = forward ? (offset - due[k]) * next : offset * next + due[k];
      }
    }
  }
  /// The slips that give segments a to b, linked by active slips, their elongations.
  void follow(const Row& row, int a, int b, const Tensions& e, Values& values) const {
    int at = b;
    for (int i = a; i <= b; ++i)
      if (links_.length[row.segment(i)] >= 0) at = i;
    Real before = 0, after = 0;
    for (int i = a; i < at; ++i) {
      before += e[row.segment(i)];
      values[slip_after(row, i)] += before;
    }
    for (int i = b; i > at; --i) {
      after += e[row.segment(i)];
      values[slip_after(row, i - 1)] -= after;
    }
    const int length = links_.length[row.segment(at)];
    if (length >= 0) values[length] += before + after + e[row.segment(at)];
  }

  const CondensedType* model_ = nullptr;
  ActiveConstraints active_;
  Real held_ = 0, stiffest_ = 0;
  Tensions flexibility_;  // of every segment in its own direction [m/N], 0 if statics give its force
  Links links_;
  BorderedLu<Real, has_rows ? capacity : 0> factors_;
  bool is_diagonal_ = false;
};

}  // namespace taut
