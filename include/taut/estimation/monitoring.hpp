// What is odd about the answers: friction outside of its prior, forces beyond limits.
#pragma once

#include <cmath>

#include "taut/estimation/alarms.hpp"

namespace taut {

/// Raises an alarm for every joint, or cable that shares its mu, whose mu is surely outside of two standard
/// deviations of its prior. Returns true if and only if there is none. Cost: one root a joint.
template <class Cables, class FilterType, class Alarms>
[[nodiscard]] bool check_friction(const Cables& cables, const FilterType& filter, Alarms& alarms) {
  using Scalar = typename FilterType::Scalar;
  bool is_fine = true;
  for (int c = 0; c < cables.size(); ++c) {
    const auto& cable = cables[c];
    const Scalar sd = filter.prior().mu_sd[c];
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k, p = filter.unknown_of(j);
      if (p < 0) continue;
      const bool shared = filter.prior().shared[c];
      const Scalar off = filter.mu_change(j, p), beyond = std::fabs(off) - 2 * sd * filter.weight(j);
      if (beyond > 0 && beyond > 2 * filter.mu_deviation(j)) {
        is_fine = false;
        alarms.add(Alarm::of(off > 0 && !shared ? Alarm::Kind::stuck_joint : Alarm::Kind::mu_band, c,
                             shared ? -1 : k));
      }
      if (shared) break;
    }
  }
  return is_fine;
}

/// Raises an alarm for every segment whose force(segment) [N] is beyond a limit, as `watch`, a ForceWatch,
/// has it. is_held(cable) is whether wedges hold it, or nothing can pull it. Cost: one force a segment.
template <class Cables, class Force, class IsHeld, class Watch, class Scalar, class Alarms>
void check_forces(const Cables& cables, const Force& force, const IsHeld& is_held, Watch& watch,
                  const AlarmLimits<Scalar>& limits, Alarms& alarms) {
  for (int c = 0; c < cables.size(); ++c) {
    const auto& cable = cables[c];
    const bool held = is_held(c);
    for (int i = 0; i < cable.segments(); ++i) {
      const int segment = cable.first_segment + i;
      const auto side = watch.take(segment, force(segment), held, limits);
      if (side == Watch::Side::above) alarms.add(Alarm::of(Alarm::Kind::force_high, c, i));
      if (side == Watch::Side::below) alarms.add(Alarm::of(Alarm::Kind::force_low, c, i));
    }
  }
}

}  // namespace taut
