// The cables of a condensed scene in their present state: what the parts of the tracker ask and change.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "taut/scene/sliding_spans.hpp"
#include "taut/status.hpp"
#include "taut/tracking/affine_map.hpp"
#include "taut/tracking/cable_state.hpp"
#include "taut/tracking/sensitivity.hpp"

namespace taut {

/// The state of all cables, the affine map of the present piece, and what follows from them alone. Nothing is
/// decided here. Every function costs at most O(segments x inputs), those that add up tensions O(segments^2)
/// on a structure.
template <class CondensedType, int Parameters>
struct CableSystem {
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Model = CondensedType;
  using Loads = Drive<Real, Cap>;
  using Laws = JointConstraints<CondensedType, (Parameters > 0)>;
  using Map = AffineMap<CondensedType, Laws>;
  using Derivatives = Sensitivity<CondensedType, Laws, Parameters>;
  using SlipState = taut::SlipState<Real, Cap>;
  using Tensions = typename Map::Tensions;
  using Inputs = typename Map::Inputs;
  using Span = typename SlidingSpans<Cap>::Span;
  using State = CableState<CondensedType, Map::max_inputs>;
  static constexpr bool is_adjustable = Parameters > 0;
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  /// Forces closer than this part of the largest force so far are equal.
  static constexpr Real tolerance = Real(1e-12);

  struct JackedEnd {
    int cable = 0;
    std::size_t end = 0;
    int input = 0;        ///< its force in the map, or -1
    bool locked = false;  ///< as in the goal
  };

  State state;
  const CondensedType* model = nullptr;
  SlidingSpans<Cap> spans;
  Laws laws;
  FixedList<JackedEnd, max_jacks<Cap>> jacks;
  FixedArray<std::int16_t, 2 * Cap::cables> number;  ///< of an end among the jacks, or -1

  // Made from the state.
  Map map;
  Derivatives derivatives;
  struct Nothing {};
  struct Shifts {
    FixedArray<Scalar, max_shifts<Cap>> base;                             ///< where the map was made
    FixedArray<FixedArray<Scalar, max_shifts<Cap>>, Map::max_inputs> by;  ///< of a unit of every input
  };
  Tensions total;          ///< tensions from all slips, made by the last test of forces [N]
  Tensions force;          ///< where the last event, or the last call with events, ended [N]
  Real push = 0;           ///< largest change of force that the path would make with every joint stuck [N]
  bool is_set_up = false;  ///< the slips of the map are those of the present modes
  bool has_redundant_jack = false;  ///< a cable of one segment has two jacks at work
  /// Second-order theory: LevelModel::shifts() along the map.
  std::conditional_t<Model::has_level, Shifts, Nothing> shifts;

  /// Begins without loads; the goal is the prestrain.
  void begin(const CondensedType& condensed) {
    model = &condensed;
    spans.find(condensed.cables, [&condensed](int j) { return condensed.is_self_locking(j); });
    jacks.clear();
    number.fill(-1);
    for_each_jacked_end(condensed.cables, [&](int c, std::size_t end) {
      number[2 * c + static_cast<int>(end)] = static_cast<std::int16_t>(jacks.add({c, end, -1, false}));
    });
    laws.find(condensed);
    state = {};
    state.goal.prestrain = 1;
    for (int r = 0; r < spans.size(); ++r)
      state.representative[r] = static_cast<std::int16_t>(spans[r].segment(0));
    force = {};
    find_redundant_jack();
    map.begin(condensed);
    drop_set();
    if constexpr (is_adjustable) derivatives.begin();
  }

  /// The numbers of the model have changed.
  void take_model() {
    map.begin(*model);
    drop_set();
  }

  // Queries.

  bool has_prestrain() const {
    for (int i = 0; Cap::prestrain && i < model->segments; ++i)
      if (model->prestrain[i] != 0) return true;
    return false;
  }

  Real force_tolerance() const { return tolerance * state.peak; }
  /// Zero at compile time where the capacity is, so that no code for joints is left.
  int joints() const { return Cap::joints == 0 ? 0 : model->joints; }
  /// Where there can be only one cable the compiler knows its number.
  static int number_of(int cable) { return Cap::cables == 1 ? 0 : cable; }
  int patterns() const { return Cap::loads == 0 ? 0 : model->loads; }

  /// Of an unlocked jack's force in the present map, or -1.
  int input_of(int cable, std::size_t end) const {
    const int jack = number[2 * cable + static_cast<int>(end)];
    return jack < 0 ? -1 : input_of(jack);
  }
  int input_of(int jack) const { return state.has_map ? jacks[jack].input : -1; }

  /// A span that ends in an unlocked jack cannot go slack: the jack draws it straight.
  bool is_jacked(const Span& span) const {
    for (const JackedEnd& jack : jacks)
      if (pulls(jack, span)) return true;
    return false;
  }
  bool pulls(const JackedEnd& jack, const Span& span) const {
    if (jack.cable != span.cable || state.goal.jack[jack.cable][jack.end].locked) return false;
    const int segment = model->cables[jack.cable].end_segment(jack.end);
    return segment == span.segment(0) || segment == span.segment(span.count - 1);
  }
  /// On a cable of one segment with two jacks at work the start's extension rests, and the end's does for
  /// both.
  bool is_redundant(int c, std::size_t end) const {
    return max_jacks<Cap> >= 2 && end == 0 && model->cables[c].segments() == 1 &&
           model->cables[c].ends[1] == End::jacked && !state.goal.jack[c][0].locked &&
           !state.goal.jack[c][1].locked;
  }
  void find_redundant_jack() {
    has_redundant_jack = false;
    for (const JackedEnd& jack : jacks)
      has_redundant_jack = has_redundant_jack || is_redundant(jack.cable, jack.end);
  }
  /// Two jacks on one segment balance only if they pull alike.
  bool redundant_agrees(int c) const {
    const Real F0 = state.goal.jack[c][0].force, F1 = state.goal.jack[c][1].force;
    return std::fabs(F0 - F1) <= Real(64) * tolerance * larger(F0, F1);
  }
  bool is_slack(int segment) const { return state.slack[spans.of(segment)]; }
  /// Self-locking joints never do; in a span without tension they move as they must.
  bool can_slide(int joint) const {
    const int span = spans.of(laws.sides(joint)[0]);
    return !model->is_self_locking(joint) && !state.slack[span] && !state.rests[span];
  }

  /// Without friction it slides both ways, and its law always holds.
  bool glides(int joint) const {
    if constexpr (is_adjustable)
      if (derivatives.depends(joint)) return false;
    return Cap::smooth && !(laws.rho(joint) < 1);
  }

  /// rho of a joint that is about to slide: it scales the tolerance of its smaller force.
  Real held(const SlipMode& next) const { return next.joint < 0 ? Real(1) : laws.rho(next.joint); }
  Status at_joint(Code code, int joint) const {
    for (int c = 0; c < model->cables.size(); ++c) {
      const int j = joint - model->cables[c].first_joint;
      if (joint >= 0 && j >= 0 && j < model->cables[c].joints())
        return Status::along(code, Place::joint, c, j);
    }
    return Status::at(code, Place::none, -1);
  }

  // Slips.

  /// Slips, extensions and slack lengths at the end of the path followed.
  SlipState slip_state() const {
    SlipState moving = state.moved;
    if (!state.has_map) return moving;
    Inputs x;
    values(state.now, x);
    for (int i = 0; i < map.active(); ++i) moving.of(map.variable(i)) = map.value(i, x);
    for (const JackedEnd& jack : jacks)
      if (state.goal.jack[jack.cable][jack.end].locked)
        moving.extension[jack.cable][jack.end] = state.now.jack[jack.cable][jack.end].extension;
    return moving;
  }

  /// Takes the slips where they are, to make another map from.
  void freeze() {
    if (!state.has_map) return;
    if constexpr (is_adjustable) {
      Inputs x;
      values(state.now, x);
      differentiate_at(x);
      derivatives.freeze(map, x, state.last);
    }
    state.moved = slip_state();
  }
  /// Makes the derivatives of the map, where they are not made yet: whoever asks Sensitivity for them needs
  /// them. Of the pieces that a path passes, only those at their ends are needed.
  void differentiate() {
    if constexpr (is_adjustable)
      if (state.has_map && !derivatives.is_made()) derivatives.make(map, laws, *this);
  }
  /// The same for freeze() and what is found at its event, at inputs `x` alone.
  void differentiate_at(const Inputs& x) { derivatives.make_at(map, laws, x, *this); }
  void stop(int joint) {
    if (state.slides[joint] == JointState::stick) return;
    state.slides[joint] = JointState::stick;
    FixedList<std::int16_t, Cap::joints> others;
    for (const std::int16_t each : state.order)
      if (each != joint) others.add(each);
    state.order = others;
  }
  void drop_map() {
    state.has_map = false;
    state.has_range = false;
  }
  /// Other slip variables are at work from here on.
  void drop_set() {
    is_set_up = false;
    drop_map();
  }

  static Real value(const Input& input, const Loads& loads) {
    if (input.kind == Input::Kind::load) return loads.factor[input.index];
    if (Cap::prestrain && input.kind == Input::Kind::prestrain) return loads.prestrain;
    const auto& jack = loads.jack[input.index / 2][static_cast<std::size_t>(input.index % 2)];
    return input.kind == Input::Kind::jack_force ? jack.force : jack.extension;
  }
  void values(const Loads& loads, Inputs& x) const {
    for (int k = 0; k < map.inputs(); ++k) x[k] = value(map.input(k), loads);
  }
  /// What is left of the path.
  void directions(Inputs& dx) const {
    for (int k = 0; k < map.inputs(); ++k)
      dx[k] = value(map.input(k), state.goal) - value(map.input(k), state.now);
  }
  void find_forces() {
    if (!state.has_map) return;
    Inputs x;
    values(state.now, x);
    map.tensions(x, force);
  }

  // How far geometry has changed in the present step of second-order theory.

  /// After the map was made.
  void find_shifts() {
    if constexpr (Model::has_level) {
      const auto keep = [this](const auto& found, FixedArray<Scalar, max_shifts<Cap>>& kept) {
        for (int n = 0; n < model->shift_count(); ++n) kept[n] = static_cast<Scalar>(found[n]);
      };
      keep(model->shifts(state.now, elongations_by(slip_state())), shifts.base);
      for (int k = 0; k < map.inputs(); ++k) {
        const Input& input = map.input(k);
        FixedArray<Real, Cap::loads> factor;
        factor.fill(Real(0));
        if (input.kind == Input::Kind::load) factor[input.index] = 1;
        SlipState moving{};
        for (int i = 0; i < map.active(); ++i) moving.of(map.variable(i)) = map.column_value(k, i);
        if (input.kind == Input::Kind::extension)
          moving.extension[input.index / 2][static_cast<std::size_t>(input.index % 2)] = 1;
        keep(model->shifts_by(factor, elongations_by(moving)), shifts.by[k]);
      }
    }
  }
  template <class Number, class Values, class Anchor>
  Number shift_at(int n, const Values& x, const Anchor& anchor) const {
    auto sum = static_cast<Number>(shifts.base[n]);
    for (int k = 0; k < map.inputs(); ++k) sum += (x[k] - anchor[k]) * static_cast<Number>(shifts.by[k][n]);
    return sum;
  }

  // Tensions, Eqs. (6) and (8).

  /// Tensions from the present loads and everything that has moved.
  Tensions totals() const { return totals(state.moved); }
  Tensions totals(const SlipState& moved) const {
    Tensions T;
    T.fill(Real(0));
    for (int i = 0; i < model->segments; ++i) {
      if constexpr (Cap::prestrain) T[i] = state.now.prestrain * model->prestrain[i];
      for (int k = 0; k < model->loads; ++k) T[i] += state.now.factor[k] * model->load[k][i];
    }
    carry(moved, T);
    return T;
  }
  /// Rates of tension with every joint stuck.
  void stuck_rates(Tensions& rates) const {
    rates.fill(Real(0));
    [[maybe_unused]] const Real prestrain = state.goal.prestrain - state.now.prestrain;
    for (int i = 0; i < model->segments; ++i) {
      if constexpr (Cap::prestrain) rates[i] = prestrain * model->prestrain[i];
      for (int k = 0; k < patterns(); ++k)
        rates[i] += (state.goal.factor[k] - state.now.factor[k]) * model->load[k][i];
    }
    Tensions e;
    e.fill(Real(0));
    for (const JackedEnd& jack : jacks) {
      const auto& start = state.now.jack[jack.cable][jack.end];
      const auto& goal = state.goal.jack[jack.cable][jack.end];
      if (goal.locked) e[model->cables[jack.cable].end_segment(jack.end)] += goal.extension - start.extension;
    }
    model->coupling.add(model->segments, e, rates);
  }
  /// Adds the tensions that slips make.
  template <class Moved, class Number>
  void carry(const Moved& moved, FixedArray<Number, Cap::segments>& T) const {
    model->coupling.add(model->segments, elongations_by<Number>(moved), T);
  }
  /// Elongations that slips, or derivatives of slips, impose on the segments [m].
  template <class Number = Real, class Moved>
  FixedArray<Number, Cap::segments> elongations_by(const Moved& moved) const {
    FixedArray<Number, Cap::segments> e;
    e.fill(Number(0));
    impose(moved, e);
    return e;
  }
  template <class Moved, class Number>
  void impose(const Moved& moved, FixedArray<Number, Cap::segments>& e) const {
    for (int j = 0; j < joints(); ++j) laws.slip(j).impose(static_cast<Number>(moved.slip[j]), e);
    for (const JackedEnd& jack : jacks)
      e[model->cables[jack.cable].end_segment(jack.end)] +=
          static_cast<Number>(moved.extension[jack.cable][jack.end]);
    for (int r = 0; r < spans.size(); ++r)
      if (state.slack[r]) e[spans[r].segment(0)] += static_cast<Number>(moved.slack_length[r]);
  }

  // What is rounding.

  /// What the loads would do with every joint stuck, on what is left of the path, is as large as any force:
  /// it says what is rounding.
  void measure_path() {
    push = 0;
    for (int i = 0; i < model->segments; ++i) {
      state.peak = larger(state.peak, force[i]);
      if constexpr (Cap::prestrain) {
        const auto prestrain = model->prestrain[i];
        measure(state.goal.prestrain * prestrain, (state.goal.prestrain - state.now.prestrain) * prestrain);
      }
      for (int k = 0; k < model->loads; ++k) {
        const auto load = model->load[k][i];
        measure(state.goal.factor[k] * load, (state.goal.factor[k] - state.now.factor[k]) * load);
      }
    }
    for (const JackedEnd& jack : jacks) {
      const auto& start = state.now.jack[jack.cable][jack.end];
      const auto& goal = state.goal.jack[jack.cable][jack.end];
      const int segment = model->cables[jack.cable].end_segment(jack.end);
      measure(goal.force, goal.force - start.force);
      const Real drawn = model->coupling(segment, segment) * (goal.extension - start.extension);
      measure(drawn, drawn);
    }
  }
  void measure(Real size, Real change) {
    state.peak = larger(state.peak, std::fabs(size));
    push = larger(push, std::fabs(change));
  }
  /// Rates of force along the path below this are zero [N]; all of them if the path itself is rounding.
  Real rate_tolerance() const {
    return push > epsilon * state.peak ? Real(64) * epsilon * push : Real(64) * epsilon * state.peak;
  }
};

}  // namespace taut
