// A cable over rigid saddles, in a scene type that has room for nothing else.
#pragma once

#include <cmath>
#include <vector>

#include "support/scenes.hpp"

namespace support {

/// Capacity of a scene without anything elastic but its cable.
struct SaddleCapacity : taut::Capacity {
  static constexpr int nodes = 10, cables = 1, segments = 9, joints = 9, loads = 1, temperatures = 1;
  using Watch = RoutesTaken;
};
using Saddles = taut::Scene<double, 2, SaddleCapacity>;

/// A cable over held nodes.
inline void saddles(Saddles& scene, const taut::Cable<double>& cable, const std::vector<PlanePoint>& points) {
  scene = {};
  std::vector<int> path;
  for (const PlanePoint& point : points) path.push_back(scene.add_node(point, taut::held_xy));
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
}

/// Points of a path from its segment lengths and the angles by which it turns between them.
inline std::vector<PlanePoint> path_points(const std::vector<double>& lengths,
                                           const std::vector<double>& turns) {
  std::vector<PlanePoint> points{{0, 0}};
  double angle = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (i > 0) angle += turns[i - 1];
    const PlanePoint last = points.back();
    points.push_back({last[0] + lengths[i] * std::cos(angle), last[1] + lengths[i] * std::sin(angle)});
  }
  return points;
}

}  // namespace support
