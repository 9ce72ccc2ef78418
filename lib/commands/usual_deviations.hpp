// What `estimate` takes for what a scene does not say of how well things are known.
#pragma once

#include <string>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Gives every cable without one a standard deviation of mu: half of it. Returns a remark on each.
std::vector<std::string> fill_in_mu_deviations(SceneDescription& scene);

/// Gives the scene standard deviations where it has none: half of mu; 0.5 % of the largest reading of a load
/// cell at an anchored end; of a measured force of a segment or strut its scatter in the log, 1 % of gain and
/// 0.2 % of the largest reading for the zero; of a stroke 1 mm and a free zero. Returns a remark on each.
std::vector<std::string> fill_in_deviations(const std::string& path, const LogRules& rules,
                                            SceneDescription& scene);

}  // namespace taut::host
