// The body of make_valid_scene(), for the units that compile it.
#pragma once

#include "lib/files/status_text.hpp"
#include "lib/kinds/scene_build.hpp"
#include "lib/kinds/valid_scene.hpp"
#include "taut/scene/validation.hpp"

namespace taut::host {

template <int Dimension, class Cap>
std::unique_ptr<Scene<double, Dimension, Cap>> make_valid_scene(const SceneDescription& described) {
  auto scene = std::make_unique<Scene<double, Dimension, Cap>>();
  build(described, *scene);
  const Status status = validate(*scene);
  if (!status) throw scene_error(status, described);
  return scene;
}

}  // namespace taut::host
