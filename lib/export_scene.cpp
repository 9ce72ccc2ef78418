#include "lib/export_scene.hpp"

#include <iostream>

#include "lib/condensed_arrays.hpp"
#include "lib/output_file.hpp"
#include "lib/scene_file.hpp"
#include "lib/scene_header.hpp"
#include "lib/status_text.hpp"
#include "lib/usual_deviations.hpp"

namespace taut::host {
namespace {

ExportedArrays arrays_of(const SceneDescription& scene, ScalarType scalar) {
  return {condense(scene, scalar), know(scene, scalar)};
}

}  // namespace

int export_scene(const ExportOptions& options) {
  SceneDescription scene = read_scene_file(options.scene);
  // As `taut estimate` does, but for load cells: their largest reading is not known here.
  fill_in_mu_deviations(scene);
  const ExportedArrays in_double = arrays_of(scene, ScalarType::float64);
  if (!in_double.condensed.condensing.status) {
    std::cerr << scene.file << ": " << failure_text(in_double.condensed.condensing.status, scene) << '\n';
    return 1;
  }
  const ExportedArrays in_float = arrays_of(scene, ScalarType::float32);
  if (!in_float.condensed.condensing.status) {
    std::cerr << "remark: the header holds no condensed<float>: "
              << failure_text(in_float.condensed.condensing.status, scene) << '\n';
  }
  keep_inputs(options.output, {options.scene});
  OutputFile output(options.output);
  output.write(scene_header(scene, in_float, in_double));
  output.finish();
  return 0;
}

}  // namespace taut::host
