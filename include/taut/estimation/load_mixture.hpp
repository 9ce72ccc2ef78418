// Several hypotheses together: the estimate that they give, and which one goes for want of room.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/load_filter_tuning.hpp"
#include "taut/estimation/load_hypotheses.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// A level and its standard deviation.
struct LoadEstimate {
  LoadFilterTuning::Level level, sd;
};

/// The hypothesis of a long hold, or -1. It is left only when hardly anything speaks for it any more. `all`
/// is the sum of the weights. Cost: a few operations.
template <class Level, int Capacity>
int long_hold(const LoadHypotheses<Level, Capacity>& hypotheses, Level all) {
  using Tuning = LoadFilterTuning;
  const int oldest = hypotheses.place(0);
  const bool holds = hypotheses.at(hypotheses.run_length, oldest) >= Tuning::long_run &&
                     hypotheses.at(hypotheses.weight, oldest) > Tuning::patience * all &&
                     !hypotheses.has_slope(oldest, Tuning::creeps);
  return holds ? oldest : -1;
}

/// Mean and spread of the hypotheses about the best one, or about that of a long hold. `all` is the sum of
/// the weights. Cost: a few operations a hypothesis and one root.
template <class Level, int Capacity>
LoadEstimate estimate_load(const LoadHypotheses<Level, Capacity>& hypotheses, int best, Level all) {
  using Hypotheses = LoadHypotheses<Level, Capacity>;
  const int hold = long_hold(hypotheses, all);
  const Level from = Hypotheses::at(hypotheses.level, hold < 0 ? best : hold);
  // Side by side, then in a row: sums have an order.
  typename Hypotheses::Lanes weights, means, squares;
  for (std::size_t i = 0; i < Hypotheses::capacity; ++i) {
    const Level d = hypotheses.level[i] - from;
    const Level given = hypotheses.weight[i],
                weight = std::fabs(d) > LoadFilterTuning::apart ? Level(0) : given;
    weights[i] = weight;
    means[i] = weight * d;
    squares[i] = weight * (d * d + hypotheses.level_variance[i]);
  }
  Level total = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < Hypotheses::capacity; ++i) {
    total += weights[i];
    mean += means[i];
    square += squares[i];
  }
  const Level unit = 1 / total;
  if (hold >= 0) return {from, std::sqrt(square * unit)};
  mean *= unit;
  return {from + mean, std::sqrt(larger(square * unit - mean * mean, Level(0)))};
}

/// The rank of the older one of the two neighbours whose run lengths are most alike, when there is no room.
/// Cost: a few operations a hypothesis.
template <class Level, int Capacity>
int most_alike(const LoadHypotheses<Level, Capacity>& hypotheses) {
  using Hypotheses = LoadHypotheses<Level, Capacity>;
  constexpr int longest = LoadFilterTuning::long_run;
  typename Hypotheses::Counts length;
  for (int k = 0; k < Capacity; ++k) {
    const std::int32_t samples = Hypotheses::at(hypotheses.run_length, hypotheses.place(k));
    Hypotheses::at(length, k) = samples < longest ? samples : longest;
  }
  const auto of = [&](int k) { return Hypotheses::at(length, k); };
  int found = 0;
  for (int k = 1; k + 1 < Capacity; ++k)
    if (of(k) * of(found + 1) <= of(found) * of(k + 1)) found = k;
  return found;
}

/// Makes room for one more hypothesis. If there is none, what contributes nothing goes, or the less likely of
/// the two whose run lengths are most alike, where `surprises` with the reading `y` that comes. The other one
/// takes its weight, and its spread: but a long hold must not become uncertain by what does not last. Cost: a
/// few operations a hypothesis and two densities.
template <class Level, int Capacity>
void make_room(LoadHypotheses<Level, Capacity>& hypotheses, bool surprises, Level y) {
  using Hypotheses = LoadHypotheses<Level, Capacity>;
  using Tuning = LoadFilterTuning;
  if (hypotheses.size < Capacity) return;
  int least = 0;
  for (int k = 1; k < Capacity; ++k)
    if (hypotheses.weight_of(k) < hypotheses.weight_of(least)) least = k;
  if (hypotheses.weight_of(least) < Tuning::neglected) return hypotheses.drop(least);
  const int rank = most_alike(hypotheses), older = hypotheses.place(rank),
            younger = hypotheses.place(rank + 1);
  const auto likely = [&](int i) {
    return Hypotheses::at(hypotheses.weight, i) * (surprises ? hypotheses.density(i, y) : Level(1));
  };
  const bool keeps_older = likely(older) > likely(younger);
  const int gone = keeps_older ? younger : older, kept = keeps_older ? older : younger;
  const Level d = Hypotheses::at(hypotheses.level, gone) - Hypotheses::at(hypotheses.level, kept);
  if (std::fabs(d) < Tuning::apart / 2) {
    const Level more = Hypotheses::at(hypotheses.weight, gone);
    Hypotheses::at(hypotheses.weight, kept) += more;
    if (Hypotheses::at(hypotheses.run_length, kept) < Tuning::long_run)
      Hypotheses::at(hypotheses.level_variance, kept) +=
          more / Hypotheses::at(hypotheses.weight, kept) * d * d;
  }
  hypotheses.drop(keeps_older ? rank + 1 : rank);
}

}  // namespace taut
