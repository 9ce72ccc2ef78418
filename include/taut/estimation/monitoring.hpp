// What is odd about the answers: friction outside of its prior, cells that differ, forces beyond limits.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/alarms.hpp"
#include "taut/scene/scene.hpp"

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

/// Raises an alarm for every load cell at an anchored end whose gain differs from that of the jack's cell of
/// its cable by more than AlarmLimits::gain, surely: by two standard deviations more. Readings show the
/// difference alone, and only once the cable has slid both ways: else another mu explains it. Returns true if
/// and only if there is none. Cost: a few operations a cable.
template <class Cables, class FilterType, class Scalar, class Alarms>
[[nodiscard]] bool check_gains(const Cables& cables, const FilterType& filter,
                               const AlarmLimits<Scalar>& limits, Alarms& alarms) {
  const auto& belief = filter.belief();
  bool is_fine = true;
  for (int c = 0; c < cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& ends = cables[c].ends;
      const int far = filter.instruments().at(c, end).gain, jack = filter.instruments().at(c, 1 - end).gain;
      if (ends[end] != End::anchored || ends[1 - end] != End::jacked || (far < 0 && jack < 0)) continue;
      const auto mean = [&](int p) { return p < 0 ? Scalar(0) : belief.mean(p); };
      const auto covariance = [&](int p, int q) {
        return p < 0 || q < 0 ? Scalar(0) : belief.covariance(p, q);
      };
      const Scalar off = std::fabs(mean(far) - mean(jack)), beyond = off - limits.gain,
                   variance = covariance(far, far) + covariance(jack, jack) - 2 * covariance(far, jack);
      if (!(beyond > 0 && beyond * beyond > 4 * variance)) continue;
      is_fine = false;
      alarms.add(Alarm::of(Alarm::Kind::gain, c, static_cast<int>(end)));
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
