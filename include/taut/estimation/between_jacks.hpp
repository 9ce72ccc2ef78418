// How far the friction between a segment and the jacks at both ends of its cable reaches.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/held_over.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The standard deviation that a segment between two jacks has at least [N]. With friction that is lower by
/// two deviations a jack leaves so much more of its load in it, and can hold so much less of it, whichever of
/// the two jacks the cable slides to by now, Eq. (69). Zero before the start, and where no two jacks pull the
/// cable. Cost: a pass over its joints, and for either jack the square of the unknowns.
template <class Parts>
typename Parts::Scalar deviation_between_jacks(const Parts& parts, int segment,
                                               typename Parts::Scalar force) {
  using Scalar = typename Parts::Scalar;
  if constexpr (Parts::JacksType::capacity < 2) return 0;
  if (!parts.tracker.is_started()) return 0;
  const auto& belief = parts.filter.belief();
  const int c = parts.model().cable_of(segment);
  const auto pulls = parts.jacks.pulls(c);
  if (!pulls[0] || !pulls[1] || !belief.has_friction()) return 0;
  const auto& cable = parts.model().cables[c];
  const int before = segment - cable.first_segment;  // joints
  Scalar deviation = 0;
  for (std::size_t end = 0; end < 2; ++end) {
    const int first = end == 0 ? 0 : before, joints = end == 0 ? before : cable.joints() - before;
    typename Parts::Values H;
    const Scalar carried = held_between(parts.tracker, cable.first_joint + first, joints);
    parts.filter.add_log_slopes(parts.tracker, cable.first_joint + first, joints, H);
    Scalar change = 0;
    for (int p = 0; p < belief.friction(); ++p) change += H[p] * (belief.mean(p) - belief.linearized_at(p));
    const Scalar load = parts.jacks[parts.jacks.find(c, end)].best(),
                 part = -larger(-carried * (1 + change), Scalar(-1)),
                 sd = std::sqrt(belief.variance_of_reading(H));
    deviation = larger(deviation, load * part * sd - (force - load * part) / 2);
    if (part > 0) deviation = larger(deviation, load / part * sd - (load / part - force) / 2);
  }
  return deviation;
}

}  // namespace taut
