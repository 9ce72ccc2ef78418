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

/// x > 0 of a number, by integers: where software works in double, a comparison costs as much as a product.
template <class Scalar>
bool is_positive(Scalar x) {
  return bits_of(x) > 0;
}

/// The whole part n of -126 <= x <= 0, and 2^n.
template <class Scalar>
struct WholePower {
  Scalar whole, power;
};
template <class Scalar>
WholePower<Scalar> whole_power_of_two(Scalar x) {
  WholePower<Scalar> found;
  BitsOf<Scalar> bits;
  if constexpr (sizeof(Scalar) == sizeof(float)) {
    const int n = static_cast<int>(x);
    found.whole = static_cast<Scalar>(n);
    bits = (n + 127) << 23;
  } else {
    // Compilers cannot turn several doubles at a time into integers. A number this large has no digits behind
    // the point, and those before it are its lowest bits.
    constexpr Scalar large = 6755399441055744;  // 3/2 2^52
    const Scalar nearest = x + large - large;
    found.whole = nearest + (nearest < x ? Scalar(1) : Scalar(0));
    bits = static_cast<std::int64_t>((static_cast<std::uint64_t>(bits_of(found.whole + large)) + 1023) << 52);
  }
  std::memcpy(&found.power, &bits, sizeof bits);
  return found;
}

}  // namespace taut
