// How far the friction between a segment and the jacks at both ends of its cable reaches.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/held_over.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The standard deviation that a segment between two jacks has at least [N]. With friction that is lower by
/// two deviations, but holds what the jacks differ by, a jack leaves so much more of its load in it, and can
/// hold so much less of it, whichever of the two jacks the cable slides to by now, Eq. (69). Zero before the
/// start, at a jack, and where no two jacks pull the cable. Cost: a pass over its joints, and three times the
/// square of the unknowns.
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
  // What a jack holds itself is read.
  if (before == 0 || before == cable.joints()) return 0;
  std::array<Scalar, 2> load, part, sd;  // part: of its load that a jack leaves at most
  Scalar variance = 0;                   // of the loads, relative
  typename Parts::Values along;
  for (std::size_t end = 0; end < 2; ++end) {
    const int first = end == 0 ? 0 : before, joints = end == 0 ? before : cable.joints() - before;
    typename Parts::Values H;
    const Scalar carried = held_between(parts.tracker, cable.first_joint + first, joints);
    parts.filter.add_log_slopes(parts.tracker, cable.first_joint + first, joints, H);
    Scalar change = 0;
    for (int p = 0; p < belief.friction(); ++p) {
      change += H[p] * (belief.mean(p) - belief.linearized_at(p));
      along[p] += H[p];
    }
    const auto& jack = parts.jacks[parts.jacks.find(c, end)];
    load[end] = jack.best();
    part[end] = -larger(-carried * (1 + change), Scalar(-1));
    sd[end] = std::sqrt(belief.variance_of_reading(H));
    variance += jack.at.sd * jack.at.sd / (load[end] * load[end]);
  }
  // As much lower as still holds what they differ by, of two deviations.
  const Scalar less = -larger(-load[0], -load[1]), more = larger(load[0], load[1]),
               held = part[0] * part[1] * more, two_sd = 2 * std::sqrt(belief.variance_of_reading(along)),
               lower = larger(less - held, Scalar(0)) + 2 * std::sqrt(variance) * held,
               share = lower < two_sd * held ? lower / (two_sd * held) : Scalar(1);
  Scalar deviation = 0;
  for (std::size_t end = 0; end < 2; ++end) {
    const Scalar least = load[end] * part[end], of_friction = share * sd[end];
    deviation = larger(deviation, least * of_friction - (force - least) / 2);
    if (!(part[end] > 0)) continue;
    const Scalar most = load[end] / part[end];
    deviation = larger(deviation, most * of_friction - (most - force) / 2);
  }
  return deviation;
}

}  // namespace taut
