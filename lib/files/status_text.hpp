// What a Status of the core means in terms of the scene file.
#pragma once

#include <string>

#include "lib/files/input_error.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"
#include "taut/status.hpp"

namespace taut::host {

/// The error for a scene that validate() has refused: place as a JSON pointer, nodes and cables by name.
InputError scene_error(const Status& status, const SceneDescription& scene);

/// What helps where a node is held by nothing but the friction of a joint.
inline constexpr const char* sliding_remedy = "add a second strut, a support or a substructure at that node";

/// `joint 3 of cable "C" at node "top"`, from numbers that count from 0.
Sentence joint_text(const SceneDescription& scene, int cable, int joint);

/// What may help a linear scene where a node hangs on its cable alone, see hanging_joints().
inline constexpr const char* tension_remedy =
    "\"second_order\" in the scene makes the cable's tension count, which may hold it";

/// What may help where there is no answer, as far as the scene tells.
Sentence failure_remedy(const Status& status, const SceneDescription& scene);

/// Why there is no answer, as `joint 3 of cable "C": problem; remedy`. `remedy` is what the caller has found
/// to help; without it, failure_remedy() or what keeps a strut from running away.
Sentence failure_text(const Status& status, const SceneDescription& scene, const Sentence& remedy = {});

}  // namespace taut::host
