// What a condensed scene takes in the memory of a device.
#pragma once

#include <cstddef>

#include "lib/files/result_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/condensed_arrays.hpp"

namespace taut::host {

/// The counts of a capacity that fits a condensed scene exactly. Nodes are not needed any more.
struct CondensedCounts {
  int cables = 0, jacks = 0, segments = 0, joints = 0, loads = 0, struts = 0;
  int beams = 0;    ///< in second-order theory; in linear theory nothing is kept of them
  int normals = 0;  ///< directions in which a bar leans in second-order theory; 0: linear theory
  /// Zero means rigid saddles: no coupling between segments is stored. Beams count as a substructure, and so
  /// does a structure that consists of cables alone.
  int substructures = 0;
  /// Of several scenes with a structure, some lie on rigid saddles.
  bool saddles = false;
  int spans = 0;  ///< sliding spans
  /// Closed cables; segments with a prestrain; joints without friction.
  bool hoops = false, prestrain = false, smooth = false;

  bool has_rigid_saddles() const { return struts == 0 && substructures == 0; }
  bool leans() const { return normals > 0; }
};
/// Of a scene and what it was condensed to; if that failed, of whatever it may be condensed to.
CondensedCounts condensed_counts(const SceneDescription& scene, const CondensedArrays& condensed);
/// The larger of each count: a capacity that holds either scene.
CondensedCounts larger(const CondensedCounts& a, const CondensedCounts& b);

/// Bytes, for a capacity that fits exactly, where pointers are as large as here.
struct CondensedSize {
  std::size_t scene = 0;       ///< Condensed or SecondOrder, in flash
  std::size_t strut_rows = 0;  ///< CondensedStruts or LevelStruts, in flash if it is used
  std::size_t tracker = 0;     ///< Tracker, in RAM
  /// What an event takes of the stack. Within a tenth of what gcc needs for a Cortex-M4F
  /// (firmware_example/SIZES.md); other compilers and options differ.
  std::size_t stack = 0;
};
/// Exact but for the padding of small counts: some ten bytes.
CondensedSize condensed_size(const CondensedCounts& counts, ScalarType scalar);

}  // namespace taut::host
