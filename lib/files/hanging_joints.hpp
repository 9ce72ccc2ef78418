// Joints that nothing but the tension of their cable holds in some direction.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// A joint, and in how many directions its node hangs on the cable. All numbers count from 0.
struct HangingJoint {
  std::size_t cable = 0, joint = 0;
  int node = 0, directions = 0;
};

/// In how many directions a node hangs on its cables: with its neighbours held, rotation and all where
/// something turns with them, and its own rotation free,
/// struts, beams, substructures and the ends of anchored cables resist a motion there with less than `least`
/// [N/m].
int hanging_directions(const SceneDescription& scene, int node, double least);

/// All joints whose nodes resist in some direction with less than a tenth of what the cable does by its
/// tension, the sum of T / L of both segments, at a strain of 0.0025, about what cables are tensioned to. In
/// linear theory tension resists nothing, so friction alone holds them there. Struts that are pinned at both
/// ends stand on such joints. What holds a node through further nodes is not looked at. Cost: joints x parts
/// of the scene.
std::vector<HangingJoint> hanging_joints(const SceneDescription& scene);

}  // namespace taut::host
