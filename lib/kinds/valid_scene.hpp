// Core scenes of every kind the program is compiled for, checked by the core.
#pragma once

#include <memory>

#include "lib/files/scene_description.hpp"
#include "lib/files/status_text.hpp"
#include "lib/kinds/scene_build.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/validation.hpp"

namespace taut::host {

/// A scene of the kind `SceneKind<Dimension, Cap>`, built and found valid. Throws InputError if it is not.
template <int Dimension, class Cap>
std::unique_ptr<Scene<double, Dimension, Cap>> make_valid_scene(const SceneDescription& described) {
  auto scene = std::make_unique<Scene<double, Dimension, Cap>>();
  build(described, *scene);
  const Status status = validate(*scene);
  if (!status) throw scene_error(status, described);
  return scene;
}

/// Throws InputError unless the mechanics of the scene can be used: sizes, geometry, stiffnesses, supports;
/// or if they are surely a mistake, see require_plausible().
void require_valid(const SceneDescription& described);

}  // namespace taut::host
