// `taut template`: the header of a log for a scene.
#pragma once

#include <string>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// A log without rows: a header of all columns that a log of the scene can have, and above it a remark on
/// each: what it is, in which unit, and whether it is needed.
std::string log_template(const SceneDescription& scene);

/// Writes it to a file, or standard output if `output` is empty. Returns the exit status; throws InputError
/// for a scene that cannot be used.
int write_log_template(const std::string& scene, const std::string& output);

}  // namespace taut::host
