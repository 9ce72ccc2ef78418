// How far a wedge was drawn in: what the far end of its cable shows of that, and what forces are then.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/lone_outliers.hpp"
#include "taut/estimation/other_friction.hpp"
#include "taut/numerics/decay.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Draw-ins that are tried [m], evenly apart, with the forces that each leaves, and how likely each is.
template <class Scalar, int Segments>
struct DrawIns {
  static constexpr int size = 9;
  /// Beyond so many standard deviations none is tried.
  static constexpr Scalar far = 3;
  Scalar least = 0, step = 0;
  FixedArray<FixedArray<Scalar, Segments>, size> force;  ///< of segments [N]
  FixedArray<Scalar, size> weight;                       ///< their sum is one
  FixedArray<Scalar, size> away;  ///< how many standard deviations each is from the likeliest

  Scalar at(int i) const { return least + static_cast<Scalar>(i) * step; }
  void spread(Scalar from, Scalar to) {
    least = from;
    step = (to - from) / (size - 1);
  }
  Scalar mean() const {
    Scalar mean = 0;
    for (int i = 0; i < size; ++i) mean += weight[i] * at(i);
    return mean;
  }
  Scalar variance() const {
    const Scalar mean = this->mean();
    Scalar variance = 0;
    for (int i = 0; i < size; ++i) variance += weight[i] * (at(i) - mean) * (at(i) - mean);
    return larger(variance, step * step / 12);
  }
  /// Weighs them with their prior, of standard deviation `sd`, and a reading of the far end's `segment`, if
  /// there is one (variance > 0), Eq. (57). Returns the smallest square of the reading's deviation from what
  /// one of them makes of it, in variances. Cost: an exponential each.
  Scalar weigh(Scalar sd, int segment, Scalar reading, Scalar variance) {
    Scalar nearest = -1, best = 0;
    FixedArray<Scalar, size> score, spread;
    for (int i = 0; i < size; ++i) {
      const int before = i > 0 ? i - 1 : i, after = i + 1 < size ? i + 1 : i;
      // Between two of them the force goes over to that of the next.
      const Scalar wide =
                       (force[after][segment] - force[before][segment]) / static_cast<Scalar>(after - before),
                   off = reading - force[i][segment], x = at(i) / sd;
      spread[i] = variance + wide * wide / 12;
      const Scalar square = variance > 0 ? off * off / spread[i] : Scalar(0);
      if (nearest < 0 || square < nearest) nearest = square;
      score[i] = square + x * x;
      if (i == 0 || score[i] < best) best = score[i];
    }
    Scalar sum = 0;
    for (int i = 0; i < size; ++i) {
      away[i] = std::sqrt(score[i] - best);
      weight[i] = decay((score[i] - best) / 2);
      if (variance > 0) weight[i] *= std::sqrt(variance / spread[i]);
      sum += weight[i];
    }
    for (int i = 0; i < size; ++i) weight[i] /= sum;
    return nearest;
  }
  /// The standard deviation of a segment's force about the one that is shown [N], Eq. (58).
  Scalar deviation(int segment, Scalar shown) const {
    Scalar square = 0, farthest = 0;
    for (int i = 0; i < size; ++i) {
      const Scalar off = std::fabs(force[i][segment] - shown);
      square += weight[i] * off * off;
      if (away[i] >= 1 && away[i] <= far) farthest = larger(farthest, off / away[i]);
    }
    return larger(std::sqrt(square), farthest);
  }
  /// Spreads them over those that are likely. Returns whether that is much less.
  bool narrow() {
    Scalar likely = 0;
    for (int i = 0; i < size; ++i) likely = larger(likely, weight[i]);
    int first = 0, last = size - 1;
    while (first < last && weight[first] < Scalar(1e-3) * likely) ++first;
    while (last > first && weight[last] < Scalar(1e-3) * likely) --last;
    const int from = first > 0 ? first - 1 : 0, to = last + 1 < size ? last + 1 : last;
    if (to - from > size / 2 + 1) return false;
    spread(at(from), at(to));
    return true;
  }
};

/// Draws the wedge of jack `k` in by one of `all` after the other, and notes the forces of its cable;
/// friction is where it is linearized. False if there is no state at one. Cost: that of go_before_lock_off(),
/// and of seat() for each.
template <class Parts, class All>
bool try_draw_ins(Parts& parts, int k, All& all) {
  const auto& cable = parts.model().cables[parts.jacks.end(k).cable()];
  const auto values = parts.filter.belief().save().linearized_at;
  auto before = values;
  if (!go_before_lock_off(parts, before)) return false;
  auto further = drawn_further(parts, values);
  further[k] = all.least;
  for (int i = 0; i < all.size; ++i) {
    if (!seat(parts, further)) return false;
    for (int j = cable.first_segment; j < cable.first_segment + cable.segments(); ++j)
      all.force[i][j] = parts.tracker.tension(j);
    further = {};
    further[k] = all.step;
  }
  static_cast<void>(parts.filter.linearize_at(values));
  return true;
}

/// A force that the far end of a cable has been read to have, with its variance; none if that is zero.
template <class Scalar>
struct FarEndForce {
  int segment = 0;
  Scalar force = 0, variance = 0;
};

/// After the wedge of jack `k` was drawn in, in the last lock-off, which is known, by how much is not: tries
/// draw-ins that are likely, and takes their mean and variance, and those of all forces. How far joints slide
/// back is not in proportion to a draw-in, and a far end may tell only that it is less than what would reach
/// it, Eqs. (57) and (58). Contradiction if and only if no draw-in makes that of the far end which was read;
/// then nothing is learned of it. Cost: at worst five times that of try_draw_ins(), and that of lock_anew().
template <class Parts>
[[gnu::noinline]] Update weigh_draw_in(Parts& parts, int k, const FarEndForce<typename Parts::Scalar>& read) {
  using Scalar = typename Parts::Scalar;
  const auto& belief = parts.filter.belief();
  const int p = parts.jacks[k].seating, c = parts.jacks.end(k).cable();
  const Scalar sd = parts.filter.prior().seating_sd[c];
  const auto& cable = parts.model().cables[c];
  const auto here = belief.save().linearized_at;
  DrawIns<Scalar, Parts::Cap::segments> all;
  Update update = Update::updated;
  const auto fail = [&] {
    static_cast<void>(lock_anew(parts, here));
    return Update::no_information;
  };
  const auto spread_all = [&] {
    all.spread(belief.bounded(p, -all.far * sd), belief.bounded(p, all.far * sd));
  };
  spread_all();
  Scalar variance = read.variance;
  constexpr int most_passes = 4;
  for (int pass = 1;; ++pass) {
    if (!try_draw_ins(parts, k, all)) return fail();
    if (all.weigh(sd, read.segment, read.force, variance) > belief.gate) {
      update = Update::contradiction;
      variance = 0;
      spread_all();
    } else if (pass >= most_passes || !all.narrow()) {
      break;
    }
  }
  auto values = here;
  values[p] = belief.bounded(p, all.mean());
  const Scalar deviation = std::sqrt(all.variance());
  if (!lock_anew(parts, values)) return fail();
  parts.filter.know(p, values[p], deviation);
  for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
    const Scalar force = parts.tracker.tension(i), by_draw_in = all.deviation(i, force);
    const int other = parts.turned.drawn_by(i);
    if (other < 0 || other == p ||
        parts.turned.drawn_deviation(i, force, std::sqrt(belief.variance(other))) <= by_draw_in)
      parts.turned.draw(i, force, by_draw_in / deviation, p);
  }
  return update;
}

/// Whether a reading of cell `e` counts beside those since the last lock-off, `read`: one that is far off
/// them, or the first off what is expected, may be wrong; two in a row are not, and what was read before is
/// no more. Cost: that of FarEnds::expect() for the first, else a few operations.
template <class Parts>
bool counts_as_read(Parts& parts, typename Parts::LockOff::Read& read, int e,
                    typename Parts::Scalar reading) {
  using Scalar = typename Parts::Scalar;
  constexpr Scalar far = LoneOutliers<Scalar>::outlier;
  const bool was_elsewhere = read.is_elsewhere;
  if (read.readings > 0) {
    const auto& watch = parts.far_ends.watch(e);
    const Scalar off = reading - read.sum / static_cast<Scalar>(read.readings);
    read.is_elsewhere = std::fabs(off) > far * (watch.sd + watch.lasts);
  } else {
    const auto expected = parts.far_ends.expect(e, parts.tracker, parts.filter, parts.jacks);
    read.is_elsewhere = std::fabs(reading - expected.value) > far * std::sqrt(expected.variance);
  }
  if (!read.is_elsewhere) return true;
  if (was_elsewhere) read = {};
  return was_elsewhere;
}

/// Readings of the cell at the far end of a cable that jack `k` has locked, in the last lock-off, which is
/// known: once there are one, two, four and so on, they tell how far its wedge was drawn in. One that is far
/// off alone is left out. Cost: a few operations, or those of weigh_draw_in() and try_other_friction().
template <class Parts>
[[gnu::noinline]] Update learn_draw_in(Parts& parts, int k, int e, typename Parts::Scalar reading) {
  using Scalar = typename Parts::Scalar;
  constexpr int most = 64;
  const int p = parts.jacks[k].seating, c = parts.jacks.end(k).cable();
  auto& read = parts.lock_off.read[c];
  if (read.readings == most || !counts_as_read(parts, read, e, reading)) return Update::no_information;
  const int n = read.readings + 1;
  read.readings = static_cast<std::int16_t>(n);
  read.sum += reading;
  if ((n & (n - 1)) != 0) return Update::waits;
  const int segment = parts.far_ends.ends()[e].segment(parts.model());
  // What drifts is not in what is tried.
  const auto here = parts.filter.belief().save().linearized_at;
  auto values = parts.lock_off.linearized_at;
  for_each_of_lock_off(parts, [&](int other) {
    if (const int q = parts.jacks[other].seating; q >= 0) values[q] = here[q];
    if (const int drift = parts.drift[parts.jacks.end(other).cable()]; drift >= 0) values[drift] = 0;
  });
  if (!lock_anew(parts, values)) {
    static_cast<void>(lock_anew(parts, here));
    return Update::no_information;
  }
  const auto expected = parts.far_ends.expect_without(p, e, n, parts.tracker, parts.filter, parts.jacks);
  const Scalar off = read.sum / static_cast<Scalar>(n) - expected.value;
  const Update update = weigh_draw_in(
      parts, k, FarEndForce<Scalar>{segment, parts.tracker.tension(segment) + off, expected.variance});
  try_other_friction(parts, c);
  return update;
}

/// What derivatives do not tell of the last lock-off, which is known. Cost: that of try_other_friction() a
/// cable, and of weigh_draw_in() a jack.
template <class Parts>
[[gnu::noinline]] void try_others(Parts& parts) {
  for (int c = 0; c < parts.model().cables.size(); ++c) {
    bool is_locked = false;
    for_each_of_lock_off(parts, [&](int k) { is_locked |= parts.jacks.end(k).cable() == c; });
    if (is_locked) try_other_friction(parts, c);
  }
  if constexpr (Parts::has_seating)
    for_each_of_lock_off(parts, [&](int k) {
      if (parts.jacks[k].seating >= 0)
        static_cast<void>(
            weigh_draw_in(parts, k, FarEndForce<typename Parts::Scalar>{parts.end_segment(k), 0, 0}));
    });
}

}  // namespace taut
