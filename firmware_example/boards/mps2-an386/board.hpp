// ARM MPS2 with AN386: Cortex-M4F.
#pragma once

#include "boards/cortex_m/mps2.hpp"

namespace boards {

using Board = Mps2;

}  // namespace boards
