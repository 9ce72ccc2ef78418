// Reads what a scene file says of its instruments.
#pragma once

#include "lib/files/json_field.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Reads the object "sensors" of a scene into its instruments; cables and struts have been read. Throws
/// InputError for what does not fit.
void read_instruments(const Field& sensors, SceneDescription& scene);

}  // namespace taut::host
