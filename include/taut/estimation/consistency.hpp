// Whether the readings of an instrument go on being what is expected of them.
#pragma once

#include <cmath>
#include <cstdint>

namespace taut {

/// The innovations of an instrument, its readings less what was expected of them, over about the last thirty
/// readings. Each scatters by itself, for its noise, and with the others, for what is not known of the model;
/// in the mean the former averages out. A mean beyond `most` standard deviations says that model and
/// instrument do not fit, Eq. (37). A plain value. Cost: a few operations a reading.
template <class Scalar>
class Consistency {
 public:
  /// Where a single reading is refused at five.
  static constexpr Scalar most = Scalar(4.5);

  /// An innovation, the variance that the model gives it, and that of noise.
  void take(Scalar innovation, Scalar of_model, Scalar of_noise) {
    if (count_ < window) ++count_;
    const Scalar w = 1 / static_cast<Scalar>(count_);
    mean_ += w * (innovation - mean_);
    of_model_ += w * (of_model - of_model_);
    of_noise_ = (1 - w) * (1 - w) * of_noise_ + w * w * of_noise;
  }
  /// By how much readings are off what is expected of them, where it is more than chance allows; else zero.
  Scalar misfit() const {
    const bool fits = count_ < fewest || mean_ * mean_ <= most * most * (of_model_ + of_noise_);
    return fits ? Scalar(0) : std::fabs(mean_);
  }

 private:
  static constexpr std::int8_t window = 16, fewest = 8;

  Scalar mean_ = 0, of_model_ = 0, of_noise_ = 0;  // with the two parts of its variance
  std::int8_t count_ = 0;
};

}  // namespace taut
