// From the readings of a row to the tracker: loads are conditioned, and the tracker is driven along with
// them.
#pragma once

#include <cmath>

#include "taut/estimation/draw_in.hpp"
#include "taut/estimation/drive.hpp"
#include "taut/estimation/early_unlock.hpp"
#include "taut/estimation/late_lock.hpp"
#include "taut/estimation/learning.hpp"
#include "taut/estimation/leg.hpp"
#include "taut/estimation/load_memory.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/other_friction.hpp"
#include "taut/estimation/two_jacks.hpp"
#include "taut/estimation/witness.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// What the wedge of jack `k`, whose end is locked, holds, as the cell of the jack will read it once it
/// pulls: less what its readings are off by, which the force of the segment has not. Cost: that of
/// Estimator::estimate(), and the square of the unknowns for each one of the cell.
template <class Parts>
HeldByWedge<typename Parts::Scalar> held_by_wedge(const Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  const auto& at = parts.jacks.end(k);
  const int segment = parts.end_segment(k);
  const auto held = parts.estimate(segment);
  typename Parts::Values by_load;
  parts.filter.instruments()
      .at(at.cable(), at.end)
      .for_each_error(parts.cell(k), k, true, [&](const auto& error) {
        by_load[error.parameter] = error.constant + error.proportional * held.force;
      });
  Scalar load = held.force, variance = held.deviation * held.deviation;
  for (int p = 0; p < belief.carried(); ++p) {
    if (by_load[p] == 0) continue;
    load -= by_load[p] * belief.mean(p);
    for (int q = 0; q < belief.carried(); ++q)
      variance +=
          by_load[p] * belief.covariance(p, q) * (by_load[q] - 2 * parts.tracker.sensitivity(q, segment));
  }
  return {parts.tracker.tension(segment), load, std::sqrt(larger(variance, Scalar(0)))};
}

/// Strokes of two jacks on one cable count together: where the load of one has turned, or it is locked or
/// takes over, both begin another leg. Cost: a few operations a jack.
template <class Parts>
void begin_legs_together(Parts& parts) {
  auto& jacks = parts.jacks;
  for (int k = 0; k < jacks.size(); ++k) {
    const int other = jacks.find(jacks.end(k).cable(), 1 - jacks.end(k).end);
    if (other >= 0 && (jacks[k].at.reversed || jacks[k].locked != jacks[k].driven.locked))
      jacks[other].elongation.begin_leg();
  }
}

/// Conditions the loads of a row. Returns whether there is something to check of a jack, too. Cost: that of
/// JackLoad::take() a jack.
template <class Parts>
[[gnu::always_inline]] inline bool condition_loads(Parts& parts, const typename Parts::ReadingsType& readings,
                                                   Corners<typename Parts::Scalar>& corners) {
  using Scalar = typename Parts::Scalar;
  auto& jacks = parts.jacks;
  const EndReading<Scalar> none;
  bool has_more = false;
  for (int k = 0; k < jacks.size(); ++k) {
    const EndReading<Scalar>& given = jacks.in(readings.ends, k);
    bool locked = jacks.in(readings.sample.jack, k).locked;
    auto beside = read_beside(parts, readings, k);
    HeldByWedge<Scalar> held;
    if (jacks[k].locked && !locked) {
      held = held_by_wedge(parts, k);
      const bool held_yet = jacks[k].unlocked_early;
      locked = wedge_holds_yet(jacks[k], given, held, parts.cell(k), readings.dt, beside.force);
      if (locked && !held_yet) parts.alarms.add(Parts::alarm_at(Alarm::Kind::early_unlock, jacks.end(k)));
    } else {
      jacks[k].unlocked_early = false;
    }
    const bool is_same = given.force == jacks[k].believed;
    const auto said = hear_far_end(parts, k, locked, given, readings.dt, beside);
    // A reading of an earlier row tells of a jump; it is too old to contradict the jack.
    if (jacks[k].is_unread && std::isnan(beside.force)) beside = read_before(parts, k);
    const bool has_outlier = jacks[k].take(locked, said == FarEndSays::nothing ? given : none, readings.dt,
                                           parts.cell(k), parts.most_force(k), held, corners,
                                           [&] { return sees_rise(parts, k, given.force, beside); });
    if (has_outlier || said == FarEndSays::is_misread)
      parts.alarms.add(Parts::alarm_at(Alarm::Kind::outlier, jacks.end(k)));
    if constexpr (Parts::Cap::lags) {
      const Scalar late = parts.lagging.late(jacks.end(k).cable(), jacks.end(k).end);
      if (jacks[k].is_new && late > 0) jacks[k].come_late(late);
    }
    if (jacks[k].standing.is_frozen() ||
        (said == FarEndSays::is_old && jacks[k].since > Parts::JacksType::Load::too_old))
      parts.alarms.add(Parts::alarm_at(Alarm::Kind::frozen, jacks.end(k)));
    else if (jacks[k].is_silent())
      parts.alarms.add(Parts::alarm_at(Alarm::Kind::unread, jacks.end(k)));
    if (jacks[k].locked_late) parts.alarms.add(Parts::alarm_at(Alarm::Kind::late_lock, jacks.end(k)));
    if (jacks[k].is_new && !is_same) jacks[k].beside = beside.force;
    has_more |= given.has_stroke | (jacks[k].locked & given.has_force);
  }
  if constexpr (Parts::JacksType::capacity > 1) {
    follow_other_jack(parts);
    begin_legs_together(parts);
  }
  return has_more;
}

/// Drives the tracker to the loads of a row, through corners and along what friction remembers of them, if it
/// does not look ahead already. Returns false if the row ends here: `progress` says why. Cost: that of
/// drive(), and at most of one path more.
template <class Parts>
[[gnu::always_inline]] inline bool drive_row(Parts& parts, const typename Parts::SampleType& sample,
                                             const Corners<typename Parts::Scalar>& corners, int event_budget,
                                             Progress<typename Parts::Scalar>& progress) {
  auto& jacks = parts.jacks;
  auto& tracker = parts.tracker;
  if (parts.lock_off.is_known) parts.lock_off.is_known = !has_gone_on(parts, jacks.target(sample));
  if (parts.has_instruments() && !parts.is_ahead) parts.sliding_way.go(parts.sum_of_loads());
  if (parts.is_ahead)
    follow_ahead(parts, corners, sample);
  else
    parts.slides_ahead.fill(false);
  bool is_as_before = !corners.any();
  for (int k = 0; k < jacks.size(); ++k) is_as_before &= !jacks[k].changes_branch();
  if (parts.is_ahead || (is_as_before && try_extend(tracker, jacks, sample))) return true;
  learn_waiting(parts);
  begin_row(parts);
  for (int k = 0; k < jacks.size(); ++k)
    if (jacks[k].driven.locked && !jacks[k].locked) turn_forces(parts, k);
  progress = drive(
      tracker, jacks, corners, jacks.target(sample), event_budget,
      [&](const typename Parts::SampleType& to) { leave(parts, to); },
      [&](int k, typename Parts::Scalar sd, bool turns) {
        if (turns) turn_forces(parts, k);
        remember_turn(parts, k, sd);
        begin_leg(parts, k);
        if (jacks[k].locks_now) begin_lock_off(parts);
      },
      [&](int k) {
        remember_load(parts, k);
        forget_leg(parts);
      },
      HoldByFriction<true, Parts>{parts});
  if (corners.any() || progress.events > 0) {
    parts.far_ends.restart();
    follow_sliding(parts);
  }
  if (!progress.is_complete()) return false;
  if (!corners.locks) return true;
  if (remember_seating(parts)) progress = join(progress, tracker.advance(jacks.target(sample), event_budget));
  if (progress.status) progress.status = remember_drift(parts);
  if (progress.status && parts.lock_off.is_known) try_others(parts);
  widen_late_locks(parts);
  return progress.status.ok();
}

/// After start(): the loads of first readings, those of jacks having come down from so high that every joint
/// slid back, see Estimator::come_down(). What a wedge holds is as much as leaves at the other end what is
/// read there, of a jack too; where nothing is, as much as the cable can carry. Fails as Tracker::advance()
/// does. Cost: two paths.
template <class Parts>
Progress<typename Parts::Scalar> come_down_to(Parts& parts, const typename Parts::ReadingsType& first) {
  using Scalar = typename Parts::Scalar;
  auto& jacks = parts.jacks;
  auto to = first.sample, above = to;
  // Of jack `k`, where friction holds all but the part `held` back: no more than the cable can carry.
  const auto highest_with = [&](Scalar load, Scalar held, int k) {
    const Scalar most = Scalar(0.99) * parts.most_force(k);
    return load < most * held ? load / held : most;
  };
  for (int k = 0; k < jacks.size(); ++k) {
    const EndReading<Scalar>& given = jacks.in(first.ends, k);
    if (jacks.in(to.jack, k).locked || !given.has_force || !(given.force > 0) ||
        !(given.force <= parts.most_force(k)))
      continue;
    jacks[k].come_down(given.force, parts.cell(k));
    change_errors(parts, k);
    const Scalar load = jacks.in(to.jack, k).force = jacks[k].at.load,
                 held = held_over(parts.tracker, jacks.end(k).cable());
    jacks.in(above.jack, k).force = highest_with(Scalar(1.02) * load, held * held, k);
  }
  for (int k = 0; k < jacks.size(); ++k) {
    if (!jacks.in(to.jack, k).locked) continue;
    const auto& end = jacks.end(k);
    const int c = end.cable(), other = jacks.find(c, 1 - end.end);
    auto& highest = jacks.in(above.jack, k);
    jacks[k].lie_locked();
    jacks[k].found_locked = true;
    // A wedge holds no more than the jack at the other end, once all has slid back to that.
    if (other >= 0 && !jacks.in(to.jack, other).locked) {
      highest = {jacks.in(above.jack, other).force, false};
      continue;
    }
    const auto beside = read_beside(parts, first, k);
    const Scalar load = larger(beside.force + 5 * beside.deviation, Scalar(0));
    highest = {highest_with(load, held_over(parts.tracker, c), k), false};
  }
  auto progress = parts.tracker.advance(above);
  // Wedges are seated already: none is drawn in any more.
  if (progress.status)
    progress = join(progress, parts.tracker.seat(to, [&](int c, std::size_t) {
      return -static_cast<Scalar>(parts.model().cables[c].seating);
    }));
  if (progress.status) jacks.arrive(to, parts.patterns());
  return progress;
}

}  // namespace taut
