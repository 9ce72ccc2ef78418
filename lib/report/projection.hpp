// Nodes on paper.
#pragma once

#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/report/curve.hpp"

namespace taut::host {

/// Where every node of a scene lies in a drawing, y downwards, true to scale within a margin.
class Projection {
 public:
  static constexpr double width = 640;

  explicit Projection(const SceneDescription& scene);

  double height() const { return height_; }
  const CurvePoint& at(int node) const { return points_[static_cast<std::size_t>(node)]; }
  /// The directions of the axes in the drawing: of a spatial scene.
  static std::vector<CurvePoint> axes();

 private:
  double height_ = 0;
  std::vector<CurvePoint> points_;
};

}  // namespace taut::host
