// Readings that come late: what stood in front of the filter of an amplifier, or of a display that averages.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "taut/estimation/readings.hpp"
#include "taut/numerics/decay.hpp"

namespace taut {

/// An instrument behind a low-pass filter of first order with the time constant `lag`: its reading y of what
/// is F follows lag dy/dt = F - y, Eq. (72). A plain value.
///
/// Readings y_a, y_b that are a time t apart have weighed F between them to the mean (y_b - a y_a) / (1 - a)
/// with a = exp(-t / lag), whatever way it went, Eq. (73). That is taken for F: it never goes beyond where F
/// was, which friction would keep, and in a ramp it is that of lag - t a / (1 - a) before, an eighth of a lag
/// at a `stride`, and never more than one.
///
/// Noise that is added behind the filter grows by lag / t, and noise in front of it averages out over t: of
/// readings that come close only those count that are a `stride` of lags apart. There, what is made of
/// readings that scatter by sd scatters by sqrt((1 + a) / (1 - a)) = 2.83 sd if all noise is in front of the
/// filter, LoadCell::noise(), and by twice that if all of it is behind: more is found from the readings.
template <class Scalar>
class LaggingReading {
 public:
  static constexpr Scalar stride = Scalar(0.25);

  /// Time goes on [s].
  void wait(Scalar dt) {
    since_ += dt;
    is_taken_ = is_taken_ && !(dt > 0);
  }
  /// A finite reading becomes what stood in front of the filter. False if it comes too soon to count. The
  /// first one stays as it is, and again in the same row gives the same. Cost: that of decay().
  bool undo(Scalar lag, Scalar& reading) {
    if (!is_taken_) take(lag, reading);
    reading = force_;
    return counts_;
  }
  /// How long ago the force in a ramp was what was made of the last reading that counted [s].
  Scalar late() const { return late_; }

 private:
  /// Of a stride: where rows are one apart, times that do not add up to it must not make it two.
  static constexpr Scalar nearly = Scalar(0.9);

  void take(Scalar lag, Scalar reading) {
    is_taken_ = true;
    counts_ = !has_last_ || since_ >= nearly * stride * lag;
    if (!counts_) return;
    const Scalar a = has_last_ ? decay(since_ / lag) : Scalar(0);
    force_ = reading + a / (1 - a) * (reading - last_);
    late_ = has_last_ ? lag - since_ * a / (1 - a) : Scalar(0);
    last_ = reading;
    since_ = 0;
    has_last_ = true;
  }

  Scalar since_ = 0;  // the last reading that counted [s]
  Scalar last_ = 0, force_ = 0, late_ = 0;
  bool has_last_ = false, is_taken_ = false, counts_ = false;
};

/// The load cells of all ends.
template <class Scalar, class Cap>
class LaggingCells {
 public:
  /// Replaces the readings of a row of those `cells` that lag, but what is no number or more than `most` of a
  /// cable, which is no reading. Cost: that of LaggingReading::undo() for each.
  template <class Cells, class Most>
  void undo(const Cells& cells, const Most& most, Readings<Scalar, Cap>& readings) {
    for (int c = 0; c < cells_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        auto& given = readings.ends[c][end];
        if (!(cells[c][end].lag > 0)) continue;
        cells_[c][end].wait(readings.dt);
        if (given.has_force && std::fabs(given.force) <= most[c])
          given.has_force = cells_[c][end].undo(cells[c][end].lag, given.force);
      }
  }

  /// LaggingReading::late() of the load cell at an end; zero where it has no lag.
  Scalar late(int cable, std::size_t end) const { return cells_[cable][end].late(); }

 private:
  FixedArray<std::array<LaggingReading<Scalar>, 2>, Cap::lags ? Cap::cables : 0> cells_;
};

}  // namespace taut
