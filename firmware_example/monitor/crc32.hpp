// The checksum of frames and records: CRC-32 as in Ethernet and zip.
#pragma once

#include <cstddef>
#include <cstdint>

namespace monitor {

/// Finds every error of up to three bits and every burst of up to 32 in a frame. By half bytes: 64 bytes of
/// table in place of 1024.
class Crc32 {
 public:
  void add(std::uint8_t byte) {
    state_ = (state_ >> 4) ^ table[(state_ ^ byte) & 0xFU];
    state_ = (state_ >> 4) ^ table[(state_ ^ (byte >> 4U)) & 0xFU];
  }
  void add(const void* bytes, std::size_t count) {
    const auto* each = static_cast<const std::uint8_t*>(bytes);
    for (std::size_t i = 0; i < count; ++i) add(each[i]);
  }
  std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::uint32_t table[16] = {
      0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
      0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
  std::uint32_t state_ = 0xFFFFFFFF;
};

}  // namespace monitor
