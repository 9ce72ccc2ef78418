// The larger of two numbers, without a call into the C library.
#pragma once

namespace taut {

/// std::fmax but for NaN: compilers make one instruction of it.
template <class Scalar>
constexpr Scalar larger(Scalar a, Scalar b) {
  return a < b ? b : a;
}

}  // namespace taut
