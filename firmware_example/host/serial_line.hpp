// A serial line of this computer, for the device's Modbus.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace monitor::host {

class SerialLine {
 public:
  /// Opens a serial device, or a pseudo-terminal, with even parity. Throws std::runtime_error.
  SerialLine(const std::string& path, std::uint32_t baud);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// To wait for bytes.
  int descriptor() const { return line_; }

  /// Bytes that come together have the time at which they were found.
  bool read(std::uint8_t& byte, std::uint32_t& at);
  std::uint32_t microseconds() const;
  void write(const std::uint8_t* bytes, int count);

 private:
  int line_ = -1;
  std::array<std::uint8_t, 512> bytes_{};
  std::size_t taken_ = 0, held_ = 0;
  std::uint32_t found_at_ = 0;
};

}  // namespace monitor::host
