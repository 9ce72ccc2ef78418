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
/// they are few beside those that it has taken before. How far it drifts off shows in the sum of its
/// innovations, where older ones fade; readings that do not wait are followed in it too. The readings are
/// kept themselves as well, for the case that some do not
/// agree.
template <class Force, class Scalar, int Capacity>
struct LoadBlock {
  static constexpr int capacity = Capacity;
  /// Of an innovation in the sum, from one reading to the next: a line that has bent is off by more and more.
  static constexpr Scalar fade = Scalar(0.8);

  std::array<Force, static_cast<std::size_t>(Capacity)> reading{};  ///< as they were read
  std::array<Scalar, static_cast<std::size_t>(Capacity)> step{};    ///< the time since the one before
  Scalar level = 0, slope = 0;  ///< of the line that follows them, at the last reading
  Scalar level_gain = 0, slope_gain = 0;
  Scalar spread = 0;          ///< variance of an innovation
  Scalar drift = 0;           ///< sum of the innovations of the line
  Scalar drift_variance = 0;  ///< of the sum after many
  Scalar sum = 0;             ///< of the readings, as levels of the line
  Scalar times = 0;           ///< sum of their times since the line was last fitted
  Scalar span = 0;            ///< time of the last one
  std::int8_t size = 0;
  std::int8_t most = 0;  ///< so many may wait

  /// Up to so many readings of this line will come about `dt` apart.
  void begin(const LineState<Scalar>& line, Scalar dt, int up_to) {
    const Scalar C = line.covariance + dt * line.slope_variance,
                 P = line.level_variance + dt * (line.covariance + C);
    spread = P + 1;
    drift_variance = spread / (1 - fade * fade);
    level = line.level;
    slope = line.slope;
    level_gain = P / spread;
    slope_gain = C / spread;
    sum = times = span = 0;
    size = 0;
    most = static_cast<std::int8_t>(up_to < capacity ? up_to : capacity);
  }
  /// Variance of `level` once it has taken a reading.
  Scalar variance() const { return level_gain; }
  /// There must be room. Returns the innovation: how far the reading, as a level, is from what the line
  /// expected.
  Scalar add(Force given, Scalar dt, Scalar y) {
    reading[static_cast<std::size_t>(size)] = given;
    step[static_cast<std::size_t>(size)] = dt;
    ++size;
    span += dt;
    times += span;
    sum += y;
    const Scalar expected = level + dt * slope, innovation = y - expected;
    level = expected + level_gain * innovation;
    slope += slope_gain * innovation;
    follow(innovation);
    return innovation;
  }
  /// An innovation of the line, also of a reading that does not wait.
  void follow(Scalar innovation) { drift = fade * drift + innovation; }
  /// No more of them than these wait from now on; level_of() is that of a reading. What follows them is not
  /// put back.
  template <class LevelOf>
  void keep(int first, int count, const LevelOf& level_of) {
    sum = times = span = 0;
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(first + count); ++i) {
      span += step[i];
      times += span;
      sum += level_of(reading[i]);
    }
    size = static_cast<std::int8_t>(count);
  }
  void close() { most = 0; }  ///< none waits any more
  bool has_room() const { return size < most; }
  Scalar share() const { return shares[static_cast<std::size_t>(size)]; }  ///< 1 / size

 private:
  static_assert(Capacity <= 16, "shares of more are missing");
  static constexpr Scalar part(int of) { return Scalar(1) / static_cast<Scalar>(of); }
  static constexpr Scalar shares[] = {0,        1,        part(2),  part(3),  part(4),  part(5),
                                      part(6),  part(7),  part(8),  part(9),  part(10), part(11),
                                      part(12), part(13), part(14), part(15), part(16)};
};

}  // namespace taut
