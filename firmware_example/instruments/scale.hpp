// From counts of a converter to force.
#pragma once

#include <cstdint>

namespace instruments {

/// A straight line: exact differences of counts, one rounding in the conversion to float and one in the
/// product.
struct Scale {
  std::int32_t zero = 0;  ///< counts without load
  float newtons_per_count = 1;

  /// Through two calibration points. False, and nothing is changed, if they are the same counts.
  bool calibrate(std::int32_t unloaded, std::int32_t loaded, float load) {
    if (loaded == unloaded) return false;
    zero = unloaded;
    newtons_per_count = load / static_cast<float>(loaded - unloaded);
    return true;
  }
  /// [N], of counts of at most 24 bits.
  float force(std::int32_t counts) const { return static_cast<float>(counts - zero) * newtons_per_count; }
};

}  // namespace instruments
