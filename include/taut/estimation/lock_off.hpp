// Wedges that are drawn in, and how it would have gone with other unknowns.
#pragma once

#include <cstddef>

#include "taut/estimation/leg.hpp"

namespace taut {

/// Whether jack `k` was at work where the last lock-off began, and is locked now.
template <class Parts>
bool is_of_lock_off(const Parts& parts, int k) {
  return !parts.jacks.in(parts.confirmed.tracker.now.jack, k).locked && parts.jacks[k].locked;
}

/// Calls visit(jack) for every one whose wedge was drawn in in the last lock-off, which is known.
template <class Parts, class Visit>
void for_each_of_lock_off(const Parts& parts, const Visit& visit) {
  for (int k = 0; k < parts.jacks.size(); ++k)
    if (is_of_lock_off(parts, k)) visit(k);
}

/// Calls visit(unknown) for those that mean something else once jack `k` is locked: by how much further its
/// wedge was drawn in, and the strain that its cable takes on.
template <class Parts, class Visit>
void for_each_of_lock(const Parts& parts, int k, const Visit& visit) {
  const int seating = parts.jacks[k].seating, drift = parts.drift[parts.jacks.end(k).cable()];
  if (Parts::has_seating && seating >= 0) visit(seating);
  if (drift >= 0) visit(drift);
}

/// The unknown of jack `k` will be how far its wedge is drawn in now; what it was stays a part of it, and
/// forces as uncertain.
template <class Parts>
void keep_draw_in(Parts& parts, int k) {
  const int p = parts.jacks[k].seating, c = parts.jacks.end(k).cable();
  if (p < 0) return;
  const auto sd = parts.filter.prior().seating_sd[c], still_in = parts.filter.still_in(p, sd);
  parts.lock_off.still_in[k] = still_in;
  const auto& cable = parts.model().cables[c];
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
    parts.turned.keep_drawn(i, parts.tracker.tension(i), p, still_in * sd);
}

/// The wedges of all jacks that lock in this row are about to be drawn in. Cost: that of Tracker::save(), and
/// at worst of Tracker::adjust() an unknown and once more.
template <class Parts>
void begin_lock_off(Parts& parts) {
  bool is_unknown = false;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    if (!parts.jacks[k].locks_now) continue;
    for_each_of_lock(parts, k, [&](int p) { parts.filter.keep_what_is_known(parts.tracker, p); });
    if constexpr (Parts::has_seating) keep_draw_in(parts, k);
    is_unknown |= Parts::has_seating && parts.jacks[k].seating >= 0;
  }
  // Draw-ins are tried with this friction, and how far joints slide back is not in proportion to it.
  if (is_unknown) parts.filter.come_to_what_is_known(parts.tracker);
  // Not in use while the tracker is not ahead.
  parts.tracker.save_into(parts.confirmed.tracker);
  parts.lock_off.linearized_at = parts.filter.belief().save().linearized_at;
  parts.lock_off.read.fill({});
  parts.lock_off.is_known = true;
}

/// Whether anything has changed since the wedges were drawn in, of all that cables feel.
template <class Parts>
bool has_gone_on(const Parts& parts, const typename Parts::SampleType& target) {
  for (int i = 0; i < parts.patterns(); ++i)
    if (target.factor[i] != parts.jacks.factor(i)) return true;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& to = parts.jacks.in(target.jack, k);
    const auto& at = parts.jacks[k].driven;
    if (to.locked != at.locked || (!to.locked && to.force != at.force)) return true;
  }
  return false;
}

/// Brings the tracker to where the wedges of the last lock-off, which is known, were about to be drawn in,
/// with friction at these values. Returns the values that unknowns have there. False if there is no state
/// there.
template <class Parts>
bool go_before_lock_off(Parts& parts, typename Parts::Values& values) {
  for_each_of_lock_off(parts, [&](int k) {
    for_each_of_lock(parts, k, [&](int p) { values[p] = parts.lock_off.linearized_at[p]; });
  });
  return go_back_to(parts, parts.confirmed.tracker, parts.lock_off.linearized_at, values);
}

/// Draws the wedges of the jacks in, by so much [m] more than the model has it or, if they are locked
/// already, on. False if that has no answer. Cost: that of Tracker::seat().
template <class Parts>
[[gnu::noinline]] bool seat(Parts& parts, const typename Parts::DrawnFurther& further) {
  const auto to = parts.jacks.driven(parts.patterns());
  return parts.tracker.seat(to, [&](int c, std::size_t end) { return further[parts.jacks.find(c, end)]; })
      .is_complete();
}

/// By how much further [m] wedges were drawn in in the last lock-off, with these values of the unknowns.
template <class Parts>
typename Parts::DrawnFurther drawn_further(const Parts& parts, const typename Parts::Values& values) {
  typename Parts::DrawnFurther further;
  if constexpr (Parts::has_seating)
    for_each_of_lock_off(parts, [&](int k) {
      if (const int p = parts.jacks[k].seating; p >= 0) further[k] = values[p];
    });
  return further;
}

/// Draws the wedges of the last lock-off, which is known, in anew, with these values of the unknowns: with
/// that friction, and by what they say. False if there is no state there; then the tracker is elsewhere.
/// Cost: those of Tracker::restore(), and of two adjust(), seat() and strain().
template <class Parts>
[[gnu::noinline]] bool lock_anew(Parts& parts, const typename Parts::Values& values) {
  auto& tracker = parts.tracker;
  auto& filter = parts.filter;
  auto before = values;
  if (!go_before_lock_off(parts, before)) return false;
  leave_turns(parts, parts.jacks.driven(parts.patterns()));
  bool is_there = seat(parts, drawn_further(parts, values)), drifts = false;
  if constexpr (Parts::has_seating)
    for_each_of_lock_off(parts, [&](int k) {
      const int p = parts.jacks[k].seating;
      if (p < 0) return;
      const auto& at = parts.jacks.end(k);
      before[p] = values[p];
      tracker.draw_in(p, at.cable(), at.end, parts.lock_off.still_in[k]);
      is_there = is_there && tracker.advance(parts.jacks.driven(parts.patterns())).is_complete();
    });
  for_each_of_lock_off(parts, [&](int k) {
    const auto& at = parts.jacks.end(k);
    const int p = parts.drift[at.cable()];
    if (!is_there || !parts.drifts(at.cable())) return;
    before[p] = 0;
    drifts |= values[p] != 0;
    is_there = tracker.strain(p, at.cable(), at.end, filter.prior().length).ok();
  });
  static_cast<void>(filter.linearize_at(before));
  const auto change = filter.linearize_at(values);
  if (is_there && drifts) is_there = tracker.adjust(filter.friction(parts.linear()), change).ok();
  return is_there;
}

}  // namespace taut
