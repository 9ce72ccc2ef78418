// The strokes of a row: those of two jacks on one cable count together.
#pragma once

#include <array>
#include <cstddef>

#include "taut/estimation/gauges.hpp"
#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// What was read of the stroke of a jack [m]: by one of the instruments of an Estimator, or else with a
/// standard deviation.
template <class Scalar>
struct StrokeReading {
  Scalar reading = 0;
  Scalar sd = 0;  ///< of a reading without an instrument
  Gauge gauge;
  bool has_gauge = false;
};

/// What two jacks of one cable pull leaves open how they share its elongation, where it differs by all
/// friction between them: as it does while one pulls and the valve of the other one is shut. What both have
/// come out together is not left open. So the stroke of one waits for that of the other one.
///
/// `Cables` is the number of cables that may have two jacks.
template <class Scalar, int Cables>
class RowStrokes {
 public:
  using All = FixedList<StrokeReading<Scalar>, Cables == 0 ? 1 : 2>;

  void begin_row() { waiting_.fill({}); }
  /// A stroke was read at an end. Returns what counts now: this one, with that of the other end if it pulls
  /// too; nothing as long as that has not been read in the same way.
  All take(int cable, std::size_t end, const StrokeReading<Scalar>& read, const std::array<bool, 2>& pulls) {
    All all;
    all.add(read);
    if constexpr (Cables > 0) {
      if (!pulls[1 - end]) return all;
      auto& waiting = waiting_[cable];
      const Waiting other = waiting[1 - end];
      if (other.is_read && other.stroke.has_gauge == read.has_gauge) {
        all.add(other.stroke);
        waiting.fill({});
      } else {
        all.clear();
        waiting[end] = {read, true};
      }
    }
    return all;
  }

 private:
  struct Waiting {
    StrokeReading<Scalar> stroke;
    bool is_read = false;
  };
  FixedArray<std::array<Waiting, 2>, Cables> waiting_;
};

}  // namespace taut
