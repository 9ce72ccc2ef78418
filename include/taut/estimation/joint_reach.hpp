// How far the error of a jack's load reaches over joints that stick where the tracker is.
#pragma once

#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/kink.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The standard deviation that a segment has at least [N], where the joint beside it that sticks toward a
/// jack might slide, were the load of the jack another one, as far as that is not known: friction leaves no
/// less in the segment than the load times `carried`, and no more than the load over that, Eq. (62). Cost: a
/// few operations a jack where the joint slides, one product a joint more where it sticks, and that of
/// estimate_force() where it might slide.
template <class Parts>
typename Parts::Scalar deviation_by_reach(const Parts& parts, int segment, typename Parts::Scalar force) {
  using Scalar = typename Parts::Scalar;
  // No load is less known than to a tenth: two deviations of that.
  constexpr Scalar most = Scalar(0.2);
  const auto& tracker = parts.tracker;
  Scalar deviation = 0;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& jack = parts.jacks[k];
    const auto& end = parts.jacks.end(k);
    const auto& cable = tracker.model().cables[end.cable()];
    const int i = segment - cable.first_segment, beside = end.end == 0 ? i - 1 : i;
    if (jack.locked || i < 0 || i >= cable.segments() || beside < 0 || beside >= cable.joints() ||
        tracker.is_at_limit(cable.first_joint + beside))
      continue;
    const Scalar carried = carried_over(tracker, end, segment), load = jack.best(), room = most * load;
    const Scalar above = force - carried * load, below = load / carried - force;
    if (!(carried > 0) || (above > room && below > room)) continue;
    const Scalar sd = parts.estimate_segment(parts.end_segment(k)).deviation;
    deviation = larger(deviation,
                       larger(deviation_across(carried * sd, above), deviation_across(sd / carried, below)));
  }
  return deviation;
}

}  // namespace taut
