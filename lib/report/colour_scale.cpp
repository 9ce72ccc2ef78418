#include "lib/report/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/report/axis.hpp"
#include "lib/report/chart.hpp"
#include "lib/report/html.hpp"

namespace taut::host {
namespace {

using Colour = std::array<int, 3>;

// Viridis at 0, 1/9 ... 1 (matplotlib).
constexpr std::array<Colour, 10> viridis = {{{0x44, 0x01, 0x54},
                                             {0x48, 0x28, 0x78},
                                             {0x3e, 0x4a, 0x89},
                                             {0x31, 0x68, 0x8e},
                                             {0x26, 0x82, 0x8e},
                                             {0x1f, 0x9e, 0x89},
                                             {0x35, 0xb7, 0x79},
                                             {0x6d, 0xcd, 0x59},
                                             {0xb4, 0xde, 0x2c},
                                             {0xfd, 0xe7, 0x25}}};

Colour colour_at(double part) {
  const double at = part * static_cast<double>(viridis.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double rest = at - static_cast<double>(before);
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i)
    colour[i] =
        static_cast<int>(std::lround(viridis[before][i] * (1 - rest) + viridis[before + 1][i] * rest));
  return colour;
}

std::string hexadecimal(const Colour& colour) {
  std::string text = "#";
  for (const int value : colour) {
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

std::string class_of(int i) { return "c" + std::to_string(i); }

}  // namespace

std::string force_colour_rules() {
  std::string rules;
  for (int i = 0; i < force_colours; ++i)
    rules += "." + class_of(i) + "{--c:" + hexadecimal(colour_at(i / (force_colours - 1.0))) + "}\n";
  return rules;
}

ForceScale::ForceScale(const std::vector<double>& forces) {
  if (forces.empty()) return;
  high = std::max(*std::max_element(forces.begin(), forces.end()), 0.0);
  low = std::min(*std::min_element(forces.begin(), forces.end()), (1 - least_span) * high);
}

std::string ForceScale::look(double force) const {
  const double part = high > low ? std::clamp((force - low) / (high - low), 0.0, 1.0) : 0;
  return class_of(std::min(static_cast<int>(part * force_colours), force_colours - 1));
}

std::string ForceScale::bar(const ForceUnit& unit, const Words& say) const {
  constexpr int steps = 4;
  std::string bar;
  for (int i = 0; i < force_colours; ++i)
    bar += void_element("rect", {{"class", class_of(i)},
                                 {"x", percent(static_cast<double>(i) / force_colours)},
                                 {"y", "0"},
                                 {"width", percent(1.02 / force_colours)},
                                 {"height", "12"}});
  Axis axis;
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    axis.ticks.push_back({part, unit.number(low + part * (high - low))});
  }
  const std::string svg =
      element("svg",
              {{"role", "img"},
               {"aria-label", say("Colours from {1} to {2}", {unit.text(low), unit.text(high)})},
               {"width", "100%"},
               {"height", "12"}},
              axis_below(axis, 12) + bar);
  return element("div", {{"class", "scale"}},
                 element("span", {}, escaped(say("Force") + " [" + unit.name + "]")) + svg);
}

}  // namespace taut::host
