// What LoadFilter takes for granted of loads, readings and times: every constant, and what it is for.
#pragma once

#include <cstdint>

#include "taut/estimation/load_hypotheses.hpp"

namespace taut {

/// Levels are forces in standard deviations of a reading, "samples" are readings. What is known of outliers
/// is in LoadHypotheses.
struct LoadFilterTuning {
  /// Single precision is enough: levels are counted from near the load, see LoadFilter::move_base().
  using Level = float;
  using Hypotheses = LoadHypotheses<Level, 4>;

  // The path of the load: how often it bends and jumps, and how much.

  /// The hazard of a change: the odds that a piece ends now are 1 in its run length and this. Pieces of every
  /// length are as likely.
  static constexpr Level least_length = 15;
  /// Of the changes so many are bends, where a reading surprises and where none does, and so many jumps.
  static constexpr Level bends = Level(0.8), quiet_bends = Level(0.4), jumps = Level(0.002);
  /// Changes of slope to be expected, per sample: the slope itself, but at least the first, or the second
  /// where a reading is that far off.
  static constexpr Level gentle_bend = Level(0.15), steep_bend = 3;
  /// Standard deviation of the slope after a jump, per sample: nothing is known of it.
  static constexpr Level slope_after_jump = 10;
  /// Squares of an innovation, in its variances: beyond the one a steep bend explains it better than a gentle
  /// one, beyond the other, which counts the bend's, a jump better than a bend.
  static constexpr Level gentle = Level(2.6), farthest_bend = 20;
  /// How far a jump is expected to lead, at least: readings that near have the clutter density.
  static constexpr Level least_jump = Level(0.4) / Hypotheses::clutter_density;

  // When a hypothesis begins, and which one goes.

  /// Samples from one new hypothesis to the next: where nothing surprises, it does not matter where exactly
  /// one begins.
  static constexpr std::int8_t pause = 3;
  /// Samples from one to the next while readings wait: nothing has surprised then.
  static constexpr std::int8_t long_pause = 24;
  /// A reading farther off than so many standard deviations surprises: a hypothesis begins at once.
  static constexpr Level surprise = 2;
  /// For readings that wait: the square of their drift, in its variances.
  static constexpr Level suspicious = Level(0.5);
  /// Run lengths beyond this are as good as one another.
  static constexpr int long_run = 1024;
  /// A weight that contributes nothing: such a hypothesis goes first.
  static constexpr Level neglected = Level(1e-9);
  /// No weight falls below this: it could not recover from zero.
  static constexpr Level least_weight = Level(1e-30);
  /// Levels farther apart than this tell different stories: their mean tells none.
  static constexpr Level apart = 6;

  // A long hold is not left by chance: among a million readings some look like a bend.

  /// Weight of its hypothesis that is enough to stay with it.
  static constexpr Level patience = Level(1e-4);
  /// Its slope is one of a load that creeps, not of chance, beyond so many standard deviations.
  static constexpr Level creeps = 5;

  // Readings that wait.

  /// Samples without surprise after which readings wait.
  static constexpr std::int8_t calm_enough = 4;
  /// Their drift, in its standard deviations, beyond which they do not agree with the line.
  static constexpr Level disagree = Level(2.4);
  /// The innovation of the last one, in its standard deviations, beyond which it does not fit.
  static constexpr Level doubt = 3;
  /// Where they drift off, so many of the last ones are not what the line explains.
  static constexpr int doubtful = 8;
  /// After that readings wait again at once if a hypothesis of this weight and run length is left: it was by
  /// chance.
  static constexpr Level by_far = Level(0.8);
  static constexpr int long_ago = 32;
  // Readings that drift off may be the first of a new piece.

  /// How far they drift off beyond what is by chance counts as deviation too, by this part, but not beyond
  /// the widest one; of a line older than `young` by less, in proportion.
  static constexpr Level by_chance = 2, perhaps_bent = Level(0.8), widest = Level(1.2);
  static constexpr int young = 300;

  /// That a load rests is so many times as likely as that it goes on or comes back; and by how much it goes
  /// then: by about so much, or as it has.
  static constexpr Level rests = 2, least_gone = 2;

  // Times without readings.

  /// A step so many times as long as the one before, or longer, is a gap.
  static constexpr Level gap = 4;
  /// Odds that the load went on after a gap somewhere else than it was held, and not on the line's way
  /// either.
  static constexpr Level elsewhere = Level(0.02);
  /// Variance of a line across a gap that leaves too few digits.
  static constexpr Level vague = Level(1e4);
  /// Times beyond these are taken for the nearer end, or for none: their squares stay finite.
  static constexpr Level shortest = Level(1e-15), longest = Level(1e15);
  /// What is farther is no reading, and its square overflows.
  static constexpr Level farthest = Level(1e9);

  // How many standard deviations confirm what the load has done.

  /// That it has come so far, by the estimate.
  static constexpr Level confirm_load = Level(3.3);
  /// By a mean of readings: that of few is tried a million times in a long hold.
  static constexpr Level confirm_mean = 5;
  /// That it has reversed: a wrong reversal is remembered by friction.
  static constexpr Level confirm_reversal = 5;
  /// That a line has a slope, so that a load on its way back came farthest before, and by how much.
  static constexpr Level confirm_slope = 3, left_behind = 3;
};

}  // namespace taut
