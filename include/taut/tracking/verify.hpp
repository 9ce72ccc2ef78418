// Independent check of the state that a tracker reached.
#pragma once

#include <cmath>
#include <limits>

#include "taut/numerics/larger.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// The largest violation of each condition, relative to the largest force so far, and where the worst of
/// all is.
template <class Scalar>
struct Verdict {
  Scalar imbalance = 0;  ///< T against load x factors + prestrain + coupling x e, made afresh from the slips
  Scalar compression = 0;  ///< T below zero, tension in a slack span, or a slack span that is too short
  Scalar outside = 0;      ///< beyond the friction cone rho T2 <= T1 <= T2 / rho
  Scalar off_limit = 0;    ///< a joint that slides without being at the limit that opposes it
  int segment = -1;        ///< of the largest imbalance
  int joint = -1;          ///< of the largest violation of friction

  Scalar worst() const { return larger(larger(imbalance, compression), larger(outside, off_limit)); }
};

/// Recomputes equilibrium, Eq. (8), T >= 0, the friction cones, Eq. (3), and that what slides slides against
/// its friction at its limit, Eq. (9).
///
/// Uses the condensed scene and the slips alone, none of what the tracker keeps for speed: segments^2
/// multiplications. Where some number is none, the violation is infinite. Before start() nothing is violated.
template <class CondensedType, int Parameters>
Verdict<typename CondensedType::Scalar> verify(const Tracker<CondensedType, Parameters>& tracker) {
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  if (!tracker.is_started()) return {};
  const auto& model = tracker.model();
  const auto slips = tracker.slip_state();
  const auto& loads = tracker.loads();
  const Real unit = tracker.peak() > 0 ? Real(1) / static_cast<Real>(tracker.peak()) : Real(1);
  Verdict<Scalar> verdict;
  // What is no number is beyond everything.
  const auto raise = [](Scalar& worst, Real violation) {
    const auto by = static_cast<Scalar>(violation);
    if (!(by <= worst)) worst = by > worst ? by : std::numeric_limits<Scalar>::infinity();
  };

  FixedArray<Real, Cap::segments> e, T;
  e.fill(Real(0));
  for (int c = 0; c < model.cables.size(); ++c) {
    const auto& cable = model.cables[c];
    for (int j = 0; j < cable.joints(); ++j) {
      const auto sides = cable.joint_segments(j);
      e[sides[0]] += slips.slip[cable.first_joint + j];
      e[sides[1]] -= slips.slip[cable.first_joint + j];
    }
  }
  for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
    e[model.cables[c].end_segment(end)] += slips.extension[c][end];
  });
  for (int r = 0; r < tracker.spans().size(); ++r) e[tracker.spans()[r].segment(0)] += slips.slack_length[r];
  for (int i = 0; i < model.segments; ++i) {
    T[i] = loads.prestrain * model.prestrain[i];
    for (int k = 0; k < model.loads; ++k) T[i] += loads.factor[k] * model.load[k][i];
  }
  model.coupling.add(model.segments, e, T);

  for (int i = 0; i < model.segments; ++i) {
    const Real off = std::fabs(T[i] - static_cast<Real>(tracker.tension(i))) * unit;
    if (!(static_cast<Scalar>(off) <= verdict.imbalance)) verdict.segment = i;
    raise(verdict.imbalance, off);
    raise(verdict.compression, -T[i] * unit);
  }
  for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
    const auto& jack = loads.jack[c][end];
    if (jack.locked) return;
    const Real off = std::fabs(T[model.cables[c].end_segment(end)] - jack.force) * unit;
    raise(verdict.imbalance, off);
  });
  for (int r = 0; r < tracker.spans().size(); ++r) {
    const auto& span = tracker.spans()[r];
    if (!tracker.is_slack(span)) continue;
    const Real stiffness = model.coupling(span.segment(0), span.segment(0));
    raise(verdict.compression, -slips.slack_length[r] * stiffness * unit);
    for (int i = 0; i < span.count; ++i) raise(verdict.compression, std::fabs(T[span.segment(i)]) * unit);
  }
  for (int c = 0; c < model.cables.size(); ++c) {
    const auto& cable = model.cables[c];
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const auto sides = cable.joint_segments(k);
      const Real T1 = T[sides[0]], T2 = T[sides[1]], rho = tracker.rho(j);
      const Real outside = larger(rho * T2 - T1, rho * T1 - T2) * unit;
      Real off_limit = 0;
      if (tracker.motion(j) == JointState::forward) off_limit = std::fabs(T1 - rho * T2) * unit;
      if (tracker.motion(j) == JointState::backward) off_limit = std::fabs(T2 - rho * T1) * unit;
      const auto most = static_cast<Scalar>(larger(outside, off_limit));
      if (!(most <= larger(verdict.outside, verdict.off_limit))) verdict.joint = j;
      raise(verdict.outside, outside);
      raise(verdict.off_limit, off_limit);
    }
  }
  return verdict;
}

}  // namespace taut
