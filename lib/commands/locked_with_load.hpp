// An end that is locked in the very row of a load that its jack had not pulled before.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace taut::host {

/// Finds the first row that locks an end and has a load a twentieth above the one before: in a locked row the
/// column of a jack is not used, so that whoever writes both into one row loses the load.
class LockedWithLoad {
 public:
  /// A row of a jacked end; `reading` [N] is not a number if there is none, and less than `least` is no load.
  void take(double reading, bool locked, double least, std::size_t line) {
    if (locked && !is_locked_ && !is_found() && reading > std::max(least, (1 + more) * last_)) {
      load_ = reading;
      line_ = line;
    }
    if (!is_found() && !locked && !std::isnan(reading)) last_ = reading;
    is_locked_ = locked;
  }
  bool is_found() const { return line_ > 0; }
  /// The load of that row, and the one before [N].
  double load() const { return load_; }
  double last() const { return last_; }
  std::size_t line() const { return line_; }

 private:
  static constexpr double more = 0.05;

  double load_ = 0, last_ = 0;
  std::size_t line_ = 0;
  bool is_locked_ = true;  // a log may begin behind a wedge
};

}  // namespace taut::host
