// What the operator must know, as bits of one number in every answer.
#pragma once

#include <cstdint>

namespace monitor {

enum class Alarm : std::uint8_t {
  bad_frame,        ///< something on the line was no frame
  bytes_lost,       ///< the line was faster than the main loop
  sample_lost,      ///< a sequence number is missing: the path went straight past it
  sensor_range,     ///< a reading outside its range: at a jack the sample was not used, else the reading
  sensor_frozen,    ///< a load cell that says the same again and again
  budget_exceeded,  ///< the forces are those part of the way to the sample
  no_answer,        ///< the model has none: code and place say why
  doubtful,         ///< the forces miss equilibrium or friction by more than rounding
  scene_refused,    ///< the scene cannot be used: choose another one
  silence,          ///< no sample for a while
  state_lost,       ///< the record in memory was not usable: begun anew without load
  restarted,        ///< after a power failure or by the watchdog, not on command
  not_kept,         ///< the state could not be written to memory that outlives the power
};
constexpr int alarm_count = 13;

/// A set of alarms.
class Alarms {
 public:
  constexpr Alarms() = default;
  constexpr explicit Alarms(std::uint32_t bits) : bits_(bits) {}

  constexpr void raise(Alarm alarm) { bits_ |= bit(alarm); }
  constexpr void add(Alarms other) { bits_ |= other.bits_; }
  constexpr bool has(Alarm alarm) const { return (bits_ & bit(alarm)) != 0; }
  constexpr std::uint32_t bits() const { return bits_; }

 private:
  static constexpr std::uint32_t bit(Alarm alarm) { return 1U << static_cast<unsigned>(alarm); }
  std::uint32_t bits_ = 0;
};

/// For people; the device sends the bits.
constexpr const char* alarm_words[alarm_count] = {
    "bad_frame",       "bytes_lost", "sample_lost", "sensor_range",  "sensor_frozen",
    "budget_exceeded", "no_answer",  "doubtful",    "scene_refused", "silence",
    "state_lost",      "restarted",  "not_kept"};

/// What the forces in an answer are worth.
enum class Quality : char {
  good = 'g',      ///< those of this sample
  behind = 'b',    ///< those part of the way to it: the event budget is spent
  doubtful = 'd',  ///< those of this sample, but verify() disagrees
  held = 'h',      ///< those of a sample before, or of the place where the answer ended
  none = 'n',      ///< there is no model: the scene was refused
};

}  // namespace monitor
