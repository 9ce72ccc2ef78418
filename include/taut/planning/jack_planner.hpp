// Planning anew beside the jack: the next moves of one jack, from what is known of friction by now.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "taut/condensation/second_order.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/planning/jack_goal.hpp"
#include "taut/planning/objective.hpp"
#include "taut/planning/turn_search.hpp"
#include "taut/scene/sample.hpp"
#include "taut/status.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// The moves of one jack that bring the forces nearest to their targets, Eq. (49), from where the cables are:
/// none, one, or two that turn. All other jacks and loads stay as they are.
///
/// Friction remembers the turning points of the jack alone, and between two events of the tracker all is
/// linear. So one release, followed from event to event, shows everything that can follow a pull, and the
/// best of it is exact; so does one pull after a release. Where to turn is a function of one number, which
/// TurnSearch looks for: the best pull alone and the best release alone are exact, of two moves the turning
/// point is as near as `most_turns` looks bring it. Lock-off draws in cable as a release does: the states
/// after it are those of the same release, as far behind the turn as the seating.
///
/// It has a tracker of its own, so that the estimator goes on while it looks: call step() with a few events
/// between two rows. The moves hold as long as the jack has gone no other way meanwhile, and no further, than
/// the first of them. `TrackerType` is that of the estimator, whose code it shares.
///
/// Nothing here may be called from an interrupt while another call is under way.
template <class TrackerType>
class JackPlanner {
 public:
  using Scalar = typename TrackerType::Scalar;
  using Real = typename TrackerType::Real;
  using Cap = typename TrackerType::Cap;
  using State = typename TrackerType::State;
  using CondensedType = std::decay_t<decltype(std::declval<const TrackerType&>().condensed())>;
  using Goal = JackGoal<Scalar, Cap>;
  using Moves = NextMoves<Scalar, Cap>;
  /// Turning points that a search looks at.
  static constexpr int most_turns = TrackerType::Model::has_level ? 64 : 32;
  /// Events of a leg, after which it is given up.
  static constexpr int most_leg = 4 * Cap::segments + (TrackerType::Model::has_level ? 128 : 32);
  /// Events in all after which the search ends with what it has.
  static constexpr int default_budget =
      4 * most_turns * (Cap::segments + 32) * (TrackerType::Model::has_level ? 8 : 1);

  // Beginning.

  /// From the best estimate of an Estimator with this type of tracker, for the jack at an end of a cable.
  /// Fails with `bad_sample` if that is no jack at work, else as Estimator::bring() does. Cost: that, and of
  /// one event.
  template <class EstimatorType>
  Status begin(const EstimatorType& estimator, const Goal& goal, int cable, std::size_t end,
               int most_events = default_budget) {
    task_ = Task::done;
    const Status there = estimator.bring(tracker_);
    if (!there) return there;
    return begin(estimator.tracker().condensed(), estimator.best_friction(), tracker_.save(), goal, cable,
                 end, most_events);
  }
  /// From the state of any such tracker, with the friction that `friction(joint)` gives as JointFriction; the
  /// condensed scene must outlive the planner. Fails with `bad_sample` if the state is none of the scene, or
  /// the end has no jack at work. Cost: that of one event.
  template <class Friction>
  Status begin(const CondensedType& condensed, const Friction& friction, const State& state, const Goal& goal,
               int cable, std::size_t end, int most_events = default_budget) {
    task_ = Task::done;
    condensed_ = &condensed;
    start_ = state;
    // Nobody asks for derivatives.
    static_cast<typename TrackerType::Derivatives::Frozen&>(start_) = {};
    const auto& model = linear_part(condensed);
    for (int j = 0; j < model.joints; ++j) {
      const JointFriction<Real> given = friction(j);
      rho_[j] = given.parameter < 0 ? Real(-1) : given.rho;
    }
    goal_ = goal;
    cable_ = cable;
    end_ = end;
    events_ = 0;
    most_events_ = most_events;
    const Status there = go_back();
    if (!there) return there;
    const auto& at = tracker_.loads();
    if (model.cables[cable].closed || model.cables[cable].ends[end] != End::jacked ||
        at.jack[cable][end].locked)
      return Status::along(Code::bad_sample, Place::cable_end, cable, static_cast<int>(end));
    for (int i = 0; i < model.loads; ++i) sample_.factor[i] = static_cast<Scalar>(at.factor[i]);
    for_each_jacked_end(model.cables, [&](int c, std::size_t side) {
      sample_.jack[c][side] = {static_cast<Scalar>(at.jack[c][side].force), at.jack[c][side].locked};
    });
    from_ = sample_.jack[cable][end].force;
    const Scalar possible = just_below * model.most_force[cable];
    most_force_ = goal.most_force > 0 && goal.most_force < possible ? goal.most_force : possible;
    seating_ = goal.lock ? static_cast<Real>(model.cables[cable].seating) : Real(0);
    look();
    best_.count = 0;
    best_.tension = here_.tension;
    best_.error = error_now_ = off_target(&here_.tension[0], &goal_.target[0], model.segments);
    if (seating_ > 0) best_.error = unreachable;
    explore(Task::release);
    return Status::success();
  }

  // Looking.

  /// Looks on for so many events. True once there is nothing left to look for. Cost: at most that of
  /// `events` events of the tracker, each as Tracker::advance() with a budget of one says or, where a leg
  /// begins, as Tracker::restore(); and O(segments) numbers for the best place on each. The moves that are
  /// found do not depend on how the events are shared among calls.
  bool step(int events) {
    for (; events > 0 && task_ != Task::done; --events) {
      if (events_ >= most_events_) task_ = Task::done;
      if (task_ == Task::done) break;
      ++events_;
      go();
    }
    return task_ == Task::done;
  }
  /// Looks until there is nothing left to look for, and gives what was found. Cost: at most `most_events`
  /// events.
  const Moves& find() {
    while (!step(default_budget)) {
    }
    return best_;
  }

  // What was found.

  bool is_done() const { return task_ == Task::done; }
  /// The best until now. With a lock-off to come `error` is 1e6 until the first leg shows what follows from
  /// it.
  const Moves& best() const { return best_; }
  /// How far the forces are off their targets where the jack stood at the beginning.
  Scalar error_now() const { return error_now_; }
  /// Events looked at until now.
  int events() const { return events_; }

 private:
  enum class Task : std::uint8_t {
    done,
    release,               // alone, all of it
    pull,                  // alone, all of it
    pull_and_release,      // where to turn
    release_and_pull,      // where to turn
    release_pull_and_lock  // where to turn twice, for a lock-off that draws in
  };
  /// On the way to the turns, and what is looked at.
  enum class Leg : std::uint8_t { begins, to_turn, to_second, from_turn };
  using Search = TurnSearch<Scalar, most_turns>;

  static constexpr Scalar unreachable = Search::unreachable, just_below = Scalar(0.999999);
  // Of an error: no gauge shows it. Coarser where two turns are looked for.
  static constexpr Scalar tolerance = Scalar(1e-5), coarse = Scalar(1e-4);
  static constexpr int most_releases = 16, most_pulls = 10;  // there
  static constexpr bool is_rigid = has_rigid_saddles<Cap>;
  // By how much steeper than between rigid saddles the error may be, with springs.
  static constexpr Scalar steeper = is_rigid ? Scalar(1) : Scalar(2);

  /// A point of a leg.
  struct Point {
    Scalar force = 0;  // of the jack
    FixedArray<Scalar, Cap::segments> tension;
    Scalar stroke = 0;
    Real extension = 0;  // the same, as a lock-off holds it
  };
  /// A point of a release, for a lock-off that draws in so much that the forces are those of a later one.
  struct Passed {
    Scalar force = 0, extension = 0;
  };
  /// What the way of one move shows.
  struct Reach {
    Scalar value = 0;     // the least error on it
    Scalar end = 0;       // force of the jack beyond which no turn is of use
    Scalar steepest = 0;  // largest change of a segment's error with the force of the jack [1/N]
  };

  const auto& model() const { return tracker_.model(); }
  int segments() const { return tracker_.model().segments; }
  bool explores() const { return task_ == Task::release || task_ == Task::pull; }
  /// Which way the last move goes, whose way is looked at.
  bool goes_down() const {
    return task_ == Task::release || task_ == Task::pull_and_release || task_ == Task::release_pull_and_lock;
  }
  Reach& reach(bool down) { return reach_[down ? 0 : 1]; }
  static Scalar mix(Scalar a, Scalar b, Scalar part) { return part >= 1 ? b : a + part * (b - a); }
  static Scalar smaller(Scalar a, Scalar b) { return b < a ? b : a; }
  // An error beyond which nothing is looked at, where there is one that is known.
  static Scalar enough(Scalar error) {
    return smaller(Scalar(1), is_rigid ? error : Scalar(1.5) * error + Scalar(0.05));
  }

  Status go_back() {
    const auto known = [this](int j) {
      return rho_[j] < 0 ? JointFriction<Real>() : JointFriction<Real>{rho_[j], 0, Real(0)};
    };
    return tracker_.restore(*condensed_, known, start_);
  }
  void look() {
    here_.force = static_cast<Scalar>(tracker_.loads().jack[cable_][end_].force);
    for (int i = 0; i < segments(); ++i) here_.tension[i] = tracker_.tension(i);
    if (!(seating_ > 0) && !(goal_.most_stroke > 0)) return;
    here_.extension = tracker_.slip_state().extension[cable_][end_];
    const int segment = model().cables[cable_].end_segment(end_);
    here_.stroke = static_cast<Scalar>(here_.extension * tracker_.unstrained(cable_, segment));
  }

  // From task to task.

  void explore(Task task) {
    task_ = task;
    turn_ = second_ = from_;
    reach(goes_down()) = {unreachable, from_, Scalar(0)};
    leg_ = Leg::begins;
  }
  /// The turns of a move, each followed by the other one.
  void search(Task task) {
    task_ = task;
    const Reach& turns = reach(!goes_down());
    search_.begin(from_, turns.end, steeper * turns.steepest, tolerance);
    search_.take(from_, reach(goes_down()).value);
  }
  void find_turn() {
    while (!search_.next(turn_)) {
      if (task_ == Task::release_and_pull) return end();
      if (seating_ > 0) return search_two_turns();
      search(Task::release_and_pull);
    }
    second_ = turn_;
    leg_ = Leg::begins;
  }
  void search_two_turns() {
    task_ = Task::release_pull_and_lock;
    releases_.begin(from_, reach(true).end, steeper * steepest(), coarse, most_releases);
    leg_ = Leg::begins;
    if (!find_release()) end();
  }
  /// The next release, and the first pull that follows it.
  bool find_release() {
    if (!releases_.next(turn_)) return false;
    search_.begin(turn_, reach(false).end, steeper * steepest(), coarse, most_pulls);
    return search_.next(second_);
  }
  Scalar steepest() { return larger(reach(true).steepest, reach(false).steepest); }
  void find_second_turn() {
    leg_ = Leg::begins;
    if (search_.next(second_)) return;
    releases_.take(turn_, search_.least());
    if (!find_release()) end();
  }
  void end_leg() {
    if (task_ == Task::release) {
      reach(true).value = value_;
      explore(Task::pull);
    } else if (task_ == Task::pull) {
      reach(false).value = value_;
      search(Task::pull_and_release);
      find_turn();
    } else if (task_ == Task::release_pull_and_lock) {
      search_.take(second_, value_);
      find_second_turn();
    } else {
      search_.take(turn_, value_);
      find_turn();
    }
  }
  void end() { task_ = Task::done; }

  // From event to event.

  void go() {
    if (leg_ == Leg::begins) return begin_leg();
    const Point before = here_;
    sample_.jack[cable_][end_].force = leg_ == Leg::to_turn     ? turn_
                                       : leg_ == Leg::to_second ? second_
                                       : goes_down()            ? Scalar(0)
                                                                : larger(turn_, most_force_);
    const Progress<Scalar> progress = tracker_.advance(sample_, 1);
    look();
    const bool arrives = progress.status.ok() && progress.fraction >= 1;
    const bool goes_on = progress.status.ok() && ++points_ < most_leg;
    if (leg_ != Leg::from_turn) {
      if (arrives) return begin_move();
      if (!goes_on) end_leg();
      return;
    }
    if (take_piece(before) && !arrives && goes_on) return;
    // What would be drawn in beyond that leaves no force.
    if (arrives && seating_ > 0 && goes_down() && value_ >= unreachable)
      value_ = off_target(&here_.tension[0], &goal_.target[0], segments());
    end_leg();
  }
  void begin_leg() {
    value_ = unreachable;
    leg_ = Leg::begins;
    // It was good before.
    static_cast<void>(go_back().ok());
    look();
    begin_move();
  }
  /// The next one that goes anywhere.
  void begin_move() {
    points_ = 0;
    if (leg_ == Leg::begins && turn_ != from_) {
      leg_ = Leg::to_turn;
    } else if (leg_ < Leg::to_second && second_ != turn_) {
      leg_ = Leg::to_second;
    } else {
      leg_ = Leg::from_turn;
      turned_ = here_.extension;
      passed_.clear();
      if (seating_ > 0) passed_.add({here_.force, static_cast<Scalar>(here_.extension)});
    }
  }
  /// Looks at the way from `before` to here. False if what follows is of no use.
  bool take_piece(const Point& before) {
    if (seating_ > 0) passed_.add({here_.force, static_cast<Scalar>(here_.extension)});
    const Scalar most = part_within_limits(before), least = part_drawn_in(before);
    if (least <= most && (goes_down() || !(seating_ > 0))) {
      // With both turns given, there is one place where the wedge holds.
      const bool is_held = task_ == Task::release_pull_and_lock;
      const auto nearest = nearest_part(&before.tension[0], &here_.tension[0], &goal_.target[0], segments(),
                                        least, is_held ? least : most);
      take(before, nearest, least);
      if (is_held) return false;
    }
    if (explores() && !extend_reach(before, most)) return false;
    return most >= 1 && (explores() || !is_beyond());
  }
  void take(const Point& before, const NearestPart<Scalar>& nearest, Scalar least) {
    value_ = smaller(value_, nearest.error);
    if (task_ == Task::release_pull_and_lock) return take(turn_, second_, before, nearest);
    Scalar back = mix(before.force, here_.force, nearest.part);
    if (seating_ > 0)
      back = nearest.part > least || least == 0
                 ? force_at(static_cast<Scalar>(seating_ + before.extension +
                                                static_cast<Real>(nearest.part) *
                                                    (here_.extension - before.extension)))
                 : turn_;
    take(turn_, back, before, nearest);
  }
  void take(Scalar first, Scalar second, const Point& before, const NearestPart<Scalar>& nearest) {
    const int count = (first != from_ ? 1 : 0) + (second != first ? 1 : 0);
    if (!(nearest.error + worth(count) < best_.error + worth(best_.count))) return;
    best_.count = count;
    best_.force = {first != from_ ? first : second, count == 2 ? second : Scalar(0)};
    best_.error = nearest.error;
    for (int i = 0; i < segments(); ++i)
      best_.tension[i] = mix(before.tension[i], here_.tension[i], nearest.part);
  }
  Scalar worth(int moves) const { return static_cast<Scalar>(moves) * goal_.worth_a_move; }
  /// Of this release, where the jack had so much extension.
  Scalar force_at(Scalar extension) const {
    for (int k = 1; k < passed_.size(); ++k) {
      const Passed &from = passed_[k - 1], &to = passed_[k];
      if (to.extension <= extension && from.extension > extension)
        return mix(from.force, to.force, (from.extension - extension) / (from.extension - to.extension));
    }
    return turn_;
  }

  /// The part of a piece on which no limit is passed further than it is already.
  Scalar part_within_limits(const Point& before) const {
    Scalar most = 1;
    const auto heed = [&most](Scalar from, Scalar to, Scalar limit) {
      if (limit > 0 && to > limit && to > from)
        most = smaller(most, larger(Scalar(0), (limit - from) / (to - from)));
    };
    for (int i = 0; i < segments(); ++i)
      heed(before.tension[i], here_.tension[i], just_below * goal_.most_tension);
    heed(before.stroke, here_.stroke, just_below * goal_.most_stroke);
    return most;
  }
  /// The part of a piece of a release behind which a wedge has been drawn in by the seating; above 1: none.
  Scalar part_drawn_in(const Point& before) const {
    const Real most = turned_ - seating_;
    if (!(seating_ > 0) || before.extension <= most) return 0;
    if (!(here_.extension <= most)) return 2;
    return static_cast<Scalar>((before.extension - most) / (before.extension - here_.extension));
  }
  /// Whether some force has gone beyond its target by more than the best place of this leg is off.
  bool is_beyond() const {
    const Scalar most = enough(value_);
    for (int i = 0; i < segments(); ++i) {
      const Scalar off =
          goes_down() ? goal_.target[i] - here_.tension[i] : here_.tension[i] - goal_.target[i];
      if (goal_.target[i] > 0 && off >= most * goal_.target[i]) return true;
    }
    return false;
  }
  /// How far a turn is of use: what a turn leaves as it is then, is off by more than is known to be possible.
  bool extend_reach(const Point& before, Scalar most) {
    const bool down = goes_down();
    const Scalar way = down ? Scalar(-1) : Scalar(1), off = enough(best_.error);
    Scalar end = 0;
    for (int i = 0; i < segments(); ++i) {
      if (!(goal_.target[i] > 0)) continue;
      const Scalar limit = goal_.target[i] * (1 + way * off), left = way * (limit - before.tension[i]),
                   gains = way * (here_.tension[i] - before.tension[i]);
      if (left > 0) end = larger(end, gains > left ? left / gains : Scalar(2));
    }
    const Scalar by = here_.force - before.force, part = smaller(end, most);
    Reach& reached = reach(down);
    if (part > 0 && by != 0)
      for (int i = 0; i < segments(); ++i)
        if (goal_.target[i] > 0)
          reached.steepest = larger(
              reached.steepest, std::fabs((here_.tension[i] - before.tension[i]) / (by * goal_.target[i])));
    reached.end = mix(before.force, here_.force, part);
    return part >= 1;
  }

  // Where it begins, and what is asked for.
  const CondensedType* condensed_ = nullptr;
  State start_;
  FixedArray<Real, Cap::joints> rho_;    // as it is known now; below zero: that of the condensed scene
  Goal goal_ = {{}, 0, 0, 0, false, 0};  // all zeros until begin(): no flash to copy from
  int cable_ = 0;
  std::size_t end_ = 0;
  Scalar from_ = 0, most_force_ = 0;
  Real seating_ = 0;
  int most_events_ = 0;

  // What is being looked at.
  TrackerType tracker_;
  Sample<Scalar, Cap> sample_;
  Task task_ = Task::done;
  Leg leg_ = Leg::begins;
  Point here_;
  Scalar turn_ = 0, second_ = 0;  // where the moves turn
  Real turned_ = 0;               // the extension of the jack at the last turn
  Scalar value_ = 0;              // the least error of this leg
  int points_ = 0, events_ = 0;
  std::array<Reach, 2> reach_;
  Search search_, releases_;
  FixedList<Passed, most_leg + 1> passed_;

  Moves best_;
  Scalar error_now_ = 0;
};

}  // namespace taut
