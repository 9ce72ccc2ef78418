// y += a x, in loops that a compiler can take several entries at a time.
#pragma once

namespace taut {

/// Whether the processor works on several numbers at a time.
#if defined(__SSE2__) || defined(__ARM_NEON)
constexpr bool takes_several = true;
#else
constexpr bool takes_several = false;
#endif

/// y += a x for the first n entries, which must not overlap. Every entry is one product and one sum: the same
/// bits on every machine, however many are taken at a time.
template <class Scalar, class Other>
void axpy(int n, Scalar a, const Other* __restrict x, Scalar* __restrict y) {
  for (int i = 0; i < n; ++i) y[i] += a * static_cast<Scalar>(x[i]);
}

}  // namespace taut
