// The text of a C++ header with a condensed scene.
#pragma once

#include <string>

#include "lib/condensed_arrays.hpp"
#include "lib/scene_description.hpp"

namespace taut::host {

/// A name as an identifier, for a namespace: every run of other characters than letters and digits becomes
/// one underscore; at the ends they are dropped. What would then begin with a digit, be empty, or have a
/// meaning of its own in C++ gets `scene_` before it.
std::string identifier(const std::string& name);

/// A scene in one floating-point type.
struct ExportedArrays {
  CondensedArrays condensed;
  KnowledgeArrays knowledge;
};

/// The header. A scene that was condensed with failure in one type is there in the other type only.
std::string scene_header(const SceneDescription& scene, const ExportedArrays& in_float,
                         const ExportedArrays& in_double);

}  // namespace taut::host
