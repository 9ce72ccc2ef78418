// A jack whose load cell is read row by row, without a cable.
#pragma once

#include "taut/estimation/jack_load.hpp"

namespace estimation {

/// A jack that is read row by row.
class Read {
 public:
  static constexpr double most = 1e7;  ///< that the cable can carry [N]

  explicit Read(double sd) {
    cell_.sd = sd;
    jack_.start(cell_);
  }
  /// Whether the row tells an outlier; `is_seen`: another cell has seen the load go there.
  bool tells(double reading, double dt = 1, bool is_seen = false) {
    taut::EndReading<double> given;
    given.has_force = true;
    given.force = reading;
    taut::Corners<double> corners;
    return jack_.take(false, given, dt, cell_, most, {}, corners, [is_seen] { return is_seen; });
  }
  bool tells_nothing() {
    taut::Corners<double> corners;
    return jack_.take(false, {}, 1, cell_, most, {}, corners);
  }
  /// Locks the end; whether that is known to have been after a turn.
  bool locks_after_turn(double dt) {
    taut::Corners<double> corners;
    static_cast<void>(jack_.take(true, {}, dt, cell_, most, {}, corners));
    return corners.locks && corners.reverses && jack_.has_reversed();
  }
  const taut::ConditionedLoad<double>& at() const { return jack_.at; }
  /// Where friction follows it [N].
  double followed() const { return jack_.target(); }
  double lock_sd() const { return jack_.lock_sd; }
  bool refused() const { return jack_.at.refused; }
  double load() const { return jack_.at.load; }
  double sd() const { return jack_.at.sd; }
  /// Where it turned; zero if it did not in this row.
  double reversal() const { return jack_.at.reversed ? jack_.at.reversal : 0; }
  bool has_turned() const { return !jack_.rises; }
  double back() const { return jack_.back(jack_.at.load); }

 private:
  taut::LoadCell<double> cell_;
  taut::JackLoad<double, 2> jack_;
};

}  // namespace estimation
