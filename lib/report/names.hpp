// How a report calls the parts of a structure.
#pragma once

#include <array>
#include <string>

#include "lib/files/scene_description.hpp"
#include "lib/report/words.hpp"

namespace taut::host {

/// The nodes at both ends of a segment, and the node of a joint; both counted from 0 within their cable.
inline std::array<int, 2> segment_nodes(const CableDescription& cable, std::size_t segment) {
  return {cable.path[segment], cable.path[(segment + 1) % cable.path.size()]};
}
inline int joint_node(const CableDescription& cable, std::size_t joint) {
  return cable.path[cable.closed ? joint : joint + 1];
}

inline const std::string& node_name(const SceneDescription& scene, int node) {
  return scene.nodes[static_cast<std::size_t>(node)].name;
}

/// `segment 2 (b-c)`
inline std::string segment_name(const SceneDescription& scene, const CableDescription& cable, std::size_t i,
                                const Words& say = Words()) {
  const auto nodes = segment_nodes(cable, i);
  return say("segment {1} ({2}\u2013{3})",
             {std::to_string(i + 1), node_name(scene, nodes[0]), node_name(scene, nodes[1])});
}

}  // namespace taut::host
