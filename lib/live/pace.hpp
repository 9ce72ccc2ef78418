// A log played at the speed of its time column, or faster.
#pragma once

#include <chrono>
#include <optional>

#include "lib/live/stop_signal.hpp"

namespace taut::host {

/// Rows wait until it is their time.
class Pace {
 public:
  /// `speed` seconds of the log a second.
  Pace(double speed, const StopSignal& stop) : speed_(speed), stop_(stop) {}

  /// Returns when so many seconds of the log have passed since the first row, or the program is to end.
  void wait_for(double time) {
    if (!first_) {
      first_ = time;
      begun_ = Clock::now();
    }
    while (!stop_.is_requested()) {
      const double passed = std::chrono::duration<double>(Clock::now() - begun_).count();
      const double left = (time - *first_) / speed_ - passed;
      if (left <= 0) return;
      constexpr double longest = 1;  // s
      stop_.wait(static_cast<int>(1000 * (left < longest ? left : longest)) + 1);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  const StopSignal& stop_;
  std::optional<double> first_;
  Clock::time_point begun_;
};

}  // namespace taut::host
