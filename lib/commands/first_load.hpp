// Whether cables were under load before the first row of a log.
#pragma once

#include <string>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Whether some jack pulls in the first row more than 5 % of what it ever does, and did not come there from
/// zero in one stage: the next row goes on by less than 0.8 of that.
bool begins_under_load(const std::string& path, const LogRules& rules, const SceneDescription& scene);

}  // namespace taut::host
