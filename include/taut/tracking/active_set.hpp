// The slip variables at work with their laws, and how they follow: a factorization that grows with them.
#pragma once

#include <cmath>
#include <limits>

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
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  /// Laws are linear in the tensions: no more of them can be independent.
  static constexpr int capacity = Cap::segments;
  template <class Number>
  using Along = FixedArray<Number, Cap::segments>;  ///< the segments
  template <class Number>
  using By = FixedArray<Number, capacity>;  ///< slip variable
  using Tensions = Along<Real>;
  using Values = By<Real>;
  using ActiveConstraints = FixedList<ActiveConstraint, capacity>;
  /// Pivots, relative to their row and column: below, no digit is left; and the next one would be better
  /// first, a guess is worth no less.
  static constexpr Real singular = Real(1e-12), small = Real(1e-4);
  static constexpr bool may_be_either = Cap::saddles && !has_rigid_saddles<Cap>;
  static constexpr bool has_chains = has_rigid_saddles<Cap> || may_be_either;

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
  /// Whether the segments know nothing of one another.
  bool is_chains() const {
    if constexpr (may_be_either)
      return is_diagonal_;
    else
      return has_chains;
  }
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
    settle_by(laws, LinksOf<Real>{*this, laws}, due, T, values, passes);
  }
  /// Calls visit(Number(), settle), where settle(due, T, values) is as above with one pass, in Number: for
  /// derivatives, of which there are many for the same slips. They are kept in Scalar, and are as good in it
  /// unless laws all but depend on one another: then Number is Real.
  template <class Visit>
  void settle_derivatives(const Laws& laws, Visit visit) const {
    const auto visit_with = [&](auto zero, const auto& links) {
      using Number = decltype(zero);
      visit(zero, [&](const By<Number>& due, Along<Number>& T, By<Number>& values) {
        settle_by(laws, links, due, T, values, 1);
      });
    };
    if constexpr (has_chains)
      if (is_chains()) return visit_with(Scalar(), KeptLinks<Scalar>(*this, laws));
    if constexpr (has_rows) {
      if (size() == 0 || is_sound_[size() - 1])
        visit_with(Scalar(), LinksOf<Scalar>{*this, laws});
      else
        visit_with(Real(), LinksOf<Real>{*this, laws});
    }
  }

  /// Adds to every segment a spring of this part of its own stiffness: a node that only its cables hold is
  /// free while they are slack, and a decision at zero tension is well posed nevertheless. To be set while
  /// the set is empty.
  void hold(Real part) { held_ = is_chains() ? Real(0) : part; }
  /// Whether there are such springs. Between rigid saddles no node is free, and the compiler knows.
  bool is_held() const { return has_rows && is_positive(held_); }
  /// Adds the tensions that elongations make.
  template <class Number>
  void carry(const Along<Number>& e, Along<Number>& T) const {
    model_->coupling.add(model_->segments, e, T);
    if (!is_held()) return;
    for (int i = 0; i < model_->segments; ++i)
      T[i] += static_cast<Number>(held_ * model_->coupling(i, i)) * e[i];
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
  /// A pivot that leaves enough digits in a float.
  static constexpr Real sound = Real(1e-3);

  static constexpr bool has_rows = !has_rigid_saddles<Cap>;
  bool has_diagonal_coupling() const {
    for (int i = 0; i < model_->segments; ++i)
      for (int k = 0; k < i; ++k)
        if (model_->coupling(i, k) != 0) return false;
    return true;
  }

  template <class Number, class Links>
  void settle_by(const Laws& laws, const Links& links, const By<Number>& due, Along<Number>& T,
                 By<Number>& values, int passes) const {
    if (size() == 0) return;
    const Number most = largest(size(), &due[0], largest(model_->segments, &T[0]));
    if (is_chains())
      settle_chains(links, due, T, values);
    else
      settle_all(laws, due, T, values, passes);
    // What a law gives outright has no rounding. More than rounding must be seen by whoever tests the laws.
    constexpr Number rounding = Number(4096) * std::numeric_limits<Number>::epsilon();
    for (int i = 0; i < size(); ++i) {
      Number& on = T[active_[i].slides() ? 0 : active_[i].on];
      if (!active_[i].slides() && std::fabs(on - due[i]) <= rounding * most) on = due[i];
    }
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
    is_sound_[n] = (n == 0 || is_sound_[n - 1]) && std::fabs(pivot) > sound;
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
  template <class Number>
  void settle_all(const Laws& laws, const By<Number>& due, Along<Number>& T, By<Number>& values,
                  int passes) const {
    constexpr Number rounding = std::numeric_limits<Number>::epsilon();
    Number before = (std::numeric_limits<Number>::max)();
    for (int pass = 0; pass < passes; ++pass) {
      By<Number> change;
      for (int i = 0; i < size(); ++i) change[i] = due[i] - laws.of(active_[i]).of(T);
      if (passes > 1) {
        const Number off = largest(size(), &change[0]);
        if (pass > 0 && (off <= rounding * largest(model_->segments, &T[0]) || off > before / 4)) return;
        before = off;
      }
      factors_.solve(change);
      Along<Number> e;
      for (int i = 0; i < size(); ++i) {
        const Number by = change[i] * static_cast<Number>(flexibility(active_[i].variable));
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

  struct Numbers {
    FixedArray<std::int16_t, has_chains ? Cap::segments : 0> fixed;   // variable whose law gives the tension
    FixedArray<std::int16_t, has_chains ? Cap::segments : 0> length;  // variable that is no slip
    FixedArray<std::int16_t, has_chains ? Cap::joints : 0> slip;
  };

  void renumber() {
    if (is_chains()) {
      numbers_.fixed.fill(-1);
      numbers_.length.fill(-1);
      numbers_.slip.fill(-1);
      for (int i = 0; i < size(); ++i) {
        const auto number = static_cast<std::int16_t>(i);
        const ActiveConstraint& active = active_[i];
        if (!active.slides()) numbers_.fixed[active.on] = number;
        if (active.variable.kind != SlipVariable::Kind::slip)
          numbers_.length[active.variable.lengthened] = number;
        else if constexpr (Cap::joints > 0)
          numbers_.slip[active.variable.index] = number;
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
        if (numbers_.slip[cable.first_joint + i] < 0) {
          row.begin = i;
          break;
        }
    return row;
  }
  int slip_after(const Row& row, int i) const {
    const int joint = i + 1 < row.count ? row.joint(i) : -1;
    return Cap::joints == 0 || joint < 0 ? -1 : numbers_.slip[joint];
  }
  /// The active slip after segment `i` if a ratio of tensions links the two segments, else -1.
  int ratio(const Row& row, int i) const {
    const int slip = slip_after(row, i);
    return slip >= 0 && active_[slip].slides() ? slip : -1;
  }
  /// Whether two laws would give the tension of one chain, or a ring slide as a whole.
  bool closes_a_loop(const ActiveConstraint& active) const {
    if (!active.slides()) return numbers_.fixed[active.on] >= 0 || chain_is_fixed(active.on);
    const SlipVariable& variable = active.variable;
    if (chain_is_fixed(variable.lengthened) && chain_is_fixed(variable.shortened)) return true;
    return same_chain(variable.lengthened, variable.shortened);
  }
  /// Segment `i` of a row and what links it to the next one, as the present slips have it.
  template <class Number>
  struct LinksOf {
    const ActiveSet& set;
    const Laws& laws;

    int segment(const Row& row, int i) const { return row.segment(i); }
    int fixed(const Row& row, int i) const { return set.numbers_.fixed[row.segment(i)]; }
    int length(const Row& row, int i) const { return set.numbers_.length[row.segment(i)]; }
    int slip(const Row& row, int i) const { return set.slip_after(row, i); }
    int ratio(const Row& row, int i) const { return set.ratio(row, i); }
    bool is_forward(const Row&, int, int slip) const { return set.active_[slip].sense > 0; }
    /// The tension of the next segment over that of this one.
    Number next(const Row&, int, int slip) const {
      const auto rho = static_cast<Number>(laws.rho(set.active_[slip].variable.index));
      return set.active_[slip].sense > 0 ? Number(1) / rho : rho;
    }
    Number flexibility(const Row& row, int i) const {
      return static_cast<Number>(set.flexibility_[row.segment(i)]);
    }
  };
  /// The same, worked out once.
  template <class Number>
  class KeptLinks {
   public:
    KeptLinks(const ActiveSet& set, const Laws& laws) {
      const LinksOf<Number> links{set, laws};
      for (int c = 0; c < set.model_->cables.size(); ++c) {
        const Row row = set.row_of(c);
        Number ratio = 1;  // since the chain began
        for (int i = 0; i < row.count; ++i) {
          const int slip = links.ratio(row, i);
          Number next = 1;
          if (slip >= 0) next = links.next(row, i, slip);
          // A float has no more; so little is left there that nothing depends on it.
          if (ratio * next > farthest || ratio * next * farthest < 1) next = 1;
          ratio = slip >= 0 ? ratio * next : Number(1);
          kept_[row.first_segment + i] = {links.flexibility(row, i),
                                          next,
                                          short_of(links.segment(row, i)),
                                          short_of(links.fixed(row, i)),
                                          short_of(links.length(row, i)),
                                          short_of(links.slip(row, i)),
                                          short_of(slip),
                                          slip >= 0 && links.is_forward(row, i, slip)};
        }
      }
    }
    int segment(const Row& row, int i) const { return at(row, i).segment; }
    int fixed(const Row& row, int i) const { return at(row, i).fixed; }
    int length(const Row& row, int i) const { return at(row, i).length; }
    int slip(const Row& row, int i) const { return at(row, i).slip; }
    int ratio(const Row& row, int i) const { return at(row, i).ratio; }
    bool is_forward(const Row& row, int i, int) const { return at(row, i).forward; }
    Number next(const Row& row, int i, int) const { return at(row, i).next; }
    Number flexibility(const Row& row, int i) const { return at(row, i).flexibility; }

   private:
    struct Link {
      Number flexibility, next;
      std::int16_t segment, fixed, length, slip, ratio;
      bool forward;
    };
    static constexpr Number farthest = Number(1e24);
    static std::int16_t short_of(int number) { return static_cast<std::int16_t>(number); }
    const Link& at(const Row& row, int i) const { return kept_[row.first_segment + i]; }

    FixedArray<Link, Cap::segments> kept_;
  };
  template <class Links, class Visit>
  static void for_each_chain(const Links& links, const Row& row, Visit visit) {
    for (int a = 0; a < row.count;) {
      int b = a;
      while (links.ratio(row, b) >= 0) ++b;
      visit(a, b);
      a = b + 1;
    }
  }
  bool chain_is_fixed(int segment) const {
    bool fixed = false;
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Row row = row_of(c);
      for_each_chain(*this, row, [&](int a, int b) {
        bool here = false, any = false;
        for (int i = a; i <= b; ++i) {
          here = here || row.segment(i) == segment;
          any = any || numbers_.fixed[row.segment(i)] >= 0;
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
      for_each_chain(*this, row, [&](int a, int b) {
        int found = 0;
        for (int i = a; i <= b; ++i) found += row.segment(i) == one || row.segment(i) == other ? 1 : 0;
        same = same || found == 2;
      });
    }
    return same;
  }
  template <class Links, class Number>
  void settle_chains(const Links& links, const By<Number>& due, Along<Number>& T, By<Number>& values) const {
    Along<Number> e;
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Row row = row_of(c);
      for_each_chain(links, row, [&](int a, int b) { settle_chain(links, row, a, b, due, T, e); });
      for (int a = 0; a < row.count;) {
        int b = a;
        while (links.slip(row, b) >= 0) ++b;
        follow(links, row, a, b, e, values);
        a = b + 1;
      }
    }
  }
  /// T_i = ratio_i tau + offset_i along a chain. A law gives one of them; if none does, the elongations
  /// cancel: Eq. (13).
  template <class Links, class Number>
  static void settle_chain(const Links& links, const Row& row, int a, int b, const By<Number>& due,
                           Along<Number>& T, Along<Number>& e) {
    Number weights = 0, sum = 0, tau = 0;
    bool found = false;
    for (const bool settles : {false, true}) {
      if (settles && !found) {
        if (a == b) return;
        tau = sum / weights;
      }
      Number ratio = 1, offset = 0;
      for (int i = a; i <= b; ++i) {
        const int segment = links.segment(row, i), fixed = links.fixed(row, i);
        const Number flexibility = links.flexibility(row, i);
        if (settles) {
          const Number settled = ratio * tau + offset;
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
        const int k = links.ratio(row, i);
        const Number next = links.next(row, i, k);
        ratio *= next;
        offset = links.is_forward(row, i, k) ? (offset - due[k]) * next : offset * next + due[k];
      }
    }
  }
  /// The slips that give segments a to b, linked by active slips, their elongations.
  template <class Links, class Number>
  static void follow(const Links& links, const Row& row, int a, int b, const Along<Number>& e,
                     By<Number>& values) {
    int at = b;
    for (int i = a; i <= b; ++i)
      if (links.length(row, i) >= 0) at = i;
    Number before = 0, after = 0;
    for (int i = a; i < at; ++i) {
      before += e[links.segment(row, i)];
      values[links.slip(row, i)] += before;
    }
    for (int i = b; i > at; --i) {
      after += e[links.segment(row, i)];
      values[links.slip(row, i - 1)] -= after;
    }
    const int length = links.length(row, at);
    if (length >= 0) values[length] += before + after + e[links.segment(row, at)];
  }

  const CondensedType* model_ = nullptr;
  ActiveConstraints active_;
  Real held_ = 0, stiffest_ = 0;
  Tensions flexibility_;  // of every segment in its own direction [m/N], 0 if statics give its force
  Numbers numbers_;
  BorderedLu<Real, has_rows ? capacity : 0> factors_;
  FixedArray<bool, has_rows ? capacity : 0> is_sound_;  // whether all pivots up to here are
  bool is_diagonal_ = false;
};

}  // namespace taut
