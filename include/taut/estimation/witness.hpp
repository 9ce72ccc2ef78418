// The load cell at the other end of a cable as a witness of what its jack's cell reads.
#pragma once

#include <limits>

#include "taut/estimation/drive.hpp"
#include "taut/estimation/force_estimate.hpp"

namespace taut {

/// The force at the anchored end of a cable as its load cell reads it in this row, with the standard
/// deviation of its noise [N]; not a number if it has none, or none is read. Cost: a few operations an end.
template <class Parts>
ForceEstimate<typename Parts::Scalar> read_beside(const Parts& parts,
                                                  const typename Parts::ReadingsType& readings, int cable) {
  const auto& ends = parts.far_ends.ends();
  for (int e = 0; e < ends.size(); ++e) {
    const auto& given = ends[e].in(readings.ends);
    if (ends[e].cable() == cable && parts.can_be(given, cable))
      return {given.force, parts.far_ends.watch(e).sd};
  }
  return {std::numeric_limits<typename Parts::Scalar>::quiet_NaN(), 0};
}

/// Whether the cell beside jack `k` has seen the load go up as far as its reading [N], or at least half as
/// far as where all joints slide. What goes down does not come through at first. Cost: one product a joint.
template <class Parts>
bool sees_rise(const Parts& parts, int k, typename Parts::Scalar reading,
               const ForceEstimate<typename Parts::Scalar>& beside) {
  using Scalar = typename Parts::Scalar;
  constexpr Scalar surely = 10, half = Scalar(0.5);
  const auto& jack = parts.jacks[k];
  const Scalar rise = beside.force - jack.beside, of_jack = reading - jack.believed;
  return of_jack > 0 && rise > surely * beside.deviation &&
         rise > half * held_over(parts.tracker, parts.jacks.end(k).cable()) * of_jack;
}

}  // namespace taut
