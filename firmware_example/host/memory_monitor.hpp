// The application on a board of memory, compiled once for all programs that use it.
#pragma once

#include "host/memory_board.hpp"
#include "monitor/scenes.hpp"

namespace monitor {

extern template class Application<host::MemoryBoard, Settings, FromFlash<FlashScene>,
                                  CondensedAtStartUp<scenes::truss_string>>;

namespace host {

using MemoryMonitor = Monitor<MemoryBoard>;

}  // namespace host
}  // namespace monitor
