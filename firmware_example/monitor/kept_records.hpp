// The record in memory of two kinds: RAM that a reset leaves alone, and flash that outlives the power.
#pragma once

#include <cstddef>
#include <cstdint>

#include "monitor/flash_log.hpp"
#include "monitor/record.hpp"

namespace monitor {

/// Every record is in RAM; in flash are those that must be kept at once, and of the others one in
/// Board::flash_interval [ms], for flash wears. A reset loses nothing, a power failure what was sampled
/// since.
///
/// `Board` has the RAM as its memory, read() and write(), and flash() as FlashLog needs it. If its flash is
/// not there the RAM is all there is.
template <class Board>
class KeptRecords {
 public:
  KeptRecords(Board& board, int slot) : board_(board), ram_(board, slot), log_(board.flash(), slot) {
    static_assert(Board::memory_size / 2 <= Board::Flash::sector_size, "a record may not fit into a sector");
  }

  static constexpr int size_with(std::size_t content) { return Records<Board>::size_with(content); }

  Found find(RecordHeader& header) {
    const Found in_ram = ram_.find(header);
    if (!board_.flash().is_there()) return in_ram;
    RecordHeader stored;
    const Found in_flash = log_.find(stored);
    is_in_flash_ = in_flash == Found::record &&
                   (in_ram != Found::record || stored.sequence - header.sequence - 1 < 0x7FFFFFFF);
    if (is_in_flash_) {
      header = stored;
      ram_.continue_after(stored.sequence);
      return Found::record;
    }
    // After a power failure the RAM holds anything.
    return in_ram == Found::record ? Found::record : in_flash;
  }
  void read(std::size_t at, void* to, std::size_t count) {
    if (is_in_flash_)
      log_.read(sizeof(RecordHeader) + at, to, count);
    else
      ram_.read(at, to, count);
  }

  void begin(const RecordHeader& header) { ram_.begin(header); }
  void add(const void* bytes, std::size_t count) { ram_.add(bytes, count); }
  void finish(Keep how_soon) {
    ram_.finish(how_soon);
    is_waiting_ = true;
    if (how_soon == Keep::at_once) store();
    idle();
  }
  /// Writes what has waited for long enough.
  void idle() {
    if (is_waiting_ && board_.milliseconds() - stored_at_ >= Board::flash_interval) store();
  }
  /// Records that could not be written to the flash.
  std::uint32_t failures() const { return failures_; }

 private:
  void store() {
    is_waiting_ = false;
    stored_at_ = board_.milliseconds();
    if (!board_.flash().is_there()) return;
    board_.feed_watchdog();
    if (!log_.store(board_, ram_.latest_at(), (ram_.latest_size() + 3) / 4 * 4)) ++failures_;
    board_.feed_watchdog();
  }

  Board& board_;
  Records<Board> ram_;
  FlashLog<typename Board::Flash> log_;
  bool is_in_flash_ = false;
  bool is_waiting_ = false;
  std::uint32_t stored_at_ = 0;
  std::uint32_t failures_ = 0;
};

}  // namespace monitor
