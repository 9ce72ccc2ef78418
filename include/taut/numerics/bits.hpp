// Numbers as their bits: whether any of many is negative, without a comparison at each; powers of two.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace taut {

/// An integer as wide as a float or double.
template <class Scalar>
using BitsOf = std::conditional_t<sizeof(Scalar) == sizeof(std::int64_t), std::int64_t, std::int32_t>;

/// The bits of a number: negative as an integer if the sign bit is set. Those of many numbers, or-ed
/// together, are negative if one of them is; compilers take several at a time, which they may not do with
/// comparisons.
template <class Scalar>
BitsOf<Scalar> bits_of(Scalar x) {
  static_assert(sizeof(Scalar) == sizeof(BitsOf<Scalar>), "float or double");
  BitsOf<Scalar> bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

/// 2^n, -126 <= n <= 127.
template <class Scalar>
Scalar power_of_two(int n) {
  constexpr bool single = sizeof(Scalar) == sizeof(float);
  const BitsOf<Scalar> bits = static_cast<BitsOf<Scalar>>(n + (single ? 127 : 1023)) << (single ? 23 : 52);
  Scalar power;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}

}  // namespace taut
