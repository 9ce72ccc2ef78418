// Follows the forces of a condensed scene from sample to sample, from event to event.
#pragma once

#include <cmath>
#include <limits>

#include "taut/condensation/condensed.hpp"
#include "taut/numerics/complementarity.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/runs.hpp"
#include "taut/status.hpp"
#include "taut/tracking/affine_map.hpp"

namespace taut {

/// How far a call to Tracker came.
template <class Scalar>
struct [[nodiscard]] Progress {
  Status status;
  Scalar fraction = 1;  ///< of the path that was followed; below 1 the state is the equilibrium there
  int events = 0;       ///< places where the state of a joint or a run was decided anew
};

/// The exact answer between samples. Along the straight path of loads and jack forces tensions are piecewise
/// linear; only where a piece ends (a joint begins to slide, a run goes slack or taut) is anything solved.
///
/// What moves along the cables are the slips of the joints, the payouts of the jacks and the excess lengths
/// of slack runs. A move is frozen at its value, or active under a law of its own: a sliding joint keeps
/// T_small = rho T_big, an unlocked jack keeps its force, a slack run has no tension. Where a piece ends, the
/// rates of the joints at their limit solve a linear complementarity problem. Always totals: nothing is added
/// up, nothing drifts.
///
/// The condensed scene must come from a valid scene and outlive the tracker.
template <class CondensedType>
class Tracker {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Cap = typename CondensedType::Capacity;
  /// Everything that has moved along the cables.
  struct Moving {
    FixedArray<Scalar, Cap::joints> slip;                   ///< delta of every joint [m]
    FixedArray<std::array<Scalar, 2>, Cap::cables> payout;  ///< at start and end of every cable [m]
    FixedArray<Scalar, Cap::segments> excess;  ///< length that every run has too much [m], zero if taut
  };
  /// Events in one call. Of 100,000 random logs 26 reached it.
  static constexpr int default_budget = 64 + 16 * Cap::segments;

  /// Begins without loads and brings the prestrain on.
  Progress<Scalar> start(const CondensedType& condensed, int event_budget = default_budget) {
    model_ = &condensed;
    runs_.find(condensed.cables, [&condensed](int j) { return condensed.is_locked(j); });
    first_of_run_.clear();
    for (const auto& run : runs_) first_of_run_.add(run.segment(0));
    jacks_.clear();
    for_each_jacked_end(condensed.cables, [&](int c, std::size_t end) { jacks_.add({c, end}); });
    for (const auto& cable : condensed.cables)
      for (int j = 0; j < cable.joints(); ++j) {
        const auto sides = cable.joint_segments(j);
        sides_[cable.first_joint + j] = {static_cast<std::int16_t>(sides[0]),
                                         static_cast<std::int16_t>(sides[1])};
      }
    slip_ = {};
    payout_ = {};
    excess_ = {};
    slides_ = {};
    last_ = {};
    live_ = {};
    slack_ = {};
    loose_ = {};
    has_loose_ = false;
    tension_ = {};
    now_ = {};
    goal_ = {};
    goal_.prestrain = 1;
    map_is_old_ = true;
    peak_ = 0;
    return follow(event_budget);
  }

  /// Follows the straight path from the present state to the sample. When the event budget is spent
  /// (`fraction` < 1) the state is the equilibrium reached, and a call with the same sample goes on from
  /// there.
  ///
  /// Fails with `bad_sample` (nothing was done), or at `fraction` of the path with `pulled_through` (names
  /// the cable), `mechanism` (names a joint whose sliding sets its node free) or `state_iterations`.
  Progress<Scalar> advance(const Sample<Scalar, Cap>& sample, int event_budget = default_budget) {
    const Status usable = check_sample(model_->cables, model_->loads, sample);
    if (!usable) return {usable, Scalar(0), 0};
    set_goal(sample);
    for (const JackedEnd& jack : jacks_)
      if (is_spare(jack.cable, jack.end) && !spare_agrees(jack.cable))
        return {Status::at(Code::pulled_through, Place::cable, jack.cable), Scalar(0), 0};
    if (brings_new_input()) {
      freeze(moves());
      map_is_old_ = true;
    }
    if (quick()) return {};
    return follow(event_budget);
  }

  /// Tension of a segment [N], >= 0.
  Scalar tension(int segment) const { return tension_[segment] > 0 ? tension_[segment] : Scalar(0); }

  /// Slips, payouts and excess lengths at the end of the path followed.
  Moving moves() const {
    Moving moving{slip_, payout_, excess_};
    if (map_is_old_) return moving;
    Inputs x;
    values(now_, x);
    for (int i = 0; i < map_.active(); ++i) {
      const Move& move = map_.move(i);
      const Scalar at = map_.active_move(i, x);
      if (move.kind == Move::Kind::slip) moving.slip[move.index] = at;
      if (move.kind == Move::Kind::payout)
        moving.payout[move.index / 2][static_cast<std::size_t>(move.index % 2)] = at;
      if (move.kind == Move::Kind::excess) moving.excess[move.index] = at;
    }
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      if (goal_.jack[c][end].locked) moving.payout[c][end] = now_.jack[c][end].payout;
    });
    return moving;
  }
  const CondensedType& model() const { return *model_; }
  /// The loads and jack forces reached.
  const Drive<Scalar, Cap>& loads() const { return now_; }
  const Runs<Scalar, Cap>& runs() const { return runs_; }
  bool is_slack(const Run<Scalar>& run) const { return is_slack(run.segment(0)); }
  /// What the joint did on the last piece of the path, apart from slack.
  JointState motion(int joint) const {
    for (int i = 0; i < map_.active(); ++i) {
      if (map_.move(i).kind != Move::Kind::slip || map_.move(i).index != joint) continue;
      const Scalar rate = map_.move_rate(i, last_);
      if (rate == 0 || !loose_[joint]) return rate == 0 ? JointState::stick : slides_[joint];
      return rate > 0 ? JointState::forward : JointState::backward;
    }
    return JointState::stick;
  }
  /// The largest tension so far [N].
  Scalar peak() const { return peak_; }

  /// The state at the end of the path followed. Forces of struts only if their rows are given.
  void respond(Response<Scalar, Cap>& response, const CondensedStruts<Scalar, Cap>* struts = nullptr) const {
    const Moving moved = moves();
    for (int i = 0; i < model_->segments; ++i) response.tension[i] = tension(i);
    for (int c = 0; c < model_->cables.size(); ++c) {
      response.payout[c] = moved.payout[c];
      const auto& cable = model_->cables[c];
      for (int k = 0; k < cable.joints(); ++k) {
        const int j = cable.first_joint + k;
        const auto sides = cable.joint_segments(k);
        const Scalar T1 = tension(sides[0]), T2 = tension(sides[1]);
        response.slip[j] = moved.slip[j];
        response.contact[j] = (T1 + T2) * model_->cos_alpha[j];
        response.friction[j] = (T2 - T1) * model_->sin_alpha[j];
        response.state[j] = is_slack(sides[0]) && is_slack(sides[1]) ? JointState::open : motion(j);
      }
    }
    if (struts != nullptr) strut_forces(moved, *struts, response);
  }

 private:
  using Map = AffineMap<CondensedType>;
  using Tensions = typename Map::Tensions;
  using Inputs = FixedArray<Scalar, Map::max_inputs>;
  using Loads = Drive<Scalar, Cap>;

  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  /// Forces closer than this part of the largest force so far are equal.
  static constexpr Scalar tolerance = sizeof(Scalar) == sizeof(float) ? Scalar(4e-6) : Scalar(1e-12);

  struct JackedEnd {
    int cable = 0;
    std::size_t end = 0;
  };

  Scalar force_tolerance() const { return tolerance * peak_; }
  bool is_slack(int segment) const { return slack_[runs_.of(segment)]; }
  /// Zero at compile time where the capacity is, so that no code for joints is left.
  int joints() const { return Cap::joints == 0 ? 0 : model_->joints; }

  // From sample to path.

  /// Sets goal_; where a lock changes, also the present drive at the state reached.
  void set_goal(const Sample<Scalar, Cap>& sample) {
    bool changes = false;
    for (const JackedEnd& jack : jacks_)
      changes =
          changes || sample.jack[jack.cable][jack.end].locked != goal_.jack[jack.cable][jack.end].locked;
    if (!changes) {
      for (int i = 0; i < model_->loads; ++i) goal_.factor[i] = sample.factor[i];
      for (const JackedEnd& jack : jacks_) {
        auto& goal = goal_.jack[jack.cable][jack.end];
        if (!goal.locked) goal.force = sample.jack[jack.cable][jack.end].force;
      }
      return;
    }
    Response<Scalar, Cap> present;
    respond(present);
    freeze(moves());
    set_path(model_->cables, model_->loads, present, sample, now_, goal_);
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      now_.jack[c][end].locked = goal_.jack[c][end].locked;
    });
    // A jack that takes hold of a slack run draws it straight; its payout follows from its force.
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r] && is_jacked(runs_[r])) draw_straight(r);
    map_is_old_ = true;
  }

  /// What a slack run has too much goes out through the jack: over every joint, if that is at its far end.
  void draw_straight(int r) {
    const Run<Scalar>& run = runs_[r];
    const auto& cable = model_->cables[run.cable];
    const bool at_start = run.segment(0) == cable.end_segment(0) && cable.ends[0] == End::jacked &&
                          !goal_.jack[run.cable][0].locked;
    for (int i = 0; !at_start && i < run.joints(); ++i) slip_[run.joint(i)] += excess_[r];
    slack_[r] = false;
    excess_[r] = 0;
  }

  Scalar value(const Input& input, const Loads& loads) const {
    if (input.kind == Input::Kind::load) return loads.factor[input.index];
    if (input.kind == Input::Kind::prestrain) return loads.prestrain;
    const auto& jack = loads.jack[input.index / 2][static_cast<std::size_t>(input.index % 2)];
    return input.kind == Input::Kind::jack_force ? jack.force : jack.payout;
  }
  void values(const Loads& loads, Inputs& x) const {
    for (int k = 0; k < map_.inputs(); ++k) x[k] = value(map_.input(k), loads);
  }

  // Moves.

  void freeze(const Moving& moves) {
    slip_ = moves.slip;
    payout_ = moves.payout;
    excess_ = moves.excess;
  }

  Move slip_of(int joint) const {
    if (Cap::joints == 0) return {};
    const auto& sides = sides_[joint];
    return {Move::Kind::slip, joint, sides[0], sides[1]};
  }
  /// Forward: T_before = rho T_after. Backward: T_after = rho T_before.
  Law<Scalar> limit_of(int joint, JointState way) const {
    const Move slip = slip_of(joint);
    const bool forward = way == JointState::forward;
    return {forward ? slip.lengthened : slip.shortened, forward ? slip.shortened : slip.lengthened,
            model_->rho[joint]};
  }
  static Scalar sign(JointState way) { return way == JointState::forward ? Scalar(1) : Scalar(-1); }

  /// A run that ends in an unlocked jack cannot go slack: the jack draws it straight.
  bool is_jacked(const Run<Scalar>& run) const {
    bool jacked = false;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const int segment = model_->cables[c].end_segment(end);
      jacked = jacked || (c == run.cable && !goal_.jack[c][end].locked &&
                          (segment == run.segment(0) || segment == run.segment(run.count - 1)));
    });
    return jacked;
  }
  /// On a cable of one segment with two jacks at work the start's payout rests, and the end's does for both.
  bool is_spare(int c, std::size_t end) const {
    return end == 0 && model_->cables[c].segments() == 1 && model_->cables[c].ends[1] == End::jacked &&
           !goal_.jack[c][1].locked;
  }

  /// Two jacks on one segment balance only if they pull alike.
  bool spare_agrees(int c) const {
    const Scalar F0 = goal_.jack[c][0].force, F1 = goal_.jack[c][1].force;
    return std::fabs(F0 - F1) <= Scalar(64) * tolerance * std::fmax(F0, F1);
  }

  // The map.

  /// Makes the map of the present state from totals. Returns -1, or an active move that nothing resists.
  int rebuild() {
    map_.clear(*model_);
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) { add_jack(c, end); });
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r]) add_slack_run(r);
    for (int j = 0; j < joints(); ++j)
      if (slides_[j] != JointState::stick)
        map_.add_active(slip_of(j), limit_of(j, slides_[j]), sign(slides_[j]));
    for (int i = 0; i < model_->loads; ++i) {
      live_[i] = now_.factor[i] != goal_.factor[i];
      if (live_[i]) map_.add_input({Input::Kind::load, i});
    }
    if (now_.prestrain != goal_.prestrain) map_.add_input({Input::Kind::prestrain, 0});
    map_is_old_ = false;
    const int loose = map_.factor();
    if (loose >= 0) return loose;
    map_.make_base(frozen_tensions());
    map_.make_columns();
    return -1;
  }
  void add_jack(int c, std::size_t end) {
    const int index = 2 * c + static_cast<int>(end);
    const auto& start = now_.jack[c][end];
    const auto& goal = goal_.jack[c][end];
    if (!goal.locked && !is_spare(c, end)) {
      map_.add_active(map_.payout_move(index), {model_->cables[c].end_segment(end), -1, Scalar(0)});
      map_.add_input({Input::Kind::jack_force, index});
    }
    if (goal.locked && start.payout != goal.payout) map_.add_input({Input::Kind::payout, index});
  }
  /// Its tensions are zero; its slips and its excess length follow. A ring keeps the slip of one joint: it
  /// may turn freely.
  void add_slack_run(int r) {
    const Run<Scalar>& run = runs_[r];
    for (int i = 0; i < run.count; ++i) {
      const int joint = run.joint(i);
      const bool last = i == run.count - 1;
      map_.add_active(last ? Move{Move::Kind::excess, r, run.segment(0), -1} : slip_of(joint),
                      {run.segment(i), -1, Scalar(0)});
    }
  }
  /// Tensions of everything that does not change along the path, the active moves at zero.
  Tensions frozen_tensions() const {
    Tensions e, T;
    e.fill(Scalar(0));
    T.fill(Scalar(0));
    if (now_.prestrain == goal_.prestrain)
      for (int i = 0; i < model_->segments; ++i) T[i] = now_.prestrain * model_->prestrain[i];
    for (int k = 0; k < model_->loads; ++k)
      for (int i = 0; !live_[k] && i < model_->segments; ++i) T[i] += now_.factor[k] * model_->load[k][i];
    FixedArray<bool, Cap::joints> moves;
    moves.fill(false);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.move(i).kind == Move::Kind::slip) moves[map_.move(i).index] = true;
    for (int j = 0; j < joints(); ++j)
      if (!moves[j]) Map::impose(slip_of(j), slip_[j], e);
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const Move move = map_.payout_move(2 * c + static_cast<int>(end));
      const auto& goal = goal_.jack[c][end];
      if (goal.locked && now_.jack[c][end].payout == goal.payout) Map::impose(move, goal.payout, e);
      if (!goal.locked && is_spare(c, end)) Map::impose(move, payout_[c][end], e);
    });
    model_->coupling.add(model_->segments, e, T);
    return T;
  }

  // A sample without an event.

  /// Whether a load changes that the present map has as a constant.
  bool brings_new_input() const {
    for (int k = 0; k < model_->loads; ++k)
      if (!live_[k] && goal_.factor[k] != now_.factor[k]) return true;
    return false;
  }

  /// Goes to the goal if no state changes on the way; both ends of the straight path within the limits is
  /// enough.
  bool quick() {
    if (map_is_old_ || has_loose_) return false;
    Inputs x, dx;
    for (int k = 0; k < map_.inputs(); ++k) {
      const Input input = map_.input(k);
      x[k] = value(input, goal_);
      dx[k] = x[k] - value(input, now_);
      if (dx[k] == 0 && input.kind == Input::Kind::load) {
        map_.fold(k--, goal_.factor[input.index]);
        live_[input.index] = false;
      }
    }
    if (!map_.goes_on(dx) || !map_.stays_slack(x)) return false;
    Tensions T;
    map_.tensions(x, T);
    if (!is_within_limits(T)) return false;
    tension_ = T;
    now_ = goal_;
    last_ = dx;
    return true;
  }
  /// The friction cones, and T >= 0. Sliding joints are at their limit, give or take the rounding that is
  /// allowed for.
  bool is_within_limits(const Tensions& T) const {
    const Scalar least = -force_tolerance();
    bool within = true;
    for (int j = 0; j < joints(); ++j) {
      const Scalar T1 = T[sides_[j][0]], T2 = T[sides_[j][1]], rho = model_->rho[j];
      within = within & (T1 - rho * T2 >= least) & (T2 - rho * T1 >= least);
    }
    for (const int segment : first_of_run_) within = within & (T[segment] >= least);
    return within;
  }

  // From event to event.

  /// A joint that would leave its friction cone, and where.
  struct Candidate {
    int joint = -1;
    JointState way = JointState::stick;
  };

  Progress<Scalar> follow(int event_budget) {
    Progress<Scalar> progress;
    progress.fraction = 0;
    const Loads from = now_;
    measure_path();
    Candidate next;
    int stalled = 0;
    for (;;) {
      progress.status = decide(from, next);
      if (!progress.status) return progress;
      Inputs dx;
      directions(from, dx);
      const Scalar rest = Scalar(1) - progress.fraction;
      const Scalar step = piece(dx, rest, next);
      const bool done = step >= rest || (rest - step) * change(dx) <= force_tolerance();
      progress.fraction = done ? Scalar(1) : progress.fraction + step;
      now_ = Loads::between(from, goal_, progress.fraction);
      Inputs x;
      values(now_, x);
      map_.tensions(x, tension_);
      for (int i = 0; i < model_->segments; ++i) peak_ = std::fmax(peak_, std::fabs(tension_[i]));
      last_ = dx;
      if (map_.law_violation(tension_, x) > Scalar(8) * force_tolerance()) {
        progress.status = Status::at(Code::ill_conditioned, Place::none, -1);
        return progress;
      }
      if (done) return progress;
      stalled = step > 0 ? 0 : stalled + 1;
      if (stalled > 8 + 4 * joints()) {
        progress.status = at_joint(Code::state_iterations, next.joint);
        return progress;
      }
      if (++progress.events >= event_budget) return progress;
    }
  }

  /// What the loads would do with every joint stuck is as large as any force: it says what is rounding.
  void measure_path() {
    push_ = 0;
    for (int i = 0; i < model_->segments; ++i) {
      measure(goal_.prestrain * model_->prestrain[i],
              (goal_.prestrain - now_.prestrain) * model_->prestrain[i]);
      for (int k = 0; k < model_->loads; ++k)
        measure(goal_.factor[k] * model_->load[k][i],
                (goal_.factor[k] - now_.factor[k]) * model_->load[k][i]);
    }
    for (const JackedEnd& jack : jacks_) {
      const auto& start = now_.jack[jack.cable][jack.end];
      const auto& goal = goal_.jack[jack.cable][jack.end];
      const int segment = model_->cables[jack.cable].end_segment(jack.end);
      measure(goal.force, goal.force - start.force);
      const Scalar drawn = model_->coupling(segment, segment) * (goal.payout - start.payout);
      measure(drawn, drawn);
    }
  }
  void measure(Scalar force, Scalar change) {
    peak_ = std::fmax(peak_, std::fabs(force));
    push_ = std::fmax(push_, std::fabs(change));
  }
  /// Rates of force along the path below this are zero [N].
  Scalar rate_tolerance() const { return Scalar(64) * epsilon * push_; }

  /// Largest change of a tension, or of what a slack run's excess length stands for, along the whole path
  /// [N].
  Scalar change(const Inputs& dx) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Scalar most = 0;
    for (int i = 0; i < model_->segments; ++i) most = std::fmax(most, std::fabs(rate[i]));
    for (int i = 0; i < map_.active(); ++i) {
      const Move& move = map_.move(i);
      if (move.kind == Move::Kind::excess)
        most = std::fmax(
            most, std::fabs(model_->coupling(move.lengthened, move.lengthened) * map_.move_rate(i, dx)));
    }
    return most;
  }
  void directions(const Loads& from, Inputs& dx) const {
    Inputs end;
    values(goal_, end);
    values(from, dx);
    for (int k = 0; k < map_.inputs(); ++k) dx[k] = end[k] - dx[k];
  }

  /// How far the present piece goes, at most `rest` [fraction of the path]; `next` is the joint at its end,
  /// if it is one.
  Scalar piece(const Inputs& dx, Scalar rest, Candidate& next) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Scalar step = rest;
    next = {};
    const auto shorten = [&](Scalar room, Scalar falling, const Candidate& found) {
      // At the limit, and held there by decide(): what is left is rounding.
      if (room <= force_tolerance() && falling >= -Scalar(16) * rate_tolerance()) return;
      if (falling >= 0 || room > -falling * step) return;
      step = room > 0 ? room / -falling : Scalar(0);
      next = found;
    };
    for (int j = 0; j < joints(); ++j) {
      if (slides_[j] != JointState::stick || model_->is_locked(j) || is_slack(slip_of(j).lengthened))
        continue;
      for (const JointState way : {JointState::forward, JointState::backward}) {
        const Law<Scalar> limit = limit_of(j, way);
        shorten(limit.of(tension_), limit.of(rate), {j, way});
      }
    }
    for (int r = 0; r < runs_.size(); ++r) {
      const int segment = runs_[r].segment(0);
      if (!slack_[r]) shorten(tension_[segment], rate[segment], {});
    }
    Inputs x;
    values(now_, x);
    for (int i = 0; i < map_.active(); ++i) {
      const Move& move = map_.move(i);
      if (move.kind != Move::Kind::excess) continue;
      const Scalar stiffness = model_->coupling(move.lengthened, move.lengthened);
      shorten(stiffness * map_.active_move(i, x), stiffness * map_.move_rate(i, dx), {});
    }
    return step;
  }

  // The states in the next piece.

  /// Decides which joints slide and which runs are slack from here on, and makes the map for it. `next` is
  /// the joint that ended the piece before.
  ///
  /// A run without tension is first asked whether it would go slack (its excess length grows), and only if
  /// not what slides.
  Status decide(const Loads& from, const Candidate& next) {
    freeze(moves());
    FixedList<int, Cap::segments> asked;
    for (int r = 0; r < runs_.size(); ++r)
      if (is_without_tension(r)) asked.add(r);
    if (asked.empty()) return decide_slides(from, next);
    // All combinations of a few, slack first; of many, those that contradict themselves change.
    const bool few = asked.size() <= 5;
    const int tries = few ? 1 << asked.size() : 4 * asked.size();
    for (const int r : asked) slack_[r] = true;
    Status status;
    for (int count = 0; count < tries; ++count) {
      for (int i = 0; few && i < asked.size(); ++i) slack_[asked[i]] = (count >> i & 1) == 0;
      map_is_old_ = true;
      status = decide_slides(from, next);
      bool agrees = status.ok();
      for (const int r : asked) {
        const bool fits = status.ok() && (slack_[r] ? excess_grows(r, from) : stays_taut(r, from));
        agrees = agrees && fits;
        if (!few && !fits) slack_[r] = !slack_[r];
      }
      if (!agrees) continue;
      for (const int r : asked)
        if (!slack_[r]) excess_[r] = 0;
      return status;
    }
    return status ? at_joint(Code::state_iterations, runs_[asked[0]].joint(0)) : status;
  }
  bool is_without_tension(int r) const {
    const Run<Scalar>& run = runs_[r];
    if (is_jacked(run)) return false;
    if (slack_[r]) {
      const int segment = run.segment(0);
      return excess_[r] * model_->coupling(segment, segment) <= force_tolerance();
    }
    for (int i = 0; i < run.count; ++i)
      if (tension_[run.segment(i)] > force_tolerance()) return false;
    return true;
  }
  bool excess_grows(int r, const Loads& from) const {
    Inputs dx;
    directions(from, dx);
    for (int i = 0; i < map_.active(); ++i) {
      const Move& move = map_.move(i);
      if (move.kind == Move::Kind::excess && move.index == r)
        return map_.move_rate(i, dx) * model_->coupling(move.lengthened, move.lengthened) > rate_tolerance();
    }
    return false;
  }
  bool stays_taut(int r, const Loads& from) const {
    Inputs dx;
    directions(from, dx);
    Tensions rate;
    map_.tension_rates(dx, rate);
    for (int i = 0; i < runs_[r].count; ++i)
      if (rate[runs_[r].segment(i)] < -rate_tolerance()) return false;
    return true;
  }

  using Candidates = FixedList<Candidate, 2 * Cap::joints>;
  using Rates = Lemke<Scalar, 2 * Cap::joints>;

  /// With runs as they are: rates v >= 0 of the joints at their limits, w = T_small - rho T_big kept >= 0, v
  /// w = 0.
  Status decide_slides(const Loads& from, const Candidate& next) {
    const bool as_before = !map_is_old_ && !has_loose_;
    loose_.fill(false);
    has_loose_ = false;
    const FixedArray<JointState, Cap::joints> slid = slides_;
    const Candidates candidates = at_limit(slid, false);
    // Most often all goes on as it was and the joint that reached its limit slides too, or all stick.
    if (as_before && next.joint < 0 && is_consistent(from, candidates)) return Status::success();
    if (next.joint >= 0) {
      slides_[next.joint] = next.way;
      if (rebuild() < 0 && is_consistent(from, candidates)) return Status::success();
    }
    const Status status = solve_slides(from, candidates);
    if (status) return status;
    // Just above zero a joint is at both limits only by rounding; while tension falls it can keep but one.
    if (solve_slides(from, at_limit(slid, true))) return Status::success();
    find_loose();
    if (has_loose_ && solve_slides(from, at_limit(slid, false))) return Status::success();
    return status;
  }
  /// Whether the rates under the present map agree with its states: v >= 0 where it slides, w >= 0 at the
  /// other limits.
  bool is_consistent(const Loads& from, const Candidates& candidates) const {
    Inputs dx;
    directions(from, dx);
    if (!map_.goes_on(dx, rate_tolerance())) return false;
    Tensions rate;
    map_.tension_rates(dx, rate);
    const Scalar least = -rate_tolerance();
    for (const Candidate& candidate : candidates)
      if (slides_[candidate.joint] != candidate.way &&
          limit_of(candidate.joint, candidate.way).of(rate) < least)
        return false;
    return true;
  }
  /// In a run whose jacks rest at zero all tensions are zero and every joint slides as the structure moves,
  /// without friction: the law T_before = rho T_after says that, whichever way it goes.
  void find_loose() {
    loose_.fill(false);
    has_loose_ = false;
    for (int r = 0; r < runs_.size(); ++r) {
      const Run<Scalar>& run = runs_[r];
      int jacks = 0;
      bool zero = !slack_[r];
      for (const JackedEnd& jack : jacks_) {
        const int segment = model_->cables[jack.cable].end_segment(jack.end);
        const auto& goal = goal_.jack[jack.cable][jack.end];
        if (goal.locked || (segment != run.segment(0) && segment != run.segment(run.count - 1))) continue;
        ++jacks;
        zero = zero && goal.force <= force_tolerance() &&
               now_.jack[jack.cable][jack.end].force <= force_tolerance();
      }
      for (int i = 0; i < run.count; ++i) zero = zero && tension_[run.segment(i)] <= force_tolerance();
      if (!zero || jacks == 0) continue;
      // Between two jacks the cable may move as a whole; one joint keeps its place.
      for (int i = jacks - 1; i < run.joints(); ++i) loose_[run.joint(i)] = has_loose_ = true;
    }
  }
  Candidates at_limit(const FixedArray<JointState, Cap::joints>& slid, bool only_nearer) const {
    Candidates candidates;
    for (int j = 0; j < joints(); ++j) {
      if (loose_[j] || model_->is_locked(j) || is_slack(slip_of(j).lengthened)) continue;
      const Scalar room_forward = limit_of(j, JointState::forward).of(tension_);
      const Scalar room_backward = limit_of(j, JointState::backward).of(tension_);
      bool forward = slid[j] == JointState::forward || room_forward <= force_tolerance();
      bool backward = slid[j] == JointState::backward || room_backward <= force_tolerance();
      const bool tense = tension_[sides_[j][0]] > 0 || tension_[sides_[j][1]] > 0;
      if (only_nearer && tense && forward && backward) {
        const bool keep =
            slid[j] == JointState::stick ? room_forward <= room_backward : slid[j] == JointState::forward;
        forward = keep;
        backward = !keep;
      }
      if (forward) candidates.add({j, JointState::forward});
      if (backward) candidates.add({j, JointState::backward});
    }
    return candidates;
  }
  Status solve_slides(const Loads& from, const Candidates& candidates) {
    for (int j = 0; j < joints(); ++j) slides_[j] = loose_[j] ? JointState::forward : JointState::stick;
    const int unresisted = rebuild();
    if (unresisted >= 0) return no_answer(map_.move(unresisted));
    if (candidates.empty()) return Status::success();
    Inputs dx;
    directions(from, dx);
    Tensions rate;
    map_.tension_rates(dx, rate);
    Rates rates;
    auto outcome = Rates::Outcome::ray;
    for (int attempt = 0; attempt < 6 && outcome != Rates::Outcome::solved; ++attempt) {
      pose(rates, candidates, rate);
      outcome = rates.solve(attempt);
    }
    if (outcome != Rates::Outcome::solved) return no_answer(slip_of(candidates[0].joint));
    bool any = false;
    for (int k = 0; k < candidates.size(); ++k) {
      if (!(rates.z(k) > 0)) continue;
      slides_[candidates[k].joint] = candidates[k].way;
      any = true;
    }
    if (!any) return Status::success();
    const int free = rebuild();
    return free < 0 ? Status::success() : no_answer(map_.move(free));
  }

  /// w = q + M v from the map with all candidates stuck, and its tension rates.
  void pose(Rates& rates, const Candidates& candidates, const Tensions& rate) const {
    rates.reset(candidates.size());
    for (int k = 0; k < candidates.size(); ++k) {
      Tensions column;
      typename Map::Moves follow;
      map_.column_of(slip_of(candidates[k].joint), column);
      map_.project(column, -1, follow);
      for (int i = 0; i < candidates.size(); ++i)
        rates.set_M(i, k,
                    sign(candidates[k].way) * limit_of(candidates[i].joint, candidates[i].way).of(column));
      const Scalar q = limit_of(candidates[k].joint, candidates[k].way).of(rate);
      rates.set_q(k, std::fabs(q) > rate_tolerance() ? q : Scalar(0));
    }
  }

  /// Why there is none: two jacks that pull the cable through, or a node that its cable alone had held.
  Status no_answer(const Move& move) const {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      const bool both = !cable.closed && cable.ends[0] == End::jacked && cable.ends[1] == End::jacked &&
                        !goal_.jack[c][0].locked && !goal_.jack[c][1].locked;
      if (!both) continue;
      Scalar carried = 1;
      for (int k = 0; k < cable.joints(); ++k) carried *= model_->rho[cable.first_joint + k];
      const Scalar F0 = now_.jack[c][0].force, F1 = now_.jack[c][1].force;
      const Scalar margin = 64 * tolerance * std::fmax(F0, F1);
      if (F0 <= carried * F1 + margin || F1 <= carried * F0 + margin)
        return Status::at(Code::pulled_through, Place::cable, c);
    }
    return at_joint(Code::mechanism, move.kind == Move::Kind::slip ? move.index : -1);
  }
  Status at_joint(Code code, int joint) const {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const int j = joint - model_->cables[c].first_joint;
      if (joint >= 0 && j >= 0 && j < model_->cables[c].joints())
        return Status::along(code, Place::joint, c, j);
    }
    return Status::at(code, Place::none, -1);
  }

  void strut_forces(const Moving& moves, const CondensedStruts<Scalar, Cap>& rows,
                    Response<Scalar, Cap>& response) const {
    Tensions e;
    e.fill(Scalar(0));
    for (int j = 0; j < joints(); ++j) Map::impose(slip_of(j), moves.slip[j], e);
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      Map::impose(map_.payout_move(2 * c + static_cast<int>(end)), moves.payout[c][end], e);
    });
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r]) e[runs_[r].segment(0)] += moves.excess[r];
    for (int i = 0; i < Cap::struts; ++i) {
      Scalar force = now_.prestrain * rows.prestrain[i];
      for (int k = 0; k < model_->loads; ++k) force += now_.factor[k] * rows.load[k][i];
      for (int segment = 0; segment < model_->segments; ++segment)
        force += e[segment] * rows.elongation[segment][i];
      response.strut[i] = force;
    }
  }

  const CondensedType* model_ = nullptr;
  Runs<Scalar, Cap> runs_;
  Map map_;
  Loads now_, goal_;
  Tensions tension_;
  FixedArray<Scalar, Cap::joints> slip_;  // frozen, as payout_ and excess_
  FixedArray<std::array<Scalar, 2>, Cap::cables> payout_;
  FixedArray<Scalar, Cap::segments> excess_;
  FixedList<int, Cap::segments> first_of_run_;  // its first segment
  FixedList<JackedEnd, 2 * Cap::cables> jacks_;
  FixedArray<std::array<std::int16_t, 2>, Cap::joints> sides_;  // the segments before and after every joint
  FixedArray<JointState, Cap::joints> slides_;  // stick, forward or backward: the law in force
  Inputs last_;                                 // direction of the inputs on the last piece
  FixedArray<bool, Cap::loads> live_;           // load patterns that are inputs of the map
  FixedArray<bool, Cap::segments> slack_;       // of runs
  Scalar peak_ = 0;
  Scalar push_ = 0;  // largest change of force that the path would make with every joint stuck [N]
  FixedArray<bool, Cap::joints> loose_;  // slides without tension, either way
  bool has_loose_ = false;
  bool map_is_old_ = true;
};

}  // namespace taut
