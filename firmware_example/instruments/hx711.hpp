// Avia Semiconductor HX711: a converter of 24 bits for load cells, read over two pins.
#pragma once

#include <cstdint>

#include "instruments/reading.hpp"

namespace instruments {

/// Counts and when they were read.
struct Counts {
  Fault fault = Fault::not_ready;
  std::int32_t value = 0;
  std::uint32_t at = 0;  ///< [ms]
};

/// The chip holds a conversion until the next one; read() takes it if there is a new one, in at most 27
/// pulses of a few microseconds. `Pins` has
///
///   bool data();                        the level of DOUT
///   void clock(bool high);              of PD_SCK
///   void pause();                       at least 0.2 us, a few at most
///   void hold_interrupts(bool);         around one pulse: a long one switches the chip off
///   std::uint32_t microseconds();
///   std::uint32_t milliseconds();       both may pass zero
///
/// Every bit is sampled three times and the majority taken, so that a spike does not count. The protocol has
/// no checksum: a bit that is wrong for a whole pulse, and a data line that gets stuck in the middle of a
/// reading, are not seen in that reading. HX711 data sheet, "Serial interface".
template <class Pins>
class Hx711 {
 public:
  /// Channel and gain of the next conversion, as the number of pulses after the bits.
  enum class Gain : std::uint8_t { a128 = 1, b32 = 2, a64 = 3 };

  static constexpr std::int32_t most = 0x7FFFFF, least = -0x800000;
  /// Conversions that are wrong after power-up and a change of gain take so long at 10 a second.
  static constexpr std::uint32_t settling_milliseconds = 400;

  /// `settling` and `longest_wait` [ms] fit 10 conversions a second; at 80 take an eighth.
  explicit Hx711(Pins& pins, Gain gain = Gain::a128, std::uint32_t settling = settling_milliseconds,
                 std::uint32_t longest_wait = 500)
      : pins_(pins), gain_(gain), settling_(settling), longest_wait_(longest_wait) {
    power_up();
  }

  /// The newest conversion. Without a new one that before, with its time, until it is too old.
  Counts read() {
    const std::uint32_t now = pins_.milliseconds();
    if (is_off_) return {Fault::absent, 0, now};
    if (pins_.data()) return wait(now);
    std::int32_t value = 0;
    const Fault fault = clock_out(value);
    if (fault == Fault::timing) {
      // It may have switched itself off, and on again with another gain.
      power_up();
      return last_ = {fault, 0, now};
    }
    heard_at_ = now;
    if (fault != Fault::none) return last_ = {fault, 0, now};
    if (!gain_is_set_) {
      gain_is_set_ = true;
      settles_from_ = now;
    }
    if (!has_settled_ && now - settles_from_ < settling_) return last_ = {Fault::settling, 0, now};
    has_settled_ = true;
    const bool is_at_rail = value == most || value == least;
    return last_ = {is_at_rail ? Fault::saturated : Fault::none, value, now};
  }

  /// From the next conversion on; what comes until it has settled is not used.
  void set_gain(Gain gain) {
    gain_ = gain;
    begin();
  }
  /// Less than a microampere, until power_up().
  void power_down() {
    pins_.clock(true);
    is_off_ = true;
  }
  void power_up() {
    pins_.clock(false);
    is_off_ = false;
    begin();
  }

 private:
  static constexpr std::uint32_t longest_pulse = 50;  ///< [us]; above 60 it is switched off

  void begin() {
    gain_is_set_ = false;
    has_settled_ = false;
    heard_at_ = pins_.milliseconds();
    last_ = {Fault::settling, 0, heard_at_};
  }
  Counts wait(std::uint32_t now) {
    if (now - heard_at_ > longest_wait_) return {Fault::not_ready, 0, now};
    return last_;
  }

  bool level() {
    const int high = (pins_.data() ? 1 : 0) + (pins_.data() ? 1 : 0) + (pins_.data() ? 1 : 0);
    return high >= 2;
  }
  /// One pulse; the bit is there while the clock is high.
  bool pulse(bool& in_time) {
    pins_.hold_interrupts(true);
    const std::uint32_t begun = pins_.microseconds();
    pins_.clock(true);
    pins_.pause();
    const bool bit = level();
    pins_.clock(false);
    in_time = in_time && pins_.microseconds() - begun < longest_pulse;
    pins_.hold_interrupts(false);
    pins_.pause();
    return bit;
  }
  Fault clock_out(std::int32_t& value) {
    bool in_time = true;
    std::uint32_t bits = 0;
    for (int i = 0; i < 24; ++i) bits = bits << 1U | (pulse(in_time) ? 1U : 0U);
    bool is_high = true;
    for (int i = 0; i < static_cast<int>(gain_); ++i) is_high = pulse(in_time) && is_high;
    if (!in_time) return Fault::timing;
    // After the bits the line rests high until the next conversion.
    if (!is_high || !level()) return Fault::stuck;
    value = static_cast<std::int32_t>(bits ^ 0x800000U) - 0x800000;
    return Fault::none;
  }

  Pins& pins_;
  Gain gain_;
  std::uint32_t settling_, longest_wait_;
  Counts last_;
  std::uint32_t heard_at_ = 0;      // the last conversion, whatever it was worth
  std::uint32_t settles_from_ = 0;  // the conversion after which the gain is that which was asked for
  bool gain_is_set_ = false, has_settled_ = false, is_off_ = false;
};

}  // namespace instruments
