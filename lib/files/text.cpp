#include "lib/files/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace taut::host {
namespace {

constexpr std::size_t longest_quote = 48;     // of a message that still fits on a line
constexpr std::size_t longest_compared = 64;  // keeps the comparison cheap on hostile input
constexpr std::size_t most_listed = 12;

bool continues(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

// Length of the UTF-8 character at the start of the text; 0 if it is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 && lead < 0xF5   ? 4
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues(byte(i))) return 0;
  }
  return length;
}

std::string escaped(unsigned char byte) {
  constexpr char digits[] = "0123456789abcdef";
  return std::string("\\x") + digits[byte >> 4] + digits[byte & 0xF];
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Number of single-character edits and swaps of neighbours between two words, capitals counting as small
// letters.
std::size_t distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest_compared + 1>;
  Row before_last{}, last{}, row{};
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({row[j - 1] + 1, last[j] + 1, last[j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j))
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

// The known word that `word` was probably meant to be; null if none is near.
const std::string* nearest(std::string_view word, const std::vector<std::string>& known) {
  const std::string* best = nullptr;
  std::size_t fewest = 0;
  for (const std::string& candidate : known) {
    if (word.size() > longest_compared || candidate.size() > longest_compared) continue;
    const std::size_t edits = distance(word, candidate);
    const std::size_t tolerated = std::max<std::size_t>(1, std::min(word.size(), candidate.size()) / 3);
    if (edits > tolerated || edits >= std::max(word.size(), candidate.size())) continue;
    if (best == nullptr || edits < fewest) best = &candidate, fewest = edits;
  }
  return best;
}

}  // namespace

std::string quote(std::string_view text) {
  std::string shown = "\"";
  while (!text.empty()) {
    if (shown.size() > longest_quote) {
      shown += "...";
      break;
    }
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::size_t length = character_length(text);
    if (length == 0 || byte < 0x20 || byte == 0x7F) {
      shown += escaped(byte);
      text.remove_prefix(1);
    } else {
      shown += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return shown + "\"";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string plain(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known,
                       const std::string& kind) {
  if (const std::string* meant = nearest(word, known)) return "did you mean " + quote(*meant) + "?";
  if (known.empty()) return "remove it: there are none";
  std::string list = kind;
  for (std::size_t i = 0; i < std::min(known.size(), most_listed); ++i)
    list += (i == 0 ? " " : ", ") + quote(known[i]);
  if (known.size() > most_listed) list += " and " + std::to_string(known.size() - most_listed) + " more";
  return list;
}

std::string pointer_step(std::string_view key) {
  std::string step = "/";
  for (const char c : key) {
    if (c == '~') {
      step += "~0";
    } else if (c == '/') {
      step += "~1";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      step += escaped(static_cast<unsigned char>(c));  // a message is one line
    } else {
      step += c;
    }
  }
  return step;
}

}  // namespace taut::host
