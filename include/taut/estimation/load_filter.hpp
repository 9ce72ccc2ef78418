// The true load behind the noisy readings of a jack's load cell, fit for a model with friction.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/load_block.hpp"
#include "taut/estimation/load_lines.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// What is known of the load once a reading has been taken. No force is below zero.
template <class Scalar>
struct ConditionedLoad {
  Scalar load = 0;       ///< best estimate of the true load at this sample [N]
  Scalar sd = 0;         ///< its standard deviation [N]
  Scalar sure = 0;       ///< how far the load has surely come [N]; between two turns it moves one way only
  bool turned = false;   ///< the load has turned since the sample before: the model goes to `turn` first
  Scalar turn = 0;       ///< best estimate of where [N], if it has
  bool refused = false;  ///< the reading was taken for an outlier
};

/// Friction remembers every peak, those of noise too: fed with raw readings, a model is dragged along by
/// them. This filter tells what the load surely did (`sure`, `turned`) from where it probably is (`load`).
///
/// The load is taken for a line in time that bends or jumps now and then. Readings scatter about it,
/// independent and Gaussian; some are outliers. A few lines compete, each begun at another sample; their
/// weights are the probabilities that the present piece of the path began there, and `load` and `sd` their
/// mean and spread. A new line is weighed at every third sample, and at every one that surprises; as there is
/// room for few, the young ones are kept closer together.
///
/// As long as the readings agree with the likeliest line, up to eight of them wait until they are weighed as
/// one: their mean. Meanwhile that line alone follows them. Where one does not agree, those that wait are
/// weighed one by one after all.
///
/// `sure` asks for more than a line, which overshoots where a ramp ends: a load that rises is now at least as
/// high as the mean of any readings since it turned.
///
/// A plain value that may be stored and read back byte by byte. Computed with + - * / and square roots alone,
/// for the same bits on every machine.
template <class Scalar>
class LoadFilter {
 public:
  /// Forgets everything; the load is taken to have come up from zero. `sd` is the standard deviation of a
  /// reading [N], with quantisation (step / sqrt(12)). Zero: readings are exact.
  void start(Scalar sd) {
    *this = LoadFilter();
    sd_ = sd > 0 ? sd : Scalar(0);
    per_sd_ = sd_ > 0 ? 1 / sd_ : Scalar(0);
  }

  /// Takes the next reading [N], `dt` > 0 after the one before, in any unit of time; for the first it is of
  /// no account. What is not finite is refused.
  ConditionedLoad<Scalar> take(Scalar reading, Scalar dt) {
    if (sd_ == 0) return take_exact(reading);
    const Scalar step = dt > 0 && std::isfinite(dt) ? dt : Scalar(0);
    return may_wait() ? wait(reading, step) : take_one(reading, step);
  }

 private:
  // Forces of lines are in standard deviations of a reading, from `base_`; densities are those of such
  // readings.

  using Lines = LoadLines<Scalar, 4>;
  using Block = LoadBlock<Scalar, 8>;
  static constexpr Scalar farthest =
      Scalar(1e9);  ///< what is farther is no reading, and its square overflows

  struct Estimate {
    Scalar level, sd;
  };

  /// `step` is the time since the reading before, or zero if that is not known.
  ConditionedLoad<Scalar> take_one(Scalar reading, Scalar step) {
    const Scalar y = level_of(reading);
    const bool usable = std::fabs(y) < farthest;
    if (lines_.size == 0) return begin_anew(usable, reading);
    step_ = step;
    lines_.forget(1);
    const int newest = lines_.place(lines_.size - 1);
    const bool has_no_slope = !(step > 0) || (best_ == newest && is_new(newest));
    // Only now is it known what a sample is in time.
    if (is_new(newest) && step > 0)
      at(lines_.slope_variance, newest) = slope_after_jump / step * (slope_after_jump / step);
    lines_.advance(step);
    // After so long a time nothing is known any more.
    if (!(at(lines_.level_variance, best_) < farthest)) return begin_anew(usable, reading);
    if (!usable) return conclude(false, 1, y);
    const bool surprises = is_surprise(y);
    ++since_birth_;
    calm_ = static_cast<std::int8_t>(surprises ? 0 : calm_ < calm_enough ? calm_ + 1 : calm_);
    // Where nothing surprises, where exactly a line begins is of no account.
    if (since_birth_ >= pause || surprises) begin_line({surprises, has_no_slope}, step, step, y, Scalar(1));
    lines_.weigh(y, 1);
    const Scalar total = find_best();
    return conclude(at(lines_.strays, best_) == 0, total, y);
  }

  // Readings that wait.

  /// What is young may soon be disproved.
  bool may_wait() {
    if (calm_ < calm_enough) return false;
    if (block_.size == 0) {
      const int hold = long_hold(1);
      if (hold >= 0 && hold != best_) return false;
      block_.begin(at(lines_.weight, best_) < Scalar(0.5) ? 0 : at(lines_.age, best_) / 4);
      sure_before_ = sure_;
    }
    return block_.room > 1;
  }
  ConditionedLoad<Scalar> wait(Scalar reading, Scalar step) {
    const Scalar y = level_of(reading);
    block_.add(reading, step, y);
    const auto fit = block_.fit(line(best_), y);
    const Estimate estimate = estimate_load(fit);
    const bool is_even = 2 * step > step_ && step < 2 * step_;
    // Not a number does not agree either.
    const bool agrees = fit.off * fit.off < disagree * disagree * fit.spread &&
                        fit.last_off * fit.last_off < doubt * doubt * fit.last_spread;
    if (!agrees || !is_even || has_turned(estimate)) return take_one_by_one();
    if (block_.is_full()) return take_together(y);
    const Scalar share = block_.share();
    go_on(estimate, [&](Scalar way) {
      return larger(way * y - sure_mean, way * (block_.sum * share) - sure_mean * std::sqrt(share));
    });
    return said(estimate);
  }
  /// The readings that wait, and their mean as one; the last of them is `y`.
  ConditionedLoad<Scalar> take_together(Scalar y) {
    const Scalar share = block_.share(), middle = block_.times * share, mean = block_.sum * share;
    const int count = block_.size;
    block_.size = 0;
    step_ = block_.span * share;
    since_birth_ = static_cast<std::int8_t>(since_birth_ + count);
    lines_.forget(count);
    lines_.advance(middle);
    begin_line({false, false}, step_, middle, mean, share);
    lines_.weigh(mean, count);
    lines_.advance(block_.span - middle);
    return conclude(true, find_best(), y);
  }
  /// What has been told of them in the meantime stands: `sure` does not go back, but for a turn.
  ConditionedLoad<Scalar> take_one_by_one() {
    const Scalar told = sure_;
    const bool fell = falls_;
    sure_ = sure_before_;
    const int count = block_.size;
    block_.size = 0;
    ConditionedLoad<Scalar> now;
    Scalar turn = 0;
    for (int i = 0; i < count; ++i) {
      now = take_one(at(block_.reading, i), at(block_.step, i));
      if (now.turned) turn = now.turn;
    }
    calm_ = 0;
    now.turned = falls_ != fell;
    if (now.turned)
      now.turn = fell ? -larger(-turn, -told) : larger(turn, told);
    else if (now.refused || ahead(sure_, told) > 0)
      sure_ = told;
    now.sure = sure_;
    return now;
  }

  /// Lines that began longer ago than this are as good as one another.
  static constexpr int old_age = 1024;
  /// Samples from one new line to the next, but for readings that surprise: by so many standard deviations.
  static constexpr std::int8_t pause = 3;
  static constexpr Scalar surprise = 2;
  /// Readings wait after so many without surprise, until the mean of them disagrees or the last one is in
  /// doubt.
  static constexpr std::int8_t calm_enough = 4;
  static constexpr Scalar disagree = Scalar(2.0), doubt = Scalar(2.6);
  /// As long as a line is young, it may have bent if their mean is off by more than by chance: so much of
  /// that square is believed.
  static constexpr Scalar perhaps_bent = Scalar(0.25);
  static constexpr int young = 50;

  /// The odds that a piece ends now are 1 in its age and this: pieces of every length are as likely.
  static constexpr Scalar least_length = 15;
  static constexpr Scalar bends = Scalar(0.8), jumps = Scalar(0.002);
  /// Changes of slope to be expected, per sample; in between the better of the two will do.
  static constexpr Scalar gentle_bend = Scalar(0.15), steep_bend = 3;
  static constexpr Scalar slope_after_jump = 10;
  /// Squares, in variances of a reading: beyond the one a steep bend explains it better than a gentle one,
  /// beyond the other, which counts the bend's, a jump better than a bend.
  static constexpr Scalar gentle = Scalar(2.6), farthest_bend = 20;
  /// How far a jump is expected to lead, at least: readings that near have the density `anywhere`.
  static constexpr Scalar least_jump = Scalar(0.4) / Lines::anywhere;

  static constexpr Scalar neglected = Scalar(1e-9), least_weight = Scalar(1e-30);
  static constexpr Scalar patience = Scalar(1e-4);  ///< weight of a long hold that is enough
  /// A long hold among a million samples has a slope by chance now and then.
  static constexpr Scalar creeps = 5;
  /// Lines farther apart than this tell different stories: their mean tells none.
  static constexpr Scalar apart = 6;

  // How many standard deviations make sure. The mean of few readings is tried a million times in a long hold.
  static constexpr Scalar sure_load = Scalar(3.3), sure_mean = 5, sure_turn = 5;
  static constexpr Scalar sure_slope = 3, left_behind = 3;

  template <class Array>
  static auto& at(Array& array, int i) {
    return Lines::at(array, i);
  }
  bool is_new(int i) const { return at(lines_.age, i) == 1 && at(lines_.known, i) == 1; }
  Scalar level_of(Scalar reading) const { return (reading - base_) * per_sd_; }
  LineState<Scalar> line(int i) const {
    return {at(lines_.level, i), at(lines_.slope, i), at(lines_.level_variance, i), at(lines_.covariance, i),
            at(lines_.slope_variance, i)};
  }
  Scalar force(Scalar level) const {
    const Scalar newtons = base_ + level * sd_;
    return newtons > 0 ? newtons : Scalar(0);
  }
  /// Positive if `b` lies beyond `a` as the load goes at present.
  Scalar ahead(Scalar a, Scalar b) const { return falls_ ? a - b : b - a; }

  ConditionedLoad<Scalar> take_exact(Scalar reading) {
    if (!std::isfinite(reading)) return refuse();
    const Scalar load = reading > 0 ? reading : Scalar(0);
    ConditionedLoad<Scalar> now;
    if (ahead(sure_, load) < 0) {
      now.turned = true;
      now.turn = sure_;
      falls_ = !falls_;
    }
    now.load = now.sure = sure_ = load;
    return now;
  }

  ConditionedLoad<Scalar> begin_anew(bool usable, Scalar reading) {
    lines_.clear();
    calm_ = 0;
    if (!usable) return refuse();
    base_ = reading;
    const int first = lines_.add();
    at(lines_.level_variance, first) = at(lines_.weight, first) = 1;
    at(lines_.age, first) = at(lines_.known, first) = 1;
    best_ = static_cast<std::int8_t>(first);
    return conclude(true, 1, 0);
  }

  ConditionedLoad<Scalar> refuse() const {
    ConditionedLoad<Scalar> now;
    now.load = now.sure = sure_;
    now.sd = sd_;
    now.refused = true;
    return now;
  }

  bool is_surprise(Scalar y) const {
    const Scalar r = y - at(lines_.level, best_);
    return r * r > surprise * surprise * (at(lines_.level_variance, best_) + 1);
  }
  struct Why {
    bool surprises, has_no_slope;
  };
  /// A line that began `since` ago, by a bend of what was the best line until then, or by a jump: where the
  /// reading `y`, with this variance, is expected from there. The lines are at this sample, but have not
  /// taken it yet; samples are `dt` apart.
  void begin_line(Why why, Scalar dt, Scalar since, Scalar y, Scalar noise) {
    const Scalar odds = static_cast<Scalar>(since_birth_) * at(lines_.weight, best_) /
                        (static_cast<Scalar>(at(lines_.age, best_)) + least_length);
    since_birth_ = 0;
    const Scalar come = corner(since), level = at(lines_.level, best_), slope = at(lines_.slope, best_);
    const Scalar level_variance = at(lines_.level_variance, best_), covariance = at(lines_.covariance, best_);
    const Scalar slope_variance = at(lines_.slope_variance, best_);
    const std::int32_t known = at(lines_.known, best_);
    make_room(why.surprises, y);
    const int born = lines_.add();
    const Scalar square = (y - level) * (y - level), variance = level_variance + noise;
    const bool is_jump = why.has_no_slope || square > farthest_bend * (variance + steep_bend * steep_bend);
    const Scalar jump = larger(square, least_jump * least_jump);
    const Scalar bend = square > gentle * variance ? steep_bend : gentle_bend, change = bend / dt;
    const Scalar bent = change * since;
    at(lines_.level, born) = level;
    at(lines_.slope, born) = is_jump ? Scalar(0) : slope;
    at(lines_.level_variance, born) = is_jump ? jump : level_variance + bent * bent;
    at(lines_.covariance, born) = is_jump ? Scalar(0) : covariance + bent * change;
    at(lines_.slope_variance, born) = is_jump ? Scalar(0) : slope_variance + change * change;
    at(lines_.weight, born) = odds * (is_jump ? jumps : bends);
    at(lines_.corner, born) = come;
    at(lines_.mean, born) = 0;
    at(lines_.age, born) = at(lines_.strays, born) = 0;
    // Else a jump that bends at once were taken for a new one.
    at(lines_.known, born) = is_jump ? 0 : known < 2 ? 2 : known;
  }
  /// The farthest that the load had come `since` ago, as the best line has it. A load that is already on its
  /// way back came farthest before that.
  Scalar corner(Scalar since) const {
    const Scalar last = reached(since), before = at(lines_.corner, best_);
    const bool returns = lines_.has_slope(best_, sure_slope) && ahead(0, at(lines_.slope, best_)) < 0;
    return returns && ahead(last, before) > left_behind ? before : last;
  }
  /// Where the load had come at the last reading that the best line believed. In a hold its slope is known to
  /// be zero, which halves the scatter.
  Scalar reached(Scalar since) const {
    const Scalar level = at(lines_.level, best_), slope = at(lines_.slope, best_);
    const Scalar slope_variance = at(lines_.slope_variance, best_);
    if (!lines_.has_slope(best_, sure_slope) && slope_variance > 0)
      return level - at(lines_.covariance, best_) / slope_variance * slope;
    return level - (static_cast<Scalar>(at(lines_.strays, best_)) * step_ + since) * slope;
  }

  /// If there is none, what contributes nothing goes, or the less likely of the two lines whose ages are most
  /// alike, at a surprise with the reading that comes. The other one takes its weight, and its spread: but a
  /// long hold must not become uncertain by what does not last.
  void make_room(bool surprises, Scalar y) {
    if (lines_.size < Lines::capacity) return;
    int least = 0;
    for (int k = 1; k < Lines::capacity; ++k)
      if (lines_.weight_of(k) < lines_.weight_of(least)) least = k;
    if (lines_.weight_of(least) < neglected) return lines_.drop(least);
    const int rank = most_alike(), older = lines_.place(rank), younger = lines_.place(rank + 1);
    const auto likely = [&](int i) {
      return at(lines_.weight, i) * (surprises ? lines_.density(i, y) : Scalar(1));
    };
    const bool keeps_older = likely(older) > likely(younger);
    const int gone = keeps_older ? younger : older, kept = keeps_older ? older : younger;
    const Scalar d = at(lines_.level, gone) - at(lines_.level, kept);
    if (std::fabs(d) < apart / 2) {
      const Scalar more = at(lines_.weight, gone);
      at(lines_.weight, kept) += more;
      if (at(lines_.age, kept) < old_age)
        at(lines_.level_variance, kept) += more / at(lines_.weight, kept) * d * d;
    }
    lines_.drop(keeps_older ? rank + 1 : rank);
  }
  /// The rank of the older one of the pair, when there is no room.
  int most_alike() const {
    typename Lines::Counts age;
    for (int k = 0; k < Lines::capacity; ++k) {
      const std::int32_t samples = at(lines_.age, lines_.place(k));
      at(age, k) = samples < old_age ? samples : old_age;
    }
    int found = 0;
    for (int k = 1; k + 1 < Lines::capacity; ++k)
      if (at(age, k) * at(age, found + 1) <= at(age, found) * at(age, k + 1)) found = k;
    return found;
  }

  /// Returns the sum of the weights: what surprises the others is explained by the newest line.
  Scalar find_best() {
    Scalar total = 0, most = -1;
    for (int i = 0; i < Lines::capacity; ++i) {
      const Scalar weight = at(lines_.weight, i);
      total += weight;
      if (weight > most) {
        most = weight;
        best_ = static_cast<std::int8_t>(i);
      }
    }
    return total;
  }

  /// `total` is the sum of the weights; it becomes one.
  ConditionedLoad<Scalar> conclude(bool accepted, Scalar total, Scalar y) {
    const Estimate estimate = estimate_load(total);
    const Scalar unit = 1 / total;
    for (Scalar& weight : lines_.weight) weight = larger(least_weight, weight * unit);
    off_best_ = estimate.level - at(lines_.level, best_);
    beside_best_ = estimate.sd * estimate.sd - at(lines_.level_variance, best_);
    ConditionedLoad<Scalar> now = said(estimate);
    now.refused = !accepted;
    if (accepted) {
      if (has_turned(estimate)) turn_round(now);
      go_on(estimate, [&](Scalar way) { return least_mean(estimate, way, y); });
    }
    now.sure = sure_;
    move_base();
    return now;
  }
  ConditionedLoad<Scalar> said(const Estimate& estimate) const {
    ConditionedLoad<Scalar> now;
    now.load = force(estimate.level);
    now.sd = estimate.sd * sd_;
    now.sure = sure_;
    return now;
  }
  bool has_turned(const Estimate& estimate) const {
    return ahead(estimate.level, level_of(sure_)) > sure_turn * estimate.sd;
  }
  /// While readings wait.
  Estimate estimate_load(const typename Block::Fit& fit) const {
    Scalar variance = fit.variance + beside_best_;
    if (at(lines_.age, best_) < young)
      variance += perhaps_bent * larger(fit.off * fit.off - fit.spread, Scalar(0));
    return {fit.level + off_best_, std::sqrt(larger(variance, Scalar(0)))};
  }
  /// The line of a long hold, or -1. It is left only when hardly anything speaks for it any more: among a
  /// million readings there are some that look like a bend. `all` is the sum of the weights.
  int long_hold(Scalar all) const {
    const int oldest = lines_.place(0);
    const bool holds = at(lines_.age, oldest) >= old_age && at(lines_.weight, oldest) > patience * all &&
                       !lines_.has_slope(oldest, creeps);
    return holds ? oldest : -1;
  }
  /// About the best line, or that of a long hold.
  Estimate estimate_load(Scalar all) const {
    const int hold = long_hold(all);
    const Scalar from = at(lines_.level, hold < 0 ? best_ : hold);
    Scalar total = 0, mean = 0, square = 0;
    for (int i = 0; i < Lines::capacity; ++i) {
      const Scalar d = at(lines_.level, i) - from;
      const Scalar weight = std::fabs(d) > apart ? Scalar(0) : at(lines_.weight, i);
      total += weight;
      mean += weight * d;
      square += weight * (d * d + at(lines_.level_variance, i));
    }
    const Scalar unit = 1 / total;
    if (hold >= 0) return {from, std::sqrt(square * unit)};
    mean *= unit;
    return {from + mean, std::sqrt(square * unit - mean * mean)};
  }
  void turn_round(ConditionedLoad<Scalar>& now) {
    const Scalar corner = force(at(lines_.corner, best_));
    if (ahead(sure_, corner) > 0) sure_ = corner;
    now.turned = true;
    now.turn = sure_;
    falls_ = !falls_;
    calm_ = 0;
    // The means of older lines are from before the turn.
    for (int k = 1; k < Lines::capacity && lines_.place(0) != best_; ++k) lines_.drop(0);
  }
  /// `least(way)` is what the load surely is by means of readings, times the way that it goes.
  template <class Least>
  void go_on(const Estimate& estimate, const Least& least) {
    const Scalar way = falls_ ? Scalar(-1) : Scalar(1);
    const Scalar most = way * estimate.level - sure_load * estimate.sd;
    if (!(ahead(sure_, force(way * most)) > 0)) return;
    const Scalar come = force(way * -larger(-least(way), -most));
    if (ahead(sure_, come) > 0) sure_ = come;
  }
  Scalar least_mean(const Estimate& estimate, Scalar way, Scalar y) const {
    const auto near = [&](Scalar level, Scalar least) {
      return std::fabs(level - estimate.level) <= apart ? least : -farthest;
    };
    // The reading itself is a mean of one.
    Scalar mean = near(y, way * y - sure_mean);
    for (int k = 0; k < lines_.size; ++k) {
      const int i = lines_.place(k);
      const Scalar least = way * at(lines_.mean, i) - sure_mean * lines_.mean_deviation(i);
      mean = larger(mean, near(at(lines_.level, i), least));
    }
    return mean;
  }
  /// Keeps levels small, so that no digits are lost where the load is large and the noise is not.
  void move_base() {
    if (std::fabs(at(lines_.level, best_)) < 64) return;
    const Scalar base = base_ + at(lines_.level, best_) * sd_;
    const Scalar moved = (base - base_) * per_sd_;
    base_ = base;
    for (auto* const lanes : {&lines_.level, &lines_.mean, &lines_.corner})
      for (Scalar& each : *lanes) each -= moved;
  }

  Lines lines_;
  Block block_;
  Scalar sd_ = 0, per_sd_ = 0, base_ = 0;
  Scalar sure_ = 0, sure_before_ = 0;  // now; before the readings that wait
  // The estimate less the level of the best line, its variance less that of this line.
  Scalar off_best_ = 0, beside_best_ = 0;
  Scalar step_ = 0;              // the last one
  std::int8_t best_ = 0;         // of the lines, the most likely
  std::int8_t since_birth_ = 0;  // samples since a line began
  std::int8_t calm_ = 0;         // samples without surprise
  bool falls_ = false;
};

}  // namespace taut
