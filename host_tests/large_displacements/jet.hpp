// A number with its first and second derivatives by N variables.
#pragma once

#include <array>
#include <cmath>

namespace large_displacements {

template <int N>
struct Jet {
  static constexpr int entries = N * (N + 1) / 2;
  double value = 0;
  std::array<double, N> first{};
  std::array<double, entries> second{};  ///< lower triangle, row by row

  Jet() = default;
  Jet(double constant) : value(constant) {}
  static Jet variable(double at, int i) {
    Jet jet(at);
    jet.first[i] = 1;
    return jet;
  }

  Jet& operator+=(const Jet& b) {
    value += b.value;
    for (int i = 0; i < N; ++i) first[i] += b.first[i];
    for (int k = 0; k < entries; ++k) second[k] += b.second[k];
    return *this;
  }
  Jet& operator*=(double b) {
    value *= b;
    for (int i = 0; i < N; ++i) first[i] *= b;
    for (int k = 0; k < entries; ++k) second[k] *= b;
    return *this;
  }
};

template <int N>
Jet<N> operator+(Jet<N> a, const Jet<N>& b) {
  return a += b;
}
template <int N>
Jet<N> operator*(Jet<N> a, double b) {
  return a *= b;
}
template <int N>
Jet<N> operator-(Jet<N> a, const Jet<N>& b) {
  a.value -= b.value;
  for (int i = 0; i < N; ++i) a.first[i] -= b.first[i];
  for (int k = 0; k < Jet<N>::entries; ++k) a.second[k] -= b.second[k];
  return a;
}
template <int N>
Jet<N> operator*(const Jet<N>& a, const Jet<N>& b) {
  Jet<N> c(a.value * b.value);
  for (int i = 0; i < N; ++i) c.first[i] = a.first[i] * b.value + a.value * b.first[i];
  for (int i = 0, k = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++k)
      c.second[k] =
          a.second[k] * b.value + a.value * b.second[k] + a.first[i] * b.first[j] + a.first[j] * b.first[i];
  return c;
}

/// f(a), given f, f' and f'' at a.
template <int N>
Jet<N> chain(const Jet<N>& a, double f, double f1, double f2) {
  Jet<N> c(f);
  for (int i = 0; i < N; ++i) c.first[i] = f1 * a.first[i];
  for (int i = 0, k = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++k) c.second[k] = f1 * a.second[k] + f2 * a.first[i] * a.first[j];
  return c;
}
template <int N>
Jet<N> sqrt(const Jet<N>& a) {
  const double root = std::sqrt(a.value);
  return chain(a, root, 0.5 / root, -0.25 / (root * a.value));
}
template <int N>
Jet<N> inverse(const Jet<N>& a) {
  const double inv = 1 / a.value;
  return chain(a, inv, -inv * inv, 2 * inv * inv * inv);
}

/// asin(sqrt(z)) / sqrt(z): turns the sine of a rotation vector into the vector.
template <int N>
Jet<N> angle_over_sine(const Jet<N>& z) {
  const double x = z.value;
  if (x < 1e-3) {
    constexpr double c1 = 1.0 / 6, c2 = 3.0 / 40, c3 = 15.0 / 336, c4 = 105.0 / 3456, c5 = 945.0 / 42240;
    return chain(z, 1 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5)))),
                 c1 + x * (2 * c2 + x * (3 * c3 + x * (4 * c4 + x * 5 * c5))),
                 2 * c2 + x * (6 * c3 + x * (12 * c4 + x * 20 * c5)));
  }
  // f = asin(s) / s, z = s^2; then 2 z f' = 1 / sqrt(1 - z) - f.
  const double s = std::sqrt(x), f = std::asin(s) / s, w = 1 / std::sqrt(1 - x);
  const double f1 = (w - f) / (2 * x), f2 = (0.5 * w * w * w - 3 * f1) / (2 * x);
  return chain(z, f, f1, f2);
}

}  // namespace large_displacements
