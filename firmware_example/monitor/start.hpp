// Why the device began to run.
#pragma once

#include <cstdint>

namespace monitor {

enum class Start : std::uint8_t { power_on, commanded, watchdog };

}  // namespace monitor
