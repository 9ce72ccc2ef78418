// The way of a jack since it turned last, which is gone anew where friction turns out to be another one.
#pragma once

#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/estimation/look_ahead.hpp"

namespace taut {

/// No jack is on a way that could be gone anew.
template <class Parts>
void forget_leg(Parts& parts) {
  if constexpr (Parts::legs > 0) parts.leg[0].is_known = false;
}

/// Jack `k` has turned here, or was locked, and leaves with the next path. Cost: that of Tracker::save().
template <class Parts>
void begin_leg(Parts& parts, int k) {
  if constexpr (Parts::legs > 0) {
    if (parts.gauges.size() == 0) return;
    auto& leg = parts.leg[0];
    leg.is_known = !parts.jacks[k].locked;
    if (!leg.is_known) return;
    parts.tracker.save_into(leg.from);
    leg.linearized_at = parts.filter.belief().save().linearized_at;
    for (int j = 0; j < parts.jacks.size(); ++j) leg.erred_up[j] = parts.jacks[j].erred_up;
  }
}

/// Whether the load of one jack alone has changed since it began: the way was straight.
template <class Parts>
bool is_on_leg(const Parts& parts) {
  if (!parts.leg[0].is_known) return false;
  const auto& from = parts.leg[0].from.now;
  const auto& to = parts.tracker.loads();
  for (int i = 0; i < parts.patterns(); ++i)
    if (from.factor[i] != to.factor[i]) return false;
  int moved = 0;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& before = parts.jacks.in(from.jack, k);
    const auto& now = parts.jacks.in(to.jack, k);
    if (before.locked != now.locked) return false;
    if (!now.locked && before.force != now.force) ++moved;
  }
  return moved < 2;
}

/// Brings the tracker to a state that it had with the model linearized at `there`, but with the unknowns at
/// other values. False if there is none; then the tracker is elsewhere. Cost: those of Tracker::restore() and
/// adjust().
template <class Parts>
bool go_back_to(Parts& parts, const typename Parts::TrackerType::State& from,
                const typename Parts::Values& there, const typename Parts::Values& values) {
  static_cast<void>(parts.filter.linearize_at(there));
  const bool is_there = put_back(parts, from).ok();
  const auto change = parts.filter.linearize_at(values);
  return is_there && parts.tracker.adjust(parts.filter.friction(parts.linear()), change).ok();
}

/// Goes the leg anew with friction at these values of the unknowns; the tracker is not ahead. False if that
/// cannot be: then all is as it was. Cost: that of go_back_to(), of a path, and of Tracker::restore().
template <class Parts>
bool go_leg_anew(Parts& parts, const typename Parts::Values& values) {
  const auto before = parts.filter.belief().save().linearized_at;
  // Not in use while the tracker is not ahead.
  auto& here = parts.confirmed.tracker;
  parts.tracker.save_into(here);
  parts.lock_off.is_known = false;
  const auto to = parts.jacks.driven(parts.patterns());
  FixedArray<bool, Parts::JacksType::capacity> erred_up;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    erred_up[k] = parts.jacks[k].erred_up;
    parts.jacks[k].erred_up = parts.leg[0].erred_up[k];
  }
  bool is_there = go_back_to(parts, parts.leg[0].from, parts.leg[0].linearized_at, values);
  if (is_there) {
    leave(parts, to);
    is_there = parts.tracker.advance(to).is_complete();
  }
  if (is_there) return true;
  for (int k = 0; k < parts.jacks.size(); ++k) parts.jacks[k].erred_up = erred_up[k];
  static_cast<void>(parts.filter.linearize_at(before));
  static_cast<void>(put_back(parts, here).ok());
  return false;
}

/// Brings the tracker to these values of the unknowns, and ahead again if it was. Where a jack comes back,
/// how far each joint has slid depends on friction, and not in proportion: the leg is gone anew. What came
/// before is moved by its derivatives, which is exact where all joints slid. False if there is no state
/// there: then the tracker stays. Cost: that of go_leg_anew(), and of look_ahead().
template <class Parts>
bool relinearize(Parts& parts, const typename Parts::Values& values) {
  const bool was_ahead = parts.is_ahead;
  go_back(parts);
  bool is_there = false;
  if constexpr (Parts::legs > 0) is_there = is_on_leg(parts) && go_leg_anew(parts, values);
  if (!is_there) is_there = parts.filter.relinearize(parts.tracker, values);
  if (was_ahead) look_ahead(parts);
  return is_there;
}

}  // namespace taut
