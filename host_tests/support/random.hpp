// Random numbers that are the same on every platform.
#pragma once

#include <cmath>
#include <cstdint>

namespace support {

constexpr double pi = 3.14159265358979323846;

/// Evenly distributed: xorshift64*, Vigna 2016.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 1) {}
  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }
  int below(int bound) { return static_cast<int>(unit() * bound); }
  bool coin() { return unit() < 0.5; }

 private:
  double unit() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<double>((state_ * 0x2545F4914F6CDD1Du) >> 11) / 9007199254740992.0;
  }
  std::uint64_t state_;
};

/// Standard normal, the same but for the rounding of log and cos: Box and Muller 1958.
inline double gaussian(Random& random) {
  const double radius = std::sqrt(-2 * std::log(random.between(1e-300, 1)));
  return radius * std::cos(2 * pi * random.between(0, 1));
}

}  // namespace support
