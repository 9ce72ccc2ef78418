// Reads a scene file.
#pragma once

#include <string>
#include <string_view>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Reads a scene file (JSON with comments) of at most 16 MiB. Throws InputError if it cannot be read or does
/// not fit the format. What needs mechanics to judge is left to require_valid().
SceneDescription read_scene_file(const std::string& path);

/// The same for text at hand; `file` is the name for messages.
SceneDescription read_scene(std::string_view text, const std::string& file);

}  // namespace taut::host
