// Modbus requests: what is asked of coils and registers, and the answer.
#pragma once

#include <cstdint>

#include "monitor/modbus_crc.hpp"
#include "monitor/modbus_frame.hpp"

namespace monitor {

/// Why a request is refused. Modbus application protocol V1.1b3, 7.
enum class ModbusException : std::uint8_t {
  none = 0,
  illegal_function = 1,  ///< none of 1 to 6, 15, 16
  illegal_address = 2,   ///< a coil or register that there is not, or that cannot be written
  illegal_value = 3,     ///< a wrong count or length, or a value that the command does not take
  device_failure = 4,    ///< the command is not possible now
};

/// Serves coils and registers of `Map`:
///
///   void begin_reading();                                          once before input registers are read
///   bool discrete(std::uint16_t address, bool& value);            whether there is such a one
///   bool coil(std::uint16_t address, bool& value);
///   bool input(std::uint16_t address, std::uint16_t& value);
///   bool holding(std::uint16_t address, std::uint16_t& value);
///   void set_holding(std::uint16_t address, std::uint16_t value);  of a register that there is
///   ModbusException set_coil(std::uint16_t address, bool value);   of a coil that there is
///
/// Bounded: at most 2000 questions to the map a request.
template <class Map>
class ModbusServer {
 public:
  ModbusServer(Map& map, std::uint8_t address) : map_(map), address_(address) {}

  /// Answers a frame with a good checksum. Returns how many bytes of answer() are to be sent: none to another
  /// device's frame, and none to a broadcast, which is obeyed if it writes.
  int take(const std::uint8_t* frame, int size) {
    const bool is_broadcast = frame[0] == 0;
    if (!is_broadcast && frame[0] != address_) return 0;
    request_ = frame + 1;
    length_ = size - 3;
    answer_[0] = frame[0];
    answer_[1] = request_[0];
    end_ = 2;
    const bool reads = request_[0] >= read_coils && request_[0] <= read_inputs;
    if (is_broadcast && reads) return 0;
    const ModbusException exception = serve();
    if (is_broadcast) return 0;
    if (exception != ModbusException::none) {
      answer_[1] = static_cast<std::uint8_t>(request_[0] | 0x80U);
      answer_[2] = static_cast<std::uint8_t>(exception);
      end_ = 3;
    }
    ModbusCrc crc;
    crc.add(answer_, end_);
    put(static_cast<std::uint8_t>(crc.value() & 0xFFU));
    put(static_cast<std::uint8_t>(crc.value() >> 8U));
    return end_;
  }
  const std::uint8_t* answer() const { return answer_; }

 private:
  static constexpr std::uint8_t read_coils = 1, read_discretes = 2, read_holdings = 3, read_inputs = 4,
                                write_coil = 5, write_holding = 6, write_coils = 15, write_holdings = 16;

  ModbusException serve() {
    switch (request_[0]) {
      case read_coils:
        return read_bits([this](std::uint16_t at, bool& value) { return map_.coil(at, value); });
      case read_discretes:
        return read_bits([this](std::uint16_t at, bool& value) { return map_.discrete(at, value); });
      case read_holdings:
        return read_words([this](std::uint16_t at, std::uint16_t& value) { return map_.holding(at, value); });
      case read_inputs:
        map_.begin_reading();
        return read_words([this](std::uint16_t at, std::uint16_t& value) { return map_.input(at, value); });
      case write_coil:
        return take_coil();
      case write_holding:
        return take_holding();
      case write_coils:
        return take_coils();
      case write_holdings:
        return take_holdings();
      default:
        return ModbusException::illegal_function;
    }
  }

  template <class Read>
  ModbusException read_bits(Read read) {
    const int count = word(3);
    if (length_ != 5 || count < 1 || count > 2000) return ModbusException::illegal_value;
    put(static_cast<std::uint8_t>((count + 7) / 8));
    unsigned bits = 0;
    for (int i = 0; i < count; ++i) {
      bool value = false;
      if (word(1) + i > 0xFFFF || !read(static_cast<std::uint16_t>(word(1) + i), value))
        return ModbusException::illegal_address;
      if (value) bits |= 1U << static_cast<unsigned>(i % 8);
      if (i % 8 != 7 && i != count - 1) continue;
      put(static_cast<std::uint8_t>(bits));
      bits = 0;
    }
    return ModbusException::none;
  }
  template <class Read>
  ModbusException read_words(Read read) {
    const int count = word(3);
    if (length_ != 5 || count < 1 || count > 125) return ModbusException::illegal_value;
    put(static_cast<std::uint8_t>(2 * count));
    for (int i = 0; i < count; ++i) {
      std::uint16_t value = 0;
      if (word(1) + i > 0xFFFF || !read(static_cast<std::uint16_t>(word(1) + i), value))
        return ModbusException::illegal_address;
      put_word(value);
    }
    return ModbusException::none;
  }

  ModbusException take_coil() {
    if (length_ != 5 || (word(3) != 0xFF00 && word(3) != 0)) return ModbusException::illegal_value;
    bool value = false;
    if (!map_.coil(static_cast<std::uint16_t>(word(1)), value)) return ModbusException::illegal_address;
    echo();
    return map_.set_coil(static_cast<std::uint16_t>(word(1)), word(3) != 0);
  }
  ModbusException take_holding() {
    if (length_ != 5) return ModbusException::illegal_value;
    std::uint16_t value = 0;
    if (!map_.holding(static_cast<std::uint16_t>(word(1)), value)) return ModbusException::illegal_address;
    map_.set_holding(static_cast<std::uint16_t>(word(1)), static_cast<std::uint16_t>(word(3)));
    echo();
    return ModbusException::none;
  }
  /// From the first on; those before one that is refused are set.
  ModbusException take_coils() {
    const int count = length_ < 6 ? 0 : word(3);
    if (count < 1 || count > 1968 || request_[5] != (count + 7) / 8 || length_ != 6 + request_[5])
      return ModbusException::illegal_value;
    bool value = false;
    for (int i = 0; i < count; ++i)
      if (word(1) + i > 0xFFFF || !map_.coil(static_cast<std::uint16_t>(word(1) + i), value))
        return ModbusException::illegal_address;
    for (int i = 0; i < count; ++i) {
      const bool on = (request_[6 + i / 8] >> static_cast<unsigned>(i % 8) & 1U) != 0;
      const ModbusException exception = map_.set_coil(static_cast<std::uint16_t>(word(1) + i), on);
      if (exception != ModbusException::none) return exception;
    }
    echo();
    return ModbusException::none;
  }
  ModbusException take_holdings() {
    const int count = length_ < 6 ? 0 : word(3);
    if (count < 1 || count > 123 || request_[5] != 2 * count || length_ != 6 + request_[5])
      return ModbusException::illegal_value;
    std::uint16_t value = 0;
    for (int i = 0; i < count; ++i)
      if (word(1) + i > 0xFFFF || !map_.holding(static_cast<std::uint16_t>(word(1) + i), value))
        return ModbusException::illegal_address;
    for (int i = 0; i < count; ++i)
      map_.set_holding(static_cast<std::uint16_t>(word(1) + i), static_cast<std::uint16_t>(word(6 + 2 * i)));
    echo();
    return ModbusException::none;
  }

  /// Of the request, or zero past its end.
  int word(int at) const { return at + 1 < length_ ? request_[at] << 8 | request_[at + 1] : 0; }
  void put(std::uint8_t byte) { answer_[end_++] = byte; }
  void put_word(std::uint16_t value) {
    put(static_cast<std::uint8_t>(value >> 8U));
    put(static_cast<std::uint8_t>(value & 0xFFU));
  }
  /// What a write answers: its address and its value or count.
  void echo() {
    for (int i = 1; i < 5; ++i) put(request_[i]);
  }

  Map& map_;
  std::uint8_t address_;
  const std::uint8_t* request_ = nullptr;  // from the function code on
  int length_ = 0;                         // of it, without the checksum
  std::uint8_t answer_[most_modbus_frame] = {};
  int end_ = 0;
};

}  // namespace monitor
