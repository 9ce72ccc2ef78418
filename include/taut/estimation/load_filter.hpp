// The true load behind the noisy readings of a jack's load cell, fit for a model with friction.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/load_block.hpp"
#include "taut/estimation/load_filter_tuning.hpp"
#include "taut/estimation/load_hypotheses.hpp"
#include "taut/estimation/load_mixture.hpp"
#include "taut/numerics/decay.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// What is known of the load once a reading has been taken. No force is below zero.
template <class Scalar>
struct ConditionedLoad {
  Scalar load = 0;  ///< best estimate of the true load at this sample [N]
  Scalar sd = 0;    ///< its standard deviation [N]
  /// How far it has probably come since it turned [N], and the standard deviation of that: friction holds
  /// forces where the load was farthest, and a load that is held may have come back since, Eq. (65).
  Scalar come = 0, come_sd = 0;
  Scalar confirmed =
      0;  ///< how far the load is confirmed to have come [N]; between two reversals it moves one way only
  bool reversed =
      false;            ///< the load has reversed since the sample before: the model goes to `reversal` first
  Scalar reversal = 0;  ///< best estimate of where [N], if it has
  Scalar reversal_sd = 0;  ///< its standard deviation [N], or zero if TurningPoint does not tell
  bool refused = false;    ///< the reading was taken for an outlier: the load is held
  /// This reading is the first that left a line of many: the load is taken to be there, but whether it has
  /// gone there, and nobody misread, the next one tells. Until then nothing is confirmed.
  bool alone = false;
  bool behind = false;  ///< the estimate has not come as far as `confirmed`: the load may have reversed

  /// The reading was believed, and so is where the load has gone.
  [[gnu::always_inline]] bool is_sure() const { return !refused && !alone; }
};

/// Friction remembers every peak, those of noise too: fed with raw readings, a model is dragged along by
/// them. This filter tells what the load is confirmed to have done (`confirmed`, `reversed`) from where it
/// probably is
/// (`load`).
///
/// The load is taken for a line in time that bends or jumps now and then. Readings scatter about it,
/// independent and Gaussian; some are outliers. A few lines compete, the hypotheses, each begun at another
/// sample; their weights are the probabilities that the present piece of the path began there, and `load` and
/// `sd` their mean and spread (run lengths; Adams and MacKay, Bayesian online changepoint detection, 2007). A
/// new hypothesis begins at every third sample, and at every one that surprises; as there is room for few,
/// the young ones are kept closer together.
///
/// As long as the readings agree with the likeliest line, up to sixteen of them wait until they update all
/// hypotheses as one: their mean. Meanwhile that line alone follows them. Where they drift off, the last
/// eight are taken two by two after all; where only the last one does not agree, it is taken alone.
///
/// After a gap, a step much longer than the one before, no slope is trusted: the longer it was, the less
/// likely that a line has gone on, and a new one begins where the load was last read, as uncertain as the
/// reading shows. A reading that is refused, or is none, leaves the load where it was, and less certain.
///
/// `confirmed` asks for more than a line, which overshoots where a ramp ends: a load that rises is now at
/// least as high as the mean of any readings since it reversed.
///
/// A plain value that may be stored and read back byte by byte. Computed with + - * / and square roots alone,
/// for the same bits on every machine.
template <class Scalar>
class LoadFilter : LoadFilterTuning {
 public:
  /// Forgets everything; the load is taken to have come up from zero. `sd` >= 0 is the standard deviation of
  /// a reading [N], with quantisation (step / sqrt(12)). Zero: readings are exact. Always possible.
  void start(Scalar sd) {
    *this = LoadFilter();
    way_ = block_.spread = 1;
    sd_ = sd > 0 ? sd : Scalar(0);
    per_sd_ = sd_ > 0 ? 1 / sd_ : Scalar(0);
  }

  /// Begins again at a load that was held until now, known with a standard deviation [N]; what came before is
  /// forgotten, and the load is taken to go up from there, or down.
  void start_at(Scalar sd, Scalar held, Scalar held_sd, bool rises = true) {
    start(sd);
    way_ = rises ? Level(1) : Level(-1);
    if (sd_ > 0) {
      hypotheses_.clear();
      base_ = held;
      const int first = hypotheses_.add();
      const auto known = static_cast<Level>(held_sd * per_sd_);
      at(hypotheses_.level_variance, first) = larger(known * known, Level(1e-4));
      at(hypotheses_.weight, first) = 1;
      at(hypotheses_.run_length, first) = at(hypotheses_.known, first) = 1;
      best_ = static_cast<std::int8_t>(first);
    }
    set_confirmed(held);
  }
  /// Standard deviation of a reading [N].
  Scalar sd() const { return sd_; }
  /// From here on readings scatter by another standard deviation `sd` > 0 [N]. Nothing may wait, see
  /// has_waiting().
  void change_sd(Scalar sd) {
    if (!(sd_ > 0 && sd > 0)) return;
    const auto f = static_cast<Level>(sd_ / sd);
    sd_ = sd;
    per_sd_ = 1 / sd;
    for (auto* const lanes : {&hypotheses_.level, &hypotheses_.slope, &hypotheses_.mean, &hypotheses_.corner})
      for (Level& each : *lanes) each *= f;
    for (auto* const lanes :
         {&hypotheses_.level_variance, &hypotheses_.covariance, &hypotheses_.slope_variance})
      for (Level& each : *lanes) each *= f * f;
    off_best_ *= f;
    come_.level *= f;
    come_.sd *= f;
    beside_best_ *= f * f;
    of_drift_ *= f * f;
    set_confirmed(confirmed_);
  }
  bool has_waiting() const { return block_.has_room(); }
  /// The way that the load goes at present.
  bool goes_up() const { return way_ > 0; }
  /// Whether it surely goes on that way: its line has a slope.
  bool goes_on() const {
    return sd_ > 0 && hypotheses_.size > 0 && hypotheses_.has_slope(best_, confirm_slope) &&
           way_ * at(hypotheses_.slope, best_) > 0;
  }
  /// Whether two readings have told how it goes in time.
  bool knows_pace() const { return usual_ > 0 || !(sd_ > 0); }
  /// Readings since the likeliest line began, but those that wait.
  int run_length() const { return sd_ > 0 && hypotheses_.size > 0 ? at(hypotheses_.run_length, best_) : 0; }
  /// For how long that line has lasted [s].
  Scalar lasted() const { return hypotheses_.size > 0 ? static_cast<Scalar>(lasts()) : Scalar(0); }
  /// Something else will remember the load as it is now: it is taken to have come as far as this best
  /// estimate of it [N], which is further than what is confirmed. Until it is confirmed to have turned.
  void come_to(Scalar load) {
    if (ahead(confirmed_, load) > 0) set_confirmed(load);
  }

  /// The load is known to have left its line: where it is now, the next reading alone tells.
  void lose() { lost_ = true; }

  /// How far the load may have gone in the time `dt` > 0 since the last reading, with none in between: as a
  /// standard deviation [N]. Cost: a few operations.
  Scalar gone(Scalar dt) const {
    if (!(sd_ > 0) || hypotheses_.size == 0) return 0;
    const Level slope = block_.has_room() && block_.size > 0 ? block_.slope : at(hypotheses_.slope, best_);
    const Level variance = growth(time_of(static_cast<Level>(dt)), slope);
    return static_cast<Scalar>(std::sqrt(larger(variance, Level(0)))) * sd_;
  }

  /// Takes the next reading [N], `dt` > 0 after the one before, in any unit of time; for the first it does
  /// not matter. What is not finite is refused, and may be anything else. Cost: while readings wait a few
  /// operations; else those of four hypotheses; at worst, when sixteen that wait are taken apart, six times
  /// that.
  ConditionedLoad<Scalar> take(Scalar reading, Scalar dt);

 private:
  // Forces of lines are in standard deviations of a reading, from `base_`; densities are those of such
  // readings. Single precision does for them.

  using Level = LoadFilterTuning::Level;
  using Block = LoadBlock<Scalar, Level, 16>;
  using Estimate = LoadEstimate;

  ConditionedLoad<Scalar> take_one(Scalar reading, Level dt) {
    const Level y = level_of(reading);
    const bool usable = is_reading(reading);
    Level step = time_of(dt);
    // Two at once are as far apart as those before.
    if (usable && !(step > 0)) step = step_;
    if (hypotheses_.size == 0) return begin_anew(usable, reading);
    if (!usable) return miss(step);
    missed_ = 0;
    const Told told = last_told();
    if ((lost_ || step > gap * step_) && step_ > 0) return take_after_gap(step, y, told);
    note_step(step);
    const int newest = hypotheses_.place(hypotheses_.size - 1);
    const bool has_no_slope = !(step > 0) || (best_ == newest && is_new(newest));
    advance(step);
    const bool surprises = is_surprise(y);
    ++since_birth_;
    calm_ = static_cast<std::int8_t>(surprises ? 0 : calm_ < calm_enough ? calm_ + 1 : calm_);
    // Where nothing surprises, it does not matter where exactly a line begins.
    if (since_birth_ >= pause || surprises) begin_line({surprises, has_no_slope}, step, step, y, Level(1));
    const int before = best_;
    const bool may_be_alone = at(hypotheses_.run_length, before) >= Hypotheses::established &&
                              at(hypotheses_.outliers_in_a_row, before) == 0;
    const Level innovation =
        (y - at(hypotheses_.level, best_)) / std::sqrt(at(hypotheses_.level_variance, best_) + 1);
    hypotheses_.update(y, 1);
    const Level total = find_best();
    const bool accepted = at(hypotheses_.outliers_in_a_row, best_) == 0;
    if (best_ != before)
      block_.drift = 0;
    else if (accepted)
      block_.follow(innovation);
    return conclude(accepted, total, y, told, may_be_alone && at(hypotheses_.run_length, best_) == 1);
  }
  /// The time since the last reading that was one; zero if it is not known.
  Level time_of(Level dt) const {
    const Level time = missed_ + (dt > 0 ? dt : Level(0));
    return time < shortest ? Level(0) : time < longest ? time : longest;
  }
  void note_step(Level step) {
    if (!(step > 0)) return;
    step_ = step;
    const Level least = usual_ / gap, most = usual_ * gap;
    usual_ = usual_ > 0 ? larger(least, -larger(-most, -step)) : step;
  }
  void advance(Level step) {
    hypotheses_.forget(1);
    const int newest = hypotheses_.place(hypotheses_.size - 1);
    // Only now is it known what a sample is in time.
    if (is_new(newest) && step > 0)
      at(hypotheses_.slope_variance, newest) = slope_after_jump / step * (slope_after_jump / step);
    hypotheses_.advance(step);
  }

  // Times without readings.

  /// Where the load was when it was last told.
  struct Told {
    Level level, variance;
  };
  Told last_told() const {
    return {at(hypotheses_.level, best_) + off_best_,
            at(hypotheses_.level_variance, best_) + beside_best_ + of_drift_};
  }
  /// A piece of the path goes on for about as long as it has lasted.
  Level lasts() const { return static_cast<Level>(at(hypotheses_.run_length, best_)) * usual_; }
  /// By what the variance of the load grows where it may have gone on along its line, with this slope now.
  Level growth(Level step, Level slope) const {
    const Level t = -larger(-step, -lasts()), gone = t * slope;
    return t * (2 * at(hypotheses_.covariance, best_) + t * at(hypotheses_.slope_variance, best_)) +
           gone * gone;
  }
  /// A reading that is none: the load stays where it was last read, and is the less certain the longer that
  /// is ago.
  ConditionedLoad<Scalar> miss(Level step) {
    missed_ = step;
    const Told told = last_told();
    const Level variance = larger(told.variance, Level(0)) + growth(step, at(hypotheses_.slope, best_));
    const Estimate estimate = {told.level, std::sqrt(variance)};
    ConditionedLoad<Scalar> now;
    say(now, estimate, beyond_confirmed(estimate));
    now.refused = true;
    return now;
  }
  /// The first reading after a gap. What the load did meanwhile is not known: the longer it was, the less
  /// likely that a line has gone on. Beside the lines that have, a new one begins where the load was held.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_after_gap(Level step, Level y, const Told& told) {
    const Level come = corner(0), off = y - told.level, gone = step * at(hypotheses_.slope, best_);
    const bool is_on_the_way = off > -larger(-gone, Level(0)) - apart && off < larger(gone, Level(0)) + apart;
    const Level samples = static_cast<Level>(since_birth_) + step / usual_;
    const Level odds = samples * at(hypotheses_.weight, best_) /
                       (static_cast<Level>(at(hypotheses_.run_length, best_)) + least_length);
    note_step(step);
    advance(step);
    for (int k = hypotheses_.size - 1; k >= 0; --k) {
      const int i = hypotheses_.place(k);
      // Of a line that says so little no digits would be left.
      if (lost_ ||
          !(at(hypotheses_.level_variance, i) < vague && std::fabs(at(hypotheses_.level, i)) < farthest)) {
        hypotheses_.drop(k);
        continue;
      }
      // What has lasted long is to be left as easily as any other now.
      if (at(hypotheses_.run_length, i) >= long_run) at(hypotheses_.run_length, i) = long_run - 1;
    }
    lost_ = false;
    make_room(hypotheses_, true, y);
    const int born = hypotheses_.add();
    at(hypotheses_.level, born) = told.level;
    at(hypotheses_.level_variance, born) = larger(off * off, Level(1));
    at(hypotheses_.weight, born) = odds * (is_on_the_way ? Level(1) : elsewhere);
    at(hypotheses_.corner, born) = come;
    at(hypotheses_.outliers_in_a_row, born) = at(hypotheses_.known, born) = 0;
    since_birth_ = calm_ = 0;
    block_.drift = 0;
    hypotheses_.update(y, 1);
    const Level total = find_best();
    return conclude(at(hypotheses_.outliers_in_a_row, best_) == 0, total, y, told);
  }

  // Readings that wait.

  /// Whether readings wait from now on: what is young may soon be disproved.
  bool begins_to_wait() {
    if (calm_ < calm_enough || missed_ > 0) return false;
    const int hold = long_hold(hypotheses_, Level(1));
    if (hold >= 0 && hold != best_) return false;
    const std::int32_t run_length = at(hypotheses_.run_length, best_);
    const int most = at(hypotheses_.weight, best_) < Level(0.5) ? 0 : run_length / 2;
    if (most < 2) return false;
    block_.begin(line(best_), step_, most);
    confirmed_before_ = confirmed_;
    const Level taken = static_cast<Level>(run_length),
                half = Level(0.5) * static_cast<Level>(block_.most + 1);
    // While half of them have been taken.
    const Level variance = block_.variance() * taken / (taken + half);
    waits_sd_ = std::sqrt(larger(variance + beside_best_, Level(0)));
    // Where it goes on, it comes with the line.
    const Level gained = goes_on_ * (block_.variance() - variance);
    come_.sd = std::sqrt(larger(come_.sd * come_.sd - gained, waits_sd_ * waits_sd_ * goes_on_));
    return true;
  }
  ConditionedLoad<Scalar> wait(Scalar reading, Level dt) {
    const Level y = level_of(reading);
    const Level innovation = block_.add(reading, dt, y), square = block_.drift * block_.drift;
    const bool is_even = std::fabs(dt - step_) <= Level(0.5) * step_;
    const Estimate estimate = {block_.level + off_best_, waits_sd_};
    const Level further = beyond_confirmed(estimate);
    // Not a number does not agree either.
    const bool agrees =
        square < disagree * disagree * block_.drift_variance && is_even && !has_reversed(estimate, further);
    const bool fits = innovation * innovation < doubt * doubt * block_.spread;
    // What is none says nothing of those before.
    if (!agrees || !fits) return take_apart(agrees || !is_reading(reading), fits && is_even);
    if (!block_.has_room()) return take_together(y, square > suspicious * block_.drift_variance);
    confirm(estimate, further, [&](Level way) {
      const Level share = block_.share();
      return larger(way * y - confirm_mean, way * (block_.sum * share) - confirm_mean * std::sqrt(share));
    });
    ConditionedLoad<Scalar> now;
    say(now, widened(estimate), further);
    say_come(now, come_with(estimate.level), estimate.level);
    return now;
  }
  /// What comes next is none of those that wait.
  void take_waiting() {
    if (!block_.has_room()) return;
    if (block_.size > 0) take_together(level_of(at(block_.reading, block_.size - 1)), true);
    block_.close();
    calm_ = 0;
  }
  /// The readings that wait, and their mean as one; the last of them is `y`.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_together(Level y, bool is_suspicious) {
    const Level share = block_.share(), middle = block_.times * share, mean = block_.sum * share;
    const int count = block_.size;
    step_ = usual_ = block_.span * share;
    since_birth_ = static_cast<std::int8_t>(since_birth_ + count);
    hypotheses_.forget(count);
    hypotheses_.advance(middle);
    if (is_suspicious || since_birth_ >= long_pause) begin_line({false, false}, step_, middle, mean, share);
    hypotheses_.update(mean, count);
    hypotheses_.advance(block_.span - middle);
    return conclude(true, find_best(), y);
  }
  /// Of those that agree the mean is taken, others two by two; the last one, if it does not fit, alone.
  /// What has been told of them in the meantime stands: `confirmed` does not go back, but for a reversal.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_apart(bool agree, bool last_fits) {
    const Scalar told = confirmed_;
    const Level way = way_;
    const int count = block_.size, in_doubt = agree ? 0 : doubtful, last = count - (last_fits ? 0 : 1);
    const int agreeing = agree ? last : count > in_doubt ? count - in_doubt : 0;
    block_.close();
    if (!agree) set_confirmed(confirmed_before_);
    ConditionedLoad<Scalar> now;
    Scalar reversal = 0;
    for (int i = 0; i < count;) {
      const int together = i < agreeing ? agreeing : i + 2 <= last ? 2 : 1;
      if (together > 1) {
        block_.keep(i, together, [this](Scalar each) { return level_of(each); });
        now = take_together(level_of(at(block_.reading, i + together - 1)), true);
      } else {
        now = take_one(at(block_.reading, i), at(block_.step, i));
      }
      if (now.reversed) reversal = now.reversal;
      i += together;
    }
    // It was by chance if an old line is still by far the likeliest. A load that is held is not on it.
    const bool is_calm = !now.refused && at(hypotheses_.weight, best_) > by_far &&
                         at(hypotheses_.run_length, best_) > long_ago;
    calm_ = is_calm ? calm_enough : std::int8_t{0};
    now.reversed = way_ != way;
    now.alone &= !now.reversed;
    if (now.reversed)
      now.reversal = way < 0 ? -larger(-reversal, -told) : larger(reversal, told);
    else if (now.refused || ahead(confirmed_, told) > 0)
      set_confirmed(told);
    now.confirmed = confirmed_;
    now.behind = ahead(confirmed_, now.load) < 0;
    return now;
  }

  template <class Array>
  static auto& at(Array& array, int i) {
    return Hypotheses::at(array, i);
  }
  bool is_new(int i) const { return at(hypotheses_.run_length, i) == 1 && at(hypotheses_.known, i) == 1; }
  /// Whatever was read before: else what it was led to by one that was none could be the end.
  bool is_reading(Scalar given) const { return std::fabs(given * per_sd_) < Scalar(farthest); }
  Level level_of(Scalar reading) const {
    // What is none, or too far, is farther than any.
    constexpr Scalar end = 2 * Scalar(farthest);
    const Scalar level = (reading - base_) * per_sd_, below = level < end ? level : end;
    return static_cast<Level>(larger(below, -end));
  }
  LineState<Level> line(int i) const {
    return {at(hypotheses_.level, i), at(hypotheses_.slope, i), at(hypotheses_.level_variance, i),
            at(hypotheses_.covariance, i), at(hypotheses_.slope_variance, i)};
  }
  void set_confirmed(Scalar load) { set_confirmed(load, level_of(load)); }
  void set_confirmed(Scalar load, Level level) {
    confirmed_ = load;
    confirmed_level_ = level;
  }
  Scalar force(Level level) const {
    const Scalar newtons = base_ + static_cast<Scalar>(level) * sd_;
    return larger(newtons, Scalar(0));
  }
  /// Positive if `b` lies beyond `a` as the load goes at present.
  template <class Number>
  Number ahead(Number a, Number b) const {
    return way_ < 0 ? a - b : b - a;
  }

  ConditionedLoad<Scalar> take_exact(Scalar reading) {
    if (!std::isfinite(reading)) return refuse();
    const Scalar load = reading > 0 ? reading : Scalar(0);
    ConditionedLoad<Scalar> now;
    if (ahead(confirmed_, load) < 0) {
      now.reversed = true;
      now.reversal = confirmed_;
      way_ = -way_;
    }
    now.load = now.come = now.confirmed = confirmed_ = load;
    return now;
  }

  ConditionedLoad<Scalar> begin_anew(bool usable, Scalar reading) {
    hypotheses_.clear();
    calm_ = 0;
    if (!usable) return refuse();
    base_ = reading;
    set_confirmed(confirmed_);
    const int first = hypotheses_.add();
    at(hypotheses_.level_variance, first) = at(hypotheses_.weight, first) = 1;
    at(hypotheses_.run_length, first) = at(hypotheses_.known, first) = 1;
    best_ = static_cast<std::int8_t>(first);
    return conclude(true, 1, 0);
  }

  ConditionedLoad<Scalar> refuse() const {
    ConditionedLoad<Scalar> now;
    now.load = now.come = now.confirmed = confirmed_;
    now.sd = now.come_sd = sd_;
    now.refused = true;
    return now;
  }

  bool is_surprise(Level y) const {
    const Level r = y - at(hypotheses_.level, best_);
    return r * r > surprise * surprise * (at(hypotheses_.level_variance, best_) + 1);
  }
  struct Why {
    bool surprises, has_no_slope;
  };
  /// A line that began `since` ago, by a bend of what was the best line until then, or by a jump: where the
  /// reading `y`, with this variance, is expected from there. The lines are at this sample, but have not
  /// taken it yet; samples are `dt` apart.
  void begin_line(Why why, Level dt, Level since, Level y, Level noise) {
    const Level odds = static_cast<Level>(since_birth_) * at(hypotheses_.weight, best_) /
                       (static_cast<Level>(at(hypotheses_.run_length, best_)) + least_length);
    since_birth_ = 0;
    const Level come = corner(since), level = at(hypotheses_.level, best_),
                slope = at(hypotheses_.slope, best_);
    const Level level_variance = at(hypotheses_.level_variance, best_),
                covariance = at(hypotheses_.covariance, best_);
    const Level slope_variance = at(hypotheses_.slope_variance, best_);
    const std::int32_t known = at(hypotheses_.known, best_);
    make_room(hypotheses_, why.surprises, y);
    const int born = hypotheses_.add();
    const Level square = (y - level) * (y - level), variance = level_variance + noise;
    const bool is_jump = why.has_no_slope || square > farthest_bend * (variance + steep_bend * steep_bend);
    const Level jump = larger(square, least_jump * least_jump);
    // A ramp often ends in a hold: such a bend is as large as its slope.
    const Level least = larger(gentle_bend, std::fabs(slope) * dt),
                change = (square > gentle * variance ? steep_bend : least) / dt;
    const Level bent = change * since;
    at(hypotheses_.level, born) = level;
    at(hypotheses_.slope, born) = is_jump ? Level(0) : slope;
    at(hypotheses_.level_variance, born) = is_jump ? jump : level_variance + bent * bent;
    at(hypotheses_.covariance, born) = is_jump ? Level(0) : covariance + bent * change;
    at(hypotheses_.slope_variance, born) = is_jump ? Level(0) : slope_variance + change * change;
    at(hypotheses_.weight, born) = odds * (is_jump ? jumps : why.surprises ? bends : quiet_bends);
    at(hypotheses_.corner, born) = come;
    at(hypotheses_.mean, born) = 0;
    at(hypotheses_.run_length, born) = at(hypotheses_.outliers_in_a_row, born) = 0;
    // Else a jump that bends at once were taken for a new one.
    at(hypotheses_.known, born) = is_jump ? 0 : known < 2 ? 2 : known;
  }
  /// The farthest that the load had come `since` ago, as the best line has it. A load that is already on its
  /// way back came farthest before that.
  Level corner(Level since) const {
    const Level last = reached(since), before = at(hypotheses_.corner, best_);
    const bool returns =
        hypotheses_.has_slope(best_, confirm_slope) && ahead(Level(0), at(hypotheses_.slope, best_)) < 0;
    return returns && ahead(last, before) > left_behind ? before : last;
  }
  /// Where the load had come at the last reading that the best line believed. In a hold its slope is known to
  /// be zero, which halves the scatter.
  Level reached(Level since) const {
    const Level level = at(hypotheses_.level, best_), slope = at(hypotheses_.slope, best_);
    const Level slope_variance = at(hypotheses_.slope_variance, best_);
    if (!hypotheses_.has_slope(best_, confirm_slope) && slope_variance > 0)
      return level - at(hypotheses_.covariance, best_) / slope_variance * slope;
    return level - (static_cast<Level>(at(hypotheses_.outliers_in_a_row, best_)) * step_ + since) * slope;
  }

  /// Returns the sum of the weights: what surprises the others is explained by the newest line.
  Level find_best() {
    Level total = 0, most = -1;
    for (int i = 0; i < Hypotheses::capacity; ++i) {
      const Level weight = at(hypotheses_.weight, i);
      total += weight;
      if (weight > most) {
        most = weight;
        best_ = static_cast<std::int8_t>(i);
      }
    }
    return total;
  }

  /// Where a reading is refused: the load stays where it was, and may have gone as far as the line says, or
  /// as far again as it has come.
  Estimate hold(const Told& told, const Estimate& expected) const {
    const Level far = std::fabs(at(hypotheses_.slope, best_)) * lasts(),
                on = std::fabs(expected.level - told.level);
    const Level gone = -larger(-far, -on), variance = larger(expected.sd * expected.sd, told.variance);
    return {told.level, std::sqrt(variance + gone * gone)};
  }
  /// `total` is the sum of the weights; it becomes one. `told` is where the load stays if the reading `y` is
  /// not accepted; one that is `alone` confirms nothing.
  ConditionedLoad<Scalar> conclude(bool accepted, Level total, Level y, const Told& told = {},
                                   bool alone = false) {
    Estimate estimate = estimate_load(hypotheses_, best_, total);
    const Level unit = 1 / total;
    for (int k = 0; k < hypotheses_.size; ++k) {
      Level& weight = at(hypotheses_.weight, hypotheses_.place(k));
      weight = larger(least_weight, weight * unit);
    }
    if (!accepted) estimate = hold(told, estimate);
    off_best_ = estimate.level - at(hypotheses_.level, best_);
    beside_best_ = estimate.sd * estimate.sd - at(hypotheses_.level_variance, best_);
    ConditionedLoad<Scalar> now;
    now.alone = accepted && alone;
    if (accepted && !alone) {
      if (has_reversed(estimate, beyond_confirmed(estimate))) reverse(now);
      confirm(estimate, beyond_confirmed(estimate), [&](Level way) { return least_mean(estimate, way, y); });
    }
    say(now, accepted ? widened(estimate) : estimate, beyond_confirmed(estimate));
    now.refused = !accepted;
    if (accepted) {
      find_come(estimate);
      say_come(now, come_with(estimate.level), estimate.level);
    }
    move_base();
    return now;
  }
  /// Readings that drift off the best line may be the first of a new piece: then the line tells no more than
  /// about a single one of them. One that is young does not claim to tell more.
  Estimate widened(const Estimate& estimate) {
    const std::int32_t run_length = at(hypotheses_.run_length, best_);
    const Level far = std::fabs(block_.drift) - by_chance;
    of_drift_ = 0;
    if (!(far > 0) || run_length < Hypotheses::established) return estimate;
    const Level part =
                    run_length < young ? perhaps_bent : perhaps_bent * young / static_cast<Level>(run_length),
                most = larger(estimate.sd, widest);
    const Level sd = -larger(-most, -(estimate.sd + part * far));
    of_drift_ = sd * sd - estimate.sd * estimate.sd;
    return {estimate.level, sd};
  }
  void say(ConditionedLoad<Scalar>& now, const Estimate& estimate, Level further) const {
    now.load = force(estimate.level);
    now.sd = static_cast<Scalar>(estimate.sd) * sd_;
    now.come = now.load;
    now.come_sd = now.sd;
    now.confirmed = confirmed_;
    // Below zero there is no load: both are zero then.
    if (further < 0) now.behind = now.load != confirmed_;
  }
  /// Where the load was farthest on the best line, Eq. (65): one that is held is at rest, or goes on, or
  /// comes back, and what the line rises or falls by from its beginning to now may be chance.
  void find_come(const Estimate& estimate) {
    come_ = {0, estimate.sd};
    goes_on_ = 1;
    const int hold = long_hold(hypotheses_, Level(1)), line = hold < 0 ? best_ : hold;
    const auto readings = static_cast<Level>(at(hypotheses_.run_length, line));
    const Level variance = estimate.sd * estimate.sd, of_rest = 1 / readings;
    if (readings < Hypotheses::established || !(of_rest < variance)) return;
    const Level mean = at(hypotheses_.mean, line), half = way_ * (estimate.level - mean),
                gone_variance = 12 * of_rest;
    const Level expected = least_gone * least_gone + 4 * half * half, both = expected + gone_variance,
                known = expected / both, square = 4 * half * half / gone_variance;
    const Level part = 1 / (1 + rests * std::sqrt(both / gone_variance) * decay(square * known / 2)),
                far = known * std::fabs(half);
    goes_on_ = half > 0 ? part * known : Level(0);
    come_.level = mean + way_ * part * far - goes_on_ * estimate.level;
    come_.sd = std::sqrt((1 - part) * (of_rest + part * far * far) + part * variance);
  }
  /// How far the load has come where the estimate is at `level`.
  Estimate come_with(Level level) const { return {come_.level + goes_on_ * level, come_.sd}; }
  /// Readings that drift off on its way may be the first of a load that goes on.
  void say_come(ConditionedLoad<Scalar>& now, const Estimate& come, Level load) const {
    if (of_drift_ > 0 && way_ * block_.drift > 0 && way_ * (load - come.level) > 0) return;
    now.come = force(come.level);
    now.come_sd = static_cast<Scalar>(std::sqrt(come.sd * come.sd + of_drift_)) * sd_;
  }
  /// How much further the estimate is than what is confirmed, as the load goes at present.
  Level beyond_confirmed(const Estimate& estimate) const {
    return way_ * (estimate.level - confirmed_level_);
  }
  static bool has_reversed(const Estimate& estimate, Level further) {
    return -further > confirm_reversal * estimate.sd;
  }
  void reverse(ConditionedLoad<Scalar>& now) {
    const Scalar corner = force(at(hypotheses_.corner, best_));
    if (ahead(confirmed_, corner) > 0) set_confirmed(corner);
    now.reversed = true;
    now.reversal = confirmed_;
    way_ = -way_;
    calm_ = 0;
    // The means of older lines are from before the reversal.
    while (hypotheses_.size > 1 && hypotheses_.place(0) != best_) hypotheses_.drop(0);
  }
  /// `least(way)` is what the load is by means of readings, less their uncertainty, times the way that it
  /// goes.
  template <class Least>
  void confirm(const Estimate& estimate, Level further, const Least& least) {
    if (!(further > confirm_load * estimate.sd)) return;
    const Level most = way_ * estimate.level - confirm_load * estimate.sd;
    const Level level = way_ * -larger(-least(way_), -most);
    const Scalar come = force(level);
    if (ahead(confirmed_, come) > 0) set_confirmed(come, come > 0 ? level : level_of(come));
  }
  Level least_mean(const Estimate& estimate, Level way, Level y) const {
    const auto near = [&](Level level, Level least) {
      return std::fabs(level - estimate.level) <= apart ? least : -farthest;
    };
    // The reading itself is a mean of one.
    Level mean = near(y, way * y - confirm_mean);
    const auto deviation = hypotheses_.mean_deviations();
    for (int k = 0; k < hypotheses_.size; ++k) {
      const int i = hypotheses_.place(k);
      const Level least = way * at(hypotheses_.mean, i) - confirm_mean * at(deviation, i);
      mean = larger(mean, near(at(hypotheses_.level, i), least));
    }
    return mean;
  }
  /// Keeps levels small, so that no digits are lost where the load is large and the noise is not.
  void move_base() {
    if (std::fabs(at(hypotheses_.level, best_)) < 64) return;
    const Scalar base = base_ + static_cast<Scalar>(at(hypotheses_.level, best_)) * sd_;
    const auto moved = static_cast<Level>((base - base_) * per_sd_);
    base_ = base;
    set_confirmed(confirmed_);
    for (auto* const lanes : {&hypotheses_.level, &hypotheses_.mean, &hypotheses_.corner})
      for (Level& each : *lanes) each -= moved;
    come_.level -= (1 - goes_on_) * moved;
  }

  Hypotheses hypotheses_;
  Block block_;
  Scalar sd_ = 0, per_sd_ = 0, base_ = 0;
  Scalar confirmed_ = 0, confirmed_before_ = 0;  // now; before the readings that wait
  Level confirmed_level_ = 0;
  // The estimate less the level of the best line, its variance less that of this line.
  Level off_best_ = 0, beside_best_ = 0;
  // How far the load has come, without what follows it; and by how much of where it is it follows.
  Estimate come_{};
  Level goes_on_ = 0;
  Level of_drift_ = 0;           // of what was told, for readings that drift off
  Level waits_sd_ = 0;           // standard deviation of the estimate while readings wait
  Level step_ = 0, usual_ = 0;   // the last one; what they usually are
  Level missed_ = 0;             // time since the last reading that was one
  Level way_ = 0;                // that the load goes: up or down
  std::int8_t best_ = 0;         // the most likely hypothesis
  std::int8_t since_birth_ = 0;  // samples since a line began
  std::int8_t calm_ = 0;         // samples without surprise
  bool lost_ = false;            // it has left its line
};

// Outside of the class, so that a source with an `extern template` of it compiles none of it.

template <class Scalar>
ConditionedLoad<Scalar> LoadFilter<Scalar>::take(Scalar reading, Scalar dt) {
  const auto step = static_cast<Level>(dt);
  if (lost_) take_waiting();
  if (block_.has_room() || begins_to_wait()) return wait(reading, step);
  return sd_ == 0 ? take_exact(reading) : take_one(reading, step);
}

}  // namespace taut
