// The colours of forces: viridis, which grows lighter evenly and which colour-blind people can read.
#pragma once

#include <string>
#include <vector>

#include "lib/report/number_text.hpp"
#include "lib/report/words.hpp"

namespace taut::host {

inline constexpr int force_colours = 32;

/// Style rules for the classes `c0` ... that ForceScale::look() names.
std::string force_colour_rules();

/// From the smallest to the largest force at one moment, so that what friction takes can be seen; but never
/// so narrow that noise gets all the colours.
struct ForceScale {
  static constexpr double least_span = 0.05;  ///< of the largest force

  explicit ForceScale(const std::vector<double>& forces);

  /// Class of the colour of a force.
  std::string look(double force) const;
  /// A bar of all colours with numbers below it.
  std::string bar(const ForceUnit& unit, const Words& say = Words()) const;

  double low = 0, high = 0;
};

}  // namespace taut::host
