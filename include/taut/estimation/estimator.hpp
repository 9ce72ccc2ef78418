// From jacking loads to the force in every segment, with its standard deviation, and friction on the way.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/alarms.hpp"
#include "taut/estimation/drive.hpp"
#include "taut/estimation/far_ends.hpp"
#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/force_watch.hpp"
#include "taut/estimation/friction_filter.hpp"
#include "taut/estimation/friction_prior.hpp"
#include "taut/estimation/gauges.hpp"
#include "taut/estimation/jack_loads.hpp"
#include "taut/estimation/monitoring.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// An extended Kalman filter on the unknowns of friction around a Tracker that carries their sensitivities.
///
/// A row of readings goes through three stages:
/// 1. drive: LoadFilter conditions the jacks' load cells against noise, and the tracker is driven as far as
///    the loads are confirmed to have come, straight on or through corners (drive.hpp);
/// 2. measure: a load cell at an anchored end is compared with its prediction and updates friction (FarEnds,
///    FrictionFilter); where mu has moved far from where the tracker is linearized, that is relinearized;
/// 3. monitor: what is odd raises an alarm (monitoring.hpp).
/// Forces are those of the tracker, carried on to the best estimate of loads and friction
/// (force_estimate.hpp). Where nothing measures mu, the answer is the prior carried through.
///
/// Strain gauges on struts and the strokes of jacks are measurements of the same kind for whoever has them:
/// take_strut(), take_stroke().
///
/// `Parameters` bounds the number of unknowns that forces depend on: one a cable with a shared mu, one a
/// joint otherwise; gain, zero and hysteresis of a jack's load cell where they are not known;
/// `remembered_corners` of every jack whose load cell has noise; the draw-in of its wedge; and the strain
/// that a locked cable takes on by itself. If there is no room for the last three, they are taken for exact.
/// `Further` bounds those that readings alone depend on: gain and zero of cells at anchored ends, and of
/// gauges. See count_unknowns().
///
/// Nothing here may be called from an interrupt while another call is under way; two estimators share
/// nothing.
template <class CondensedType, int Parameters, int Further = 0>
class Estimator : private CondensedType::Capacity::Account {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Account = typename Cap::Account;
  using TrackerType = Tracker<CondensedType, Parameters>;
  using PriorType = FrictionPrior<Scalar, Cap>;
  using ReadingsType = Readings<Scalar, Cap>;
  using FilterType = FrictionFilter<CondensedType, Parameters, Further>;
  /// Loads of a jack that friction is taken to remember: where it reversed, was locked, or rested while one
  /// of so many load patterns changed.
  static constexpr int remembered_corners(int load_patterns) { return load_patterns > 0 ? 3 : 2; }
  using JacksType = JackLoads<Scalar, Cap, remembered_corners(Cap::loads)>;
  /// Where the tracker is driven to, by jack.
  using Drives = FixedArray<Jack<Scalar>, JacksType::capacity>;
  using FarEndsType = FarEnds<FilterType, JacksType>;
  using GaugesType = Gauges<Scalar, Further, Cap::cables>;
  using ForceWatchType = ForceWatch<Scalar, Cap::segments>;
  using NoGauges = FixedList<LoadCell<Scalar>, 0>;
  using Alarms = FixedList<Alarm, 8 + 5 * Cap::cables + Cap::joints + Cap::segments>;

  /// Where the loads are confirmed to have come, while the tracker looks ahead.
  struct Confirmed {
    typename TrackerType::State tracker;
    Drives jack;
  };
  /// All that restore() needs to go on with the same bits, as Tracker::State: a plain value.
  struct State {
    typename TrackerType::State tracker;
    typename JacksType::State jacks;
    typename FilterType::State friction;
    typename FarEndsType::State far_ends;
    typename GaugesType::State gauges;
    Confirmed confirmed;
    bool is_ahead = false;  ///< of what is confirmed; else that has no meaning
    typename ForceWatchType::State forces;
  };

  // Beginning.

  /// Begins without loads, with friction as it is known beforehand. `condensed` and `prior` must outlive
  /// the estimator; `gauges`, a range of LoadCell, are the instruments whose readings take_segment(),
  /// take_strut() and take_stroke() are given. Fails with `capacity_exceeded` if and only if there are more
  /// unknown mu than Parameters, or more gauges, or unknowns of them, than Further (the amount is what is
  /// missing), else as Tracker::start() does. Cost: that of the prestrain.
  Progress<Scalar> start(const CondensedType& condensed, const PriorType& prior,
                         const AlarmLimits<Scalar>& limits = {}) {
    return start(condensed, prior, limits, NoGauges());
  }
  template <class Cells>
  Progress<Scalar> start(const CondensedType& condensed, const PriorType& prior,
                         const AlarmLimits<Scalar>& limits, const Cells& gauges) {
    const Status known = begin(condensed, prior, limits, gauges);
    if (!known) return {known, Scalar(0), 0};
    Account::begin(filter_);
    return tracker_.start(condensed, filter_.friction(linear_part(condensed)), load_errors());
  }
  /// After start(): the loads of these first readings, those of jacks having come down from so high that
  /// every joint slid back, at most 0.99 of what Condensed::most_force allows: the largest forces that any
  /// past of the jacks can have left, see UnknownPast. Fails as advance() does. Cost: two paths.
  Progress<Scalar> come_down(const ReadingsType& first) {
    auto to = first.sample;
    for (int k = 0; k < jacks_.size(); ++k) {
      const EndReading<Scalar>& given = jacks_.in(first.ends, k);
      if (jacks_.in(to.jack, k).locked || !given.has_force || !(given.force > 0) ||
          !(given.force <= most_force(k)))
        continue;
      jacks_[k].come_down(given.force, jacks_.in(filter_.prior().cell, k));
      change_errors(k);
      jacks_.in(to.jack, k).force = jacks_[k].at.load;
    }
    auto above = to;
    for (int k = 0; k < jacks_.size(); ++k) {
      const Scalar held = held_over(tracker_, jacks_.end(k).cable());
      auto& force = jacks_.in(above.jack, k).force;
      const Scalar most = Scalar(0.99) * most_force(k), square = held * held;
      force = Scalar(1.02) * force < most * square ? Scalar(1.02) * force / square : most;
    }
    auto progress = tracker_.advance(above);
    if (progress.status) progress = join(progress, tracker_.advance(to));
    if (progress.status) jacks_.arrive(to, load_patterns(model()));
    return progress;
  }
  /// The state between two rows. Cost: a copy of it.
  State save() const {
    return {tracker_.save(), jacks_.save(), filter_.save(), far_ends_.save(),
            gauges_.save(),  confirmed_,    is_ahead_,      forces_.save()};
  }
  /// Goes on where save() was called on an estimator of the same scene. Fails with `capacity_exceeded` if and
  /// only if start() would, and with `bad_sample` if the state is none of this scene or was saved before
  /// start(); then only start() or another restore() may follow. Cost: that of one event.
  Status restore(const CondensedType& condensed, const PriorType& prior, const State& state,
                 const AlarmLimits<Scalar>& limits = {}) {
    return restore(condensed, prior, state, limits, NoGauges());
  }
  template <class Cells>
  Status restore(const CondensedType& condensed, const PriorType& prior, const State& state,
                 const AlarmLimits<Scalar>& limits, const Cells& gauges) {
    const Status known = begin(condensed, prior, limits, gauges);
    if (!known) return known;
    jacks_.restore(state.jacks);
    filter_.restore(state.friction);
    Account::begin(filter_);
    far_ends_.restore(state.far_ends);
    misfits_ = far_ends_.misfits();
    gauges_.restore(state.gauges);
    forces_.restore(state.forces);
    confirmed_ = state.confirmed;
    is_ahead_ = state.is_ahead;
    return tracker_.restore(condensed, filter_.friction(linear_part(condensed)), state.tracker,
                            load_errors());
  }

  // A row of readings.

  /// Follows the readings of one row. Fails with `bad_sample` if a load factor is not finite or out of range;
  /// then nothing was done. Else fails as Tracker::advance() does; then, or with a fraction below 1, the
  /// state is where the path ended, and the next call goes on from there. A reading that is not finite, or
  /// more than the cable can carry, is refused with an alarm.
  ///
  /// Cost: without an event that of a reading in LoadFilter a jack, and of gathering a reading of the far
  /// end. At worst 4 (1 + cables) paths of `event_budget` events each; for every far end, and once for what
  /// was gathered, an update with four calls of Tracker::adjust(); one such call for every jack that
  /// reversed.
  Progress<Scalar> advance(const ReadingsType& readings, int event_budget = TrackerType::default_budget) {
    alarms_.clear();
    for (int i = 0; i < jacks_.patterns(); ++i)
      if (!(std::fabs(readings.sample.factor[i]) <= model().most_factor[i]))
        return {Status::at(Code::bad_sample, Place::load, i), Scalar(0), 0};
    begin_row();
    Corners<Scalar> corners;
    const bool has_more = condition(readings, corners);
    follow_other_loads(readings.sample, corners);
    if (is_ahead_) follow_ahead(corners, readings.sample);
    for (int k = 0; k < jacks_.size(); ++k)
      if (!jacks_[k].at.reversed) change_branch(k);
    Progress<Scalar> progress{Status::success(), Scalar(1), 0};
    if (!is_ahead_ && (corners.any() || !try_extend(tracker_, jacks_, readings.sample))) {
      learn_waiting();
      begin_row();
      progress = drive(
          tracker_, jacks_, corners, jacks_.target(readings.sample), event_budget,
          [this](int k) { remember_reversal(k); }, [&](int k) { remember_load(k, readings.sample); },
          [this](int c) { return filter_.relative_deviation(tracker_, c); });
      if (corners.any() || progress.events > 0) far_ends_.restart();
      if (!progress.status || progress.fraction < 1) return progress;
      if (corners.locks && remember_seating())
        progress = join(progress, tracker_.advance(jacks_.target(readings.sample), event_budget));
      if (progress.status && corners.locks) progress.status = remember_drift();
      if (!progress.status) return progress;
    }
    if (corners.bends) {
      far_ends_.bend();
      gauges_.bend();
    }
    for (int e = 0; e < far_ends_.ends().size(); ++e) {
      const EndReading<Scalar>& given = far_ends_.ends()[e].in(readings.ends);
      if (can_be(given, far_ends_.ends()[e].cable()))
        corners.times_noise =
            larger(corners.times_noise, far_ends_.watch(e).follow_noise(given.force, readings.dt));
    }
    if (corners.times_noise > 1) filter_.inflate(corners.times_noise);
    if (gauges_.size() > 0) follow_gauges(corners, readings.dt);
    look_ahead();
    for (int c = 0; c < model().cables.size(); ++c)
      if (drifts(c)) filter_.diffuse(drift_[c], c, readings.dt);
    if (!loads_are_in_doubt() && measure_far_ends(readings)) look_ahead();
    if (has_more) check_jacks(readings);
    if (!is_belief_fine_ && filter_.belief().has_friction()) {
      const bool is_friction_fine = check_friction(model().cables, filter_, alarms_);
      is_belief_fine_ = check_gains(model().cables, filter_, limits_, alarms_) && is_friction_fine;
    }
    if (limits_.has_force())
      check_forces(
          model().cables, [this](int i) { return force(i); }, [this](int c) { return is_held(c); }, forces_,
          limits_, alarms_);
    return progress;
  }

  /// A strain gauge on a strut, read together with the last row: its axial force [N], tension positive, with
  /// the standard deviation `sd` > 0 of the reading. `rows` are those of the condensed scene; a strut has the
  /// number of the scene. After an advance() that came to its end and before save(); as often as there are
  /// gauges. While joints stick that matter to it nothing is learned from it; what contradicts raises
  /// Alarm::Kind::strut, and nothing has changed. Cost: an update, with at most four calls of
  /// Tracker::adjust().
  void take_strut(const typename CondensedType::Struts& rows, int strut, Scalar reading, Scalar sd) {
    const auto predict = [&](auto& prediction) {
      predict_strut(tracker_, rows, strut, filter_.belief(), jacks_.ends(), prediction);
    };
    take_measurement(predict, reading, sd, Alarm::of(Alarm::Kind::strut, -1, strut));
  }
  /// The stroke of a jack, read together with the last row: its extension since the start [m], with the
  /// standard deviation `sd` > 0 of the reading and of what the elongation of the cable is uncertain by, that
  /// of E A. A locked end, or one without a jack, tells nothing. After an advance() that came to its end and
  /// before save(), once a jack; what contradicts raises Alarm::Kind::elongation, and nothing has changed.
  /// Cost: an update, with at most four calls of Tracker::adjust().
  void take_stroke(int cable, std::size_t end, Scalar reading, Scalar sd) {
    const int k = jacks_.find(cable, end);
    if (k < 0 || jacks_[k].locked) return;
    const auto predict = [&](auto& prediction) {
      predict_stroke(tracker_, jacks_.end(k), filter_.belief(), jacks_.ends(), prediction);
    };
    take_measurement(predict, reading, sd, alarm_at(Alarm::Kind::elongation, jacks_.end(k)));
  }

  /// The same of instruments with unknowns of their own: numbers in the list that start() was given. Which
  /// readings count is told by Gauges, those while cables surely slide; all may be handed in. What
  /// contradicts raises Alarm::Kind::strut, `elongation`, or `segment` for the measured force of a segment
  /// [N].
  void take_strut(const typename CondensedType::Struts& rows, int strut, Scalar reading, Gauge gauge) {
    const auto predict = [&](auto& prediction) {
      predict_strut(tracker_, rows, strut, filter_.belief(), jacks_.ends(), prediction);
    };
    take_gauge(predict, reading, gauge, Alarm::of(Alarm::Kind::strut, -1, strut));
  }
  void take_stroke(int cable, std::size_t end, Scalar reading, Gauge gauge) {
    const int k = jacks_.find(cable, end);
    if (k < 0 || jacks_[k].locked) return;
    // A mark is made once slack has been taken out.
    if (gauges_.has(gauge) && gauges_.lacks_mark(gauge) && !is_bedded(k)) return;
    const auto predict = [&](auto& prediction) {
      predict_stroke(tracker_, jacks_.end(k), filter_.belief(), jacks_.ends(), prediction);
    };
    take_gauge(predict, reading, gauge, alarm_at(Alarm::Kind::elongation, jacks_.end(k)));
  }
  void take_segment(int segment, Scalar reading, Gauge gauge) {
    if (!gauges_.has(gauge)) return;
    const int c = cable_of(segment);
    const auto predict = [&](auto& prediction) {
      predict_tension(tracker_, segment, filter_.belief(), jacks_.ends(), prediction);
    };
    take_gauge(predict, reading, gauge,
               Alarm::of(Alarm::Kind::segment, c, segment - model().cables[c].first_segment));
  }
  const GaugesType& gauges() const { return gauges_; }

  // The answers.

  /// Force of a segment [N], >= 0, and its standard deviation [N]; both at once take hardly longer than the
  /// deviation alone. Cost: of a force one product a jack and unknown, of a deviation half the square of the
  /// unknowns more.
  Scalar force(int segment) const { return estimate_force<false>(tracker_, jacks_, filter_, segment).force; }
  Scalar deviation(int segment) const { return estimate(segment).deviation; }
  ForceEstimate<Scalar> estimate(int segment) const {
    auto estimate = estimate_force<true>(tracker_, jacks_, filter_, segment);
    if (misfits_) estimate.deviation = widened(estimate.deviation, segment);
    return estimate;
  }
  /// Axial force of a strut [N], tension positive, and its standard deviation [N]; `rows` are those of the
  /// condensed scene, `strut` has the number of the scene. Cost: all that moves along the cables once an
  /// unknown and jack.
  ForceEstimate<Scalar> estimate_strut(const typename CondensedType::Struts& rows, int strut) const {
    if (!tracker_.is_started()) return {};
    return taut::estimate_strut(tracker_, rows, jacks_, filter_, filter_.prior(), strut);
  }
  /// Friction coefficient of a joint, and its standard deviation [-].
  Scalar mu(int joint) const { return tracker_.is_started() ? filter_.mu(joint) : Scalar(0); }
  Scalar mu_deviation(int joint) const { return filter_.mu_deviation(joint); }
  /// The unknown that it depends on, as Capacity::Account counts those of friction, or -1.
  int friction_unknown(int joint) const { return filter_.unknown_of(joint); }
  /// Slips, contact and friction forces, extensions, states and, if their rows are given, strut forces: as
  /// Tracker::respond(), with tensions and extensions at the best estimate. Cost: a force a segment, and that
  /// of Tracker::respond().
  void respond(Response<Scalar, Cap>& response,
               const typename CondensedType::Struts* struts = nullptr) const {
    if (!tracker_.is_started()) return;
    tracker_.respond(response, struts);
    for (int i = 0; i < model().segments; ++i) response.tension[i] = force(i);
    model().resolve_joints(response);
    for (int k = 0; k < jacks_.size(); ++k) {
      Scalar& extension = jacks_.in(response.extension, k);
      extension = estimate_extension(tracker_, jacks_, filter_.belief(), k, extension);
      // A strain is none.
      const int c = jacks_.end(k).cable(), p = drift_[c];
      if (p >= 0 && jacks_[k].locked && filter_.belief().mean(p) != 0)
        extension -= tracker_.extension_sensitivity(p, c, jacks_.end(k).end) * filter_.belief().mean(p);
    }
  }
  /// What is odd about the last row.
  const Alarms& alarms() const { return alarms_; }
  /// The force that a segment has reached at most (at least) beyond a limit [N] while Alarm::Kind::force_high
  /// (force_low) has been raised for it without a break; zero while neither is.
  Scalar peak(int segment) const { return forces_.peak(segment); }
  /// The load of a jack as it was conditioned; zero where there is none.
  ConditionedLoad<Scalar> load(int cable, std::size_t end) const {
    const int k = jacks_.find(cable, end);
    return k < 0 ? ConditionedLoad<Scalar>() : jacks_[k].at;
  }
  const TrackerType& tracker() const { return tracker_; }
  /// Brings another tracker to where the cables are by the best estimate of friction, for who tries what
  /// would follow, as JackPlanner does. Loads are those that the tracker was driven to: gain and zero of the
  /// jacks' load cells are left as they are read. After an advance() that came to its end. Fails as
  /// Tracker::adjust() does; then only start() or restore() of that tracker may follow. Cost: those of
  /// Tracker::save(), restore() and adjust().
  Status bring(TrackerType& other) const {
    const auto& condensed = tracker_.condensed();
    const Status there =
        other.restore(condensed, filter_.friction(linear_part(condensed)), tracker_.save(), load_errors());
    return there ? filter_.bring(other) : there;
  }
  /// The friction that bring() gives it, as a function of the joint that Tracker::restore() takes.
  auto best_friction() const { return filter_.best_friction(linear_part(tracker_.condensed())); }
  /// What was told of every update since start() or restore(); see Capacity::Account.
  const Account& account() const { return *this; }
  int unknowns() const { return filter_.belief().size(); }

 private:
  using EndType = CableEnd<Cap>;

  const auto& model() const { return tracker_.model(); }
  int cable_of(int segment) const {
    int c = 0;
    while (segment >= model().cables[c].first_segment + model().cables[c].segments()) ++c;
    return c;
  }
  static Alarm alarm_at(Alarm::Kind kind, const EndType& at) {
    return Alarm::of(kind, at.cable(), static_cast<int>(at.end));
  }

  template <class Cells>
  Status begin(const CondensedType& condensed, const PriorType& prior, const AlarmLimits<Scalar>& limits,
               const Cells& gauges) {
    const auto& linear = linear_part(condensed);
    limits_ = limits;
    alarms_.clear();
    is_belief_fine_ = is_ahead_ = misfits_ = false;
    forces_.start();
    jacks_.start(linear, prior);
    Status known = filter_.start(linear, prior);
    const auto corners = static_cast<std::size_t>(remembered_corners(load_patterns(linear)));
    for (std::size_t m = 0; m < corners; ++m)
      for (int k = 0; k < jacks_.size(); ++k) {
        const bool has_noise = jacks_.in(prior.cell, k).sd > 0;
        jacks_[k].memory[m] = static_cast<std::int16_t>(has_noise ? filter_.add_load_error() : -1);
      }
    for (int c = 0; c < linear.cables.size(); ++c)
      drift_[c] = static_cast<std::int16_t>(prior.drift_sd[c] > 0 ? filter_.add_load_error() : -1);
    for (int k = 0; k < jacks_.size(); ++k) {
      const bool is_uncertain = prior.seating_sd[jacks_.end(k).cable()] > 0;
      jacks_[k].seating = static_cast<std::int16_t>(is_uncertain ? filter_.add_load_error() : -1);
    }
    if (known) known = filter_.end(linear, [&](const auto& add) { return gauges_.start(gauges, add); });
    far_ends_.start(linear, filter_, jacks_);
    return known;
  }
  /// The unknowns that forces of jacks depend on.
  FixedList<JackError<Scalar>, 4 * JacksType::capacity> load_errors() const {
    FixedList<JackError<Scalar>, 4 * JacksType::capacity> errors;
    for (int k = 0; k < jacks_.size(); ++k)
      for_each_load_error(k, [&](const JackError<Scalar>& error) { errors.add(error); });
    return errors;
  }
  template <class Visit>
  void for_each_load_error(int k, const Visit& visit) const {
    const EndType& at = jacks_.end(k);
    filter_.instruments()
        .at(at.cable(), at.end)
        .for_each_error(jacks_.in(filter_.prior().cell, k), 2 * at.cable() + static_cast<int>(at.end),
                        jacks_[k].erred_up, visit);
    if (jacks_[k].frozen >= 0) visit(frozen_error(k));
  }
  void begin_row() {
    filter_.begin_row();
    far_ends_.begin_row();
  }

  // Driving.

  /// Conditions the loads of a row. Returns whether there is something to check of a jack, too.
  [[gnu::always_inline]] bool condition(const ReadingsType& readings, Corners<Scalar>& corners) {
    bool has_more = false;
    for (int k = 0; k < jacks_.size(); ++k) {
      const EndReading<Scalar>& given = jacks_.in(readings.ends, k);
      const bool locked = jacks_.in(readings.sample.jack, k).locked;
      ForceEstimate<Scalar> held;
      if (jacks_[k].locked && !locked) held = estimate(end_segment(k));
      if (jacks_[k].take(locked, given, readings.dt, jacks_.in(filter_.prior().cell, k), most_force(k), held,
                         corners))
        alarms_.add(alarm_at(Alarm::Kind::outlier, jacks_.end(k)));
      has_more |= given.has_stroke | (jacks_[k].locked & given.has_force);
    }
    return has_more;
  }
  /// A load that leaves the place of its last turn is read on the other branch from there on; the tracker is
  /// at that place.
  void change_branch(int k) {
    auto& jack = jacks_[k];
    if (!jack.changes_branch()) return;
    jack.erred_up = jack.pulls;
    change_errors(k);
  }
  void change_errors(int k) {
    for_each_load_error(k, [&](const JackError<Scalar>& error) { tracker_.change_load_error(error); });
  }
  int end_segment(int k) const {
    const EndType& at = jacks_.end(k);
    return model().cables[at.cable()].end_segment(at.end);
  }
  Scalar most_force(int k) const { return model().most_force[jacks_.end(k).cable()]; }
  /// A jack that reverses or is locked now: friction will remember the error of its load.
  void remember_reversal(int k) {
    auto& jack = jacks_[k];
    change_branch(k);
    const bool loads_change = jack.frozen >= 0;
    forget_other_loads(k);
    if (!jack.locked && (far_ends_.ends().size() > 0 || gauges_.size() > 0))
      filter_.come_to_what_is_known(tracker_);
    const int p = next_memory(k);
    if (p < 0) return;
    filter_.remember_reversal(tracker_, p, jacks_.end(k).cable(), jacks_.end(k).end, jack.sd_before);
    is_belief_fine_ = false;
    if (!loads_change || jack.locked) return;
    jack.frozen = static_cast<std::int16_t>(p);
    tracker_.change_load_error(frozen_error(k));
  }
  /// The memory that matters least to forces, of several the oldest.
  int next_memory(int k) {
    auto& jack = jacks_[k];
    const int corners = remembered_corners(load_patterns(model()));
    int found = jack.oldest;
    Scalar smallest = -1;
    for (int i = 0; i < corners; ++i) {
      const int slot = (jack.oldest + i) % corners, p = jack.memory[static_cast<std::size_t>(slot)];
      if (p < 0) return p;
      Scalar matters = 0;
      for (int s = 0; s < model().segments; ++s) {
        const Scalar S = tracker_.sensitivity(p, s);
        matters += S * S * filter_.belief().variance(p);
      }
      if (smallest >= 0 && !(matters < smallest)) continue;
      smallest = matters;
      found = slot;
    }
    jack.oldest = (found + 1) % corners;
    return jack.memory[static_cast<std::size_t>(found)];
  }
  bool changes_factors(const Sample<Scalar, Cap>& sample) const {
    for (int i = 0; i < jacks_.patterns(); ++i)
      if (sample.factor[i] != jacks_.factor(i)) return true;
    return false;
  }
  /// While other loads change, friction comes to rest at the loads that jacks have then, known or not.
  void follow_other_loads(const Sample<Scalar, Cap>& sample, Corners<Scalar>& corners) {
    if (jacks_.patterns() == 0) return;
    const bool changes = changes_factors(sample);
    for (int k = 0; k < jacks_.size(); ++k) {
      auto& jack = jacks_[k];
      if (jack.locked || jack.memory[0] < 0) continue;
      if (changes) jack.come_to_best(jacks_.in(filter_.prior().cell, k));
      if (changes && jack.frozen >= 0) filter_.widen(jack.frozen, jack.come_sd);
      corners.loads |= changes != (jack.frozen >= 0);
    }
  }
  void remember_load(int k, const Sample<Scalar, Cap>& sample) {
    auto& jack = jacks_[k];
    const bool changes = changes_factors(sample);
    if (jack.locked || jack.memory[0] < 0 || changes == (jack.frozen >= 0)) return;
    if (!changes) return forget_other_loads(k);
    jack.frozen = static_cast<std::int16_t>(next_memory(k));
    filter_.remember_load(tracker_, frozen_error(k), jack.come_sd);
    is_belief_fine_ = false;
  }
  /// Other loads change no longer: what friction remembers stays as it is.
  void forget_other_loads(int k) {
    if (jacks_[k].frozen < 0) return;
    // A failure shows on the way on.
    static_cast<void>(tracker_.end_load_error(jacks_[k].frozen));
    jacks_[k].frozen = -1;
  }
  JackError<Scalar> frozen_error(int k) const {
    const EndType& at = jacks_.end(k);
    return {jacks_[k].frozen, static_cast<std::int16_t>(2 * at.cable() + static_cast<int>(at.end)), Scalar(1),
            Scalar(0)};
  }

  /// Where the best estimate of a load lies beyond the present piece, the forces there follow from the events
  /// in between: the tracker goes there, and stays while the loads that are confirmed are on their way.
  void look_ahead() {
    if (is_ahead_ ? !is_best_elsewhere() : !is_beyond_piece()) return;
    if (is_ahead_ && !is_best_further()) go_back();
    if (!is_ahead_) {
      learn_waiting();
      confirmed_.tracker = tracker_.save();
      for (int k = 0; k < jacks_.size(); ++k) confirmed_.jack[k] = jacks_[k].driven;
      is_ahead_ = true;
    }
    const auto to = jacks_.best(jacks_.driven(load_patterns(model())));
    const auto progress = tracker_.advance(to);
    if (progress.status && !(progress.fraction < 1))
      jacks_.arrive(to, load_patterns(model()));
    else
      go_back();
  }
  bool is_beyond_piece() const {
    for (int k = 0; k < jacks_.size(); ++k)
      if (!jacks_[k].locked && !jacks_[k].at.behind && jacks_[k].beyond() != 0 &&
          !tracker_.reaches(k, jacks_[k].at.load))
        return true;
    return false;
  }
  /// While it is ahead: whether a best estimate has left the piece there, or has come back.
  bool is_best_elsewhere() const {
    for (int k = 0; k < jacks_.size(); ++k) {
      if (jacks_[k].locked) continue;
      const bool goes_up = jacks_[k].driven.force >= confirmed_.jack[k].force;
      const Scalar further = goes_up ? jacks_[k].beyond() : -jacks_[k].beyond();
      if (further > 0 ? !tracker_.reaches(k, jacks_[k].at.load) : further < -jacks_[k].at.sd) return true;
    }
    return false;
  }
  /// While it is ahead: whether all best estimates have gone on the way that it came there.
  bool is_best_further() const {
    for (int k = 0; k < jacks_.size(); ++k)
      if (jacks_[k].beyond() * (jacks_[k].driven.force - confirmed_.jack[k].force) < 0) return false;
    return true;
  }
  /// While it is ahead: nothing is done if the loads of a row lie on the way there. If they have come as far,
  /// it is ahead no longer, and else goes back.
  void follow_ahead(const Corners<Scalar>& corners, const Sample<Scalar, Cap>& sample) {
    bool is_on_way = !corners.any(), is_past = is_on_way;
    for (int i = 0; i < load_patterns(model()); ++i) is_on_way &= sample.factor[i] == jacks_.factor(i);
    for (int k = 0; k < jacks_.size(); ++k) {
      const auto& jack = jacks_[k];
      is_on_way &= jack.locked == jack.driven.locked && !jack.changes_branch();
      if (jack.locked) continue;
      const Scalar from = confirmed_.jack[k].force, to = jack.driven.force, at = jack.target();
      is_past &= (at - to) * (to - from) >= 0;
      is_on_way &= (at - from) * (to - from) >= 0;
    }
    if (!is_on_way) return go_back();
    if (is_past) {
      is_ahead_ = false;
      return;
    }
    for (int k = 0; k < jacks_.size(); ++k) {
      const Scalar from = confirmed_.jack[k].force, to = jacks_[k].driven.force, at = jacks_[k].target();
      if (!jacks_[k].locked && (at - to) * (to - from) > 0) return go_back();
    }
  }
  void go_back() {
    if (!is_ahead_) return;
    is_ahead_ = false;
    static_cast<void>(tracker_
                          .restore(tracker_.condensed(), filter_.friction(linear_part(tracker_.condensed())),
                                   confirmed_.tracker, load_errors())
                          .ok());
    for (int k = 0; k < jacks_.size(); ++k) jacks_[k].driven = confirmed_.jack[k];
  }
  /// How far the wedges were drawn in that hold since this row is not known exactly.
  /// Returns whether there are any.
  bool remember_seating() {
    bool any = false;
    for (int k = 0; k < jacks_.size(); ++k) {
      if (!jacks_[k].locks_now || jacks_[k].seating < 0) continue;
      const EndType& at = jacks_.end(k);
      filter_.remember_seating(tracker_, jacks_[k].seating, at.cable(), at.end,
                               filter_.prior().seating_sd[at.cable()]);
      any = true;
    }
    return any;
  }
  /// Cables that are held since this row drift from here on.
  Status remember_drift() {
    Status status = Status::success();
    for (int k = 0; k < jacks_.size() && status; ++k) {
      const EndType& at = jacks_.end(k);
      if (jacks_[k].locks_now && drifts(at.cable()))
        status = filter_.remember_drift(tracker_, drift_[at.cable()], at.cable(), at.end);
    }
    return status;
  }
  /// Whether a cable drifts: its strain does where wedges hold it.
  bool drifts(int c) const { return drift_[c] >= 0 && is_held(c); }
  /// Whether all jacks of a cable are locked, if there are any.
  bool is_held(int c) const {
    for (int k = 0; k < jacks_.size(); ++k)
      if (jacks_.end(k).cable() == c && !jacks_[k].locked) return false;
    return true;
  }

  // Measuring.

  /// What is read of forces cannot be compared with those of loads that may be others.
  bool loads_are_in_doubt() const { return jacks_.may_have_reversed() || jacks_.has_refused(); }
  /// Nothing is learned where the tracker is ahead: what is read belongs to no place that is confirmed.
  bool can_learn() const { return filter_.belief().has_friction() && !is_ahead_ && !loads_are_in_doubt(); }
  /// Returns whether anything was learned.
  bool measure_far_ends(const ReadingsType& readings) {
    const bool gathers = !is_ahead_ && far_ends_.gathers(jacks_);
    bool learns = false;
    misfits_ = false;
    for (int e = 0; e < far_ends_.ends().size(); ++e) {
      const EndType& end = far_ends_.ends()[e];
      const EndReading<Scalar>& given = end.in(readings.ends);
      if (can_be(given, end.cable()))
        learns |= measure_far_end(e, given.force, gathers);
      else if (given.has_force)
        alarms_.add(alarm_at(Alarm::Kind::sensor, end));
      if (!(far_ends_.watch(e).fit.misfit() > 0)) continue;
      misfits_ = true;
      if (given.has_force) alarms_.add(alarm_at(Alarm::Kind::misfit, end));
    }
    return learns;
  }
  /// Whether an end was read, and no more than its cable can carry.
  bool can_be(const EndReading<Scalar>& given, int cable) const {
    return given.has_force && std::fabs(given.force) <= model().most_force[cable];
  }
  bool measure_far_end(int e, Scalar reading, bool gathers) {
    const EndType& end = far_ends_.ends()[e];
    auto& watch = far_ends_.watch(e);
    if (watch.stays_frozen(reading)) {
      alarms_.add(alarm_at(Alarm::Kind::frozen, end));
      return false;
    }
    const int readings = gathers ? far_ends_.waiting() + 1 : 1;
    const Update update = drifts(end.cable()) ? correct_drift(e, reading)
                          : is_ahead_         ? far_ends_.compare(e, reading, tracker_, filter_, jacks_)
                          : gathers           ? far_ends_.gather(reading, tracker_, filter_, jacks_)
                                              : far_ends_.measure(e, reading, tracker_, filter_, jacks_);
    // Once, as long as it lasts.
    const bool is_told = update == Update::no_information && watch.is_told;
    watch.is_told = update == Update::no_information;
    if (update != Update::waits && !is_told) note(update, alarm_at(Alarm::Kind::sensor, end), readings);
    return update == Update::updated;
  }
  /// The cell at the far end of a cable that is locked tells how far its wedge was drawn in, and what has
  /// strained it since.
  Update correct_drift(int e, Scalar reading) {
    const int c = far_ends_.ends()[e].cable();
    int k = 0;
    while (jacks_.end(k).cable() != c) ++k;
    const auto is_corrected = [&](int p) { return p == drift_[c] || p == jacks_[k].seating; };
    const Update update = far_ends_.correct(e, reading, tracker_, filter_, jacks_, is_corrected);
    // A failure shows in the next row.
    if (update == Update::updated && filter_.moved(is_corrected) > far_ends_.watch(e).sd)
      static_cast<void>(filter_.follow_drift(tracker_, drift_[c], c, jacks_.end(k).end));
    return update;
  }
  /// The deviation of a force in a cable whose cells are off the model.
  Scalar widened(Scalar deviation, int segment) const {
    const Scalar misfit = far_ends_.misfit(cable_of(segment));
    return std::sqrt(deviation * deviation + misfit * misfit);
  }
  void learn_waiting() {
    if (!far_ends_.has_waiting()) return;
    const int readings = far_ends_.waiting();
    note(far_ends_.learn(tracker_, filter_, jacks_), alarm_at(Alarm::Kind::sensor, far_ends_.ends()[0]),
         readings);
  }
  /// Of something else than a load cell.
  template <class Predict>
  void take_measurement(const Predict& predict, Scalar reading, Scalar sd, const Alarm& contradiction) {
    if (!(sd > 0) || !can_learn()) return;
    wait_for_none();
    predict(filter_.prediction());
    if (filter_.is_informative(tracker_, contradiction.cable, sd))
      note(filter_.update(tracker_, predict, jacks_.readings(filter_.prior()), {reading, sd, Scalar(0)}),
           contradiction);
    look_ahead();
  }
  /// Nothing else of the row waits.
  void wait_for_none() {
    // The errors of the jack that they share.
    if (!far_ends_.has_waiting()) return;
    const bool shares_row = far_ends_.has_waiting_of_row();
    learn_waiting();
    if (!shares_row) begin_row();
  }
  void follow_gauges(const Corners<Scalar>& corners, Scalar dt) {
    Scalar load = 0;
    for (int k = 0; k < jacks_.size(); ++k) load += jacks_[k].driven.force;
    if (corners.locks) gauges_.forget_marks();
    gauges_.begin_row(load, dt);
    for (int c = 0; c < model().cables.size(); ++c)
      gauges_.follow_sliding(c, filter_.slides_throughout(tracker_, c));
  }
  /// Whether all cables that prediction() depends on, read with `sd` at `cable`, surely slide throughout.
  bool is_sure(int cable, Scalar sd) const {
    for (int c = 0; c < model().cables.size(); ++c)
      if (filter_.matters(tracker_, c, cable, sd) &&
          !gauges_.surely_slides(c, filter_.relative_deviation(tracker_, c)))
        return false;
    return true;
  }
  template <class Predict>
  void take_gauge(const Predict& predict, Scalar reading, Gauge gauge, const Alarm& contradiction) {
    if (!gauges_.has(gauge) || !std::isfinite(reading)) return;
    gauges_.follow_noise(gauge, reading);
    if (!can_learn() || !gauges_.is_due(gauge)) return;
    const auto predict_reading = [&](auto& prediction) {
      predict(prediction);
      gauges_.depend(gauge, prediction);
    };
    const Scalar sd = gauges_.sd(gauge);
    wait_for_none();
    predict_reading(filter_.prediction());
    if (!is_sure(contradiction.cable, sd)) return look_ahead();
    const auto jacks = jacks_.readings(filter_.prior());
    if (gauges_.lacks_mark(gauge)) {
      const Expected<Scalar> expected = filter_.belief().expect(filter_.prediction(), jacks, sd);
      gauges_.set_mark(gauge, reading - expected.value);
      filter_.renew(gauges_.unknowns(gauge).zero, GaugesType::very_unknown * std::sqrt(expected.variance));
    }
    gauges_.count(gauge);
    note(filter_.update(tracker_, predict_reading, jacks, {reading - gauges_.mark(gauge), sd, Scalar(0)}),
         contradiction);
    look_ahead();
  }
  /// What came of so many readings of an instrument; `contradiction` is the alarm if they contradict.
  void note(Update update, const Alarm& contradiction, int readings = 1) {
    if (update == Update::updated) {
      is_belief_fine_ = false;
      Account::learned(contradiction, readings, filter_);
    } else if (update == Update::contradiction) {
      alarms_.add(contradiction);
    } else if (update == Update::no_information) {
      alarms_.add(Alarm::of(Alarm::Kind::no_information, contradiction.cable, contradiction.place));
    }
  }

  // Monitoring.

  /// Strokes against the elongation that is expected, and the load cells of locked ends.
  void check_jacks(const ReadingsType& readings) {
    for (int k = 0; k < jacks_.size(); ++k) {
      const EndReading<Scalar>& given = jacks_.in(readings.ends, k);
      if (given.has_stroke) check_stroke(k, given.stroke);
      if (given.has_force && jacks_[k].locked) check_lift_off(k, given.force);
    }
  }
  void check_stroke(int k, Scalar stroke) {
    auto& jack = jacks_[k];
    if (jack.locked) return;
    if (!is_bedded(k)) return jack.elongation.begin_leg();
    // Where a load may have turned, or was not read, so is the extension.
    const bool is_known = !jack.at.behind && !jack.at.refused && std::isfinite(stroke);
    if (is_known ? jack.elongation.take(stroke, expected_extension(k), limits_) : jack.elongation.is_off())
      alarms_.add(alarm_at(Alarm::Kind::elongation, jacks_.end(k)));
  }
  /// Whether a jack strains its cable by AlarmLimits::initial_strain. It carries at most a tenth of E A.
  bool is_bedded(int k) const { return jacks_[k].at.load >= 10 * limits_.initial_strain * most_force(k); }
  ExpectedExtension<Scalar> expected_extension(int k) {
    const auto& belief = filter_.belief();
    auto& prediction = filter_.prediction();
    predict_stroke(tracker_, jacks_.end(k), belief, jacks_.ends(), prediction);
    typename FilterType::JackReadings best;
    ExpectedExtension<Scalar> extension;
    for (int i = 0; i < jacks_.size(); ++i) {
      best.add({jacks_[i].beyond(), Scalar(0)});
      const Scalar part = jacks_[i].locked ? Scalar(0) : prediction.by_jack[i] * jacks_[i].at.sd;
      extension.of_loads += part * part;
    }
    const Expected<Scalar> expected = belief.expect(prediction, best, Scalar(0));
    extension.value = expected.value;
    extension.of_unknowns = expected.variance;
    for (int p = 0; p < belief.friction(); ++p) extension.by_friction += prediction.H[p];
    return extension;
  }
  void check_lift_off(int k, Scalar reading) {
    const EndType& at = jacks_.end(k);
    const int segment = end_segment(k);
    const Scalar up = jacks_.in(filter_.prior().cell, k).up;
    if (jacks_[k].lifts_off(reading, most_force(k), up * force(segment),
                            [&] { return up * deviation(segment); }))
      alarms_.add(alarm_at(Alarm::Kind::lift_off, at));
  }

  // What every row needs comes first: instructions reach it directly.
  AlarmLimits<Scalar> limits_ = {0, 0, 0, 0, 0, 0, 0};  // all zeros until start(): no flash to copy from
  bool is_belief_fine_ = false;  // nothing is odd about what is believed of friction and gains
  FarEndsType far_ends_;
  FixedArray<std::int16_t, Cap::cables> drift_;  // unknown strains of cables, or -1
  JacksType jacks_;
  TrackerType tracker_;
  FilterType filter_;
  GaugesType gauges_;
  ForceWatchType forces_;
  Alarms alarms_;
  Confirmed confirmed_;
  bool is_ahead_ = false;  // of what is confirmed
  bool misfits_ = false;   // some load cell at an anchored end is off the model
};

}  // namespace taut
