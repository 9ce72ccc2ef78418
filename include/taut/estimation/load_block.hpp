// Readings of a load cell that a line explains, taken into account together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace taut {

/// Where a line is at one time, with covariances: the slope is by the unit of time.
template <class Scalar>
struct LineState {
  Scalar level, slope;
  Scalar level_variance, covariance, slope_variance;
};

/// Readings with standard deviation one since a line was last fitted. Of a straight line their mean says
/// nearly all that they say one by one: it is a reading in the middle of them, with the variance 1 / size.
/// They are kept themselves too, for the case that one does not agree.
template <class Scalar, int Capacity>
struct LoadBlock {
  static constexpr int capacity = Capacity;
  using Values = std::array<Scalar, static_cast<std::size_t>(Capacity)>;

  Values reading{}, step{};  ///< as they were read; the time since the one before
  Scalar sum = 0;            ///< of the readings, as levels of the line
  Scalar times = 0;          ///< sum of their times since the line was last fitted
  Scalar span = 0;           ///< time of the last one
  std::int8_t size = 0;
  std::int8_t room = 0;  ///< so many are taken into account together

  void begin(int most) {
    size = 0;
    room = static_cast<std::int8_t>(most < capacity ? most : capacity);
    sum = times = span = 0;
  }
  /// There must be room. `level` is the reading as a level of the line.
  void add(Scalar given, Scalar dt, Scalar level) {
    reading[static_cast<std::size_t>(size)] = given;
    step[static_cast<std::size_t>(size)] = dt;
    ++size;
    span += dt;
    times += span;
    sum += level;
  }
  bool is_full() const { return size >= room; }
  Scalar share() const { return shares[static_cast<std::size_t>(size)]; }  ///< 1 / size

  /// The line at the last reading, once it has taken the mean of them all; how far that mean was off, and the
  /// variance of that; and the same of the last reading alone, without the others.
  struct Fit {
    Scalar level, variance;
    Scalar off, spread;
    Scalar last_off, last_spread;
  };
  Fit fit(const LineState<Scalar>& line, Scalar last) const {
    const Scalar P = line.level_variance, C = line.covariance, Q = line.slope_variance;
    const Scalar n = share(), t = span, m = times * n;
    const Scalar level = line.level + t * line.slope, variance = P + t * (C + C + t * Q);
    Fit fit;
    fit.last_off = last - level;
    fit.last_spread = variance + 1;
    fit.off = sum * n - (line.level + m * line.slope);
    fit.spread = P + m * (C + C + m * Q) + n;
    const Scalar together = P + (t + m) * C + t * m * Q, gain = together / fit.spread;
    fit.level = level + gain * fit.off;
    fit.variance = variance - gain * together;
    return fit;
  }

 private:
  static_assert(Capacity <= 8, "shares of more are missing");
  static constexpr Scalar third = Scalar(1) / 3, fifth = Scalar(1) / 5, seventh = Scalar(1) / 7;
  static constexpr Scalar shares[] = {0,     1,         Scalar(0.5), third,        Scalar(0.25),
                                      fifth, third / 2, seventh,     Scalar(0.125)};
};

}  // namespace taut
