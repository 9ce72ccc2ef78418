#include "lib/files/log_verdict.hpp"

#include <cstddef>
#include <limits>

#include "lib/files/alarm_words.hpp"
#include "lib/files/plausible_scene.hpp"

namespace taut::host {

LogVerdict::LogVerdict(const SceneDescription& scene) : scene_(&scene), locks_(scene.cables.size()) {}

LogVerdict::LogVerdict(const SceneDescription& scene, const Memory& memory)
    : scene_(&scene), verdict_(memory.raised) {
  for (const auto& ends : memory.locks) locks_.push_back({UnsaidLock(ends[0]), UnsaidLock(ends[1])});
}

Sentence LogVerdict::take(const LogRow& row, const std::string& alarms, bool is_stage) {
  return verdict_.take(alarms + unsaid_locks(row), is_stage);
}

std::string LogVerdict::unsaid_locks(const LogRow& row) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string words;
  for (std::size_t c = 0; c < scene_->cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const CableDescription& cable = scene_->cables[c];
      if (!cable.is_jacked(end) || !(cable.seating > 0)) continue;
      const EndRow &own = row.cables[c][end], &other = row.cables[c][1 - end];
      UnsaidLock& lock = locks_[c][end];
      lock.take(own.reading.value_or(none), cable.is_jacked(1 - end) ? none : other.reading.value_or(none),
                own.locked, first_stage_strain * cable.E * cable.A);
      if (lock.may_hold()) words += " unsaid-lock:" + end_word(cable.name, end);
    }
  return words;
}

LogVerdict::Memory LogVerdict::memory() const {
  Memory memory{verdict_.memory(), {}};
  for (const auto& ends : locks_) memory.locks.push_back({ends[0].memory(), ends[1].memory()});
  return memory;
}

}  // namespace taut::host
