// exp(-x) with the same bits on every machine: a C library may round it as it likes.
#pragma once

namespace taut {

/// exp(-x) for x >= 0, relative to itself off by some 10 x epsilon at most, and a few epsilon where x < 1:
/// halved until the series is short, then squared as often, which doubles the error each time. Zero beyond
/// 60.
template <class Real>
constexpr Real decay(Real x) {
  if (!(x < Real(60))) return 0;
  int halvings = 0;
  for (; x > Real(0.125) && halvings < 16; ++halvings) x /= 2;
  Real sum = 1;
  for (int n = 12; n > 0; --n) sum = Real(1) - x / static_cast<Real>(n) * sum;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

}  // namespace taut
