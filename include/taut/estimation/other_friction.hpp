// What the forces of a cable would be with other friction, where a derivative does not tell.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/lock_off.hpp"
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

/// What the tension of a segment changes by with the move of `leader`, where the tracker is [N].
template <class Parts>
typename Parts::Scalar by_move(const Parts& parts, int leader, int segment) {
  typename Parts::Scalar change = 0;
  for (int p = 0; p < parts.filter.belief().friction(); ++p)
    if (parts.turned.leader(p) == leader)
      change += parts.tracker.sensitivity(p, segment) * parts.turned.move(p);
  return change;
}

/// The standard deviation of a segment's force by the loads that friction remembers [N], and by one that has
/// the variance `here` in it [N^2]. Cost: a derivative a memory.
template <class Parts>
typename Parts::Scalar known_by_loads(const Parts& parts, int segment, typename Parts::Scalar here) {
  typename Parts::Scalar variance = here;
  parts.jacks.for_each_memory([&](int p) {
    const auto S = parts.tracker.sensitivity(p, segment);
    variance += S * S * parts.filter.belief().variance(p);
  });
  return std::sqrt(variance);
}

/// A reading has told of the loads that friction remembers, in the last update: so it has of the forces where
/// jacks turned, of segments that still have those. Cost: three derivatives a segment and memory.
template <class Parts>
[[gnu::noinline]] void correct_turned(Parts& parts) {
  using Scalar = typename Parts::Scalar;
  for (int i = 0; i < parts.model().segments; ++i) {
    Scalar change = 0;
    parts.jacks.for_each_memory(
        [&](int p) { change += parts.tracker.sensitivity(p, i) * parts.filter.belief().change(p); });
    parts.turned.correct(i, best_tension(parts, i) - change, change, known_by_loads(parts, i, Scalar(0)));
  }
}

/// Jack `k` turns here, or takes hold of a cable that was locked. Cost: a derivative a segment and unknown.
template <class Parts>
void turn_forces(Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  auto& turned = parts.turned;
  const int c = parts.jacks.end(k).cable(), leader = find_common_friction(parts, c);
  const auto& cable = parts.model().cables[c];
  const Scalar sd = leader < 0 ? Scalar(0) : std::sqrt(belief.variance(leader));
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
    const Scalar force = best_tension(parts, i);
    const Scalar here = parts.tracker.slope(k, i) * parts.jacks[k].turn_sd;
    turned.turn(i, force, known_by_loads(parts, i, here * here));
    if (leader < 0) continue;
    Scalar sticks = by_move(parts, leader, i), apart = parts.filter.scatter(i);
    if (turned.leader_of(i) == leader) {
      sticks = turned.longest(i, force, sticks, turned.of_friction(i, sd));
      apart = larger(apart, turned.apart(i));
    }
    turned.turn_with_friction(i, sticks, leader, apart);
  }
  parts.far_ends.set_bent(parts.model(), c, [](int) { return Scalar(0); });
}

/// The segments of a cable from one end on.
template <class Scalar>
struct FromEnd {
  const CableLayout<Scalar>& cable;
  std::size_t end;
  int segment(int i) const { return cable.first_segment + (end == 0 ? i : cable.segments() - 1 - i); }
};

/// How many joints have slid back from where the wedge of an end was drawn in, with the one that holds if
/// there is none: the segments from that end up to this one follow the wedge. Cost: a pass over the segments.
template <class Parts, class Scalar>
int find_front(const Parts& parts, const FromEnd<Scalar>& from) {
  const int n = from.cable.segments();
  int front = 0;
  const auto has_slid = [&](int i) {
    return parts.turned.has_gone_on(from.segment(i), best_tension(parts, from.segment(i)));
  };
  while (front + 1 < n && has_slid(front + 1)) ++front;
  return front == 0 && n > 1 ? 1 : front;
}

/// Calls visit(segments from the end, front) for every end of cable `c` that the last lock-off is of.
template <class Parts, class Visit>
void for_each_front(const Parts& parts, int c, const Visit& visit) {
  for_each_of_lock_off(parts, [&](int k) {
    const auto& at = parts.jacks.end(k);
    if (at.cable() != c) return;
    const FromEnd<typename Parts::Scalar> from = {parts.model().cables[c], at.end};
    visit(from, find_front(parts, from));
  });
}

/// After wedges of cable `c` were drawn in, in the last lock-off, which is known: draws them in with friction
/// two standard deviations less, and more, and comes back; one or a half where there is no state so far, as
/// between two jacks that so little friction does not hold. How far joints slide back there depends on
/// friction, and not in proportion. Cost: three times that of lock_anew(), at worst seven.
template <class Parts>
void try_other_friction(Parts& parts, int c) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  auto& turned = parts.turned;
  const int leader = find_common_friction(parts, c);
  if (leader < 0) return;
  const auto& cable = parts.model().cables[c];
  Scalar apart = 0;
  for_each_front(parts, c, [&](const auto& end, int front) {
    const Scalar of_end = parts.filter.mean_scatter(c, end.segment(front), front);
    for (int i = 0; i <= front; ++i) turned.follow(end.segment(i), of_end);
    apart = larger(apart, of_end);
  });
  const Scalar far = static_cast<Scalar>(turned.far) * std::sqrt(belief.variance(leader) + apart);
  const auto here = belief.save().linearized_at;
  FixedArray<Scalar, Parts::Cap::segments> force;
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
    force[i] = best_tension(parts, i);
  for (const Scalar way : {-far, far})
    for (const Scalar part : {Scalar(1), Scalar(0.5), Scalar(0.25)}) {
      const Scalar x = part * way;
      auto values = belief.mean();
      for (int p = 0; p < belief.friction(); ++p)
        if (turned.leader(p) == leader) values[p] += x * turned.move(p);
      if (!lock_anew(parts, values)) continue;
      // By how much jacks' cells are off is counted along a straight line: half of that is in doubt here.
      for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
        turned.find(i, (parts.tracker.tension(i) - force[i]) / x);
      break;
    }
  static_cast<void>(lock_anew(parts, here));
  const Scalar sd = std::sqrt(belief.variance(leader));
  parts.far_ends.set_bent(parts.model(), c, [&](int i) {
    const Scalar slides = by_move(parts, leader, i), straight = slides * sd,
                 kinked = turned.deviation(i, force[i], slides, sd);
    return larger(kinked * kinked - straight * straight, Scalar(0));
  });
  if (!(apart > 0)) return;
  // Between the end and a segment friction is off by itself, beside what the end has.
  for_each_front(parts, c, [&](const auto& end, int front) {
    const int first = end.segment(0);
    const Scalar all = turned.of_friction(first, sd), slides = by_move(parts, leader, first),
                 of_end = turned.farther(slides, turned.found(first));
    for (int i = 1; i <= front; ++i) {
      const int segment = end.segment(i);
      const Scalar part = force[first] > 0 ? force[segment] / force[first] : Scalar(0),
                   own = by_move(parts, leader, segment) - part * slides,
                   square = parts.filter.scatter(segment) * own * own / (all * all);
      turned.find(segment, std::sqrt(part * of_end * part * of_end + square));
    }
  });
}

}  // namespace taut
