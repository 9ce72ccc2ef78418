// How often error bars hold, and how far errors leave them.
#pragma once

#include <algorithm>
#include <cmath>

namespace estimation {

/// Of errors in their standard deviations; one that is very far off counts as a hundred.
struct Score {
  int held = 0, count = 0;
  double square = 0, worst = 0;

  void add(double error) {
    const double z = std::fabs(error);
    held += z < 1.96 ? 1 : 0;
    ++count;
    square += std::min(z * z, 1e4);
    worst = std::max(worst, z);
  }
  /// Those of another one.
  void add(const Score& other) {
    held += other.held;
    count += other.count;
    square += other.square;
    worst = std::max(worst, other.worst);
  }
  double share() const { return 1.0 * held / count; }
  double rms() const { return std::sqrt(square / count); }
};

}  // namespace estimation
