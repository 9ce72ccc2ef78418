// A load cell, or the pressure gauge of a jack: how its reading comes about, and how well that is known.
#pragma once

namespace taut {

/// What is known beforehand of an instrument that reads a force F:
///     reading = (1 + gain) branch F + zero + noise,
/// where `branch` is `up` while the jack pulls and `down` while it is let out, each give or take
/// `hysteresis` up and down. Between the two, after a turn, F rests until the reading has come that far: the
/// friction of a ram. Gain, zero and hysteresis are unknown constants with these standard deviations; what
/// is zero is no unknown and costs nothing. Behind a low-pass filter it comes late, see LaggingReading. An
/// aggregate, it can be a constant in flash.
template <class Scalar>
struct LoadCell {
  Scalar sd = 0;             ///< of the noise of a reading [N], with quantisation; 0: not given
  Scalar gain_sd = 0;        ///< of the calibration [-]
  Scalar zero_sd = 0;        ///< of the zero [N]
  Scalar hysteresis_sd = 0;  ///< of half the width between the branches [-]
  Scalar up = 1, down = 1;   ///< reading by force on both branches [-]
  Scalar lag = 0;            ///< time constant of a filter [s]; 0: none, as of a jack's with sd 0

  template <class Other>
  static constexpr LoadCell of(const LoadCell<Other>& other) {
    return {static_cast<Scalar>(other.sd),      static_cast<Scalar>(other.gain_sd),
            static_cast<Scalar>(other.zero_sd), static_cast<Scalar>(other.hysteresis_sd),
            static_cast<Scalar>(other.up),      static_cast<Scalar>(other.down),
            static_cast<Scalar>(other.lag)};
  }
  /// Standard deviation of the noise of what LaggingReading makes of readings, at least: so much of it stands
  /// in front of the filter where readings scatter by `sd`.
  constexpr Scalar noise() const { return lag > 0 ? Scalar(2.83) * sd : sd; }
  constexpr bool has_branches() const { return up != 1 || down != 1 || hysteresis_sd > 0; }
  /// Unknown constants of it: gain, zero, hysteresis.
  constexpr int unknowns() const {
    return (gain_sd > 0 ? 1 : 0) + (zero_sd > 0 ? 1 : 0) + (hysteresis_sd > 0 ? 1 : 0);
  }
  friend constexpr bool operator==(const LoadCell& a, const LoadCell& b) {
    return a.sd == b.sd && a.gain_sd == b.gain_sd && a.zero_sd == b.zero_sd &&
           a.hysteresis_sd == b.hysteresis_sd && a.up == b.up && a.down == b.down && a.lag == b.lag;
  }
};

}  // namespace taut
