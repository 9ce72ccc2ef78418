// The condensed scene as plain lists, without its types.
#pragma once

#include <vector>

#include "lib/condense_scene.hpp"
#include "lib/result_file.hpp"
#include "lib/scene_description.hpp"

namespace taut::host {

/// The fields of Condensed and CondensedStruts for what the scene holds; values in float are exact.
struct CondensedArrays {
  using Row = std::vector<double>;

  Condensing condensing;  ///< on failure all else is empty
  bool rigid = false;     ///< see is_rigid()
  std::vector<CableLayout<double>> cables;
  std::vector<Row> coupling;  ///< of all segments
  Row prestrain;
  std::vector<Row> load;
  Row rho, cos_alpha, sin_alpha;
  std::vector<Row> strut_load;
  Row strut_prestrain;
  std::vector<Row> strut_elongation;
};

/// Condenses a scene in the given type. Throws InputError if the scene cannot be used.
CondensedArrays condense(const SceneDescription& scene, ScalarType scalar);

}  // namespace taut::host
