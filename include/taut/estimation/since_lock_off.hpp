// Whether the far end of a cable that wedges hold stays what it was when they were set.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/estimation/consistency.hpp"
#include "taut/estimation/lone_outliers.hpp"

namespace taut {

/// Readings of the cell at the far end of a locked cable, against the first four of them. Friction, and the
/// gains and zeros of cells, are in all of them alike: how little is known of these hides nothing, as it does
/// where a reading is compared with the force that the jack's load leaves there. What is left is what strains
/// the cable and is in no column of the log, Eq. (78). A plain value. Cost: a few operations a reading.
template <class Scalar>
class SinceLockOff {
 public:
  bool has_begun() const { return count_ > 0; }
  /// What the jack's own cell reads [N] in a row, with its standard deviation: before take(). A wedge is
  /// drawn in while the jack lets go: as long as that goes on, it begins anew.
  void follow_jack(Scalar reading, Scalar sd) {
    if (is_jack_read_ && !(reading < lowest_ - LoneOutliers<Scalar>::outlier * sd)) return;
    if (is_jack_read_) *this = SinceLockOff();
    is_jack_read_ = true;
    lowest_ = reading;
  }
  /// Before take(): the model has learned that the force is more by `change` [N], and was all along.
  void correct(Scalar change) { force_ += change; }
  /// A reading [N] of what should be `force`, which scatters by `sd` and is off by `lasts` together with
  /// those about it [N]. What loads have changed the force by since is known to no better than that change.
  void take(Scalar reading, Scalar force, Scalar sd, Scalar lasts) {
    constexpr Scalar far = LoneOutliers<Scalar>::outlier;
    if (count_ < first) {
      // What jumps is not at rest yet.
      if (std::fabs(reading - reading_) > far * (sd + lasts)) count_ = 0;
      ++count_;
      reading_ = count_ == 1 ? reading : reading_ + (reading - reading_) / static_cast<Scalar>(count_);
      force_ = force;
      return;
    }
    const Scalar changed = force - force_, of_noise = sd * sd,
                 of_model = of_noise / static_cast<Scalar>(first) + 2 * lasts * lasts + changed * changed;
    fit_.take(outliers_.confirmed(reading - reading_ - changed, std::sqrt(of_model + of_noise)), of_model,
              of_noise);
  }
  /// By how much readings are off the first of them, where it is more than chance allows [N]; else zero.
  Scalar misfit() const { return fit_.misfit(); }

 private:
  static constexpr std::int8_t first = 4;

  Scalar reading_ = 0, force_ = 0;  // the mean of the first readings, and the force that the model had
  Scalar lowest_ = 0;               // of the jack
  LoneOutliers<Scalar> outliers_;
  Consistency<Scalar> fit_;
  std::int8_t count_ = 0;  // of the first readings
  bool is_jack_read_ = false;
};

}  // namespace taut
