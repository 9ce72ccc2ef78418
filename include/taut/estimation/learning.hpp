// What becomes of a reading: it is known, waits for others, tells nothing, or raises an alarm.
#pragma once

#include "taut/estimation/estimator_parts.hpp"

namespace taut {

/// What came of so many readings of an instrument; `contradiction` is the alarm if they contradict.
template <class Parts>
void note(Parts& parts, Update update, const Alarm& contradiction, int readings = 1) {
  if (update == Update::updated) {
    parts.is_belief_fine = false;
    parts.learned(contradiction, readings, parts.filter);
    for (int k = 0; k < parts.jacks.size() && parts.filter.belief().has_errors(); ++k)
      parts.jacks[k].teach(readings);
  } else if (update == Update::contradiction) {
    parts.alarms.add(contradiction);
  } else if (update == Update::no_information) {
    parts.alarms.add(Alarm::of(Alarm::Kind::no_information, contradiction.cable, contradiction.place));
  }
}

/// Nothing of the row has been measured yet.
template <class Parts>
void begin_row(Parts& parts) {
  parts.filter.begin_row();
  parts.far_ends.begin_row();
}

/// The loads are where the tracker is, and it may have changed which cables the model has slide throughout.
/// Cost: a pass over the joints, if there is an instrument to learn from.
template <class Parts>
void follow_sliding(Parts& parts) {
  if (!parts.has_instruments()) return;
  parts.sliding_way.go(parts.sum_of_loads());
  for (int c = 0; c < parts.model().cables.size(); ++c)
    parts.sliding_way.follow(c, parts.filter.slides_throughout(parts.tracker, c));
}

/// Readings of the far end that were gathered are taken into account. Cost: that of FarEnds::learn().
template <class Parts>
void learn_waiting(Parts& parts) {
  auto& far_ends = parts.far_ends;
  if (!far_ends.has_waiting()) return;
  const int readings = far_ends.waiting();
  note(parts, far_ends.learn(parts.tracker, parts.filter, parts.jacks),
       Parts::alarm_at(Alarm::Kind::sensor, far_ends.ends()[0]), readings);
}

/// Before another instrument is taken into account: nothing else of the row waits. Cost: that of
/// learn_waiting().
template <class Parts>
void wait_for_none(Parts& parts) {
  // The errors of the jack that they share.
  if (!parts.far_ends.has_waiting()) return;
  const bool shares_row = parts.far_ends.has_waiting_of_row();
  learn_waiting(parts);
  if (!shares_row) begin_row(parts);
}

}  // namespace taut
