// Where the load of a jack is let out just before its end is said to be locked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace taut::host {

/// Finds the first lock-off before which the readings of a jack fall by more than half within ten seconds, or
/// from one row to the next but one. A wedge that is drawn in leaves the jack without load at once: if
/// `locked` comes rows later, the cable is taken to have been let out with it.
class LateLock {
 public:
  /// A row of a jacked end at a time [s]; `reading` is not a number if there is none, and less than `least`
  /// is no load.
  void take(double time, double reading, bool locked, double least, std::size_t line) {
    if (is_found()) return;
    if (locked) {
      // The rest of a load that is let out slowly is none that a wedge takes over.
      if (is_let_out_ && held_ > std::max(least, highest_ / 2)) locked_line_ = line;
      if (!is_found()) *this = LateLock();
      return;
    }
    if (std::isnan(reading)) return;
    // Of two in a row, for one may be wrong.
    const double both = std::min(reading, left_);
    const bool is_slow = ++rows_ > 2 && time - held_time_ > most_time;
    left_ = reading;
    is_let_out_ = reading < held_ / 2 && (is_let_out_ || !is_slow);
    if (is_let_out_ || (both < held_ * (1 - still_held) && !is_slow)) return;
    held_ = both;
    highest_ = std::max(highest_, both);
    held_line_ = line;
    held_time_ = time;
    rows_ = 0;
  }
  bool is_found() const { return locked_line_ > 0; }
  /// The readings before the load falls, and before the end is locked [N].
  double held() const { return held_; }
  double left() const { return left_; }
  /// The lines of the last row that has the load, and of the first one that is locked.
  std::size_t held_line() const { return held_line_; }
  std::size_t locked_line() const { return locked_line_; }

 private:
  static constexpr double still_held = 0.1, most_time = 10;  // [-], [s]

  double held_ = 0, highest_ = 0, left_ = 0, held_time_ = 0;
  int rows_ = 0;  // since it was held
  bool is_let_out_ = false;
  std::size_t held_line_ = 0, locked_line_ = 0;
};

}  // namespace taut::host
