// The alarms or the notices of a log, those of consecutive rows joined.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "lib/files/log_file.hpp"

namespace taut::host {

/// The same alarm in consecutive rows.
struct AlarmRun {
  std::string word;  ///< as in the result: kind and place
  std::size_t first_row = 0, last_row = 0;
  double first_time = 0, last_time = 0;
  bool has_peak = false;
  double peak = 0, peak_time = 0;  ///< how far a force went beyond a limit [N], and when
};

/// Takes the alarms of a log row by row. What a table could not show is counted.
class AlarmRecord {
 public:
  static constexpr std::size_t most_runs = 500;

  /// The next row, with the words of its alarms separated by blanks, and what they are the peaks of.
  void add(const LogRow& row, const std::string& words, const std::map<std::string, double>& peaks = {});

  /// In the order in which they began; the first `most_runs` of them.
  const std::vector<AlarmRun>& runs() const { return runs_; }
  /// How many there are beyond runs(), by word.
  const std::map<std::string, std::size_t>& further() const { return further_; }
  /// All of them.
  std::size_t count() const { return count_; }

 private:
  void begin_run(const LogRow& row, const std::string& word);
  void follow_peak(const LogRow& row, const std::string& word, double peak);

  static constexpr std::size_t not_kept = static_cast<std::size_t>(-1);

  std::vector<AlarmRun> runs_;
  std::map<std::string, std::size_t> present_;  // alarms of the row before, and where they are in runs_
  std::map<std::string, std::size_t> further_;
  std::size_t count_ = 0;
};

}  // namespace taut::host
