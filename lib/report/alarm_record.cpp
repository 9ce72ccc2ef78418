#include "lib/report/alarm_record.hpp"

#include <sstream>
#include <utility>

namespace taut::host {

void AlarmRecord::add(const LogRow& row, const std::string& words,
                      const std::map<std::string, double>& peaks) {
  const auto before = std::exchange(present_, {});
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const auto same = before.find(word);
    if (same == before.end()) {
      if (present_.find(word) == present_.end()) begin_run(row, word);
      continue;
    }
    present_[word] = same->second;
    if (same->second == not_kept) continue;
    runs_[same->second].last_row = row.row;
    runs_[same->second].last_time = row.time;
  }
  for (const auto& [word, peak] : peaks) follow_peak(row, word, peak);
}

void AlarmRecord::follow_peak(const LogRow& row, const std::string& word, double peak) {
  const auto present = present_.find(word);
  if (present == present_.end() || present->second == not_kept) return;
  AlarmRun& run = runs_[present->second];
  if (run.has_peak && run.peak == peak) return;
  run.has_peak = true;
  run.peak = peak;
  run.peak_time = row.time;
}

void AlarmRecord::begin_run(const LogRow& row, const std::string& word) {
  ++count_;
  if (runs_.size() == most_runs) {
    ++further_[word];
    present_[word] = not_kept;
    return;
  }
  present_[word] = runs_.size();
  runs_.push_back({word, row.row, row.row, row.time, row.time, false, 0, 0});
}

}  // namespace taut::host
