// What an instrument says. An instrument is whatever has `Reading read()`: bounded, without waiting.
#pragma once

#include <cstdint>

namespace instruments {

/// Why there is no value.
enum class Fault : std::uint8_t {
  none,
  absent,     ///< there is no such instrument
  settling,   ///< just switched on, or its gain changed
  not_ready,  ///< it has said nothing for too long: broken wire, no supply, a data line that is stuck high
  stuck,      ///< its data line does not follow the clock
  saturated,  ///< at one of its rails: the true value is beyond, or the bridge is broken
  timing,     ///< an interrupt or the like came between: what was read is not to be used
};

/// A value and when it was measured.
struct Reading {
  Fault fault = Fault::absent;
  float value = 0;       ///< [N] or [m]; only without a fault
  std::uint32_t at = 0;  ///< [ms] of the board's clock, which may pass zero

  static constexpr Reading of(float value, std::uint32_t at) { return {Fault::none, value, at}; }
  static constexpr Reading without(Fault fault, std::uint32_t at) { return {fault, 0, at}; }
  constexpr bool is_good() const { return fault == Fault::none; }
};

/// What an end of a cable can have.
enum class Quantity : std::uint8_t { force, stroke };

}  // namespace instruments
