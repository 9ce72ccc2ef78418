// How far forces are off their targets, and where on a straight line they are nearest.
#pragma once

#include <cmath>
#include <limits>

namespace taut {

/// The largest |T_i - target_i| / target_i of Eq. (49) over the n segments that have a target (greater than
/// zero) [-]. Both arrays have n entries [N]. Cost: O(n).
template <class Scalar>
Scalar off_target(const Scalar* tension, const Scalar* target, int n) {
  Scalar most = 0;
  for (int i = 0; i < n; ++i) {
    if (!(target[i] > 0)) continue;
    const Scalar off = std::fabs(tension[i] - target[i]) / target[i];
    if (off > most) most = off;
  }
  return most;
}

/// A place on the way from one state (part 0) to another (part 1), and how near to the targets it is.
template <class Scalar>
struct NearestPart {
  Scalar part = 0;
  Scalar error = 0;  ///< off_target() there
};

namespace detail {

// The largest of the lines |T_i - target_i| / target_i at one place, and its slope: among equals the one that
// is largest on the way there.
template <class Scalar>
struct TopLine {
  Scalar value = -1, slope = 0;

  TopLine(const Scalar* from, const Scalar* to, const Scalar* target, int n, Scalar part, Scalar way) {
    for (int i = 0; i < n; ++i) {
      if (!(target[i] > 0)) continue;
      const Scalar rate = (to[i] - from[i]) / target[i];
      const Scalar off = (from[i] - target[i]) / target[i] + part * rate;
      const Scalar here = std::fabs(off), grows = off < 0 || (off == 0 && way * rate < 0) ? -rate : rate;
      if (!(here > value || (here == value && way * grows > way * slope))) continue;
      value = here;
      slope = grows;
    }
  }
};

}  // namespace detail

/// Where forces are nearest to their targets between two states of n tensions [N], between `least_part` and
/// `most_part` of the way, all being linear: the lowest vertex of the largest of the lines, Eq. (50), exact
/// but for rounding. Cost: O(n) a vertex that is looked at, at most 2 n + 3 of them; most often three.
template <class Scalar>
NearestPart<Scalar> nearest_part(const Scalar* from, const Scalar* to, const Scalar* target, int n,
                                 Scalar least_part = 0, Scalar most_part = 1) {
  using Top = detail::TopLine<Scalar>;
  constexpr Scalar just_above = 1 + 4 * std::numeric_limits<Scalar>::epsilon();
  Scalar left = least_part, right = most_part;
  Top falling(from, to, target, n, left, Scalar(1)), rising(from, to, target, n, right, Scalar(-1));
  if (falling.slope >= 0 || right <= left) return {left, falling.value};
  if (rising.slope <= 0) return {right, rising.value};
  // Every round finds a line that was not there before.
  for (int round = 0; round <= 2 * n; ++round) {
    const Scalar at = (rising.value - falling.value + falling.slope * left - rising.slope * right) /
                      (falling.slope - rising.slope);
    if (!(at > left && at < right)) break;
    const Top middle(from, to, target, n, at, Scalar(1));
    const Scalar bound = falling.value + falling.slope * (at - left);
    if (middle.value <= bound * just_above || middle.slope == 0) return {at, middle.value};
    Top& same_way = middle.slope < 0 ? falling : rising;
    (middle.slope < 0 ? left : right) = at;
    same_way = middle;
  }
  if (falling.value <= rising.value) return {left, falling.value};
  return {right, rising.value};
}

}  // namespace taut
