// Core scenes of every kind the program is compiled for, checked by the core.
#pragma once

#include <memory>

#include "lib/files/scene_description.hpp"
#include "lib/kinds/capacities.hpp"
#include "taut/scene/scene.hpp"

namespace taut::host {

/// A scene of the kind `SceneKind<Dimension, Cap>`, built and found valid. Throws InputError if it is not.
/// Compiled for each kind in a unit of its own.
template <int Dimension, class Cap>
std::unique_ptr<Scene<double, Dimension, Cap>> make_valid_scene(const SceneDescription& described);

/// Throws InputError unless the mechanics of the scene can be used: sizes, geometry, stiffnesses, supports;
/// or if they are surely a mistake, see require_plausible().
void require_valid(const SceneDescription& described);

}  // namespace taut::host
