// The text of a C interface to an exported scene.
#pragma once

#include <string>

#include "lib/commands/scene_header.hpp"

namespace taut::host {

/// NAME.h: an Estimator of the scene in C99, with what every function takes and gives. `name` is an
/// identifier.
std::string c_header(const ExportedScene& scene, const std::string& name);

/// NAME.cpp: what is behind it; `header` is the file name of the exported scene in the same folder.
std::string c_source(const ExportedScene& scene, const std::string& name, const std::string& header);

}  // namespace taut::host
