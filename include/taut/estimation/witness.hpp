// The load cell at the other end of a cable as a witness of what its jack's cell reads.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "taut/estimation/drive.hpp"
#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/held_over.hpp"
#include "taut/estimation/jump_guard.hpp"
#include "taut/estimation/readings.hpp"

namespace taut {

/// The number among far ends of the cell at the other end of the cable of jack `k`, or -1. Cost: a few
/// operations an end.
template <class Parts>
int far_end_of(const Parts& parts, int k) {
  const auto& jack = parts.jacks.end(k);
  return parts.far_ends.find(jack.cable(), 1 - jack.end);
}

/// The force at the other end of the cable of jack `k`, which is anchored, as its load cell reads it in this
/// row, with the standard deviation of its noise [N]; not a number if it has none, or none is read. Cost:
/// that of far_end_of().
template <class Parts>
ForceEstimate<typename Parts::Scalar> read_beside(const Parts& parts,
                                                  const typename Parts::ReadingsType& readings, int k) {
  const int e = far_end_of(parts, k);
  if (e >= 0) {
    const auto& end = parts.far_ends.ends()[e];
    const auto& given = end.in(readings.ends);
    if (parts.can_be(given, end.cable())) return {given.force, parts.far_ends.watch(e).sd};
  }
  return {std::numeric_limits<typename Parts::Scalar>::quiet_NaN(), 0};
}

/// The same as it was read last, for a jack whose cell was not read since: a logger that reads its channels
/// in turn has it in a row of its own. Cost: that of far_end_of().
template <class Parts>
[[gnu::noinline]] ForceEstimate<typename Parts::Scalar> read_before(const Parts& parts, int k) {
  const int e = far_end_of(parts, k);
  if (e >= 0) return {parts.far_ends.watch(e).noise.last(), parts.far_ends.watch(e).sd};
  return {std::numeric_limits<typename Parts::Scalar>::quiet_NaN(), 0};
}

/// How far a jack's cell and the one at the far end of its cable have gone up since the last reading of the
/// jack that was believed [N].
template <class Scalar>
struct CommonRise {
  Scalar of_jack, of_far_end;
  Scalar scatter;  ///< of the far end, at most

  /// Whether the far end has surely gone up.
  bool is_seen() const { return of_far_end > scatter; }
  /// What of the jack's comes through at least, where all joints slide and leave the part `held`: half of it.
  Scalar least(Scalar held) const { return Scalar(0.5) * held * of_jack; }
};
template <class Parts>
CommonRise<typename Parts::Scalar> common_rise(const Parts& parts, int k, typename Parts::Scalar reading,
                                               const ForceEstimate<typename Parts::Scalar>& beside) {
  constexpr typename Parts::Scalar surely = 10;
  const auto& jack = parts.jacks[k];
  return {reading - jack.believed, beside.force - jack.beside, surely * beside.deviation};
}

/// Whether the cell beside jack `k` has seen the load go up as far as its reading [N], or at least half as
/// far as where all joints slide. What goes down does not come through at first. Cost: one product a joint.
template <class Parts>
bool sees_rise(const Parts& parts, int k, typename Parts::Scalar reading,
               const ForceEstimate<typename Parts::Scalar>& beside) {
  const auto rise = common_rise(parts, k, reading, beside);
  return rise.of_jack > 0 && rise.is_seen() &&
         rise.of_far_end > rise.least(held_over(parts.tracker, parts.jacks.end(k).cable()));
}

/// Whether a reading of jack `k` [N], `dt` [s] after the row before, cannot be its load by what the cell
/// beside it has read since the last one that was believed: in load stages, where no pace tells. Where the
/// cable slid over all joints as it was pulled, a load that has gone on farther than twice as far as in the
/// stage before has taken the far end at least half as far as that of all joints; of several such rows the
/// first is held to be wrong. A load below half of what lets all joints slide back takes the far end down: as
/// long as that does not go down the jack was misread, or its wedge holds; of several rows in which the far
/// end reads the very same the first is held to be wrong, for its cell may be dead. Cost: two products a
/// joint.
template <class Parts>
bool contradicts_stage(const Parts& parts, int k, typename Parts::Scalar reading, typename Parts::Scalar dt,
                       const ForceEstimate<typename Parts::Scalar>& beside) {
  using Scalar = typename Parts::Scalar;
  const auto& jack = parts.jacks[k];
  if (!JumpGuard<Scalar>::is_stage(dt) || jack.locked) return false;
  const int cable = parts.jacks.end(k).cable();
  const auto rise = common_rise(parts, k, reading, beside);
  const bool stays_up = rise.of_far_end > -rise.scatter, may_be_dead = rise.of_far_end == 0 && jack.is_unread;
  if (!(jack.believed > 0 && jack.beside > rise.scatter && stays_up) || may_be_dead) return false;
  const Scalar held = -larger(-held_over(parts.tracker, cable), -jack.beside / jack.believed);
  const bool is_below = reading < Scalar(0.5) * held * beside.force && jack.believed >= held * jack.beside,
             is_beyond = !jack.is_unread && jack.rises && rise.of_jack > 2 * jack.step_by &&
                         rise.least(held) > larger(rise.scatter, rise.of_far_end) &&
                         parts.filter.slides_throughout(parts.tracker, cable);
  return is_below || is_beyond;
}

/// Whether jack `k` reads the very same [N] as in the last row that was believed, and those before, while the
/// cell beside it has surely gone up since the first of them, though its readings had always changed: then
/// its cell does not live. Not of a jack whose readings are exact. Cost: a few operations.
template <class Parts>
bool stands_beside_rise(const Parts& parts, int k, typename Parts::Scalar reading,
                        const ForceEstimate<typename Parts::Scalar>& beside) {
  const auto& jack = parts.jacks[k];
  return reading == jack.believed && parts.cell(k).sd > 0 && jack.beside > 0 &&
         jack.standing.has_always_changed() && common_rise(parts, k, reading, beside).is_seen();
}

/// What a far end says of a reading of its jack: nothing against it, that it is none, or that it is an old
/// one, of a cell that does not live.
enum class FarEndSays : std::uint8_t { nothing, is_misread, is_old };

/// What the cell beside jack `k` says of what is read there in a row `dt` [s] after the one before; nothing
/// where the jack is not read, or its wedge holds. Cost: that of contradicts_stage().
template <class Parts>
FarEndSays hear_far_end(const Parts& parts, int k, bool locked,
                        const EndReading<typename Parts::Scalar>& given, typename Parts::Scalar dt,
                        const ForceEstimate<typename Parts::Scalar>& beside) {
  if (locked || !given.has_force) return FarEndSays::nothing;
  if (contradicts_stage(parts, k, given.force, dt, beside)) return FarEndSays::is_misread;
  return stands_beside_rise(parts, k, given.force, beside) ? FarEndSays::is_old : FarEndSays::nothing;
}

/// In a row in which the jack of its cable is not read, the load cell at anchored end `e` reads [N] what it
/// hardly could if the load were where it was. Then the load may have gone on, by as much at least, if it can
/// have meanwhile, and will until it is read; else the cell is wrong, which raises an alarm once it surely
/// is. While the cable slides throughout, and the load may have gone on, the reading waits for the next one
/// of the jack, see BetweenReadings. Returns whether either is so: nothing is learned then. Cost: that of
/// FarEnds::expect().
template <class Parts>
bool sees_unread(Parts& parts, int e, typename Parts::Scalar reading) {
  using Scalar = typename Parts::Scalar;
  constexpr Scalar perhaps = 3, surely = 5;
  const auto& end = parts.far_ends.ends()[e];
  for (int k = 0; k < parts.jacks.size(); ++k) {
    auto& jack = parts.jacks[k];
    if (parts.jacks.end(k).cable() != end.cable() || !jack.is_unread || jack.locked) continue;
    if (jack.is_in_doubt() && parts.filter.slides_throughout(parts.tracker, end.cable()))
      parts.far_ends.between(e).wait(reading, jack.at.load, jack.since);
    const auto expected = parts.far_ends.expect(e, parts.tracker, parts.filter, parts.jacks);
    const Scalar off = std::fabs(reading - expected.value);
    // Bars of a load that was on its way have that it went on.
    const Scalar least = jack.went_on ? surely : perhaps;
    if (off * off <= least * least * expected.variance) return false;
    const Scalar gone = off / held_over(parts.tracker, end.cable());
    if (gone <= jack.fastest * parts.most_force(k) * jack.since)
      jack.go_on_unread(gone);
    else if (off * off > surely * surely * expected.variance)
      parts.alarms.add(Parts::alarm_at(Alarm::Kind::sensor, end));
    else
      return false;
    return true;
  }
  return false;
}

/// Where the load of a jack may have gone farther while it was not read, and have come back, what the cell at
/// anchored end `e` reads [N] says how far at most: that force has gone along, and has not come back, unless
/// friction holds so little that it may have. Where joints stick nothing is said. Cost: that of
/// FarEnds::expect() where there is such a load.
template <class Parts>
void bound_missed(Parts& parts, int e, typename Parts::Scalar reading) {
  using Scalar = typename Parts::Scalar;
  const auto& end = parts.far_ends.ends()[e];
  const int k = parts.jacks.find(end.cable(), 1 - end.end);
  if (k < 0 || !(parts.jacks[k].missed > 0)) return;
  auto& jack = parts.jacks[k];
  if (!parts.filter.slides_throughout(parts.tracker, end.cable())) return;
  const Scalar missed = jack.missed;
  jack.missed = 0;
  const auto expected = parts.far_ends.expect(e, parts.tracker, parts.filter, parts.jacks);
  // The least of several rows counts: twice two deviations.
  const Scalar most = std::fabs(reading - expected.value) + 4 * std::sqrt(expected.variance),
               held = held_over(parts.tracker, end.cable()),
               back = jack.best() * (jack.rises ? 1 / held : held);
  const bool may_be_back = jack.rises ? expected.value + most > back : expected.value - most < back;
  jack.missed = may_be_back || most > held * missed ? missed : most / held;
}

/// Of two jacks on one cable one is read in this row and the other one is not: friction holds that one within
/// what the first one pulls. Cost: one product a joint.
template <class Parts>
void follow_other_jack(Parts& parts) {
  using Scalar = typename Parts::Scalar;
  auto& jacks = parts.jacks;
  for (int k = 0; k < jacks.size(); ++k) {
    const auto& end = jacks.end(k);
    const int other = jacks.find(end.cable(), 1 - end.end);
    if (other < 0 || !jacks[k].is_unread || jacks[k].locked || !jacks[other].is_new) continue;
    const Scalar load = jacks[other].at.load,
                 carried = surely_held_over(parts.tracker, end.cable(), Scalar(0.02));
    jacks[k].come_between(carried * load, load / carried, parts.cell(k));
  }
}

}  // namespace taut
