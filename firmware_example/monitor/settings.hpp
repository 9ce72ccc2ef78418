// What belongs to the site and not to the scene.
#pragma once

#include <cstdint>

#include "taut/estimation/alarms.hpp"

namespace monitor {

/// The load cells: what they can say.
struct CellLimits {
  float least = -2e4F;               ///< [N]; between this and zero a reading counts as zero
  float most = 1e7F;                 ///< [N]
  std::uint32_t frozen_after = 600;  ///< readings in a row with the same bits, 0: never
};

struct Settings {
  /// Whether forces are doubted where the very first sample is under load: then they lie between those of
  /// all pasts of the jacks until the cables have slid enough. Takes the RAM of a second estimator.
  static constexpr bool doubts_past = true;
  /// From when on the estimator finds something odd; by itself it has no limit for forces.
  static constexpr taut::AlarmLimits<float> alarm_limits{};
  /// Events of the tracker in one call, 0: as many as it takes by itself.
  static constexpr int event_budget = 0;
  /// Calls of the tracker a sample; the watchdog is fed in between.
  static constexpr int most_calls = 64;
  /// verify() above this part of the largest force makes an answer doubtful.
  static constexpr float most_violation = 1e-4F;
  /// verify() is called for every sample with an event and for every so many others.
  static constexpr std::uint32_t verify_every = 1;
  /// Milliseconds without a sample until the device says so.
  static constexpr std::uint32_t silence_after = 10000;
  /// A reading of the board's own instruments that is older [ms] is out of range.
  static constexpr std::uint32_t oldest_reading = 1000;
  /// Of the Modbus line, where a board has one: this device, 1 to 247, and bits a second. The standard's are
  /// 8 bits, even parity, one stop bit.
  static constexpr std::uint8_t modbus_address = 1;
  static constexpr std::uint32_t modbus_baud = 19200;
};

}  // namespace monitor
