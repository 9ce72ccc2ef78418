// STM32F405: Cortex-M4F, 1 MiB of flash, 128 KiB of RAM and 64 KiB beside the core.
#pragma once

#include "boards/stm32f405/stm32f405.hpp"

namespace boards {

using Board = Stm32f405;

}  // namespace boards
