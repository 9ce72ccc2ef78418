// Loads and strokes since the beginning, in as many points as a chart shows.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "lib/live/live_answer.hpp"

namespace taut::host {

/// Keeps every answer as long as there are few; then every second, fourth ... of them, and the last one.
class LoadHistory {
 public:
  static constexpr std::size_t most = 1024;

  void add(const LiveAnswer& live);
  /// `[[time, [[force, stroke], .. a jack], whether there was an alarm], ..]`; null where there is no stroke.
  std::string json() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> points_;
  std::string last_;
  std::size_t count_ = 0, every_ = 1;
};

}  // namespace taut::host
