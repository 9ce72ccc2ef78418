// The structure as a drawing, its cables coloured by force.
#pragma once

#include <string>

#include "lib/report/colour_scale.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/words.hpp"

namespace taut::host {

/// As it is in the plane, in an axonometric projection in space. Cables, struts and joints say what they are
/// where they are pointed at.
std::string structure_drawing(const SceneDescription& scene, const RunRecord& record, const ForceUnit& unit,
                              const ForceScale& scale, const Words& say = Words());

/// The symbols of the drawing in words.
std::string structure_legend(const SceneDescription& scene, const Words& say = Words());

/// The outline of a joint's symbol; forward and backward along the x axis, which is turned to the cable.
const char* joint_outline(JointState state);

}  // namespace taut::host
