// How condensed numbers follow the level of second-order theory.
#pragma once

namespace taut {

/// What the rise and the bow of a number count for at a level: Eq. (48).
template <class Real>
struct LevelWeights {
  Real rise = 0;
  Real bow = 0;

  constexpr Real of(Real rise_of, Real bow_of) const { return rise * rise_of + bow * bow_of; }
};

/// The way of a condensed number from the low level to the high one, Eq. (48): low + s rise + s (1 - s) bow,
/// where s goes from 0 to 1. What geometry alone holds goes with 1/tau, what is mostly elastic hardly bends:
/// k says which, and the bow is what is left over at the middle level.
template <class Real>
struct LevelCurve {
  /// The lowest is above zero: without tension nothing may hold a pinned strut.
  static constexpr Real low = Real(1) / 96, middle = Real(1) / 2, high = 1;
  Real k = 0;  ///< 0 is a straight line

  /// s: how far numbers have come. Below the low level they stay.
  constexpr Real part(Real level) const {
    const Real at = level > low ? level : low;
    return (at - low) / (high - low) * (1 + k * high) / (1 + k * at);
  }
  constexpr LevelWeights<Real> weights(Real level) const {
    const Real s = part(level);
    return {s, s * (1 - s)};
  }
  /// Their derivatives with respect to the level.
  constexpr LevelWeights<Real> slopes(Real level) const {
    const Real by = 1 + k * level;
    const Real slope = (1 + k * high) * (1 + k * low) / ((high - low) * by * by);
    return {slope, slope * (1 - 2 * part(level))};
  }
  /// Makes of the numbers at the middle and at the high level the bow and the rise.
  constexpr void split(Real at_low, Real& at_middle, Real& at_high) const {
    const Real s = part(middle);
    at_high -= at_low;
    at_middle = (at_middle - at_low - s * at_high) / (s * (1 - s));
  }
};

/// Finds the curve of numbers that go together, by least squares of what their bows would be.
template <class Real>
class LevelCurveFit {
 public:
  void add(Real at_low, Real at_middle, Real at_high) {
    const Real rise = at_high - at_low;
    along_ += rise * (at_middle - at_low);
    all_ += rise * rise;
  }
  LevelCurve<Real> found() const {
    using Curve = LevelCurve<Real>;
    if (!(all_ > 0)) return {};
    // From s at the middle level.
    const Real steeper = along_ / all_ * (Curve::high - Curve::low) / (Curve::middle - Curve::low);
    const Real left = Curve::high - steeper * Curve::middle;
    return steeper > 1 && left > 0 ? Curve{(steeper - 1) / left} : Curve{};
  }

 private:
  Real along_ = 0, all_ = 0;
};

}  // namespace taut
