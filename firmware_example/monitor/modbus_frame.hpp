// Modbus RTU frames on a line: what lies between two silences of 3.5 characters.
#pragma once

#include <cstdint>

#include "monitor/modbus_crc.hpp"

namespace monitor {

/// Longest frame: address, 253 bytes, checksum.
constexpr int most_modbus_frame = 256;

/// The silence that ends a frame [us]: 3.5 characters of 11 bits, above 19200 bits a second 1750 us. Modbus
/// over serial line V1.02, 2.5.1.1.
constexpr std::uint32_t modbus_silence(std::uint32_t baud) { return baud > 19200 ? 1750 : 38500000 / baud; }

/// Finds frames in bytes and the times at which they came. Times are microseconds of a clock that may pass
/// zero. Pauses within a frame that are shorter than a silence are forgiven: the checksum tells.
class ModbusFrameReader {
 public:
  explicit ModbusFrameReader(std::uint32_t silence) : silence_(silence) {}

  /// Whether bytes have come and the silence that ends their frame has passed; then size() and bytes() are
  /// valid until clear().
  bool has_ended(std::uint32_t now) const { return size_ > 0 && now - last_ >= silence_; }
  void clear() { size_ = 0; }
  /// A byte of the present frame.
  void add(std::uint8_t byte, std::uint32_t at) {
    if (size_ < most_modbus_frame) bytes_[size_] = byte;
    // One more than fits says that it is too long.
    if (size_ <= most_modbus_frame) ++size_;
    last_ = at;
  }

  /// Whether length and checksum are those of a frame.
  bool is_good() const {
    if (size_ < 4 || size_ > most_modbus_frame) return false;
    ModbusCrc crc;
    crc.add(bytes_, size_);
    return crc.value() == 0;
  }
  const std::uint8_t* bytes() const { return bytes_; }
  /// With the checksum.
  int size() const { return size_; }

 private:
  std::uint8_t bytes_[most_modbus_frame] = {};
  int size_ = 0;
  std::uint32_t silence_;
  std::uint32_t last_ = 0;
};

}  // namespace monitor
