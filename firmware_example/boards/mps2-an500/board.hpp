// ARM MPS2 with AN500: Cortex-M7.
#pragma once

#include "boards/cortex_m/mps2.hpp"

namespace boards {

using Board = Mps2;

}  // namespace boards
