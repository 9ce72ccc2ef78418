// A force beside a kink: where a joint that sticks would slide, or one that slides would stick.
#pragma once

#include "taut/numerics/larger.hpp"

namespace taut {

/// A force is on one side of a kink and may be on the other, where it would follow a number that is known to
/// `deviation` and `distance` away from it, both in the force's unit. Returns the standard deviation that it
/// has by that, Eq. (62): it is off one way only, and 95 % of that lie within 1.64 standard deviations, in
/// place of 1.96. Zero where the kink is farther than two of them, nearly.
template <class Scalar>
constexpr Scalar deviation_across(Scalar deviation, Scalar distance) {
  return larger(Scalar(0.84) * deviation - larger(distance, Scalar(0)) / 2, Scalar(0));
}

}  // namespace taut
