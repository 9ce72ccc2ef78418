// Two jacks on one cable: friction holds what their loads differ by.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "taut/estimation/alarms.hpp"
#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/estimation/held_over.hpp"
#include "taut/estimation/learning.hpp"
#include "taut/estimation/standing_structure.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The jacks of a cable that pull at both ends: the one that pulls less, and the one that pulls more.
struct UnequalJacks {
  int less = -1, more = -1;

  template <class Jacks>
  static UnequalJacks of(const Jacks& jacks, int c) {
    const int first = jacks.find(c, 0), last = jacks.find(c, 1);
    if (first < 0 || last < 0) return {};
    if (jacks[first].at.load < jacks[last].at.load) return {first, last};
    return {last, first};
  }
};

/// The logarithm of a / b, but for the fifth power of u: with the same bits wherever it is computed.
template <class Scalar>
Scalar log_quotient(Scalar a, Scalar b) {
  const Scalar u = (a - b) / (a + b);
  return 2 * u + 2 * u * u * u / 3;
}

/// Calls visit(unknown, derivative) for what the load of jack `k` varies by with the constants of its load
/// cell [N].
template <class Parts, class Visit>
void for_each_constant(const Parts& parts, int k, const Visit& visit) {
  for_each_cell_error(parts, k, [&](const auto& error) {
    visit(static_cast<int>(error.parameter), error.constant + error.proportional * parts.jacks[k].at.load);
  });
}

/// Adds to `H` the derivatives of Eq. (68): by the unknowns, of the logarithm of what friction leaves of the
/// load of one jack of cable `c`, over that of the other. Cost: a pass over its joints.
template <class Parts>
void add_slopes_between(const Parts& parts, int c, const UnequalJacks& unequal, typename Parts::Values& H) {
  using Scalar = typename Parts::Scalar;
  const auto& cable = parts.model().cables[c];
  parts.filter.add_log_slopes(parts.tracker, cable.first_joint, cable.joints(), H);
  const auto load = [&](int k) { return parts.jacks[k].at.load; };
  for_each_constant(parts, unequal.more, [&](int p, Scalar by) { H[p] += by / load(unequal.more); });
  for_each_constant(parts, unequal.less, [&](int p, Scalar by) { H[p] -= by / load(unequal.less); });
}

/// The standard deviation of the load of jack `k` by these [N].
template <class Parts>
typename Parts::Scalar deviation_by_cell(const Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  Scalar variance = 0;
  for_each_constant(parts, k,
                    [&](int p, Scalar by) { variance += by * by * parts.filter.belief().variance(p); });
  return std::sqrt(variance);
}

/// Two jacks pull best estimates that differ by more than all friction between them as it is believed to be:
/// there is more, Eq. (68), and the tracker is brought to it. Returns false if they do not, or were not both
/// read in this row, if friction of the cable is known, and if it would have to be off by more than five
/// sigma: then nothing has changed. Cost: three times the square of the unknowns, and that of
/// Tracker::adjust().
template <class Parts>
bool raise_friction(Parts& parts, int c) {
  using Scalar = typename Parts::Scalar;
  if constexpr (Parts::JacksType::capacity < 2) return false;
  auto& filter = parts.filter;
  const auto& jacks = parts.jacks;
  const auto unequal = UnequalJacks::of(jacks, c);
  const int less = unequal.less, more = unequal.more;
  if (less < 0 || !jacks[less].is_new || !jacks[more].is_new || parts.loads_are_in_doubt(c) ||
      !(jacks[less].at.load > 0))
    return false;
  const Scalar of_less = jacks[less].at.load, of_more = jacks[more].at.load;
  typename Parts::Values H;
  add_slopes_between(parts, c, unequal, H);
  // A ramp that has been noticed of one and not yet of the other is no friction.
  const Scalar left = (of_more - 3 * jacks[more].filter.sd()) * held_over(parts.tracker, c),
               read = of_less + 3 * jacks[less].filter.sd();
  if (!(left > read)) return false;
  const Scalar sd_of_less = jacks[less].at.sd / of_less, sd_of_more = jacks[more].at.sd / of_more;
  // Of two jacks of a cable, the first has an even half of its own.
  const int bound = jacks.find(c, 0) / 2;
  if (!filter.bring_below_zero(bound, log_quotient(left, read), H,
                               sd_of_less * sd_of_less + sd_of_more * sd_of_more))
    return false;
  note(parts, Update::updated, Parts::alarm_at(Alarm::Kind::sensor, jacks.end(less)));
  return filter.relinearize(parts.tracker, filter.belief().mean());
}

/// What two jacks were confirmed to pull may differ by more than friction holds in the model, although it
/// holds their loads: lets the one of cable `c` that pulls more pull only as much as friction holds. Returns
/// false if and only if the loads themselves differ, by five sigma, by more than friction holds that is five
/// sigma larger; then nothing is changed. Cost: two passes over the joints.
template <class Parts, class SampleType>
[[nodiscard]] bool pull_less(const Parts& parts, int c, SampleType& to) {
  using Scalar = typename Parts::Scalar;
  if constexpr (Parts::JacksType::capacity < 2) return false;
  const auto& jacks = parts.jacks;
  auto& jack = to.jack[c];
  const std::size_t more = jack[0].force < jack[1].force ? 1 : 0, less = 1 - more;
  // Farthest toward the other one that a load can be; where one ramp has been noticed and the other not yet,
  // they are off by their noise too.
  const auto at_best = [&](std::size_t end, int way) {
    const int k = jacks.find(c, end);
    if (k < 0) return Scalar(0);
    return jacks[k].at.load + static_cast<Scalar>(way) * (5 * (jacks[k].at.sd + deviation_by_cell(parts, k)) +
                                                          3 * jacks[k].filter.sd());
  };
  // Friction larger by the part x leaves about as much less.
  const Scalar mu_sd = parts.filter.relative_deviation(parts.tracker, c), held = held_over(parts.tracker, c),
               least = larger(held - 5 * mu_sd * (1 - held), Scalar(0));
  if (at_best(less, 1) < least * at_best(more, -1)) return false;
  // Next to where all joints slide: farther inside some would come to rest, and remember it.
  const Scalar most = jack[less].force / surely_held_over(parts.tracker, c, Scalar(0.002));
  jack[more].force = -larger(-jack[more].force, -most);
  return true;
}

/// Where a cable is pulled through, for drive_straight(): friction as it is believed to be, or, if that
/// `learns`, found to be more on the way.
template <bool learns, class Parts>
struct HoldByFriction {
  std::conditional_t<learns, Parts&, const Parts&> parts;
  template <class SampleType>
  bool pull_less(int c, SampleType& to) const {
    return taut::pull_less(parts, c, to);
  }
  bool raise(int c) const {
    if constexpr (learns) return raise_friction(parts, c);
    return false;
  }
  /// So many, one after the other, before another load is tried.
  static constexpr auto bounds = bounds_of_friction<typename Parts::TrackerType>;
  template <class GoOn>
  auto stand(const Progress<typename Parts::Scalar>& progress, const GoOn& go_on, int most) const {
    return find_where_it_stands(parts, progress, go_on, most);
  }
};

}  // namespace taut
