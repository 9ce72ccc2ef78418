// Where the readings of a load cell go over to another unit in the middle of a log.
#pragma once

#include <cmath>
#include <cstddef>

namespace taut::host {

/// Finds readings that go to a thousandth, a millionth, or as many times as much, from one row to the next
/// and stay there for four rows, to 3 %: N and kN, or N and MN. A load that is let out leaves noise, which
/// does not.
class UnitStep {
 public:
  void take(double reading, std::size_t line) {
    if (is_found()) return;
    if (rows_ > 0 && is_near(reading * times_, before_)) {
      ++rows_;
    } else {
      rows_ = 0;
      for (const double times : {1e3, 1e6, 1e-3, 1e-6})
        if (is_near(reading * times, last_)) begin(times, reading, line);
    }
    last_ = reading;
  }
  bool is_found() const { return rows_ == enough; }
  /// The readings before and after [N], and the line of the first one after.
  double before() const { return before_; }
  double after() const { return after_; }
  std::size_t line() const { return line_; }

 private:
  static constexpr int enough = 4;

  static bool is_near(double a, double b) { return b > 0 && std::fabs(a - b) < 0.03 * b; }
  void begin(double times, double reading, std::size_t line) {
    rows_ = 1;
    times_ = times;
    before_ = last_;
    after_ = reading;
    line_ = line;
  }

  double last_ = 0, before_ = 0, after_ = 0, times_ = 1;
  std::size_t line_ = 0;
  int rows_ = 0;
};

}  // namespace taut::host
