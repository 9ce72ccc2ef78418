// How much the readings of an instrument scatter, found from the readings themselves.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/numerics/larger.hpp"

namespace taut {

/// The standard deviation of readings about a line, of neighbours and of means over three seconds, at least
/// eight readings: noise that lasts longer than a reading averages out less than its scatter tells. Of noise
/// that is remembered for a second half the variance of long means is seen: it is common to neighbouring
/// ones.
///
/// Second differences of what lies on a line are zero; their median, which is not moved by corners and
/// outliers, is followed in steps that shrink to a hundredth. After n of them, at most 99, the level is known
/// to about 1.2 / sqrt(n) of itself; it counts where it exceeds what was said by 4 / sqrt(n + 1), so that
/// noise of 1.4 times what was said is found at last. Readings must be about equally far apart in time. Means
/// are long beside the pieces of a path: only those count between which it does not bend. A plain value.
/// Cost: a few operations a reading.
template <class Scalar>
class NoiseLevel {
 public:
  /// Readings scatter at least by `sd`.
  void start(Scalar sd) {
    *this = NoiseLevel();
    said_ = neighbours_.sd = means_.sd = sd;
  }
  /// The standard deviation of white noise that averages out as slowly as this noise, and scatters no less.
  Scalar sd() const { return larger(neighbours_.beyond(said_), means_.beyond(said_)); }

  /// The readings have left the line that they were on.
  void bend() {
    means_.count = 0;
    in_mean_ = 0;
  }
  /// The next reading, `dt` [s] after the one before.
  void take(Scalar reading, Scalar dt) {
    const bool is_even = std::fabs(dt - dt_) <= Scalar(0.25) * dt_;
    dt_ = dt;
    if (!is_even) {
      neighbours_.count = means_.count = 0;
      in_mean_ = 0;
    }
    neighbours_.take(reading, to_sd);
    if (in_mean_ == 0) {
      first_ = reading;
      further_ = span_ = 0;
    }
    further_ += reading - first_;
    span_ += dt;
    if (++in_mean_ < fewest || (span_ < duration && in_mean_ < most)) return;
    const auto readings = static_cast<Scalar>(in_mean_);
    means_.take(first_ + further_ / readings, to_sd * std::sqrt(readings));
    in_mean_ = 0;
  }

 private:
  static constexpr int fewest = 8, most = 250;
  static constexpr Scalar duration = 3;
  static constexpr std::int8_t settled = 99;
  /// The median of the size of a second difference is 0.6745 sqrt(6) standard deviations.
  static constexpr Scalar to_sd = Scalar(0.60525);

  struct Level {
    Scalar last = 0, before = 0, sd = 0;
    std::int8_t count = 0, learned = 0;

    void take(Scalar value, Scalar scale) {
      if (count == 2) {
        if (learned < settled) ++learned;
        const Scalar step = 1 + 1 / static_cast<Scalar>(learned + 1);
        sd *= std::fabs(value - 2 * last + before) * scale > sd ? step : 1 / step;
      } else {
        ++count;
      }
      before = last;
      last = value;
    }
    /// The level where it is surely more than was said, else that.
    Scalar beyond(Scalar said) const {
      const Scalar excess = sd - said;
      return excess > 0 && excess * excess * static_cast<Scalar>(learned + 1) > 16 * said * said ? sd : said;
    }
  };

  Level neighbours_, means_;
  Scalar said_ = 0, dt_ = 0, first_ = 0, further_ = 0, span_ = 0;
  std::uint8_t in_mean_ = 0;
};

}  // namespace taut
