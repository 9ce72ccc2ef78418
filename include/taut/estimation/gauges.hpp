// Instruments whose readings are handed in one by one: what is unknown of them, and which readings count.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "taut/estimation/instruments.hpp"
#include "taut/estimation/lagging_reading.hpp"
#include "taut/estimation/noise_level.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/load_cell.hpp"

namespace taut {

/// Number of an instrument in the list that Estimator::start() was given.
struct Gauge {
  int number = 0;
};

/// A zero_sd for instruments that are read from any mark.
template <class Scalar>
constexpr Scalar free_zero = std::numeric_limits<Scalar>::infinity();

/// The stroke of a jack as a measurement: how well it is known, in metres, and where it is read. An
/// aggregate, it can be a constant in flash; a range of them is one of instruments for Estimator::start().
template <class Scalar>
struct StrokeGauge : LoadCell<Scalar> {
  int cable = 0;
  int end = 0;  ///< as in Readings::ends

  template <class Other>
  static constexpr StrokeGauge of(const StrokeGauge<Other>& other) {
    return {LoadCell<Scalar>::of(other), other.cable, other.end};
  }
};

/// Measured segment forces, strain gauges of struts and strokes: a reading of what should be y is
///     reading = (1 + gain) y + zero + noise,
/// with gain and zero unknown constants. A LoadCell says how well they are known, for a stroke in metres; its
/// hysteresis has no meaning. The errors of a model do not average out from row to row: a reading counts only
/// if the best estimate of the jacks' loads is elsewhere, by `part` of the largest, than at the last one that
/// did. Not if the model has been driven on: that follows the noise of a load cell, and those readings are a
/// choice of rows that read high on the way up, and low on the way down.
template <class Scalar, int Capacity, bool Lags = true>
class Gauges {
 public:
  static constexpr Scalar part = Scalar(1) / 256;
  /// A zero that is free is as unknown as so many standard deviations of the first reading.
  static constexpr Scalar very_unknown = 10;

  /// All that is known between two rows.
  struct State {
    struct One {
      NoiseLevel<Scalar> noise;
      Scalar since = 0;  ///< time since its last reading [s]
      Scalar mark = 0;   ///< what is taken off a reading
      Scalar taken = 0;  ///< `best` at the last reading that counted [N]
      bool is_marked = false, is_taken = false;
    };
    Scalar largest = 0;  ///< sum of all loads so far [N]
    Scalar best = 0;     ///< that of the best estimates of the loads [N]
    FixedArray<One, Capacity> one;
    FixedArray<LaggingReading<Scalar>, Lags ? Capacity : 0> lagging;
  };

  /// Takes the instruments over, and numbers their unknowns by add(standard deviation). Returns how many
  /// instruments or unknowns found no room.
  template <class Cells, class Add>
  int start(const Cells& cells, const Add& add) {
    state_ = {};
    cells_.clear();
    int missing = 0;
    for (const LoadCell<Scalar>& cell : cells) {
      const int g = cells_.add(cell);
      if (g < 0) {
        ++missing;
        continue;
      }
      if (!Lags && cell.lag > 0) ++missing;
      LoadCell<Scalar> constants = cell;
      constants.hysteresis_sd = 0;
      if (is_free(g)) constants.zero_sd = 0;
      missing += unknowns_[g].add(constants, add);
      if (!is_free(g)) continue;
      const int zero = add(Scalar(0));
      if (zero < 0) ++missing;
      unknowns_[g].zero = static_cast<std::int16_t>(zero);
    }
    for (int g = 0; g < size(); ++g) state_.one[g].noise.start(cells_[g].noise());
    return missing;
  }
  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }

  int size() const { return cells_.size(); }
  bool has(Gauge gauge) const { return gauge.number >= 0 && gauge.number < size(); }
  const InstrumentUnknowns& unknowns(Gauge gauge) const { return unknowns_[gauge.number]; }
  /// Standard deviation of the noise of a reading, found from readings; never less than was given.
  Scalar sd(Gauge gauge) const { return state_.one[gauge.number].noise.sd(); }
  /// What is taken off a reading before anything else.
  Scalar mark(Gauge gauge) const { return state_.one[gauge.number].mark; }
  /// Whether its zero is free and nothing has been read from it yet.
  bool lacks_mark(Gauge gauge) const { return is_free(gauge.number) && !state_.one[gauge.number].is_marked; }
  void set_mark(Gauge gauge, Scalar mark) {
    state_.one[gauge.number].mark = mark;
    state_.one[gauge.number].is_marked = true;
  }

  /// A row `dt` [s] after the one before: the sum of the loads that the model was driven to, and that of
  /// their best estimates [N].
  void begin_row(Scalar load, Scalar best, Scalar dt) {
    state_.best = best;
    state_.largest = larger(state_.largest, load);
    for (int g = 0; g < size(); ++g) state_.one[g].since += dt;
    for (int g = 0; Lags && g < size(); ++g) state_.lagging[g].wait(dt);
  }
  /// A reading becomes what stood in front of the filter of its instrument, if that has one. False if it
  /// comes too soon after the one before to count.
  bool undo_lag(Gauge gauge, Scalar& reading) {
    if constexpr (Lags) {
      const Scalar lag = cells_[gauge.number].lag;
      if (lag > 0) return state_.lagging[gauge.number].undo(lag, reading);
    }
    return true;
  }
  /// What was read from a mark may be read from another one from now on.
  void forget_marks() {
    for (int g = 0; g < size(); ++g) state_.one[g].is_marked = state_.one[g].is_taken = false;
  }
  /// The load of a jack has left the line that it was on.
  void bend() {
    for (int g = 0; g < size(); ++g) state_.one[g].noise.bend();
  }
  /// A reading tells how much readings scatter.
  void follow_noise(Gauge gauge, Scalar reading) {
    auto& one = state_.one[gauge.number];
    one.noise.take(reading, one.since);
    one.since = 0;
  }
  /// Whether the next reading counts.
  bool is_due(Gauge gauge) const {
    const auto& one = state_.one[gauge.number];
    return !one.is_taken || std::fabs(state_.best - one.taken) >= part * state_.largest;
  }
  void count(Gauge gauge) {
    state_.one[gauge.number].taken = state_.best;
    state_.one[gauge.number].is_taken = true;
  }
  /// Completes what is predicted of y by the gain of an instrument, and by its zero.
  template <class PredictionType>
  void depend_on_gain(Gauge gauge, PredictionType& prediction) const {
    const int gain = unknowns(gauge).gain;
    if (gain >= 0) prediction.H[gain] = prediction.value;
  }
  template <class PredictionType>
  void depend_on_zero(Gauge gauge, PredictionType& prediction) const {
    taut::depend_on_zero(unknowns(gauge).zero, prediction);
  }

 private:
  /// All zeros until there is one.
  struct Taken : LoadCell<Scalar> {
    constexpr Taken() : LoadCell<Scalar>{0, 0, 0, 0, 0, 0} {}
    constexpr Taken(const LoadCell<Scalar>& cell) : LoadCell<Scalar>(cell) {}
  };

  bool is_free(int g) const { return cells_[g].zero_sd > (std::numeric_limits<Scalar>::max)(); }

  FixedList<Taken, Capacity> cells_;
  FixedArray<InstrumentUnknowns, Capacity> unknowns_;
  State state_;
};

}  // namespace taut
