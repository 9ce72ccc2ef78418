// Whether the numbers of a row are to be trusted, said in one line.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "lib/files/sentence.hpp"

namespace taut::host {

/// Whether a verdict is `trust`, and not `do not trust: <reason>`.
bool is_trust(const Sentence& verdict);

/// Takes the alarms of an estimate row by row and judges them. A plain value; it does not grow with the log,
/// only with the number of places that alarms can name.
class Verdict {
 public:
  /// For every word of the last rows in which of them it was raised: bit 0 is the present row, bit 1 the one
  /// before, and so on to bit `rows` - 1. No word has no bit.
  using Memory = std::map<std::string, std::uint32_t>;
  /// So many rows are looked at, with the present one.
  static constexpr int rows = 30;

  Verdict() = default;
  /// Goes on where another one, whose memory() this is, has come to.
  explicit Verdict(Memory memory) : raised_(std::move(memory)) {}

  /// The next row, with the words of its alarms as alarm_word() writes them, separated by blanks. Returns its
  /// verdict: `trust`, or `do not trust: ` and the one or two worst reasons, joined by `; `. There is no
  /// comma in its English. A word of no kind that makes numbers doubtful changes nothing. In a load stage
  /// what contradicts the model makes them doubtful if it was raised once in the last three rows.
  Sentence take(const std::string& words, bool is_stage = false);

  const Memory& memory() const { return raised_; }

 private:
  Memory raised_;
};

}  // namespace taut::host
