// Readings that are all off by the same: what one more of them is worth.
#pragma once

namespace taut {

/// A reading with noise of variance `noise`, and off by an error of variance `lasting` that all readings of
/// its kind have in common: the variance with which it counts, as if its error were its own, so that n of
/// them leave no less of what is predicted, known to the variance `predicted`, than lasting + noise / n,
/// Eq. (63). Zero if it tells nothing more. Cost: a few operations.
template <class Scalar>
constexpr Scalar counted_variance(Scalar predicted, Scalar noise, Scalar lasting) {
  // Of what is predicted, what readings may still tell.
  constexpr Scalar least = Scalar(1e-3);
  if (!(lasting > 0)) return noise;
  const Scalar open = predicted - lasting;
  if (!(open > least * predicted)) return 0;
  // No product of three variances: it overflows in single precision.
  return predicted / open * (lasting / open * (open + noise) + noise);
}

}  // namespace taut
