// A jack whose valve is shut: its load rests while the other one pulls, and then follows it.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// Where two jacks pull at once, what they differ by is no more than friction holds. But where one rests
/// while the other goes on, and then goes on in proportion, its valve is shut and the cable slides
/// throughout: the quotient of their loads is what all friction leaves, Eq. (80). Readings of each row are
/// compared, not what they were conditioned to, so that rows are apart.
///
/// The quotient falls in proportion while one rests, and is level from where it follows: that is told by the
/// slope of a straight line through it over the load of the one that goes on, begun anew wherever it is
/// surely not level. A second pump can make it level, too, but hardly twice at the same quotient. A plain
/// value. Cost: a few operations a row.
template <class Scalar>
class FollowingJack {
 public:
  /// As many rows' quotients are taken into account together, at most.
  static constexpr int together = 8;

  /// What both were read to pull in a row.
  struct Row {
    int less;         ///< the end whose jack pulls less
    Scalar quotient;  ///< of what is read of them [-]
    Scalar variance;  ///< of that, relative to its square [-]
    Scalar load;      ///< what the other one pulls, conditioned [N]
    bool rises;       ///< that surely goes up
    bool has_turned;  ///< it has surely turned
  };

  /// Takes a row. Returns whether quotients are a measurement now, see measured().
  bool take(const Row& row) {
    const bool counts = rises_;
    rises_ = row.rises;
    if (row.less != less_ || row.has_turned || n_ == 0) {
      if (is_level_) level_at_[less_] = mean();
      fallen_ = 0;
      begin(row);
      less_ = static_cast<std::int8_t>(row.less);
      return false;
    }
    // What the reading of this row is off by must not decide on whether it counts.
    if (!counts) return follows_ && rows_ >= few;
    const Scalar further = row.load / load_ - 1, fell = 1 - row.quotient / quotient_;
    add(further, fell);
    if (rows_ == together) static_cast<void>(measured());
    sum_ += row.quotient;
    ++rows_;
    const Scalar spread = further_further_ - further_ * further_ / n_;
    if (n_ < few || !(spread > 0)) return false;
    const Scalar slope = (further_fell_ - further_ * fell_ / n_) / spread, sd = std::sqrt(variance_ / spread);
    if (std::fabs(slope) > surely * sd && (std::fabs(slope) > level || is_level_)) {
      // Where it begins to follow one line has a part of both.
      const bool rests = slope > Scalar(0.5), is_between = slope > 0 && !rests;
      if (rests)
        fallen_ += slope * further;
      else if (!is_between || is_bent_)
        fallen_ = 0;
      is_bent_ = is_between;
      begin(row);
      return false;
    }
    is_level_ |= further > far && surely * sd < level;
    // Of a pump that works as fast as the other one, and began later, it would rise by as much as it fell.
    follows_ |=
        is_level_ && fallen_ > rested * std::sqrt(variance_) && 2 * surely * sd < fallen_ && is_as_before();
    return follows_ && rows_ == together;
  }
  /// The mean quotient of how many of the last rows, which then count no more.
  struct Mean {
    Scalar quotient;
    int rows;
  };
  Mean measured() {
    const Mean mean = {sum_ / static_cast<Scalar>(rows_), rows_};
    sum_ = 0;
    rows_ = 0;
    return mean;
  }
  /// It does not follow: what it tells cannot be, or a wedge holds an end.
  void reject() { *this = {}; }

 private:
  static constexpr Scalar surely = 3, rested = 6, far = Scalar(0.05), level = Scalar(0.1),
                          alike = Scalar(0.01);
  static constexpr int few = 4;

  void begin(const Row& row) {
    load_ = row.load;
    quotient_ = row.quotient;
    variance_ = row.variance;
    further_ = fell_ = further_further_ = further_fell_ = sum_ = 0;
    n_ = 1;
    rows_ = 0;
    follows_ = is_level_ = false;
  }
  void add(Scalar further, Scalar fell) {
    further_ += further;
    fell_ += fell;
    further_further_ += further * further;
    further_fell_ += further * fell;
    n_ += 1;
  }
  Scalar mean() const { return quotient_ * (1 - fell_ / n_); }
  bool is_as_before() const { return std::fabs(mean() - level_at_[less_]) < alike * mean(); }

  Scalar load_ = 0, quotient_ = 0, variance_ = 0;  // where the line begins
  // Sums over the rows on the line: of loads and of how far quotients have fallen, as parts of the first.
  Scalar n_ = 0, further_ = 0, fell_ = 0, further_further_ = 0, further_fell_ = 0;
  Scalar fallen_ = 0;               // by how much the quotient fell before, while the other one rested
  Scalar sum_ = 0;                  // of quotients that are not measured yet
  FixedArray<Scalar, 2> level_at_;  // where it was level last, the one at either end pulling less
  std::int16_t rows_ = 0;
  std::int8_t less_ = 0;
  bool follows_ = false, is_level_ = false, is_bent_ = false, rises_ = false;
};

}  // namespace taut
