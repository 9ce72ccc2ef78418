// Cables over saddles that feel nothing of each other.
#pragma once

#include <vector>

#include "support/scenes.hpp"

namespace estimation {

/// So many of them alike, of five segments each, one 20 m above the other.
inline void saddle_rows(support::Plane& scene, const taut::Cable<double>& cable, int count) {
  const auto points = support::chain_points(5);
  support::rigid_saddles(scene, cable, points);
  for (int c = 1; c < count; ++c) {
    std::vector<int> path;
    for (const auto& point : points)
      path.push_back(scene.add_node({point[0], point[1] + 20 * c}, taut::held_xy));
    scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  }
}

}  // namespace estimation
