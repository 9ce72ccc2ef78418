// How much of a cable's force is left behind joints that it slides over.
#pragma once

#include <cmath>

#include "taut/numerics/larger.hpp"

namespace taut {

/// The product of rho of `joints` joints in a row: the part of a force that is left behind them where all
/// slide away from it. Cost: one product a joint.
template <class TrackerType>
typename TrackerType::Scalar held_between(const TrackerType& tracker, int first_joint, int joints) {
  using Scalar = typename TrackerType::Scalar;
  Scalar held = 1;
  for (int j = first_joint; j < first_joint + joints; ++j) held *= static_cast<Scalar>(tracker.rho(j));
  return held;
}

/// The least part of its force that cable `c` has at one end where it is pulled at the other and slides over
/// all joints. Cost: one product a joint.
template <class TrackerType>
typename TrackerType::Scalar held_over(const TrackerType& tracker, int c) {
  const auto& cable = tracker.model().cables[c];
  return held_between(tracker, cable.first_joint, cable.joints());
}

/// The same for two jacks that pull at both ends and surely do not pull the cable through: larger by this
/// part, which is inside of what friction holds; but where that is next to nothing, or the cable is one
/// segment, they pull alike.
template <class TrackerType>
typename TrackerType::Scalar surely_held_over(const TrackerType& tracker, int c,
                                              typename TrackerType::Scalar inside) {
  using Scalar = typename TrackerType::Scalar;
  const Scalar held = held_over(tracker, c);
  return -larger(-(1 + inside) * held, -std::sqrt(held));
}

}  // namespace taut
