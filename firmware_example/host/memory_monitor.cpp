#include "host/memory_monitor.hpp"

namespace monitor::host {

MemoryMonitor::MemoryMonitor(MemoryBoard& board) : application_(board) {}
MemoryMonitor::~MemoryMonitor() = default;

void MemoryMonitor::begin() { application_.begin(); }
void MemoryMonitor::step() { application_.step(); }

}  // namespace monitor::host
