#include "benchmark/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <tuple>

namespace bench {
namespace {

const Point* find(const std::vector<Point>& points, const Point& like, const std::string& scalar,
                  const std::string& method) {
  for (const Point& point : points)
    if (point.scene == like.scene && point.log == like.log && point.scalar == scalar &&
        point.method == method)
      return &point;
  return nullptr;
}

std::string time_in_words(double ns) {
  char text[32];
  if (ns < 1e3)
    std::snprintf(text, sizeof text, "%.0f ns", ns);
  else if (ns < 1e6)
    std::snprintf(text, sizeof text, "%.3g µs", ns / 1e3);
  else
    std::snprintf(text, sizeof text, "%.3g ms", ns / 1e6);
  return text;
}
std::string error_in_words(const Point* point) {
  if (point == nullptr || point->error < 0) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", point->error);
  return text;
}

/// A line through points by least squares: its slope.
double slope(const std::vector<std::array<double, 2>>& points) {
  std::array<double, 2> mean{};
  for (const auto& [x, y] : points) {
    mean[0] += x / static_cast<double>(points.size());
    mean[1] += y / static_cast<double>(points.size());
  }
  double xx = 0, xy = 0;
  for (const auto& [x, y] : points) {
    xx += (x - mean[0]) * (x - mean[0]);
    xy += (x - mean[0]) * (y - mean[1]);
  }
  return xy / xx;
}

}  // namespace

Point Point::of(const std::string& name, double ns, double error, double events) {
  Point point;
  std::istringstream parts(name);
  for (std::string* part : {&point.scene, &point.log, &point.scalar, &point.method})
    std::getline(parts, *part, '/');
  point.ns = ns;
  point.error = error;
  point.events = events;
  return point;
}

void print_table(const std::vector<Point>& points) {
  std::printf("\n| scene | log | method | a sample, double | float | error, double | float | x tracker |\n");
  std::printf("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Point& point : points) {
    if (point.scalar != "double") continue;
    const Point* single = find(points, point, "float", point.method);
    const Point* tracker = find(points, point, "double", "tracker");
    char ratio[32] = "";
    if (tracker != nullptr) {
      const double times = point.ns / tracker->ns;
      std::snprintf(ratio, sizeof ratio, times < 10 ? "%.2g" : "%.0f", times);
    }
    std::printf("| %s | %s | %s | %s | %s | %s | %s | %s |\n", point.scene.c_str(), point.log.c_str(),
                point.method.c_str(), time_in_words(point.ns).c_str(),
                single != nullptr ? time_in_words(single->ns).c_str() : "", error_in_words(&point).c_str(),
                error_in_words(single).c_str(), ratio);
  }
}

void print_growth(const std::vector<Point>& points) {
  const auto key = [](const Point& point) {
    return std::make_tuple(point.scene.substr(0, point.scene.find(',')), point.log, point.scalar);
  };
  std::printf("\n| scenes | log | scalar | joints: ns an event (events a sample) | exponent |\n");
  std::printf("| --- | --- | --- | --- | ---: |\n");
  std::vector<decltype(key(points[0]))> done;
  for (const Point& point : points) {
    if (!(point.events > 0) || std::find(done.begin(), done.end(), key(point)) != done.end()) continue;
    done.push_back(key(point));
    std::vector<std::array<double, 2>> logarithms;
    const auto& [scenes, log, scalar] = done.back();
    std::printf("| %s | %s | %s |", scenes.c_str(), log.c_str(), scalar.c_str());
    for (const Point& other : points) {
      if (!(other.events > 0) || key(other) != key(point)) continue;
      const double joints = std::atof(other.scene.c_str() + scenes.size() + 1);
      const double cost = other.ns / other.events;
      std::printf("%s %.0f: %.0f (%.2f)", logarithms.empty() ? "" : ",", joints, cost, other.events);
      logarithms.push_back({std::log(joints), std::log(cost)});
    }
    if (logarithms.size() > 1)
      std::printf(" | %.2f |\n", slope(logarithms));
    else
      std::printf(" | |\n");
  }
}

void draw(const std::vector<Point>& points, const std::string& scene, const std::string& log,
          const std::string& file) {
  constexpr double width = 720, height = 400, left = 70, right = 40, top = 40, bottom = 50;
  constexpr double first_ns = 1, last_ns = 8, first_error = -17, last_error = -1;  // powers of ten
  const auto x = [&](double ns) {
    return left + (std::log10(ns) - first_ns) / (last_ns - first_ns) * (width - left - right);
  };
  const auto y = [&](double error) {
    const double power = std::clamp(std::log10(std::max(error, 1e-17)), first_error, last_error);
    return top + (last_error - power) / (last_error - first_error) * (height - top - bottom);
  };
  std::ofstream out(file);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"#fff\"/>\n"
      << "<text x=\"" << left << "\" y=\"22\" font-size=\"14\">" << scene << "; " << log
      << ": error (part of the jack force) over time a sample</text>\n";
  for (int power = int(first_ns); power <= int(last_ns); ++power) {
    const double at = x(std::pow(10.0, power));
    out << "<path stroke=\"#ddd\" d=\"M" << at << ' ' << top << 'V' << height - bottom << "\"/><text x=\""
        << at << "\" y=\"" << height - bottom + 18 << "\" text-anchor=\"middle\">"
        << time_in_words(std::pow(10.0, power)) << "</text>\n";
  }
  for (int power = int(first_error); power <= int(last_error); power += 2) {
    const double at = y(std::pow(10.0, power));
    out << "<path stroke=\"#ddd\" d=\"M" << left << ' ' << at << 'H' << width - right << "\"/><text x=\""
        << left - 8 << "\" y=\"" << at + 4 << "\" text-anchor=\"end\">1e" << power << "</text>\n";
  }
  for (const Point& point : points) {
    if (point.scene != scene || point.log != log || point.error < 0) continue;
    const bool is_double = point.scalar == "double", is_tracker = point.method == "tracker";
    const char* color = is_tracker ? "#0a7" : "#c40";
    out << "<circle cx=\"" << x(point.ns) << "\" cy=\"" << y(point.error) << "\" r=\"5\" stroke=\"" << color
        << "\" stroke-width=\"2\" fill=\"" << (is_double ? color : "#fff") << "\"/>\n";
    if (is_double || is_tracker)
      out << "<text x=\"" << x(point.ns) + 9 << "\" y=\"" << y(point.error) + (is_double ? 18 : 4) << "\">"
          << point.method << (is_double ? "" : ", float") << "</text>\n";
  }
  out << "<text x=\"" << width - right << "\" y=\"" << height - 10
      << "\" text-anchor=\"end\">filled: double, open: float; stepwise with its load steps a "
         "sample</text>\n</svg>\n";
}

}  // namespace bench
