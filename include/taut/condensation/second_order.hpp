// The condensed scene in second-order theory: two linear ones, and what lies between them.
#pragma once

#include <limits>

#include "taut/condensation/condensed.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The rows that give `Count` numbers of the state in second-order theory: between two levels as Eq. (47)
/// says, and what bars that lean add by their length, Eq. (45), at the same level. An aggregate, too.
template <class Scalar, int Count, class Cap>
struct LevelRows {
  using Real = Wide<Scalar>;
  using Stretches = FixedArray<Real, max_bars<Cap>>;

  CondensedRows<Real, Count, Cap> low, high;
  RowsByBar<Real, Count, Cap> low_by_bar, by_bar;
  /// Of strut forces: by what part of itself each is more than what it balances along the axis that its strut
  /// has in the scene, for a metre that its lean lengthens it by: 1 / length, Eq. (45). Otherwise zero.
  FixedArray<Real, Count> by_own_lean;
  int count = 0;  ///< rows in use

  /// All numbers in use at these loads and elongations [m], of which `model` is the LevelModel. Costs (bars +
  /// segments + count) x segments.
  template <class Model, class Loads, class Elongations, class Number, int Size>
  void evaluate(const Model& model, const Loads& drive, const Elongations& e,
                FixedArray<Number, Size>& numbers) const {
    static_assert(Count <= Size, "there is room for every number");
    Stretches q;
    model.stretches_at(drive, e, q);
    const Real sum = model.sum_at(drive, e);
    for (int i = 0; i < count; ++i) numbers[i] = static_cast<Number>(at(i, model, drive, e, sum, q));
  }
  /// One of them, where all tensions together are `sum` [N] and bars are lengthened by `q` [m].
  template <class Model, class Loads, class Elongations>
  Real at(int i, const Model& model, const Loads& drive, const Elongations& e, Real sum,
          const Stretches& q) const {
    const Real below = number_of(low, i, model, drive, e);
    const Real part = model.part(sum / model.target_force);
    Real number = below + part * (number_of(high, i, model, drive, e) - below);
    model.lean().for_each_bar(model.segments, [&](int b) {
      const bool is_segment = b < Cap::segments;
      const Real from = is_segment ? low.elongation[b][i] : low_by_bar[b - Cap::segments][i];
      const Real to = is_segment ? high.elongation[b][i] : by_bar[b - Cap::segments][i];
      number += q[b] * (from + part * (to - from));
    });
    return i < Cap::struts ? number * (1 + by_own_lean[i] * q[Cap::segments + i]) : number;
  }
};

/// On request: the rows that give strut forces [N], tension positive.
template <class Scalar, class Cap>
using LevelStruts = LevelRows<Scalar, Cap::struts, Cap>;
/// On request: the rows that give displacements of nodes [m], see CondensedDisplacements.
template <class Scalar, class Cap>
using LevelDisplacements =
    CondensedDisplacements<Scalar, Cap, LevelRows<Scalar, max_displacements<Cap>, Cap>>;

/// As number_of() and change_of() of CondensedRows; the change at the level of the model.
template <class Scalar, int Count, class Cap, class Model, class Loads, class Elongations>
Wide<Scalar> number_of(const LevelRows<Scalar, Count, Cap>& rows, int i, const Model& model,
                       const Loads& drive, const Elongations& e) {
  typename LevelRows<Scalar, Count, Cap>::Stretches q;
  model.stretches_at(drive, e, q);
  return rows.at(i, model, drive, e, model.sum_at(drive, e), q);
}
template <class Scalar, int Count, class Cap, class Model, class Elongations>
Wide<Scalar> change_of(const LevelRows<Scalar, Count, Cap>& rows, int i, const Model& model,
                       const Elongations& e) {
  const auto low = change_of(rows.low, i, model, e);
  return low + model.part(model.anchor.level) * (change_of(rows.high, i, model, e) - low);
}

template <class Scalar, class Cap>
struct LevelModel;

/// A scene condensed with its geometric stiffness, Eq. (43): T = C(tau) e + D(tau) p, with the level
/// tau = mean T / mean T*, where T* are the tensions at the target state. An aggregate: it can be a constant
/// in flash.
template <class Scalar_, class Cap>
struct SecondOrder {
  static_assert(!has_rigid_saddles<Cap>, "between rigid saddles nothing leans");
  using Scalar = Scalar_;
  using Capacity = Cap;
  using Real = Wide<Scalar>;
  using Linear = Condensed<Scalar, Cap>;
  using AtLevel = LevelModel<Scalar, Cap>;
  using Struts = LevelStruts<Scalar, Cap>;
  using Displacements = LevelDisplacements<Scalar, Cap>;
  /// Levels of the two. The lowest is above zero: without tension nothing may hold a pinned strut.
  static constexpr Real low_level = Real(1) / 48, high_level = 1;
  Linear low, high;
  CondensedLean<Scalar, Cap> lean;  ///< at the high level, but for low_tension_by_bar
  Real target_force = 0;            ///< T* of all segments together [N]
  Real curve = 0;                   ///< k of Eq. (47): 0 is a straight line between the two

  /// How far numbers have come from the low level to the high one: Eq. (47).
  constexpr Real part(Real level) const {
    const Real at = larger(level, low_level);
    return (at - low_level) / (high_level - low_level) * (1 + curve * high_level) / (1 + curve * at);
  }
  /// Its derivative with respect to the level.
  constexpr Real part_slope(Real level) const {
    const Real by = 1 + curve * level;
    return (1 + curve * high_level) * (1 + curve * low_level) / ((high_level - low_level) * by * by);
  }
  /// The curve that comes to `part` at `level`.
  static constexpr Real curve_through(Real level, Real part) {
    const Real steeper = part * (high_level - low_level) / (level - low_level);
    const Real left = high_level - steeper * level;
    return steeper > 1 && left > 0 ? (steeper - 1) / left : Real(0);
  }
};

/// What a condensed scene says whatever the level is: its counts, the layout of its cables, and friction in
/// the geometry of the scene.
template <class Scalar, class Cap>
constexpr const Condensed<Scalar, Cap>& linear_part(const Condensed<Scalar, Cap>& condensed) {
  return condensed;
}
template <class Scalar, class Cap>
constexpr const Condensed<Scalar, Cap>& linear_part(const SecondOrder<Scalar, Cap>& condensed) {
  return condensed.low;
}

template <class Real, int Count, class Cap>
constexpr const CondensedRows<Real, Count, Cap>& linear_part(const CondensedRows<Real, Count, Cap>& rows) {
  return rows;
}
template <class Scalar, int Count, class Cap>
constexpr const CondensedRows<Wide<Scalar>, Count, Cap>& linear_part(
    const LevelRows<Scalar, Count, Cap>& rows) {
  return rows.low;
}

/// A second-order scene about one level: what a tracker computes with until the level has changed by a step.
///
/// With the level tau and the lengths q by which bars lean, Eq. (45),
///
///     T = C(tau) e + D(tau) p + B q(e, p),                                                             (43)
///
/// and this is its tangent, Eq. (46), where the step began, at the anchor e_0, p_0, tau_0: G = C' e_0 + D'
/// p_0 is what the level does, tau follows from T itself, and dq = 2 a . da. So the next step begins where
/// this one ends, but for products of changes.
template <class Scalar_, class Cap>
struct LevelModel : Condensed<Scalar_, Cap> {
  using Scalar = Scalar_;
  using Real = Wide<Scalar>;
  using Source = SecondOrder<Scalar, Cap>;
  using Tensions = FixedArray<Real, Cap::segments>;
  using Kappas = FixedArray<Real, Cap::joints>;
  using Stretches = FixedArray<Real, max_bars<Cap>>;
  static constexpr bool has_level = true;
  /// A step of the level.
  static constexpr Real step = Real(1) / 32;

  /// Where a step began: all that the model is made from.
  struct Anchor {
    Real level = 0;
    Real prestrain = 0;  ///< as in Drive
    FixedArray<Real, Cap::loads> factor;
    Tensions e;  ///< [m]
  };

  Anchor anchor;
  Real target_force = 0;             ///< T* of all segments together [N]
  Real least_sum = 0, most_sum = 0;  ///< of all tensions, while this step holds [N]
  Kappas bend;                       ///< by what part of itself cot(alpha) has changed: Eq. (44)
  Kappas kappa_ratio;                ///< kappa of the displaced geometry, as a part of that of the scene

  /// Begins without tension, with the geometry of the scene.
  void begin(const Source& source) {
    static_cast<Condensed<Scalar, Cap>&>(*this) = source.low;
    source_ = &source;
    target_force = source.target_force;
    anchor = {};
    anchor.level = Source::low_level;
    make();
  }
  /// Begins the next step at these loads and elongations [m], of which all tensions together are `sum` [N].
  /// Costs segments^2 x bars.
  template <class Loads>
  void come_to(Real sum, const Loads& drive, const Tensions& e) {
    anchor.level = larger(sum / target_force, Source::low_level);
    anchor.prestrain = drive.prestrain;
    anchor.factor = drive.factor;
    anchor.e = e;
    make();
  }
  /// Goes on where another one was, with its anchor.
  void make() {
    Asides a;
    a.fill(Real(0));
    Tensions G;
    G.fill(Real(0));
    if (is_tangent()) {
      find_asides(anchor, anchor.e, a);
      find_bend(G);
    }
    const Real share = along(G);
    const auto follow = [&](Tensions& T) {
      const Real by = share * sum_of(T);
      for (int i = 0; i < this->segments; ++i) T[i] += by * G[i];
    };
    const auto& aside = source_->lean.aside;
    for (int k = 0; k < this->segments; ++k) {
      Tensions column;
      for (int i = 0; i < this->segments; ++i) column[i] = coupling_at(i, k);
      stretch(a, aside.elongation[k], column);
      follow(column);
      for (int i = 0; i < this->segments; ++i) this->coupling.set(i, k, column[i]);
    }
    for (int k = 0; k < this->loads; ++k) {
      for (int i = 0; i < this->segments; ++i)
        this->load[k][i] = between(source_->low.load[k][i], source_->high.load[k][i]);
      stretch(a, aside.load[k], this->load[k]);
      follow(this->load[k]);
    }
    for (int i = 0; i < this->segments; ++i)
      this->prestrain[i] =
          between(source_->low.prestrain[i], source_->high.prestrain[i]) - anchor.level * G[i];
    stretch(a, aside.prestrain, this->prestrain);
    // At the anchor itself q is half of what its own derivative gives.
    lean().for_each_bar(this->segments, [&](int b) { lengthen(b, -stretch_of(a, a, b), this->prestrain); });
    follow(this->prestrain);
    take_friction();
    most_sum = target_force * (anchor.level + step);
    least_sum = is_lowest() ? std::numeric_limits<Real>::lowest() : target_force * (anchor.level - step);
  }
  const CondensedLean<Scalar, Cap>& lean() const { return source_->lean; }
  Real part(Real level) const { return source_->part(level); }
  /// rho of a joint that holds rho in the scene's geometry.
  static Real scaled(Real flat, Real by) {
    const Real kappa = by * kappa_of(flat);
    const Real held = kappa < most_kappa ? kappa : most_kappa;
    return (1 - held) / (1 + held);
  }
  /// Tensions of all segments together at these loads and elongations [N]. Costs segments^2.
  template <class Loads, class Elongations>
  Real sum_at(const Loads& drive, const Elongations& e) const {
    Tensions T;
    for (int i = 0; i < this->segments; ++i) {
      T[i] = drive.prestrain * this->prestrain[i];
      for (int k = 0; k < this->loads; ++k) T[i] += drive.factor[k] * this->load[k][i];
    }
    this->coupling.add(this->segments, e, T);
    return sum_of(T);
  }
  /// By how much all bars are lengthened as they lean at these loads and elongations [m]. Costs bars x
  /// segments.
  template <class Loads, class Elongations>
  void stretches_at(const Loads& drive, const Elongations& e, Stretches& q) const {
    Asides a;
    a.fill(Real(0));
    if (is_tangent()) find_asides(drive, e, a);
    for (int b = 0; b < max_bars<Cap>; ++b) q[b] = stretch_of(a, a, b);
  }

 private:
  using Asides = FixedArray<Real, max_bars<Cap> * Cap::normals>;
  static constexpr Real most_kappa = Real(0.999);

  /// From no tension on: there must be none then without elongations either.
  bool is_lowest() const { return anchor.level <= step; }
  /// While the prestrain comes on there is nowhere to put what does not grow with it.
  bool is_tangent() const { return anchor.prestrain == 1 && !is_lowest(); }
  Real between(Real low, Real high) const { return low + part(anchor.level) * (high - low); }
  Real coupling_at(int i, int k) const {
    return between(source_->low.coupling(i, k), source_->high.coupling(i, k));
  }
  Real sum_of(const Tensions& T) const {
    Real sum = 0;
    for (int i = 0; i < this->segments; ++i) sum += T[i];
    return sum;
  }
  /// 1 / (sum T* - sum G). Where the level would run away by itself, it is left as it was.
  Real along(const Tensions& G) const {
    const Real left = target_force - sum_of(G);
    return left > target_force / 8 ? 1 / left : Real(0);
  }
  /// What the level changes in all tensions [N].
  void find_bend(Tensions& G) const {
    const Real unit = source_->part_slope(anchor.level);
    for (int i = 0; i < this->segments; ++i) {
      Real change = source_->high.prestrain[i] - source_->low.prestrain[i];
      for (int k = 0; k < this->loads; ++k)
        change += anchor.factor[k] * (source_->high.load[k][i] - source_->low.load[k][i]);
      for (int k = 0; k < this->segments; ++k)
        change += anchor.e[k] * (source_->high.coupling(i, k) - source_->low.coupling(i, k));
      G[i] = unit * change;
    }
  }
  template <class Loads, class Elongations>
  void find_asides(const Loads& drive, const Elongations& e, Asides& a) const {
    lean().for_each_bar(this->segments, [&](int b) {
      for (int n = b * Cap::normals; n < (b + 1) * Cap::normals; ++n)
        a[n] = number_of(lean().aside, n, *this, drive, e);
    });
  }
  /// Eq. (45): a . b of a bar [m].
  static Real stretch_of(const Asides& a, const Asides& b, int bar) {
    Real sum = 0;
    for (int n = 0; n < Cap::normals; ++n) sum += a[bar * Cap::normals + n] * b[bar * Cap::normals + n];
    return sum;
  }
  /// Adds what bars do that lean by `a` already and by `da` more.
  void stretch(const Asides& a, const Asides& da, Tensions& T) const {
    lean().for_each_bar(this->segments, [&](int b) { lengthen(b, 2 * stretch_of(a, da, b), T); });
  }
  void lengthen(int bar, Real by, Tensions& T) const {
    if (bits_of(by) == 0) return;
    for (int i = 0; i < this->segments; ++i) {
      if (bar < Cap::segments)
        T[i] += by * coupling_at(i, bar);
      else
        T[i] += by * between(lean().low_tension_by_bar[bar - Cap::segments][i],
                             lean().tension_by_bar[bar - Cap::segments][i]);
    }
  }
  /// Friction of the displaced geometry, Eq. (44). A joint that locks itself, or has no friction, stays so.
  void take_friction() {
    lean().bends.evaluate(*this, anchor, anchor.e, bend);
    for (int j = 0; j < this->joints; ++j) {
      const Real flat = source_->low.rho[j];
      kappa_ratio[j] = larger(Real(0), 1 + lean().kappa_by_bend[j] * bend[j]);
      if (!this->is_self_locking(j)) this->rho[j] = scaled(flat, kappa_ratio[j]);
    }
  }

  const Source* source_ = nullptr;
};

}  // namespace taut
