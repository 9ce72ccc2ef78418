#include "lib/commands/export_scene.hpp"

#include <algorithm>
#include <iostream>

#include "lib/commands/scene_header.hpp"
#include "lib/commands/usual_deviations.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/condensed_arrays.hpp"
#include "lib/kinds/condensed_kind.hpp"

namespace taut::host {
namespace {

ExportedArrays arrays_of(const SceneDescription& scene, ScalarType scalar) {
  return {condense(scene, scalar), know(scene, scalar)};
}

ExportedScene exported_scene(const std::string& file) {
  ExportedScene scene;
  scene.description = read_scene_file(file);
  fill_in_mu_deviations(scene.description);
  for (const std::string& text : fill_in_jacks(scene.description)) std::cerr << "remark: " << text << '\n';
  scene.in_double = arrays_of(scene.description, ScalarType::float64);
  if (scene.in_double.condensed.condensing.status)
    scene.in_float = arrays_of(scene.description, ScalarType::float32);
  return scene;
}

// Every scene has a namespace of its own.
void require_other_names(const ExportedScene& scene, const std::vector<ExportedScene>& before) {
  const std::string space = identifier(scene.description.name);
  const auto same = std::find_if(before.begin(), before.end(), [&](const ExportedScene& other) {
    return identifier(other.description.name) == space;
  });
  if (same != before.end())
    throw InputError(scene.description.file, "/name",
                     "the name " + quote(scene.description.name) + " gives the namespace " + quote(space) +
                         " in the header, as that of " + same->description.file + " does",
                     "give every scene of a header another name");
}

// One Tracker serves all scenes of a header.
void require_same_theory(const ExportedScene& scene, const std::vector<ExportedScene>& before) {
  if (before.empty() || leans(scene.description) == leans(before[0].description)) return;
  const SceneDescription& other = before[0].description;
  throw InputError(scene.description.file, leans(scene.description) ? "/second_order" : "",
                   std::string("the scene is in ") + (leans(scene.description) ? "second-order" : "linear") +
                       " theory, and " + other.file + " is not",
                   "export scenes of either theory into a header of their own");
}

}  // namespace

int export_scenes(const ExportOptions& options) {
  std::vector<ExportedScene> scenes;
  for (const std::string& file : options.scenes) {
    ExportedScene scene = exported_scene(file);
    const SceneDescription& description = scene.description;
    require_other_names(scene, scenes);
    require_same_theory(scene, scenes);
    if (const Status status = scene.in_double.condensed.condensing.status; !status) {
      std::cerr << description.file << ": " << failure_text(status, description) << '\n';
      return 1;
    }
    if (const Status status = scene.in_float.condensed.condensing.status; !status) {
      std::cerr << "remark: the header holds no condensed<float>"
                << (options.scenes.size() == 1 ? "" : " of " + quote(description.name)) << ": "
                << failure_text(status, description) << '\n';
    }
    scenes.push_back(std::move(scene));
  }
  keep_inputs(options.output, options.scenes);
  OutputFile output(options.output);
  output.write(scene_header(scenes));
  output.finish();
  return 0;
}

}  // namespace taut::host
