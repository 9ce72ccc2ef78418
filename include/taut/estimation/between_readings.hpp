// A far end that is read between two readings of its jack, as by a logger that reads its channels in turn.
#pragma once

namespace taut {

/// The reading of a load cell in a row in which the jack of its cable is not read: what the load was by then
/// shows with the next reading of the jack. A plain value.
template <class Scalar>
class BetweenReadings {
 public:
  bool waits() const { return waits_; }
  /// It waits: `load` is that of the jack where it was read last [N], `since` then [s].
  void wait(Scalar reading, Scalar load, Scalar since) {
    reading_ = reading;
    load_ = load;
    since_ = since;
    waits_ = true;
  }
  void drop() { waits_ = false; }
  /// The jack has come to `load` [N] evenly, in `step` from one of its readings to the next [s]: what the
  /// cell would read by now, where it follows that with `slope`, Eq. (71).
  Scalar taken_on(Scalar slope, Scalar load, Scalar step) const {
    return reading_ + slope * (load - load_) * (step - since_) / step;
  }

 private:
  Scalar reading_ = 0, load_ = 0;  // [N]
  Scalar since_ = 0;               // from a reading of the jack to it [s]
  bool waits_ = false;
};

}  // namespace taut
