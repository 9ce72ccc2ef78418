// Condensation and tracker for scenes of many cables, compiled once.
#pragma once

#include "campaign/many_cables_world.hpp"
#include "support/run.hpp"

namespace support {

extern template class Run<double, campaign::PlaneWeb>;
extern template class Run<float, campaign::PlaneWeb>;
extern template class Run<double, campaign::SpaceWeb>;
extern template class Run<float, campaign::SpaceWeb>;

}  // namespace support
