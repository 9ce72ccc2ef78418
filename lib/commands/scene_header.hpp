// The text of a C++ header with condensed scenes.
#pragma once

#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/kinds/condensed_arrays.hpp"

namespace taut::host {

/// A name as an identifier, for a namespace: every run of other characters than letters and digits becomes
/// one underscore; at the ends they are dropped. What would then begin with a digit, be empty, or have a
/// meaning of its own in C++ gets `scene_` before it.
std::string identifier(const std::string& name);

/// A scene in one floating-point type.
struct ExportedArrays {
  CondensedArrays condensed;
  FrictionPriorArrays prior;
};

/// A scene with what is written of it.
struct ExportedScene {
  SceneDescription description;
  ExportedArrays in_float, in_double;
};

/// The header of at least one scene, each in a namespace of its own: their identifiers must differ. Several
/// scenes have one capacity, the larger of each count. A scene that was condensed with failure in one type is
/// there in the other type only.
std::string scene_header(const std::vector<ExportedScene>& scenes);

}  // namespace taut::host
