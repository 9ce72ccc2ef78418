// From jacking loads to the force in every segment, with its standard deviation, and friction on the way.
#pragma once

#include <cmath>
#include <cstddef>
#include <new>

#include "taut/estimation/drive_row.hpp"
#include "taut/estimation/estimator_parts.hpp"
#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/estimation/jack_checks.hpp"
#include "taut/estimation/measure_following.hpp"
#include "taut/estimation/measure_row.hpp"
#include "taut/estimation/monitoring.hpp"
#include "taut/estimation/take_gauge.hpp"

namespace taut {

/// An extended Kalman filter on the unknowns of friction around a Tracker that carries their sensitivities.
///
/// A row of readings goes through three stages:
/// 1. drive: LoadFilter conditions the jacks' load cells against noise, and the tracker is driven as far as
///    the loads are confirmed to have come, straight on or through corners (drive_row.hpp);
/// 2. measure: a load cell at an anchored end is compared with its prediction and updates friction (FarEnds,
///    FrictionFilter); where mu has moved far from where the tracker is linearized, that is relinearized
///    (measure_row.hpp);
/// 3. monitor: what is odd raises an alarm (monitoring.hpp, jack_checks.hpp).
/// Forces are those of the tracker, carried on to the best estimate of loads and friction
/// (force_estimate.hpp). Where nothing measures mu, the answer is the prior carried through.
///
/// Strain gauges on struts and the strokes of jacks are measurements of the same kind for whoever has them:
/// take_strut(), take_stroke().
///
/// `Parameters` bounds the number of unknowns that forces depend on: one a cable with a shared mu, one a
/// joint otherwise; gain, zero and hysteresis of a jack's load cell where they are not known;
/// the draw-in of its wedge; the strain that a locked cable takes on by itself; and remembered_corners() of
/// every jack whose load cell has noise: if there is no room for these, such loads are taken for exact.
/// `Further` bounds those that readings alone depend on: gain and zero of cells at anchored ends, and of
/// gauges. See count_unknowns().
///
/// Nothing here may be called from an interrupt while another call is under way; two estimators share
/// nothing.
template <class CondensedType, int Parameters, int Further = 0>
class Estimator {
  using Parts = EstimatorParts<CondensedType, Parameters, Further>;

 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Account = typename Parts::Account;
  using TrackerType = typename Parts::TrackerType;
  using PriorType = typename Parts::PriorType;
  using ReadingsType = typename Parts::ReadingsType;
  using FilterType = typename Parts::FilterType;
  using JacksType = typename Parts::JacksType;
  using FarEndsType = typename Parts::FarEndsType;
  using GaugesType = typename Parts::GaugesType;
  using ForceWatchType = typename Parts::ForceWatchType;
  using Alarms = typename Parts::Alarms;
  using Confirmed = typename Parts::Confirmed;
  using NoGauges = FixedList<LoadCell<Scalar>, 0>;

  /// All that restore() needs to go on with the same bits, as Tracker::State: a plain value.
  struct State {
    typename TrackerType::State tracker;
    typename JacksType::State jacks;
    typename FilterType::State friction;
    typename FarEndsType::State far_ends;
    typename GaugesType::State gauges;
    typename Parts::SlidingWayType sliding_way;
    Confirmed confirmed;
    bool is_ahead = false;  ///< of what is confirmed; else that has no meaning
    FixedArray<typename Parts::Leg, Parts::legs> leg;
    typename Parts::LockOff lock_off;
    typename ForceWatchType::State forces;
    typename Parts::TurnedForcesType turned;
    typename Parts::HeldCellsType held;
    typename Parts::LaggingCellsType lagging;
    typename Parts::FollowingJacks following;
  };

  // Beginning.

  /// Begins without loads, with friction as it is known beforehand. `condensed` and `prior` must outlive
  /// the estimator; `gauges`, a range of LoadCell, are the instruments whose readings take_segment(),
  /// take_strut() and take_stroke() are given. Fails with `capacity_exceeded` if and only if there are more
  /// unknown mu than Parameters, or more gauges, or unknowns of them, than Further (the amount is what is
  /// missing), or no room for the unknown draw-in of a wedge, as is the case without Capacity::seating, or
  /// for the strain that a locked cable takes on, or for a load cell that lags without Capacity::lags (names
  /// the cable), else as Tracker::start() does. Cost: that of the prestrain.
  Progress<Scalar> start(const CondensedType& condensed, const PriorType& prior,
                         const AlarmLimits<Scalar>& limits = {});
  template <class Cells>
  Progress<Scalar> start(const CondensedType& condensed, const PriorType& prior,
                         const AlarmLimits<Scalar>& limits, const Cells& gauges) {
    const Status known = begin(condensed, prior, limits, gauges);
    if (!known) return {forget(known), Scalar(0), 0};
    parts_.begin(parts_.filter);
    return parts_.tracker.start(condensed, parts_.filter.friction(linear_part(condensed)),
                                load_errors(parts_));
  }
  /// After start(): the loads of these first readings, those of jacks having come down from so high that
  /// every joint slid back, at most 0.99 of what Condensed::most_force allows: the largest forces that any
  /// past of the jacks can have left, see UnknownPast. Fails as advance() does. Cost: two paths.
  Progress<Scalar> come_down(const ReadingsType& first);
  /// The state between two rows. Cost: a copy of it.
  State save() const {
    return {parts_.tracker.save(),
            parts_.jacks.save(),
            parts_.filter.save(),
            parts_.far_ends.save(),
            parts_.gauges.save(),
            parts_.sliding_way,
            parts_.confirmed,
            parts_.is_ahead,
            parts_.leg,
            parts_.lock_off,
            parts_.forces.save(),
            parts_.turned,
            parts_.held,
            parts_.lagging,
            parts_.following};
  }
  /// Goes on where save() was called on an estimator of the same scene. Fails with `capacity_exceeded` if and
  /// only if start() would, and with `bad_sample` if the state was saved before start(), or is seen to be
  /// none of this scene; then it is as before start(). Not every such state is seen: its bytes must be those
  /// of save(), whole and undamaged, or what follows is undefined. Cost: that of one event.
  Status restore(const CondensedType& condensed, const PriorType& prior, const State& state,
                 const AlarmLimits<Scalar>& limits = {});
  template <class Cells>
  Status restore(const CondensedType& condensed, const PriorType& prior, const State& state,
                 const AlarmLimits<Scalar>& limits, const Cells& gauges) {
    const Status known = begin(condensed, prior, limits, gauges);
    if (!known) return forget(known);
    parts_.jacks.restore(state.jacks);
    parts_.filter.restore(state.friction);
    parts_.begin(parts_.filter);
    parts_.far_ends.restore(state.far_ends);
    parts_.misfits = parts_.far_ends.misfits();
    parts_.gauges.restore(state.gauges);
    parts_.sliding_way = state.sliding_way;
    parts_.forces.restore(state.forces);
    parts_.turned = state.turned;
    parts_.confirmed = state.confirmed;
    parts_.is_ahead = state.is_ahead;
    parts_.is_beyond.fill(state.is_ahead);
    parts_.leg = state.leg;
    parts_.lock_off = state.lock_off;
    parts_.held = state.held;
    parts_.lagging = state.lagging;
    parts_.following = state.following;
    const Status restored = parts_.tracker.restore(condensed, parts_.filter.friction(linear_part(condensed)),
                                                   state.tracker, load_errors(parts_));
    return restored ? restored : forget(restored);
  }

  // A row of readings.

  /// Follows the readings of one row. Fails with `bad_sample` if a load factor is not finite or out of range,
  /// or `dt` is below zero or not finite; then nothing was done. Else fails as Tracker::advance() does; then,
  /// or with a fraction below 1, the state is where the path ended. The next call goes on from there: with
  /// the same sample, no readings and `dt` zero, until the row is done; alarms() has those of all calls. A
  /// reading that is not finite, or more than the cable can carry, is refused with an alarm.
  ///
  /// Cost: without an event that of a reading in LoadFilter a jack, and of gathering a reading of the far
  /// end. At worst 8 paths, and 32 a cable with two jacks, of `event_budget` events each; for every far end,
  /// and once for what was gathered, an update with four calls of Tracker::adjust(); one such call for every
  /// jack that reversed, and 16 for a cable with two jacks.
  Progress<Scalar> advance(const ReadingsType& readings, int event_budget = TrackerType::default_budget);

  /// A strain gauge on a strut, read together with the last row: its axial force [N], tension positive, with
  /// the standard deviation `sd` > 0 of the reading. `rows` are those of the condensed scene; a strut has the
  /// number of the scene. After an advance() that came to its end and before save(); as often as there are
  /// gauges. While joints stick that matter to it nothing is learned from it; what contradicts raises
  /// Alarm::Kind::strut, and nothing has changed. Cost: an update, with at most four calls of
  /// Tracker::adjust().
  void take_strut(const typename CondensedType::Struts& rows, int strut, Scalar reading, Scalar sd);
  /// The stroke of a jack, read together with the last row: its extension since the start [m], with the
  /// standard deviation `sd` > 0 of the reading and of what the elongation of the cable is uncertain by, that
  /// of E A. A locked end, or one without a jack, tells nothing. After an advance() that came to its end and
  /// before save(), once a jack; what contradicts raises Alarm::Kind::elongation, and nothing has changed.
  /// Cost: an update, with at most four calls of Tracker::adjust().
  void take_stroke(int cable, std::size_t end, Scalar reading, Scalar sd);

  /// The same of instruments with unknowns of their own: numbers in the list that start() was given. Which
  /// readings count is told by Gauges, of all but strokes those while cables surely slide; all may be handed
  /// in. What contradicts raises Alarm::Kind::strut, `elongation`, or `segment` for the measured force of a
  /// segment [N]. Cost: an update, with at most four calls of Tracker::adjust(); of a stroke, where
  /// Capacity::strokes has it, with at most four ways anew from where the jack turned last, each of
  /// Tracker::restore(), adjust() and two paths.
  void take_strut(const typename CondensedType::Struts& rows, int strut, Scalar reading, Gauge gauge);
  void take_stroke(int cable, std::size_t end, Scalar reading, Gauge gauge);
  void take_segment(int segment, Scalar reading, Gauge gauge);
  const GaugesType& gauges() const { return parts_.gauges; }

  // The answers.

  /// Force of a segment [N], >= 0, and its standard deviation [N]; both at once take hardly longer than the
  /// deviation alone. Cost: of a force one product a jack and unknown, of a deviation half the square of the
  /// unknowns more.
  Scalar force(int segment) const;
  Scalar deviation(int segment) const { return estimate(segment).deviation; }
  ForceEstimate<Scalar> estimate(int segment) const;
  /// Axial force of a strut [N], tension positive, and its standard deviation [N]; `rows` are those of the
  /// condensed scene, `strut` has the number of the scene. Cost: all that moves along the cables once an
  /// unknown and jack.
  ForceEstimate<Scalar> estimate_strut(const typename CondensedType::Struts& rows, int strut) const;
  /// Friction coefficient of a joint, and its standard deviation [-].
  Scalar mu(int joint) const { return parts_.tracker.is_started() ? parts_.filter.mu(joint) : Scalar(0); }
  Scalar mu_deviation(int joint) const { return parts_.filter.mu_deviation(joint); }
  /// The unknown that it depends on, as Capacity::Account counts those of friction, or -1.
  int friction_unknown(int joint) const { return parts_.filter.unknown_of(joint); }
  /// Slips, contact and friction forces, extensions, states and, if their rows are given, strut forces: as
  /// Tracker::respond(), with tensions and extensions at the best estimate. Cost: a force a segment, and that
  /// of Tracker::respond().
  void respond(Response<Scalar, Cap>& response, const typename CondensedType::Struts* struts = nullptr) const;
  /// What is odd about the last row.
  const Alarms& alarms() const { return parts_.alarms; }
  /// The force that a segment has reached at most (at least) beyond a limit [N] while Alarm::Kind::force_high
  /// (force_low) has been raised for it without a break; zero while neither is.
  Scalar peak(int segment) const { return parts_.forces.peak(segment); }
  /// The load of a jack as it was conditioned; zero where there is none.
  ConditionedLoad<Scalar> load(int cable, std::size_t end) const {
    const int k = parts_.jacks.find(cable, end);
    return k < 0 ? ConditionedLoad<Scalar>() : parts_.jacks[k].at;
  }
  const TrackerType& tracker() const { return parts_.tracker; }
  /// Brings another tracker to where the cables are by the best estimate of friction, for who tries what
  /// would follow, as JackPlanner does. Loads are those that the tracker was driven to: gain and zero of the
  /// jacks' load cells are left as they are read. After an advance() that came to its end. Fails as
  /// Tracker::adjust() does; then only start() or restore() of that tracker may follow. Cost: those of
  /// Tracker::save(), restore() and adjust().
  Status bring(TrackerType& other) const;
  /// The friction that bring() gives it, as a function of the joint that Tracker::restore() takes.
  auto best_friction() const { return parts_.filter.best_friction(parts_.linear()); }
  /// What was told of every update since start() or restore(); see Capacity::Account.
  const Account& account() const { return parts_; }
  int unknowns() const { return parts_.filter.belief().size(); }

 private:
  template <class Cells>
  Status begin(const CondensedType& condensed, const PriorType& prior, const AlarmLimits<Scalar>& limits,
               const Cells& gauges) {
    parts_.limits = limits;
    parts_.alarms.clear();
    parts_.is_belief_fine = parts_.is_ahead = parts_.misfits = false;
    parts_.is_beyond.fill(false);
    parts_.slides_ahead.fill(false);
    forget_leg(parts_);
    parts_.lock_off.is_known = false;
    parts_.forces.start();
    parts_.turned.clear();
    parts_.sliding_way = {};
    parts_.held = {};
    parts_.lagging = {};
    parts_.following = {};
    return number_unknowns(parts_, condensed, prior, gauges);
  }
  /// As before start(). Returns why.
  Status forget(Status why) {
    new (static_cast<void*>(&parts_)) Parts();
    return why;
  }
  /// advance() with readings that count, and have no lag.
  Progress<Scalar> follow_row(const ReadingsType& readings, int event_budget);
  /// What a row measures, once the tracker has come to its loads; the tracker looks ahead.
  [[gnu::always_inline]] void measure_row(const ReadingsType& readings, Corners<Scalar>& corners) {
    if (corners.bends) {
      parts_.far_ends.bend();
      parts_.gauges.bend();
    }
    follow_cell_noise(parts_, readings, corners);
    if (parts_.gauges.size() > 0) {
      follow_gauges(parts_, corners, readings.dt);
      follow_sliding(parts_);
    }
    for (int c = 0; c < parts_.model().cables.size(); ++c)
      if (parts_.drifts(c)) parts_.filter.diffuse(parts_.drift[c], c, readings.dt);
    measure_far_ends(parts_, readings);
    if constexpr (JacksType::capacity > 1)
      for (int c = 0; c < parts_.model().cables.size(); ++c) measure_following(parts_, c);
  }
  /// What is odd about what is known now: friction and gains if they have changed, forces beyond limits.
  [[gnu::always_inline]] void check_answers() {
    const auto& cables = parts_.model().cables;
    if (!parts_.is_belief_fine && parts_.filter.belief().has_friction()) {
      const bool is_friction_fine = check_friction(cables, parts_.filter, parts_.alarms);
      parts_.is_belief_fine =
          check_gains(cables, parts_.filter, parts_.limits, parts_.alarms) && is_friction_fine;
    }
    if (parts_.limits.has_force())
      check_forces(
          cables, [this](int i) { return parts_.force(i); }, [this](int c) { return parts_.is_held(c); },
          parts_.forces, parts_.limits, parts_.alarms);
  }

  Parts parts_;
};

// Outside of the class, so that a source with an `extern template` of it compiles none of them.

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::start(const CondensedType& condensed,
                                                          const PriorType& prior,
                                                          const AlarmLimits<Scalar>& limits)
    -> Progress<Scalar> {
  return start(condensed, prior, limits, NoGauges());
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::come_down(const ReadingsType& first) -> Progress<Scalar> {
  return come_down_to(parts_, first);
}

template <class CondensedType, int Parameters, int Further>
Status Estimator<CondensedType, Parameters, Further>::restore(const CondensedType& condensed,
                                                              const PriorType& prior, const State& state,
                                                              const AlarmLimits<Scalar>& limits) {
  return restore(condensed, prior, state, limits, NoGauges());
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::advance(const ReadingsType& readings, int event_budget)
    -> Progress<Scalar> {
  if (!(readings.dt >= 0 && std::isfinite(readings.dt)))
    return {Status::at(Code::bad_sample, Place::none, -1), Scalar(0), 0};
  if (readings.dt > 0) parts_.alarms.clear();
  for (int i = 0; i < parts_.jacks.patterns(); ++i)
    if (!(std::fabs(readings.sample.factor[i]) <= parts_.model().most_factor[i]))
      return {Status::at(Code::bad_sample, Place::load, i), Scalar(0), 0};
  const bool has_held = parts_.tracker.is_started() && parts_.held.take(readings, parts_.model());
  if (!Cap::lags && !has_held) return follow_row(readings, event_budget);
  ReadingsType counted = readings;
  if (has_held) parts_.held.drop(counted);
  if constexpr (Cap::lags)
    parts_.lagging.undo(parts_.filter.prior().cell, parts_.model().most_force, counted);
  return follow_row(counted, event_budget);
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::follow_row(const ReadingsType& readings, int event_budget)
    -> Progress<Scalar> {
  begin_row(parts_);
  parts_.strokes.begin_row();
  Corners<Scalar> corners;
  Progress<Scalar> progress{Status::success(), Scalar(1), 0};
  const bool has_more = condition_loads(parts_, readings, corners);
  follow_other_loads(parts_, readings, corners);
  if (!drive_row(parts_, readings.sample, corners, event_budget, progress)) return progress;
  measure_row(readings, corners);
  if (has_more) check_jacks(parts_, readings);
  check_answers();
  return progress;
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::take_strut(const typename CondensedType::Struts& rows,
                                                               int strut, Scalar reading, Scalar sd) {
  take_measurement(parts_, foretell_strut(parts_, rows, strut), reading, sd,
                   Alarm::of(Alarm::Kind::strut, -1, strut));
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::take_stroke(int cable, std::size_t end, Scalar reading,
                                                                Scalar sd) {
  taut::take_stroke(parts_, cable, end, reading, sd);
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::take_strut(const typename CondensedType::Struts& rows,
                                                               int strut, Scalar reading, Gauge gauge) {
  take_gauge<WhileSliding>(parts_, foretell_strut(parts_, rows, strut), reading, gauge,
                           Alarm::of(Alarm::Kind::strut, -1, strut));
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::take_stroke(int cable, std::size_t end, Scalar reading,
                                                                Gauge gauge) {
  taut::take_stroke(parts_, cable, end, reading, gauge);
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::take_segment(int segment, Scalar reading, Gauge gauge) {
  if (!parts_.gauges.has(gauge)) return;
  const int c = parts_.model().cable_of(segment);
  take_gauge<WhileSliding>(
      parts_, foretell_segment(parts_, segment), reading, gauge,
      Alarm::of(Alarm::Kind::segment, c, segment - parts_.model().cables[c].first_segment));
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::force(int segment) const -> Scalar {
  return parts_.force(segment);
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::estimate(int segment) const -> ForceEstimate<Scalar> {
  return parts_.estimate(segment);
}

template <class CondensedType, int Parameters, int Further>
auto Estimator<CondensedType, Parameters, Further>::estimate_strut(const typename CondensedType::Struts& rows,
                                                                   int strut) const -> ForceEstimate<Scalar> {
  if (!parts_.tracker.is_started()) return {};
  return taut::estimate_strut(parts_.tracker, rows, parts_.jacks, parts_.filter, parts_.filter.prior(),
                              strut);
}

template <class CondensedType, int Parameters, int Further>
Status Estimator<CondensedType, Parameters, Further>::bring(TrackerType& other) const {
  const auto& condensed = parts_.tracker.condensed();
  const Status there = other.restore(condensed, parts_.filter.friction(linear_part(condensed)),
                                     parts_.tracker.save(), load_errors(parts_));
  return there ? parts_.filter.bring(other) : there;
}

template <class CondensedType, int Parameters, int Further>
void Estimator<CondensedType, Parameters, Further>::respond(
    Response<Scalar, Cap>& response, const typename CondensedType::Struts* struts) const {
  if (!parts_.tracker.is_started()) return;
  parts_.tracker.respond(response, struts);
  for (int i = 0; i < parts_.model().segments; ++i) response.tension[i] = force(i);
  parts_.model().resolve_joints(response);
  for (int k = 0; k < parts_.jacks.size(); ++k) {
    Scalar& extension = parts_.jacks.in(response.extension, k);
    extension = estimate_extension(parts_.tracker, parts_.jacks, parts_.filter.belief(), k, extension);
    // A strain is none.
    const int c = parts_.jacks.end(k).cable(), p = parts_.drift[c];
    if (p >= 0 && parts_.jacks[k].locked && parts_.filter.belief().mean(p) != 0)
      extension -= parts_.tracker.extension_sensitivity(p, c, parts_.jacks.end(k).end) *
                   parts_.filter.belief().mean(p);
  }
}

}  // namespace taut
