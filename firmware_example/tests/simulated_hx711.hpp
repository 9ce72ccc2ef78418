// An HX711 and its two pins, with the times of its data sheet, and a world that disturbs them.
#pragma once

#include <cstdint>
#include <functional>

namespace rig {

/// Pins of a simulated chip. Time passes with every call.
class SimulatedHx711 {
 public:
  // The world.
  std::function<double(int)> input = [](int) {
    return 0.0;
  };  ///< counts at gain 1, of channel 0 (A) or 1 (B)
  enum class Line { follows, low, high } line = Line::follows;
  bool has_supply = true;
  int spike_at_read = -1;       ///< the read of the data pin, counted from 0, that says the opposite
  int slow_at_pulse = -1;       ///< the pulse in which something takes long that no interrupt mask holds
  int interrupt_at_pulse = -1;  ///< the same with an interrupt, if none is held
  double pause_microseconds = 1;
  double access_microseconds = 0.05;            ///< what looking at a pin or setting it takes
  static constexpr double conversion = 100000;  ///< [us]: 10 a second

  // What was seen of the driver.
  int reads = 0, pulses = 0, last_pulses = 0;
  double longest_pulse = 0;
  bool is_off() const { return has_supply && is_off_at(now_); }

  void pass(double microseconds) { until(now_ + microseconds); }

  // For the driver.
  bool data() {
    until(now_ + access_microseconds);
    const bool level = line == Line::high || !has_supply || (line == Line::follows && output_at(now_));
    return (reads++ == spike_at_read) != level;
  }
  void clock(bool high) {
    until(now_ + access_microseconds);
    if (high == clock_) return;
    if (high) {
      rises_at_ = now_;
      before_ = output_;
      ++pulses;
      shift();
      clock_ = true;
      if (pulses - 1 == slow_at_pulse || (pulses - 1 == interrupt_at_pulse && !held_)) until(now_ + 80);
    } else {
      longest_pulse = now_ - rises_at_ > longest_pulse ? now_ - rises_at_ : longest_pulse;
      // Awake from power-down: everything anew, channel A with gain 128.
      if (is_off_at(now_)) restart();
      clock_ = false;
    }
  }
  void pause() { until(now_ + pause_microseconds); }
  void hold_interrupts(bool held) {
    held_ = held;
    // What was held comes now.
    if (!held && interrupt_at_pulse >= 0 && pulses - 1 == interrupt_at_pulse) until(now_ + 80);
  }
  std::uint32_t microseconds() { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(now_)); }
  std::uint32_t milliseconds() { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(now_ / 1000)); }

 private:
  bool is_off_at(double time) const { return clock_ && time - rises_at_ > 60; }
  /// Data is valid 0.1 us after the edge.
  bool output_at(double time) const {
    if (is_off_at(time)) return true;
    return clock_ && time - rises_at_ < 0.1 ? before_ : output_;
  }
  void restart() {
    shifted_ = -1;
    output_ = true;
    selection_ = next_selection_ = 1;
    unsettled_ = 3;
    converts_at_ = now_ + conversion;
  }
  void until(double time) {
    while (converts_at_ <= time) {
      now_ = converts_at_;
      converts_at_ += conversion;
      if (!is_off_at(now_) && (shifted_ < 0 || shifted_ >= 24)) convert();
    }
    now_ = time;
  }
  void convert() {
    last_pulses = shifted_ < 0 ? last_pulses : shifted_;
    if (shifted_ > 24) next_selection_ = shifted_ - 24;
    if (next_selection_ != selection_) unsettled_ = 3;
    selection_ = next_selection_;
    const int gain = selection_ == 1 ? 128 : selection_ == 2 ? 32 : 64;
    double counts = input(selection_ == 2 ? 1 : 0) * gain;
    // Until it has settled it says something else.
    if (unsettled_ > 0) {
      counts = counts / 2 + 1000;
      --unsettled_;
    }
    const double bound = counts > 8388607 ? 8388607 : counts < -8388608 ? -8388608 : counts;
    word_ = static_cast<std::uint32_t>(static_cast<std::int32_t>(bound)) & 0xFFFFFFU;
    shifted_ = 0;
    output_ = false;
  }
  void shift() {
    if (shifted_ < 0 || (shifted_ == 0 && output_)) return;
    output_ = shifted_ >= 24 || (word_ >> (23U - static_cast<unsigned>(shifted_)) & 1U) != 0;
    ++shifted_;
  }

  double now_ = 0, rises_at_ = 0, converts_at_ = conversion;
  bool clock_ = false, output_ = true, before_ = true, held_ = false;
  int shifted_ = -1;  // pulses since the conversion; -1 before the first
  int selection_ = 1, next_selection_ = 1, unsettled_ = 3;
  std::uint32_t word_ = 0;
};

}  // namespace rig
