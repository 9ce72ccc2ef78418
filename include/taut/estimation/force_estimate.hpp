// The force of a segment at the best estimate of loads and friction, with its standard deviation.
#pragma once

#include <cmath>

#include "taut/estimation/held_over.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// A force and its standard deviation, both in N.
template <class Scalar>
struct ForceEstimate {
  Scalar force = 0, deviation = 0;
};

/// By how much of a change of the jack's force at `at` a segment of the same cable changes, at most: where
/// all joints between slide; zero in other cables. Cost: one product a joint between.
template <class TrackerType, class EndType>
typename TrackerType::Scalar carried_over(const TrackerType& tracker, const EndType& at, int segment) {
  const auto& cable = tracker.model().cables[at.cable()];
  const int i = segment - cable.first_segment;
  if (i < 0 || i >= cable.segments()) return 0;
  return at.end == 0 ? held_between(tracker, cable.first_joint, i)
                     : held_between(tracker, cable.first_joint + i, cable.joints() - i);
}

/// The tension of a segment where the tracker is, carried on along its present piece to the best estimate of
/// the loads and of friction: T + dT/dF (F - driven) + dT/dmu (mu - mu_0), not below zero. The standard
/// deviation has that of the loads, of friction and its scatter, and of what friction remembers, Eq. (20);
/// zero if not `HasDeviation`. A load that may be elsewhere may have let joints slide that stick here; of one
/// that may have turned friction may hold more than it is confirmed to have done, and of one that was not
/// read for a while more than it was seen to do; a joint that slides since a turn may stick, as `turned` has
/// it. What a load is off by for readings that taught friction as well counts once, Eq. (66). Cost: one
/// product a jack and unknown in use, and with a deviation half the square of the unknowns.
template <bool HasDeviation, class TrackerType, class Jacks, class FilterType, class Turned>
ForceEstimate<typename TrackerType::Scalar> estimate_force(const TrackerType& tracker, const Jacks& jacks,
                                                           const FilterType& filter, const Turned& turned,
                                                           int segment) {
  const auto& belief = filter.belief();
  using Scalar = typename TrackerType::Scalar;
  using EndType = CableEnd<typename TrackerType::Cap>;
  FixedArray<Scalar, Jacks::capacity> by_jack, by_shared;
  const auto sensitivity = [&](int p) {
    return tracker.sensitivity(p, segment) - jacks.counted_elsewhere(p, by_jack);
  };
  Scalar T = tracker.tension(segment), variance = 0;
  for (int k = 0; k < jacks.size(); ++k) {
    const auto& load = jacks[k];
    const EndType& at = jacks.end(k);
    // Where nothing is confirmed to pull yet, too.
    const bool is_elsewhere = load.at.refused || !(load.driven.force > 0),
               is_behind_joints = segment != at.segment(tracker.model()),
               is_held = is_behind_joints && !is_elsewhere;
    const Scalar slope = by_jack[k] = tracker.slope(k, segment),
                 further = slope * (is_held ? load.come_beyond() : load.beyond());
    T += further;
    if (!HasDeviation || load.locked) continue;
    const bool may_be_back = load.may_be_back() && is_behind_joints,
               went_unread = load.missed > 0 && is_behind_joints;
    const Scalar most =
        is_elsewhere || may_be_back || went_unread ? carried_over(tracker, at, segment) : Scalar(0);
    // Where the load may be elsewhere, joints that stick may slide.
    const Scalar part =
        larger(std::fabs(slope), is_elsewhere ? most : Scalar(0)) * (is_held ? load.at.come_sd : load.at.sd);
    variance += part * part;
    if (went_unread) variance += most * load.missed * most * load.missed / 4;
    if (!is_elsewhere && !may_be_back) by_shared[k] = slope * load.taught_part();
    if (!may_be_back) continue;
    // If it has reversed, the force did not follow from where it was farthest.
    const Scalar held = most * load.short_of_farthest(load.driven.force),
                 off = (load.rises ? held : -held) - further;
    variance += off * off;
  }
  if (HasDeviation) {
    const int leader = turned.leader_of(segment);
    Scalar by_friction = 0, in_common = 0;
    Scalar of_unknowns = belief.variance_of([&](int p) {
      const Scalar S = sensitivity(p);
      for (int k = 0; k < jacks.size(); ++k) in_common += by_shared[k] * S * belief.with_load(p, k);
      T += S * (belief.mean(p) - belief.linearized_at(p));
      if (leader >= 0 && p < belief.friction() && turned.leader(p) == leader)
        by_friction += S * turned.move(p);
      return S;
    });
    // Eq. (66), counted for no more than either variance.
    variance += 2 * larger(-in_common, larger(-variance, -of_unknowns));
    if (leader >= 0) {
      const Scalar sd = std::sqrt(larger(belief.variance(leader), Scalar(0))), straight = by_friction * sd,
                   kinked = turned.deviation(segment, T, by_friction, sd);
      of_unknowns += kinked * kinked - straight * straight;
    } else if (const int common = filter.scatters_about(segment); common >= 0) {
      const Scalar S = sensitivity(common);
      of_unknowns += S * S * filter.scatter(segment);
    }
    if (const int p = turned.drawn_by(segment); Turned::drawn_segments > 0 && p >= 0) {
      const Scalar sd = std::sqrt(larger(belief.variance(p), Scalar(0))), straight = sensitivity(p) * sd,
                   kinked = turned.drawn_deviation(segment, T, sd);
      of_unknowns += larger(kinked * kinked - straight * straight, Scalar(0));
    }
    // Forces are about exponential in mu: the longer side counts.
    const Scalar square = T * T;
    variance +=
        of_unknowns + (of_unknowns < square ? 2 * of_unknowns * of_unknowns / square : 2 * of_unknowns);
  } else {
    for (int p = 0; p < belief.carried(); ++p)
      if (belief.mean(p) != belief.linearized_at(p))
        T += sensitivity(p) * (belief.mean(p) - belief.linearized_at(p));
  }
  return {larger(T, Scalar(0)), HasDeviation ? std::sqrt(larger(variance, Scalar(0))) : Scalar(0)};
}

/// The axial force of a strut [N], tension positive, at the best estimate of the loads and of the unknowns.
/// `rows` are the CondensedStruts of the scene, `strut` has the number of the scene. The standard deviation
/// has that of the loads, of friction and, at most, of its scatter. Cost: that of predict_strut(), and the
/// square of the unknowns.
template <class TrackerType, class StrutRows, class Jacks, class FilterType, class PriorType>
ForceEstimate<typename TrackerType::Scalar> estimate_strut(const TrackerType& tracker, const StrutRows& rows,
                                                           const Jacks& jacks, const FilterType& filter,
                                                           const PriorType& prior, int strut) {
  using Scalar = typename TrackerType::Scalar;
  const auto& belief = filter.belief();
  typename FilterType::PredictionType N;
  predict_strut(tracker, rows, strut, belief, jacks, N);
  auto [force, variance] = belief.expect(N, jacks.readings(prior), Scalar(0));
  variance += filter.most_scatter(N.H);
  return {force, std::sqrt(larger(variance, Scalar(0)))};
}

/// The extension of jack `k` [m] at the best estimate of its load and of the unknowns, from that where the
/// tracker is. Cost: all that moves along the cables for every unknown that is not where the tracker is
/// linearized.
template <class TrackerType, class Jacks, class BeliefType>
typename TrackerType::Scalar estimate_extension(const TrackerType& tracker, const Jacks& jacks,
                                                const BeliefType& belief, int k,
                                                typename TrackerType::Scalar of_tracker) {
  const int cable = jacks.end(k).cable();
  const std::size_t end = jacks.end(k).end;
  FixedArray<typename TrackerType::Scalar, Jacks::capacity> by_jack;
  by_jack[k] = tracker.extension_slope(cable, end);
  auto extension = of_tracker + by_jack[k] * jacks[k].beyond();
  for (int p = 0; p < belief.carried(); ++p)
    if (belief.mean(p) != belief.linearized_at(p))
      extension += (tracker.extension_sensitivity(p, cable, end) - jacks.counted_elsewhere(p, by_jack)) *
                   (belief.mean(p) - belief.linearized_at(p));
  return extension;
}

}  // namespace taut
