// How much the readings of an instrument scatter, found from the readings themselves.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "taut/numerics/larger.hpp"

namespace taut {

/// The standard deviation of readings about a line, s of neighbours and s' of readings a second, at least
/// eight readings, apart. Noise that is remembered scatters less among neighbours, r = s' / s times, and
/// averages out more slowly than its scatter tells: noise that fades as exp(-t / tau), tau about a second, as
/// if it were white with r^1.5 s'. No more than r = 4.5 counts: a load that wanders never averages out; nor a
/// smaller s than an eighth of what was said: readings without noise are no measure.
///
/// Second differences of what lies on a line are zero; the median of their size, which is not moved by
/// corners and outliers, is followed in steps that shrink to a hundredth. After n of them, at most 99, s is
/// known to about 1.2 / sqrt(n) of itself; it counts where it exceeds what was said by 4 / sqrt(n + 1), s'
/// where it exceeds s by 6 / sqrt(n + 1): noise of 1.4 times what was said, and r of 1.6, are found at last.
/// Readings must be about equally far apart in time. Those far apart are compared only where the path does
/// not bend in between. A plain value. Cost: a few operations a reading.
template <class Scalar>
class NoiseLevel {
 public:
  /// A level that is so many times another is worth going over to.
  static constexpr Scalar worth_it = Scalar(1.3);

  /// Readings scatter at least by `sd`.
  void start(Scalar sd) {
    *this = NoiseLevel();
    said_ = neighbours_.sd = beside_.sd = distant_.sd = sd;
  }
  /// The standard deviation of white noise that averages out as slowly as this noise, and scatters no less.
  Scalar sd() const {
    const Scalar near = larger(larger(neighbours_.sd, beside_.sd), least * said_),
                 white = neighbours_.exceeds(said_, 4) ? neighbours_.sd : said_;
    if (distant_.learned < few || !distant_.exceeds(near, 6)) return white;
    const Scalar r = -larger(-distant_.sd / near, -most_remembered);
    return larger(white, r * std::sqrt(r) * distant_.sd);
  }

  /// The readings have left the line that they were on.
  void bend() {
    kept_ = 0;
    strides_ = 0;
  }
  /// The next reading, `dt` [s] after the one before. Returns whether it is time to ask for sd(): every few
  /// readings.
  bool take(Scalar reading, Scalar dt) {
    const bool is_even = std::fabs(dt - dt_) <= Scalar(0.25) * dt_;
    dt_ = dt;
    if (!is_even) {
      count_ = 0;
      bend();
    }
    const Scalar of_neighbours = std::fabs(reading - 2 * last_ + before_) * to_sd;
    const bool has_neighbours = count_ == 2;
    if (has_neighbours)
      neighbours_.follow(of_neighbours);
    else
      ++count_;
    before_ = last_;
    last_ = reading;
    if (strides_ == 0) span_ = 0;
    span_ += dt;
    if (++strides_ < fewest || (span_ < stride && strides_ < most)) return false;
    strides_ = 0;
    if (kept_ == 4 && has_neighbours) {
      beside_.follow(of_neighbours);
      distant_.follow(std::fabs(reading - 2 * at_[1] + at_[3]) * to_sd);
    } else if (kept_ < 4) {
      ++kept_;
    }
    at_ = {reading, at_[0], at_[1], at_[2]};
    return true;
  }

 private:
  /// Every so many readings, half of a second, one is kept.
  static constexpr int fewest = 4, most = 250;
  static constexpr Scalar stride = Scalar(0.5), most_remembered = Scalar(4.5), least = Scalar(0.125);
  static constexpr std::int8_t settled = 99, few = 8;
  /// The median of the size of a second difference is 0.6745 sqrt(6) standard deviations.
  static constexpr Scalar to_sd = Scalar(0.60525);

  struct Level {
    Scalar sd = 0;
    std::int8_t learned = 0;

    /// Towards the median of these.
    void follow(Scalar size) {
      if (learned < settled) ++learned;
      const Scalar step = 1 + 1 / static_cast<Scalar>(learned + 1);
      sd *= size > sd ? step : 1 / step;
    }
    /// Whether it is more than that by so many times 1 / sqrt(n + 1) of it.
    bool exceeds(Scalar other, int times) const {
      const Scalar excess = sd - other, by = static_cast<Scalar>(times) * other;
      return excess > 0 && excess * excess * static_cast<Scalar>(learned + 1) > by * by;
    }
  };

  // Those beside are the neighbours where readings far apart are compared: a scatter that ceases is not taken
  // for memory while the two follow it at different paces.
  Level neighbours_, distant_, beside_;
  Scalar said_ = 0, dt_ = 0, last_ = 0, before_ = 0, span_ = 0;
  std::array<Scalar, 4> at_{};  // kept readings, the newest first
  std::int8_t count_ = 0, kept_ = 0;
  std::uint8_t strides_ = 0;
};

}  // namespace taut
