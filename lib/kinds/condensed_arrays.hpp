// The condensed scene, and what is known of friction, as plain lists, without their types.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lib/files/result_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/condense_scene.hpp"
#include "taut/estimation/gauges.hpp"

namespace taut::host {

/// The fields of CondensedRows for what the scene holds.
struct RowsArrays {
  using Row = std::vector<double>;

  std::vector<Row> load;
  Row prestrain;
  std::vector<Row> elongation;
};

/// The fields of LeaningRows: `by_bar` for the struts of the scene and then its beams.
struct LeaningArrays {
  RowsArrays rows;
  std::vector<RowsArrays::Row> by_bar;
};

/// The fields of Condensed for what the scene holds; values in float are exact.
struct LinearArrays {
  using Row = std::vector<double>;

  std::vector<CableLayout<double>> cables;
  std::vector<Row> coupling;  ///< columns of all segments
  Row prestrain;
  std::vector<Row> load;
  Row rho, cos_alpha, sin_alpha;
  Row most_force, most_factor;
};

/// What SecondOrder and LevelStruts hold beside the low level. Bars are segments, struts and beams of the
/// scene, one after the other; in `aside` and `own_aside` each has `normals` numbers. Tables by push have as
/// many rows for every strut.
struct LevelArrays {
  using Row = std::vector<double>;

  std::vector<Row> low_by_bar;
  LeaningArrays rise, bow;  ///< of tensions
  std::vector<Row> low_strut_by_bar;
  LeaningArrays strut_rise, strut_bow;
  Row strut_curve;
  std::vector<Row> strut_by_push;
  LeaningArrays bends, thrust;
  RowsArrays aside;
  Row kappa_by_bend, by_own_lean, own_aside;
  Row low_thrust, thrust_rise, thrust_bow;
  std::vector<Row> bends_by_push, aside_by_push;
  int struts = 0, beams = 0, normals = 0;
  double target_force = 0, curve = 0;
};

/// A condensed scene, in second-order theory at its low level, and CondensedStruts.
struct CondensedArrays : LinearArrays {
  Condensing condensing;  ///< on failure nothing else has a meaning; not_finite: numbers out of all range
  bool rigid = false;     ///< see is_rigid()
  RowsArrays struts;
  std::optional<LevelArrays> level;  ///< in second-order theory
};

/// Condenses a scene in the given type. Throws InputError if the scene cannot be used.
CondensedArrays condense(const SceneDescription& scene, ScalarType scalar);

/// The fields of FrictionPrior for what the scene holds, and the strokes that it describes; values in float
/// are exact.
struct FrictionPriorArrays {
  CondensedArrays::Row mu, contact_factor;
  std::vector<bool> capstan;
  CondensedArrays::Row mu_sd;
  std::vector<bool> shared;
  std::vector<double> scatter, seating_sd, drift_sd, length;
  std::vector<std::array<LoadCell<double>, 2>> cell;
  std::vector<StrokeGauge<double>> stroke;
};

/// Collects it from a usable scene in the given type.
FrictionPriorArrays know(const SceneDescription& scene, ScalarType scalar);

}  // namespace taut::host
