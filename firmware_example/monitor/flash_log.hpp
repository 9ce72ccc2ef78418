// Records one after the other in two sectors of flash: a sector is erased when the other one is full.
#pragma once

#include <cstddef>
#include <cstdint>

#include "monitor/record.hpp"

namespace monitor {

/// `Flash` has
///
///   static constexpr int sector_size;                        [bytes] of each of two sectors
///   bool is_there();                                         whether it can be written
///   bool erase(int sector);                                  all ones; false: it failed
///   bool program(int at, std::uint32_t word);                at a multiple of four, of both sectors in a row
///   void read(int at, void* to, std::size_t count);
///   void lock();                                             after the last of these
///
/// The sectors wear alike, and each only once in as many records as fit into it. Cut at any word, the newest
/// whole record is still there: it is never in the sector that is erased.
template <class Flash>
class FlashLog {
 public:
  static constexpr int sectors = 2;

  /// `slot`: room for a record [bytes], a multiple of four.
  FlashLog(Flash& flash, int slot) : flash_(flash), slot_(slot) {}

  /// Finds the newest record; `header` is then its header. `nothing`: both sectors are blank.
  Found find(RecordHeader& header) {
    bool blank = true;
    latest_ = -1;
    for (int number = 0; number < sectors * slots(); ++number) {
      RecordHeader other;
      flash_.read(start_of(number), &other, sizeof other);
      blank = blank && other.magic == erased;
      if (!is_good_record(flash_, start_of(number), slot_, other)) continue;
      // The sequence may pass zero.
      if (latest_ >= 0 && other.sequence - header.sequence > 0x7FFFFFFF) continue;
      header = other;
      latest_ = number;
    }
    tried_ = latest_;
    return latest_ >= 0 ? Found::record : blank ? Found::nothing : Found::damage;
  }
  /// Bytes of the record that was found, from its header on.
  void read(std::size_t at, void* to, std::size_t count) {
    flash_.read(start_of(latest_) + static_cast<int>(at), to, count);
  }

  /// Copies a record of `count` bytes, a multiple of four and at most a slot, from `memory`. After a failure
  /// it tries once more, elsewhere. False: it is not in the flash.
  template <class Memory>
  bool store(Memory& memory, int from, int count) {
    const bool stored = put(memory, from, count) || put(memory, from, count);
    flash_.lock();
    return stored;
  }

 private:
  static constexpr std::uint32_t erased = 0xFFFFFFFF;

  int slots() const { return Flash::sector_size / slot_; }
  int start_of(int number) const { return number / slots() * Flash::sector_size + number % slots() * slot_; }
  bool is_blank(int start) {
    bool blank = true;
    for (int at = 0; blank && at < slot_; at += 4) {
      std::uint32_t word = 0;
      flash_.read(start + at, &word, sizeof word);
      blank = word == erased;
    }
    return blank;
  }
  /// A slot for the next record, or -1. What a cut has left half written is passed over.
  int next_slot() {
    for (int number = tried_ + 1; number % slots() != 0; ++number)
      if (is_blank(start_of(number))) return number;
    // Also if it looks blank: an erasure that was cut leaves bits that are ones today.
    const int other = latest_ < 0 ? 0 : 1 - latest_ / slots();
    return flash_.erase(other) ? other * slots() : -1;
  }
  template <class Memory>
  bool put(Memory& memory, int from, int count) {
    const int number = next_slot();
    if (number < 0) return false;
    tried_ = number;
    for (int at = 0; at < count; at += 4) {
      std::uint32_t word = 0;
      memory.read(from + at, &word, sizeof word);
      if (!flash_.program(start_of(number) + at, word)) return false;
    }
    latest_ = number;
    return true;
  }

  Flash& flash_;
  int slot_;
  int latest_ = -1;  // number of the slot with the newest record, over both sectors
  int tried_ = -1;   // the last one that was written to
};

}  // namespace monitor
