#include "host/memory_monitor.hpp"

namespace monitor::host {

MemoryMonitor::MemoryMonitor(MemoryBoard& board)
    : application_(board),
      modbus_(application_, board.modbus, Settings::modbus_address, Settings::modbus_baud) {}
MemoryMonitor::~MemoryMonitor() = default;

void MemoryMonitor::begin() { application_.begin(); }
void MemoryMonitor::step() { application_.step(); }
void MemoryMonitor::step_modbus() { modbus_.step(); }

}  // namespace monitor::host
