// Jacks that hold one another alone, as the two that stay a pinned mast.
#pragma once

#include <string>

#include "lib/files/scene_file.hpp"
#include "lib/kinds/condensed_arrays.hpp"

namespace taut::host {

/// What to say of jacks whose forces alone pull at something: while all of them are given, it moves and no
/// tension changes, so that there is an answer only where they balance. Empty if there are none, and in
/// second-order theory, where tension may hold it.
std::string balance_warning(const SceneDescription& scene, const CondensedArrays& condensed);

}  // namespace taut::host
