// What the forces of a cable would be with other friction, where a derivative does not tell.
#pragma once

#include <cmath>

#include "taut/estimation/leg.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// By how much the unknowns of a cable's friction move with their sum, by one standard deviation of that:
/// more or less friction as a whole, Eq. (55). Returns the unknown that stands for all of them, or -1 if it
/// has none. Cost: the square of the unknowns.
template <class Parts>
int find_common_friction(Parts& parts, int c) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  const auto& cable = parts.model().cables[c];
  FixedArray<bool, Parts::unknowns> is_of;
  int leader = -1;
  for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
    const int p = parts.filter.unknown_of(j);
    if (p < 0) continue;
    is_of[p] = true;
    leader = p;
  }
  if (leader < 0) return -1;
  typename Parts::Values with_sum;
  Scalar of_sum = 0;
  for (int p = 0; p < belief.friction(); ++p) {
    for (int q = 0; q < belief.friction(); ++q)
      if (is_of[p] && is_of[q]) with_sum[p] += belief.covariance(p, q);
    of_sum += with_sum[p];
  }
  const Scalar scale = std::sqrt(larger(of_sum * belief.variance(leader), Scalar(0)));
  if (!(scale > 0)) return -1;
  for (int p = 0; p < belief.friction(); ++p)
    if (is_of[p]) parts.turned.set_move(p, with_sum[p] / scale, leader);
  return leader;
}

/// The tension of a segment where the tracker is, at the best estimate of the unknowns [N].
template <class Parts>
typename Parts::Scalar best_tension(const Parts& parts, int segment) {
  const auto& belief = parts.filter.belief();
  auto T = parts.tracker.tension(segment);
  for (int p = 0; p < belief.carried(); ++p)
    if (belief.mean(p) != belief.linearized_at(p))
      T += parts.tracker.sensitivity(p, segment) * (belief.mean(p) - belief.linearized_at(p));
  return T;
}

/// Jack `k` turns here, or takes hold of a cable that was locked. Cost: a derivative a segment and unknown.
template <class Parts>
void turn_forces(Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  auto& turned = parts.turned;
  const int c = parts.jacks.end(k).cable(), leader = find_common_friction(parts, c);
  if (leader < 0) return;
  const auto& cable = parts.model().cables[c];
  const Scalar sd = std::sqrt(belief.variance(leader));
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
    const Scalar force = best_tension(parts, i);
    Scalar sticks = 0;
    for (int p = 0; p < belief.friction(); ++p)
      if (turned.leader(p) == leader) sticks += parts.tracker.sensitivity(p, i) * turned.move(p);
    if (turned.leader_of(i) == leader) sticks = turned.deviation(i, force, sticks, sd) / sd;
    turned.turn(i, force, sticks, leader);
  }
}

/// After the wedges of cable `c` were drawn in, from where the tracker was when `from` was saved: goes that
/// way with friction two standard deviations less, and more, and comes back. How far joints slide back there
/// depends on friction, and not in proportion. Cost: three times those of Tracker::restore(), and of a path;
/// two of Tracker::adjust().
template <class Parts>
void try_other_friction(Parts& parts, int c, const typename Parts::TrackerType::State& from) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  auto& turned = parts.turned;
  const int leader = find_common_friction(parts, c);
  if (leader < 0) return;
  const auto& cable = parts.model().cables[c];
  const Scalar far = static_cast<Scalar>(turned.far) * std::sqrt(belief.variance(leader));
  const auto here = belief.save().linearized_at;
  FixedArray<Scalar, Parts::Cap::segments> force;
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
    force[i] = best_tension(parts, i);
  for (const Scalar x : {-far, far}) {
    auto values = belief.mean();
    for (int p = 0; p < belief.friction(); ++p)
      if (turned.leader(p) == leader) values[p] += x * turned.move(p);
    if (!go_anew(parts, from, here, &values)) continue;
    for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
      turned.find(i, (parts.tracker.tension(i) - force[i]) / x);
  }
  static_cast<void>(go_anew(parts, from, here, nullptr));
}

}  // namespace taut
