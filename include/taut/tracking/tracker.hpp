// Follows the forces of a condensed scene from sample to sample, from event to event.
#pragma once

#include <cmath>
#include <limits>

#include "taut/condensation/condensed.hpp"
#include "taut/numerics/bits.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/runs.hpp"
#include "taut/status.hpp"
#include "taut/tracking/affine_map.hpp"
#include "taut/tracking/mode_solver.hpp"
#include "taut/tracking/sensitivity.hpp"

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
///
/// With `Parameters`, the derivatives with respect to so many unknowns of the friction are carried along: see
/// Sensitivity and adjust().
template <class CondensedType, int Parameters = 0>
class Tracker {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Loads = Drive<Real, Cap>;
  using Laws = JointLaws<CondensedType, (Parameters > 0)>;
  using Map = AffineMap<CondensedType, Laws>;
  using Derivatives = Sensitivity<CondensedType, Laws, Parameters>;
  using Moving = taut::Moving<Real, Cap>;
  using Tensions = typename Map::Tensions;
  /// Events in one call. Of 300,000 random logs none reached it.
  static constexpr int default_budget = 64 + 16 * Cap::segments;

  /// All that restore() needs to go on with the same bits. A plain value: it may be stored and read back byte
  /// by byte, on the same machine and with the same build.
  struct State : Derivatives::Frozen {
    Loads now, goal, built;
    Moving moved;
    FixedArray<JointState, Cap::joints> slides;
    FixedList<std::int16_t, Cap::joints> order;  ///< joints that slide, as they began
    FixedArray<bool, Cap::segments> slack, rests;
    FixedArray<std::int16_t, Cap::segments> representative;
    FixedArray<bool, Cap::loads> has_load;
    FixedArray<bool, Map::max_inputs> live;
    FixedArray<Real, Map::max_inputs> last;
    FixedArray<Scalar, Map::max_inputs> reach;
    FixedArray<Scalar, Cap::segments> tension;
    Real peak = 0;
    bool has_map = false, arrived = false, has_range = false;
  };

  /// Begins without loads and brings the prestrain on.
  Progress<Scalar> start(const CondensedType& condensed, int event_budget = default_budget) {
    begin(condensed);
    return bring_on_prestrain(event_budget);
  }
  /// The same in two steps, with set_friction() in between: without loads and prestrain.
  void begin(const CondensedType& condensed) {
    model_ = &condensed;
    runs_.find(condensed.cables, [&condensed](int j) { return condensed.is_locked(j); });
    jacks_.clear();
    number_.fill(-1);
    for_each_jacked_end(condensed.cables, [&](int c, std::size_t end) {
      number_[2 * c + static_cast<int>(end)] = static_cast<std::int16_t>(jacks_.add({c, end, -1, false}));
    });
    laws_.find(condensed);
    for (int j = 0; j < joints(); ++j) rho_[j] = static_cast<Scalar>(laws_.rho(j));
    moved_ = {};
    slides_ = {};
    order_.clear();
    last_ = {};
    slack_ = {};
    rests_ = {};
    tension_ = {};
    force_ = {};
    now_ = {};
    goal_ = {};
    built_ = {};
    has_load_ = {};
    goal_.prestrain = 1;
    find_spare();
    map_.begin(condensed);
    drop_set();
    for (int r = 0; r < runs_.size(); ++r)
      representative_[r] = static_cast<std::int16_t>(runs_[r].segment(0));
    if constexpr (is_adjustable) derivatives_.begin();
    drop_map();
    peak_ = 0;
  }
  Progress<Scalar> bring_on_prestrain(int event_budget = default_budget) {
    if (has_prestrain()) return follow(event_budget);
    now_.prestrain = 1;
    arrived_ = true;
    round();
    return {};
  }

  State save() const {
    State state;
    if constexpr (is_adjustable) static_cast<typename Derivatives::Frozen&>(state) = derivatives_.frozen();
    state.now = now_;
    state.goal = goal_;
    state.built = built_;
    state.moved = moved_;
    state.slides = slides_;
    state.order = order_;
    state.slack = slack_;
    state.rests = rests_;
    state.representative = representative_;
    state.has_load = has_load_;
    state.live = live_;
    state.last = last_;
    state.reach = reach_;
    state.tension = tension_;
    state.peak = peak_;
    state.has_map = has_map_;
    state.arrived = arrived_;
    state.has_range = has_range_;
    return state;
  }
  /// Goes on where save() was called on a tracker of the same scene. Fails with `bad_sample` if the state is
  /// none of this scene; then only start() or another restore() may follow.
  Status restore(const CondensedType& condensed, const State& state) {
    begin(condensed);
    return resume(state);
  }
  /// The same after begin() and set_friction().
  Status resume(const State& state) {
    goal_ = state.goal;
    now_ = state.built;
    moved_ = state.moved;
    slides_ = state.slides;
    order_ = state.order;
    slack_ = state.slack;
    rests_ = state.rests;
    representative_ = state.representative;
    has_load_ = state.has_load;
    peak_ = state.peak;
    if constexpr (is_adjustable) derivatives_.set_frozen(state);
    find_spare();
    const Status broken = Status::at(Code::bad_sample, Place::none, -1);
    if (!(peak_ >= 0) || (state.has_map && !(set_up() && make_map()))) return broken;
    now_ = state.now;
    last_ = state.last;
    if (state.has_map)
      find_forces();
    else
      force_ = totals();
    round();
    reach_ = state.reach;
    live_ = state.live;
    sum_up_constant();
    if (state.has_range) find_range();
    tension_ = state.tension;
    arrived_ = state.arrived;
    for (int i = 0; i < model_->segments; ++i)
      if (!std::isfinite(force_[i]) || !std::isfinite(tension_[i])) return broken;
    return Status::success();
  }

  /// Follows the straight path from the present state to the sample. When the event budget is spent
  /// (`fraction` < 1) the state is the equilibrium reached, and a call with the same sample goes on from
  /// there.
  ///
  /// Fails with `bad_sample` (nothing was done), or at `fraction` of the path with `pulled_through` (names
  /// the cable), `mechanism` (names a joint whose sliding sets its node free) or `state_iterations`.
  Progress<Scalar> advance(const Sample<Scalar, Cap>& sample, int event_budget = default_budget) {
    if (goes_along(sample)) return {};
    return approach(sample, event_budget);
  }
  /// The same if one load alone changes and stays where nothing happens: all tensions and derivatives go on
  /// along straight lines. Otherwise false, and nothing is changed.
  bool goes_along(const Sample<Scalar, Cap>& sample) { return only_ >= 0 && stays_in_range(sample); }
  /// The same if the force of this jack alone changes, by its number.
  bool goes_along(int jack, Scalar force) {
    return only_ >= 0 && jacks_[jack].input == only_ && goes_to(force);
  }

  /// The friction of a joint depends on unknown `parameter` from here on, with derivative `slope` of its rho.
  /// At the start, before the first path; see adjust() for later. Not for locked joints.
  void set_friction(int joint, Real rho, int parameter, Real slope) {
    laws_.set_rho(joint, rho);
    rho_[joint] = static_cast<Scalar>(rho);
    derivatives_.depend(joint, parameter, slope);
  }
  /// After set_friction() for other values of the unknowns: brings the present state to what it would be had
  /// they been so all along, `change` of each, to first order. Joints that come to lie outside of their cone
  /// are put on its edge. Fails with `mechanism`; then only start() may follow.
  Status adjust(const FixedArray<Scalar, Parameters>& change) {
    if (!has_map_) return Status::success();
    freeze();
    derivatives_.for_each([&](const auto& derivative, int p) { shift(derivative, change[p]); });
    drop_set();
    for (int count = 0; count <= joints(); ++count) {
      if (!set_up() || !make_map()) return at_joint(Code::mechanism, -1);
      find_forces();
      if (!put_on_edge()) break;
    }
    for (int i = 0; i < model_->segments; ++i) peak_ = larger(peak_, std::fabs(force_[i]));
    round();
    return Status::success();
  }
  /// From here on unknown `p` is an error [N] in the force at which this jack turns now, or is locked: what
  /// friction remembers of it is carried along.
  void turn(int p, int cable, std::size_t end) {
    const int k = input_of(cable, end);
    if (k < 0) return;
    find_forces();
    freeze();
    derivatives_.turn(map_, p, k);
    drop_map();
  }
  /// Derivative of a tension with respect to unknown `p` [N], at the loads reached.
  Scalar sensitivity(int p, int segment) const {
    return !has_map_ ? Scalar(0) : derivatives_.tension(map_, p, segment, at_, anchor_);
  }
  /// Derivative of that with respect to the force of an unlocked jack, on the present piece [-]. Jacks are
  /// counted as for_each_jacked_end() does.
  Scalar sensitivity_slope(int p, int jack, int segment) const {
    const int k = input_of(jack);
    return k < 0 ? Scalar(0) : derivatives_.tension_slope(p, k, segment);
  }
  /// Derivative of a tension with respect to the force of an unlocked jack, on the present piece [-].
  Scalar slope(int jack, int segment) const {
    const int k = input_of(jack);
    return k < 0 ? Scalar(0) : map_.rounded_column(k)[segment];
  }
  /// The same of a jack's payout [m/N].
  Scalar payout_slope(int cable, std::size_t end) const {
    const int k = input_of(cable, end);
    if (k < 0) return 0;
    for (int i = 0; i < map_.active(); ++i)
      if (map_.move(i).kind == Move::Kind::payout && map_.move(i).index == 2 * cable + static_cast<int>(end))
        return static_cast<Scalar>(map_.column_move(k, i));
    return 0;
  }
  /// Derivatives of moves() with respect to unknown `p`, and to the force of an unlocked jack [m/N].
  taut::Moving<Scalar, Cap> move_sensitivity(int p) const {
    if (!has_map_) return {};
    Inputs x;
    values(now_, x);
    return derivatives_.moves(map_, p, x);
  }
  Moving move_slope(int cable, std::size_t end) const {
    Moving moving;
    const int k = input_of(cable, end);
    for (int i = 0; k >= 0 && i < map_.active(); ++i) moving.of(map_.move(i)) = map_.column_move(k, i);
    return moving;
  }
  /// Whether the joint slides, or slid before the load came to rest.
  bool is_at_limit(int joint) const { return slides_[joint] != JointState::stick; }
  /// rho of a joint as it is used now.
  Real rho(int joint) const { return laws_.rho(joint); }

  /// Tension of a segment [N], >= 0.
  Scalar tension(int segment) const { return tension_[segment] > 0 ? tension_[segment] : Scalar(0); }

  /// Slips, payouts and excess lengths at the end of the path followed.
  Moving moves() const {
    Moving moving = moved_;
    if (!has_map_) return moving;
    Inputs x;
    values(now_, x);
    for (int i = 0; i < map_.active(); ++i) moving.of(map_.move(i)) = map_.active_move(i, x);
    for (const JackedEnd& jack : jacks_)
      if (goal_.jack[jack.cable][jack.end].locked)
        moving.payout[jack.cable][jack.end] = now_.jack[jack.cable][jack.end].payout;
    return moving;
  }
  /// Elongations that the moves impose on the segments [m], for CondensedRows.
  Tensions elongations() const { return elongations_by(moves()); }
  /// The same of derivatives of the moves.
  template <class Moved>
  Tensions elongations_by(const Moved& moved) const {
    Tensions e;
    e.fill(Real(0));
    impose(moved, e);
    return e;
  }
  const CondensedType& model() const { return *model_; }
  /// The loads and jack forces reached.
  const Loads& loads() const { return now_; }
  const Runs<Cap>& runs() const { return runs_; }
  bool is_slack(const Run& run) const { return is_slack(run.segment(0)); }
  /// What the joint did on the last piece of the path, apart from slack.
  JointState motion(int joint) const {
    for (int i = 0; has_map_ && i < map_.active(); ++i) {
      if (map_.move(i).kind != Move::Kind::slip || map_.move(i).index != joint) continue;
      const Real rate = map_.move_rate(i, last_);
      if (rate == 0 || slides_[joint] != JointState::stick)
        return rate == 0 ? JointState::stick : slides_[joint];
      return rate > 0 ? JointState::forward : JointState::backward;
    }
    return JointState::stick;
  }
  /// The largest force so far, but for what came and went between two events [N].
  Scalar peak() const {
    Scalar most = static_cast<Scalar>(peak_);
    for (int i = 0; i < model_->segments; ++i) most = larger(most, tension_[i]);
    return most;
  }

  /// The state at the end of the path followed. Forces of struts only if their rows are given.
  void respond(Response<Scalar, Cap>& response, const CondensedStruts<Scalar, Cap>* struts = nullptr) const {
    const Moving moved = moves();
    for (int i = 0; i < model_->segments; ++i) response.tension[i] = tension(i);
    model_->resolve_joints(response);
    for (int c = 0; c < model_->cables.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end)
        response.payout[c][end] = static_cast<Scalar>(moved.payout[c][end]);
      const auto& cable = model_->cables[c];
      for (int k = 0; k < cable.joints(); ++k) {
        const int j = cable.first_joint + k;
        const auto sides = cable.joint_segments(k);
        response.slip[j] = static_cast<Scalar>(moved.slip[j]);
        response.state[j] = is_slack(sides[0]) && is_slack(sides[1]) ? JointState::open : motion(j);
      }
    }
    if (struts == nullptr) return;
    struts->evaluate(*model_, now_, elongations_by(moved), response.strut);
  }

 private:
  using Inputs = typename Map::Inputs;
  using Rounded = typename Map::Rounded;
  using Given = FixedArray<Scalar, Map::max_inputs>;
  using States = FixedArray<JointState, Cap::joints>;
  using Spans = FixedArray<bool, Cap::segments>;

  static constexpr bool is_adjustable = Parameters > 0;
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  /// Forces closer than this part of the largest force so far are equal.
  static constexpr Real tolerance = Real(1e-12);
  /// The same in a sample without an event.
  static constexpr Scalar quick_tolerance = sizeof(Scalar) == sizeof(float) ? Scalar(1e-6) : Scalar(1e-12);

  struct JackedEnd {
    int cable = 0;
    std::size_t end = 0;
    // For samples without an event.
    int input = 0;        ///< its force in the map, or -1
    bool locked = false;  ///< as in the goal
  };

  bool has_prestrain() const {
    for (int i = 0; i < model_->segments; ++i)
      if (model_->prestrain[i] != 0) return true;
    return false;
  }

  Real force_tolerance() const { return tolerance * peak_; }
  bool is_slack(int segment) const { return slack_[runs_.of(segment)]; }
  /// Zero at compile time where the capacity is, so that no code for joints is left.
  int joints() const { return Cap::joints == 0 ? 0 : model_->joints; }
  /// Where there can be only one cable the compiler knows its number.
  static int number_of(int cable) { return Cap::cables == 1 ? 0 : cable; }
  int patterns() const { return Cap::loads == 0 ? 0 : model_->loads; }

  /// Of an unlocked jack's force in the present map, or -1.
  int input_of(int cable, std::size_t end) const {
    const int jack = number_[2 * cable + static_cast<int>(end)];
    return jack < 0 ? -1 : input_of(jack);
  }
  int input_of(int jack) const { return has_map_ ? jacks_[jack].input : -1; }

  /// Not in one frame with the samples that need no more than goes_along().
  [[gnu::noinline]] Progress<Scalar> approach(const Sample<Scalar, Cap>& sample, int event_budget) {
    if (quick(sample)) return {};
    const Status usable = check_sample(*model_, sample);
    if (!usable) return {usable, Scalar(0), 0};
    set_goal(sample);
    for (const JackedEnd& jack : jacks_)
      if (is_spare(jack.cable, jack.end) && !spare_agrees(jack.cable))
        return {Status::at(Code::pulled_through, Place::cable, jack.cable), Scalar(0), 0};
    for (int i = 0; i < model_->loads; ++i) {
      if (has_load_[i] || goal_.factor[i] == now_.factor[i]) continue;
      find_forces();
      freeze();
      drop_map();
    }
    return follow(event_budget);
  }

  // A sample without an event.

  /// Goes to the sample if no state changes on the way; both ends of the straight path within the limits is
  /// enough. Otherwise nothing is changed.
  bool quick(const Sample<Scalar, Cap>& sample) {
    if (!has_map_ || !arrived_ || has_spare_) return false;
    Given x;
    if (!read(sample, x)) return false;
    bool keeps = true, regroups = false, moves = false;
    for (int k = 0; k < map_.inputs(); ++k) {
      if (x[k] == at_[k]) continue;
      // Not a number is neither.
      if (!(std::fabs(x[k]) <= reach_[k] && x[k] >= least_[k])) return false;
      moves = true;
      keeps = keeps && map_.keeps(k, x[k] > at_[k]);
      regroups = regroups || !live_[k];
    }
    if (moves && (!keeps || map_.has_slack()) && !goes_on(x)) return false;
    if (regroups)
      regroup(x);
    else if (!has_range_)
      find_range();
    if (!moves) {
      last_.fill(Real(0));
      return true;
    }
    Rounded T = constant_;
    add_inputs(true, x, T);
    if (!is_within_limits(T)) return false;
    tension_ = T;
    for (int k = 0; k < map_.inputs(); ++k) {
      last_[k] = static_cast<Real>(x[k] - at_[k]);
      if (x[k] == at_[k]) continue;
      go_to(k, x[k]);
    }
    return true;
  }
  /// The same where the only input that changes has a range: false if anything else changes, or it leaves it.
  bool stays_in_range(const Sample<Scalar, Cap>& sample) {
    const int k = only_;
    Scalar x = at_[k];
    for (int n = 0; n < jacks_.size(); ++n) {
      const JackedEnd& jack = jacks_[n];
      const Jack<Scalar>& given = sample.jack[number_of(jack.cable)][jack.end];
      if (given.locked != jack.locked) return false;
      if (jack.input == k)
        x = given.force;
      else if (jack.input >= 0 && given.force != at_[jack.input])
        return false;
    }
    for (int i = 0; i < patterns(); ++i) {
      if (sample.factor[i] == factor_[i]) continue;
      if (load_input_[i] != k) return false;
      x = sample.factor[i];
    }
    return goes_to(x);
  }
  /// Of that input.
  bool goes_to(Scalar x) {
    const int k = only_;
    const Scalar step = x - at_[k];
    if (step != 0) {
      const Scalar dx = x - anchor_[k];
      if (!(dx >= range_[0] && dx <= range_[1]) || !map_.keeps(k, step > 0)) return false;
      const Rounded& column = map_.rounded_column(k);
      // So few are done sooner than counted.
      const int n = Cap::segments <= 16 ? Cap::segments : model_->segments;
      for (int i = 0; i < n; ++i) tension_[i] = constant_[i] + dx * column[i];
      go_to(k, x);
    }
    last_[k] = static_cast<Real>(step);
    return true;
  }
  void go_to(int k, Scalar x) {
    const Input& input = map_.input(k);
    at_[k] = x;
    if (input.kind == Input::Kind::load)
      now_.factor[input.index] = static_cast<Real>(factor_[input.index] = x);
    if (input.kind == Input::Kind::jack_force) {
      const auto end = static_cast<std::size_t>(input.index);
      now_.jack[number_of(static_cast<int>(end / 2))][end % 2].force = static_cast<Real>(x);
    }
  }
  /// What a sample says of the map's inputs; false if it changes anything else.
  bool read(const Sample<Scalar, Cap>& sample, Given& x) const {
    for (int k = 0; k < map_.inputs(); ++k) x[k] = at_[k];
    for (const JackedEnd& jack : jacks_) {
      const Jack<Scalar>& given = sample.jack[jack.cable][jack.end];
      if (given.locked != jack.locked) return false;
      if (jack.input >= 0) x[jack.input] = given.force;
    }
    for (int i = 0; i < model_->loads; ++i) {
      if (load_input_[i] >= 0)
        x[load_input_[i]] = sample.factor[i];
      else if (sample.factor[i] != factor_[i])
        return false;
    }
    return true;
  }
  bool goes_on(const Given& given) const {
    Inputs x, dx;
    for (int k = 0; k < map_.inputs(); ++k) {
      x[k] = static_cast<Real>(given[k]);
      dx[k] = static_cast<Real>(given[k] - at_[k]);
    }
    return map_.goes_on(dx, Real(0)) && map_.stays_slack(x);
  }
  /// Inputs that do not change are added up once.
  void regroup(const Given& x) {
    for (int k = 0; k < map_.inputs(); ++k) live_[k] = x[k] != at_[k];
    forget_range();
    sum_up_constant();
  }
  void forget_range() {
    has_range_ = false;
    only_ = -1;
  }
  void drop_map() {
    has_map_ = false;
    forget_range();
  }
  /// Other moves are at work from here on.
  void drop_set() {
    is_set_up_ = false;
    drop_map();
  }
  /// Where one input alone changes, as in most samples: how far it may go from its anchor within all limits.
  /// Found when a second sample is like the first; from then on a sample asks for nothing else. Where none
  /// changes, as in a hold, that is not far.
  void find_range() {
    has_range_ = true;
    only_ = -1;
    int live = 0;
    for (int k = 0; k < map_.inputs(); ++k)
      if (live_[k]) {
        ++live;
        only_ = k;
      }
    if (live == 0 && map_.inputs() > 0) {
      only_ = 0;
      range_ = {1, -1};
      return;
    }
    // A slack run has limits of its own.
    if (live != 1 || map_.has_slack()) {
      only_ = -1;
      return;
    }
    range_ = {larger(least_[only_], -reach_[only_]) - anchor_[only_], reach_[only_] - anchor_[only_]};
    const Rounded& column = map_.rounded_column(only_);
    for (int j = 0; j < joints(); ++j) {
      const auto& sides = laws_.sides(j);
      for (int way = 0; way < 2; ++way) {
        const int small = sides[static_cast<std::size_t>(way)],
                  big = sides[static_cast<std::size_t>(1 - way)];
        narrow(constant_[small] - rho_[j] * constant_[big] - spare_[j],
               column[small] - rho_[j] * column[big]);
      }
    }
    for (int r = 0; r < runs_.size(); ++r) {
      const int segment = representative_[r];
      narrow(constant_[segment] - least_tension(r), column[segment]);
    }
  }
  /// To where room + dx slope >= 0.
  void narrow(Scalar room, Scalar slope) {
    if (slope > 0) range_[0] = larger(range_[0], -room / slope);
    if (slope < 0) range_[1] = -larger(-range_[1], room / slope);
    if (!(slope > 0) && !(slope < 0) && !(room >= 0)) range_ = {1, -1};
  }
  void sum_up_constant() {
    for (int i = 0; i < model_->segments; ++i) constant_[i] = map_.rounded_base(i);
    add_inputs(false, at_, constant_);
  }
  /// Of those that change, or of the others.
  void add_inputs(bool live, const Given& x, Rounded& T) const {
    for (int k = 0; k < map_.inputs(); ++k) {
      if (live_[k] != live) continue;
      const Scalar dx = x[k] - anchor_[k];
      const Rounded& column = map_.rounded_column(k);
      for (int i = 0; i < model_->segments; ++i) T[i] += dx * column[i];
    }
  }
  /// The friction cones, and T >= 0: with something to spare where a joint sticks or a run is taut, give or
  /// take rounding where a law holds them at the limit.
  bool is_within_limits(const Rounded& T) const {
    if constexpr (Cap::joints > 0) {
      for (const auto& cable : model_->cables)
        if (!are_joints_within(cable, T)) return false;
    }
    for (int r = 0; r < runs_.size(); ++r)
      if (!(T[representative_[r]] >= least_tension(r))) return false;
    return true;
  }
  bool are_joints_within(const CableLayout<Scalar>& cable, const Rounded& T) const {
    const int n = cable.segments();
    const Scalar* const t = T.items.data() + cable.first_segment;
    // The joint after segment i is joint i of an open cable, joint i + 1 of a hoop.
    const int after = cable.first_joint + (cable.closed ? 1 : 0);
    const Scalar* const rho = rho_.items.data() + after;
    const Scalar* const spare = spare_.items.data() + after;
    BitsOf<Scalar> bits = 0;
    for (int i = 0; i + 1 < n; ++i)
      bits |= bits_of(t[i] - rho[i] * t[i + 1] - spare[i]) | bits_of(t[i + 1] - rho[i] * t[i] - spare[i]);
    if (cable.closed) {
      const Scalar closing = rho_[cable.first_joint], left = spare_[cable.first_joint];
      bits |= bits_of(t[n - 1] - closing * t[0] - left) | bits_of(t[0] - closing * t[n - 1] - left);
    }
    return bits >= 0;
  }
  Scalar least_tension(int run) const { return may_be_zero_[run] ? -margin_ : margin_; }
  void set_limits() {
    margin_ = quick_tolerance * static_cast<Scalar>(peak_);
    for (int j = 0; j < joints(); ++j)
      spare_[j] = slides_[j] == JointState::stick && can_slide(j) && !glides(j) ? margin_ : -margin_;
    has_resting_ = false;
    for (int r = 0; r < runs_.size(); ++r) {
      may_be_zero_[r] = slack_[r] || is_jacked(runs_[r]);
      has_resting_ = has_resting_ || rests_[r];
    }
  }

  // From sample to path.

  /// Sets goal_; where a lock changes, also the present drive at the state reached.
  void set_goal(const Sample<Scalar, Cap>& sample) {
    bool changes = false;
    for (const JackedEnd& jack : jacks_)
      changes =
          changes || sample.jack[jack.cable][jack.end].locked != goal_.jack[jack.cable][jack.end].locked;
    if (changes) {
      freeze();
      find_forces();
    }
    const auto force = [this](int c, std::size_t end) { return force_[model_->cables[c].end_segment(end)]; };
    const auto payout = [this](int c, std::size_t end) { return moved_.payout[c][end]; };
    set_path(model_->cables, model_->loads, sample, force, payout, now_, goal_);
    if (!changes) return;
    for (const JackedEnd& jack : jacks_)
      now_.jack[jack.cable][jack.end].locked = goal_.jack[jack.cable][jack.end].locked;
    find_spare();
    // A jack that takes hold of a slack run draws it straight; its payout follows from its force.
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r] && is_jacked(runs_[r])) draw_straight(r);
    drop_set();
  }

  /// Takes the moves where they are, to make another map from.
  void freeze() {
    if (!has_map_) return;
    if constexpr (is_adjustable) {
      Inputs x;
      values(now_, x);
      derivatives_.freeze(map_, x, last_);
    }
    moved_ = moves();
  }
  template <class Derivative>
  void shift(const Derivative& derivative, Scalar change) {
    const auto by = static_cast<Real>(change);
    for (int j = 0; j < joints(); ++j) moved_.slip[j] += by * static_cast<Real>(derivative.slip[j]);
    for (int r = 0; r < runs_.size(); ++r)
      moved_.excess[r] = larger(Real(0), moved_.excess[r] + by * static_cast<Real>(derivative.excess[r]));
    for (const JackedEnd& jack : jacks_) {
      const Real more = by * static_cast<Real>(derivative.payout[jack.cable][jack.end]);
      moved_.payout[jack.cable][jack.end] += more;
      if (!goal_.jack[jack.cable][jack.end].locked) continue;
      for (Loads* loads : {&now_, &goal_, &built_}) loads->jack[jack.cable][jack.end].payout += more;
    }
  }
  /// Whether any joint had to be.
  bool put_on_edge() {
    bool any = false;
    for (int j = 0; j < joints(); ++j) {
      if (slides_[j] != JointState::stick || !can_slide(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward})
        if (laws_.limit(Candidate::of(j, way)).of(force_) < -force_tolerance()) {
          slides_[j] = way;
          order_.add(static_cast<std::int16_t>(j));
          any = true;
        }
    }
    return any;
  }
  /// What a slack run has too much goes out through the jack: over every joint, if that is at its far end.
  void draw_straight(int r) {
    const Run& run = runs_[r];
    const auto& cable = model_->cables[run.cable];
    const bool at_start = run.segment(0) == cable.end_segment(0) && cable.ends[0] == End::jacked &&
                          !goal_.jack[run.cable][0].locked;
    slack_[r] = false;
    const auto straighten = [&](auto& moved) {
      for (int i = 0; !at_start && i < run.joints(); ++i) moved.slip[run.joint(i)] += moved.excess[r];
      moved.excess[r] = 0;
    };
    straighten(moved_);
    if constexpr (is_adjustable) derivatives_.for_each([&](auto& moved, int) { straighten(moved); });
  }

  static Real value(const Input& input, const Loads& loads) {
    if (input.kind == Input::Kind::load) return loads.factor[input.index];
    if (input.kind == Input::Kind::prestrain) return loads.prestrain;
    const auto& jack = loads.jack[input.index / 2][static_cast<std::size_t>(input.index % 2)];
    return input.kind == Input::Kind::jack_force ? jack.force : jack.payout;
  }
  void values(const Loads& loads, Inputs& x) const {
    for (int k = 0; k < map_.inputs(); ++k) x[k] = value(map_.input(k), loads);
  }

  /// A run that ends in an unlocked jack cannot go slack: the jack draws it straight.
  bool is_jacked(const Run& run) const {
    for (const JackedEnd& jack : jacks_)
      if (pulls(jack, run)) return true;
    return false;
  }
  bool pulls(const JackedEnd& jack, const Run& run) const {
    if (jack.cable != run.cable || goal_.jack[jack.cable][jack.end].locked) return false;
    const int segment = model_->cables[jack.cable].end_segment(jack.end);
    return segment == run.segment(0) || segment == run.segment(run.count - 1);
  }
  /// On a cable of one segment with two jacks at work the start's payout rests, and the end's does for both.
  bool is_spare(int c, std::size_t end) const {
    return end == 0 && model_->cables[c].segments() == 1 && model_->cables[c].ends[1] == End::jacked &&
           !goal_.jack[c][0].locked && !goal_.jack[c][1].locked;
  }
  void find_spare() {
    has_spare_ = false;
    for (const JackedEnd& jack : jacks_) has_spare_ = has_spare_ || is_spare(jack.cable, jack.end);
  }
  /// Two jacks on one segment balance only if they pull alike.
  bool spare_agrees(int c) const {
    const Real F0 = goal_.jack[c][0].force, F1 = goal_.jack[c][1].force;
    return std::fabs(F0 - F1) <= Real(64) * tolerance * larger(F0, F1);
  }

  // The map.

  /// Puts the moves of the present states at work, in their order. Where laws imply one another, a node is
  /// held by its cables alone; weak springs then choose among its places, and forces do not depend on them.
  bool set_up() {
    is_set_up_ = add_all(Real(0)) || add_all(held_at_zero);
    return is_set_up_;
  }
  bool add_all(Real held, Real least_pivot = least_pivot_of_all) {
    map_.begin(*model_);
    map_.set().hold(held);
    return add_equalities() && add_slides(least_pivot);
  }
  /// What follows whatever happens: jacks, spans without tension, joints without friction.
  bool add_equalities() {
    for (const JackedEnd& jack : jacks_)
      if (!add_jack(jack.cable, jack.end)) return false;
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r] ? !add_slack_run(r) : rests_[r] && !add_resting_run(r)) return false;
    // Where another law says the same already, there is nothing to add.
    for (int j = 0; j < joints(); ++j)
      if (glides(j) && can_slide(j)) static_cast<void>(map_.set().append(laws_, laws_.gliding(j)));
    return true;
  }
  bool add_slides(Real least_pivot) {
    for (const int j : order_)
      if (!map_.set().append(laws_, laws_.sliding(Candidate::of(j, slides_[j])), least_pivot)) return false;
    return true;
  }
  /// Whether the laws that imply one another agree; if not, a node is free.
  bool is_held(bool totally) const {
    if (!map_.is_held()) return true;
    if (totally) return !(map_.law_violation(laws_, map_.base(), map_.anchor()) > Real(1e-9) * peak_);
    Inputs dx;
    directions(dx);
    Tensions rate;
    map_.tension_rates(dx, rate);
    return !(map_.law_violation(laws_, rate, dx) > Real(1e-9) * larger(push_, peak_));
  }
  /// Makes the map of the moves at work from totals; they must be frozen at the present state.
  bool rebuild() {
    for (int i = 0; i < model_->loads; ++i) has_load_[i] = now_.factor[i] != goal_.factor[i];
    return make_map();
  }
  bool make_map() {
    map_.clear_inputs();
    for (const JackedEnd& jack : jacks_) add_jack_input(jack.cable, jack.end);
    for (int i = 0; i < model_->loads; ++i)
      if (has_load_[i]) map_.add_input(Input::Kind::load, i);
    if (now_.prestrain != goal_.prestrain) map_.add_input(Input::Kind::prestrain, 0);
    typename Map::Moves moves;
    for (int i = 0; i < map_.active(); ++i) moves[i] = moved_.of(map_.move(i));
    Inputs x;
    values(now_, x);
    map_.make(laws_, totals(), moves, x, [this](const auto& settle) { differentiate(settle); });
    has_map_ = true;
    built_ = now_;
    return true;
  }
  template <class Settle>
  void differentiate(const Settle& settle) {
    if constexpr (is_adjustable)
      derivatives_.make(map_, settle, [this](const auto& moved, Tensions& T) { carry(moved, T); });
    else
      static_cast<void>(settle);
  }
  bool add_jack(int c, std::size_t end) {
    if (goal_.jack[c][end].locked || is_spare(c, end)) return true;
    const auto on = static_cast<std::int16_t>(model_->cables[c].end_segment(end));
    return map_.set().append(laws_, {Map::payout_move(*model_, 2 * c + static_cast<int>(end)), on, 0, -1});
  }
  void add_jack_input(int c, std::size_t end) {
    const int index = 2 * c + static_cast<int>(end);
    const auto& start = now_.jack[c][end];
    const auto& goal = goal_.jack[c][end];
    if (!goal.locked && !is_spare(c, end)) map_.add_input(Input::Kind::jack_force, index);
    if (goal.locked && start.payout != goal.payout) map_.add_input(Input::Kind::payout, index);
  }
  /// Its tensions are zero; its slips and its excess length follow. A ring keeps the slip of one joint: it
  /// may turn freely.
  bool add_slack_run(int r) {
    const Run& run = runs_[r];
    for (int i = 0; i < run.count; ++i) {
      const bool last = i == run.count - 1;
      const Move move = last ? Move::of(Move::Kind::excess, r, run.segment(0)) : laws_.slip(run.joint(i));
      if (!map_.set().append(laws_, {move, static_cast<std::int16_t>(run.segment(i)), 0, -1})) return false;
    }
    return true;
  }
  /// Its jacks keep the end segments at zero, its slips all others. Between two jacks the cable may move as a
  /// whole; one joint keeps its place.
  bool add_resting_run(int r) {
    const Run& run = runs_[r];
    bool at_start = false, at_end = false;
    for (const JackedEnd& jack : jacks_) {
      at_start = at_start || (pulls(jack, run) && jack.end == 0);
      at_end = at_end || (pulls(jack, run) && jack.end == 1);
    }
    for (int i = at_start && at_end ? 1 : 0; i < run.joints(); ++i)
      if (!map_.set().append(laws_, {laws_.slip(run.joint(i)),
                                     static_cast<std::int16_t>(run.segment(at_end ? i : i + 1)), 0, -1}))
        return false;
    return true;
  }
  /// Tensions from the present loads and everything that has moved.
  Tensions totals() const { return totals(moved_); }
  Tensions totals(const Moving& moved) const {
    Tensions T;
    T.fill(Real(0));
    for (int i = 0; i < model_->segments; ++i) {
      T[i] = now_.prestrain * model_->prestrain[i];
      for (int k = 0; k < model_->loads; ++k) T[i] += now_.factor[k] * model_->load[k][i];
    }
    carry(moved, T);
    return T;
  }
  /// Adds the tensions that moves make.
  template <class Moved>
  void carry(const Moved& moved, Tensions& T) const {
    model_->coupling.add(model_->segments, elongations_by(moved), T);
  }
  template <class Moved>
  void impose(const Moved& moved, Tensions& e) const {
    for (int j = 0; j < joints(); ++j) laws_.slip(j).impose(static_cast<Real>(moved.slip[j]), e);
    for (const JackedEnd& jack : jacks_)
      e[model_->cables[jack.cable].end_segment(jack.end)] +=
          static_cast<Real>(moved.payout[jack.cable][jack.end]);
    for (int r = 0; r < runs_.size(); ++r)
      if (slack_[r]) e[runs_[r].segment(0)] += static_cast<Real>(moved.excess[r]);
  }

  // From event to event.

  /// What ends a piece of the path: a joint at its limit, a run that goes slack, or one that is taut again.
  struct Ending {
    Candidate next;
    std::int16_t run = -1, excess = -1;  // the run; its active move
    Real falling = 0;                    // rate of what reached zero
    Real step = 1;                       // where, as a part of what was left of the path
  };
  Progress<Scalar> follow(int event_budget) {
    Progress<Scalar> progress;
    find_forces();
    Real rest = 1;  // of the path
    Ending ending;
    int stalled = 0;
    for (;;) {
      measure_path();
      if (further_ == 0) stride_ = 1;
      further_ = 0;
      progress.status = decide(ending);
      if constexpr (is_adjustable) derivatives_.pass();
      if (!progress.status) break;
      bool done = false;
      if (further_ == 0) {
        find_forces();
        const Status broken = follow_piece(ending, rest, done);
        stalled = ending.step > 0 ? 0 : stalled + 1;
        if (!broken || stalled > 8 + 4 * joints()) {
          const int joint = ending.next.joint;
          progress.status = find_further_on(broken ? at_joint(Code::state_iterations, joint) : broken);
          if (!progress.status) break;
        }
      }
      if (further_ > 0) {
        rest *= Real(1) - further_;
        ending = {};
        stalled = 0;
      }
      if (done || ++progress.events >= event_budget) break;
    }
    progress.fraction = static_cast<Scalar>(Real(1) - rest);
    // Rounding must not say that a path came to its end which did not.
    if (rest > 0 && progress.fraction >= Scalar(1))
      progress.fraction = Scalar(1) - std::numeric_limits<Scalar>::epsilon();
    arrived_ = progress.status.ok() && rest == 0;
    round();
    return progress;
  }
  /// Goes along the present piece to its end. If the forces there break a law, the state is the one before.
  Status follow_piece(Ending& ending, Real& rest, bool& done) {
    Inputs dx, x;
    directions(dx);
    const Real step = piece(dx, ending);  // of what is left of the path
    done = Real(1) - step <= Real(4) * epsilon ||
           (Real(1) - step) * change(dx) <= held(ending.next) * force_tolerance();
    const Loads before = now_;
    now_ = Loads::between(now_, goal_, done ? Real(1) : step);
    find_forces();
    const Status status = check_forces();
    if (!status) {
      now_ = before;
      find_forces();
      done = false;
      return status;
    }
    rest = done ? Real(0) : rest * (Real(1) - step);
    for (int i = 0; i < model_->segments; ++i) peak_ = larger(peak_, std::fabs(force_[i]));
    last_ = dx;
    values(now_, x);
    if constexpr (is_adjustable)
      if (!done) meet(ending, x);
    return status;
  }
  /// Whether the forces obey the laws of all moves at work, friction where joints stick, and T >= 0: no state
  /// is shown that was not tested.
  Status check_forces() const {
    Real most = peak_;
    for (int i = 0; i < model_->segments; ++i) most = larger(most, std::fabs(force_[i]));
    const Real least = -Real(8) * tolerance * most;
    const Status broken = map_.is_held() ? free_node() : Status::at(Code::ill_conditioned, Place::none, -1);
    Inputs x;
    values(now_, x);
    if (map_.law_violation(laws_, force_, x) > -least) return broken;
    if (!is_in_equilibrium(rounded_totals * most)) return free_node();
    for (int i = 0; i < model_->segments; ++i)
      if (!(force_[i] >= least)) return broken;
    for (int j = 0; j < joints(); ++j) {
      if (model_->is_locked(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward})
        if (!(laws_.limit(Candidate::of(j, way)).of(force_) >= least)) return broken;
    }
    return Status::success();
  }
  /// Whether the tensions are those of all moves: where slack cables alone hold a node, it goes so far away
  /// that rounding of the moves shows.
  bool is_in_equilibrium(Real tolerated) const {
    const Tensions T = totals(moves());
    for (int i = 0; i < model_->segments; ++i)
      if (!(std::fabs(T[i] - force_[i]) <= tolerated)) return false;
    return true;
  }
  /// What samples without an event start from.
  void round() {
    set_limits();
    load_input_.fill(-1);
    for (JackedEnd& jack : jacks_) {
      jack.input = -1;
      jack.locked = goal_.jack[jack.cable][jack.end].locked;
    }
    for (int i = 0; i < model_->loads; ++i) factor_[i] = static_cast<Scalar>(now_.factor[i]);
    for (int i = 0; i < model_->segments; ++i) tension_[i] = static_cast<Scalar>(force_[i]);
    live_.fill(false);
    forget_range();
    for (int k = 0; k < map_.inputs(); ++k) {
      const Input& input = map_.input(k);
      at_[k] = static_cast<Scalar>(value(input, now_));
      reach_[k] = Scalar(16) * std::fabs(at_[k]);
      anchor_[k] = static_cast<Scalar>(map_.anchor()[k]);
      least_[k] = std::numeric_limits<Scalar>::lowest();
      if (input.kind == Input::Kind::load) {
        load_input_[input.index] = k;
        reach_[k] = -larger(-reach_[k], -model_->most_factor[input.index]);
      }
      if (input.kind == Input::Kind::jack_force) {
        reach_[k] = -larger(-reach_[k], -model_->most_force[input.index / 2]);
        least_[k] = has_resting_ ? std::numeric_limits<Scalar>::infinity() : Scalar(0);
        for (JackedEnd& jack : jacks_)
          if (2 * jack.cable + static_cast<int>(jack.end) == input.index) jack.input = k;
      }
    }
  }
  void find_forces() {
    if (!has_map_) return;
    Inputs x;
    values(now_, x);
    map_.tensions(x, force_);
  }

  /// What a joint that is about to slide holds of the larger force with the smaller one: that little counts.
  Real held(const Candidate& next) const { return next.joint < 0 ? Real(1) : laws_.rho(next.joint); }

  /// What the loads would do with every joint stuck, on what is left of the path, is as large as any force:
  /// it says what is rounding.
  void measure_path() {
    push_ = 0;
    for (int i = 0; i < model_->segments; ++i) {
      peak_ = larger(peak_, force_[i]);
      const auto prestrain = model_->prestrain[i];
      measure(goal_.prestrain * prestrain, (goal_.prestrain - now_.prestrain) * prestrain);
      for (int k = 0; k < model_->loads; ++k) {
        const auto load = model_->load[k][i];
        measure(goal_.factor[k] * load, (goal_.factor[k] - now_.factor[k]) * load);
      }
    }
    for (const JackedEnd& jack : jacks_) {
      const auto& start = now_.jack[jack.cable][jack.end];
      const auto& goal = goal_.jack[jack.cable][jack.end];
      const int segment = model_->cables[jack.cable].end_segment(jack.end);
      measure(goal.force, goal.force - start.force);
      const Real drawn = model_->coupling(segment, segment) * (goal.payout - start.payout);
      measure(drawn, drawn);
    }
  }
  void measure(Real force, Real change) {
    peak_ = larger(peak_, std::fabs(force));
    push_ = larger(push_, std::fabs(change));
  }
  /// Rates of force along the path below this are zero [N]; all of them if the path itself is rounding.
  Real rate_tolerance() const {
    return push_ > epsilon * peak_ ? Real(64) * epsilon * push_ : Real(64) * epsilon * peak_;
  }

  /// Largest change of a tension, or of what a slack run's excess length stands for, along the whole path
  /// [N].
  Real change(const Inputs& dx) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Real most = 0;
    for (int i = 0; i < model_->segments; ++i) most = larger(most, std::fabs(rate[i]));
    for (int i = 0; i < map_.active(); ++i)
      if (map_.move(i).kind == Move::Kind::excess)
        most = larger(most, std::fabs(map_.stiffness(i) * map_.move_rate(i, dx)));
    return most;
  }
  /// What is left of the path.
  void directions(Inputs& dx) const {
    for (int k = 0; k < map_.inputs(); ++k) dx[k] = value(map_.input(k), goal_) - value(map_.input(k), now_);
  }

  /// How far the present piece goes, as a part of what is left of the path.
  Real piece(const Inputs& dx, Ending& ending) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Real step = 1;
    ending = {};
    const auto shorten = [&](Real room, Real falling, const Candidate& next, int run, int excess) {
      // At the limit, and held there by decide(): what is left is rounding.
      if (room <= force_tolerance() && falling >= -Real(16) * rate_tolerance()) return;
      if (falling >= 0 || room > -falling * step) return;
      step = room > 0 ? room / -falling : Real(0);
      ending = {next, static_cast<std::int16_t>(run), static_cast<std::int16_t>(excess), falling, step};
    };
    for (int j = 0; j < joints(); ++j) {
      if (slides_[j] != JointState::stick || !can_slide(j) || glides(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward}) {
        const Candidate candidate = Candidate::of(j, way);
        const Law<Real> limit = laws_.limit(candidate);
        shorten(limit.of(force_), limit.of(rate), candidate, -1, -1);
      }
    }
    for (int r = 0; r < runs_.size(); ++r) {
      const int segment = representative_[r];
      if (!slack_[r]) shorten(force_[segment], rate[segment], {}, r, -1);
    }
    Inputs x;
    values(now_, x);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.move(i).kind == Move::Kind::excess)
        shorten(map_.stiffness(i) * map_.active_move(i, x), map_.stiffness(i) * map_.move_rate(i, dx), {},
                map_.move(i).index, i);
    return step;
  }
  /// How much later the piece would end if friction were other.
  void meet(const Ending& ending, const Inputs& x) {
    if (!(-ending.falling > rate_tolerance())) return;
    if (ending.excess >= 0)
      derivatives_.meet_move(map_, x, ending.excess, ending.falling);
    else if (ending.run >= 0)
      derivatives_.meet(map_, x, force_, Law<Real>::on(representative_[ending.run]), -1, ending.falling);
    else if (ending.next.joint >= 0)
      derivatives_.meet(map_, x, force_, laws_.limit(ending.next), ending.next.joint, ending.falling);
  }
  /// Locked joints never do; in a run without tension they move as they must.
  bool can_slide(int joint) const {
    const int run = runs_.of(laws_.sides(joint)[0]);
    return !model_->is_locked(joint) && !slack_[run] && !rests_[run];
  }

  /// Without friction it slides both ways, and its law always holds.
  bool glides(int joint) const {
    if constexpr (is_adjustable)
      if (derivatives_.depends(joint)) return false;
    return !(laws_.rho(joint) < 1);
  }

  // The states in the next piece.

  using Solver = ModeSolver<CondensedType, Laws>;
  using Candidates = FixedList<Candidate, 2 * Cap::joints>;
  struct Pull {
    const JackedEnd* jack = nullptr;
    Real least = 0;
    bool is_direct = false;  // no joint on the way has friction
  };

  /// Decides what sticks, slides and is slack from here on, and makes the map for it. `ending` is what ended
  /// the piece before.
  Status decide(const Ending& ending) {
    free_joint_ = doubtful_joint_ = -1;
    find_representatives();
    find_resting();
    Spans zero;
    const bool any_zero = find_zero(ending, zero);
    const Candidates candidates = at_limit(ending.next, zero);
    if (!any_zero) {
      // Most often all goes on as it was.
      if (has_map_ && ending.next.joint < 0 && is_consistent(candidates)) return Status::success();
      freeze();
      drop_map();
      if ((is_set_up_ || set_up()) && go_on(candidates)) {
        rebuild();
        return Status::success();
      }
    } else {
      freeze();
    }
    drop_map();
    return begin_anew(zero, candidates);
  }
  /// The segment with the largest tension stands for its span: behind many joints near to self-locking the
  /// others are rounding.
  void find_representatives() {
    for (int r = 0; r < runs_.size(); ++r) {
      int most = runs_[r].segment(0);
      for (int i = 1; i < runs_[r].count; ++i)
        if (force_[runs_[r].segment(i)] > force_[most]) most = runs_[r].segment(i);
      representative_[r] = static_cast<std::int16_t>(most);
    }
  }
  /// A jack at zero that stays there leaves its span slack: no segment has tension, the cable moves over
  /// every joint as the structure does, and what is too long is the jack's.
  void find_resting() {
    for (int r = 0; r < runs_.size(); ++r) {
      bool rests = is_jacked(runs_[r]) && force_[representative_[r]] <= force_tolerance();
      for (const JackedEnd& jack : jacks_)
        if (pulls(jack, runs_[r]))
          rests = rests && now_.jack[jack.cable][jack.end].force <= force_tolerance() &&
                  goal_.jack[jack.cable][jack.end].force <= force_tolerance();
      if (rests == rests_[r]) continue;
      freeze();
      rests_[r] = rests;
      drop_set();
      for (int i = 0; rests && i < runs_[r].joints(); ++i) stop(runs_[r].joint(i));
    }
  }
  void stop(int joint) {
    if (slides_[joint] == JointState::stick) return;
    slides_[joint] = JointState::stick;
    FixedList<std::int16_t, Cap::joints> others;
    for (const std::int16_t each : order_)
      if (each != joint) others.add(each);
    order_ = others;
  }
  /// Spans that are wholly at zero, where what follows is decided from nothing.
  bool find_zero(const Ending& ending, Spans& zero) const {
    bool any = false;
    for (int r = 0; r < runs_.size(); ++r) {
      zero[r] = !rests_[r] && is_at_zero(r, ending);
      any = any || zero[r];
    }
    return any;
  }
  bool is_at_zero(int r, const Ending& ending) const {
    if (!slack_[r]) return force_[representative_[r]] <= force_tolerance();
    const bool closes = ending.excess >= 0 && ending.run == r;
    return closes ||
           excess(r) * model_->coupling(runs_[r].segment(0), runs_[r].segment(0)) <= force_tolerance();
  }
  Real excess(int r) const {
    if (!has_map_) return moved_.excess[r];
    Inputs x;
    values(now_, x);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.move(i).kind == Move::Kind::excess && map_.move(i).index == r) return map_.active_move(i, x);
    return 0;
  }
  /// Whether the rates under the present map agree with its states: v >= 0 where it slides, w >= 0 at the
  /// other limits.
  bool is_consistent(const Candidates& candidates) const {
    Inputs dx;
    directions(dx);
    if (!map_.goes_on(dx, rate_tolerance())) return false;
    Tensions rate;
    map_.tension_rates(dx, rate);
    const Real least = -rate_tolerance();
    for (const Candidate& candidate : candidates)
      if (slides_[candidate.joint] != candidate.way && laws_.limit(candidate).of(rate) < least) return false;
    return true;
  }
  /// Limits that hold: those of joints that slide, the one just reached, and what is as near as rounding. Of
  /// a joint under tension only the nearer one; where a span is at zero, both.
  Candidates at_limit(const Candidate& next, const Spans& zero) const {
    Candidates candidates;
    for (int j = 0; j < joints(); ++j) {
      if (model_->is_locked(j) || glides(j)) continue;
      const auto& sides = laws_.sides(j);
      const int run = runs_.of(sides[0]);
      if (!zero[run] && !can_slide(j)) continue;
      const Candidate ahead = Candidate::of(j, JointState::forward),
                      back = Candidate::of(j, JointState::backward);
      if (zero[run]) {
        candidates.add(ahead);
        candidates.add(back);
        continue;
      }
      if (slides_[j] != JointState::stick) {
        candidates.add(slides_[j] == JointState::forward ? ahead : back);
        continue;
      }
      const Real to_forward = laws_.limit(ahead).of(force_), to_backward = laws_.limit(back).of(force_);
      const Real near = tolerance * larger(force_[sides[0]], force_[sides[1]]) + epsilon * Real(64) * peak_;
      const Candidate& nearer = to_forward <= to_backward ? ahead : back;
      if (next.joint == j)
        candidates.add(next);
      else if (laws_.rho(j) < 1 ? (nearer.way == JointState::forward ? to_forward : to_backward) <= near
                                : true)
        candidates.add(nearer);
      if (!(laws_.rho(j) < 1)) candidates.add(nearer.way == JointState::forward ? back : ahead);
    }
    return candidates;
  }
  /// What a jacked end is to have: the rate of its force, or all of it.
  Real due_at(const JackedEnd& jack, bool totally) const {
    const Real now = now_.jack[jack.cable][jack.end].force;
    return totally ? now : goal_.jack[jack.cable][jack.end].force - now;
  }
  void dues(bool totally, typename Map::Moves& due) const {
    due.fill(Real(0));
    for (int i = 0; i < map_.active(); ++i) {
      const Move& move = map_.move(i);
      if (move.kind == Move::Kind::payout) due[i] = due_at(jacks_[number_[move.index]], totally);
    }
  }
  /// Rates of tension with every joint stuck.
  void stuck_rates(Tensions& rates) const {
    rates.fill(Real(0));
    const Real prestrain = goal_.prestrain - now_.prestrain;
    for (int i = 0; i < model_->segments; ++i) {
      rates[i] = prestrain * model_->prestrain[i];
      for (int k = 0; k < patterns(); ++k)
        rates[i] += (goal_.factor[k] - now_.factor[k]) * model_->load[k][i];
    }
    Tensions e;
    e.fill(Real(0));
    for (const JackedEnd& jack : jacks_) {
      const auto& start = now_.jack[jack.cable][jack.end];
      const auto& goal = goal_.jack[jack.cable][jack.end];
      if (goal.locked) e[model_->cables[jack.cable].end_segment(jack.end)] += goal.payout - start.payout;
    }
    model_->coupling.add(model_->segments, e, rates);
  }
  /// What slides, begun from what slid: an ordinary event is one pivot.
  /// Segments of the spans in `tightening` must then gain tension.
  [[gnu::noinline]] bool go_on(const Candidates& candidates, const Spans* tightening = nullptr) {
    Tensions stuck;
    typename Map::Moves due;
    stuck_rates(stuck);
    dues(false, due);
    Solver solver;
    solver.begin(*model_, laws_, map_.set());
    for (const Candidate& each : candidates) solver.add_slip(each);
    if (solver.solve(stuck, due, rate_tolerance(), true) != Solver::Outcome::solved) {
      remember_ray(solver);
      drop_set();
      return false;
    }
    for (int i = 0; tightening != nullptr && i < model_->segments; ++i)
      if ((*tightening)[runs_.of(i)] && !(solver.rates()[i] > Real(16) * rate_tolerance())) return false;
    read_slides();
    return true;
  }
  /// Where no rate was found: a joint that its node would follow freely, and the last one that was tried.
  void remember_ray(const Solver& solver) {
    const int p = solver.last_pair();
    if (p < 0 || solver.pairs()[p].is_segment()) return;
    doubtful_joint_ = solver.pairs()[p].index;
    if (solver.is_free()) free_joint_ = doubtful_joint_;
  }
  /// Where spans at zero become taut, most often every joint slides toward the jack. Tried first: Lemke's
  /// path goes on from there, and the answer is taken if it gives every segment of these spans tension.
  [[gnu::noinline]] bool pull_straight(const Spans& zero, const Candidates& candidates) {
    const auto slack = slack_;
    const auto slides = slides_;
    const auto order = order_;
    const Moving moved = moved_;
    for (int r = 0; r < runs_.size(); ++r) {
      if (!zero[r]) continue;
      slack_[r] = false;
      moved_.excess[r] = 0;
      for (int i = 0; i < runs_[r].count; ++i)
        if (const Pull pull = pull_on(runs_[r], i, false); pull.jack != nullptr) slide_toward(pull, r, i);
    }
    drop_set();
    is_set_up_ = add_all(Real(0), sound_pivot);
    if (is_set_up_ && go_on(candidates, &zero)) {
      rebuild();
      return true;
    }
    slack_ = slack;
    slides_ = slides;
    order_ = order;
    moved_ = moved;
    free_joint_ = doubtful_joint_ = -1;
    drop_set();
    return false;
  }
  void slide_toward(const Pull& pull, int r, int segment) {
    for_each_joint_toward(*pull.jack, runs_[r], segment, [&](int joint, JointState way) {
      if (glides(joint) || slides_[joint] == way) return;
      if (slides_[joint] == JointState::stick) order_.add(static_cast<std::int16_t>(joint));
      slides_[joint] = way;
    });
  }
  /// What slides and what is slack, begun from nothing. The moves must be frozen.
  Status begin_anew(const Spans& zero, const Candidates& candidates) {
    if (pull_straight(zero, candidates)) return Status::success();
    if (solve_anew(zero, candidates, false)) return Status::success();
    if (const Status why = pulled_through(); !why) return why;
    if (free_joint_ >= 0) return find_further_on(at_joint(Code::mechanism, free_joint_));
    return find_further_on(doubtful_joint_ >= 0 ? at_joint(Code::gives_way, doubtful_joint_) : free_node());
  }
  /// From rates, or from all forces where there are none.
  [[gnu::noinline]] bool solve_anew(const Spans& zero, const Candidates& candidates, bool totally) {
    const auto was_slack = slack_;
    for (int r = 0; r < runs_.size(); ++r)
      if (zero[r]) slack_[r] = false;
    map_.begin(*model_);
    map_.set().hold(held_at_zero);
    is_set_up_ = false;
    bool solved = add_equalities();
    if (solved) {
      Tensions stuck;
      typename Map::Moves due;
      if (totally)
        stuck = totals();
      else
        stuck_rates(stuck);
      dues(totally, due);
      Solver solver;
      solver.begin(*model_, laws_, map_.set());
      for (int r = 0; r < runs_.size(); ++r)
        if (zero[r]) add_span(r, totally, solver);
      for (const Candidate& each : candidates) solver.add_slip(each);
      const Real none = totally ? Real(16) * epsilon * peak_ : rate_tolerance();
      solved = solver.solve(stuck, due, none, false) == Solver::Outcome::solved;
      if (solved)
        adopt(solver, zero, totally);
      else
        remember_ray(solver);
    }
    solved = solved && set_up();
    if (solved) {
      rebuild();
      solved = is_held(totally);
    }
    if (!solved) {
      slack_ = was_slack;
      drop_set();
    }
    return solved;
  }
  /// Rates do not tell how it goes on. All forces, at loads a little further on, are a problem that always
  /// has an answer: it is taken if it is near. If not, friction gives way here, and the structure would jump.
  /// Steps that follow each other grow, eightfold each, as long as they find an answer.
  Status find_further_on(Status why) {
    freeze();
    drop_map();
    for (;;) {
      const bool first = stride_ <= Real(1);
      const Status status = try_further_on(why);
      stride_ = status ? stride_ * Real(8) : Real(1);
      if (status || first) return status;
    }
  }
  Status try_further_on(Status why) {
    const Real least = push_ > 0 ? stride_ * small_step * peak_ / push_ : Real(1);
    const Real step = least < Real(0.5) ? least : Real(0.5);
    const Loads before = now_;
    const Tensions forces = force_;
    const Moving moved = moved_;
    const auto slides = slides_;
    const auto order = order_;
    const auto slack = slack_;
    now_ = Loads::between(now_, goal_, step);
    Spans all;
    for (int r = 0; r < runs_.size(); ++r) {
      all[r] = !rests_[r];
      if (all[r]) moved_.excess[r] = 0;
    }
    Candidates candidates;
    for (int j = 0; j < joints(); ++j) {
      if (model_->is_locked(j) || glides(j) || rests_[runs_.of(laws_.sides(j)[0])]) continue;
      candidates.add(Candidate::of(j, JointState::forward));
      candidates.add(Candidate::of(j, JointState::backward));
    }
    if (solve_anew(all, candidates, true)) {
      find_forces();
      Real farthest = 0;
      for (int i = 0; i < model_->segments; ++i)
        farthest = larger(farthest, std::fabs(force_[i] - forces[i]));
      const bool is_near = farthest <= nearby * peak_;
      if (is_near) why = check_forces();
      if (is_near && why) {
        further_ = step;
        return why;
      }
      if (!is_near && free_joint_ < 0) why = at_joint(Code::gives_way, doubtful_joint_);
    }
    now_ = before;
    moved_ = moved;
    slides_ = slides;
    order_ = order;
    slack_ = slack;
    force_ = forces;
    drop_set();
    return why;
  }
  /// The jack that gives a segment of a span at zero the larger tension, by what friction leaves of its force
  /// on the way; `on_the_way(joint, way)` is called for every joint there.
  Pull pull_on(const Run& run, int i, bool totally) const {
    Pull strongest;
    for (const JackedEnd& jack : jacks_) {
      if (!pulls(jack, run)) continue;
      Pull pull{&jack, due_at(jack, totally), true};
      for_each_joint_toward(jack, run, i, [&](int joint, JointState) {
        pull.least *= laws_.rho(joint);
        pull.is_direct = pull.is_direct && glides(joint);
      });
      if (pull.is_direct) return pull;
      if (strongest.jack == nullptr || pull.least > strongest.least) strongest = pull;
    }
    return strongest;
  }
  template <class Visit>
  void for_each_joint_toward(const JackedEnd& jack, const Run& run, int i, Visit visit) const {
    if (jack.end == 0)
      for (int k = i; k > 0; --k) visit(run.joint(k - 1), JointState::backward);
    else
      for (int k = i; k < run.count - 1; ++k) visit(run.joint(k), JointState::forward);
  }
  /// Segments of a span at zero, but for those that a jack gives their tension; joints without friction make
  /// one of two.
  void add_span(int r, bool totally, Solver& solver) const {
    const Run& run = runs_[r];
    for (int i = 0; i < run.count; ++i) {
      if (i > 0 && glides(run.joint(i - 1))) continue;
      const Pull pull = pull_on(run, i, totally);
      if (!pull.is_direct) solver.add_segment(run.segment(i), larger(Real(0), pull.least));
    }
  }
  /// Takes over what was decided. What a segment of a jacked span has too much goes out through the jack,
  /// over all joints on the way.
  void adopt(const Solver& solver, const Spans& zero, bool totally) {
    for (int r = 0; r < runs_.size(); ++r)
      if (zero[r]) moved_.excess[r] = 0;
    read_slides();
    FixedArray<Real, Cap::joints> flow;
    flow.fill(Real(0));
    for (int p = 0; p < solver.pairs().size(); ++p) {
      const auto& pair = solver.pairs()[p];
      if (!solver.is_active(p)) continue;
      if (!pair.is_segment()) {
        flow[pair.index] += pair.way == JointState::forward ? solver.value(p) : -solver.value(p);
        continue;
      }
      const int r = runs_.of(pair.index);
      int i = 0;
      while (runs_[r].segment(i) != pair.index) ++i;
      const Pull pull = pull_on(runs_[r], i, totally);
      if (pull.jack == nullptr) {
        slack_[r] = true;
        continue;
      }
      for_each_joint_toward(*pull.jack, runs_[r], i, [&](int joint, JointState way) {
        if (glides(joint)) return;
        flow[joint] += way == JointState::forward ? solver.value(p) : -solver.value(p);
        if (slides_[joint] == JointState::stick) order_.add(static_cast<std::int16_t>(joint));
        slides_[joint] = flow[joint] > 0 ? JointState::forward : flow[joint] < 0 ? JointState::backward : way;
      });
    }
    const auto slid = order_;
    order_.clear();
    for (const std::int16_t j : slid) {
      if (slack_[runs_.of(laws_.sides(j)[0])])
        slides_[j] = JointState::stick;
      else
        order_.add(j);
    }
  }
  /// The slips of the set, in its order.
  void read_slides() {
    slides_.fill(JointState::stick);
    order_.clear();
    for (int i = 0; i < map_.active(); ++i) {
      const Active& active = map_.actives()[i];
      if (!active.slides() || active.sense == 0) continue;
      slides_[active.move.index] = active.sense > 0 ? JointState::forward : JointState::backward;
      order_.add(active.move.index);
    }
  }

  /// `pulled_through` if two jacks on one cable differ by all the friction between them, and more so as the
  /// loads go.
  Status pulled_through() const {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      const bool both = !cable.closed && cable.ends[0] == End::jacked && cable.ends[1] == End::jacked &&
                        !goal_.jack[c][0].locked && !goal_.jack[c][1].locked;
      if (!both) continue;
      Real carried = 1;
      for (int k = 0; k < cable.joints(); ++k) carried *= laws_.rho(cable.first_joint + k);
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& small = now_.jack[c][end];
        const auto& big = now_.jack[c][1 - end];
        const Real room = small.force - carried * big.force;
        const Real rate =
            goal_.jack[c][end].force - small.force - carried * (goal_.jack[c][1 - end].force - big.force);
        if (room <= Real(64) * tolerance * larger(small.force, big.force) + epsilon * peak_ && rate < 0)
          return Status::at(Code::pulled_through, Place::cable, c);
      }
    }
    return Status::success();
  }
  /// `mechanism`, at a joint of a span that should hold its node and has no tension.
  Status free_node() const {
    for (int r = 0; r < runs_.size(); ++r)
      if ((slack_[r] || rests_[r]) && runs_[r].joint_near() >= 0)
        return at_joint(Code::mechanism, runs_[r].joint_near());
    return at_joint(Code::mechanism, 0);
  }
  Status at_joint(Code code, int joint) const {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const int j = joint - model_->cables[c].first_joint;
      if (joint >= 0 && j >= 0 && j < model_->cables[c].joints())
        return Status::along(code, Place::joint, c, j);
    }
    return Status::at(code, Place::none, -1);
  }

  struct Nothing {};
  /// Of a segment's own stiffness, in decisions from zero tension.
  static constexpr Real held_at_zero = Real(1e-8);
  /// Pivots of the moves at work, of the largest entry in row and column: none is left; so many digits are
  /// kept.
  static constexpr Real least_pivot_of_all = Real(1e-12), sound_pivot = Real(1e-4);
  /// Of the largest force: what may be lost where a cable moves much further than it stretches.
  static constexpr Real rounded_totals = Real(1e-10);
  /// Of the largest force: how much further on an answer is looked for, and how near it must be.
  static constexpr Real small_step = Real(1e-6), nearby = Real(1e-3);

  const CondensedType* model_ = nullptr;
  std::conditional_t<(Parameters > 0), Derivatives, Nothing> derivatives_;
  Runs<Cap> runs_;
  Laws laws_;
  FixedList<JackedEnd, max_jacks<Cap>> jacks_;
  FixedArray<std::int16_t, 2 * Cap::cables> number_;  // of an end among them, or -1

  Loads now_, goal_;
  Loads built_;                                             // where the map was made
  Moving moved_;                                            // frozen at the anchor of the map
  States slides_;                                           // stick, forward or backward: the law in force
  FixedList<std::int16_t, Cap::joints> order_;              // joints that slide, as they began
  FixedArray<std::int16_t, Cap::segments> representative_;  // of runs: the segment with the largest tension
  bool is_set_up_ = false;                                  // the map's moves are those of these states
  FixedArray<bool, Cap::segments> slack_;                   // of runs
  FixedArray<bool, Cap::segments> rests_;  // of runs: without tension since its jacks are at zero
  Map map_;
  FixedArray<bool, Cap::loads> has_load_;  // as an input
  bool has_map_ = false;
  Tensions force_;  // where the last event, or the last call with events, ended
  Inputs last_;     // direction of the inputs on the last piece
  Real peak_ = 0;
  Real push_ = 0;  // largest change of force that the path would make with every joint stuck [N]

  // For samples without an event.
  Rounded tension_;
  FixedArray<Scalar, Cap::loads> factor_;  // the loads reached
  FixedArray<Scalar, Cap::joints> rho_;
  Rounded constant_;                             // the map's base and all inputs that do not change
  FixedArray<Scalar, Cap::joints> spare_;        // least T_small - rho T_big of every joint
  FixedArray<bool, Cap::segments> may_be_zero_;  // of runs
  Scalar margin_ = 0;                            // what is to be spared where nothing is at its limit
  Given at_, anchor_;
  Given reach_;  // so large forces are still of the order of peak_
  Given least_;  // a jack does not push, and takes a resting run along only in an event
  FixedArray<int, Cap::loads> load_input_;  // in the map, or -1
  FixedArray<bool, Map::max_inputs> live_;  // inputs that do
  // Of the only live input, from its anchor: within all limits.
  std::array<Scalar, 2> range_{};
  int only_ = 0;
  bool has_range_ = false;
  Real stride_ = 1;   // of small steps that follow each other
  Real further_ = 0;  // how far all forces were found anew, as a part of what was left of the path
  int free_joint_ = -1, doubtful_joint_ = -1;
  bool arrived_ = false;
  bool has_spare_ = false;
  bool has_resting_ = false;
};

}  // namespace taut
