// Twice the digits of a floating point type, from its own + - x: an unevaluated sum of two numbers.
#pragma once

#include <limits>
#include <type_traits>

#if defined(__FAST_MATH__)
#error \
    "taut: error-free arithmetic and reproducible results need IEEE arithmetic; compile without -ffast-math"
#endif

namespace taut {

/// hi + lo with |lo| at most half a unit in the last place of hi.
///
/// Residuals of nearly inextensible structures cancel: an elongation is a small difference of displacements.
/// Taken with double words the elongation is good to the last digit of Scalar. Needs IEEE arithmetic without
/// contraction. Algorithms: Knuth's TwoSum, Dekker's split and TwoProduct (Dekker, Numer. Math. 18 (1971)
/// 224-242).
template <class Scalar>
struct DoubleWord {
  Scalar hi = 0;
  Scalar lo = 0;

  constexpr Scalar value() const { return hi + lo; }

  /// a + b without error.
  static constexpr DoubleWord sum(Scalar a, Scalar b) {
    const Scalar s = a + b;
    const Scalar bb = s - a;
    return {s, (a - (s - bb)) + (b - bb)};
  }

  /// a x b without error, unless it over- or underflows.
  static constexpr DoubleWord product(Scalar a, Scalar b) {
    const DoubleWord x = split(a), y = split(b);
    const Scalar p = a * b;
    return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
  }

  constexpr DoubleWord operator-() const { return {-hi, -lo}; }

  friend constexpr DoubleWord operator+(DoubleWord a, DoubleWord b) {
    const DoubleWord s = sum(a.hi, b.hi);
    return renormalized(s.hi, s.lo + (a.lo + b.lo));
  }
  friend constexpr DoubleWord operator-(DoubleWord a, DoubleWord b) { return a + (-b); }
  friend constexpr DoubleWord operator*(Scalar a, DoubleWord b) {
    const DoubleWord p = product(a, b.hi);
    return renormalized(p.hi, p.lo + a * b.lo);
  }
  constexpr DoubleWord& operator+=(DoubleWord b) { return *this = *this + b; }
  constexpr DoubleWord& operator-=(DoubleWord b) { return *this = *this - b; }

 private:
  static_assert(std::is_floating_point<Scalar>::value, "double words are made of floating point numbers");

  static constexpr DoubleWord renormalized(Scalar a, Scalar b) {
    const Scalar s = a + b;
    return {s, b - (s - a)};
  }

  static constexpr Scalar power_of_two(int exponent) {
    Scalar power = 1;
    for (int i = 0; i < exponent; ++i) power *= 2;
    return power;
  }
  static constexpr DoubleWord split(Scalar a) {
    constexpr Scalar splitter = power_of_two((std::numeric_limits<Scalar>::digits + 1) / 2) + 1;
    const Scalar c = splitter * a;
    const Scalar hi = c - (c - a);
    return {hi, a - hi};
  }
};

}  // namespace taut
