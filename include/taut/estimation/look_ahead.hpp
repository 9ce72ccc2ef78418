// Where the best estimate of a load lies behind the next event: the tracker goes there, and comes back.
#pragma once

#include "taut/estimation/drive.hpp"
#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/estimation/learning.hpp"
#include "taut/estimation/load_memory.hpp"
#include "taut/estimation/two_jacks.hpp"

namespace taut {

/// Notes of every cable whether the best estimate of one of its jacks is beyond the present piece, and not
/// only because something happens to another cable on the way. Returns whether one is beyond it at all. Cost:
/// that of Tracker::reaches() a jack.
template <class Parts>
bool note_beyond(Parts& parts) {
  parts.is_beyond.fill(false);
  bool any = false;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& jack = parts.jacks[k];
    if (!jack.leads() || jack.beyond() == 0 || parts.tracker.reaches(k, jack.best())) continue;
    any = true;
    const int c = parts.jacks.end(k).cable();
    if constexpr (Parts::has_several)
      parts.is_beyond[c] = !parts.slides_ahead[c];
    else
      parts.is_beyond[c] = true;
  }
  return any;
}

/// While it is ahead: whether a best estimate has left the piece there, or has come back.
template <class Parts>
bool is_best_elsewhere(const Parts& parts) {
  using Scalar = typename Parts::Scalar;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& jack = parts.jacks[k];
    if (jack.locked) continue;
    const bool goes_up = jack.driven.force >= parts.confirmed.jack[k].force;
    const Scalar further = goes_up ? jack.beyond() : -jack.beyond();
    if (further > 0 ? !parts.tracker.reaches(k, jack.best()) : further < -jack.at.sd) return true;
  }
  return false;
}

/// While it is ahead: whether all best estimates have gone on the way that it came there.
template <class Parts>
bool is_best_further(const Parts& parts) {
  for (int k = 0; k < parts.jacks.size(); ++k)
    if (parts.jacks[k].beyond() * (parts.jacks[k].driven.force - parts.confirmed.jack[k].force) < 0)
      return false;
  return true;
}

/// To where the loads were confirmed to have come when it went ahead. Cost: that of Tracker::restore().
template <class Parts>
void restore_confirmed(Parts& parts) {
  parts.is_ahead = false;
  static_cast<void>(put_back(parts, parts.confirmed.tracker).ok());
  for (int k = 0; k < parts.jacks.size(); ++k) parts.jacks[k].driven = parts.confirmed.jack[k];
}

/// If it is ahead, to where the loads are confirmed to have come. Cost: that of Tracker::restore().
template <class Parts>
void go_back(Parts& parts) {
  if (parts.is_ahead) restore_confirmed(parts);
}

/// Goes straight to these loads, two jacks as far as friction holds them. Returns whether it is there.
template <class Parts>
bool go_straight(Parts& parts, typename Parts::SampleType to) {
  leave_turns(parts, to);
  const auto progress = drive_straight(parts.tracker, to, Parts::TrackerType::default_budget,
                                       HoldByFriction<false, Parts>{parts});
  return arrive(parts.tracker, parts.jacks, to, progress);
}

/// Goes back, and on to where the loads of this row are confirmed to have come: while it was ahead they may
/// have gone far. Where there is no answer, it stays where it was before it went ahead. Cost: that of
/// go_back() twice, and of a path.
template <class Parts>
void go_back_to_target(Parts& parts) {
  go_back(parts);
  if (!go_straight(parts, parts.jacks.target(parts.jacks.driven(parts.patterns())))) restore_confirmed(parts);
}

/// Where the best estimate of a load lies beyond the present piece, the forces there follow from the events
/// in between: the tracker goes there, and stays while the loads that are confirmed are on their way. Cost:
/// where nothing changes, that of Tracker::reaches() a jack; else of one path or two, and of
/// Tracker::restore().
template <class Parts>
void look_ahead(Parts& parts) {
  if (parts.is_ahead ? !is_best_elsewhere(parts) : !note_beyond(parts)) return;
  if (parts.is_ahead && !is_best_further(parts)) go_back_to_target(parts);
  auto& jacks = parts.jacks;
  if (!parts.is_ahead) {
    learn_waiting(parts);
    parts.tracker.save_into(parts.confirmed.tracker);
    parts.lock_off.is_known = false;
    for (int k = 0; k < jacks.size(); ++k) parts.confirmed.jack[k] = jacks[k].driven;
    parts.is_ahead = true;
  }
  if (!go_straight(parts, jacks.best(jacks.driven(parts.patterns())))) go_back_to_target(parts);
}

/// While it is ahead: nothing is done if the loads of a row lie on the way there. If they have come as far,
/// it is ahead no longer, and else goes back; as it does with several cables, for what is read of one may
/// teach where only the jack of another has to be confirmed. Cost: a few operations a jack, or those of
/// go_back().
template <class Parts>
void follow_ahead(Parts& parts, const Corners<typename Parts::Scalar>& corners,
                  const typename Parts::SampleType& sample) {
  using Scalar = typename Parts::Scalar;
  const auto& jacks = parts.jacks;
  if constexpr (Parts::has_several)
    if (parts.model().cables.size() > 1) {
      for (int c = 0; c < parts.model().cables.size(); ++c)
        parts.slides_ahead[c] = parts.filter.slides_throughout(parts.tracker, c);
      return go_back(parts);
    }
  bool is_on_way = !corners.any(), is_past = is_on_way;
  for (int i = 0; i < parts.patterns(); ++i) is_on_way &= sample.factor[i] == jacks.factor(i);
  for (int k = 0; k < jacks.size(); ++k) {
    const auto& jack = jacks[k];
    is_on_way &= jack.locked == jack.driven.locked && !jack.changes_branch();
    if (jack.locked) continue;
    const Scalar from = parts.confirmed.jack[k].force, to = jack.driven.force, at = jack.target();
    is_past &= (at - to) * (to - from) >= 0;
    is_on_way &= (at - from) * (to - from) >= 0;
  }
  if (!is_on_way) return go_back(parts);
  if (is_past) {
    parts.is_ahead = false;
    return;
  }
  for (int k = 0; k < jacks.size(); ++k) {
    const Scalar from = parts.confirmed.jack[k].force, to = jacks[k].driven.force, at = jacks[k].target();
    if (!jacks[k].locked && (at - to) * (to - from) > 0) return go_back(parts);
  }
}

}  // namespace taut
