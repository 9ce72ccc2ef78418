// From modes to constraints: which tension every active variable keeps, and the affine map of the piece.
#pragma once

#include "taut/tracking/cable_system.hpp"

namespace taut {

/// Puts the active variables of the present modes at work, Eq. (9): a joint that slides keeps T_small = rho
/// T_big, an unlocked jack its force, a slack span no tension. Then makes the affine map of the piece from
/// totals, Eqs. (12) and (14).
template <class Cables>
class Constraints {
 public:
  using Real = typename Cables::Real;
  using Cap = typename Cables::Cap;
  using Laws = typename Cables::Laws;
  using Map = typename Cables::Map;
  using Set = typename Map::Set;
  using State = typename Cables::State;
  using Tensions = typename Cables::Tensions;
  using Inputs = typename Cables::Inputs;
  using JackedEnd = typename Cables::JackedEnd;

  explicit Constraints(Cables& cables)
      : cables_(cables),
        model_(*cables.model),
        spans_(cables.spans),
        laws_(cables.laws),
        state_(cables.state),
        map_(cables.map) {}

  /// Puts the slips of the present states at work, in their order. Where laws imply one another, a node is
  /// held by its cables alone; weak springs then choose among its places, and forces do not depend on them.
  bool set_up() {
    joint_without_pivot_ = -1;
    cables_.is_set_up = add_all(Real(0)) || add_all(held_at_zero);
    return cables_.is_set_up;
  }
  /// After set_up(): the first joint that nothing holds any more as it slides, after those before it in the
  /// order; -1 if there is none.
  int joint_without_pivot() const { return joint_without_pivot_; }
  /// Puts the active variables at work only if every pivot keeps digits: a guess is not worth less.
  bool set_up_soundly() {
    cables_.is_set_up = add_all(Real(0), Set::small);
    return cables_.is_set_up;
  }
  /// Only what follows whatever happens, to decide all else from nothing. False if its laws contradict.
  bool set_up_equalities() {
    map_.clear();
    map_.set().hold(held_at_zero);
    cables_.is_set_up = false;
    return add_equalities();
  }
  /// Only jacks, and spans that rest: what others then have no choice in. False if its laws contradict.
  bool set_up_rest() {
    map_.clear();
    map_.set().hold(Real(0));
    cables_.is_set_up = false;
    return add_jacks_and_rest();
  }
  /// Whether the tension of a segment depends on its length while all at work follows.
  bool depends(int segment) {
    // Where statics give its force, no length does.
    if (!(model_.coupling(segment, segment) > 0)) return false;
    const int size = map_.active();
    const auto on = static_cast<std::int16_t>(segment);
    const bool has_pivot =
        map_.set().append(laws_, {SlipVariable::of(SlipVariable::Kind::slack_length, 0, segment), on, 0, -1});
    map_.set().truncate(size);
    return has_pivot;
  }
  /// Of a slack span, whose tensions are zero, the slips follow and its slack length: add_slack_length(). A
  /// ring keeps the slip of one joint: it may turn freely. False if other laws say some of that already.
  bool add_slack_slips(int r) {
    const typename Cables::Span& span = spans_[r];
    bool all = true;
    for (int i = 0; i + 1 < span.count; ++i)
      all = map_.set().append(
                laws_, {laws_.slip(span.joint(i)), static_cast<std::int16_t>(span.segment(i)), 0, -1}) &&
            all;
    return all;
  }
  bool add_slack_length(int r) {
    const typename Cables::Span& span = spans_[r];
    return map_.set().append(laws_, {SlipVariable::of(SlipVariable::Kind::slack_length, r, span.segment(0)),
                                     static_cast<std::int16_t>(span.segment(span.count - 1)), 0, -1});
  }
  /// Where another law says the same already, there is nothing to add.
  void add_gliding() {
    for (int j = 0; j < cables_.joints(); ++j)
      if (cables_.glides(j) && cables_.can_slide(j))
        static_cast<void>(map_.set().append(laws_, laws_.gliding(j)));
  }
  /// Whether the laws that imply one another agree; if not, a node is free.
  bool is_held(bool totally) const {
    if (!map_.is_held()) return true;
    if (totally) return !(map_.law_violation(laws_, map_.base(), map_.anchor()) > Real(1e-9) * state_.peak);
    Inputs dx;
    cables_.directions(dx);
    Tensions rate;
    map_.tension_rates(dx, rate);
    return !(map_.law_violation(laws_, rate, dx) > Real(1e-9) * larger(cables_.push, state_.peak));
  }
  /// Makes the map of the slips at work from totals, without CableSystem::differentiate(); they must be
  /// frozen at the present state. `has_total`: the totals were made there by the last test of forces.
  void rebuild(bool has_total = false) {
    for (int i = 0; i < model_.loads; ++i) state_.has_load[i] = state_.now.factor[i] != state_.goal.factor[i];
    make_map(has_total);
  }
  void make_map(bool has_total = false) {
    map_.clear_inputs();
    for (const JackedEnd& jack : cables_.jacks) add_jack_input(jack.cable, jack.end);
    for (int i = 0; i < model_.loads; ++i)
      if (state_.has_load[i]) map_.add_input(Input::Kind::load, i);
    if (Cap::prestrain && state_.now.prestrain != state_.goal.prestrain)
      map_.add_input(Input::Kind::prestrain, 0);
    typename Map::Values values;
    for (int i = 0; i < map_.active(); ++i) values[i] = state_.moved.of(map_.variable(i));
    Inputs x;
    cables_.values(state_.now, x);
    if (!has_total) cables_.total = cables_.totals();
    map_.make(laws_, cables_.total, values, x);
    if constexpr (Cables::is_adjustable) cables_.derivatives.drop();
    state_.has_map = true;
    cables_.find_shifts();
    state_.built = state_.now;
  }

 private:
  /// Of a segment's own stiffness, in decisions from zero tension: the springs that make them well posed.
  static constexpr Real held_at_zero = Real(1e-8);

  bool add_all(Real held, Real least = Set::singular) {
    map_.clear();
    map_.set().hold(held);
    return add_equalities() && add_slides(least);
  }
  /// What follows whatever happens: jacks, spans without tension, joints without friction.
  bool add_equalities() {
    if (!add_jacks_and_rest()) return false;
    for (int r = 0; r < spans_.size(); ++r)
      if (state_.slack[r] && !(add_slack_slips(r) && add_slack_length(r))) return false;
    add_gliding();
    return true;
  }
  bool add_jacks_and_rest() {
    for (const JackedEnd& jack : cables_.jacks)
      if (!add_jack(jack.cable, jack.end)) return false;
    for (int r = 0; r < spans_.size(); ++r)
      if (state_.rests[r] && !add_resting_span(r)) return false;
    return true;
  }
  bool add_slides(Real least) {
    for (const int j : state_.order)
      if (!map_.set().append(laws_, laws_.sliding(SlipMode::of(j, state_.slides[j])), least)) {
        if (joint_without_pivot_ < 0) joint_without_pivot_ = j;
        return false;
      }
    return true;
  }
  bool add_jack(int c, std::size_t end) {
    if (state_.goal.jack[c][end].locked || cables_.is_redundant(c, end)) return true;
    const auto on = static_cast<std::int16_t>(model_.cables[c].end_segment(end));
    return map_.set().append(laws_,
                             {Map::extension_variable(model_, 2 * c + static_cast<int>(end)), on, 0, -1});
  }
  void add_jack_input(int c, std::size_t end) {
    const int index = 2 * c + static_cast<int>(end);
    const auto& start = state_.now.jack[c][end];
    const auto& goal = state_.goal.jack[c][end];
    if (!goal.locked && !cables_.is_redundant(c, end)) map_.add_input(Input::Kind::jack_force, index);
    if (goal.locked && start.extension != goal.extension) map_.add_input(Input::Kind::extension, index);
  }
  /// Its jacks keep the end segments at zero, its slips all others. Between two jacks the cable may move as a
  /// whole; one joint keeps its place. Without a jack other laws say some of that already, or all.
  bool add_resting_span(int r) {
    const typename Cables::Span& span = spans_[r];
    bool at_start = false, at_end = false;
    for (const JackedEnd& jack : cables_.jacks) {
      at_start = at_start || (cables_.pulls(jack, span) && jack.end == 0);
      at_end = at_end || (cables_.pulls(jack, span) && jack.end == 1);
    }
    const bool at_both = max_jacks<Cap> >= 2 && at_start && at_end, at_none = !at_start && !at_end;
    for (int i = at_both ? 1 : 0; i < span.joints(); ++i)
      if (!map_.set().append(laws_, {laws_.slip(span.joint(i)),
                                     static_cast<std::int16_t>(span.segment(at_end ? i : i + 1)), 0, -1}) &&
          !at_none)
        return false;
    return true;
  }

  Cables& cables_;
  const typename Cables::Model& model_;
  const SlidingSpans<Cap>& spans_;
  const Laws& laws_;
  State& state_;
  Map& map_;
  int joint_without_pivot_ = -1;
};

}  // namespace taut
