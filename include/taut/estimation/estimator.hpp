// From jacking loads to the force in every segment, with its standard deviation, and friction on the way.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

#include "taut/estimation/alarms.hpp"
#include "taut/estimation/belief.hpp"
#include "taut/estimation/gathered.hpp"
#include "taut/estimation/knowledge.hpp"
#include "taut/estimation/load_filter.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// An extended Kalman filter on the unknowns of friction around a Tracker that carries their sensitivities.
///
/// The unknowns are constant: one mu a joint, or one factor a cable on the nominal values, with the prior of
/// the scene. The jacks' load cells, conditioned against noise, drive the tracker. A load cell at an anchored
/// end is a measurement
///     y = T(sure) + dT/dF (raw - sure) + dT/dmu (mu - mu_0) + noise,
/// where the noise is that of the cell and, through dT/dF, of the raw jack readings: both independent from
/// sample to sample. What several measurements of one row have in common, the errors of the jacks' readings,
/// is an unknown of that row. When mu has moved so far from where the tracker is linearized that it shows,
/// the tracker is adjusted to it and the measurement is taken again (iterated update; Gelb, Applied Optimal
/// Estimation, 1974, 6.1). With one jack and one such cell, rows between which only the load changes are
/// gathered first, up to sixteen. Where nothing measures mu, the answer is the prior carried through.
///
/// Strain gauges on struts and the strokes of jacks are measurements of the same kind for whoever has them:
/// take_strut(), take_stroke().
///
/// `Parameters` bounds the number of unknowns: one a cable with a shared mu, one a joint otherwise; and
/// `memories` of every jack whose load cell has noise. If there is no room for these, turning points are
/// taken for exact.
template <class CondensedType, int Parameters>
class Estimator {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using TrackerType = Tracker<CondensedType, Parameters>;
  using KnowledgeType = Knowledge<Scalar, Cap>;
  using ReadingsType = Readings<Scalar, Cap>;
  using BeliefType = Belief<Scalar, Parameters, max_jacks<Cap>>;
  /// Friction of a cable whose prior moves a measured number by less than this part of the standard deviation
  /// of its reading is of no account for the reading.
  static constexpr Scalar unseen = Scalar(0.2);
  /// Readings in a row that show that the jack of a locked end pulls less than its wedge holds.
  static constexpr std::uint8_t surely_below = 3;
  /// Turning points of every jack that friction is taken to remember.
  static constexpr int memories = 2;
  static constexpr int most_jacks = max_jacks<Cap>;
  using Factors = FixedArray<Scalar, Cap::loads>;
  using Alarms = FixedList<Alarm, 8 + 4 * Cap::cables + Cap::joints + Cap::segments>;

  /// Begins without loads, with friction as it is known beforehand. Fails with `capacity_exceeded` if there
  /// are more unknown mu than Parameters (the amount is what is missing), and as Tracker::start(). Both must
  /// outlive the estimator.
  Progress<Scalar> start(const CondensedType& condensed, const KnowledgeType& knowledge,
                         const AlarmLimits<Scalar>& limits = {}) {
    const Status known = begin(condensed, knowledge, limits);
    if (!known) return {known, Scalar(0), 0};
    return tracker_.bring_on_prestrain();
  }

  /// Follows the readings of one row. Fails as Tracker::advance() does; then the state is where the path
  /// ended, and the next call goes on from there; with `bad_sample` nothing was done. A reading that is not
  /// finite, or more than the cable can carry, is refused with an alarm.
  Progress<Scalar> advance(const ReadingsType& readings, int event_budget = TrackerType::default_budget) {
    alarms_.clear();
    for (int i = 0; i < patterns(); ++i)
      if (!(std::fabs(readings.sample.factor[i]) <= model_->most_factor[i]))
        return {Status::at(Code::bad_sample, Place::load, i), Scalar(0), 0};
    begin_row();
    Corners corners;
    bool has_more = false;
    for (int k = 0; k < jacks_.size(); ++k) {
      const EndReading<Scalar>& given = of_end(readings.ends, k);
      take_load(k, of_end(readings.sample.jack, k).locked, given, readings.dt, corners);
      has_more |= given.has_stroke | (cells_[k].locked & given.has_force);
    }
    Progress<Scalar> progress;
    if (corners.any() || !goes_along(readings.sample)) {
      learn_gathered();
      begin_row();
      progress = approach(corners, where_to(readings.sample), event_budget);
      if (corners.any() || progress.events > 0) learned_ = 0;
      if (!progress.status || progress.fraction < 1) return progress;
    }
    if (!may_have_turned()) measure_far_ends(readings);
    for (int k = 0; has_more && k < jacks_.size(); ++k) {
      const EndReading<Scalar>& given = of_end(readings.ends, k);
      if (given.has_stroke) compare(k, given.stroke);
      if (given.has_force && cells_[k].locked) watch(k, given.force);
    }
    raise_alarms();
    return progress;
  }

  /// A strain gauge on a strut, read together with the last row: its axial force [N], tension positive, with
  /// the standard deviation `sd` > 0 of the reading. `rows` are those of the condensed scene; a strut has the
  /// number of the scene. After an advance() that came to its end and before save(); as often as there are
  /// gauges. alarms() has then what is odd about it too: Alarm::Kind::strut, and nothing has changed, or
  /// `no_information`.
  void take_strut(const CondensedStruts<Scalar, Cap>& rows, int strut, Scalar reading, Scalar sd) {
    const auto carried = [&](const auto& elongations) {
      Real sum = 0;
      for (int i = 0; i < model_->segments; ++i) sum += rows.elongation[i][strut] * elongations[i];
      return sum;
    };
    const auto expect = [&](Expected& expected) {
      const auto& loads = tracker_.loads();
      Real at = loads.prestrain * rows.prestrain[strut] + carried(tracker_.elongations());
      for (int k = 0; k < model_->loads; ++k) at += loads.factor[k] * rows.load[k][strut];
      expected.at = static_cast<Scalar>(at);
      for (int p = 0; p < belief_.in_use(); ++p)
        expected.by_unknown[p] =
            static_cast<Scalar>(carried(tracker_.elongations_by(tracker_.move_sensitivity(p))));
      for (int k = 0; k < jacks_.size(); ++k)
        expected.by_jack[k] = static_cast<Scalar>(
            carried(tracker_.elongations_by(tracker_.move_slope(jacks_[k].cable(), jacks_[k].end))));
    };
    take_measurement(expect, reading, sd, Alarm::of(Alarm::Kind::strut, -1, strut));
  }
  /// The stroke of a jack, read together with the last row: its payout since the start [m], with the standard
  /// deviation `sd` > 0 of the reading and of what the elongation of the cable is uncertain by, that of E A.
  /// A locked end tells nothing. When and how often as take_strut(); what contradicts raises
  /// Alarm::Kind::elongation.
  void take_stroke(int cable, std::size_t end, Scalar reading, Scalar sd) {
    const int jack = jack_at(cable, end);
    if (jack < 0 || cells_[jack].locked) return;
    const auto expect = [&](Expected& expected) {
      const auto of = [&](const auto& moving) { return static_cast<Scalar>(moving.payout[cable][end]); };
      expected.at = of(tracker_.moves());
      for (int p = 0; p < belief_.in_use(); ++p) expected.by_unknown[p] = of(tracker_.move_sensitivity(p));
      for (int k = 0; k < jacks_.size(); ++k)
        expected.by_jack[k] = of(tracker_.move_slope(jacks_[k].cable(), jacks_[k].end));
    };
    take_measurement(expect, reading, sd, Alarm::of(Alarm::Kind::elongation, cable, static_cast<int>(end)));
  }

  /// Force of a segment [N], >= 0.
  Scalar force(int segment) const { return find<false>(segment).force; }
  /// Its standard deviation [N].
  Scalar deviation(int segment) const { return find<true>(segment).deviation; }
  /// Both at once take hardly longer than one.
  struct SegmentForce {
    Scalar force, deviation;
  };
  SegmentForce estimate(int segment) const { return find<true>(segment); }
  /// Friction coefficient of a joint, and its standard deviation.
  Scalar mu(int joint) const {
    const auto nominal = static_cast<Scalar>(knowledge_->mu[joint]);
    const int p = unknown_of_[joint];
    return p < 0 ? nominal : nominal + weight_[joint] * belief_.mean(p);
  }
  Scalar mu_deviation(int joint) const {
    const int p = unknown_of_[joint];
    return p < 0 ? Scalar(0) : weight_[joint] * std::sqrt(belief_.variance(p));
  }
  /// Slips, contact and friction forces, payouts, states and, if their rows are given, strut forces: as
  /// Tracker::respond(), at the best estimate.
  void respond(Response<Scalar, Cap>& response, const CondensedStruts<Scalar, Cap>* struts = nullptr) const {
    tracker_.respond(response, struts);
    for (int i = 0; i < model_->segments; ++i) response.tension[i] = force(i);
    model_->resolve_joints(response);
    for (int k = 0; k < jacks_.size(); ++k)
      of_end(response.payout, k) = payout(k, of_end(response.payout, k));
  }
  /// What is odd about the last row.
  const Alarms& alarms() const { return alarms_; }
  /// The load of a jack as it was conditioned; zero where there is none.
  ConditionedLoad<Scalar> load(int cable, std::size_t end) const {
    const int jack = jack_at(cable, end);
    return jack < 0 ? ConditionedLoad<Scalar>() : cells_[jack].at;
  }
  const TrackerType& tracker() const { return tracker_; }
  int unknowns() const { return belief_.size(); }

  /// A jack and its load cell.
  struct Cell {
    LoadFilter<Scalar> filter;
    ConditionedLoad<Scalar> at{};
    Jack<Scalar> led{};  // where the tracker was led
    Scalar since = 0;    // the reading before
    Scalar raw = 0;
    Scalar first = 0;   // the least load once there is one: which way things slide shows from then on
    Scalar before = 0;  // standard deviation of the load a sample ago
    bool is_new = false, has_locked = false, locked = false;
    Scalar most_payout = 0;  // that it should have had so far
    std::uint8_t below = 0;  // locked: readings in a row that were surely below what the wedge holds
    // Unknown errors of where its load last turned or was locked; the oldest is forgotten next.
    std::array<std::int16_t, memories> memory{};
    int oldest = 0;
  };
  /// All that restore() needs to go on with the same bits, as Tracker::State.
  struct State {
    typename TrackerType::State tracker;
    Factors factor;
    FixedArray<Cell, most_jacks> cells;
    typename BeliefType::Values mean, at;
    typename BeliefType::Covariance covariance;
    Gathered<Scalar> gathered;
    std::uint8_t learned;
  };
  /// Between two rows.
  State save() const {
    return {tracker_.save(), factor_, cells_, belief_.mean(), at_, belief_.covariance(), gathered_, learned_};
  }
  /// Goes on where save() was called on an estimator of the same scene. Fails with `bad_sample` if the state
  /// is none of this scene; then only start() or another restore() may follow.
  Status restore(const CondensedType& condensed, const KnowledgeType& knowledge, const State& state,
                 const AlarmLimits<Scalar>& limits = {}) {
    const Status known = begin(condensed, knowledge, limits);
    if (!known) return known;
    factor_ = state.factor;
    cells_ = state.cells;
    at_ = state.at;
    belief_.restore(state.mean, state.covariance);
    gathered_ = state.gathered;
    learned_ = state.learned;
    set_frictions();
    return tracker_.resume(state.tracker);
  }

 private:
  struct CableEnd {
    std::int16_t number = 0;
    std::uint8_t end = 0;
    // With one cable the compiler knows which.
    int cable() const { return Cap::cables == 1 ? 0 : number; }
  };
  static CableEnd end_of(int cable, std::size_t end) {
    return {static_cast<std::int16_t>(cable), static_cast<std::uint8_t>(end)};
  }
  /// What belongs to the end where jack `k` is.
  template <class Ends>
  auto& of_end(Ends& ends, int k) const {
    return ends[jacks_[k].cable()][jacks_[k].end];
  }
  /// Its number, or -1.
  int jack_at(int cable, std::size_t end) const {
    for (int k = 0; k < jacks_.size(); ++k)
      if (jacks_[k].cable() == cable && jacks_[k].end == end) return k;
    return -1;
  }
  /// Zero at compile time where the capacity is.
  int patterns() const { return Cap::loads == 0 ? 0 : model_->loads; }

  Status begin(const CondensedType& condensed, const KnowledgeType& knowledge,
               const AlarmLimits<Scalar>& limits) {
    model_ = &condensed;
    knowledge_ = &knowledge;
    limits_ = limits;
    limits_forces_ = limits.most_force >= 0 || limits.least_force >= 0;
    alarms_.clear();
    jacks_.clear();
    for_each_jacked_end(condensed.cables, [&](int c, std::size_t end) { jacks_.add(end_of(c, end)); });
    gathered_ = {};
    learned_ = 0;
    mu_is_fine_ = false;
    tracker_.begin(condensed);
    for (int j = 0; j < Cap::joints; ++j) can_slide_[j] = j < condensed.joints && !condensed.is_locked(j);
    factor_.fill(Scalar(0));
    for (int k = 0; k < jacks_.size(); ++k) {
      cells_[k] = {};
      cells_[k].filter.start(of_end(knowledge.sensor_sd, k));
    }
    const Status known = find_unknowns();
    find_far_ends();
    return known;
  }
  /// Where a load cell has something to say.
  void find_far_ends() {
    far_.clear();
    for (int c = 0; c < model_->cables.size() && belief_.has_friction(); ++c)
      for (std::size_t end = 0; end < 2 && !model_->cables[c].closed; ++end)
        if (model_->cables[c].ends[end] == End::anchored && knowledge_->sensor_sd[c][end] > 0)
          far_.add(end_of(c, end));
    can_gather_ = far_.size() == 1 && jacks_.size() == 1;
  }

  // The unknowns.

  Status find_unknowns() {
    belief_.clear();
    at_.fill(Scalar(0));
    unknown_of_.fill(-1);
    int missing = 0;
    const auto add = [&](Scalar sd) {
      const int p = belief_.add(sd);
      if (p < 0) ++missing;
      return p;
    };
    for (int c = 0; c < model_->cables.size(); ++c) {
      const Scalar sd = knowledge_->mu_sd[c];
      const auto& cable = model_->cables[c];
      Real sum = 0;
      int free = 0;
      for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
        if (model_->is_locked(j)) continue;
        sum += knowledge_->mu[j];
        ++free;
      }
      if (!(sd > 0) || free == 0) continue;
      const bool shared = knowledge_->shared[c];
      const int common = shared ? add(sd) : -1;
      for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
        if (model_->is_locked(j)) continue;
        const int p = shared ? common : add(sd);
        if (p < 0) continue;
        const Real weight = shared && sum > 0 ? knowledge_->mu[j] * static_cast<Real>(free) / sum : Real(1);
        depend(c, j, p, static_cast<Scalar>(weight));
      }
    }
    belief_.end_friction();
    for (std::size_t m = 0; m < memories; ++m)
      for (int k = 0; k < jacks_.size(); ++k) {
        const bool has = of_end(knowledge_->sensor_sd, k) > 0 && belief_.size() < Parameters;
        cells_[k].memory[m] = static_cast<std::int16_t>(has ? add(Scalar(0)) : -1);
      }
    if (missing > 0) return Status::at(Code::capacity_exceeded, Place::none, Parameters, missing);
    return Status::success();
  }
  void depend(int c, int j, int p, Scalar weight) {
    unknown_of_[j] = static_cast<std::int16_t>(p);
    weight_[j] = weight;
    if (!(weight > 0)) return;
    // mu >= 0, and never quite locked.
    const Real most_mu = (knowledge_->capstan[c] ? Real(6) : Real(0.98)) / knowledge_->grip[j];
    const auto nominal = static_cast<Scalar>(knowledge_->mu[j]);
    belief_.bound(p, -nominal / weight, (static_cast<Scalar>(most_mu) - nominal) / weight);
    set_friction(c, j);
  }
  void set_friction(int c, int j) {
    const int p = unknown_of_[j];
    const auto weight = static_cast<Real>(weight_[j]);
    const auto limit = knowledge_->limit(c, j, knowledge_->mu[j] + weight * static_cast<Real>(at_[p]));
    tracker_.set_friction(j, at_[p] == 0 ? model_->rho[j] : limit.rho, p, weight * limit.slope);
  }
  /// Brings the tracker to these values of the unknowns.
  bool linearize_at(const FixedArray<Scalar, Parameters>& values) {
    FixedArray<Scalar, Parameters> change;
    for (int p = 0; p < belief_.in_use(); ++p) {
      change[p] = values[p] - at_[p];
      at_[p] = values[p];
    }
    set_frictions();
    return tracker_.adjust(change).ok();
  }
  void set_frictions() {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
        if (unknown_of_[j] >= 0) set_friction(c, j);
    }
  }
  /// A jack that turns or is locked now: friction will remember the error of its load.
  void remember(int k) {
    Cell& cell = cells_[k];
    const int p = cell.memory[static_cast<std::size_t>(cell.oldest)];
    if (p < 0) return;
    cell.oldest = (cell.oldest + 1) % memories;
    if (belief_.mean(p) != at_[p]) static_cast<void>(linearize_at(belief_.mean()));
    tracker_.turn(p, jacks_[k].cable(), jacks_[k].end);
    at_[p] = 0;
    belief_.renew(p, cell.before);
    mu_is_fine_ = false;
  }

  // The loads.

  /// Where the way to a row is not straight.
  struct Corners {
    bool locks = false, turns = false;
    bool any() const { return locks || turns; }
  };
  /// Conditions a jack's reading.
  void take_load(int k, bool locks, const EndReading<Scalar>& given, Scalar dt, Corners& corners) {
    const Scalar sd = of_end(knowledge_->sensor_sd, k);
    Cell& cell = cells_[k];
    cell.is_new = cell.has_locked = false;
    cell.at.turned = false;
    cell.since += dt;
    if (locks) {
      cell.before = cell.at.sd;
      if (cell.locked) return;
      corners.locks = cell.has_locked = cell.locked = true;
      cell.at.behind = false;
      cell.filter.start(sd);
      cell.below = 0;
      return;
    }
    if (!given.has_force) return;
    // A released end keeps its wedge until a load is read.
    if (cell.locked) {
      cell.filter.start(sd);
      cell.at = {};
      cell.locked = false;
    }
    cell.before = cell.at.sd;
    // Placed there, not on the heap: a copy would read back at once what was just written in parts, and wait.
    new (&cell.at) ConditionedLoad<Scalar>(cell.filter.take(possible(k, given.force), cell.since));
    if (cell.first == 0 && cell.at.load > 0) cell.first = Scalar(1e-3) * sd;
    cell.since = 0;
    cell.raw = given.force;
    cell.is_new = !cell.at.refused;
    corners.turns |= cell.at.turned;
    if (cell.at.refused) alarms_.add(of_jack(Alarm::Kind::outlier, k));
  }
  /// A reading, or none if it is more than the cable can carry.
  Scalar possible(int k, Scalar reading) const {
    const bool is_possible = std::fabs(reading) <= model_->most_force[jacks_[k].cable()];
    return is_possible ? reading : std::numeric_limits<Scalar>::quiet_NaN();
  }
  Alarm of_jack(Alarm::Kind kind, int k) const {
    return Alarm::of(kind, jacks_[k].cable(), static_cast<int>(jacks_[k].end));
  }
  /// Where the tracker is led for a row.
  Scalar load_of(int k) const { return larger(cells_[k].at.sure, cells_[k].first); }
  Sample<Scalar, Cap> where_to(const Sample<Scalar, Cap>& given) const {
    Sample<Scalar, Cap> drive = given;
    for (int k = 0; k < jacks_.size(); ++k) of_end(drive.jack, k) = {load_of(k), cells_[k].locked};
    return drive;
  }
  /// Follows the readings where nothing happens but that a load changes; else false, and nothing was done.
  bool goes_along(const Sample<Scalar, Cap>& given) {
    // With one jack alone the compiler knows what can change.
    if constexpr (most_jacks == 1 && Cap::loads == 0) {
      if (jacks_.empty() || cells_[0].locked) return false;
      const Scalar load = load_of(0);
      if (!tracker_.goes_along(0, load)) return false;
      cells_[0].led.force = load;
    } else {
      const Sample<Scalar, Cap> drive = where_to(given);
      if (!tracker_.goes_along(drive)) return false;
      arrive(drive);
    }
    return true;
  }
  /// Follows the readings where more happens than that a load changes.
  [[gnu::noinline]] Progress<Scalar> approach(const Corners& corners, const Sample<Scalar, Cap>& drive,
                                              int event_budget) {
    Progress<Scalar> progress;
    if (corners.any()) progress = pass(corners, event_budget);
    Sample<Scalar, Cap> to = drive;
    if (progress.status) progress = join(progress, lead(to, event_budget));
    if (!progress.status || progress.fraction < 1)
      arrive(tracker_.loads());
    else
      arrive(to);
    return progress;
  }
  /// The tracker has come to these loads: those of a row, or its own where it came to its end before.
  template <class Loads>
  void arrive(const Loads& loads) {
    for (int i = 0; i < patterns(); ++i) factor_[i] = static_cast<Scalar>(loads.factor[i]);
    for (int k = 0; k < jacks_.size(); ++k) {
      const auto& at = of_end(loads.jack, k);
      cells_[k].led = {static_cast<Scalar>(at.force), at.locked};
    }
  }
  /// Leads the tracker to the loads that ends had when they were locked, then to where loads have turned.
  Progress<Scalar> pass(const Corners& corners, int event_budget) {
    Sample<Scalar, Cap> corner;
    for (int i = 0; i < patterns(); ++i) corner.factor[i] = factor_[i];
    for (int k = 0; k < jacks_.size(); ++k) of_end(corner.jack, k) = cells_[k].led;
    Progress<Scalar> progress;
    if (corners.locks) {
      for (int k = 0; k < jacks_.size(); ++k)
        if (cells_[k].has_locked) of_end(corner.jack, k).force = cells_[k].at.load;
      progress = lead(corner, event_budget);
      for (int k = 0; k < jacks_.size(); ++k)
        if (progress.status && cells_[k].has_locked) remember(k);
    }
    if (corners.turns && progress.status) {
      const auto turns = [&](int k) { return !cells_[k].locked && cells_[k].at.turned; };
      for (int k = 0; k < jacks_.size(); ++k)
        if (turns(k)) of_end(corner.jack, k).force = cells_[k].at.turn;
      progress = join(progress, lead(corner, event_budget));
      for (int k = 0; k < jacks_.size(); ++k)
        if (progress.status && turns(k)) remember(k);
    }
    return progress;
  }
  /// Leads the tracker there, two jacks as far as friction holds them.
  Progress<Scalar> lead(Sample<Scalar, Cap>& to, int event_budget) {
    Progress<Scalar> progress = tracker_.advance(to, event_budget);
    for (int count = 0; count < model_->cables.size() && progress.status.code == Code::pulled_through &&
                        reconcile(progress.status.index, to);
         ++count)
      progress = join(progress, tracker_.advance(to, event_budget));
    return progress;
  }
  /// What is sure of two jacks may differ by more than friction holds, although their loads do not: leads the
  /// one that pulls more only as far as friction holds it. False if the loads differ, by more than five
  /// sigma.
  bool reconcile(int c, Sample<Scalar, Cap>& to) const {
    const auto& cable = model_->cables[c];
    auto& jack = to.jack[c];
    const std::size_t more = jack[0].force < jack[1].force ? 1 : 0, less = 1 - more;
    // Well inside, but two jacks on one segment pull alike.
    Scalar carried = cable.joints() == 0 ? Scalar(1) : Scalar(1.02);
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
      carried *= static_cast<Scalar>(tracker_.rho(j));
    const ConditionedLoad<Scalar> larger_load = load(c, more), smaller_load = load(c, less);
    if (smaller_load.load + 5 * smaller_load.sd < carried * (larger_load.load - 5 * larger_load.sd))
      return false;
    jack[more].force = jack[less].force / carried;
    return true;
  }
  static Progress<Scalar> join(const Progress<Scalar>& first, Progress<Scalar> then) {
    then.events += first.events;
    then.fraction *= first.status ? first.fraction : Scalar(1);
    return then;
  }
  /// From where the tracker was led to the best estimate of the load [N].
  Scalar missing(int k) const { return cells_[k].locked ? Scalar(0) : cells_[k].at.load - led_to(k); }
  Scalar led_to(int k) const { return cells_[k].led.force; }
  template <bool HasDeviation>
  SegmentForce find(int segment) const {
    Scalar T = tracker_.tension(segment), variance = 0;
    for (int k = 0; k < jacks_.size(); ++k) {
      // Along the present piece.
      const Cell& cell = cells_[k];
      const Scalar slope = tracker_.slope(k, segment), further = slope * missing(k);
      T += further;
      if (!HasDeviation || cell.locked) continue;
      const Scalar part = slope * cell.at.sd;
      variance += part * part;
      // If it has turned, the force did not follow.
      if (cell.at.behind) variance += further * further;
    }
    if (HasDeviation) {
      variance += belief_.variance_of([&](int p) {
        const Scalar S = tracker_.sensitivity(p, segment);
        T += S * (belief_.mean(p) - at_[p]);
        return S;
      });
    } else {
      for (int p = 0; p < belief_.in_use(); ++p)
        if (belief_.mean(p) != at_[p]) T += tracker_.sensitivity(p, segment) * (belief_.mean(p) - at_[p]);
    }
    return {larger(T, Scalar(0)), HasDeviation ? std::sqrt(larger(variance, Scalar(0))) : Scalar(0)};
  }
  Scalar payout(int k, Scalar of_tracker) const {
    const Scalar dF = missing(k);
    return dF != 0 ? of_tracker + tracker_.payout_slope(jacks_[k].cable(), jacks_[k].end) * dF : of_tracker;
  }

  // The measurements.

  using Expected = typename BeliefType::ExpectedType;

  void begin_row() {
    belief_.begin_row();
    has_gathered_ = false;
  }
  /// The load cells at anchored ends.
  void measure_far_ends(const ReadingsType& readings) {
    const auto reading_at = [&](const CableEnd& end) -> const EndReading<Scalar>& {
      return readings.ends[end.cable()][end.end];
    };
    if (may_gather()) {
      const EndReading<Scalar>& given = reading_at(far_[0]);
      if (given.has_force) gather(given.force);
      return;
    }
    for (const CableEnd& end : far_) {
      const EndReading<Scalar>& given = reading_at(end);
      if (given.has_force) measure(end, given.force);
    }
  }
  void measure(const CableEnd& end, Scalar reading) {
    const Scalar sd = knowledge_->sensor_sd[end.cable()][end.end];
    const auto expect = [&](Expected& expected) { expect_far(end, expected); };
    if (!says_something(expect, sd, sensor(end))) return;
    learn(expect, readings_of_jacks(), {reading, sd, Scalar(0)}, sensor(end));
    count_learned(1);
  }
  /// With a load to go by; what has begun goes on.
  bool may_gather() const {
    return (gathered_.size > 0 || (can_gather_ && room() > 1)) && (cells_[0].is_new || cells_[0].locked);
  }
  /// For readings that are gathered. Soon after something has happened little is known, and what is learned
  /// is worth most.
  int room() const { return learned_ / 4; }
  void count_learned(int readings) {
    constexpr int well_known = 4 * Gathered<Scalar>::capacity;
    if (learned_ < well_known) learned_ = static_cast<std::uint8_t>(learned_ + readings);
  }
  static Alarm sensor(const CableEnd& end) {
    return Alarm::of(Alarm::Kind::sensor, end.cable(), static_cast<int>(end.end));
  }
  /// Where the tracker is.
  void expect_far(const CableEnd& far, Expected& expected) const {
    const int segment = model_->cables[far.cable()].end_segment(far.end);
    expected.at = tracker_.tension(segment);
    for (int p = 0; p < belief_.in_use(); ++p) expected.by_unknown[p] = tracker_.sensitivity(p, segment);
    for (int k = 0; k < jacks_.size(); ++k) expected.by_jack[k] = tracker_.slope(k, segment);
  }
  /// A reading of the only cell at an anchored end, with only one jack.
  void gather(Scalar reading) {
    const Scalar led = led_to(0), load = cells_[0].locked ? led : cells_[0].raw;
    if (gathered_.size == 0 && !begin_gathering(led)) return;
    const Scalar off = gathered_.off_line(load, reading);
    if (!(off * off <= BeliefType::impossible * gathered_.spread)) {
      alarms_.add(sensor(far_[0]));
      return;
    }
    gathered_.add(load, led, off);
    has_gathered_ = true;
    if (gathered_.is_full()) learn_gathered();
  }
  /// False if the cell says nothing at present.
  bool begin_gathering(Scalar led) {
    const Scalar sd = of_far_cell();
    const auto jack = reading_of(0);
    const auto expect = [&](Expected& expected) { expect_far(far_[0], expected); };
    if (!says_something(expect, sd, sensor(far_[0]))) return false;
    gathered_.begin(led + jack.beyond, led, room());
    const Scalar by_jack = expected_.by_jack[0];
    gathered_.slope = by_jack;
    gathered_.level = expected_.at + by_jack * jack.beyond;
    for (int p = 0; p < belief_.in_use(); ++p) {
      const Scalar change = belief_.mean(p) - at_[p];
      if (change == 0) continue;
      gathered_.level += expected_.by_unknown[p] * change;
      gathered_.slope += far_sensitivity_slope(p) * change;
    }
    gathered_.jack_variance = jack.variance;
    gathered_.spread = sd * sd + by_jack * by_jack * jack.variance +
                       belief_.variance_of([&](int p) { return expected_.by_unknown[p]; });
    return true;
  }
  /// Of the only cell at an anchored end.
  Scalar far_sensitivity_slope(int p) const {
    const int segment = model_->cables[far_[0].cable()].end_segment(far_[0].end);
    return tracker_.sensitivity_slope(p, 0, segment);
  }
  Scalar of_far_cell() const { return knowledge_->sensor_sd[far_[0].cable()][far_[0].end]; }
  /// What has been gathered becomes known.
  void learn_gathered() {
    if (gathered_.size == 0) return;
    const Gathered<Scalar> all = gathered_;
    gathered_.size = 0;
    count_learned(all.size);
    const Scalar led = led_to(0), back = all.led() - led;
    const auto expect = [&](Expected& expected) {
      expect_far(far_[0], expected);
      if (back == 0) return;
      for (int p = 0; p < belief_.in_use(); ++p) expected.by_unknown[p] += back * far_sensitivity_slope(p);
    };
    expect(expected_);
    typename BeliefType::JackReadings jacks;
    jacks.add({all.jack() - led, all.jack_variance * all.share()});
    const Scalar sd = of_far_cell();
    learn(expect, jacks, {all.reading(), sd * std::sqrt(all.share()), all.spread}, sensor(far_[0]));
  }
  /// Of something else than a load cell.
  template <class Expect>
  void take_measurement(const Expect& expect, Scalar reading, Scalar sd, const Alarm& contradiction) {
    if (!(sd > 0) || !belief_.has_friction() || may_have_turned()) return;
    // The errors of the jack that they share.
    if (gathered_.size > 0) {
      const bool shares_row = has_gathered_;
      learn_gathered();
      if (!shares_row) begin_row();
    }
    if (says_something(expect, sd, contradiction))
      learn(expect, readings_of_jacks(), {reading, sd, Scalar(0)}, contradiction);
  }
  /// `expected_` has then what expect() tells.
  template <class Expect>
  bool says_something(const Expect& expect, Scalar sd, const Alarm& contradiction) {
    expect(expected_);
    const bool says = slides_where_it_matters(expected_, contradiction.cable, sd);
    if (!says) alarms_.add(Alarm::of(Alarm::Kind::no_information, contradiction.cable, contradiction.place));
    return says;
  }
  typename BeliefType::JackReadings readings_of_jacks() const {
    typename BeliefType::JackReadings jacks;
    for (int k = 0; k < jacks_.size(); ++k) jacks.add(reading_of(k));
    return jacks;
  }
  /// Takes a reading into account. expect() tells what it should be where the tracker is linearized, and
  /// `expected_` has that of the present; `contradiction` is raised if it cannot be.
  template <class Expect>
  void learn(const Expect& expect, const typename BeliefType::JackReadings& jacks,
             const typename BeliefType::Measured& measured, const Alarm& contradiction) {
    belief_.learn_errors(jacks);
    constexpr int most_rounds = 4;
    for (int round = 1;; ++round) {
      if (!belief_.weigh(expected_, at_, jacks, measured)) {
        alarms_.add(contradiction);
        return;
      }
      const bool goes_on = belief_.is_bent() && linearize_at(belief_.mean_to_be()) && round < most_rounds;
      if (!goes_on) {
        belief_.apply();
        mu_is_fine_ = false;
        return;
      }
      expect(expected_);
    }
  }
  typename BeliefType::JackReading reading_of(int k) const {
    const Cell& cell = cells_[k];
    if (cell.locked) return {};
    const Scalar sd = cell.is_new ? of_end(knowledge_->sensor_sd, k) : cell.at.sd;
    return {(cell.is_new ? cell.raw : cell.at.load) - led_to(k), sd * sd};
  }
  /// While some joints stick, what a measurement says depends on which ones do, and that on friction: no
  /// derivative tells. All of `cable` must slide, and of every other one whose friction shows in the number.
  bool slides_where_it_matters(const Expected& expected, int cable, Scalar sd) const {
    for (int c = 0; c < model_->cables.size(); ++c)
      if ((c == cable || shows(c, expected, sd)) && !slides_throughout(c)) return false;
    return true;
  }
  bool shows(int c, const Expected& expected, Scalar sd) const {
    const auto& cable = model_->cables[c];
    Scalar square = 0;
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
      const int p = unknown_of_[j];
      if (p < 0) continue;
      const Scalar part = expected.by_unknown[p] * knowledge_->mu_sd[c];
      square += part * part;
      if (knowledge_->shared[c]) break;
    }
    return square > unseen * sd * (unseen * sd);
  }
  /// Whether friction is at its limit at every joint of the cable that can slide.
  bool slides_throughout(int c) const {
    // With one cable the compiler knows how many there are.
    constexpr bool is_alone = Cap::cables == 1;
    const int first = is_alone ? 0 : model_->cables[c].first_joint;
    const int joints = is_alone ? Cap::joints : model_->cables[c].joints();
    bool sticks = false;
    for (int j = first; j < first + joints; ++j) sticks |= can_slide_[j] & !tracker_.is_at_limit(j);
    return !sticks;
  }
  /// What slides and what sticks is in doubt then.
  bool may_have_turned() const {
    for (int k = 0; k < jacks_.size(); ++k)
      if (cells_[k].at.behind) return true;
    return false;
  }
  // What is odd.

  void compare(int k, Scalar stroke) {
    const auto moves = tracker_.moves();
    const Scalar expected = payout(k, static_cast<Scalar>(of_end(moves.payout, k)));
    Scalar& most = cells_[k].most_payout;
    most = larger(most, std::fabs(expected));
    const Scalar allowed = larger(limits_.least_elongation, limits_.elongation * most);
    if (!(std::fabs(stroke - expected) <= allowed)) alarms_.add(of_jack(Alarm::Kind::elongation, k));
  }
  /// A load cell between the jack and a locked end: when the jack, having surely pulled less, comes to pull
  /// what the end segment has, the wedge is free.
  void watch(int k, Scalar reading) {
    Cell& cell = cells_[k];
    const ConditionedLoad<Scalar> pull = cell.filter.take(possible(k, reading), cell.since);
    cell.since = 0;
    if (pull.refused) return;
    const int segment = model_->cables[jacks_[k].cable()].end_segment(jacks_[k].end);
    const Scalar held = force(segment);
    if (cell.below == surely_below) {
      if (pull.load < held) return;
      cell.below = 0;
      alarms_.add(of_jack(Alarm::Kind::lift_off, k));
      return;
    }
    const Scalar missing = held - pull.load;
    const bool is_below = missing > Scalar(0.01) * held && missing > 4 * (pull.sd + deviation(segment));
    cell.below = static_cast<std::uint8_t>(is_below ? cell.below + 1 : 0);
  }
  void raise_alarms() {
    if (!mu_is_fine_ && belief_.has_friction()) judge_friction();
    if (limits_forces_) judge_forces();
  }
  void judge_friction() {
    mu_is_fine_ = true;
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      const Scalar sd = knowledge_->mu_sd[c];
      for (int k = 0; k < cable.joints(); ++k) {
        const int j = cable.first_joint + k, p = unknown_of_[j];
        if (p < 0) continue;
        const bool shared = knowledge_->shared[c];
        const Scalar off = weight_[j] * belief_.mean(p), beyond = std::fabs(off) - 2 * sd * weight_[j];
        if (beyond > 0 && beyond > 2 * mu_deviation(j)) {
          mu_is_fine_ = false;
          alarms_.add(Alarm::of(off > 0 && !shared ? Alarm::Kind::stuck_joint : Alarm::Kind::mu_band, c,
                                shared ? -1 : k));
        }
        if (shared) break;
      }
    }
  }
  void judge_forces() {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      for (int i = 0; i < cable.segments(); ++i) {
        const Scalar T = force(cable.first_segment + i);
        if (limits_.most_force >= 0 && T > limits_.most_force)
          alarms_.add(Alarm::of(Alarm::Kind::force_high, c, i));
        if (limits_.least_force >= 0 && T < limits_.least_force)
          alarms_.add(Alarm::of(Alarm::Kind::force_low, c, i));
      }
    }
  }

  const CondensedType* model_ = nullptr;
  const KnowledgeType* knowledge_ = nullptr;
  AlarmLimits<Scalar> limits_;
  TrackerType tracker_;
  Factors factor_;                            // of the load patterns, where the tracker was led
  FixedList<CableEnd, most_jacks> jacks_;     // in the order in which the tracker counts them
  FixedList<CableEnd, 2 * Cap::cables> far_;  // anchored ends whose load cell is known
  FixedArray<Cell, most_jacks> cells_;
  Alarms alarms_;

  BeliefType belief_;
  Gathered<Scalar> gathered_;
  std::uint8_t learned_ = 0;  // readings of the far end since something has happened
  bool can_gather_ = false;   // the readings of the far end
  bool limits_forces_ = false;
  bool has_gathered_ = false;  // in this row
  bool mu_is_fine_ = false;    // nothing is odd about what is believed
  Expected expected_;  // of the last measurement; a member, so that what is not in use need not be cleared
  FixedArray<bool, Cap::joints> can_slide_;
  FixedArray<std::int16_t, Cap::joints> unknown_of_;
  FixedArray<Scalar, Cap::joints> weight_;  // of the unknown in mu
  typename BeliefType::Values at_;          // where the tracker is linearized
};

}  // namespace taut
