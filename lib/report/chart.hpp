// A chart as an SVG that stretches with the page while its text keeps its size.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "lib/report/axis.hpp"
#include "lib/report/curve.hpp"

namespace taut::host {

/// Coordinates of what is stretched: x from 0 to this over the width of the chart; y in pixels.
inline constexpr double chart_width = 1000;

/// The class of a curve, a band or a mark says how it looks; see page_style.hpp.
class Chart {
 public:
  Chart(Axis x, Axis y, double height = 220) : x_(std::move(x)), y_(std::move(y)), height_(height) {}

  /// Interrupted where y is not a number.
  void curve(const std::string& look, const CurvePoints& points, const std::string& name);
  /// Between two curves.
  void band(const std::string& look, const CurvePoints& lower, const CurvePoints& upper);
  /// A rhomb.
  void mark(const std::string& look, CurvePoint at, const std::string& name);
  /// A bar above the chart.
  void bar_above(const std::string& look, double from, double to);
  /// An entry of the legend for what has this look.
  void explain(const std::string& look, const std::string& words);

  /// `says` is what the chart shows, for who cannot see it; titles go with the axes. `kind` is a further
  /// class, by which a script finds the chart: `over-time`, or `along` for one that begins with this segment.
  std::string figure(const std::string& says, const std::string& x_title, const std::string& y_title,
                     const std::string& kind = "", std::size_t first_segment = 0) const;

 private:
  double x(double value) const { return chart_width * x_.part(value); }
  double y(double value) const { return height_ * (1 - y_.part(value)); }
  void polyline(const std::string& look, const CurvePoints& points, const std::string& name);
  std::string path(const CurvePoints& points) const;
  std::string grid() const;

  Axis x_, y_;
  double height_;
  std::string stretched_, marks_, legend_;
};

/// A small sample of a look, for legends.
std::string legend_entry(const std::string& look, const std::string& words);

/// A part of the width, for what is not stretched.
std::string percent(double part);

/// Grid lines and labels of a horizontal axis below a drawing of this height.
std::string axis_below(const Axis& axis, double height);

}  // namespace taut::host
