// Alarms in words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "lib/files/answer.hpp"
#include "lib/files/scene_description.hpp"
#include "taut/estimation/alarms.hpp"

namespace taut::host {

/// A name with `_` for its blanks, for words that blanks separate.
inline std::string without_blanks(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// `C.start` or `C.end`, without blanks.
inline std::string end_word(const std::string& cable, std::size_t end) {
  return without_blanks(cable) + "." + end_name(end);
}

/// `outlier:C.end`, `sensor:C.start`, `mu:C`, `mu:C.3`, `stuck:C.3`, `elongation:C.end`, `force-high:C.T3`,
/// `force-low:C.T3`, `no-information:C.start`, `gauge:strut3`, `gauge:C.T3`, `lift-off:C.end`,
/// `model-misfit:C.start`, `frozen:C.start`, `gain:C.start`, `unread:C.end`, `late-lock:C.end`,
/// `early-unlock:C.end` or `unknown-past:C`; joints, segments and struts are counted from 1, blanks in a name
/// are `_`.
inline std::string alarm_word(const Alarm& alarm, const SceneDescription& scene) {
  const std::string number = std::to_string(alarm.place + 1);
  const bool is_at_strut = alarm.cable < 0;
  const std::string cable =
      is_at_strut ? "" : without_blanks(scene.cables[static_cast<std::size_t>(alarm.cable)].name);
  const std::string end =
      is_at_strut ? "strut" + number : end_word(cable, static_cast<std::size_t>(alarm.place == 0 ? 0 : 1));
  switch (alarm.kind) {
    case Alarm::Kind::outlier:
      return "outlier:" + end;
    case Alarm::Kind::sensor:
      return "sensor:" + end;
    case Alarm::Kind::mu_band:
      return "mu:" + cable + (alarm.place < 0 ? "" : "." + number);
    case Alarm::Kind::stuck_joint:
      return "stuck:" + cable + "." + number;
    case Alarm::Kind::elongation:
      return "elongation:" + end;
    case Alarm::Kind::force_high:
      return "force-high:" + cable + ".T" + number;
    case Alarm::Kind::force_low:
      return "force-low:" + cable + ".T" + number;
    case Alarm::Kind::no_information:
      return "no-information:" + end;
    case Alarm::Kind::strut:
      return "gauge:" + end;
    case Alarm::Kind::segment:
      return "gauge:" + cable + ".T" + number;
    case Alarm::Kind::unknown_past:
      return "unknown-past:" + cable;
    case Alarm::Kind::misfit:
      return "model-misfit:" + end;
    case Alarm::Kind::gain:
      return "gain:" + end;
    case Alarm::Kind::unread:
      return "unread:" + end;
    case Alarm::Kind::late_lock:
      return "late-lock:" + end;
    case Alarm::Kind::early_unlock:
      return "early-unlock:" + end;
    case Alarm::Kind::frozen:
      return "frozen:" + end;
    case Alarm::Kind::lift_off:
      return "lift-off:" + end;
  }
  return "";
}

/// Adds one to the alarms of an answer, or to its notices.
inline void add_alarm(const Alarm& alarm, const SceneDescription& scene, Answer& answer) {
  std::string& words = alarm.is_notice() ? answer.notices : answer.alarms;
  words += (words.empty() ? "" : " ") + alarm_word(alarm, scene);
}

/// Puts all of a list in place of what the answer had.
template <class Alarms>
void read_alarms(const Alarms& alarms, const SceneDescription& scene, Answer& answer) {
  answer.alarms.clear();
  answer.notices.clear();
  for (const Alarm& alarm : alarms) add_alarm(alarm, scene, answer);
}

}  // namespace taut::host
