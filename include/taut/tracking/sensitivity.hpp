// How tensions and slips change with friction that is not known, carried through stick and slip.
#pragma once

#include <array>
#include <cmath>
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
  using Values = typename Map::Values;
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
    event_shift_.fill(Real(0));
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

  /// Of the map that was just made; settle(due, T, values) lets its active variables follow until their laws
  /// give what is due, carry(moved, T) adds the tensions of everything that has moved.
  template <class Settle, class Carry>
  void make(const Map& map, Settle settle, Carry carry) {
    for (int p = 0; p < frozen_.used; ++p) {
      Tensions T;
      T.fill(Real(0));
      carry(frozen_.derivative[p], T);
      Values values;
      for (int i = 0; i < map.active(); ++i) values[i] = static_cast<Real>(of_variable(map.variable(i), p));
      settle(due(map, p, map.base(), error_at_anchor(map, p)), T, values);
      store(map, T, values, piece_[p].base);
      for (int k = 0; k < map.inputs(); ++k) {
        T.fill(Real(0));
        values.fill(Real(0));
        settle(due(map, p, map.column(k), error_by_input(map, p, k)), T, values);
        store(map, T, values, at(piece_[p].column, k));
      }
    }
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
    for (int i = 0; i < map.active(); ++i)
      moving.of(map.variable(i)) = static_cast<Scalar>(derivative(map, p, i, x));
    return moving;
  }

  /// At inputs `x` a law that falls at the rate `falling` along `direction` reached its limit. `joint` is
  /// whose limit it is, or -1.
  void find_saltation(const Map& map, const Inputs& x, const Tensions& T, const TensionConstraint<Real>& law,
                      int joint, Real falling) {
    for (int p = 0; p < frozen_.used; ++p) {
      Real change = static_cast<Real>(tension(map, p, law.first, x, map.anchor()));
      if (law.second >= 0)
        change -= law.weight * static_cast<Real>(tension(map, p, law.second, x, map.anchor()));
      if (joint >= 0 && parameter_[joint] == p) change -= slope_[joint] * T[law.second];
      event_shift_[p] = -change / falling;
    }
  }
  /// At inputs `x` the active variable `i` came to its end at the rate `falling`: by how much later if
  /// friction were other.
  void find_saltation_of_move(const Map& map, const Inputs& x, int i, Real falling) {
    for (int p = 0; p < frozen_.used; ++p)
      event_shift_[p] = -derivative(map, p, i, x) * map.stiffness(i) / falling;
  }
  /// From here on parameter `p` is by so many times what it was until now.
  void weigh(int p, Scalar by) { frozen_.derivative[p].scale(by); }
  /// Nothing depends on parameter `p`, in the map that was made either.
  void forget(int p) {
    use(p);
    frozen_.derivative[p] = {};
    piece_[p].base.clear();
    for (Column& column : piece_[p].column) column.clear();
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
  void pass() { event_shift_.fill(Real(0)); }

  /// Takes the derivatives where they are; `direction` is that of the inputs on the way here.
  void freeze(const Map& map, const Inputs& x, const Inputs& direction) {
    for (int p = 0; p < frozen_.used; ++p)
      for (int i = 0; i < map.active(); ++i)
        of_variable(map.variable(i), p) =
            static_cast<Scalar>(derivative(map, p, i, x) + event_shift_[p] * map.value_rate(i, direction));
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
  };

  void use(int parameter) {
    if (parameter >= frozen_.used) frozen_.used = parameter + 1;
  }
  Scalar& of_variable(const SlipVariable& variable, int p) { return frozen_.derivative[p].of(variable); }

  /// dm/dp of an active variable.
  Real derivative(const Map& map, int p, int i, const Inputs& x) const {
    const Piece& piece = piece_[p];
    Real found = static_cast<Real>(at(piece.base.value, i));
    for (int k = 0; k < map.inputs(); ++k)
      found += (x[k] - map.anchor()[k]) * static_cast<Real>(at(at(piece.column, k).value, i));
    return found;
  }
  bool is_force_of(const Input& input, int p) const {
    return input.kind == Input::Kind::jack_force && input.index == error_[p].jack;
  }
  /// Derivative of the force of the jack that depends on `p`, where the map was made.
  Real error_at_anchor(const Map& map, int p) const {
    for (int k = 0; error_[p].jack >= 0 && k < map.inputs(); ++k)
      if (is_force_of(map.input(k), p))
        return static_cast<Real>(error_[p].constant) +
               static_cast<Real>(error_[p].proportional) * map.anchor()[k];
    return 0;
  }
  /// How that changes with input `k`.
  Real error_by_input(const Map& map, int p, int k) const {
    return error_[p].jack >= 0 && is_force_of(map.input(k), p) ? static_cast<Real>(error_[p].proportional)
                                                               : Real(0);
  }
  /// What the laws' derivatives are to be: rho' T_big of every sliding joint, and that of the jack's force.
  Values due(const Map& map, int p, const Tensions& T, Real of_jack) const {
    Values values;
    values.fill(Real(0));
    if (of_jack != 0)
      for (int i = 0; i < map.active(); ++i)
        if (map.variable(i).kind == SlipVariable::Kind::extension && map.variable(i).index == error_[p].jack)
          values[i] = of_jack;
    if constexpr (Cap::joints > 0) {
      for (int i = 0; i < map.active(); ++i) {
        const ActiveConstraint& active = map.actives()[i];
        if (!active.slides()) continue;
        if (parameter_[active.variable.index] == p)
          values[i] = slope_[active.variable.index] * T[active.big()];
      }
    }
    return values;
  }
  static void store(const Map& map, const Tensions& T, const Values& values, Column& into) {
    for (int i = 0; i < Cap::segments; ++i) at(into.tension, i) = static_cast<Scalar>(T[i]);
    for (int i = 0; i < map.active(); ++i) at(into.value, i) = static_cast<Scalar>(values[i]);
  }

  Frozen frozen_;
  FixedArray<std::int16_t, Cap::joints> parameter_;
  FixedArray<Real, Cap::joints> slope_;
  FixedArray<JackError<Scalar>, Parameters> error_;  // jack -1: none
  FixedArray<Real, Parameters>
      event_shift_;                     // by how much of what was left of the path the event comes later
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
