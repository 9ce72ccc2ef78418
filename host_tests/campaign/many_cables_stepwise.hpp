// The load steps of the library on scenes of many cables, compiled once.
#pragma once

#include "campaign/many_cables_world.hpp"

namespace campaign {

/// The worst violation of any law after any row, as a part of the largest force; infinite if it stops.
double stepwise_violation(const World<PlaneWeb>& world, int substeps);
double stepwise_violation(const World<SpaceWeb>& world, int substeps);

}  // namespace campaign
