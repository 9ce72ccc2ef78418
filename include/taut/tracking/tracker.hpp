// Follows the forces of a condensed scene from sample to sample, from event to event.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "taut/status.hpp"
#include "taut/tracking/level.hpp"
#include "taut/tracking/mode_decision.hpp"
#include "taut/tracking/sample_path.hpp"
#include "taut/tracking/tracked_forces.hpp"

namespace taut {

/// How far a call to Tracker came.
template <class Scalar>
struct [[nodiscard]] Progress {
  Status status;
  Scalar fraction = 1;  ///< of the path that was followed; below 1 the state is the equilibrium there
  int events = 0;       ///< places where the state of a joint or a span was decided anew
};

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
  using typename Base::Cables;
  using typename Base::Inputs;

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
    begin(condensed, friction, errors);
    if (cables_.has_prestrain()) return follow(event_budget);
    cables_.state.now.prestrain = 1;
    cables_.state.arrived = true;
    samples_.refresh(cables_);
    return {};
  }
  /// The scene that it was begun with.
  const CondensedType& condensed() const { return level_.source(); }
  /// The state, between two calls. Cost: a copy of it.
  State save() const {
    State saved;
    static_cast<typename Cables::State&>(saved) = cables_.state;
    if constexpr (is_adjustable)
      static_cast<typename Derivatives::Frozen&>(saved) = cables_.derivatives.frozen();
    level_.save(saved);
    return saved;
  }
  /// Goes on where save() was called on a tracker of the same scene, with the same bits. Fails with
  /// `bad_sample` if and only if the state is none of this scene, or was saved before start(); then only
  /// start() or another restore() may follow. Cost: that of one event.
  Status restore(const CondensedType& condensed, const State& saved) {
    return restore(condensed, as_condensed, saved);
  }
  /// Goes on with the friction, and the unknowns, that were used when the state was saved.
  template <class Friction, class Errors = NoLoadErrors>
  Status restore(const CondensedType& condensed, const Friction& friction, const State& saved,
                 const Errors& errors = {}) {
    const Status broken = Status::at(Code::bad_sample, Place::none, -1);
    // What was saved before start() has no prestrain to go to.
    const bool is_of_scene = level_.restore(condensed, saved) && saved.goal.prestrain == 1;
    take(friction, errors);
    if (!is_of_scene) return broken;
    cables_.state = saved;
    if constexpr (is_adjustable) cables_.derivatives.set_frozen(saved);
    cables_.find_redundant_jack();
    if (!(saved.peak >= 0)) return broken;
    // The piece was begun at other loads than those reached.
    cables_.state.now = saved.built;
    if (saved.has_map) {
      Constraints<Cables> constraints(cables_);
      if (!constraints.set_up()) return broken;
      constraints.make_map();
    }
    cables_.state.now = saved.now;
    if (saved.has_map)
      cables_.find_forces();
    else
      cables_.force = cables_.totals();
    samples_.refresh(cables_);
    samples_.restore(cables_, saved);
    for (int i = 0; i < cables_.model->segments; ++i)
      if (!std::isfinite(cables_.force[i]) || !std::isfinite(cables_.state.tension[i])) return broken;
    return Status::success();
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
  /// put on its edge. Fails with `mechanism` where joints on their edges leave a node free; then only stay()
  /// may follow. Cost: that of one event, and of one more for every joint on the edge.
  template <class Friction, class Changes>
  Status adjust(const Friction& friction, const Changes& change) {
    // What changed in this row may have dropped it; before anything has moved there is none.
    const bool has_map = cables_.state.has_map || make_map_anew();
    depend(friction);
    if (!has_map) return Status::success();
    cables_.freeze();
    const auto before = cables_.state;
    cables_.derivatives.for_each([&](const auto& derivative, int p) { shift(derivative, change[p]); });
    for (int count = 0; count <= cables_.joints(); ++count) {
      if (!make_map_anew()) {
        cables_.state = before;
        return cables_.at_joint(Code::mechanism, -1);
      }
      if (!put_on_edge()) break;
    }
    cables_.state.peak = largest(cables_.model->segments, &cables_.force[0], cables_.state.peak);
    samples_.refresh(cables_);
    return Status::success();
  }
  /// After adjust() failed, with the friction of before: goes on from where it was. Fails with `mechanism`;
  /// then only start() may follow. Cost: that of one event.
  template <class Friction>
  Status stay(const Friction& friction) {
    depend(friction);
    if (!make_map_anew()) return cables_.at_joint(Code::mechanism, -1);
    samples_.refresh(cables_);
    return Status::success();
  }
  /// From here on unknown `p` is an error [N] in the force at which this jack reverses now, or is locked:
  /// what friction remembers of it is carried along.
  void turn(int p, int cable, std::size_t end) {
    const int k = cables_.input_of(cable, end);
    if (k < 0) return;
    cables_.find_forces();
    cables_.freeze();
    cables_.derivatives.turn(cables_.map, p, k);
    cables_.drop_map();
    samples_.forget(cables_);
  }
  /// From here on unknown `p` is by how much further [m] the wedge of a locked end was drawn in than the
  /// model has it, now that it is seated. Cost: that of turn().
  void draw_in(int p, int cable, std::size_t end) {
    cables_.find_forces();
    cables_.freeze();
    cables_.derivatives.draw_in(p, 2 * cable + static_cast<int>(end));
    cables_.drop_map();
    samples_.forget(cables_);
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
    if (!make_map_anew()) return cables_.at_joint(Code::mechanism, -1);
    samples_.refresh(cables_);
    return Status::success();
  }
  /// From here on the force of a jack depends on an unknown by another error. Cost: that of turn().
  void change_load_error(const JackError<Scalar>& error) {
    cables_.find_forces();
    cables_.freeze();
    cables_.derivatives.depend_on_load(error);
    cables_.drop_map();
    samples_.forget(cables_);
  }
  /// The same for an unknown that meant something else until now, of a jack that came here by itself.
  void begin_load_error(const JackError<Scalar>& error) {
    turn(error.parameter, error.jack / 2, static_cast<std::size_t>(error.jack % 2));
    cables_.derivatives.depend_on_load(error);
  }
  /// The force of the jack does not depend on unknown `p` any more, but friction has come to rest at what it
  /// was: which way the cables slide next is open. Fails with `mechanism`; then only start() may follow.
  /// Cost: that of one event.
  Status end_load_error(int p) {
    for (const auto& cable : cables_.model->cables) come_to_rest(cable);
    cables_.derivatives.depend_on_load({static_cast<std::int16_t>(p), -1, Scalar(0), Scalar(0)});
    if (!make_map_anew()) return cables_.at_joint(Code::mechanism, -1);
    samples_.refresh(cables_);
    return Status::success();
  }
  /// Derivative of a tension with respect to unknown `p` [N], at the loads reached.
  Scalar sensitivity(int p, int segment) const {
    if (!cables_.state.has_map) return 0;
    return cables_.derivatives.tension(cables_.map, p, segment, samples_.at(), samples_.anchor());
  }
  /// How that changes with the force of an unlocked jack, on the present piece [-]. Jacks are counted as
  /// for_each_jacked_end() does.
  Scalar sensitivity_slope(int p, int jack, int segment) const {
    const int k = cables_.input_of(jack);
    return k < 0 ? Scalar(0) : cables_.derivatives.tension_slope(p, k, segment);
  }
  /// Derivative of a jack's extension with respect to unknown `p`.
  Scalar extension_sensitivity(int p, int cable, std::size_t end) const {
    return slip_sensitivity(p).extension[cable][end];
  }
  /// Derivatives of slip_state() with respect to unknown `p`.
  taut::SlipState<Scalar, Cap> slip_sensitivity(int p) const {
    if (!cables_.state.has_map) return {};
    Inputs x;
    cables_.values(cables_.state.now, x);
    return cables_.derivatives.slip_state(cables_.map, p, x);
  }

 private:
  static constexpr bool is_adjustable = Cables::is_adjustable;
  static constexpr Real epsilon = Cables::epsilon;
  using Ending = taut::Ending<Real>;
  using JackedEnd = typename Cables::JackedEnd;

  static JointFriction<Real> as_condensed(int) { return {}; }
  template <class Friction, class Errors = NoLoadErrors>
  void begin(const CondensedType& condensed, const Friction& friction, const Errors& errors = {}) {
    level_.begin(condensed);
    take(friction, errors);
  }
  template <class Friction, class Errors>
  void take(const Friction& friction, const Errors& errors) {
    cables_.begin(level_.model());
    depend(friction);
    if constexpr (is_adjustable && !std::is_same_v<Errors, NoLoadErrors>)
      for (const JackError<Scalar>& error : errors) cables_.derivatives.depend_on_load(error);
  }
  template <class Friction>
  void depend(const Friction& friction) {
    if constexpr (is_adjustable)
      for (int j = 0; j < cables_.joints(); ++j) {
        if (cables_.model->is_self_locking(j)) continue;
        const JointFriction<Real> given = level_.leant(j, friction(j));
        if (given.parameter < 0) continue;
        cables_.laws.set_rho(j, given.rho);
        cables_.derivatives.depend(j, given.parameter, given.slope);
      }
    else
      static_cast<void>(friction);
  }
  /// The forces have come to where another level begins: the model follows, and all forces are found anew
  /// from totals. Where there are none, all is as before.
  Status come_to_level(ModeDecision<Cables>& modes) {
    cables_.freeze();
    Real sum = 0;
    for (int i = 0; i < cables_.model->segments; ++i) sum += cables_.force[i];
    level_.come_to(sum, cables_.state.now, cables_.elongations_by(cables_.state.moved));
    take_level();
    const Status status = modes.find_again();
    if (!status) {
      level_.go_back();
      take_level();
    }
    return status;
  }
  void take_level() {
    cables_.take_model();
    if constexpr (is_adjustable)
      for (int j = 0; j < cables_.joints(); ++j) {
        if (!cables_.derivatives.depends(j)) {
          cables_.laws.set_rho(j, cables_.model->rho[j]);
          continue;
        }
        const Real before = cables_.laws.rho(j);
        cables_.laws.set_rho(j, Model::scaled(before, level_.growth(j)));
        const Real ratio = (1 + kappa_of(before)) / (1 + kappa_of(cables_.laws.rho(j)));
        cables_.derivatives.scale(j, level_.growth(j) * ratio * ratio);
      }
  }

  /// Not in one frame with the samples that need no more than try_to_extend().
  [[gnu::noinline]] Progress<Scalar> drive(const Sample<Scalar, Cap>& sample, int event_budget) {
    if (samples_.follow(cables_, sample)) return {};
    if (cables_.model == nullptr) return {Status::at(Code::not_started, Place::none, -1), Scalar(0), 0};
    const Status usable = check_sample(*cables_.model, sample);
    if (!usable) return {usable, Scalar(0), 0};
    samples_.forget(cables_);
    set_goal(sample);
    for (const JackedEnd& jack : cables_.jacks)
      if (cables_.is_redundant(jack.cable, jack.end) && !cables_.redundant_agrees(jack.cable))
        return {Status::at(Code::pulled_through, Place::cable, jack.cable), Scalar(0), 0};
    for (int i = 0; i < cables_.model->loads; ++i) {
      if (cables_.state.has_load[i] || cables_.state.goal.factor[i] == cables_.state.now.factor[i]) continue;
      cables_.find_forces();
      cables_.freeze();
      cables_.drop_map();
    }
    return follow(event_budget);
  }

  // From event to event.

  Progress<Scalar> follow(int event_budget) {
    Progress<Scalar> progress;
    cables_.find_forces();
    Real rest = 1;  // of the path
    Ending ending;
    int stalled = 0;
    ModeDecision<Cables> modes(cables_);
    for (;;) {
      cables_.measure_path();
      progress.status = modes.decide(ending);
      if constexpr (is_adjustable) cables_.derivatives.pass();
      if (!progress.status) break;
      bool done = false;
      if (modes.further() == 0) {
        cables_.find_forces();
        const Status broken = follow_piece(ending, rest, done);
        if constexpr (Model::has_level)
          if (broken.ok() && ending.ends_level) {
            progress.status = come_to_level(modes);
            if (!progress.status) break;
            ending = {};
          }
        stalled = ending.step > 0 ? 0 : stalled + 1;
        if (!broken || stalled > 8 + 4 * cables_.joints()) {
          const int joint = ending.next.joint;
          progress.status =
              modes.find_further_on(broken ? cables_.at_joint(Code::state_iterations, joint) : broken);
          if (!progress.status) break;
        }
      }
      if (modes.further() > 0) {
        rest *= Real(1) - modes.further();
        ending = {};
        stalled = 0;
      }
      if (done || ++progress.events >= event_budget) break;
    }
    progress.fraction = static_cast<Scalar>(Real(1) - rest);
    // Rounding must not say that a path came to its end which did not.
    if (rest > 0 && progress.fraction >= Scalar(1))
      progress.fraction = Scalar(1) - std::numeric_limits<Scalar>::epsilon();
    cables_.state.arrived = progress.status.ok() && rest == 0;
    samples_.refresh(cables_);
    return progress;
  }
  /// Goes along the present piece to its end. If the forces there break a law, the state is the one before.
  Status follow_piece(Ending& ending, Real& rest, bool& done) {
    EventSearch<Cables> events(cables_);
    Inputs dx, x;
    cables_.directions(dx);
    const Real step = events.next(dx, ending);  // of what is left of the path
    done = Real(1) - step <= Real(4) * epsilon ||
           (Real(1) - step) * events.change(dx) <= cables_.held(ending.next) * cables_.force_tolerance();
    const Loads before = cables_.state.now;
    cables_.state.now = Loads::between(cables_.state.now, cables_.state.goal, done ? Real(1) : step);
    cables_.find_forces();
    const Status status = events.check_forces();
    if (!status) {
      cables_.state.now = before;
      cables_.find_forces();
      done = false;
      return status;
    }
    ending.has_total = true;
    rest = done ? Real(0) : rest * (Real(1) - step);
    cables_.state.peak = largest(cables_.model->segments, &cables_.force[0], cables_.state.peak);
    cables_.state.last = dx;
    cables_.values(cables_.state.now, x);
    if constexpr (is_adjustable)
      if (!done) events.find_saltation(ending, x);
    return status;
  }

  // From sample to path.

  /// Sets the goal; where a lock changes, also the present drive at the state reached.
  void set_goal(const Sample<Scalar, Cap>& sample) {
    bool changes = false;
    for (const JackedEnd& jack : cables_.jacks)
      changes = changes || sample.jack[jack.cable][jack.end].locked !=
                               cables_.state.goal.jack[jack.cable][jack.end].locked;
    if (changes) {
      cables_.freeze();
      cables_.find_forces();
    }
    const auto force = [this](int c, std::size_t end) {
      return cables_.force[cables_.model->cables[c].end_segment(end)];
    };
    const auto extension = [this](int c, std::size_t end) { return cables_.state.moved.extension[c][end]; };
    set_path(cables_.model->cables, cables_.model->loads, sample, force, extension, cables_.state.now,
             cables_.state.goal);
    if (!changes) return;
    for (const JackedEnd& jack : cables_.jacks)
      cables_.state.now.jack[jack.cable][jack.end].locked =
          cables_.state.goal.jack[jack.cable][jack.end].locked;
    cables_.find_redundant_jack();
    // A jack that takes hold of a slack span draws it straight; its extension follows from its force.
    for (int r = 0; r < cables_.spans.size(); ++r)
      if (cables_.state.slack[r] && cables_.is_jacked(cables_.spans[r])) draw_straight(r);
    cables_.drop_set();
  }
  template <class Derivative>
  void shift(const Derivative& derivative, Scalar change) {
    const auto by = static_cast<Real>(change);
    for (int j = 0; j < cables_.joints(); ++j)
      cables_.state.moved.slip[j] += by * static_cast<Real>(derivative.slip[j]);
    for (int r = 0; r < cables_.spans.size(); ++r)
      cables_.state.moved.slack_length[r] = larger(
          Real(0), cables_.state.moved.slack_length[r] + by * static_cast<Real>(derivative.slack_length[r]));
    for (const JackedEnd& jack : cables_.jacks) {
      const Real more = by * static_cast<Real>(derivative.extension[jack.cable][jack.end]);
      cables_.state.moved.extension[jack.cable][jack.end] += more;
      if (!cables_.state.goal.jack[jack.cable][jack.end].locked) continue;
      for (Loads* loads : {&cables_.state.now, &cables_.state.goal, &cables_.state.built})
        loads->jack[jack.cable][jack.end].extension += more;
    }
  }
  /// Whether any joint had to be.
  /// No joint of a cable slides from here on.
  void come_to_rest(const CableLayout<Scalar>& cable) {
    cables_.find_forces();
    cables_.freeze();
    cables_.drop_map();
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
      if (cables_.can_slide(j)) cables_.stop(j);
  }
  /// Other joints slide from here on, or slips have changed: the forces follow.
  bool make_map_anew() {
    cables_.drop_set();
    Constraints<Cables> constraints(cables_);
    if (!constraints.set_up()) return false;
    constraints.make_map();
    cables_.find_forces();
    return true;
  }
  bool put_on_edge() {
    bool any = false;
    for (int j = 0; j < cables_.joints(); ++j) {
      if (cables_.state.slides[j] != JointState::stick || !cables_.can_slide(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward})
        if (cables_.laws.limit(SlipMode::of(j, way)).of(cables_.force) < -cables_.force_tolerance()) {
          cables_.state.slides[j] = way;
          cables_.state.order.add(static_cast<std::int16_t>(j));
          any = true;
        }
    }
    return any;
  }
  /// What a slack span has too much goes out through the jack: over every joint, if that is at its far end.
  void draw_straight(int r) {
    const typename Cables::Span& span = cables_.spans[r];
    const auto& cable = cables_.model->cables[span.cable];
    const bool at_start = span.segment(0) == cable.end_segment(0) && cable.ends[0] == End::jacked &&
                          !cables_.state.goal.jack[span.cable][0].locked;
    cables_.state.slack[r] = false;
    const auto straighten = [&](auto& moved) {
      for (int i = 0; !at_start && i < span.joints(); ++i) moved.slip[span.joint(i)] += moved.slack_length[r];
      moved.slack_length[r] = 0;
    };
    straighten(cables_.state.moved);
    if constexpr (is_adjustable) cables_.derivatives.for_each([&](auto& moved, int) { straighten(moved); });
  }

  Level<CondensedType> level_;
  SamplePath<Cables> samples_;
};

}  // namespace taut
