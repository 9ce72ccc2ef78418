// The larger of two numbers, without a call into the C library.
#pragma once

#include <cmath>

namespace taut {

/// std::fmax but for NaN: compilers make one instruction of it.
template <class Scalar>
constexpr Scalar larger(Scalar a, Scalar b) {
  return a < b ? b : a;
}

/// The larger of `most` and the magnitudes of the first n entries. One function for all who ask: each would
/// have a loop of its own.
template <class Scalar>
[[gnu::noinline]] Scalar largest(int n, const Scalar* entries, Scalar most = 0) {
  for (int i = 0; i < n; ++i) most = larger(most, std::fabs(entries[i]));
  return most;
}

}  // namespace taut
