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

/// Readings with standard deviation one that wait until several lines take them into account together. Of a
/// straight line their mean says nearly all that they say one by one: it is a reading in the middle of them,
/// with the variance 1 / size. One line follows them meanwhile, with the gains that it had for the first:
/// they are few beside those that it has taken before. They are kept themselves too, for the case that one
/// does not agree.
template <class Force, class Scalar, int Capacity>
struct LoadBlock {
  static constexpr int capacity = Capacity;

  std::array<Force, static_cast<std::size_t>(Capacity)> reading{};  ///< as they were read
  std::array<Scalar, static_cast<std::size_t>(Capacity)> step{};    ///< the time since the one before
  Scalar level = 0, slope = 0;  ///< of the line that follows them, at the last reading
  Scalar level_gain = 0, slope_gain = 0;
  Scalar spread = 1;  ///< variance of an innovation
  Scalar off = 0;     ///< sum of the innovations
  Scalar sum = 0;     ///< of the readings, as levels of the line
  Scalar times = 0;   ///< sum of their times since the line was last fitted
  Scalar span = 0;    ///< time of the last one
  std::int8_t size = 0;
  std::int8_t room = 0;  ///< so many more may wait

  /// Readings of this line will come about `dt` apart.
  void begin(const LineState<Scalar>& line, Scalar dt, int most) {
    const Scalar C = line.covariance + dt * line.slope_variance,
                 P = line.level_variance + dt * (line.covariance + C);
    spread = P + 1;
    level = line.level;
    slope = line.slope;
    level_gain = P / spread;
    slope_gain = C / spread;
    sum = times = span = off = 0;
    size = 0;
    room = static_cast<std::int8_t>(most < capacity ? most : capacity);
  }
  /// Variance of `level` once it has taken a reading.
  Scalar variance() const { return level_gain; }
  /// There must be room. Returns the innovation: how far the reading, as a level, is from what the line
  /// expected.
  Scalar add(Force given, Scalar dt, Scalar y) {
    reading[static_cast<std::size_t>(size)] = given;
    step[static_cast<std::size_t>(size)] = dt;
    ++size;
    --room;
    span += dt;
    times += span;
    sum += y;
    const Scalar expected = level + dt * slope, innovation = y - expected;
    level = expected + level_gain * innovation;
    slope += slope_gain * innovation;
    off += innovation;
    return innovation;
  }
  /// The last reading, `y`, is no longer among them. What follows them is not put back.
  void drop_last(Scalar y) {
    --size;
    sum -= y;
    times -= span;
    span -= step[static_cast<std::size_t>(size)];
  }
  bool is_full() const { return room == 0; }
  Scalar count() const { return static_cast<Scalar>(size); }
  Scalar share() const { return shares[static_cast<std::size_t>(size)]; }  ///< 1 / size

 private:
  static_assert(Capacity <= 8, "shares of more are missing");
  static constexpr Scalar third = Scalar(1) / 3, fifth = Scalar(1) / 5, seventh = Scalar(1) / 7;
  static constexpr Scalar shares[] = {0,     1,         Scalar(0.5), third,        Scalar(0.25),
                                      fifth, third / 2, seventh,     Scalar(0.125)};
};

}  // namespace taut
