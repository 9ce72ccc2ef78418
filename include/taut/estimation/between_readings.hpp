// A far end that is read between two readings of its jack, as by a logger that reads its channels in turn.
#pragma once

namespace taut {

/// The reading of a load cell in a row in which the jack of its cable is not read: what the load was by then
/// shows with the next reading of the jack. A plain value. Cost: a few operations a row.
template <class Scalar>
class BetweenReadings {
 public:
  bool waits() const { return waits_; }
  /// It waits: `load` is that of the jack where it was read last [N], `since` then [s].
  void wait(Scalar reading, Scalar load, Scalar since) {
    reading_ = reading;
    load_ = load;
    before_ = since;
    after_ = 0;
    waits_ = true;
  }
  /// A row later, after `dt` [s].
  void go_on(Scalar dt) { after_ += dt; }
  void drop() { waits_ = false; }
  /// The jack has come to `load` [N] evenly: what the cell would read by now, where it follows that with
  /// `slope`, Eq. (71).
  Scalar taken_on(Scalar slope, Scalar load) const {
    return reading_ + slope * (load - load_) * after_ / (before_ + after_);
  }

 private:
  Scalar reading_ = 0, load_ = 0;  // [N]
  Scalar before_ = 0, after_ = 0;  // from a reading of the jack to it, and since then [s]
  bool waits_ = false;
};

}  // namespace taut
