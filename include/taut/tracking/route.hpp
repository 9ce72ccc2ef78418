// By which route the modes of an event were decided.
#pragma once

#include <cstdint>

namespace taut {

/// Routes of ModeDecision, in the order in which they are tried. `Capacity::Watch` is told of each that ends
/// a decision.
enum class Route : std::uint8_t {
  as_before,        ///< all modes stay, and so does the map
  from_before,      ///< Lemke's path from the modes of the piece before: most often one pivot
  pulled_straight,  ///< every joint of the spans at zero slides toward the jack, and Lemke's path from there
  from_nothing,     ///< rates, by full solves from zero
  further_on,       ///< all forces a little further on, from the modes of the piece before or from zero
  refused           ///< by none of them
};
constexpr int routes = 6;

}  // namespace taut
