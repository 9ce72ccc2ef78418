#include "lib/export_scene.hpp"

#include <iostream>

#include "lib/condensed_arrays.hpp"
#include "lib/output_file.hpp"
#include "lib/scene_file.hpp"
#include "lib/scene_header.hpp"
#include "lib/status_text.hpp"

namespace taut::host {

int export_scene(const ExportOptions& options) {
  const SceneDescription scene = read_scene_file(options.scene);
  const CondensedArrays in_double = condense(scene, ScalarType::float64);
  if (!in_double.condensing.status) {
    std::cerr << scene.file << ": " << failure_text(in_double.condensing.status, scene) << '\n';
    return 1;
  }
  const CondensedArrays in_float = condense(scene, ScalarType::float32);
  if (!in_float.condensing.status) {
    std::cerr << "remark: the header holds no condensed<float>: "
              << failure_text(in_float.condensing.status, scene) << '\n';
  }
  keep_inputs(options.output, {options.scene});
  OutputFile output(options.output);
  output.write(scene_header(scene, in_float, in_double));
  output.finish();
  return 0;
}

}  // namespace taut::host
