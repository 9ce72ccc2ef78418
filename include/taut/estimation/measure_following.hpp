// What a jack whose valve is shut tells of friction: the cable slides throughout.
#pragma once

#include <cmath>

#include "taut/estimation/following_jack.hpp"
#include "taut/estimation/held_over.hpp"
#include "taut/estimation/learning.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/estimation/two_jacks.hpp"

namespace taut {

/// Brings the tracker to these values of the unknowns, or next to them, where what the jacks of cable `c`
/// pull there differs by no more than friction holds: `H` are the derivatives of the logarithm of what that
/// leaves. False if there is no state there: then it stays. Cost: that of Tracker::adjust().
template <class Parts>
bool relinearize_held(Parts& parts, int c, const typename Parts::Values& H, typename Parts::Values values) {
  using Scalar = typename Parts::Scalar;
  const auto unequal = UnequalJacks::of(parts.jacks, c);
  const auto& belief = parts.filter.belief();
  const Scalar less = parts.jacks[unequal.less].driven.force, more = parts.jacks[unequal.more].driven.force;
  Scalar left = log_quotient(more * held_over(parts.tracker, c), less), square = 0;
  for (int p = 0; p < belief.friction(); ++p) {
    left += H[p] * (values[p] - belief.linearized_at(p));
    square += H[p] * H[p];
  }
  const Scalar inside = Scalar(1e-3);
  for (int p = 0; p < belief.friction() && left > -inside; ++p) values[p] -= H[p] * (left + inside) / square;
  return parts.filter.relinearize(parts.tracker, values);
}

/// The readings of a row, in which both jacks of cable `c` were: those of one that follows the other are
/// taken into account, Eq. (80). Not of cells with two branches: a ram that is held rests anywhere between
/// them. Cost: a few operations; one row in FollowingJack::together an update with at most four calls of
/// Tracker::adjust().
template <class Parts>
void measure_following(Parts& parts, int c) {
  using Scalar = typename Parts::Scalar;
  auto& filter = parts.filter;
  auto& jacks = parts.jacks;
  const auto pulls = jacks.pulls(c);
  if (!pulls[0] || !pulls[1] || !filter.belief().has_friction()) return parts.following[c].reject();
  const auto unequal = UnequalJacks::of(jacks, c);
  const auto& less = jacks[unequal.less];
  const auto& more = jacks[unequal.more];
  if (parts.cell(unequal.less).has_branches() || parts.cell(unequal.more).has_branches()) return;
  if (!less.is_new || !more.is_new || !(less.raw > 0) || !(more.raw > 0) || !(less.at.load > 0)) return;
  const auto part = [](Scalar sd, Scalar of) { return sd * sd / (of * of); };
  const Scalar variance = part(less.filter.sd(), less.at.load) + part(more.filter.sd(), more.at.load);
  auto& following = parts.following[c];
  if (!following.take({static_cast<int>(jacks.end(unequal.less).end), less.raw / more.raw, variance,
                       more.at.load, more.goes_on && more.rises, more.at.reversed}) ||
      parts.loads_are_in_doubt(c))
    return;
  go_back(parts);
  wait_for_none(parts);
  const auto read = following.measured();
  const Scalar lasting = part(less.lasts, less.at.load) + part(more.lasts, more.at.load),
               sd = std::sqrt(variance / static_cast<Scalar>(read.rows) + lasting);
  typename Parts::Values H;
  // What is left of the larger load, over what is read: one. An error of either is a part of it.
  const auto predict = [&](auto& prediction) {
    clear_further(filter.belief(), prediction);
    prediction.value = 1 + log_quotient(held_over(parts.tracker, c), read.quotient);
    H.fill(Scalar(0));
    add_slopes_between(parts, c, unequal, H);
    prediction.H = H;
    prediction.by_jack.fill(Scalar(0));
  };
  const auto comes_closer = [&] {
    const auto& belief = filter.belief();
    return (belief.is_nonlinear() || belief.moves_friction()) &&
           relinearize_held(parts, c, H, belief.updated_mean());
  };
  predict(filter.prediction());
  const Update update = filter.update_by(parts.tracker, comes_closer, predict, jacks.readings(filter.prior()),
                                         {Scalar(1), sd, Scalar(0)});
  if (update == Update::contradiction)
    following.reject();
  else
    note(parts, update, Parts::alarm_at(Alarm::Kind::sensor, jacks.end(unequal.less)), read.rows);
  look_ahead(parts);
}

}  // namespace taut
