// How far forces are off their targets, and where on a straight line they are nearest.
#pragma once

#include <vector>

#include "taut/planning/objective.hpp"

namespace taut::host {

/// The largest |T_i - target_i| / target_i over the segments that have a target (greater than zero): that of
/// the core.
double off_target(const std::vector<double>& tension, const std::vector<double>& target);

/// Where the forces are nearest between `from` (part 0) and `to` (part 1), all being linear between, and how
/// near: that of the core, exact.
using NearestPart = taut::NearestPart<double>;
NearestPart nearest_part(const std::vector<double>& from, const std::vector<double>& to,
                         const std::vector<double>& target, double least_part = 0, double most_part = 1);

}  // namespace taut::host
