// y += a x, by Eigen: several entries at a time where the processor can.
#pragma once

#include <Eigen/Core>

namespace taut {

/// Whether the processor works on several numbers at a time, as far as Eigen knows.
#ifdef EIGEN_VECTORIZE
constexpr bool takes_several = true;
#else
constexpr bool takes_several = false;
#endif

/// y += a x for the first n entries, which must not overlap. Every entry is one product and one sum: the same
/// bits on every machine, however many are taken at a time.
template <class Scalar>
void axpy(int n, Scalar a, const Scalar* x, Scalar* y) {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  Eigen::Map<Vector>(y, n) += a * Eigen::Map<const Vector>(x, n);
}

}  // namespace taut
