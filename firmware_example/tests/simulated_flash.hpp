// The flash of an STM32F4 with its controller, as the reference manual RM0090 has it, and a power that fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace rig {

/// Two sectors of 16 KiB, numbers 2 and 3, so that they are soon full.
struct SmallSectors {
  static constexpr std::uint32_t first = 2, address = 0x08008000;
  static constexpr int sector_size = 16 * 1024;
};

class SimulatedFlash {
 public:
  // The world.
  bool has_controller = true;
  long until_cut = -1;       ///< words that are still written, and steps of an erasure; negative: no failure
  bool is_worn_out = false;  ///< nothing becomes zero any more
  int worn_word = -1;        ///< that keeps its zeros, counted over both sectors; negative: none
  // What was seen.
  long steps = 0;  ///< words written and steps of erasures
  int erasures[2] = {};
  int misuses = 0;  ///< what the manual forbids
  std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(2 * SmallSectors::sector_size, 0xFF);

  /// The power is back: the controller is locked.
  void power_on() {
    until_cut = -1;
    is_off_ = false;
    control_ = locked;
    status_ = 0;
    keys_ = 0;
    busy_looks_ = 0;
  }

  std::uint32_t read(std::uint32_t address) {
    if (address >= base && address < base + memory.size()) {
      std::uint32_t word = 0;
      std::memcpy(&word, &memory[address - base], 4);
      return word;
    }
    if (!has_controller) return 0;
    if (address == 0x40023C10) return control_;
    if (address != 0x40023C0C) return misuse();
    const std::uint32_t status = status_ | (busy_looks_ > 0 ? 1U << 16U : 0U);
    if (busy_looks_ > 0) --busy_looks_;
    return status;
  }
  void write(std::uint32_t address, std::uint32_t word) {
    if (address >= base && address < base + memory.size()) return program(address - base, word);
    if (!has_controller) return;
    switch (address) {
      case 0x40023C04:
        // A wrong key locks until the next reset.
        keys_ = keys_ == 0 && word == 0x45670123 ? 1 : keys_ == 1 && word == 0xCDEF89AB ? 2 : 3;
        if (keys_ == 2) control_ &= ~locked;
        if (keys_ == 3) misuse();
        return;
      case 0x40023C0C:
        status_ &= ~(word & 0xF3U);
        return;
      case 0x40023C10:
        if ((control_ & locked) != 0 || busy_looks_ > 0) {
          misuse();
          return;
        }
        control_ = word & ~start;
        if ((word & locked) != 0) keys_ = 0;
        if ((word & start) != 0) erase();
        return;
      default:
        misuse();
    }
  }
  void copy(std::uint32_t address, void* to, std::size_t count) {
    if (address < base || address + count > base + memory.size())
      misuse();
    else
      std::memcpy(to, &memory[address - base], count);
  }

 private:
  static constexpr std::uint32_t base = SmallSectors::address;
  static constexpr std::uint32_t locked = 1U << 31U, start = 1U << 16U;

  std::uint32_t misuse() {
    ++misuses;
    return 0;
  }
  /// Whether the power fails in this step; it is off afterwards.
  bool fails() {
    if (until_cut == 0) is_off_ = true;
    if (until_cut > 0) --until_cut;
    if (!is_off_) ++steps;
    return is_off_;
  }
  void program(std::uint32_t at, std::uint32_t word) {
    if (!has_controller || is_off_) return;
    const bool is_ready = (control_ & locked) == 0 && (control_ & 1U) != 0 && busy_looks_ == 0;
    // By words, and a word at its place.
    if (!is_ready || (control_ & 0x300U) != 0x200 || at % 4 != 0) {
      status_ |= 1U << 7U;
      ++misuses;
      return;
    }
    std::uint32_t old = 0;
    std::memcpy(&old, &memory[at], 4);
    // A bit becomes zero, never one. A program that tries would be wrong.
    if ((word & ~old) != 0) ++misuses;
    std::uint32_t becomes = old & word;
    if (fails()) becomes = old & (word | static_cast<std::uint32_t>(random_()));
    if (static_cast<int>(at / 4) == worn_word) becomes &= 0xFFFFFFFE;
    if (is_worn_out) becomes = old;
    std::memcpy(&memory[at], &becomes, 4);
    busy_looks_ = 2;
  }
  void erase() {
    const std::uint32_t sector = (control_ >> 3U & 0xFU) - SmallSectors::first;
    if (sector > 1 || (control_ & 2U) == 0) {
      ++misuses;
      return;
    }
    if (is_off_) return;
    ++erasures[sector];
    constexpr int parts = 32, part = SmallSectors::sector_size / parts;
    for (int i = 0; i < parts && !is_off_; ++i) {
      const bool is_cut = fails();
      for (int k = 0; k < part; ++k) {
        std::uint8_t& byte =
            memory[sector * SmallSectors::sector_size + static_cast<std::size_t>(i * part + k)];
        byte = static_cast<std::uint8_t>(is_cut ? byte | random_() : 0xFF);
      }
    }
    busy_looks_ = 3;
  }

  std::uint32_t control_ = locked, status_ = 0;
  int keys_ = 0, busy_looks_ = 0;
  bool is_off_ = false;
  std::mt19937 random_{405};
};

}  // namespace rig
