// Axes with round numbers.
#pragma once

#include <string>
#include <vector>

namespace taut::host {

/// From the smallest to the largest of some values.
class Range {
 public:
  void include(double value);
  bool empty() const { return low_ > high_; }
  double low() const { return empty() ? 0 : low_; }
  double high() const { return empty() ? 0 : high_; }

 private:
  double low_ = 1, high_ = -1;
};

struct Tick {
  double value = 0;
  std::string label;
};

struct Axis {
  double low = 0, high = 1;
  std::vector<Tick> ticks;

  /// Where a value lies, 0 to 1; what lies outside is moved to the nearer end.
  double part(double value) const;

  /// Ends at round numbers.
  static Axis round(const Range& range, int most_ticks);
  /// Ends at the range's own ends. Ticks count from `origin`.
  static Axis exact(const Range& range, int most_ticks, double origin = 0);
  /// A band for each of 1, 2 ... n.
  static Axis counted(std::size_t n, std::size_t most_ticks);
};

}  // namespace taut::host
