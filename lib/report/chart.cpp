#include "lib/report/chart.hpp"

#include <algorithm>
#include <cmath>

#include "lib/report/html.hpp"
#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr double above = 13;  // where bars lie over the chart

std::string line(const std::string& x1, const std::string& y1, const std::string& x2, const std::string& y2) {
  return void_element("line", {{"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}});
}

// A label at an end of the axis must not hang over it.
const char* anchor_at(double part) { return part < 0.02 ? "start" : part > 0.98 ? "end" : "middle"; }

}  // namespace

std::string percent(double part) { return coordinate(100 * part, 3) + "%"; }

std::string legend_entry(const std::string& look, const std::string& words) {
  const std::string sample =
      void_element("line", {{"class", look}, {"x1", "1"}, {"y1", "6"}, {"x2", "27"}, {"y2", "6"}});
  return element(
      "li", {},
      element("svg", {{"class", "sample"}, {"width", "28"}, {"height", "12"}, {"aria-hidden", "true"}},
              sample) +
          escaped(words));
}

std::string axis_below(const Axis& axis, double height) {
  std::string drawn;
  for (const Tick& tick : axis.ticks) {
    const double part = axis.part(tick.value);
    const std::string at = percent(part);
    drawn += line(at, "0", at, coordinate(height + 4));
    drawn += element("text", {{"x", at}, {"y", coordinate(height + 18)}, {"text-anchor", anchor_at(part)}},
                     escaped(tick.label));
  }
  return element("g", {{"class", "grid"}}, drawn);
}

std::string Chart::path(const CurvePoints& points) const {
  std::string text;
  for (const CurvePoint& point : points)
    text += (text.empty() ? "" : " ") + coordinate(x(point.x)) + "," + coordinate(y(point.y));
  return text;
}

void Chart::curve(const std::string& look, const CurvePoints& points, const std::string& name) {
  CurvePoints piece;
  for (const CurvePoint& point : points) {
    if (!std::isnan(point.y)) piece.push_back(point);
    if (!std::isnan(point.y) && &point != &points.back()) continue;
    polyline(look, piece, name);
    piece.clear();
  }
}

void Chart::polyline(const std::string& look, const CurvePoints& points, const std::string& name) {
  if (points.empty()) return;
  // A single point is drawn as a dot: a line of no length with round ends.
  const std::string again = points.size() == 1 ? " " + path(points) : "";
  stretched_ += element("polyline", {{"class", look}, {"points", path(points) + again}},
                        element("title", {}, escaped(name)));
}

void Chart::band(const std::string& look, const CurvePoints& lower, const CurvePoints& upper) {
  if (lower.empty() || upper.empty()) return;
  CurvePoints back = lower;
  std::reverse(back.begin(), back.end());
  stretched_ += void_element("polygon", {{"class", look}, {"points", path(upper) + " " + path(back)}});
}

void Chart::mark(const std::string& look, CurvePoint at, const std::string& name) {
  constexpr const char* rhomb = "M0,-7 L6,0 L0,7 L-6,0 z";
  const std::string shape =
      element("path", {{"class", look}, {"d", rhomb}}, element("title", {}, escaped(name)));
  marks_ += element("svg",
                    {{"x", percent(x_.part(at.x))},
                     {"y", coordinate(y(at.y))},
                     {"class", "at"},
                     {"width", "1"},
                     {"height", "1"}},
                    shape);
}

void Chart::bar_above(const std::string& look, double from, double to) {
  constexpr double least_width = 0.004;
  const double begin = std::min(x_.part(from), 1 - least_width);
  marks_ += void_element("rect", {{"class", look},
                                  {"x", percent(begin)},
                                  {"y", coordinate(-above)},
                                  {"width", percent(std::max(x_.part(to) - begin, least_width))},
                                  {"height", "8"}});
}

void Chart::explain(const std::string& look, const std::string& words) {
  legend_ += legend_entry(look, words);
}

std::string Chart::grid() const {
  std::string drawn;
  for (const Tick& tick : y_.ticks) {
    const double at = y(tick.value);
    drawn += line("0", coordinate(at), "100%", coordinate(at));
    drawn += element("text", {{"x", "-7"}, {"y", coordinate(at + 4)}, {"text-anchor", "end"}},
                     escaped(tick.label));
  }
  return element("g", {{"class", "grid"}}, drawn) + axis_below(x_, height_);
}

std::string Chart::figure(const std::string& says, const std::string& x_title, const std::string& y_title,
                          const std::string& kind, std::size_t first_segment) const {
  const std::string height = coordinate(height_);
  const std::string stretched = element("svg",
                                        {{"class", "stretched"},
                                         {"viewBox", "0 0 " + coordinate(chart_width) + " " + height},
                                         {"preserveAspectRatio", "none"},
                                         {"width", "100%"},
                                         {"height", height}},
                                        stretched_);
  const std::string svg =
      element("svg", {{"role", "img"}, {"aria-label", says}, {"width", "100%"}, {"height", height}},
              grid() + stretched + marks_);
  return element("figure",
                 {{"class", kind.empty() ? "chart" : "chart " + kind},
                  {"data-low", significant(y_.low, 6)},
                  {"data-high", significant(y_.high, 6)},
                  {"data-first", std::to_string(first_segment)}},
                 element("ul", {{"class", "legend"}}, legend_) +
                     element("div", {{"class", "y-title"}}, escaped(y_title)) +
                     element("div", {{"class", "plot"}}, svg) +
                     element("div", {{"class", "x-title"}}, escaped(x_title)));
}

}  // namespace taut::host
