// Frames on the line: $<body>*<CRC-32 of the body, 8 hexadecimal digits><line feed>
//
// The body is printable ASCII without $ and *: fields with one blank between them. Numbers are 8 lower-case
// hexadecimal digits, a float by its IEEE bits, so that nothing is rounded on the way.
#pragma once

#include <cstdint>
#include <cstring>

#include "monitor/crc32.hpp"

namespace monitor {

/// One more whenever a frame changes.
constexpr std::uint32_t protocol_version = 2;

constexpr int digits_of_a_number = 8;
/// What a frame has around its body.
constexpr int frame_overhead = 1 + 1 + digits_of_a_number + 1;

inline std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline float float_of(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The value of a digit, or -1. Capitals are no digits: one way to write a number.
constexpr int digit_value(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  return -1;
}

/// Walks over the fields of a body. Each call takes one field and returns whether it was there and fitted.
class Fields {
 public:
  Fields(const char* text, int size) : at_(text), end_(text + size) {}

  bool letter(char& letter) {
    if (at_ == end_) return false;
    letter = *at_++;
    return separator();
  }
  bool number(std::uint32_t& value) {
    if (end_ - at_ < digits_of_a_number) return false;
    value = 0;
    for (int i = 0; i < digits_of_a_number; ++i) {
      const int digit = digit_value(*at_++);
      if (digit < 0) return false;
      value = value << 4 | static_cast<std::uint32_t>(digit);
    }
    return separator();
  }
  bool real(float& value) {
    std::uint32_t bits = 0;
    if (!number(bits)) return false;
    value = float_of(bits);
    return true;
  }
  /// A number, or `-` where there is none.
  bool reading(bool& has, float& value) {
    has = at_ == end_ || *at_ != '-';
    char none = 0;
    return has ? real(value) : letter(none);
  }
  bool done() const { return at_ == end_ && !blank_at_end_; }

 private:
  bool separator() {
    if (at_ == end_) return true;
    if (*at_ != ' ') return false;
    ++at_;
    blank_at_end_ = at_ == end_;
    return true;
  }

  const char* at_;
  const char* end_;
  bool blank_at_end_ = false;
};

/// Finds frames in a stream of bytes, one byte after the other.
template <int MostBody>
class FrameReader {
 public:
  enum class Event : std::uint8_t {
    none,     ///< go on
    frame,    ///< fields() has a body whose checksum is right; valid until the next byte
    refused,  ///< something was there that is no frame
  };

  Event take(char byte) {
    if (byte == '$') {
      const bool cut_short = size_ >= 0 || junk_;
      size_ = 0;
      junk_ = false;
      return cut_short ? Event::refused : Event::none;
    }
    if (size_ < 0) {
      const bool line_ends = junk_ && byte == '\n';
      junk_ = byte != '\n';
      return line_ends ? Event::refused : Event::none;
    }
    if (byte == '\n') {
      const bool good = is_good();
      body_ = size_ - 1 - digits_of_a_number;
      size_ = -1;
      return good ? Event::frame : Event::refused;
    }
    if (size_ == capacity || byte < ' ' || byte > '~') {
      // The rest of the line is skipped.
      size_ = -1;
      junk_ = true;
      return Event::none;
    }
    text_[size_++] = byte;
    return Event::none;
  }
  Fields fields() const { return {text_, body_}; }

 private:
  static constexpr int capacity = MostBody + 1 + digits_of_a_number;

  bool is_good() const {
    const int body = size_ - 1 - digits_of_a_number;
    if (body < 1 || text_[body] != '*') return false;
    std::uint32_t given = 0;
    Fields checksum(text_ + body + 1, digits_of_a_number);
    if (!checksum.number(given)) return false;
    Crc32 crc;
    crc.add(text_, static_cast<std::size_t>(body));
    return crc.value() == given;
  }

  char text_[capacity];
  int size_ = -1;  // of what has come since the $; -1 between frames
  int body_ = 0;
  bool junk_ = false;  // something came that no $ began
};

/// Puts a frame together. If its body does not fit there is no frame: size() is zero.
template <int MostBody>
class FrameWriter {
 public:
  void begin(char kind) {
    text_[0] = '$';
    size_ = 1;
    full_ = false;
    put(kind);
  }
  void letter(char letter) {
    put(' ');
    put(letter);
  }
  /// Goes on with the field before.
  void more(char letter) { put(letter); }
  void number(std::uint32_t value) {
    put(' ');
    digits(value);
  }
  void number(int value) { number(static_cast<std::uint32_t>(value)); }
  void real(float value) { number(bits_of(value)); }
  void word(const char* word) {
    put(' ');
    for (; *word != '\0'; ++word) put(*word);
  }
  void finish() {
    Crc32 crc;
    crc.add(text_ + 1, static_cast<std::size_t>(size_ - 1));
    room_ = sizeof text_;
    put('*');
    digits(crc.value());
    put('\n');
    room_ = MostBody + 1;
    if (full_) size_ = 0;
  }
  const char* text() const { return text_; }
  int size() const { return size_; }

 private:
  void digits(std::uint32_t value) {
    for (int shift = 28; shift >= 0; shift -= 4) put("0123456789abcdef"[value >> shift & 0xFU]);
  }
  void put(char byte) {
    if (size_ < room_)
      text_[size_++] = byte;
    else
      full_ = true;
  }

  char text_[MostBody + frame_overhead];
  int size_ = 0;
  int room_ = MostBody + 1;
  bool full_ = false;
};

}  // namespace monitor
