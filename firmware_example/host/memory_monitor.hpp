// The application on a board of memory, compiled once for all programs that use it.
#pragma once

#include "host/memory_board.hpp"
#include "monitor/scenes.hpp"

namespace monitor::host {

/// Its functions are not inline: they would be compiled again wherever they are called.
class MemoryMonitor {
 public:
  explicit MemoryMonitor(MemoryBoard& board);
  ~MemoryMonitor();
  MemoryMonitor(const MemoryMonitor&) = delete;
  MemoryMonitor& operator=(const MemoryMonitor&) = delete;

  void begin();
  void step();

 private:
  Monitor<MemoryBoard> application_;
};

}  // namespace monitor::host
