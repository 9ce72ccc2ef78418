// From jacking loads to the force in every segment, with its standard deviation, and friction on the way.
#pragma once

#include <array>
#include <cmath>

#include "taut/estimation/alarms.hpp"
#include "taut/estimation/knowledge.hpp"
#include "taut/estimation/load_filter.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// An extended Kalman filter on the unknowns of friction around a Tracker that carries their sensitivities.
///
/// The unknowns are constant: one mu a joint, or one factor a cable on the nominal values, with the prior of
/// the scene. The jacks' load cells, conditioned against noise, drive the tracker. A load cell at an anchored
/// end is a measurement
///     y = T(sure) + dT/dF (raw - sure) + dT/dmu (mu - mu_0) + noise,
/// where the noise is that of the cell and, through dT/dF, of the raw jack readings: both independent from
/// sample to sample. When mu has moved so far from where the tracker is linearized that it shows, the
/// tracker is adjusted to it and the measurement is taken again (iterated update; Gelb, Applied Optimal
/// Estimation, 1974, 6.1). Where nothing measures mu, the answer is the prior carried through.
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
  /// The tracker is adjusted to the estimate when the measured force is off its linearization by half of this
  /// part of its standard deviation.
  static constexpr Scalar bent = Scalar(0.2);
  /// Turning points of every jack that friction is taken to remember.
  static constexpr int memories = 2;
  using Alarms = FixedList<Alarm, 8 + 4 * Cap::cables + Cap::joints>;

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
  /// ended; with `bad_sample` nothing was done. A reading that is not finite is refused with an alarm.
  Progress<Scalar> advance(const ReadingsType& readings, int event_budget = TrackerType::default_budget) {
    alarms_.clear();
    for (int i = 0; i < model_->loads; ++i)
      if (!std::isfinite(readings.sample.factor[i]))
        return {Status::at(Code::bad_sample, Place::load, i), Scalar(0), 0};
    Sample<Scalar, Cap> before = drive_, turn = readings.sample, goal = readings.sample;
    const bool locks = take_loads(readings, before);
    bool turns = false;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const Cell& cell = cells_[c][end];
      const ConditionedLoad<Scalar>& at = cell.at;
      goal.jack[c][end] = {larger(at.sure, cell.first), cell.locked};
      turn.jack[c][end] = drive_.jack[c][end];
      if (cell.locked || !at.turned) return;
      turn.jack[c][end].force = at.turn;
      turns = true;
    });
    turn.factor = drive_.factor;
    Progress<Scalar> progress;
    if (locks) progress = lead(before, event_budget);
    if (progress.status) remember([](const Cell& cell) { return cell.has_locked; });
    if (turns && progress.status) progress = join(progress, lead(turn, event_budget));
    if (progress.status) remember([](const Cell& cell) { return !cell.locked && cell.at.turned; });
    if (progress.status) progress = join(progress, lead(goal, event_budget));
    // What is sure of two jacks may differ by more than friction holds, although their loads do not.
    if (progress.status.code == Code::pulled_through) {
      for_each_jacked_end(model_->cables,
                          [&](int c, std::size_t end) { goal.jack[c][end].force = cells_[c][end].at.load; });
      progress = join(progress, lead(goal, event_budget));
    }
    if (!progress.status || progress.fraction < 1) return progress;
    drive_ = goal;
    for (int c = 0; c < model_->cables.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& cable = model_->cables[c];
        const EndReading<Scalar>& given = readings.ends[c][end];
        if (!cable.closed && cable.ends[end] == End::anchored && given.has_force)
          measure(c, end, given.force);
        if (!cable.closed && cable.ends[end] == End::jacked && given.has_stroke)
          compare(c, end, given.stroke);
      }
    }
    raise_alarms();
    return progress;
  }

  /// Force of a segment [N], >= 0.
  Scalar force(int segment) const {
    Scalar T = tracker_.tension(segment) + ahead(segment);
    for (int p = 0; p < unknowns_; ++p) T += tracker_.sensitivity(p, segment) * (mean_[p] - at_[p]);
    return T > 0 ? T : Scalar(0);
  }
  /// Its standard deviation [N].
  Scalar deviation(int segment) const {
    FixedArray<Scalar, Parameters> S;
    for (int p = 0; p < unknowns_; ++p) S[p] = tracker_.sensitivity(p, segment);
    Scalar variance = 0;
    for (int p = 0; p < unknowns_; ++p)
      for (int q = 0; q < unknowns_; ++q) variance += S[p] * covariance_[p][q] * S[q];
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const Cell& cell = cells_[c][end];
      if (cell.locked) return;
      const Scalar slope = tracker_.slope(c, end, segment), part = slope * cell.at.sd;
      variance += part * part;
      // If it has turned, the force did not follow.
      const Scalar behind = cell.is_behind() ? slope * (cell.at.load - cell.at.sure) : Scalar(0);
      variance += behind * behind;
    });
    return std::sqrt(variance > 0 ? variance : Scalar(0));
  }
  /// Friction coefficient of a joint, and its standard deviation.
  Scalar mu(int joint) const {
    const auto nominal = static_cast<Scalar>(knowledge_->mu[joint]);
    const int p = unknown_of_[joint];
    return p < 0 ? nominal : nominal + weight_[joint] * mean_[p];
  }
  Scalar mu_deviation(int joint) const {
    const int p = unknown_of_[joint];
    return p < 0 ? Scalar(0) : weight_[joint] * std::sqrt(covariance_[p][p]);
  }
  /// Slips, contact and friction forces, payouts, states and, if their rows are given, strut forces: as
  /// Tracker::respond(), at the best estimate.
  void respond(Response<Scalar, Cap>& response, const CondensedStruts<Scalar, Cap>* struts = nullptr) const {
    tracker_.respond(response, struts);
    for (int i = 0; i < model_->segments; ++i) response.tension[i] = force(i);
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      for (int k = 0; k < cable.joints(); ++k) {
        const int j = cable.first_joint + k;
        const auto sides = cable.joint_segments(k);
        const Scalar T1 = response.tension[sides[0]], T2 = response.tension[sides[1]];
        response.contact[j] = (T1 + T2) * model_->cos_alpha[j];
        response.friction[j] = (T2 - T1) * model_->sin_alpha[j];
      }
    }
    for_each_jacked_end(model_->cables,
                        [&](int c, std::size_t end) { response.payout[c][end] = payout(c, end); });
  }
  /// What is odd about the last row.
  const Alarms& alarms() const { return alarms_; }
  /// The load of a jack as it was conditioned.
  const ConditionedLoad<Scalar>& load(int cable, std::size_t end) const { return cells_[cable][end].at; }
  const TrackerType& tracker() const { return tracker_; }
  int unknowns() const { return unknowns_; }

  /// A jack's load cell.
  struct Cell {
    LoadFilter<Scalar> filter;
    ConditionedLoad<Scalar> at{};
    Scalar since = 0;  // the reading before
    Scalar raw = 0;
    Scalar first = 0;   // the least load once there is one: which way things slide shows from then on
    Scalar way = 1;     // that the load goes: up or down
    Scalar before = 0;  // standard deviation of the load a sample ago
    bool is_new = false;
    bool locked = false, has_locked = false;
    // Unknown errors of where its load last turned or was locked; the oldest is forgotten next.
    std::array<std::int16_t, memories> memory{};
    int oldest = 0;

    /// Whether the load is behind where it surely was, without being known to have turned.
    bool is_behind() const { return !locked && (at.load - at.sure) * way < 0; }
  };
  /// All that restore() needs to go on with the same bits, as Tracker::State.
  struct State {
    typename TrackerType::State tracker;
    Sample<Scalar, Cap> drive;
    FixedArray<std::array<Cell, 2>, Cap::cables> cells;
    FixedArray<Scalar, 2 * Cap::cables> most_payout;
    FixedArray<Scalar, Parameters> mean, at;
    FixedArray<FixedArray<Scalar, Parameters>, Parameters> covariance;
  };
  State save() const { return {tracker_.save(), drive_, cells_, most_payout_, mean_, at_, covariance_}; }
  /// Goes on where save() was called on an estimator of the same scene. Fails with `bad_sample` if the state
  /// is none of this scene; then only start() or another restore() may follow.
  Status restore(const CondensedType& condensed, const KnowledgeType& knowledge, const State& state,
                 const AlarmLimits<Scalar>& limits = {}) {
    const Status known = begin(condensed, knowledge, limits);
    if (!known) return known;
    drive_ = state.drive;
    cells_ = state.cells;
    most_payout_ = state.most_payout;
    mean_ = state.mean;
    at_ = state.at;
    covariance_ = state.covariance;
    set_frictions();
    return tracker_.resume(state.tracker);
  }

 private:
  Status begin(const CondensedType& condensed, const KnowledgeType& knowledge,
               const AlarmLimits<Scalar>& limits) {
    model_ = &condensed;
    knowledge_ = &knowledge;
    limits_ = limits;
    alarms_.clear();
    tracker_.begin(condensed);
    drive_ = {};
    most_payout_.fill(Scalar(0));
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        cells_[c][end] = {};
        cells_[c][end].filter.start(knowledge.sensor_sd[c][end]);
      }
    return find_unknowns();
  }

  // The unknowns.

  Status find_unknowns() {
    unknowns_ = 0;
    covariance_ = {};
    mean_.fill(Scalar(0));
    at_.fill(Scalar(0));
    unknown_of_.fill(-1);
    int missing = 0;
    const auto add = [&](Scalar sd) {
      if (unknowns_ == Parameters) {
        ++missing;
        return -1;
      }
      const Scalar far = std::numeric_limits<Scalar>::max();
      covariance_[unknowns_][unknowns_] = sd * sd;
      least_[unknowns_] = -far;
      most_[unknowns_] = far;
      return unknowns_++;
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
    friction_unknowns_ = unknowns_;
    for (std::size_t m = 0; m < memories; ++m)
      for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
        const bool has = knowledge_->sensor_sd[c][end] > 0 && unknowns_ < Parameters;
        cells_[c][end].memory[m] = static_cast<std::int16_t>(has ? add(Scalar(0)) : -1);
      });
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
    least_[p] = larger(least_[p], -nominal / weight);
    most_[p] = -larger(-most_[p], -(static_cast<Scalar>(most_mu) - nominal) / weight);
    set_friction(c, j);
  }
  void set_friction(int c, int j) {
    const int p = unknown_of_[j];
    const auto weight = static_cast<Real>(weight_[j]);
    const auto limit = knowledge_->limit(c, j, knowledge_->mu[j] + weight * static_cast<Real>(at_[p]));
    tracker_.set_friction(j, at_[p] == 0 ? model_->rho[j] : limit.rho, p, weight * limit.slope);
  }
  /// Brings the tracker to the present estimate.
  bool relinearize() {
    FixedArray<Scalar, Parameters> change;
    for (int p = 0; p < unknowns_; ++p) {
      change[p] = mean_[p] - at_[p];
      at_[p] = mean_[p];
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
  /// Jacks that turn or are locked now: friction will remember the error of their loads.
  template <class Which>
  void remember(Which which) {
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      Cell& cell = cells_[c][end];
      const int p = cell.memory[static_cast<std::size_t>(cell.oldest)];
      if (p < 0 || !which(cell)) return;
      cell.oldest = (cell.oldest + 1) % memories;
      if (mean_[p] != at_[p]) static_cast<void>(relinearize());
      tracker_.turn(p, c, end);
      mean_[p] = at_[p] = 0;
      for (int q = 0; q < unknowns_; ++q) covariance_[p][q] = covariance_[q][p] = 0;
      covariance_[p][p] = cell.before * cell.before;
    });
  }

  // The loads.

  /// Conditions the jacks' readings. Where an end has just been locked, `before` leads to the load it had;
  /// returns whether there is one.
  bool take_loads(const ReadingsType& readings, Sample<Scalar, Cap>& before) {
    bool locks = false;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      Cell& cell = cells_[c][end];
      const EndReading<Scalar>& given = readings.ends[c][end];
      cell.is_new = cell.has_locked = false;
      cell.at.turned = false;
      cell.since += readings.dt;
      if (readings.sample.jack[c][end].locked) {
        cell.has_locked = !cell.locked;
        cell.before = cell.at.sd;
        if (!cell.locked) before.jack[c][end].force = cell.at.load;
        locks = locks || !cell.locked;
        cell.locked = true;
        return;
      }
      // A released end keeps its wedge until a load is read.
      if (cell.locked) {
        if (!given.has_force) return;
        cell.filter.start(knowledge_->sensor_sd[c][end]);
        cell.at = {};
        cell.way = 1;
        cell.locked = false;
      }
      if (!given.has_force) return;
      cell.before = cell.at.sd;
      const Scalar was_sure = cell.at.sure;
      cell.at = cell.filter.take(given.force, cell.since);
      if (cell.at.sure != was_sure) cell.way = cell.at.sure > was_sure ? Scalar(1) : Scalar(-1);
      if (cell.at.load > 0) cell.first = Scalar(1e-3) * knowledge_->sensor_sd[c][end];
      cell.since = 0;
      cell.raw = given.force;
      cell.is_new = !cell.at.refused;
      if (cell.at.refused) alarms_.add(Alarm::of(Alarm::Kind::outlier, c, static_cast<int>(end)));
    });
    return locks;
  }
  /// A path that was not followed to its end is followed by the next call with the same readings.
  Progress<Scalar> lead(const Sample<Scalar, Cap>& sample, int event_budget) {
    return tracker_.advance(sample, event_budget);
  }
  static Progress<Scalar> join(const Progress<Scalar>& first, Progress<Scalar> then) {
    then.events += first.events;
    then.fraction *= first.status ? first.fraction : Scalar(1);
    return then;
  }
  /// From the load that is sure to the best estimate, along the present piece.
  Scalar ahead(int segment) const {
    Scalar T = 0;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const auto& at = cells_[c][end].at;
      if (!cells_[c][end].locked && at.load != at.sure)
        T += tracker_.slope(c, end, segment) * (at.load - at.sure);
    });
    return T;
  }
  Scalar payout(int c, std::size_t end) const {
    const auto moved = static_cast<Scalar>(tracker_.moves().payout[c][end]);
    const auto& at = cells_[c][end].at;
    return cells_[c][end].locked ? moved : moved + tracker_.payout_slope(c, end) * (at.load - at.sure);
  }

  // The measurements.

  /// A load cell at an anchored end.
  void measure(int c, std::size_t end, Scalar reading) {
    const Scalar sd = knowledge_->sensor_sd[c][end];
    if (!(sd > 0) || friction_unknowns_ == 0 || may_have_turned()) return;
    if (!slides_throughout(c)) {
      alarms_.add(Alarm::of(Alarm::Kind::no_information, c, static_cast<int>(end)));
      return;
    }
    const auto mean = mean_;
    const auto covariance = covariance_;
    for (int round = 0; round < 4; ++round) {
      if (!update(model_->cables[c].end_segment(end), reading, sd)) {
        alarms_.add(Alarm::of(Alarm::Kind::sensor, c, static_cast<int>(end)));
        return;
      }
      if (!is_bent_ || !relinearize()) return;
      if (round == 3) return;
      mean_ = mean;
      covariance_ = covariance;
    }
  }
  /// Whether friction is at its limit at every joint of the cable that can slide. While some stick, what a
  /// measurement says depends on which ones do, and that on friction: no derivative tells.
  bool slides_throughout(int c) const {
    const auto& cable = model_->cables[c];
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
      if (!model_->is_locked(j) && !tracker_.is_at_limit(j)) return false;
    return true;
  }
  /// What slides and what sticks is in doubt then.
  bool may_have_turned() const {
    bool any = false;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const Cell& cell = cells_[c][end];
      any = any || cell.is_behind();
    });
    return any;
  }
  /// False if the reading contradicts everything known by more than five sigma; then nothing is changed.
  bool update(int segment, Scalar reading, Scalar sd) {
    Scalar expected = tracker_.tension(segment), noise = sd * sd;
    for_each_jacked_end(model_->cables, [&](int c, std::size_t end) {
      const Cell& cell = cells_[c][end];
      if (cell.locked) return;
      const Scalar slope = tracker_.slope(c, end, segment);
      const Scalar of_jack = cell.is_new ? knowledge_->sensor_sd[c][end] : cell.at.sd;
      expected += slope * ((cell.is_new ? cell.raw : cell.at.load) - cell.at.sure);
      noise += slope * slope * of_jack * of_jack;
    });
    FixedArray<Scalar, Parameters> H, CH;
    for (int p = 0; p < unknowns_; ++p) {
      H[p] = tracker_.sensitivity(p, segment);
      expected += H[p] * (mean_[p] - at_[p]);
    }
    Scalar spread = noise;
    for (int p = 0; p < unknowns_; ++p) {
      CH[p] = 0;
      for (int q = 0; q < unknowns_; ++q) CH[p] += covariance_[p][q] * H[q];
      spread += H[p] * CH[p];
    }
    const Scalar innovation = reading - expected;
    if (!(innovation * innovation <= Scalar(25) * spread)) return false;
    for (int p = 0; p < unknowns_; ++p) {
      mean_[p] += CH[p] / spread * innovation;
      mean_[p] = larger(least_[p], -larger(-most_[p], -mean_[p]));
      for (int q = 0; q < unknowns_; ++q) covariance_[p][q] -= CH[p] * CH[q] / spread;
    }
    // T is about exponential in mu: by shift^2 / 2T it is off the line.
    Scalar shift = 0, left = 0;
    for (int p = 0; p < friction_unknowns_; ++p) {
      shift += std::fabs(H[p] * (mean_[p] - at_[p]));
      for (int q = 0; q < friction_unknowns_; ++q) left += H[p] * covariance_[p][q] * H[q];
    }
    is_bent_ = shift * shift > bent * larger(expected, sd) * std::sqrt(larger(left, Scalar(0)));
    return true;
  }

  // What is odd.

  void compare(int c, std::size_t end, Scalar stroke) {
    const Scalar expected = payout(c, end);
    Scalar& most = most_payout_[2 * c + static_cast<int>(end)];
    most = larger(most, std::fabs(expected));
    const Scalar allowed = larger(limits_.least_elongation, limits_.elongation * most);
    if (!(std::fabs(stroke - expected) <= allowed))
      alarms_.add(Alarm::of(Alarm::Kind::elongation, c, static_cast<int>(end)));
  }
  void raise_alarms() {
    for (int c = 0; c < model_->cables.size(); ++c) {
      const auto& cable = model_->cables[c];
      const Scalar sd = knowledge_->mu_sd[c];
      for (int k = 0; k < cable.joints() && friction_unknowns_ > 0; ++k) {
        const int j = cable.first_joint + k;
        if (unknown_of_[j] < 0) continue;
        const bool shared = knowledge_->shared[c];
        const Scalar off = mu(j) - static_cast<Scalar>(knowledge_->mu[j]), spread = 2 * mu_deviation(j);
        const Scalar band = 2 * sd * weight_[j];
        if (off - spread > band)
          alarms_.add(
              Alarm::of(shared ? Alarm::Kind::mu_band : Alarm::Kind::stuck_joint, c, shared ? -1 : k));
        else if (off + spread < -band)
          alarms_.add(Alarm::of(Alarm::Kind::mu_band, c, shared ? -1 : k));
        if (shared) break;
      }
      for (int i = 0; i < cable.segments() && (limits_.most_force >= 0 || limits_.least_force >= 0); ++i) {
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
  Sample<Scalar, Cap> drive_;  // where the tracker was led
  FixedArray<std::array<Cell, 2>, Cap::cables> cells_;
  FixedArray<Scalar, 2 * Cap::cables> most_payout_;
  Alarms alarms_;

  bool is_bent_ = false;  // the last measurement
  int unknowns_ = 0, friction_unknowns_ = 0;
  FixedArray<std::int16_t, Cap::joints> unknown_of_;
  FixedArray<Scalar, Cap::joints> weight_;       // of the unknown in mu
  FixedArray<Scalar, Parameters> mean_, at_;     // estimate; where the tracker is linearized
  FixedArray<Scalar, Parameters> least_, most_;  // of the unknowns
  FixedArray<FixedArray<Scalar, Parameters>, Parameters> covariance_;
};

}  // namespace taut
