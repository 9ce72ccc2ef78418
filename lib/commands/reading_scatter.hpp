// How large the readings of an instrument are in a log, and how much they scatter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace taut::host {

/// Takes readings in their order. Memory: up to half a megabyte.
class ReadingScatter {
 public:
  void add(double reading) {
    largest_ = std::max(largest_, std::fabs(reading));
    high_ = readings_ == 0 ? reading : std::max(high_, reading);
    low_ = readings_ == 0 ? reading : std::min(low_, reading);
    if (in_a_row_ >= 1) way_ += std::fabs(reading - last_);
    if (in_a_row_ >= 2) {
      keep(std::fabs(reading - 2 * last_ + before_));
      ++readings_on_lines_;
    }
    before_ = last_;
    last_ = reading;
    ++readings_;
    ++in_a_row_;
  }
  /// What comes next is on no line with what came before.
  void interrupt() { in_a_row_ = 0; }
  /// In place of readings: how large they may be, and how much they may scatter.
  void expect(double largest, double scatter) {
    largest_ = largest;
    expected_ = scatter;
  }

  /// The largest size of a reading.
  double largest() const { return largest_; }
  /// The standard deviation of readings about the lines that they follow; what was expected, or 0, of fewer
  /// than three. The median of the size of a second difference of white noise is 0.6745 sqrt(6) standard
  /// deviations.
  double scatter() const {
    if (bends_.empty()) return expected_;
    std::vector<double> bends = bends_;
    const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
    std::nth_element(bends.begin(), middle, bends.end());
    return *middle / (0.6745 * std::sqrt(6.0));
  }
  std::size_t readings() const { return readings_; }
  /// How many readings could be compared with a line through the two before.
  std::size_t on_lines() const { return readings_on_lines_; }
  /// Whether they come further than noise does on its way: of white noise fewer than one series in a hundred
  /// would. Load stages are on no line that scatter() knows; they are no more than these.
  bool goes_somewhere() const {
    const bool are_stages = readings_ >= 8 && readings_ <= 64;
    return are_stages && way_ <= static_cast<double>(readings_ - 1) / 6 * (high_ - low_);
  }

 private:
  static constexpr std::size_t most_bends = 65536;

  // Every so many of a long log have the same median.
  void keep(double bend) {
    if (readings_ % every_ != 0) return;
    if (bends_.size() == most_bends) {
      for (std::size_t i = 0; 2 * i < most_bends; ++i) bends_[i] = bends_[2 * i];
      bends_.resize(most_bends / 2);
      every_ *= 2;
    }
    bends_.push_back(bend);
  }

  std::vector<double> bends_;
  double largest_ = 0, expected_ = 0, last_ = 0, before_ = 0;
  double high_ = 0, low_ = 0, way_ = 0;  // way_: there and back
  std::size_t readings_ = 0, readings_on_lines_ = 0, in_a_row_ = 0, every_ = 1;
};

}  // namespace taut::host
