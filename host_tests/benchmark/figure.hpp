// The benchmark's results as a table in Markdown and as a figure.
#pragma once

#include <string>
#include <vector>

namespace bench {

/// One method on one scene and log.
struct Point {
  std::string scene, log, scalar, method;
  double ns = 0;      ///< a sample
  double error = -1;  ///< part of the jack force; below zero: has none
  double events = 0;  ///< a sample; zero: not counted

  /// From "scene/log/scalar/method".
  static Point of(const std::string& name, double ns, double error, double events);
};

/// A line a scene, log and method: time in double and float, error in double and float, times slower than
/// the tracker.
void print_table(const std::vector<Point>& points);

/// How the cost of an event grows with the number of joints, for every family of scenes, log and scalar of
/// which events were counted: the exponent p of cost = c joints^p, by least squares of the logarithms.
void print_growth(const std::vector<Point>& points);

/// Error over time of all methods on one scene and log, both logarithmic, as an SVG file.
void draw(const std::vector<Point>& points, const std::string& scene, const std::string& log,
          const std::string& file);

}  // namespace bench
