// What the cell of a jack reads before its jack pulls.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace taut::host {

/// Finds out what the cell of a jack reads at rest, before its load rises for the first time. A little of
/// what the jack pulls later is probably no load, but a cell that was not tared.
class RestOffZero {
 public:
  /// The next row; `reading` is not a number if there is none.
  void take(double reading, bool locked) {
    if (!std::isnan(reading)) largest_ = std::max(largest_, std::fabs(reading));
    if (has_risen_ || std::isnan(reading)) return;
    if (locked || (rows_ >= least_rows &&
                   std::fabs(reading - level()) > std::max(3 * spread(), std::fabs(level()) / 10))) {
      has_risen_ = true;
      return;
    }
    if (rows_++ >= least_rows) return;
    sum_ += reading;
    low_ = rows_ == 1 ? reading : std::min(low_, reading);
    high_ = rows_ == 1 ? reading : std::max(high_, reading);
  }
  /// Whether there is a level at rest, and the jack pulls at least twenty times as much later.
  bool is_found() const {
    return has_risen_ && rows_ >= least_rows && spread() <= std::fabs(level()) / 5 &&
           largest_ >= times * std::fabs(level());
  }
  /// What is read at rest, and the largest reading of all [N].
  double level() const { return sum_ / least_rows; }
  double largest() const { return largest_; }
  /// How many rows it rests.
  std::size_t rows() const { return rows_; }

 private:
  // Below a twentieth the load of a first row is not taken for one of a past that nobody knows.
  static constexpr double times = 20;
  static constexpr std::size_t least_rows = 5;

  double spread() const { return high_ - low_; }

  double sum_ = 0, low_ = 0, high_ = 0;  // of the first `least_rows`
  double largest_ = 0;
  std::size_t rows_ = 0;
  bool has_risen_ = false;
};

}  // namespace taut::host
