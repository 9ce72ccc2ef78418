// A jack that is let out, of an end that the log never has locked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace taut::host {

/// Finds where the load of a jack has fallen to next to nothing after it had pulled, for two rows at least,
/// in a log in which its end is never locked: if it has a wedge, that has probably been drawn in there.
class NeverLocked {
 public:
  /// A row of a jacked end; `reading` [N] is not a number if there is none, and less than `least` is no load.
  void take(double reading, bool locked, double least, std::size_t line) {
    is_locked_ = is_locked_ || locked;
    if (std::isnan(reading) || rows_ == few) return;
    // Of two in a row, for one may be wrong.
    const double both = std::min(reading, last_);
    last_ = reading;
    if (highest_ > least && reading < nothing * highest_) {
      ++rows_;
      return;
    }
    rows_ = 0;
    highest_ = std::max(highest_, both);
    held_ = reading;
    held_line_ = line;
  }
  bool is_found() const { return !is_locked_ && rows_ == few; }
  /// The load of the last row that has some [N], and its line.
  double held() const { return held_; }
  std::size_t held_line() const { return held_line_; }

 private:
  static constexpr double nothing = 0.05;
  static constexpr int few = 2;

  double highest_ = 0, last_ = 0, held_ = 0;
  std::size_t held_line_ = 0;
  int rows_ = 0;  // in a row with next to none
  bool is_locked_ = false;
};

}  // namespace taut::host
