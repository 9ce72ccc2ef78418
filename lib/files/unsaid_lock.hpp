// A jack that is let out while the log does not have its end locked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::host {

/// Whether the wedge of an end may hold though no row says so: its jack has been let out to next to nothing,
/// for two rows at least, after it had pulled. So it may until the end is locked, its jack has pulled more
/// than ever before, or the far end has come down to less than half, too.
class UnsaidLock {
 public:
  /// What it knows, as numbers.
  using Memory = std::array<double, 4>;

  UnsaidLock() = default;
  /// Goes on where another one, whose memory() this is, has come to.
  explicit UnsaidLock(const Memory& memory)
      : highest_(memory[0]),
        highest_far_(memory[1]),
        last_(memory[2]),
        let_out_(static_cast<int>(memory[3])) {}

  /// A row of a jacked end that has a wedge; `reading` [N], and that of the far end, is not a number if there
  /// is none, and less than `least` is no load.
  void take(double reading, double far_end, bool locked, double least) {
    if (!std::isnan(far_end)) highest_far_ = std::max(highest_far_, far_end);
    const bool has_come_down = highest_far_ > least && far_end < highest_far_ / 2;
    if (locked || has_come_down) *this = {};
    if (locked || std::isnan(reading)) return;
    // Of two in a row, for one may be wrong.
    const double both = std::min(reading, last_);
    last_ = reading;
    if (both > highest_) {
      highest_ = both;
      let_out_ = 0;
    } else if (highest_ > least && reading < nothing * highest_) {
      let_out_ = std::min(let_out_ + 1, few);
    } else if (!may_hold()) {
      let_out_ = 0;
    }
  }
  bool may_hold() const { return let_out_ >= few; }
  Memory memory() const { return {highest_, highest_far_, last_, static_cast<double>(let_out_)}; }

 private:
  static constexpr double nothing = 0.05;
  static constexpr int few = 2;

  double highest_ = 0, highest_far_ = 0, last_ = 0;
  int let_out_ = 0;  // rows with next to no load, up to a few
};

}  // namespace taut::host
