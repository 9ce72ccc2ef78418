// A wedge that may have held before the log says so: the load of its jack fell until it was locked.
#pragma once

#include <cmath>

#include "taut/estimation/alarms.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Whether jack `k`, which is locked in this row, may have been let out with its wedge in place already:
/// nobody locks an end while its load falls, or once there is next to none left. That is so if its load
/// surely went down in the last row in which it was read, but for load stages, which are rests, by more than
/// a twentieth of where it turned, or to less than half of that, for a jack may be released to what it is
/// locked at; or if it is less than a tenth of that. Cost: a few operations.
template <class Parts>
bool may_have_held_before(const Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& jack = parts.jacks[k];
  const Scalar from = parts.turned.force(parts.end_segment(k));
  const bool falls = jack.went_on && !jack.was_stage();
  // A release to lock-off is slower.
  const bool is_let_out = falls && jack.step_by > Scalar(0.05) * from;
  return jack.locks_now && !jack.locks_rising() &&
         (is_let_out || jack.at.load < (falls ? Scalar(0.5) : Scalar(0.1)) * from);
}

/// Of such jacks: where the wedge held before, forces are between those that there are now and those from
/// which the load fell, which bars have from here on. Cost: a pass over the segments of their cables.
template <class Parts>
void widen_late_locks(Parts& parts) {
  using Scalar = typename Parts::Scalar;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    if (!may_have_held_before(parts, k)) continue;
    parts.jacks[k].locked_late = true;
    parts.alarms.add(Parts::alarm_at(Alarm::Kind::late_lock, parts.jacks.end(k)));
    const auto& cable = parts.model().cables[parts.jacks.end(k).cable()];
    for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
      const Scalar force = parts.tracker.tension(i), fallen = std::fabs(parts.turned.force(i) - force);
      parts.turned.turn(i, force, larger(fallen, parts.turned.deviation_by_loads(i, force)));
    }
  }
}

}  // namespace taut
