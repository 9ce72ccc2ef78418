// What a row measures beside the jacks' loads: load cells at anchored ends.
#pragma once

#include "taut/estimation/draw_in.hpp"
#include "taut/estimation/learning.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/witness.hpp"

namespace taut {

/// The noise of the cells at anchored ends: the filter goes by the scatter that there is. Cost: that of
/// CellWatch::follow_noise() a cell, and where readings scatter more than before that of Belief::inflate().
template <class Parts>
[[gnu::always_inline]] inline void follow_cell_noise(Parts& parts,
                                                     const typename Parts::ReadingsType& readings,
                                                     Corners<typename Parts::Scalar>& corners) {
  auto& far_ends = parts.far_ends;
  for (int e = 0; e < far_ends.ends().size(); ++e) {
    const auto& given = far_ends.ends()[e].in(readings.ends);
    if (parts.can_be(given, far_ends.ends()[e].cable()))
      corners.times_noise =
          larger(corners.times_noise, far_ends.watch(e).follow_noise(given.force, readings.dt));
  }
  if (corners.times_noise > 1) parts.filter.inflate(corners.times_noise);
}

/// The cell at the far end of a cable that is locked tells how far its wedge was drawn in, as long as nothing
/// else happens, and what has strained it since. Cost: that of learn_draw_in(), of FarEnds::correct(), and at
/// worst of FrictionFilter::follow_drift().
template <class Parts>
Update correct_held(Parts& parts, int e, typename Parts::Scalar reading) {
  auto& far_ends = parts.far_ends;
  const int c = far_ends.ends()[e].cable(), drift = parts.drift[c];
  int k = 0;
  while (parts.jacks.end(k).cable() != c) ++k;
  Update update = Update::no_information;
  if constexpr (Parts::has_seating)
    if (parts.lock_off.is_known && parts.jacks[k].seating >= 0 && is_of_lock_off(parts, k)) {
      const auto force = [&] { return parts.tracker.tension(far_ends.ends()[e].segment(parts.model())); };
      const auto before = force();
      update = learn_draw_in(parts, k, e, reading);
      far_ends.since_lock_off(e).correct(force() - before);
    }
  if (drift < 0) {
    static_cast<void>(far_ends.compare(e, reading, parts.tracker, parts.filter, parts.jacks));
    return update;
  }
  if (update == Update::contradiction) return update;
  const auto is_corrected = [&](int p) { return p == drift; };
  update = far_ends.correct(e, reading, parts.tracker, parts.filter, parts.jacks, is_corrected);
  // A failure shows in the next row.
  if (update == Update::updated && parts.filter.moved(is_corrected) > far_ends.watch(e).sd)
    static_cast<void>(parts.filter.follow_drift(parts.tracker, drift, c, parts.jacks.end(k).end));
  return update;
}

/// A reading of the cell at anchored end `e`; the tracker is where the loads are confirmed to have come, if
/// it is not ahead for the jacks of this cable. `gathers` is whether it is gathered with others. Returns
/// whether anything was learned. Cost: an update at most.
template <class Parts>
bool measure_far_end(Parts& parts, int e, typename Parts::Scalar reading, bool gathers) {
  auto& far_ends = parts.far_ends;
  const auto& end = far_ends.ends()[e];
  auto& watch = far_ends.watch(e);
  if (watch.stays_frozen(reading)) {
    parts.alarms.add(Parts::alarm_at(Alarm::Kind::frozen, end));
    return false;
  }
  if (gathers && far_ends.mixes(parts.filter, parts.jacks)) learn_waiting(parts);
  const int readings = gathers ? far_ends.waiting() + 1 : 1;
  if (!gathers && !parts.is_ahead) follow_sliding(parts);
  const auto teaches = [&](int c) { return parts.teaches(c); };
  const Update update =
      parts.is_corrected(end.cable()) ? correct_held(parts, e, reading)
      : parts.is_ahead                ? far_ends.compare(e, reading, parts.tracker, parts.filter, parts.jacks)
      : gathers                       ? far_ends.gather(reading, parts.tracker, parts.filter, parts.jacks)
                : far_ends.measure(e, reading, parts.tracker, parts.filter, parts.jacks, teaches);
  // Once, as long as it lasts; and where friction is known there is nothing to be told.
  const bool is_told =
      update == Update::no_information && (watch.is_told || !parts.filter.belief().has_friction());
  watch.is_told = update == Update::no_information;
  if (update != Update::waits && !is_told)
    note(parts, update, Parts::alarm_at(Alarm::Kind::sensor, end), readings);
  return update == Update::updated;
}

/// What a reading that measure_far_end() has taken says of a cable that wedges hold, where nothing takes up
/// what strains it. Cost: a few operations.
template <class Parts>
[[gnu::noinline]] void follow_since_lock_off(Parts& parts, int e,
                                             const typename Parts::ReadingsType& readings,
                                             typename Parts::Scalar reading) {
  const auto& end = parts.far_ends.ends()[e];
  const int c = end.cable();
  const auto& watch = parts.far_ends.watch(e);
  auto& since = parts.far_ends.since_lock_off(e);
  if (watch.is_frozen) return;
  if (parts.drift[c] >= 0 || !parts.is_held(c)) {
    since = {};
    return;
  }
  const std::size_t other = 1 - end.end;
  const auto& jack = readings.ends[c][other];
  if (parts.can_be(jack, c)) since.follow_jack(jack.force, parts.filter.prior().cell[c][other].noise());
  since.take(reading, parts.tracker.tension(end.segment(parts.model())), watch.sd, watch.lasts);
}

/// A reading of the cell at anchored end `e` that waits, see sees_unread(): what the cell would read in this
/// row, in which the jack of its cable is read and it is not. None where the load has not come straight on.
/// Cost: a few operations.
template <class Parts>
[[gnu::noinline]] EndReading<typename Parts::Scalar> read_in_turn(Parts& parts, int e) {
  constexpr int straight = 3;
  const auto& end = parts.far_ends.ends()[e];
  auto& between = parts.far_ends.between(e);
  const int k = parts.jacks.find(end.cable(), 1 - end.end);
  const auto& jack = parts.jacks[k];
  EndReading<typename Parts::Scalar> read;
  if (jack.is_unread) return read;
  if (jack.is_new && !jack.locked && !jack.is_in_doubt() && jack.filter.run_length() >= straight) {
    read.has_force = true;
    read.force =
        between.taken_on(parts.tracker.slope(k, end.segment(parts.model())), jack.at.load, jack.stride);
  }
  between.drop();
  return read;
}

/// The cells at anchored ends of the cables with is_chosen(cable). Returns whether anything was learned.
/// Cost: that of measure_far_end() for each.
template <class Parts, class IsChosen>
bool measure_far_ends(Parts& parts, const typename Parts::ReadingsType& readings, bool gathers,
                      const IsChosen& is_chosen) {
  auto& far_ends = parts.far_ends;
  bool learns = false;
  for (int e = 0; e < far_ends.ends().size(); ++e) {
    const auto& end = far_ends.ends()[e];
    if (!is_chosen(end.cable())) continue;
    const auto& read = end.in(readings.ends);
    auto& between = far_ends.between(e);
    EndReading<typename Parts::Scalar> waited;
    if (read.has_force)
      between.drop();
    else if (between.waits())
      waited = read_in_turn(parts, e);
    const auto& given = read.has_force ? read : waited;
    const bool is_reading = parts.can_be(given, end.cable());
    if (given.has_force && !is_reading) parts.alarms.add(Parts::alarm_at(Alarm::Kind::sensor, end));
    if (is_reading && sees_unread(parts, e, given.force)) continue;
    // Another cable's load that is in doubt makes the reading less certain; its own, what slides.
    const bool in_doubt = parts.loads_are_in_doubt(end.cable());
    far_ends.begin_memory();
    if (in_doubt && is_reading && parts.loads_are_read(end.cable()))
      far_ends.compare_in_doubt(e, given.force, parts.tracker, parts.filter, parts.jacks);
    if (!in_doubt && is_reading) {
      bound_missed(parts, e, given.force);
      learns |= measure_far_end(parts, e, given.force, gathers);
      if (parts.is_held(end.cable()) || far_ends.since_lock_off(e).has_begun())
        follow_since_lock_off(parts, e, readings, given.force);
    }
    if (far_ends.corrects_memory()) correct_turned(parts);
    if (in_doubt) continue;
    if (!far_ends.misfits(e)) continue;
    parts.misfits = true;
    if (given.has_force) parts.alarms.add(Parts::alarm_at(Alarm::Kind::misfit, end));
  }
  return learns;
}

/// All cells at anchored ends: where the loads are confirmed to have come, and those of cables whose jacks
/// are beyond the present piece once the tracker is ahead, where it then stays. Cost: that of
/// measure_far_end() for each, and of look_ahead().
template <class Parts>
[[gnu::always_inline]] inline void measure_far_ends(Parts& parts,
                                                    const typename Parts::ReadingsType& readings) {
  const bool any = parts.is_ahead || note_beyond(parts);
  if (!parts.loads_are_in_doubt()) parts.misfits = false;
  // With one cable all are, or none.
  if constexpr (!Parts::has_several) {
    if (any) look_ahead(parts);
    const bool gathers = !any && parts.far_ends.gathers(parts.jacks);
    if (measure_far_ends(parts, readings, gathers, [](int) { return true; })) look_ahead(parts);
    return;
  }
  const auto is_beyond = parts.is_beyond;
  const bool learns = measure_far_ends(parts, readings, !any && parts.far_ends.gathers(parts.jacks),
                                       [&](int c) { return !is_beyond[c]; });
  if (any || learns) look_ahead(parts);
  if (any) measure_far_ends(parts, readings, false, [&](int c) { return is_beyond[c]; });
}

}  // namespace taut
