// The condensed scene, and what is known of friction, as plain lists, without their types.
#pragma once

#include <array>
#include <vector>

#include "lib/files/result_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/condense_scene.hpp"
#include "taut/estimation/gauges.hpp"

namespace taut::host {

/// The fields of Condensed and CondensedStruts for what the scene holds; values in float are exact.
struct CondensedArrays {
  using Row = std::vector<double>;

  Condensing condensing;  ///< on failure nothing else has a meaning; not_finite: numbers out of all range
  bool rigid = false;     ///< see is_rigid()
  std::vector<CableLayout<double>> cables;
  std::vector<Row> coupling;  ///< columns of all segments
  Row prestrain;
  std::vector<Row> load;
  Row rho, cos_alpha, sin_alpha;
  Row most_force, most_factor;
  std::vector<Row> strut_load;
  Row strut_prestrain;
  std::vector<Row> strut_elongation;
};

/// Condenses a scene in the given type. Throws InputError if the scene cannot be used.
CondensedArrays condense(const SceneDescription& scene, ScalarType scalar);

/// The fields of Knowledge for what the scene holds, and the strokes that it describes; values in float are
/// exact.
struct KnowledgeArrays {
  CondensedArrays::Row mu, grip;
  std::vector<bool> capstan;
  CondensedArrays::Row mu_sd;
  std::vector<bool> shared;
  std::vector<double> scatter, seating_sd, drift_sd, length;
  std::vector<std::array<LoadCell<double>, 2>> cell;
  std::vector<StrokeGauge<double>> stroke;
};

/// Collects it from a usable scene in the given type.
KnowledgeArrays know(const SceneDescription& scene, ScalarType scalar);

}  // namespace taut::host
