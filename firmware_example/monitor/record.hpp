// The record of the state in non-volatile memory: two slots in turn, so that a power failure while one is
// written leaves the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "monitor/crc32.hpp"

namespace monitor {

/// What a record says of itself, in front of its content. The CRC-32 of both follows the content.
struct RecordHeader {
  static constexpr std::uint32_t magic_number = 0x54554154;  // "TAUT"
  /// Of the content: one more whenever its fields change.
  static constexpr std::uint32_t present_version = 19;

  std::uint32_t magic = magic_number;
  std::uint32_t version = present_version;
  std::uint32_t length = 0;    ///< of the content [bytes]
  std::uint32_t kind = 0;      ///< number of the scene
  std::uint32_t maker = 0;     ///< fingerprint of scene and firmware that can read the content
  std::uint32_t sequence = 0;  ///< one more with every record
};

/// Whether there is a whole record at `start`, no longer than `slot` [bytes].
template <class Memory>
bool is_good_record(Memory& memory, int start, int slot, const RecordHeader& header) {
  constexpr int around = static_cast<int>(sizeof header + sizeof(std::uint32_t));
  if (header.magic != RecordHeader::magic_number || header.version != RecordHeader::present_version ||
      slot < around || header.length > static_cast<std::uint32_t>(slot - around))
    return false;
  Crc32 crc;
  const std::size_t count = sizeof header + header.length;
  std::uint8_t chunk[32];
  for (std::size_t done = 0; done < count; done += sizeof chunk) {
    const std::size_t part = count - done < sizeof chunk ? count - done : sizeof chunk;
    memory.read(start + static_cast<int>(done), chunk, part);
    crc.add(chunk, part);
  }
  std::uint32_t checksum = 0;
  memory.read(start + static_cast<int>(count), &checksum, sizeof checksum);
  return checksum == crc.value();
}

enum class Found : std::uint8_t { record, nothing, damage };

/// How soon a record must outlive the power.
enum class Keep : std::uint8_t { at_once, soon };

/// Two slots in a memory `Memory` with read(at, to, count) and write(at, from, count).
///
/// The slot that is written is never the one that was good last, and its checksum is its last word: cut at
/// any byte, the record before is still there.
template <class Memory>
class Records {
 public:
  /// `slot` is the size of one slot [bytes].
  Records(Memory& memory, int slot) : memory_(memory), slot_(slot) {}

  static constexpr int size_with(std::size_t content) {
    return static_cast<int>((sizeof(RecordHeader) + content + sizeof(std::uint32_t) + 3) / 4 * 4);
  }

  /// Finds the newest record; `header` is then its header. `nothing`: the memory was never written.
  Found find(RecordHeader& header) {
    bool blank = true;
    latest_ = -1;
    for (int slot = 0; slot < 2; ++slot) {
      RecordHeader other;
      memory_.read(slot * slot_, &other, sizeof other);
      blank = blank && (other.magic == 0 || other.magic == 0xFFFFFFFF);
      if (!is_good_record(memory_, slot * slot_, slot_, other)) continue;
      // The sequence may pass zero.
      if (latest_ >= 0 && other.sequence - header.sequence > 0x7FFFFFFF) continue;
      header = other;
      latest_ = slot;
    }
    sequence_ = latest_ < 0 ? 0 : header.sequence;
    return latest_ >= 0 ? Found::record : blank ? Found::nothing : Found::damage;
  }

  /// Bytes of the content of the record that was found.
  void read(std::size_t at, void* to, std::size_t count) {
    memory_.read(latest_ * slot_ + static_cast<int>(sizeof(RecordHeader) + at), to, count);
  }

  /// Begins a record in the slot that may be lost.
  void begin(RecordHeader header) {
    header.sequence = ++sequence_;
    latest_ = latest_ == 0 ? 1 : 0;
    at_ = latest_ * slot_;
    crc_ = {};
    add(&header, sizeof header);
  }
  void add(const void* bytes, std::size_t count) {
    crc_.add(bytes, count);
    put(bytes, count);
  }
  /// This memory outlives the power: at once is always.
  void finish(Keep) {
    const std::uint32_t checksum = crc_.value();
    put(&checksum, sizeof checksum);
  }
  /// For records that are written later: nothing here.
  void idle() {}
  /// How many could not be written.
  static constexpr std::uint32_t failures() { return 0; }

  // For memory of two kinds.

  /// Goes on after a record that is elsewhere.
  void continue_after(std::uint32_t sequence) { sequence_ = sequence; }
  /// Where the newest record is, and how many bytes it has with its checksum.
  int latest_at() const { return latest_ * slot_; }
  int latest_size() const { return at_ - latest_at(); }

 private:
  void put(const void* bytes, std::size_t count) {
    memory_.write(at_, bytes, count);
    at_ += static_cast<int>(count);
  }
  Memory& memory_;
  int slot_;
  int latest_ = -1;  // slot of the newest good record
  int at_ = 0;
  std::uint32_t sequence_ = 0;
  Crc32 crc_;
};

/// What keeps the records of a board: what it names, or two slots in its memory.
template <class Board, class = void>
struct RecordsOf {
  using Type = Records<Board>;
};
template <class Board>
struct RecordsOf<Board, std::void_t<typename Board::RecordsType>> {
  using Type = typename Board::RecordsType;
};

}  // namespace monitor
