// What is known of a structure at one moment, for all who look on.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/live/plan_now.hpp"

namespace taut::host {

/// One jacked end at one moment.
struct JackNow {
  std::size_t cable = 0, end = 0;
  double force = 0;                       ///< as estimated [N]
  std::optional<double> reading, stroke;  ///< of this row: [N], [m]
};

/// The answer to a row, or what is said between two rows.
struct LiveAnswer {
  std::size_t row = 0;  ///< how many there were; 0: none has come yet, and there are no numbers
  double time = 0;      ///< [s]
  Answer answer;
  std::vector<JackNow> jacks;
  std::vector<std::string> alarms, notices;  ///< words, see alarm_word(), and those of the line
  std::shared_ptr<const PlanNow> plan;       ///< null without a goal
  std::string json;                          ///< see answer_json()
};

/// The jacks after a row. Where the log has no column of a stroke it is the extension that is computed.
std::vector<JackNow> jacks_of(const SceneDescription& scene, const LogRow& row, const Answer& answer,
                              const std::vector<std::array<bool, 2>>& has_stroke);

/// The words of a list that blanks separate.
std::vector<std::string> words_of(const std::string& list);

/// Lower and upper end of the 95 % band of a force [N].
std::array<double, 2> force_band(double force, double sd);

/// The answer on one line of JSON: `time`, `segments`, `joints`, `jack`, `alarms`, `notices`, and with a
/// goal `plan`.
std::string answer_json(const SceneDescription& scene, const LiveAnswer& live);

}  // namespace taut::host
