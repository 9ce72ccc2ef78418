// Readings that come late: what stood in front of the filter of an amplifier, or of a display that averages.
#pragma once

#include <array>
#include <cstddef>

#include "taut/estimation/readings.hpp"
#include "taut/numerics/decay.hpp"

namespace taut {

/// An instrument behind a low-pass filter of first order with the time constant `lag`: its reading y of what
/// is F follows lag dy/dt = F - y, Eqs. (72) and (73). A plain value.
///
/// Readings y_a, y_b that are a time t apart have weighed F to the mean (y_b - a y_a) / (1 - a) with
/// a = exp(-t / lag), whatever way it went. On a straight line F was that so long before the second reading:
/// `late` = lag - t a / (1 - a), and has gone on since. That counts while readings come closer than
/// `straight` lags; farther apart, as in load stages, they are taken for those of a load that rests.
///
/// Noise that is added behind the filter grows by lag / t, and noise in front of it averages out over t: of
/// readings that come close only those count that are `stride` lags apart. There, what is made of readings
/// that scatter by sd scatters by sqrt((1 + a) / (1 - a)) = 2.83 sd if all noise is in front of the filter,
/// LoadCell::noise(), and by two to three times that if all of it is behind: more is found from the readings.
template <class Scalar>
class LaggingReading {
 public:
  static constexpr Scalar stride = Scalar(0.25), straight = 2;

  /// Time goes on [s].
  void wait(Scalar dt) {
    since_ += dt;
    is_taken_ = is_taken_ && !(dt > 0);
  }
  /// A reading becomes what stood in front of the filter. False if it comes too soon to count. The first one
  /// stays as it is, and again in the same row gives the same. Cost: that of decay().
  bool undo(Scalar lag, Scalar& reading) {
    if (!is_taken_) take(lag, reading);
    reading = force_;
    return counts_;
  }

 private:
  void take(Scalar lag, Scalar reading) {
    is_taken_ = true;
    counts_ = !has_last_ || since_ >= stride * lag;
    if (!counts_) return;
    const Scalar t = since_, a = decay(t / lag), ahead = has_last_ ? a / (1 - a) : Scalar(0);
    const Scalar mean = reading + ahead * (reading - last_),
                 late = has_last_ && t <= straight * lag ? lag - t * ahead : Scalar(0);
    force_ = late > 0 ? mean + (mean - mean_) * late / (t - late + late_) : mean;
    last_ = reading;
    mean_ = mean;
    late_ = late;
    since_ = 0;
    has_last_ = true;
  }

  Scalar since_ = 0;  // the last reading that counted [s]
  Scalar last_ = 0;   // that one
  Scalar mean_ = 0, late_ = 0;
  Scalar force_ = 0;
  bool has_last_ = false, is_taken_ = false, counts_ = false;
};

/// The load cells of all ends.
template <class Scalar, class Cap>
class LaggingCells {
 public:
  /// Replaces the readings of a row of those `cells` that lag. Cost: that of LaggingReading::undo() for each.
  template <class Cells>
  void undo(const Cells& cells, Readings<Scalar, Cap>& readings) {
    for (int c = 0; c < cells_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        auto& given = readings.ends[c][end];
        if (!(cells[c][end].lag > 0)) continue;
        cells_[c][end].wait(readings.dt);
        if (given.has_force) given.has_force = cells_[c][end].undo(cells[c][end].lag, given.force);
      }
  }

 private:
  FixedArray<std::array<LaggingReading<Scalar>, 2>, Cap::lags ? Cap::cables : 0> cells_;
};

}  // namespace taut
