// The answers on standard output.
#pragma once

#include <atomic>
#include <thread>

#include "lib/live/answer_board.hpp"

namespace taut::host {

/// On a terminal one steady screen, drawn over itself at most ten times a second; elsewhere one line a row,
/// of which some are left out where nobody takes them. In a thread of its own, which nobody waits for longer
/// than `patience`.
class Terminal {
 public:
  static constexpr std::chrono::milliseconds pause{100}, patience{1000};

  Terminal(const SceneDescription& scene, const AnswerBoard& board);
  /// Shows what is left and gives the terminal back as it was. The board is closed before.
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

 private:
  void draw_screen();
  void write_lines();
  bool put(const std::string& text);

  const SceneDescription& scene_;
  const AnswerBoard& board_;
  bool is_terminal_;
  std::thread thread_;
};

}  // namespace taut::host
