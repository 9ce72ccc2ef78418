// Every decision of stick, slip and slack: which problem is solved, and what its solution means.
#pragma once

#include "taut/tracking/constraints.hpp"
#include "taut/tracking/event.hpp"
#include "taut/tracking/mode_solver.hpp"
#include "taut/tracking/resting_spans.hpp"
#include "taut/tracking/route.hpp"

namespace taut {

/// Decides the modes of all joints and spans for the next piece of the path, and makes its map.
///
/// An ordinary event goes on from the modes of the piece before: one pivot of ModeSolver. Spans at
/// zero tension are tried pulled straight toward their jacks, then decided from nothing, Eqs. (10) and (11),
/// with one covering vector after the other; those that nothing acts on are left as they are. Where rates
/// contradict, all forces are found a little further on, from the modes of the piece before or from nothing,
/// and taken if they are near. Where nothing is, the reason is returned.
template <class Cables>
class ModeDecision {
 public:
  using Real = typename Cables::Real;
  using Cap = typename Cables::Cap;
  using Loads = typename Cables::Loads;
  using Span = typename Cables::Span;
  using Laws = typename Cables::Laws;
  using Map = typename Cables::Map;
  using State = typename Cables::State;
  using Modes = typename State::Modes;
  using Tensions = typename Cables::Tensions;
  using Inputs = typename Cables::Inputs;
  using JackedEnd = typename Cables::JackedEnd;
  static constexpr Real epsilon = Cables::epsilon, tolerance = Cables::tolerance;
  using Ending = taut::Ending<Real>;

  explicit ModeDecision(Cables& cables)
      : cables_(cables),
        model_(*cables.model),
        spans_(cables.spans),
        laws_(cables.laws),
        state_(cables.state),
        map_(cables.map),
        constraints_(cables),
        resting_(cables, constraints_),
        events_(cables) {}

  /// Decides what sticks, slides and is slack from here on, and makes the map for it. `ending` is what ended
  /// the piece before.
  Status decide(const Ending& ending) {
    if (further_ == 0) stride_ = 1;
    further_ = 0;
    free_joint_ = doubtful_joint_ = -1;
    find_representatives();
    find_resting();
    Spans zero;
    const bool any_zero = find_zero(ending, zero);
    const SlipModes modes = at_limit(ending.next, zero);
    if (!any_zero) {
      // Most often all goes on as it was.
      if (state_.has_map && ending.next.joint < 0 && is_consistent(modes)) return decided(Route::as_before);
      const bool is_mapped = state_.has_map && !map_.is_held();
      cables_.freeze();
      cables_.drop_map();
      if ((cables_.is_set_up || constraints_.set_up()) && go_on(modes, nullptr, is_mapped)) {
        constraints_.rebuild(ending.has_total);
        return decided(Route::from_before);
      }
    } else {
      cables_.freeze();
    }
    cables_.drop_map();
    return begin_anew(zero, modes);
  }
  /// Rates do not tell how it goes on. All forces, at loads a little further on, are a problem that always
  /// has an answer: it is taken if it is near. If not, friction gives way here, and the structure would jump.
  /// Steps that follow each other grow eightfold, and shrink as much where they find no answer: from half of
  /// what is left of the path to `small_step`, where it ends.
  Status find_further_on(Status why) {
    cables_.freeze();
    cables_.drop_map();
    for (;;) {
      const bool least = stride_ <= Real(1);
      const Status status = try_further_on(why);
      if (status || least) Cap::Watch::took(status ? Route::further_on : Route::refused);
      stride_ = status ? stride_ * Real(8) : larger(Real(1), stride_ / Real(8));
      if (status) return status;
      if (least) break;
    }
    // Without friction, two jacks that differ leave a singular map, and no problem that has no answer.
    const Status pulled = events_.pulled_through();
    return pulled ? why : pulled;
  }
  /// After the model has changed under the same loads, with all slips frozen: finds all forces anew, near
  /// those of before.
  Status find_again() {
    free_joint_ = doubtful_joint_ = far_joint_ = -1;
    cables_.drop_map();
    // Just before there was an answer: no node is free.
    const Status status = find_near(cables_.at_joint(Code::gives_way, -1), near_level);
    return status ? status
                  : cables_.at_joint(Code::gives_way, doubtful_joint_ >= 0 ? doubtful_joint_ : far_joint_);
  }
  /// After decide() or find_further_on(): how far all forces were found anew, as a part of what was left of
  /// the path; 0 if the modes were decided where the piece before ended.
  Real further() const { return further_; }

 private:
  static Status decided(Route route) {
    Cap::Watch::took(route);
    return Status::success();
  }

  using Solver = ModeSolver<typename Cables::Model, Laws>;
  using Lengths = typename RestingSpans<Cables>::Lengths;
  using SlipModes = FixedList<SlipMode, 2 * Cap::joints>;
  using Spans = FixedArray<bool, max_spans<Cap>>;
  /// Of the largest force: how much further on an answer is looked for, and how near it must be.
  static constexpr Real small_step = Real(1e-6), nearby = Real(1e-3);
  /// Of the largest force: how much a step of the level may change forces.
  static constexpr Real near_level = Real(0.05);
  /// Of rates, before all forces are looked for further on.
  static constexpr int covering_vectors = 4;

  struct Pull {
    const JackedEnd* jack = nullptr;
    Real least = 0;
    bool is_direct = false;  // no joint on the way has friction
  };

  /// The segment with the largest tension stands for its span: behind many joints near to self-locking the
  /// others are rounding.
  void find_representatives() {
    for (int r = 0; r < spans_.size(); ++r) {
      int most = spans_[r].segment(0);
      for (int i = 1; i < spans_[r].count; ++i)
        if (cables_.force[spans_[r].segment(i)] > cables_.force[most]) most = spans_[r].segment(i);
      state_.representative[r] = static_cast<std::int16_t>(most);
    }
  }
  /// Spans that have no tension whatever their length: nothing is decided there.
  void find_resting() {
    resting_.find_jacked();
    if (!resting_.is_open()) return;
    cables_.freeze();
    find_idle(false);
  }
  /// find_idle() where no slack length grows.
  void find_idle(bool totally) {
    Lengths none;
    none.fill(Real(0));
    find_idle(none, totally);
  }
  [[gnu::noinline]] void find_idle(const Lengths& growth, bool totally) {
    if constexpr (RestingSpans<Cables>::may_depend) {
      if (!resting_.may_any_depend()) return;
      Tensions stuck;
      find_stuck(totally, stuck);
      resting_.find_idle(
          stuck, [&](typename Map::Values& due) { dues(totally, due); }, growth, totally);
    }
  }
  /// Spans that are wholly at zero, where what follows is decided from nothing.
  bool find_zero(const Ending& ending, Spans& zero) const {
    bool any = false;
    for (int r = 0; r < spans_.size(); ++r) {
      zero[r] = !state_.rests[r] && is_at_zero(r, ending);
      any = any || zero[r];
    }
    return any && leave_out_of_reach(zero);
  }
  /// Takes out of `zero` what stays at zero whatever others do: because of it, others that are under tension
  /// would be decided from nothing too. Whether any is left.
  [[gnu::noinline]] bool leave_out_of_reach(Spans& zero) const {
    if constexpr (is_one_span<Cap>) return true;
    Tensions stuck;
    cables_.stuck_rates(stuck);
    bool any = false;
    for (int r = 0; r < spans_.size(); ++r) {
      zero[r] = zero[r] && !is_out_of_reach(r, stuck);
      any = any || zero[r];
    }
    return any;
  }
  /// Whether nothing acts on a span on this path: no jack, no rate of tension with every joint stuck, no
  /// stiffness that it shares with another.
  bool is_out_of_reach(int r, const Tensions& stuck) const {
    if (cables_.is_jacked(spans_[r])) return false;
    bool is = true;
    for (int i = 0; i < model_.segments; ++i) {
      if (spans_.of(i) == r) {
        is = is && stuck[i] == 0;
        continue;
      }
      for (int k = 0; k < spans_[r].count; ++k) is = is && model_.coupling(i, spans_[r].segment(k)) == 0;
    }
    return is;
  }
  bool is_at_zero(int r, const Ending& ending) const {
    if (!state_.slack[r]) return cables_.force[state_.representative[r]] <= cables_.force_tolerance();
    const bool closes = ending.slack >= 0 && ending.span == r;
    return closes || slack_length(r) * model_.coupling(spans_[r].segment(0), spans_[r].segment(0)) <=
                         cables_.force_tolerance();
  }
  Real slack_length(int r) const {
    if (!state_.has_map) return state_.moved.slack_length[r];
    Inputs x;
    cables_.values(state_.now, x);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.variable(i).kind == SlipVariable::Kind::slack_length && map_.variable(i).index == r)
        return map_.value(i, x);
    return 0;
  }
  /// Whether the rates under the present map agree with its states: v >= 0 where it slides, w >= 0 at the
  /// other limits.
  bool is_consistent(const SlipModes& modes) const {
    Inputs dx;
    cables_.directions(dx);
    if (!map_.goes_on(dx, cables_.rate_tolerance())) return false;
    Tensions rate;
    map_.tension_rates(dx, rate);
    const Real least = -cables_.rate_tolerance();
    for (const SlipMode& mode : modes)
      if (state_.slides[mode.joint] != mode.way && laws_.limit(mode).of(rate) < least) return false;
    return true;
  }
  /// Limits that hold: those of joints that slide, the one just reached, and what is as near as rounding. Of
  /// a joint under tension only the nearer one; where a span is at zero, both.
  SlipModes at_limit(const SlipMode& next, const Spans& zero) const {
    SlipModes modes;
    for (int j = 0; j < cables_.joints(); ++j) {
      if (model_.is_self_locking(j) || cables_.glides(j)) continue;
      const auto& sides = laws_.sides(j);
      const int span = spans_.of(sides[0]);
      if (!zero[span] && !cables_.can_slide(j)) continue;
      const SlipMode ahead = SlipMode::of(j, JointState::forward),
                     back = SlipMode::of(j, JointState::backward);
      if (zero[span]) {
        modes.add(ahead);
        modes.add(back);
        continue;
      }
      if (state_.slides[j] != JointState::stick) {
        modes.add(state_.slides[j] == JointState::forward ? ahead : back);
        continue;
      }
      const Real to_forward = laws_.limit(ahead).of(cables_.force),
                 to_backward = laws_.limit(back).of(cables_.force);
      const Real near = tolerance * larger(cables_.force[sides[0]], cables_.force[sides[1]]) +
                        epsilon * Real(64) * state_.peak;
      const SlipMode& nearer = to_forward <= to_backward ? ahead : back;
      if (next.joint == j)
        modes.add(next);
      else if (laws_.rho(j) < 1 ? (nearer.way == JointState::forward ? to_forward : to_backward) <= near
                                : true)
        modes.add(nearer);
      if (!(laws_.rho(j) < 1)) modes.add(nearer.way == JointState::forward ? back : ahead);
    }
    return modes;
  }

  // Going on from the piece before.

  /// Rates of tension with every joint stuck, or all tensions with what has moved.
  void find_stuck(bool totally, Tensions& stuck) const {
    if (totally)
      stuck = cables_.totals();
    else
      cables_.stuck_rates(stuck);
  }
  /// Rates, or forces, below that are zero.
  Real nothing(bool totally) const {
    return totally ? Real(16) * epsilon * state_.peak : cables_.rate_tolerance();
  }
  /// What a jacked end is to have: the rate of its force, or all of it.
  Real due_at(const JackedEnd& jack, bool totally) const {
    const Real now = state_.now.jack[jack.cable][jack.end].force;
    return totally ? now : state_.goal.jack[jack.cable][jack.end].force - now;
  }
  void dues(bool totally, typename Map::Values& due) const {
    due.fill(Real(0));
    for (int i = 0; i < map_.active(); ++i) {
      const SlipVariable& variable = map_.variable(i);
      if (variable.kind == SlipVariable::Kind::extension)
        due[i] = due_at(cables_.jacks[cables_.number[variable.index]], totally);
    }
  }
  /// Begins the path from rates, or from all forces. `is_mapped`: the map is that of the set, and gives its
  /// rates. What is due is kept no longer: on the path itself the stack is deepest.
  [[gnu::noinline]] typename Solver::Outcome begin_path(Solver& solver, bool totally, bool goes_on,
                                                        bool is_mapped) const {
    typename Map::Values due;
    dues(totally, due);
    return solver.begin_path(
        due, nothing(totally), goes_on, [&](Tensions& T) { find_stuck(totally, T); },
        [&](Tensions& T, typename Map::Values& values) {
          if (!is_mapped) return false;
          Inputs dx;
          cables_.directions(dx);
          map_.tension_rates(dx, T);
          for (int i = 0; i < map_.active(); ++i) values[i] = map_.value_rate(i, dx);
          return true;
        });
  }
  /// Whether the path ends in a solution; if not, it is noted where it ended.
  bool solve(Solver& solver, bool totally, bool goes_on, bool is_mapped = false) {
    auto outcome = begin_path(solver, totally, goes_on, is_mapped);
    if (outcome == Solver::Outcome::pivots) outcome = solver.follow_path();
    if (outcome == Solver::Outcome::solved) return true;
    remember_last(solver);
    return false;
  }
  /// What slides, begun from what slid, from rates: an ordinary event is one pivot. Segments of the spans in
  /// `tightening` must then gain tension.
  [[gnu::noinline]] bool go_on(const SlipModes& modes, const Spans* tightening, bool is_mapped = false) {
    Solver solver;
    solver.begin(model_, laws_, map_.set());
    for (const SlipMode& each : modes) solver.add_slip(each);
    if (!solve(solver, false, true, is_mapped)) {
      cables_.drop_set();
      return false;
    }
    for (int i = 0; tightening != nullptr && i < model_.segments; ++i)
      if ((*tightening)[spans_.of(i)] && !(solver.rates()[i] > Real(16) * cables_.rate_tolerance()))
        return false;
    read_slides();
    return true;
  }
  /// Where no rate was found: a joint that its node would follow freely, and the last one that was tried.
  void remember_last(const Solver& solver) {
    const int p = solver.last_pair();
    if (p < 0 || solver.pairs()[p].is_segment()) return;
    doubtful_joint_ = solver.pairs()[p].index;
    if (solver.is_free()) free_joint_ = doubtful_joint_;
  }
  /// The slips of the set, in its order.
  void read_slides() {
    state_.slides.fill(JointState::stick);
    state_.order.clear();
    for (int i = 0; i < map_.active(); ++i) {
      const ActiveConstraint& active = map_.actives()[i];
      if (!active.slides() || active.sense == 0) continue;
      state_.slides[active.variable.index] = active.sense > 0 ? JointState::forward : JointState::backward;
      state_.order.add(active.variable.index);
    }
  }

  // From nothing.

  /// What slides and what is slack, begun from nothing. The slips must be frozen.
  Status begin_anew(const Spans& zero, const SlipModes& modes) {
    // A strut that only friction holds sideways has two answers; the one from which it does not run away
    // sticks.
    if constexpr (Cables::Model::has_level)
      if (pull_straight(zero, modes, false)) return decided(Route::pulled_straight);
    if (pull_straight(zero, modes, true)) return decided(Route::pulled_straight);
    for (int covering = 0; covering < covering_vectors; ++covering)
      if (solve_anew(zero, modes, false, covering)) return decided(Route::from_nothing);
    if (const Status why = events_.pulled_through(); !why) {
      Cap::Watch::took(Route::refused);
      return why;
    }
    if (free_joint_ >= 0) return find_further_on(cables_.at_joint(Code::mechanism, free_joint_));
    return find_further_on(doubtful_joint_ >= 0 ? cables_.at_joint(Code::gives_way, doubtful_joint_)
                                                : events_.free_node());
  }
  /// Where spans at zero become taut, most often every joint slides toward the jack, or none does. Tried
  /// first: Lemke's path goes on from there, and the answer is taken if it gives every segment of these spans
  /// tension.
  [[gnu::noinline]] bool pull_straight(const Spans& zero, const SlipModes& modes, bool slides) {
    const Modes before = state_;
    for (int r = 0; r < spans_.size(); ++r) {
      if (!zero[r]) continue;
      state_.slack[r] = false;
      state_.moved.slack_length[r] = 0;
      if (slides) slide_toward_jacks(r);
    }
    cables_.drop_set();
    if (constraints_.set_up_soundly() && go_on(modes, &zero)) {
      constraints_.rebuild();
      return true;
    }
    static_cast<Modes&>(state_) = before;
    free_joint_ = doubtful_joint_ = -1;
    cables_.drop_set();
    return false;
  }
  void slide_toward_jacks(int r) {
    FixedArray<const JackedEnd*, Cap::segments> toward;
    for (int i = 0; i < spans_[r].count; ++i) toward[i] = pull_on(spans_[r], i, false).jack;
    // From the jacks outward: the joints that leave first are the last of the set, and little is made anew.
    for (const std::size_t end : {std::size_t(0), std::size_t(1)})
      for (int k = 0; k < spans_[r].count; ++k) {
        const int i = end == 0 ? k : spans_[r].count - 1 - k;
        if (toward[i] != nullptr && toward[i]->end == end) slide_toward(*toward[i], r, i);
      }
  }
  void slide_toward(const JackedEnd& jack, int r, int segment) {
    for_each_joint_toward(jack, spans_[r], segment, [&](int joint, JointState way) {
      if (cables_.glides(joint) || state_.slides[joint] == way) return;
      if (state_.slides[joint] == JointState::stick) state_.order.add(static_cast<std::int16_t>(joint));
      state_.slides[joint] = way;
    });
  }
  /// From rates, or from all forces where there are none.
  bool solve_anew(const Spans& zero, const SlipModes& modes, bool totally, int covering = 0) {
    const auto was_slack = state_.slack;
    const auto rested = state_.rests;
    for (int r = 0; r < spans_.size(); ++r)
      if (zero[r]) state_.slack[r] = false;
    if (constraints_.set_up_equalities() && find_modes(zero, modes, totally, covering) &&
        constraints_.set_up()) {
      constraints_.rebuild();
      if (constraints_.is_held(totally)) return true;
    }
    state_.slack = was_slack;
    state_.rests = rested;
    cables_.drop_set();
    return false;
  }
  /// What slides and what is slack, from what follows whatever happens; or, if `slack` says which spans were,
  /// begun from what slid and was slack. False if the path has no end.
  [[gnu::noinline]] bool find_modes(const Spans& zero, const SlipModes& modes, bool totally, int covering,
                                    const Spans* slack = nullptr) {
    Solver solver;
    solver.begin(model_, laws_, map_.set(), covering);
    for (int r = 0; r < spans_.size(); ++r)
      if (zero[r]) add_span(r, totally, solver, slack != nullptr && (*slack)[r]);
    for (const SlipMode& each : modes) solver.add_slip(each);
    if (!solve(solver, totally, slack != nullptr)) return false;
    adopt(solver, zero, totally);
    return true;
  }
  /// Segments of a span at zero, but for those that a jack gives their tension; joints without friction make
  /// one of two.
  void add_span(int r, bool totally, Solver& solver, bool is_slack = false) const {
    const Span& span = spans_[r];
    for (int i = 0; i < span.count; ++i) {
      if (i > 0 && cables_.glides(span.joint(i - 1))) continue;
      const Pull pull = pull_on(span, i, totally);
      // Where statics give its force, no length does.
      if (!(model_.coupling(span.segment(i), span.segment(i)) > 0)) continue;
      if (!pull.is_direct) solver.add_segment(span.segment(i), larger(Real(0), pull.least), is_slack);
    }
  }
  /// The jack that gives a segment of a span at zero the larger tension, by what friction leaves of its force
  /// on the way.
  Pull pull_on(const Span& span, int i, bool totally) const {
    Pull strongest;
    for (const JackedEnd& jack : cables_.jacks) {
      if (!cables_.pulls(jack, span)) continue;
      Pull pull{&jack, due_at(jack, totally), true};
      for_each_joint_toward(jack, span, i, [&](int joint, JointState) {
        pull.least *= laws_.rho(joint);
        pull.is_direct = pull.is_direct && cables_.glides(joint);
      });
      if (pull.is_direct) return pull;
      if (strongest.jack == nullptr || pull.least > strongest.least) strongest = pull;
    }
    return strongest;
  }
  template <class Visit>
  void for_each_joint_toward(const JackedEnd& jack, const Span& span, int i, Visit visit) const {
    if (jack.end == 0)
      for (int k = i; k > 0; --k) visit(span.joint(k - 1), JointState::backward);
    else
      for (int k = i; k < span.count - 1; ++k) visit(span.joint(k), JointState::forward);
  }
  /// Takes over what was decided. What a segment of a jacked span has too much goes out through the jack,
  /// over all joints on the way.
  void adopt(const Solver& solver, const Spans& zero, bool totally) {
    for (int r = 0; r < spans_.size(); ++r)
      if (zero[r]) state_.moved.slack_length[r] = 0;
    read_slides();
    FixedArray<Real, Cap::joints> flow;
    flow.fill(Real(0));
    Lengths growth;
    growth.fill(Real(0));
    bool any_slack = false;
    for (int p = 0; p < solver.pairs().size(); ++p) {
      const auto& pair = solver.pairs()[p];
      if (!solver.is_active(p)) continue;
      if (!pair.is_segment()) {
        flow[pair.index] += pair.way == JointState::forward ? solver.value(p) : -solver.value(p);
        continue;
      }
      const int r = spans_.of(pair.index);
      int i = 0;
      while (spans_[r].segment(i) != pair.index) ++i;
      const Pull pull = pull_on(spans_[r], i, totally);
      if (pull.jack == nullptr) {
        state_.slack[r] = any_slack = true;
        growth[r] += solver.value(p) / model_.coupling(pair.index, pair.index);
        continue;
      }
      for_each_joint_toward(*pull.jack, spans_[r], i, [&](int joint, JointState way) {
        if (cables_.glides(joint)) return;
        flow[joint] += way == JointState::forward ? solver.value(p) : -solver.value(p);
        if (state_.slides[joint] == JointState::stick) state_.order.add(static_cast<std::int16_t>(joint));
        state_.slides[joint] = flow[joint] > 0   ? JointState::forward
                               : flow[joint] < 0 ? JointState::backward
                                                 : way;
      });
    }
    if (any_slack) find_idle(growth, totally);
    const auto slid = state_.order;
    state_.order.clear();
    for (const std::int16_t j : slid) {
      const int span = spans_.of(laws_.sides(j)[0]);
      if (state_.slack[span] || state_.rests[span])
        state_.slides[j] = JointState::stick;
      else
        state_.order.add(j);
    }
  }

  // A little further on.

  Status try_further_on(Status why) {
    // Never further than half of what is left of the path.
    const Real least = cables_.push > 0 ? small_step * state_.peak / cables_.push : Real(1),
               most = larger(Real(1), Real(0.5) / least);
    stride_ = -larger(-stride_, -most);
    const Real step = -larger(-stride_ * least, Real(-0.5));
    const Loads before = state_.now;
    state_.now = Loads::between(state_.now, state_.goal, step);
    const Status status = find_near(why, nearby);
    if (status)
      further_ = step;
    else
      state_.now = before;
    return status;
  }
  /// All forces at the present loads, if they are near those of before. The slips must be frozen; where
  /// nothing is near, all is as before.
  Status find_near(Status why, Real nearby_part) {
    const Tensions forces = cables_.force;
    const Modes modes_before = state_;
    for (const bool from_nothing : {false, true}) {
      // The present modes lead to a near answer. From nothing there always is one, but a long path to it may
      // lose digits, which a short one from there finds again.
      const bool found =
          from_nothing ? find_from_nothing() && (is_sound() || go_on_totally(true)) : go_on_totally(false);
      if (found) {
        const bool is_near = change_from(forces) <= nearby_part * state_.peak;
        if (is_near && is_sound()) return Status::success();
        if constexpr (Cables::Model::has_level)
          if (!is_near) far_joint_ = joint_that_changes_most(forces);
        if (from_nothing && !is_near && free_joint_ < 0)
          why = cables_.at_joint(Code::gives_way, doubtful_joint_);
      }
      static_cast<Modes&>(state_) = modes_before;
      cables_.force = forces;
      cables_.drop_set();
    }
    return why;
  }
  /// All forces at the present loads, by Lemke's path from nothing.
  bool find_from_nothing() {
    for (int r = 0; r < spans_.size(); ++r) {
      state_.slack[r] = false;
      state_.moved.slack_length[r] = 0;
    }
    find_idle(true);
    Spans all;
    for (int r = 0; r < spans_.size(); ++r) all[r] = !state_.rests[r];
    if (!solve_anew(all, all_limits(all), true)) return false;
    cables_.find_forces();
    return true;
  }
  /// All forces at the present loads, by Lemke's path from the present modes; a span that no jack pulls may
  /// go slack or become taut by it. `has_map`: the slips are those of the map.
  bool go_on_totally(bool has_map) {
    // Not frozen for good: the map may be refused.
    if (has_map) state_.moved = cables_.slip_state();
    cables_.drop_map();
    Spans bearing, loose;
    const Spans slack = state_.slack;
    bool any_loose = false;
    for (int r = 0; r < spans_.size(); ++r) {
      bearing[r] = !state_.rests[r];
      loose[r] = bearing[r] && !cables_.is_jacked(spans_[r]);
      any_loose = any_loose || loose[r];
      if (!slack[r]) continue;
      state_.slack[r] = false;
      state_.moved.slack_length[r] = 0;
    }
    const bool is_set_up = constraints_.set_up();
    if (constraints_.joint_without_pivot() >= 0) doubtful_joint_ = constraints_.joint_without_pivot();
    if (!is_set_up || !find_modes(loose, all_limits(bearing), true, 0, &slack)) return false;
    if (any_loose && !constraints_.set_up()) return false;
    constraints_.rebuild();
    cables_.find_forces();
    return constraints_.is_held(true);
  }
  /// Both limits of every joint with friction in these spans.
  SlipModes all_limits(const Spans& spans) const {
    SlipModes modes;
    for (int j = 0; j < cables_.joints(); ++j) {
      if (model_.is_self_locking(j) || cables_.glides(j) || !spans[spans_.of(laws_.sides(j)[0])]) continue;
      modes.add(SlipMode::of(j, JointState::forward));
      modes.add(SlipMode::of(j, JointState::backward));
    }
    return modes;
  }
  Real change_from(const Tensions& forces) const {
    Real most = 0;
    for (int i = 0; i < model_.segments; ++i) most = larger(most, std::fabs(cables_.force[i] - forces[i]));
    return most;
  }
  /// The joint with friction at which what friction carries differs most from what it did, or -1.
  int joint_that_changes_most(const Tensions& forces) const {
    int joint = -1;
    Real most = 0;
    for (int j = 0; j < cables_.joints(); ++j) {
      const auto& sides = laws_.sides(j);
      const Real now = cables_.force[sides[1]] - cables_.force[sides[0]],
                 before = forces[sides[1]] - forces[sides[0]];
      if (model_.is_self_locking(j) || cables_.glides(j) || !(std::fabs(now - before) > most)) continue;
      most = std::fabs(now - before);
      joint = j;
    }
    return joint;
  }
  /// Whether the forces may be shown, and slack spans have length to spare.
  bool is_sound() const {
    Inputs x;
    cables_.values(state_.now, x);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.variable(i).kind == SlipVariable::Kind::slack_length &&
          map_.stiffness(i) * map_.value(i, x) < -cables_.force_tolerance())
        return false;
    return events_.check_forces().ok();
  }

  Cables& cables_;
  const typename Cables::Model& model_;
  const SlidingSpans<Cap>& spans_;
  const Laws& laws_;
  State& state_;
  Map& map_;
  Constraints<Cables> constraints_;
  RestingSpans<Cables> resting_;
  EventSearch<Cables> events_;
  Real stride_ = 1;  // of small steps that follow each other
  Real further_ = 0;
  int free_joint_ = -1, doubtful_joint_ = -1;
  int far_joint_ = -1;  // where the answer that was found last was no near one
};

}  // namespace taut
