// The flash controller of an STM32F405 behind its registers. RM0090, 3.6 and 3.9.
#pragma once

#include <cstddef>
#include <cstdint>

namespace boards {

/// The last two sectors of 128 KiB; the program has those before.
struct RecordSectors {
  static constexpr std::uint32_t first = 10, address = 0x080C0000;
  static constexpr int sector_size = 128 * 1024;
};

/// Writes two sectors in a row, for monitor::FlashLog. `Bus` has read(address) and write(address, word) for
/// registers and flash, and copy(address, to, count). While it erases, up to two seconds, the processor
/// stands still: it has its program from the same flash.
template <class Bus, class Sectors = RecordSectors>
class FlashController {
 public:
  static constexpr int sector_size = Sectors::sector_size;

  /// After reset the controller is locked. Where there is none, as in an emulator, the register reads zero.
  explicit FlashController(Bus& bus) : bus_(bus), is_there_((bus.read(control) & locked) != 0) {}

  bool is_there() const { return is_there_; }

  bool erase(int sector) {
    if (!begin()) return false;
    const std::uint32_t number = Sectors::first + static_cast<std::uint32_t>(sector);
    bus_.write(control, by_words | sector_erase | number << 3U);
    bus_.write(control, by_words | sector_erase | number << 3U | start);
    return end();
  }
  /// Also false if the flash does not hold the word then.
  bool program(int at, std::uint32_t word) {
    if (!begin()) return false;
    const std::uint32_t address = Sectors::address + static_cast<std::uint32_t>(at);
    bus_.write(control, by_words | programming);
    bus_.write(address, word);
    return end() && bus_.read(address) == word;
  }
  void read(int at, void* to, std::size_t count) {
    bus_.copy(Sectors::address + static_cast<std::uint32_t>(at), to, count);
  }
  /// Nothing that runs wild writes to it then.
  void lock() { bus_.write(control, locked); }

 private:
  static constexpr std::uint32_t key = 0x40023C04, status = 0x40023C0C, control = 0x40023C10;
  static constexpr std::uint32_t first_key = 0x45670123, second_key = 0xCDEF89AB;
  static constexpr std::uint32_t busy = 1U << 16U, errors = 0xF2;
  static constexpr std::uint32_t programming = 1, sector_erase = 2, by_words = 2U << 8U, start = 1U << 16U,
                                 locked = 1U << 31U;
  /// More than four seconds of looks at the status register.
  static constexpr std::uint32_t most_looks = 100000000;

  bool begin() {
    if (!wait()) return false;
    if ((bus_.read(control) & locked) != 0) {
      bus_.write(key, first_key);
      bus_.write(key, second_key);
    }
    // Those of the operation before; a one clears.
    bus_.write(status, errors);
    return (bus_.read(control) & locked) == 0;
  }
  bool end() {
    const bool is_through = wait();
    const bool is_good = (bus_.read(status) & errors) == 0;
    bus_.write(control, by_words);
    return is_through && is_good;
  }
  bool wait() {
    for (std::uint32_t look = 0; look < most_looks; ++look)
      if ((bus_.read(status) & busy) == 0) return true;
    return false;
  }

  Bus& bus_;
  bool is_there_;
};

}  // namespace boards
