// How much the readings of an instrument scatter, found from the readings themselves.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
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
///
/// Sooner it shows four and eight readings apart that readings hang together, where s'' of the larger one of
/// these second differences exceeds s by 3 / sqrt(n + 1). If neighbours scatter by less than was said, it is
/// noise with a memory: then r is what was said by s, Eq. (53). Else the load itself goes up and down, as
/// with the strokes of a pump, by sqrt(s''^2 - s^2). That, and the error of a display that hardly changes, do
/// not average out: Found::lasting, Eq. (54).
template <class Scalar>
class NoiseLevel {
 public:
  /// Whether a level that is so many times another is worth going over to.
  static bool is_worth_it(Scalar times) { return !(times <= worth_it && times * worth_it >= 1); }

  /// Readings scatter at least by `sd`.
  void start(Scalar sd) {
    *this = NoiseLevel();
    said_ = counted_ = neighbours_.sd = beside_.sd = distant_.sd = apart_.sd = sd;
  }
  /// Readings are taken to scatter by `sd` from here on: by how many times the variance is larger than it
  /// ever was. Where bends of the path are taken for noise again and again, a level that comes and goes would
  /// make all that has been learned worth less every time.
  Scalar rises_to(Scalar sd) {
    const Scalar times = sd / counted_;
    counted_ = larger(counted_, sd);
    return larger(times * times, Scalar(1));
  }
  /// What readings scatter by.
  struct Found {
    Scalar sd;  ///< of white noise that averages out as slowly as this noise, and scatters no less
    /// Standard deviation of what a reading is off by together with those about it, so that their mean is off
    /// by as much; zero where there is no such thing. Of a load that goes up and down its amplitude counts:
    /// friction keeps the peaks.
    Scalar lasting;
  };
  Found found() const {
    const Scalar near = larger(neighbours_.sd, least * said_),
                 own = neighbours_.exceeds(said_, 4) ? neighbours_.sd : said_;
    const Scalar rounding = on_line_ > rests ? larger(said_, neighbours_.sd) : Scalar(0);
    // Smooth neighbours and rough ones farther apart may be one and the same chance.
    const bool hangs_together = on_line_ <= display && apart_.learned >= soon && apart_.exceeds(near, 3),
               is_smooth = hangs_together && is_below_said();
    Scalar white = own, explained = larger(near, beside_.sd), swings = 0;
    if (is_smooth && apart_.exceeds(near, 7)) {
      // What was said is what it scatters by in all.
      if (!distant_.exceeds(said_, 4))
        return {larger(own, Scalar(1.15) * remembered(said_ / neighbours_.sd) * said_), rounding};
    } else if (hangs_together && !is_smooth && apart_.learned >= enough) {
      swings = std::sqrt(apart_.sd * apart_.sd - near * near);
      white = std::sqrt(own * own + swings * swings);
      explained = larger(explained, white);
    }
    const Scalar lasting = larger(rounding, Scalar(1.4142136) * swings);
    // That neighbours are alike where nothing changes, or on the steps of a display, is no memory.
    if (on_line_ > display || distant_.learned < few || !distant_.exceeds(explained, 6))
      return {white, lasting};
    const Scalar r = remembered(distant_.sd / larger(near, beside_.sd));
    return {larger(white, r * std::sqrt(r) * distant_.sd), lasting};
  }
  Scalar sd() const { return found().sd; }
  Scalar lasting() const { return found().lasting; }
  /// Whether the last reading is another than the one before: the same one again of a force that stays is the
  /// step of a display, and no news.
  bool is_other() const { return last_ != before_; }
  /// The last reading, or zero.
  Scalar last() const { return last_; }

  /// The readings have left the line that they were on.
  void bend() {
    kept_ = 0;
    strides_ = 0;
    straight_ = 0;
  }
  /// The next reading, `dt` [s] after the one before. Returns whether it is time to ask for sd() and
  /// lasting(): every few readings.
  bool take(Scalar reading, Scalar dt) {
    const bool is_even = std::fabs(dt - dt_) <= Scalar(0.25) * dt_;
    dt_ = dt;
    if (!is_even) {
      count_ = 0;
      recent_ = 0;
      bend();
    }
    const Scalar of_neighbours = std::fabs(reading - 2 * last_ + before_) * to_sd;
    const bool has_neighbours = count_ == 2;
    if (has_neighbours) {
      neighbours_.follow(of_neighbours);
      on_line_ += ((of_neighbours < nothing * said_ ? Scalar(1) : Scalar(0)) - on_line_) * Scalar(0.0625);
    } else {
      ++count_;
    }
    follow_apart(reading);
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
  static constexpr Scalar worth_it = Scalar(1.3);
  /// Every so many readings, half of a second, one is kept.
  static constexpr int fewest = 4, most = 250;
  static constexpr unsigned lag = 4;
  static constexpr Scalar stride = Scalar(0.5), most_remembered = Scalar(4.5), least = Scalar(0.125);
  static constexpr std::int8_t settled = 99, few = 8, soon = 16, enough = 48;
  /// A second difference that is less than this part of what was said is none, as of a display; the part of
  /// those with which it is one, and with which it rests.
  static constexpr Scalar nothing = Scalar(1) / 64, display = Scalar(0.2), rests = Scalar(0.6);
  /// The median of the size of a second difference is 0.6745 sqrt(6) standard deviations.
  static constexpr Scalar to_sd = Scalar(0.60525);
  /// That of the larger one of two is 1.0518 sqrt(6).
  static constexpr Scalar larger_to_sd = Scalar(0.3882);

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

  static Scalar remembered(Scalar r) { return -larger(-r, -most_remembered); }
  /// Whether neighbours scatter by less than was said, and it is not chance.
  bool is_below_said() const {
    const Scalar missing = said_ - neighbours_.sd, by = 6 * neighbours_.sd;
    return missing > 0 && missing * missing * static_cast<Scalar>(neighbours_.learned + 1) > by * by;
  }
  /// Compares readings four apart, and eight where the path has not bent meanwhile.
  void follow_apart(Scalar reading) {
    const unsigned place = place_;
    const auto back = [&](unsigned by) { return recent_at_[(place + 4 * lag - by) % (4 * lag)]; };
    if (recent_ >= 2 * lag) {
      const Scalar middle = back(2 * lag), four = std::fabs(reading - 2 * back(lag) + middle);
      const bool is_straight = straight_ >= 4 * lag;
      const Scalar eight = is_straight ? std::fabs(reading - 2 * middle + recent_at_[place]) : Scalar(0);
      apart_.follow(is_straight ? larger(four, eight) * larger_to_sd : four * to_sd);
    }
    if (recent_ < 4 * lag) ++recent_;
    if (straight_ < 4 * lag) ++straight_;
    recent_at_[place] = reading;
    place_ = static_cast<std::uint8_t>((place + 1) % (4 * lag));
  }

  // Those beside are the neighbours where readings far apart are compared: a scatter that ceases is not taken
  // for memory while the two follow it at different paces.
  Level neighbours_, distant_, beside_, apart_;
  Scalar said_ = 0, counted_ = 0, dt_ = 0, last_ = 0, before_ = 0, span_ = 0;
  std::array<Scalar, 4> at_{};  // kept readings, the newest first
  std::int8_t count_ = 0, kept_ = 0;
  std::uint8_t strides_ = 0;
  std::uint8_t recent_ = 0, straight_ = 0;  // readings at equal steps, and since the path bent; at most 16
  std::uint8_t place_ = 0;                  // of the next one in recent_at_
  Scalar on_line_ = 0;                      // part of the second differences that are none
  std::array<Scalar, 16> recent_at_{};
};

}  // namespace taut
