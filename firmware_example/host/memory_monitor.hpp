// The application on a board of memory, compiled once for all programs that use it.
#pragma once

#include "host/memory_board.hpp"
#include "host/shared_estimators.hpp"
#include "monitor/modbus_slave.hpp"
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
  /// Of the Modbus line.
  void step_modbus();

 private:
  Monitor<MemoryBoard> application_;
  ModbusSlave<Monitor<MemoryBoard>, MemoryLine> modbus_;
};

}  // namespace monitor::host
