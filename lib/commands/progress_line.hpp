// How far a long run is, on a line of the terminal.
#pragma once

#include <chrono>
#include <cstddef>

namespace taut::host {

/// `row N of M (P %)` on standard error, once a run takes longer than people like to wait without a word.
/// The line is written over itself and erased at the end. Nothing is shown where no one watches.
class ProgressLine {
 public:
  /// `watched`: whether standard error is a terminal, and nothing else is written to it.
  ProgressLine(std::size_t rows, bool watched);
  ~ProgressLine() { erase(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// So many rows are done.
  void reach(std::size_t row) {
    if (watched_) show(row);
  }
  void erase();

 private:
  using Clock = std::chrono::steady_clock;

  void show(std::size_t row);

  std::size_t rows_;
  bool watched_;
  Clock::time_point next_;
  std::size_t width_ = 0;  // of what the line shows; 0: nothing
};

/// Whether a person reads what is written there.
bool standard_error_is_terminal();
bool standard_output_is_terminal();

}  // namespace taut::host
