#include "lib/report/projection.hpp"

#include <algorithm>
#include <cmath>

#include "lib/report/axis.hpp"

namespace taut::host {
namespace {

constexpr double margin = 36, least_height = 130, greatest_height = 470;

// Seen from the front right and from above: azimuth -60 degrees, elevation 25 degrees; y downwards.
constexpr double sin_azimuth = -0.8660254037844386, cos_azimuth = 0.5;
constexpr double sin_elevation = 0.42261826174069944, cos_elevation = 0.9063077870366499;

CurvePoint from_space(const std::array<double, 3>& at) {
  return {-sin_azimuth * at[0] + cos_azimuth * at[1],
          -cos_elevation * at[2] + sin_elevation * (cos_azimuth * at[0] + sin_azimuth * at[1])};
}

CurvePoint on_paper(const SceneDescription& scene, const NodeDescription& node) {
  return scene.dimension == 2 ? CurvePoint{node.at[0], -node.at[1]} : from_space(node.at);
}

}  // namespace

Projection::Projection(const SceneDescription& scene) {
  Range xs, ys;
  for (const NodeDescription& node : scene.nodes) {
    points_.push_back(on_paper(scene, node));
    xs.include(points_.back().x);
    ys.include(points_.back().y);
  }
  const double wide = xs.high() - xs.low(), tall = ys.high() - ys.low();
  const double room_x = width - 2 * margin, room_y = greatest_height - 2 * margin;
  double scale = 1;
  if (wide > 0 || tall > 0) scale = 1 / std::max(wide / room_x, tall / room_y);
  height_ = std::max(tall * scale + 2 * margin, least_height);
  const CurvePoint middle{xs.low() + wide / 2, ys.low() + tall / 2};
  for (CurvePoint& point : points_)
    point = {width / 2 + (point.x - middle.x) * scale, height_ / 2 + (point.y - middle.y) * scale};
}

std::vector<CurvePoint> Projection::axes() {
  return {from_space({1, 0, 0}), from_space({0, 1, 0}), from_space({0, 0, 1})};
}

}  // namespace taut::host
