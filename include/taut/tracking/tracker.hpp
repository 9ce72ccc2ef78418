// Follows the forces of a condensed scene from sample to sample, from event to event.
#pragma once

#include <cmath>
#include <new>
#include <utility>

#include "taut/status.hpp"
#include "taut/tracking/adjustment.hpp"
#include "taut/tracking/event_path.hpp"
#include "taut/tracking/level.hpp"
#include "taut/tracking/level_friction.hpp"
#include "taut/tracking/sample_goal.hpp"
#include "taut/tracking/tracked_forces.hpp"

namespace taut {

/// Nothing is unknown of the forces of jacks.
struct NoLoadErrors {
  struct None {};
  constexpr const None* begin() const { return nullptr; }
  constexpr const None* end() const { return nullptr; }
};

/// The exact answer between samples. Along the straight path of loads and jack forces tensions are piecewise
/// linear; only where a piece ends (a joint begins to slide, a span goes slack or taut) is anything solved.
///
/// What moves along the cables are the slips of the joints, the extensions of the jacks and the slack lengths
/// of spans. A slip variable is frozen at its value, or active under a constraint of its own, Eq. (9): a
/// sliding joint keeps T_small = rho T_big, an unlocked jack keeps its force, a slack span has no tension.
/// Where a piece ends, the rates of the joints at their limit solve a linear complementarity problem, Eq.
/// (10). Always totals: nothing is added up, nothing drifts.
///
/// The condensed scene must come from a valid scene and outlive the tracker. With `Parameters`, the
/// derivatives with respect to so many unknowns of the friction are carried along: see Sensitivity and
/// adjust().
template <class CondensedType, int Parameters = 0>
class Tracker : public TrackedForces<CondensedType, Parameters> {
  using Base = TrackedForces<CondensedType, Parameters>;
  using Base::cables_;
  using Base::samples_;
  using typename Base::Cables;

 public:
  using typename Base::Cap;
  using typename Base::Loads;
  using typename Base::Model;
  using typename Base::Real;
  using typename Base::Scalar;
  using typename Base::SlipState;
  using typename Base::Tensions;
  using Laws = typename Cables::Laws;
  using Derivatives = typename Cables::Derivatives;
  /// Events in one call. Of a million random logs three reach it.
  static constexpr int default_budget = 64 + 16 * Cap::segments;

  /// All that restore() needs to go on with the same bits: a plain value.
  struct State : Cables::State, Derivatives::Frozen, Level<CondensedType>::Reached {};

  // Beginning.

  /// Begins without loads, with the friction of the condensed scene, and brings the prestrain on. Fails as
  /// advance() does.
  Progress<Scalar> start(const CondensedType& condensed, int event_budget = default_budget) {
    return start(condensed, as_condensed, event_budget);
  }
  /// Begins with the friction that `friction(joint)` gives as JointFriction, for every joint that is not
  /// self-locking.
  template <class Friction, class = decltype(std::declval<Friction>()(0))>
  Progress<Scalar> start(const CondensedType& condensed, const Friction& friction,
                         int event_budget = default_budget) {
    return start(condensed, friction, NoLoadErrors(), event_budget);
  }
  /// And with unknowns on which the forces of jacks depend: `errors` is a list of JackError.
  template <class Friction, class Errors, class = decltype(std::declval<Errors>().begin())>
  Progress<Scalar> start(const CondensedType& condensed, const Friction& friction, const Errors& errors,
                         int event_budget = default_budget) {
    level_.begin(condensed);
    take(friction, errors);
    return bring_prestrain_on(event_budget);
  }
  /// The scene that it was begun with.
  const CondensedType& condensed() const { return level_.source(); }
  /// The state, between two calls. Cost: a copy of it.
  State save() const {
    State saved;
    save_into(saved);
    return saved;
  }
  /// The same where it is to be kept: it does not lie on the stack as well. Cost: a copy of it.
  void save_into(State& saved) const {
    static_cast<typename Cables::State&>(saved) = cables_.state;
    if constexpr (is_adjustable)
      static_cast<typename Derivatives::Frozen&>(saved) = cables_.derivatives.frozen();
    level_.save(saved);
  }
  /// Goes on where save() was called on a tracker of the same scene, with the same bits. Fails with
  /// `bad_sample` if the state was saved before start(), or is seen to be none of this scene; then it is as
  /// before start(). Not every such state is seen: its bytes must be those of save(), whole and undamaged, or
  /// what follows is undefined. Cost: that of one event.
  Status restore(const CondensedType& condensed, const State& saved) {
    return restore(condensed, as_condensed, saved);
  }
  /// Goes on with the friction, and the unknowns, that were used when the state was saved.
  template <class Friction, class Errors = NoLoadErrors>
  Status restore(const CondensedType& condensed, const Friction& friction, const State& saved,
                 const Errors& errors = {}) {
    // What was saved before start() has no prestrain to go to.
    const bool is_of_scene = level_.restore(condensed, saved) && saved.goal.prestrain == 1;
    take(friction, errors);
    return is_of_scene ? take_over(saved) : broken_state();
  }

  // A sample.

  /// Follows the straight path from the present state to the sample. When the event budget is spent
  /// (`fraction` < 1) the state is the equilibrium reached, and a call with the same sample goes on from
  /// there.
  ///
  /// Fails with `bad_sample` if and only if a number of the sample is not finite or beyond what the cables
  /// can carry: then nothing was done. Else, at `fraction` of the path, with `pulled_through` (two jacks
  /// differ by more than all friction; names the cable), `mechanism` (nothing holds a node; names a joint
  /// there), `gives_way` (the structure would jump), `ill_conditioned` or `state_iterations` (no answer in
  /// this precision); the state is the last that was tested.
  ///
  /// Cost: see SamplePath without an event; else that of `events` events, each O(segments^2) on a structure
  /// and O(segments) between rigid saddles, at worst O(segments^3) where a decision begins from nothing.
  Progress<Scalar> advance(const Sample<Scalar, Cap>& sample, int event_budget = default_budget) {
    if (try_to_extend(sample)) return {};
    return drive(sample, event_budget);
  }
  /// Follows the sample if one load alone changes and stays where nothing happens: all tensions and
  /// derivatives go on along straight lines. Otherwise false, and nothing is changed.
  bool try_to_extend(const Sample<Scalar, Cap>& sample) { return samples_.try_to_extend(cables_, sample); }
  /// Follows the force of this jack, by its number, in the same way.
  bool try_to_extend(int jack, Scalar force) { return samples_.try_to_extend(cables_, jack, force); }
  /// Whether this force of a jack, by its number, is on the present piece; nothing is changed.
  bool reaches(int jack, Scalar force) const { return samples_.reaches(cables_, jack, force); }

  // Unknown friction.

  /// Brings the present state to what it would be had the friction been `friction(joint)` all along, to first
  /// order; `change` is by how much each unknown differs. Joints that come to lie outside of their cone are
  /// put on its edge; between two jacks one joint is left to stick. Fails with `mechanism` where joints on
  /// their edges leave a node free; then only stay() may follow. Cost: that of one event, and of one more for
  /// every joint on the edge.
  template <class Friction, class Changes>
  Status adjust(const Friction& friction, const Changes& change) {
    const bool has_map = has_or_makes_map();
    depend_on_friction(cables_, level_, friction);
    if (!has_map) return Status::success();
    FixedArray<Scalar, Parameters> by;
    for (int p = 0; p < cables_.derivatives.used(); ++p) by[p] = change[p];
    return change_unknowns(by);
  }
  /// After adjust() failed, with the friction of before: goes on from where it was. Fails with `mechanism`;
  /// then only start() may follow. Cost: that of one event.
  template <class Friction>
  Status stay(const Friction& friction) {
    depend_on_friction(cables_, level_, friction);
    return make_map_anew();
  }
  /// Jacks reverse here, or are locked, and leave now: from here on unknown error_of(k) is an error [N] in
  /// the force that jack `k`, by its number, has here, and what friction remembers of it is carried along;
  /// error_of(k) is -1 for every other jack. As long as none has left, what slides follows the loads as they
  /// are. Cost: that of a map, and at worst of one event.
  template <class ErrorOf>
  void turn(const ErrorOf& error_of) {
    if (!has_or_makes_map()) return;
    freeze_here();
    for (int k = 0; k < cables_.jacks.size(); ++k)
      if (const int p = error_of(k), input = cables_.input_of(k); p >= 0 && input >= 0)
        cables_.derivatives.turn(cables_.map, p, input);
    drop_map();
  }
  /// Unknown `p` will mean something else: what is remembered of it is so many times that from here on. Cost:
  /// that of turn(); where it is nothing, a number each that slips.
  void weigh(int p, Scalar by) {
    if (by == 0) return cables_.derivatives.forget(p);
    freeze_here();
    cables_.derivatives.weigh(p, by);
    drop_map();
  }
  /// From here on unknown `p` is by how much further [m] the wedge of a locked end was drawn in than the
  /// model has it, now that it is seated; and also `before` times what it was until now. Cost: that of
  /// turn().
  void draw_in(int p, int cable, std::size_t end, Scalar before = 0) {
    freeze_here();
    cables_.derivatives.draw_in(p, 2 * cable + static_cast<int>(end), before);
    drop_map();
  }
  /// Follows a sample as advance() does, and draws the wedges of all ends that are locked there in by
  /// further(cable, end) [m] more on the way. Fails as advance() does. Cost: that of advance().
  template <class Further>
  Progress<Scalar> seat(const Sample<Scalar, Cap>& sample, const Further& further) {
    const Status turned = aim(sample);
    if (!turned) return {turned, Scalar(0), 0};
    for (const auto& jack : cables_.jacks)
      if (auto& goal = cables_.state.goal.jack[jack.cable][jack.end]; goal.locked)
        goal.extension -= static_cast<Real>(further(jack.cable, jack.end));
    return follow(default_budget);
  }
  /// From here on unknown `p` is the strain [-] that a cable takes on by itself, whose end is locked now:
  /// by warming, or as it relaxes, Eq. (38). Nobody knows which way, so none of its joints slides until
  /// adjust() puts it on the edge. `length` are those of all segments [m]. Fails with `mechanism`; then only
  /// start() may follow. Cost: that of one event.
  template <class Lengths>
  Status strain(int p, int cable, std::size_t end, const Lengths& length) {
    const auto& held = cables_.model->cables[cable];
    come_to_rest(held);
    cables_.derivatives.strain(p, held, length, 2 * cable + static_cast<int>(end));
    return make_map_anew();
  }
  /// The force of this jack, by its number, is `force` here: on the way that it has been on it had not come
  /// as far as it was taken to, and nothing has turned. Goes there on the present piece, and stays at its end
  /// if that comes first. Does nothing to a locked end, or before anything has moved. Cost: that of a test of
  /// all forces.
  void correct_load(int jack, Scalar force) {
    if (!has_or_makes_map() || cables_.input_of(jack) < 0) return;
    const auto& at = cables_.jacks[jack];
    cables_.state.goal.jack[at.cable][at.end].force = static_cast<Real>(force);
    EventPath<Cables, Level<CondensedType>>(cables_, level_).come_along_piece();
    samples_.refresh(cables_);
  }
  /// From here on the force of a jack depends on an unknown by another error. Cost: that of turn().
  void change_load_error(const JackError<Scalar>& error) {
    freeze_here();
    cables_.derivatives.depend_on_load(error);
    drop_map();
  }
  /// The same for an unknown that it did not depend on, of a jack that came here by itself.
  void begin_load_error(const JackError<Scalar>& error) {
    turn([&](int k) { return k == cables_.number[error.jack] ? error.parameter : -1; });
    cables_.derivatives.depend_on_load(error);
  }
  /// The force of the jack does not depend on unknown `p` any more, but friction has come to rest at what it
  /// was: which way the cables slide next is open. Fails with `mechanism`; then only start() may follow.
  /// Cost: that of one event.
  Status end_load_error(int p) {
    for (const auto& cable : cables_.model->cables) come_to_rest(cable);
    cables_.derivatives.depend_on_load({static_cast<std::int16_t>(p), -1, Scalar(0), Scalar(0)});
    return make_map_anew();
  }

 private:
  static constexpr bool is_adjustable = Cables::is_adjustable;

  static JointFriction<Real> as_condensed(int) { return {}; }
  template <class Friction, class Errors>
  void take(const Friction& friction, const Errors& errors) {
    begin_cables();
    depend_on_friction(cables_, level_, friction);
    if constexpr (is_adjustable && !std::is_same_v<Errors, NoLoadErrors>)
      for (const JackError<Scalar>& error : errors) cables_.derivatives.depend_on_load(error);
  }
  void drop_map() {
    cables_.drop_map();
    samples_.forget(cables_);
  }
  /// As before start(): of a state that is none nothing is kept.
  Status broken_state() {
    new (static_cast<void*>(&cables_)) Cables();
    new (static_cast<void*>(&samples_)) SamplePath<Cables>();
    return Status::at(Code::bad_sample, Place::none, -1);
  }

  // Defined outside of the class, so that a source with an `extern template` of it compiles none of them.

  void begin_cables();
  Progress<Scalar> bring_prestrain_on(int event_budget);
  Status take_over(const State& saved);
  Progress<Scalar> drive(const Sample<Scalar, Cap>& sample, int event_budget);
  Status aim(const Sample<Scalar, Cap>& sample);
  Progress<Scalar> follow(int event_budget);
  bool has_or_makes_map();
  Status make_map_anew();
  Status change_unknowns(const FixedArray<Scalar, Parameters>& by);
  void freeze_here();
  void come_to_rest(const CableLayout<Scalar>& cable);

  Level<CondensedType> level_;
};

template <class CondensedType, int Parameters>
void Tracker<CondensedType, Parameters>::begin_cables() {
  cables_.begin(level_.model());
}

template <class CondensedType, int Parameters>
auto Tracker<CondensedType, Parameters>::bring_prestrain_on(int event_budget) -> Progress<Scalar> {
  if (cables_.has_prestrain()) return follow(event_budget);
  cables_.state.now.prestrain = 1;
  cables_.state.arrived = true;
  samples_.refresh(cables_);
  return {};
}

/// After take(): goes on from what save() gave.
template <class CondensedType, int Parameters>
Status Tracker<CondensedType, Parameters>::take_over(const State& saved) {
  cables_.state = saved;
  if constexpr (is_adjustable) cables_.derivatives.set_frozen(saved);
  cables_.find_redundant_jack();
  if (!(saved.peak >= 0)) return broken_state();
  // The piece was begun at other loads than those reached.
  cables_.state.now = saved.built;
  if (saved.has_map) {
    Constraints<Cables> constraints(cables_);
    if (!constraints.set_up()) return broken_state();
    constraints.make_map();
    cables_.differentiate();
  }
  cables_.state.now = saved.now;
  if (saved.has_map)
    cables_.find_forces();
  else
    cables_.force = cables_.totals();
  samples_.refresh(cables_);
  samples_.restore(cables_, saved);
  for (int i = 0; i < cables_.model->segments; ++i)
    if (!std::isfinite(cables_.force[i]) || !std::isfinite(cables_.state.tension[i])) return broken_state();
  return Status::success();
}

/// Not in one frame with the samples that need no more than try_to_extend().
template <class CondensedType, int Parameters>
[[gnu::noinline]] auto Tracker<CondensedType, Parameters>::drive(const Sample<Scalar, Cap>& sample,
                                                                 int event_budget) -> Progress<Scalar> {
  if (samples_.follow(cables_, sample)) return {};
  const Status turned = aim(sample);
  return turned ? follow(event_budget) : Progress<Scalar>{turned, Scalar(0), 0};
}

template <class CondensedType, int Parameters>
Status Tracker<CondensedType, Parameters>::aim(const Sample<Scalar, Cap>& sample) {
  if (cables_.model == nullptr) return Status::at(Code::not_started, Place::none, -1);
  const Status usable = check_sample(*cables_.model, sample);
  if (!usable) return usable;
  samples_.forget(cables_);
  return turn_to(cables_, sample);
}

template <class CondensedType, int Parameters>
auto Tracker<CondensedType, Parameters>::follow(int event_budget) -> Progress<Scalar> {
  const auto progress = EventPath<Cables, Level<CondensedType>>(cables_, level_).follow(event_budget);
  samples_.refresh(cables_);
  return progress;
}

/// What changed in this row may have dropped the map; before anything has moved there is none.
template <class CondensedType, int Parameters>
bool Tracker<CondensedType, Parameters>::has_or_makes_map() {
  return cables_.state.has_map || make_map_anew().ok();
}

template <class CondensedType, int Parameters>
Status Tracker<CondensedType, Parameters>::make_map_anew() {
  const Status status = taut::make_map_anew(cables_);
  if (status) samples_.refresh(cables_);
  return status;
}

template <class CondensedType, int Parameters>
Status Tracker<CondensedType, Parameters>::change_unknowns(const FixedArray<Scalar, Parameters>& by) {
  const Status status = taut::change_unknowns(cables_, by);
  if (status) samples_.refresh(cables_);
  return status;
}

template <class CondensedType, int Parameters>
void Tracker<CondensedType, Parameters>::freeze_here() {
  taut::freeze_here(cables_);
}

template <class CondensedType, int Parameters>
void Tracker<CondensedType, Parameters>::come_to_rest(const CableLayout<Scalar>& cable) {
  taut::come_to_rest(cables_, cable);
}

}  // namespace taut
