// The condensed scene in second-order theory: linear at three levels, and what lies between them.
#pragma once

#include <cmath>
#include <limits>

#include "taut/condensation/condensed.hpp"
#include "taut/condensation/level_curve.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The rows that give `Count` numbers of the state in second-order theory: between the levels as Eq. (48)
/// says, each with a curve of its own, and what bars that lean add by their length, Eq. (45), at the same
/// level, and struts by their push, Eq. (46). `OfStruts`: the numbers are strut forces, along the axes that
/// the struts have come to. An aggregate, too.
template <class Scalar, int Count, class Cap, bool OfStruts = false>
struct LevelRows {
  using Real = Wide<Scalar>;

  LeaningRows<Real, Count, Cap> low, rise, bow;
  RowsByPush<Real, Count, Cap> by_push;  ///< at the high level
  FixedArray<Real, Count> curve;         ///< k of every row
  int count = 0;                         ///< rows in use

  /// All numbers in use at these loads and elongations [m], of which `model` is the LevelModel. Costs 3 (bars
  /// + segments) x count.
  template <class Model, class Loads, class Elongations, class Number, int Size>
  void evaluate(const Model& model, const Loads& drive, const Elongations& e,
                FixedArray<Number, Size>& numbers) const {
    static_assert(Count <= Size, "there is room for every number");
    const Real level = model.level_at(drive, e);
    const auto leant = model.leant_at(drive, e, level);
    for (int i = 0; i < count; ++i) numbers[i] = static_cast<Number>(at(i, model, drive, e, level, leant));
  }
  /// One of them at a level, where bars lean as they do.
  template <class Model, class Loads, class Elongations>
  Real at(int i, const Model& model, const Loads& drive, const Elongations& e, Real level,
          const typename Model::Leant& leant) const {
    const auto in = [&](const LeaningRows<Real, Count, Cap>& rows) {
      return number_of(rows, i, model, drive, e, leant.stretch);
    };
    const Real number = in(low) + curve_of(i).weights(level).of(in(rise), in(bow)) +
                        model.pushed(leant.push, [&](int n) { return by_push[n][i]; });
    if constexpr (OfStruts)
      return number * (1 + model.lean().by_own_lean[Cap::segments + i] * leant.stretch[Cap::segments + i]);
    return number;
  }
  LevelCurve<Real> curve_of(int i) const { return {curve[i]}; }
  /// Makes of the rows at the middle level, in `bow`, and at the high level, in `rise`, what Eq. (48) adds.
  /// The scene has so many segments, loads, struts and beams.
  template <class Model>
  void split(const Model& of) {
    for (int i = 0; i < count; ++i) {
      LevelCurveFit<Real> fit;
      for (int k = 0; k < of.low.segments; ++k)
        fit.add(low.rows.elongation[k][i], bow.rows.elongation[k][i], rise.rows.elongation[k][i]);
      curve[i] = fit.found().k;
      const auto part = [&](auto number) { curve_of(i).split(number(low), number(bow), number(rise)); };
      part([i](auto& at) -> Real& { return at.rows.prestrain[i]; });
      for (int k = 0; k < of.low.loads; ++k) part([i, k](auto& at) -> Real& { return at.rows.load[k][i]; });
      for (int k = 0; k < of.low.segments; ++k)
        part([i, k](auto& at) -> Real& { return at.rows.elongation[k][i]; });
      of.lean.for_each_bar(
          0, [&](int b) { part([i, b](auto& at) -> Real& { return at.by_bar[b - Cap::segments][i]; }); });
    }
  }
};

/// On request: the rows that give strut forces [N], tension positive.
template <class Scalar, class Cap>
using LevelStruts = LevelRows<Scalar, Cap::struts, Cap, true>;
/// On request: the rows that give displacements of nodes [m], see CondensedDisplacements.
template <class Scalar, class Cap>
using LevelDisplacements =
    CondensedDisplacements<Scalar, Cap, LevelRows<Scalar, max_displacements<Cap>, Cap>>;

/// As number_of() and change_of() of CondensedRows; the change at the level of the model.
template <class Scalar, int Count, class Cap, bool OfStruts, class Model, class Loads, class Elongations>
Wide<Scalar> number_of(const LevelRows<Scalar, Count, Cap, OfStruts>& rows, int i, const Model& model,
                       const Loads& drive, const Elongations& e) {
  const Wide<Scalar> level = model.level_at(drive, e);
  return rows.at(i, model, drive, e, level, model.leant_at(drive, e, level));
}
template <class Scalar, int Count, class Cap, bool OfStruts, class Model, class Elongations>
Wide<Scalar> change_of(const LevelRows<Scalar, Count, Cap, OfStruts>& rows, int i, const Model& model,
                       const Elongations& e) {
  return change_of(rows.low.rows, i, model, e) +
         rows.curve_of(i)
             .weights(model.anchor.level)
             .of(change_of(rows.rise.rows, i, model, e), change_of(rows.bow.rows, i, model, e));
}

template <class Scalar, class Cap>
struct LevelModel;

/// A scene condensed with its geometric stiffness, Eq. (43): T = C(tau) e + D(tau) p + B(tau) q, with the
/// level tau = mean T / mean T*, where T* are the tensions at the target state. An aggregate: it can be a
/// constant in flash.
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
  using Tensions = LeaningRows<Real, Cap::segments, Cap>;
  using Curve = LevelCurve<Real>;

  Linear low;
  RowsByBar<Real, Cap::segments, Cap> low_by_bar;  ///< tensions there [N/m]
  Tensions rise, bow;                              ///< of all tensions, Eq. (48)
  CondensedLean<Scalar, Cap> lean;                 ///< at the high level
  Real target_force = 0;                           ///< T* of all segments together [N]
  Curve curve;
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
template <class Scalar, int Count, class Cap, bool OfStruts>
constexpr const CondensedRows<Wide<Scalar>, Count, Cap>& linear_part(
    const LevelRows<Scalar, Count, Cap, OfStruts>& rows) {
  return rows.low.rows;
}

/// A second-order scene about one level: what a tracker computes with until the level has changed by a step.
///
/// With the level tau and the lengths q by which bars lean, Eq. (45),
///
///     T = C(tau) e + D(tau) p + B q(e, p) + A s(e, p, tau),                                            (43)
///
/// and this is its tangent, Eq. (47), where the step began, at the anchor e_0, p_0, tau_0: G = C' e_0 + D'
/// p_0 is what the level does, tau follows from T itself, dq = 2 f a . da, and ds = 2 (dN a + dN_apart da).
/// So the next step begins where this one ends, but for products of changes.
template <class Scalar_, class Cap>
struct LevelModel : Condensed<Scalar_, Cap> {
  using Scalar = Scalar_;
  using Real = Wide<Scalar>;
  using Source = SecondOrder<Scalar, Cap>;
  using Tensions = FixedArray<Real, Cap::segments>;
  using Kappas = FixedArray<Real, Cap::joints>;
  using Asides = FixedArray<Real, max_bars<Cap> * Cap::normals>;
  using Stretches = FixedArray<Real, max_bars<Cap>>;
  using Thrusts = FixedArray<Real, Cap::struts>;
  using Pushes = FixedArray<Real, Cap::struts * Cap::normals>;
  using Shifts = FixedArray<Real, max_shifts<Cap>>;
  using Curve = LevelCurve<Real>;
  static constexpr bool has_level = true;
  /// A step of the level, at most. It is half of a level that is small.
  static constexpr Real step = Real(1) / 32;
  /// By how much kappa may change with the bend of the cable in a step, at any joint, as a part of the
  /// largest one.
  static constexpr Real friction_step = Real(1) / 512;
  /// And by what angle [rad] any segment may turn.
  static constexpr Real turn_step = Real(1) / 2048;

  /// Where a step began: all that the model is made from.
  struct Anchor {
    Real level = 0;
    Real prestrain = 0;  ///< as in Drive
    FixedArray<Real, Cap::loads> factor;
    Tensions e;  ///< [m]
  };

  /// How bars lean in a state.
  struct Leant {
    Asides given;       ///< by loads and elongations alone, as CondensedLean::aside
    Asides aside;       ///< with what their own lengthening and the pushes of struts do
    Stretches stretch;  ///< that lengthens them by [m]: Eq. (45)
    Thrusts apart;      ///< forces of struts beyond those of the level [N]
    Pushes push;        ///< Eq. (46)
  };

  Anchor anchor;
  Real target_force = 0;             ///< T* of all segments together [N]
  Real least_sum = 0, most_sum = 0;  ///< of all tensions, while this step holds [N]
  Real most_shift = 0;               ///< of each of shifts(), up or down, while this step holds
  Kappas bend;                       ///< by what part of itself cot(alpha) has changed: Eq. (44)
  Kappas kappa_ratio;                ///< kappa of the displaced geometry, as a part of that of the scene

  /// Begins without tension, with the geometry of the scene.
  void begin(const Source& source) {
    static_cast<Condensed<Scalar, Cap>&>(*this) = source.low;
    source_ = &source;
    target_force = source.target_force;
    anchor = {};
    anchor.level = Curve::low;
    find_shift_units();
    make();
  }
  /// Begins the next step at these loads and elongations [m], of which all tensions together are `sum` [N].
  /// Costs segments^2 x bars.
  template <class Loads>
  void come_to(Real sum, const Loads& drive, const Tensions& e) {
    anchor.level = larger(sum / target_force, Curve::low);
    anchor.prestrain = drive.prestrain;
    anchor.factor = drive.factor;
    anchor.e = e;
    make();
  }
  /// Goes on where another one was, with its anchor.
  void make() {
    Tensions G;
    G.fill(Real(0));
    weights_ = source_->curve.weights(anchor.level);
    const Leant leant = leant_at(anchor, anchor.e, anchor.level);
    const Asides& a = leant.aside;
    const Stretches grown = growths_of(a), &q = leant.stretch;
    if (is_tangent()) find_bend(a, G);
    const Real share = along(G);
    const auto follow = [&](Tensions& T) {
      const Real by = share * sum_of(T);
      for (int i = 0; i < this->segments; ++i) T[i] += by * G[i];
    };
    const auto& aside = source_->lean.aside;
    const auto &rise = source_->rise.rows, &bow = source_->bow.rows;
    for (int k = 0; k < this->segments; ++k) {
      Tensions column;
      for (int i = 0; i < this->segments; ++i) column[i] = coupling_at(i, k);
      stretch(a, grown, aside.elongation[k], column);
      push(leant, lean().thrust.rows.elongation[k], aside.elongation[k], column);
      follow(column);
      for (int i = 0; i < this->segments; ++i) this->coupling.set(i, k, column[i]);
    }
    for (int k = 0; k < this->loads; ++k) {
      for (int i = 0; i < this->segments; ++i)
        this->load[k][i] = source_->low.load[k][i] + weights_.of(rise.load[k][i], bow.load[k][i]);
      stretch(a, grown, aside.load[k], this->load[k]);
      push(leant, lean().thrust.rows.load[k], aside.load[k], this->load[k]);
      follow(this->load[k]);
    }
    for (int i = 0; i < this->segments; ++i)
      this->prestrain[i] =
          source_->low.prestrain[i] + weights_.of(rise.prestrain[i], bow.prestrain[i]) - anchor.level * G[i];
    stretch(a, grown, aside.prestrain, this->prestrain);
    push(leant, lean().thrust.rows.prestrain, aside.prestrain, this->prestrain);
    // At the anchor itself q and s are not what their own derivatives give.
    lean().for_each_bar(this->segments, [&](int b) {
      lengthen(b, q[b] - 2 * grown[b] * stretch_of(a, leant.given, b), this->prestrain);
    });
    lean().for_each_push([&](int n, int b, int m) {
      push(m, leant.push[n] - 2 * (thrust_at(b, anchor, anchor.e) * a[m] + leant.apart[b] * leant.given[m]),
           this->prestrain);
    });
    follow(this->prestrain);
    if (is_tangent()) turn(leant, grown);
    take_friction(leant);
    const Real by = anchor.level < 2 * step ? anchor.level / 2 : step;
    most_sum = target_force * (anchor.level + by);
    most_shift = is_tangent() ? Real(1) : (std::numeric_limits<Real>::max)();
    least_sum = is_lowest() ? std::numeric_limits<Real>::lowest() : target_force * (anchor.level - by);
  }
  /// How far geometry has changed since the step began, of what a step allows: kappa at every joint by its
  /// bend, beta of Eq. (44) without the length by which bars lean, and the direction of every segment along
  /// its normals. Changes that go opposite ways do not hide each other. Costs segments x (joints + segments).
  template <class Loads, class Elongations>
  Shifts shifts(const Loads& drive, const Elongations& e) const {
    Shifts shifted = shifts_by(drive.factor, e);
    const Shifts before = shifts_by(anchor.factor, anchor.e);
    for (int n = 0; n < shift_count(); ++n) shifted[n] -= before[n];
    return shifted;
  }
  /// What these load factors and elongations [m] do to it.
  template <class Factors, class Elongations>
  Shifts shifts_by(const Factors& factor, const Elongations& e) const {
    Shifts by;
    by.fill(Real(0));
    const auto add = [&](Real amount, const Kappas& bends, const Asides& asides) {
      if (bits_of(amount) == 0) return;
      for (int j = 0; j < this->joints; ++j)
        by[j] += amount * static_cast<Real>(shift_by_bend_[j]) * bends[j];
      for (int m = 0; m < this->segments * Cap::normals; ++m)
        by[this->joints + m] += amount * static_cast<Real>(shift_by_aside_[m / Cap::normals]) * asides[m];
    };
    const auto& bends = lean().bends.rows;
    const auto& asides = lean().aside;
    for (int k = 0; k < this->loads; ++k) add(factor[k], bends.load[k], asides.load[k]);
    for (int k = 0; k < this->segments; ++k) add(e[k], bends.elongation[k], asides.elongation[k]);
    return by;
  }
  int shift_count() const { return this->joints + this->segments * Cap::normals; }
  const CondensedLean<Scalar, Cap>& lean() const { return source_->lean; }
  /// rho of a joint that holds rho in the scene's geometry.
  static Real scaled(Real flat, Real by) {
    const Real kappa = by * kappa_of(flat);
    const Real held = kappa < most_kappa ? kappa : most_kappa;
    return (1 - held) / (1 + held);
  }
  /// Tensions of all segments together at these loads and elongations [N]. Costs segments^2.
  template <class Loads, class Elongations>
  Real sum_at(const Loads& drive, const Elongations& e) const {
    return sum_of(tensions_at(drive, e));
  }
  /// The level that they come to.
  template <class Loads, class Elongations>
  Real level_at(const Loads& drive, const Elongations& e) const {
    return sum_at(drive, e) / target_force;
  }
  /// How all bars lean at these loads and elongations [m], of this level. At the lowest one they do not
  /// count as leaning, and struts pull by the thrusts that they have at it. Costs bars x (segments + struts).
  template <class Loads, class Elongations>
  Leant leant_at(const Loads& drive, const Elongations& e, Real level) const {
    Leant leant{};
    if (!is_tangent() && !is_lowest()) return leant;
    find_asides(drive, e, leant.given);
    // Nothing pushes yet. Without its thrusts C is positive semidefinite; as pulls they hold feet that cables
    // at zero lead.
    if (is_lowest()) {
      lean().for_each_push([&](int n, int b, int m) {
        leant.apart[b] = larger(Real(0), -2 * lean().low_thrust[b]);
        leant.push[n] = 2 * leant.apart[b] * leant.given[m];
      });
      return leant;
    }
    const auto weights = Curve{}.weights(level);
    Thrusts given;
    for (int b = 0; b < lean().struts; ++b)
      given[b] = thrust_at(b, drive, e) - lean().low_thrust[b] -
                 weights.of(lean().thrust_rise[b], lean().thrust_bow[b]);
    leant.aside = leant.given;
    for (int round = 0; round < rounds; ++round) {
      leant.apart = given;
      for (int b = 0; b < lean().struts; ++b)
        leant.apart[b] += stretched(lean().thrust, b, lean(), this->segments, leant.stretch);
      lean().for_each_push([&](int n, int b, int m) { leant.push[n] = 2 * leant.apart[b] * leant.aside[m]; });
      Asides pushed = leant.given;
      lean().for_each_push([&](int n, int, int) {
        for_each_aside([&](int, int m) { pushed[m] += leant.push[n] * lean().aside_by_push[n][m]; });
      });
      for_each_aside(
          [&](int b, int m) { leant.aside[m] = pushed[m] + lean().own_aside[m] * leant.stretch[b]; });
      leant.stretch = stretches_of(leant.aside);
    }
    return leant;
  }
  /// Forces of all struts there by the rows of the high level [N], tension positive.
  template <class Loads, class Elongations>
  Real thrust_at(int strut, const Loads& drive, const Elongations& e) const {
    return number_of(lean().thrust.rows, strut, *this, drive, e);
  }
  /// What pushes of struts do to a number, of which by(n) is what a unit of one does.
  template <class By>
  Real pushed(const Pushes& push, By by) const {
    Real sum = 0;
    lean().for_each_push([&](int n, int, int) { sum += push[n] * by(n); });
    return sum;
  }

 private:
  static constexpr int rounds = 4;
  static constexpr Real most_kappa = Real(0.999);

  /// From no tension on: there must be none then without elongations either.
  bool is_lowest() const { return anchor.level <= Curve::low; }
  /// While the prestrain comes on there is nowhere to put what does not grow with it.
  bool is_tangent() const { return anchor.prestrain == 1 && !is_lowest(); }
  Real coupling_at(int i, int k) const {
    return source_->low.coupling(i, k) +
           weights_.of(source_->rise.rows.elongation[k][i], source_->bow.rows.elongation[k][i]);
  }
  template <class Loads, class Elongations>
  Tensions tensions_at(const Loads& drive, const Elongations& e) const {
    Tensions T;
    for (int i = 0; i < this->segments; ++i) {
      T[i] = drive.prestrain * this->prestrain[i];
      for (int k = 0; k < this->loads; ++k) T[i] += drive.factor[k] * this->load[k][i];
    }
    this->coupling.add(this->segments, e, T);
    return T;
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
  /// What the level changes in all tensions [N], where bars lean by `a`.
  void find_bend(const Asides& a, Tensions& G) const {
    const auto slopes = source_->curve.slopes(anchor.level);
    const auto &rise = source_->rise.rows, &bow = source_->bow.rows;
    for (int i = 0; i < this->segments; ++i) {
      Real along = rise.prestrain[i], across = bow.prestrain[i];
      for (int k = 0; k < this->loads; ++k) {
        along += anchor.factor[k] * rise.load[k][i];
        across += anchor.factor[k] * bow.load[k][i];
      }
      for (int k = 0; k < this->segments; ++k) {
        along += anchor.e[k] * rise.elongation[k][i];
        across += anchor.e[k] * bow.elongation[k][i];
      }
      G[i] = slopes.of(along, across);
    }
    const auto usual = Curve{}.slopes(anchor.level);
    lean().for_each_push([&](int, int b, int m) {
      push(m, -2 * a[m] * usual.of(lean().thrust_rise[b], lean().thrust_bow[b]), G);
    });
  }
  template <class Loads, class Elongations>
  void find_asides(const Loads& drive, const Elongations& e, Asides& a) const {
    for_each_aside([&](int, int m) { a[m] = number_of(lean().aside, m, *this, drive, e); });
  }
  /// Calls visit(bar, aside) for every normal of every bar.
  template <class Visit>
  void for_each_aside(Visit visit) const {
    lean().for_each_bar(this->segments, [&](int b) {
      for (int m = b * Cap::normals; m < (b + 1) * Cap::normals; ++m) visit(b, m);
    });
  }
  /// Eq. (45): a . b of a bar [m].
  static Real stretch_of(const Asides& a, const Asides& b, int bar) {
    Real sum = 0;
    for (int n = 0; n < Cap::normals; ++n) sum += a[bar * Cap::normals + n] * b[bar * Cap::normals + n];
    return sum;
  }
  /// Of every bar that leans by `a`: a . a (1 + a . a / 2L).
  Stretches stretches_of(const Asides& a) const {
    Stretches q;
    q.fill(Real(0));
    lean().for_each_bar(this->segments, [&](int b) {
      const Real by = stretch_of(a, a, b);
      q[b] = by * (1 + lean().by_own_lean[b] / 2 * by);
    });
    return q;
  }
  /// f of Eq. (47). A lean that grew by itself would be no small one: f is at most twice what it is without
  /// that.
  Stretches growths_of(const Asides& a) const {
    Stretches grown;
    grown.fill(Real(0));
    lean().for_each_bar(this->segments, [&](int b) {
      const Real by = 1 + lean().by_own_lean[b] * stretch_of(a, a, b);
      grown[b] = by / larger(Real(0.5), 1 - 2 * by * stretch_of(a, lean().own_aside, b));
    });
    return grown;
  }
  /// Adds what bars do that lean by `a` already and by `da` more.
  void stretch(const Asides& a, const Stretches& grown, const Asides& da, Tensions& T) const {
    lean().for_each_bar(this->segments, [&](int b) { lengthen(b, 2 * grown[b] * stretch_of(a, da, b), T); });
  }
  /// Adds what struts push more where their forces are more by `dN` and they lean by `da` more.
  template <class Forces>
  void push(const Leant& leant, const Forces& dN, const Asides& da, Tensions& T) const {
    lean().for_each_push(
        [&](int, int b, int m) { push(m, 2 * (dN[b] * leant.aside[m] + leant.apart[b] * da[m]), T); });
  }
  /// Adds what a push does: by reciprocity, what elongations of segments do to that aside.
  void push(int aside, Real by, Tensions& T) const {
    if (bits_of(by) == 0) return;
    for (int i = 0; i < this->segments; ++i) T[i] += by * lean().aside.elongation[i][aside];
  }
  void lengthen(int bar, Real by, Tensions& T) const {
    if (bits_of(by) == 0) return;
    const int b = bar - Cap::segments;
    for (int i = 0; i < this->segments; ++i)
      T[i] += by * (b < 0 ? coupling_at(i, bar)
                          : source_->low_by_bar[b][i] +
                                weights_.of(source_->rise.by_bar[b][i], source_->bow.by_bar[b][i]));
  }
  /// Makes of all tensions those along the axes that their segments have come to, Eq. (45).
  void turn(const Leant& leant, const Stretches& grown) {
    const Tensions T = tensions_at(anchor, anchor.e);
    const auto& aside = lean().aside;
    const Asides& a = leant.aside;
    const Stretches& q = leant.stretch;
    for (int i = 0; i < this->segments; ++i) {
      if (bits_of(q[i]) == 0) continue;
      const Real part = lean().by_own_lean[i], by = 1 + part * q[i], more = 2 * part * grown[i] * T[i];
      for (int k = 0; k < this->segments; ++k)
        this->coupling.set(i, k, by * this->coupling(i, k) + more * stretch_of(a, aside.elongation[k], i));
      for (int k = 0; k < this->loads; ++k)
        this->load[k][i] = by * this->load[k][i] + more * stretch_of(a, aside.load[k], i);
      // At the anchor itself nothing is more than `by` says.
      this->prestrain[i] = by * this->prestrain[i] +
                           more * (stretch_of(a, aside.prestrain, i) - stretch_of(a, leant.given, i));
    }
  }
  /// Friction of the displaced geometry, Eq. (44). A joint that locks itself, or has no friction, stays so.
  void take_friction(const Leant& leant) {
    for (int j = 0; j < this->joints; ++j) {
      bend[j] = number_of(lean().bends, j, *this, anchor, anchor.e, leant.stretch) +
                pushed(leant.push, [&](int n) { return lean().bends_by_push[n][j]; });
      const Real flat = source_->low.rho[j];
      kappa_ratio[j] = larger(Real(0), 1 + lean().kappa_by_bend[j] * bend[j]);
      if (!this->is_self_locking(j)) this->rho[j] = scaled(flat, kappa_ratio[j]);
    }
  }

  /// A joint that locks itself stays so; what turns is w / L = a sqrt(2 / L).
  void find_shift_units() {
    const auto kappa = [this](int j) { return this->is_self_locking(j) ? Real(0) : kappa_of(this->rho[j]); };
    Real most = 0;
    for (int j = 0; j < this->joints; ++j) most = larger(most, kappa(j));
    for (int j = 0; j < this->joints; ++j)
      shift_by_bend_[j] =
          most > 0 ? static_cast<Scalar>(kappa(j) * lean().kappa_by_bend[j] / (most * friction_step))
                   : Scalar(0);
    for (int i = 0; i < this->segments; ++i)
      shift_by_aside_[i] =
          std::sqrt(static_cast<Scalar>(2 * lean().by_own_lean[i])) / static_cast<Scalar>(turn_step);
  }

  const Source* source_ = nullptr;
  LevelWeights<Real> weights_;  // at the anchor
  // shifts() by a unit of bends, and of how a segment leans.
  FixedArray<Scalar, Cap::joints> shift_by_bend_;
  FixedArray<Scalar, Cap::segments> shift_by_aside_;
};

}  // namespace taut
