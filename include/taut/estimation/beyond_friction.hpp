// Forces that are shown of neighbouring segments, where friction cannot hold them apart so far.
#pragma once

#include <cmath>

#include "taut/numerics/larger.hpp"

namespace taut {

/// Whether forces may be shown farther apart than friction allows: beside other cables or load patterns, or
/// once a jack has turned where nobody saw it. Else nothing moves the cable but its own jacks, and they are
/// known to far less than joints hold. Not before the start, nor in second-order theory, where what a joint
/// holds changes with the bend. Cost: a comparison a jack.
template <class Parts>
[[gnu::always_inline]] inline bool may_be_beyond_friction(const Parts& parts) {
  if constexpr (Parts::TrackerType::Model::has_level) return false;
  if (!parts.tracker.is_started()) return false;
  bool may_be = (Parts::has_several && parts.model().cables.size() > 1) || parts.patterns() > 0;
  for (int k = 0; k < parts.jacks.size(); ++k) may_be |= parts.jacks[k].turned_unseen;
  return may_be;
}

/// By how much `force` of a segment [N] and that of a neighbour are farther apart than the joint between them
/// holds, with friction two standard deviations higher than it is known, the larger of both, Eq. (67); not
/// below zero. To be asked where may_be_beyond_friction(). Cost: that of EstimatorParts::force() twice, and a
/// pass over the cables.
template <class Parts>
typename Parts::Scalar beyond_friction(const Parts& parts, int segment, typename Parts::Scalar force) {
  using Scalar = typename Parts::Scalar;
  using Real = typename Parts::Condensed::Real;
  constexpr Scalar deviations = 2, rounding = Scalar(1e-5);
  const int c = parts.model().cable_of(segment);
  const auto& cable = parts.model().cables[c];
  const auto& prior = parts.filter.prior();
  Real most = 0;
  for (const int joint : cable.segment_joints(segment - cable.first_segment)) {
    if (joint < 0) continue;
    const auto sides = cable.joint_segments(joint - cable.first_joint);
    const Scalar mu = parts.filter.mu(joint), own = prior.scatter[c] * mu,
                 known = parts.filter.mu_deviation(joint);
    const auto highest = static_cast<Real>(mu + deviations * std::sqrt(known * known + own * own));
    const Real rho = prior.limit(c, joint, highest).rho, here = static_cast<Real>(force),
               other = static_cast<Real>(parts.force(sides[sides[0] == segment ? 1 : 0]));
    most = larger(most, larger(rho * other - here, rho * here - other));
  }
  return larger(static_cast<Scalar>(most) - rounding * force, Scalar(0));
}

}  // namespace taut
