// Reads goal files.
#pragma once

#include <string>

#include "lib/files/scene_description.hpp"
#include "lib/plan/goal.hpp"

namespace taut::host {

/// Most moves of jacks that a goal may ask for.
inline constexpr int most_stages = 24;

/// Reads a goal for the scene. Throws InputError, with the place as a JSON pointer, for what does not fit:
/// what no scene can be asked for, and what this one has no jack for.
PlanGoal read_goal_file(const std::string& path, const SceneDescription& scene);

}  // namespace taut::host
