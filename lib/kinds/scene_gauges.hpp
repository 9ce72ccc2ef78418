// The instruments of a scene that an Estimator takes readings from one by one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/kinds/scene_build.hpp"
#include "taut/estimation/gauges.hpp"

namespace taut::host {

/// Room for a stroke at both ends of the first cables, and a force of every segment.
template <class Cap>
constexpr int most_gauges = 2 * (Cap::cables < 8 ? Cap::cables : 8) +
                            (Cap::segments < 16 ? Cap::segments : 16);

/// The stroke at a jacked end that has one as a measurement, as the scene describes it. What the elongation
/// of a cable is uncertain by in proportion is that of E A.
inline LoadCell<double> stroke_cell(const CableDescription& cable, std::size_t end) {
  LoadCell<double> stroke = load_cell(cable.stroke[end], false);
  stroke.gain_sd = cable.E_sd;
  if (cable.stroke[end].has_free_zero) stroke.zero_sd = free_zero<double>;
  return stroke;
}
inline bool has_stroke(const CableDescription& cable, std::size_t end) {
  return cable.is_jacked(end) && cable.stroke[end].is_given;
}

/// Strokes, measured forces of segments, gauges of struts: all that the scene or the log has, with a number
/// each.
class SceneGauges {
 public:
  SceneGauges() = default;
  explicit SceneGauges(const SceneDescription& scene) : of_strut_(scene.struts.size(), -1) {
    for (const CableDescription& cable : scene.cables) {
      std::array<int, 2> strokes{-1, -1};
      for (std::size_t end = 0; end < 2; ++end)
        if (has_stroke(cable, end)) strokes[end] = add_stroke(cable, end);
      of_stroke_.push_back(strokes);
      std::vector<int> segments;
      for (const InstrumentDescription& force : cable.force)
        segments.push_back(force.is_given ? add(load_cell(force, false)) : -1);
      of_segment_.push_back(segments);
    }
    for (std::size_t i = 0; i < scene.struts.size(); ++i)
      if (scene.struts[i].gauge.is_given) of_strut_[i] = add(load_cell(scene.struts[i].gauge, false));
  }

  template <class Scalar>
  std::vector<LoadCell<Scalar>> cells() const {
    std::vector<LoadCell<Scalar>> all;
    for (const LoadCell<double>& cell : cells_) all.push_back(LoadCell<Scalar>::of(cell));
    return all;
  }
  /// The largest standard deviation of a stroke's noise that the scene tells [m]; 0 if it tells none.
  double stroke_sd() const { return stroke_sd_; }
  /// Numbers of the instruments, or -1.
  int of_stroke(std::size_t cable, std::size_t end) const { return of_stroke_[cable][end]; }
  int of_segment(std::size_t cable, std::size_t segment) const { return of_segment_[cable][segment]; }
  int of_strut(std::size_t strut) const { return of_strut_[strut]; }

 private:
  int add(const LoadCell<double>& cell) {
    cells_.push_back(cell);
    return static_cast<int>(cells_.size()) - 1;
  }
  int add_stroke(const CableDescription& cable, std::size_t end) {
    const LoadCell<double> stroke = stroke_cell(cable, end);
    if (!cable.stroke[end].is_assumed) stroke_sd_ = std::max(stroke_sd_, stroke.sd);
    return add(stroke);
  }

  std::vector<LoadCell<double>> cells_;
  double stroke_sd_ = 0;
  std::vector<std::array<int, 2>> of_stroke_;
  std::vector<std::vector<int>> of_segment_;
  std::vector<int> of_strut_;
};

}  // namespace taut::host
