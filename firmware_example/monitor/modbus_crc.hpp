// The checksum of Modbus RTU frames: CRC-16 with the polynomial A001h, begun at FFFFh.
#pragma once

#include <cstdint>

namespace monitor {

/// Over all bytes of a frame and its checksum, low byte first, value() is zero. By half bytes: 32 bytes of
/// table in place of 512. Modbus over serial line V1.02, 6.2.2.
class ModbusCrc {
 public:
  void add(std::uint8_t byte) {
    step(byte & 0xFU);
    step(byte >> 4U);
  }
  void add(const std::uint8_t* bytes, int count) {
    for (int i = 0; i < count; ++i) add(bytes[i]);
  }
  std::uint16_t value() const { return state_; }

 private:
  void step(unsigned half) {
    state_ = static_cast<std::uint16_t>((state_ >> 4U) ^ table[(state_ ^ half) & 0xFU]);
  }

  static constexpr std::uint16_t table[16] = {0x0000, 0xCC01, 0xD801, 0x1400, 0xF001, 0x3C00, 0x2800, 0xE401,
                                              0xA001, 0x6C00, 0x7800, 0xB401, 0x5000, 0x9C01, 0x8801, 0x4400};
  std::uint16_t state_ = 0xFFFF;
};

}  // namespace monitor
