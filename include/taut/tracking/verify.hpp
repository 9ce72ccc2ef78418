// A check that trusts nobody: is the state that a tracker reached an answer at all?
#pragma once

#include <cmath>

#include "taut/tracking/tracker.hpp"

namespace taut {

/// The largest violation of each condition, relative to the largest tension so far, and where the worst of
/// all is.
template <class Scalar>
struct Verdict {
  Scalar imbalance = 0;  ///< T against load x factors + prestrain + coupling x e, made afresh from the moves
  Scalar compression = 0;  ///< T below zero, tension in a slack run, or a slack run that is too short
  Scalar outside = 0;      ///< beyond the friction cone rho T2 <= T1 <= T2 / rho
  Scalar off_limit = 0;    ///< a joint that slides without being at the limit that opposes it
  int segment = -1;        ///< of the largest imbalance
  int joint = -1;          ///< of the largest violation of friction

  Scalar worst() const { return std::fmax(std::fmax(imbalance, compression), std::fmax(outside, off_limit)); }
};

/// Recomputes equilibrium, T >= 0, the friction cones, and that what slides slides against its friction at
/// its limit.
///
/// Uses the condensed scene and the moves alone, none of what the tracker keeps for speed: segments^2
/// multiplications.
template <class CondensedType>
Verdict<typename CondensedType::Scalar> verify(const Tracker<CondensedType>& tracker) {
  using Scalar = typename CondensedType::Scalar;
  using Cap = typename CondensedType::Capacity;
  const CondensedType& model = tracker.model();
  const auto moves = tracker.moves();
  const auto& loads = tracker.loads();
  const Scalar unit = tracker.peak() > 0 ? Scalar(1) / tracker.peak() : Scalar(1);
  Verdict<Scalar> verdict;

  FixedArray<Scalar, Cap::segments> e, T;
  e.fill(Scalar(0));
  for (int c = 0; c < model.cables.size(); ++c) {
    const auto& cable = model.cables[c];
    for (int j = 0; j < cable.joints(); ++j) {
      const auto sides = cable.joint_segments(j);
      e[sides[0]] += moves.slip[cable.first_joint + j];
      e[sides[1]] -= moves.slip[cable.first_joint + j];
    }
  }
  for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
    e[model.cables[c].end_segment(end)] += moves.payout[c][end];
  });
  for (int r = 0; r < tracker.runs().size(); ++r) e[tracker.runs()[r].segment(0)] += moves.excess[r];
  for (int i = 0; i < model.segments; ++i) {
    T[i] = loads.prestrain * model.prestrain[i];
    for (int k = 0; k < model.loads; ++k) T[i] += loads.factor[k] * model.load[k][i];
  }
  model.coupling.add(model.segments, e, T);

  for (int i = 0; i < model.segments; ++i) {
    const Scalar off = std::fabs(T[i] - tracker.tension(i)) * unit;
    if (off > verdict.imbalance) verdict.segment = i;
    verdict.imbalance = std::fmax(verdict.imbalance, off);
    verdict.compression = std::fmax(verdict.compression, -T[i] * unit);
  }
  for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
    const auto& jack = loads.jack[c][end];
    if (jack.locked) return;
    const Scalar off = std::fabs(T[model.cables[c].end_segment(end)] - jack.force) * unit;
    verdict.imbalance = std::fmax(verdict.imbalance, off);
  });
  for (int r = 0; r < tracker.runs().size(); ++r) {
    const auto& run = tracker.runs()[r];
    if (!tracker.is_slack(run)) continue;
    const Scalar stiffness = model.coupling(run.segment(0), run.segment(0));
    verdict.compression = std::fmax(verdict.compression, -moves.excess[r] * stiffness * unit);
    for (int i = 0; i < run.count; ++i)
      verdict.compression = std::fmax(verdict.compression, std::fabs(T[run.segment(i)]) * unit);
  }
  for (int c = 0; c < model.cables.size(); ++c) {
    const auto& cable = model.cables[c];
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const auto sides = cable.joint_segments(k);
      const Scalar T1 = T[sides[0]], T2 = T[sides[1]], rho = model.rho[j];
      const Scalar outside = std::fmax(rho * T2 - T1, rho * T1 - T2) * unit;
      Scalar off_limit = 0;
      if (tracker.motion(j) == JointState::forward) off_limit = std::fabs(T1 - rho * T2) * unit;
      if (tracker.motion(j) == JointState::backward) off_limit = std::fabs(T2 - rho * T1) * unit;
      const Scalar most = std::fmax(outside, off_limit);
      if (most > std::fmax(verdict.outside, verdict.off_limit)) verdict.joint = j;
      verdict.outside = std::fmax(verdict.outside, outside);
      verdict.off_limit = std::fmax(verdict.off_limit, off_limit);
    }
  }
  return verdict;
}

}  // namespace taut
