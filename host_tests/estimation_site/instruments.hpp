// How instruments lie.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/random.hpp"

namespace estimation_site {

/// What a case does to the load cells. Parts are of the full jack force.
struct InstrumentRules {
  double jack_gain_sd = 0, far_gain_sd = 0;  ///< relative
  double zero_sd = 0;                        ///< of both cells, part
  bool sized = false;                        ///< gains are as far off as their sd, up or down
  double noise = 1;                          ///< times what is stated
  double least_sd = 0.001, most_sd = 0.005;  ///< what is stated, part
  double memory = 0;                         ///< of the noise [s]
  bool filtered = false;       ///< both cells by the same low-pass filter, with a tenth of its lag unknown
  double step = 0;             ///< of the display, part
  bool loose_plug = false;     ///< the jack's, for 5 to 15 rows
  bool in_turn = false;        ///< each row has the reading of one end only
  bool drops_out = false;      ///< the jack's is not read for 3 to 20 rows, now and then
  bool far_drops_out = false;  ///< nor the one at the other end, at other times
  double wrong = 0;            ///< so often a reading of either is of anything
  bool is_held = false;        ///< each is read at its own pace, and written again in between
  bool far_freezes = false;    ///< the far cell keeps its value from the first ramp on
  double far_tared = 0;        ///< the zero of the far cell is off by so much more, up or down, part
  double other_clock = 0;      ///< that of the far cell is off by 1 to so many seconds, before or behind [s]
  bool mistyped = false;       ///< one reading of the jack has its point moved, or two digits swapped
  double gauge_gain_sd = 0, gauge_zero_sd = 0;  ///< of gauges on segments and struts: relative, part
  bool gauges_freeze = false;  ///< those of the first joint or segment keep a value of the first ramp
  double gauge_creep = 0;      ///< by so much the zero of the first has gone off at the end, up or down, part
};

/// A low-pass filter of first order; noise in front of it is smoothed, too, and scatters as is stated behind.
struct Filter {
  double lag = 0;  ///< [s]; 0: none
  bool is_behind_noise = false;
};

/// A load cell or gauge, read row by row.
class Cell {
 public:
  Cell(double gain, double zero, double sd, double memory, double step, const Filter& filter = {})
      : gain_(gain), zero_(zero), sd_(sd), memory_(memory), step_(step), filter_(filter) {}

  double read(support::Random& random, double force, double time) {
    const double kept = fading(memory_, time), late = fading(filter_.lag, time);
    noise_ = kept * noise_ + std::sqrt(1 - kept * kept) * sd_ * support::gaussian(random);
    const double before = filter_.is_behind_noise ? std::sqrt((1 + late) / (1 - late)) * noise_ : 0;
    shown_ = late * shown_ + (1 - late) * (force + before);
    time_ = time;
    const double reading = (1 + gain_) * shown_ + zero_ + (filter_.is_behind_noise ? 0 : noise_);
    return step_ > 0 ? step_ * std::round(reading / step_) : reading;
  }

 private:
  /// What is left since the last reading of what fades so fast.
  double fading(double constant, double time) const {
    return constant > 0 ? std::exp(-(time - time_) / constant) : 0;
  }

  double gain_, zero_, sd_, memory_, step_;
  Filter filter_;
  double noise_ = 0, shown_ = 0, time_ = -1e9;
};

/// Puts a wrong value in 5 to 15 rows somewhere between the first tenth and the last.
inline void loosen_plug(support::Random& random, double full, std::vector<double>& readings, int last_row) {
  const int rows = 5 + random.below(11), first = last_row / 10 + random.below(std::max(1, last_row * 8 / 10));
  const double wrong = full * random.between(0, 1.4);
  for (int i = first; i < std::min(first + rows, last_row); ++i)
    readings[static_cast<std::size_t>(i)] = wrong;
}

/// One logger asks one cell after the other: that at the end in even rows, that at the start in odd ones.
inline void read_in_turn(std::vector<double>& end, std::vector<double>& start) {
  for (std::size_t i = 0; i < end.size(); ++i) (i % 2 == 0 ? start : end)[i] = std::nan("");
}

/// Now and then, once in 60 rows, nothing is read for 3 to 20 rows.
inline void drop_out(support::Random& random, std::vector<double>& readings) {
  for (std::size_t i = 10 + std::size_t(random.below(100)); i < readings.size();) {
    const std::size_t end = std::min(readings.size(), i + 3 + std::size_t(random.below(18)));
    for (; i < end; ++i) readings[i] = std::nan("");
    i += 20 + std::size_t(random.below(80));
  }
}

/// Some readings are of anything.
inline void misread(support::Random& random, double part, double full, std::vector<double>& readings) {
  for (double& reading : readings)
    if (random.between(0, 1) < part) reading = full * random.between(0, 1.5);
}

/// What a reading becomes whose first two digits are swapped.
inline double with_digits_swapped(double reading) {
  const double unit = std::pow(10, std::floor(std::log10(std::fabs(reading))) - 1);
  const int digits = static_cast<int>(std::fabs(reading) / unit), swapped = digits % 10 * 10 + digits / 10;
  return reading + std::copysign((swapped - digits) * unit, reading);
}
/// One reading from the third row to the last free one is copied wrongly.
inline void mistype(support::Random& random, std::vector<double>& readings, int last_row) {
  double& reading = readings[static_cast<std::size_t>(2 + random.below(std::max(1, last_row - 1)))];
  const int way = random.below(3);
  reading = way == 0 ? 10 * reading : way == 1 ? reading / 10 : with_digits_swapped(reading);
}

/// A cell is read at an even pace of its own, once in 0.3 to 3 s and in two rows at most; rows in between
/// have its last value.
inline void hold(support::Random& random, const std::vector<double>& times, std::vector<double>& readings) {
  const double row = (times.back() - times.front()) / double(times.size() - 1),
               pace = std::max(0.3 * std::pow(10, random.between(0, 1)), 2 * row);
  double next = times.front() + pace;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (times[i] < next) readings[i] = readings[i - 1];
    while (times[i] >= next) next += pace;
  }
}

/// From a row on the value of that row is shown.
inline void freeze(std::vector<double>& readings, int from) {
  for (std::size_t i = static_cast<std::size_t>(from) + 1; i < readings.size(); ++i)
    readings[i] = readings[static_cast<std::size_t>(from)];
}

}  // namespace estimation_site
