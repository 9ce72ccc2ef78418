#include "lib/commands/export_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "lib/commands/c_interface.hpp"
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
  for (const Sentence& remark : fill_in_jacks(scene.description))
    std::cerr << "remark: " << remark.english() << '\n';
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

// One scene has one set of functions; their names begin with that of the interface.
void require_possible(const ExportOptions& options) {
  if (!options.c_name) return;
  if (identifier(*options.c_name) != *options.c_name)
    throw InputError(
        "--c", "", quote(*options.c_name) + " is no identifier of C that is free",
        "write letters, digits and single underscores, such as " + quote(identifier(*options.c_name)));
  if (options.output.empty())
    throw InputError("--c", "", "has no folder to write to", "name the header with -o FOLDER/SCENE.hpp");
  if (options.scenes.size() > 1)
    throw InputError("--c", "",
                     "is an interface to one scene, and there are " + std::to_string(options.scenes.size()),
                     "export every scene by itself");
}

std::string beside(const ExportOptions& options, const char* ending) {
  return (std::filesystem::path(options.output).parent_path() / (*options.c_name + ending)).string();
}

}  // namespace

int export_scenes(const ExportOptions& options) {
  require_possible(options);
  std::vector<ExportedScene> scenes;
  for (const std::string& file : options.scenes) {
    ExportedScene scene = exported_scene(file);
    const SceneDescription& description = scene.description;
    require_other_names(scene, scenes);
    require_same_theory(scene, scenes);
    if (const Status status = scene.in_double.condensed.condensing.status; !status) {
      std::cerr << description.file << ": " << failure_text(status, description).english() << '\n';
      return 1;
    }
    if (const Status status = scene.in_float.condensed.condensing.status; !status) {
      std::cerr << "remark: the header holds no condensed<float>"
                << (options.scenes.size() == 1 ? "" : " of " + quote(description.name)) << ": "
                << failure_text(status, description).english() << '\n';
    }
    scenes.push_back(std::move(scene));
  }
  keep_inputs(options.output, options.scenes);
  const std::string header = scene_header(scenes);
  if (!options.c_name) {
    OutputFile output(options.output);
    output.write(header);
    output.finish();
    return 0;
  }
  const ExportedScene& scene = scenes.front();
  if (!scene.in_float.condensed.condensing.status) {
    std::cerr << "--c: the interface computes in float, and the scene cannot be condensed in float\n";
    return 1;
  }
  const std::string file = std::filesystem::path(options.output).filename().string();
  const std::string c_file = beside(options, ".h"), source_file = beside(options, ".cpp");
  for (const std::string& written : {c_file, source_file}) {
    keep_inputs(written, options.scenes);
    keep_apart(options.output, written, "the header of the scene and a file of its C interface");
  }
  OutputFile output(options.output), c_output(c_file), source(source_file);
  output.write(header);
  c_output.write(c_header(scene, *options.c_name));
  source.write(c_source(scene, *options.c_name, file));
  output.finish();
  c_output.finish();
  source.finish();
  return 0;
}

}  // namespace taut::host
