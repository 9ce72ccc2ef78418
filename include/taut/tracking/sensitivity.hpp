// How tensions and slips change with friction that is not known, carried through stick and slip.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "taut/numerics/uncleared.hpp"
#include "taut/tracking/affine_map.hpp"

namespace taut {

/// The force F of a jack depends on an unknown: dF/dp = constant + proportional F.
template <class Scalar>
struct JackError {
  std::int16_t parameter = 0;
  std::int16_t jack = 0;  ///< 2 x cable + end
  Scalar constant = 0;
  Scalar proportional = 0;
};

/// Derivatives of everything that slips along the cables, and of the tensions, with respect to `Parameters`
/// numbers on which the friction of the joints, or the force of a jack, depends; all other loads are fixed.
///
/// The segment at a jack has the jack's force, and its derivative. A sliding joint keeps T_small = rho T_big,
/// so its derivative keeps T'_small = rho T'_big + rho' T_big, Eq. (16). A joint that sticks keeps the
/// derivative of its slip. Where sliding ends at an event, that is at a load that itself depends on friction,
/// the derivative jumps by the rate of slip times the derivative of that load, Eq. (18). Like tensions,
/// derivatives are affine in the inputs while no state changes.
template <class CondensedType, class Laws, int Parameters>
class Sensitivity {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Map = AffineMap<CondensedType, Laws>;
  using Tensions = typename Map::Tensions;
  using Inputs = typename Map::Inputs;

  /// What is kept from map to map: derivatives of the slips where they froze.
  struct Frozen {
    FixedArray<SlipState<Scalar, Cap>, Parameters> derivative;
    int used = 0;  ///< parameters
  };

  void begin() {
    frozen_ = {};
    parameter_.fill(-1);
    error_.fill({0, -1, 0, 0});
    event_shift_.fill(Scalar(0));
  }
  /// The parameter that the joint's friction depends on, or -1, and the derivative of its rho.
  void depend(int joint, int parameter, Real slope) {
    use(parameter);
    parameter_[joint] = static_cast<std::int16_t>(parameter);
    slope_[joint] = slope;
  }
  /// The derivative of rho has changed by this factor.
  void scale(int joint, Real by) { slope_[joint] *= by; }
  bool depends(int joint) const { return parameter_[joint] >= 0; }
  /// That derivative; 0 where nothing that is unknown matters to the joint.
  Real rho_slope(int joint) const { return depends(joint) ? slope_[joint] : Real(0); }
  /// A parameter that the force of a jack depends on, or that it depends on in another way from here on.
  void depend_on_load(const JackError<Scalar>& error) {
    use(error.parameter);
    error_[error.parameter] = error;
  }
  const Frozen& frozen() const { return frozen_; }
  void set_frozen(const Frozen& frozen) { frozen_ = frozen; }
  /// The parameters that something has depended on are the first ones: so many.
  int used() const { return frozen_.used; }
  /// Calls change(derivatives of all that has moved) for every parameter.
  template <class Change>
  void for_each(Change change) {
    for (int p = 0; p < frozen_.used; ++p) change(frozen_.derivative[p], p);
  }

  /// The map is another one.
  void drop() { is_made_ = has_base_ = false; }
  /// Since then make() was called: tension(), tension_slope(), slip_state() and turn() can be.
  bool is_made() const { return is_made_; }
  /// Of the map; cables.carry(moved, T) adds the tensions of everything that has moved. Cost: for every
  /// parameter that of ActiveSet::settle(), once and once an input.
  template <class Cables>
  void make(const Map& map, const Laws& laws, const Cables& cables) {
    is_made_ = true;
    if (used() == 0) return;
    map.set().settle_derivatives(laws, [&](auto zero, const auto& settle) {
      make_base<decltype(zero)>(map, map.anchor(), map.base(), settle, cables);
      make_columns<decltype(zero)>(map, settle);
    });
  }
  /// At inputs `x` alone, where it is not known there yet: for what is found there and for freeze(). Cost: of
  /// settle() one a parameter.
  template <class Cables>
  void make_at(const Map& map, const Laws& laws, const Inputs& x, const Cables& cables) {
    if (is_made_ || used() == 0 || (has_base_ && base_at_ == x)) return;
    Tensions T;
    map.tensions(x, T);
    map.set().settle_derivatives(
        laws, [&](auto zero, const auto& settle) { make_base<decltype(zero)>(map, x, T, settle, cables); });
  }

  /// dT/dp of a segment [N], at inputs `x`; `anchor` is that of the map.
  template <class Values>
  Scalar tension(const Map& map, int p, int segment, const Values& x, const Values& anchor) const {
    if (p >= frozen_.used) return 0;
    const Piece& piece = piece_[p];
    Scalar found = at(piece.base.tension, segment);
    for (int k = 0; k < map.inputs(); ++k)
      found += static_cast<Scalar>(x[k] - anchor[k]) * at(at(piece.column, k).tension, segment);
    return found;
  }
  /// How that changes with input `k`.
  Scalar tension_slope(int p, int k, int segment) const {
    return p >= frozen_.used ? Scalar(0) : at(at(piece_[p].column, k).tension, segment);
  }

  /// Derivatives of everything that has moved, at inputs `x`.
  SlipState<Scalar, Cap> slip_state(const Map& map, int p, const Inputs& x) const {
    if (p >= frozen_.used) return {};
    SlipState<Scalar, Cap> moving = frozen_.derivative[p];
    const Moved moved = from_base(map, x);
    for (int i = 0; i < map.active(); ++i)
      moving.of(map.variable(i)) = along(moved, piece_[p], &Column::value, i);
    return moving;
  }

  /// At inputs `x` a law that falls at the rate `falling` along the path reached its limit. `joint` is whose
  /// limit it is, or -1.
  void find_saltation(const Map& map, const Inputs& x, const Tensions& T, const TensionConstraint<Real>& law,
                      int joint, Real falling) {
    const Scalar per_rate = static_cast<Scalar>(-1 / falling), weight = static_cast<Scalar>(law.weight);
    const Moved moved = from_base(map, x);
    for (int p = 0; p < frozen_.used; ++p) {
      const auto tension = [&](int segment) { return along(moved, piece_[p], &Column::tension, segment); };
      Scalar change = tension(law.first);
      if (law.second >= 0) change -= weight * tension(law.second);
      if (joint >= 0 && parameter_[joint] == p) change -= static_cast<Scalar>(slope_[joint] * T[law.second]);
      event_shift_[p] = change * per_rate;
    }
  }
  /// At inputs `x` the active variable `i` came to its end at the rate `falling`: by how much later if
  /// friction were other.
  void find_saltation_of_move(const Map& map, const Inputs& x, int i, Real falling) {
    const Scalar per_rate = static_cast<Scalar>(-map.stiffness(i) / falling);
    const Moved moved = from_base(map, x);
    for (int p = 0; p < frozen_.used; ++p)
      event_shift_[p] = along(moved, piece_[p], &Column::value, i) * per_rate;
  }
  /// From here on parameter `p` is by so many times what it was until now.
  void weigh(int p, Scalar by) { frozen_.derivative[p].scale(by); }
  /// Nothing depends on parameter `p`, in the map that was made either.
  void forget(int p) {
    use(p);
    frozen_.derivative[p] = {};
    piece_[p].clear();
  }
  /// From here on parameter `p` is also by how much further input `k` went before it turned, or before its
  /// jack was locked.
  void turn(const Map& map, int p, int k) {
    use(p);
    for (int i = 0; i < map.active(); ++i)
      of_variable(map.variable(i), p) += static_cast<Scalar>(map.column_value(k, i));
  }
  /// From here on parameter `p` is by how much less cable an end holds that is locked; `jack` is
  /// 2 x cable + end. It is also so many times what it meant before.
  void draw_in(int p, int jack, Scalar before) {
    use(p);
    frozen_.derivative[p].scale(before);
    frozen_.derivative[p].extension[jack / 2][static_cast<std::size_t>(jack % 2)] -= 1;
  }
  /// From here on parameter `p` is the strain that a cable takes on by itself while the end `jack` of it,
  /// 2 x cable + end, is locked: to forces it is what slips and an extension would be that take as much of
  /// every segment, Eq. (38). `length` are those of the segments [m].
  template <class CableLayout, class Lengths>
  void strain(int p, const CableLayout& cable, const Lengths& length, int jack) {
    use(p);
    frozen_.derivative[p] = {};
    auto& moved = frozen_.derivative[p];
    const int n = cable.segments();
    const bool from_start = jack % 2 == 1;
    Scalar beyond = 0;
    for (int k = 0; k < n; ++k) {
      const int i = from_start ? k : n - 1 - k;
      beyond += length[cable.first_segment + i];
      if (k + 1 == n)
        moved.extension[jack / 2][static_cast<std::size_t>(jack % 2)] = -beyond;
      else
        moved.slip[cable.first_joint + (from_start ? i : i - 1)] = from_start ? -beyond : beyond;
    }
  }
  /// What comes next is not at an event.
  void pass() { event_shift_.fill(Scalar(0)); }

  /// Takes the derivatives where they are; `direction` is that of the inputs on the way here.
  void freeze(const Map& map, const Inputs& x, const Inputs& direction) {
    const Moved moved = from_base(map, x);
    for (int i = 0; i < map.active(); ++i) {
      const auto rate = static_cast<Scalar>(map.value_rate(i, direction));
      for (int p = 0; p < frozen_.used; ++p)
        of_variable(map.variable(i), p) = along(moved, piece_[p], &Column::value, i) + event_shift_[p] * rate;
    }
  }

 private:
  template <class T, int N>
  using Plain = std::array<T, static_cast<std::size_t>(N)>;  // not cleared
  template <class Of>
  static auto& at(Of& of, int i) {
    return of[static_cast<std::size_t>(i)];
  }
  /// Derivatives of the tensions, and of the values of the active variables.
  struct Column {
    Plain<Scalar, Cap::segments> tension;
    Plain<Scalar, Map::max_active> value;
    void clear() {
      tension.fill(Scalar(0));
      value.fill(Scalar(0));
    }
  };
  /// Of the map, with respect to one parameter: where it was made, and how that changes with the inputs.
  struct Piece {
    Column base;
    Plain<Column, Map::max_inputs> column;
    void clear() {
      base.clear();
      for (Column& each : column) each.clear();
    }
  };

  /// At inputs `x`, with the tensions there.
  template <class Number, class Settle, class Cables>
  void make_base(const Map& map, const Inputs& x, const Tensions& there, const Settle& settle,
                 const Cables& cables) {
    has_base_ = true;
    base_at_ = x;
    for (int p = 0; p < frozen_.used; ++p) {
      typename Map::Set::template Along<Number> T;
      typename Map::Set::template By<Number> values;
      cables.carry(frozen_.derivative[p], T);
      for (int i = 0; i < map.active(); ++i) values[i] = static_cast<Number>(of_variable(map.variable(i), p));
      settle(due<Number>(map, p, there, error_at(map, p, x)), T, values);
      store(map, T, values, piece_[p].base);
    }
  }
  template <class Number, class Settle>
  void make_columns(const Map& map, const Settle& settle) {
    for (int p = 0; p < frozen_.used; ++p)
      for (int k = 0; k < map.inputs(); ++k) {
        typename Map::Set::template Along<Number> T;
        typename Map::Set::template By<Number> values;
        settle(due<Number>(map, p, map.column(k), error_by_input(map, p, k)), T, values);
        store(map, T, values, at(piece_[p].column, k));
      }
  }

  /// In the map that was made nothing depends on those that are new.
  void use(int parameter) {
    for (; frozen_.used <= parameter; ++frozen_.used) piece_[frozen_.used].clear();
  }
  Scalar& of_variable(const SlipVariable& variable, int p) { return frozen_.derivative[p].of(variable); }

  /// How far inputs are from those of the base: make_at() was there, and has made no more.
  struct Moved {
    FixedArray<Scalar, Map::max_inputs> by;
    int inputs;
  };
  Moved from_base(const Map& map, const Inputs& x) const {
    Moved moved{{}, is_made_ ? map.inputs() : 0};
    for (int k = 0; k < moved.inputs; ++k) moved.by[k] = static_cast<Scalar>(x[k] - map.anchor()[k]);
    return moved;
  }
  /// One of the tensions, or of the values, there.
  template <class Of>
  static Scalar along(const Moved& moved, const Piece& piece, Of Column::*of, int i) {
    Scalar found = at(piece.base.*of, i);
    for (int k = 0; k < moved.inputs; ++k) found += moved.by[k] * at(at(piece.column, k).*of, i);
    return found;
  }
  bool is_force_of(const Input& input, int p) const {
    return input.kind == Input::Kind::jack_force && input.index == error_[p].jack;
  }
  /// Derivative of the force of the jack that depends on `p`, at inputs `x`.
  Real error_at(const Map& map, int p, const Inputs& x) const {
    for (int k = 0; error_[p].jack >= 0 && k < map.inputs(); ++k)
      if (is_force_of(map.input(k), p))
        return static_cast<Real>(error_[p].constant) + static_cast<Real>(error_[p].proportional) * x[k];
    return 0;
  }
  /// How that changes with input `k`.
  Real error_by_input(const Map& map, int p, int k) const {
    return error_[p].jack >= 0 && is_force_of(map.input(k), p) ? static_cast<Real>(error_[p].proportional)
                                                               : Real(0);
  }
  /// What the laws' derivatives are to be: rho' T_big of every sliding joint, and that of the jack's force.
  template <class Number>
  typename Map::Set::template By<Number> due(const Map& map, int p, const Tensions& T, Real of_jack) const {
    typename Map::Set::template By<Number> values;
    if (of_jack != 0)
      for (int i = 0; i < map.active(); ++i)
        if (map.variable(i).kind == SlipVariable::Kind::extension && map.variable(i).index == error_[p].jack)
          values[i] = static_cast<Number>(of_jack);
    if constexpr (Cap::joints > 0) {
      for (int i = 0; i < map.active(); ++i) {
        const ActiveConstraint& active = map.actives()[i];
        if (!active.slides()) continue;
        if (parameter_[active.variable.index] == p)
          values[i] =
              static_cast<Number>(slope_[active.variable.index]) * static_cast<Number>(T[active.big()]);
      }
    }
    return values;
  }
  template <class Along, class By>
  static void store(const Map& map, const Along& T, const By& values, Column& into) {
    for (int i = 0; i < Cap::segments; ++i) at(into.tension, i) = static_cast<Scalar>(T[i]);
    for (int i = 0; i < map.active(); ++i) at(into.value, i) = static_cast<Scalar>(values[i]);
  }

  Frozen frozen_;
  FixedArray<std::int16_t, Cap::joints> parameter_;
  FixedArray<Real, Cap::joints> slope_;
  FixedArray<JackError<Scalar>, Parameters> error_;  // jack -1: none
  FixedArray<Scalar, Parameters>
      event_shift_;  // by how much of what was left of the path the event comes later
  Inputs base_at_;   // those of the base
  bool has_base_ = false, is_made_ = false;
  Uncleared<Piece, Parameters> piece_;  // made with every map, for what is in use: most of a large tracker
};

/// Of a tracker whose friction is known: nothing is carried, and nothing done for it.
template <class CondensedType, class Laws>
class Sensitivity<CondensedType, Laws, 0> {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Cap = typename CondensedType::Capacity;
  using Map = AffineMap<CondensedType, Laws>;
  struct Frozen {};

  static constexpr int used() { return 0; }
  static constexpr typename CondensedType::Real rho_slope(int) { return 0; }
  template <class Change>
  static void for_each(const Change&) {}
  static void depend_on_load(const JackError<Scalar>&) {}
  static void turn(const Map&, int, int) {}
  static void weigh(int, Scalar) {}
  static void forget(int) {}
  static void draw_in(int, int, Scalar) {}
  template <class Values>
  static Scalar tension(const Map&, int, int, const Values&, const Values&) {
    return 0;
  }
  static Scalar tension_slope(int, int, int) { return 0; }
  static SlipState<Scalar, Cap> slip_state(const Map&, int, const typename Map::Inputs&) { return {}; }
};

}  // namespace taut
