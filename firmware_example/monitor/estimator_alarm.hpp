// What the estimator finds odd, as one number of a frame.
#pragma once

#include <cstdint>

#include "taut/estimation/alarms.hpp"

namespace monitor {

/// So many cables have a number of their own in a code.
constexpr int most_coded_cables = 255;

/// The kind in the highest byte, the cable in the next (255: none, the place is a strut), the place in the
/// other two.
constexpr std::uint32_t code_of(const taut::Alarm& alarm) {
  return static_cast<std::uint32_t>(alarm.kind) << 24 |
         (static_cast<std::uint32_t>(alarm.cable) & 0xFFU) << 16 |
         (static_cast<std::uint32_t>(alarm.place) & 0xFFFFU);
}

constexpr taut::Alarm alarm_of(std::uint32_t code) {
  const auto cable = static_cast<std::int16_t>(code >> 16 & 0xFFU);
  return {static_cast<taut::Alarm::Kind>(code >> 24), cable == most_coded_cables ? std::int16_t(-1) : cable,
          static_cast<std::int16_t>(code & 0xFFFFU)};
}

}  // namespace monitor
