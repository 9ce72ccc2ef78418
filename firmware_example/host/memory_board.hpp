// A board of nothing but memory: the line, the clock and the non-volatile memory are variables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include "monitor/start.hpp"

namespace monitor::host {

/// A line whose bytes have times.
class MemoryLine {
 public:
  struct Byte {
    std::uint8_t value;
    std::uint32_t at;
  };
  std::deque<Byte> to_device;
  std::vector<std::uint8_t> from_device;
  std::uint32_t clock = 0;  ///< [us]

  bool read(std::uint8_t& byte, std::uint32_t& at) {
    if (to_device.empty()) return false;
    byte = to_device.front().value;
    at = to_device.front().at;
    to_device.pop_front();
    return true;
  }
  std::uint32_t microseconds() const { return clock; }
  void write(const std::uint8_t* bytes, int count) {
    from_device.insert(from_device.end(), bytes, bytes + count);
  }
};

class MemoryBoard {
 public:
  // For the one who plays the world around.
  std::string to_device, from_device;
  MemoryLine modbus;
  std::uint32_t clock = 0;
  std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(memory_size);
  Start reason = Start::power_on;
  std::uint32_t lost = 0;
  std::uint32_t fed = 0;  ///< how often the watchdog was fed
  bool asked_to_restart = false;
  long bytes_until_cut =
      -1;            ///< bytes that still reach the memory before the power fails; negative: no failure
  int torn = -1;     ///< what the byte in which the power fails becomes, -1: it stays
  long written = 0;  ///< bytes that have reached the memory

  // For the application.
  bool read(char& byte) {
    if (taken_ == to_device.size()) {
      to_device.clear();
      taken_ = 0;
      return false;
    }
    byte = to_device[taken_++];
    return true;
  }
  void write(const char* bytes, int count) { from_device.append(bytes, static_cast<std::size_t>(count)); }
  std::uint32_t lost_bytes() const { return lost; }
  std::uint32_t milliseconds() const { return clock; }
  void feed_watchdog() { ++fed; }
  Start start() const { return reason; }
  void restart() { asked_to_restart = true; }
  void hang() {}
  std::uint32_t stack_used() const { return 0; }
  std::uint32_t stack_size() const { return 0; }

  static constexpr int memory_size = 1 << 20;
  void read(int at, void* to, std::size_t count) { std::memcpy(to, memory.data() + at, count); }
  void write(int at, const void* from, std::size_t count) {
    const auto* bytes = static_cast<const std::uint8_t*>(from);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t& cell = memory[static_cast<std::size_t>(at) + i];
      if (bytes_until_cut == 0) {
        if (torn >= 0 && !has_torn_) cell = static_cast<std::uint8_t>(torn);
        has_torn_ = true;
        return;
      }
      if (bytes_until_cut > 0) --bytes_until_cut;
      cell = bytes[i];
      ++written;
    }
  }
  /// The power is back.
  void power_on() {
    bytes_until_cut = -1;
    has_torn_ = false;
    to_device.clear();
    from_device.clear();
    taken_ = 0;
  }

  /// Whether everything that was sent has been read.
  bool line_is_empty() const { return taken_ == to_device.size(); }

 private:
  std::size_t taken_ = 0;
  bool has_torn_ = false;
};

}  // namespace monitor::host
