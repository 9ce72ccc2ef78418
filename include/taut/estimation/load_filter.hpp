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
  bool refused = false;  ///< the reading was taken for an outlier: the load is held
  bool behind = false;   ///< the estimate has not come as far as `sure`: the load may have turned
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
/// As long as the readings agree with the likeliest line, up to sixteen of them wait until they are weighed
/// as one: their mean. Meanwhile that line alone follows them. Where they drift off, the last eight are
/// weighed two by two after all; where only the last one does not agree, it is weighed alone.
///
/// After a gap, a step much longer than the one before, no slope is trusted: the longer it was, the less
/// likely that a line has gone on, and a new one begins where the load was last read, as uncertain as the
/// reading shows. A reading that is refused, or is none, leaves the load where it was, and less certain.
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
    const auto step = static_cast<Level>(dt);
    if (block_.has_room() || begins_to_wait()) return wait(reading, step);
    return sd_ == 0 ? take_exact(reading) : take_one(reading, step);
  }

 private:
  // Forces of lines are in standard deviations of a reading, from `base_`; densities are those of such
  // readings. Single precision does for them.

  using Level = float;
  using Lines = LoadLines<Level, 4>;
  using Block = LoadBlock<Scalar, Level, 16>;
  static constexpr Level farthest = Level(1e9);  ///< what is farther is no reading, and its square overflows

  struct Estimate {
    Level level, sd;
  };

  ConditionedLoad<Scalar> take_one(Scalar reading, Level dt) {
    const Level step = time_of(dt), y = level_of(reading);
    const bool usable = is_reading(reading);
    if (lines_.size == 0) return begin_anew(usable, reading);
    if (!usable) return miss(step);
    missed_ = 0;
    const Told told = last_told();
    if (step > gap * step_ && step_ > 0) return take_after_gap(step, y, told);
    note_step(step);
    const int newest = lines_.place(lines_.size - 1);
    const bool has_no_slope = !(step > 0) || (best_ == newest && is_new(newest));
    advance(step);
    const bool surprises = is_surprise(y);
    ++since_birth_;
    calm_ = static_cast<std::int8_t>(surprises ? 0 : calm_ < calm_enough ? calm_ + 1 : calm_);
    // Where nothing surprises, where exactly a line begins is of no account.
    if (since_birth_ >= pause || surprises) begin_line({surprises, has_no_slope}, step, step, y, Level(1));
    lines_.weigh(y, 1);
    const Level total = find_best();
    return conclude(at(lines_.strays, best_) == 0, total, y, told);
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
    lines_.forget(1);
    const int newest = lines_.place(lines_.size - 1);
    // Only now is it known what a sample is in time.
    if (is_new(newest) && step > 0)
      at(lines_.slope_variance, newest) = slope_after_jump / step * (slope_after_jump / step);
    lines_.advance(step);
  }

  // Times without readings.

  /// Where the load was when it was last told.
  struct Told {
    Level level, variance;
  };
  Told last_told() const {
    return {at(lines_.level, best_) + off_best_, at(lines_.level_variance, best_) + beside_best_};
  }
  /// A piece of the path goes on for about as long as it has lasted.
  Level lasts() const { return static_cast<Level>(at(lines_.age, best_)) * usual_; }
  /// A reading that is none: the load stays where it was last read, and is the less certain the longer that
  /// is ago.
  ConditionedLoad<Scalar> miss(Level step) {
    missed_ = step;
    const Level t = -larger(-step, -lasts()), gone = t * at(lines_.slope, best_);
    const Level growth = t * (2 * at(lines_.covariance, best_) + t * at(lines_.slope_variance, best_));
    const Told told = last_told();
    const Level variance = larger(told.variance, Level(0)) + growth + gone * gone;
    const Estimate estimate = {told.level, std::sqrt(variance)};
    ConditionedLoad<Scalar> now;
    say(now, estimate, beyond_sure(estimate));
    now.refused = true;
    return now;
  }
  /// The first reading after a gap. What the load did meanwhile nobody knows: the longer it was, the less
  /// likely that a line has gone on. Beside the lines that have, a new one begins where the load was held.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_after_gap(Level step, Level y, const Told& told) {
    const Level come = corner(0), off = y - told.level, gone = step * at(lines_.slope, best_);
    const bool is_on_the_way = off > -larger(-gone, Level(0)) - apart && off < larger(gone, Level(0)) + apart;
    const Level samples = static_cast<Level>(since_birth_) + step / usual_;
    const Level odds =
        samples * at(lines_.weight, best_) / (static_cast<Level>(at(lines_.age, best_)) + least_length);
    note_step(step);
    advance(step);
    for (int k = lines_.size - 1; k >= 0; --k) {
      const int i = lines_.place(k);
      // Of a line that says so little no digits would be left.
      if (!(at(lines_.level_variance, i) < vague && std::fabs(at(lines_.level, i)) < farthest)) {
        lines_.drop(k);
        continue;
      }
      // What has lasted long is to be left as easily as any other now.
      if (at(lines_.age, i) >= old_age) at(lines_.age, i) = old_age - 1;
    }
    make_room(true, y);
    const int born = lines_.add();
    at(lines_.level, born) = told.level;
    at(lines_.level_variance, born) = larger(off * off, Level(1));
    at(lines_.weight, born) = odds * (is_on_the_way ? Level(1) : elsewhere);
    at(lines_.corner, born) = come;
    at(lines_.strays, born) = at(lines_.known, born) = 0;
    since_birth_ = calm_ = 0;
    lines_.weigh(y, 1);
    const Level total = find_best();
    return conclude(at(lines_.strays, best_) == 0, total, y, told);
  }

  // Readings that wait.

  /// Whether readings wait from now on: what is young may soon be disproved.
  bool begins_to_wait() {
    if (calm_ < calm_enough || missed_ > 0) return false;
    const int hold = long_hold(1);
    if (hold >= 0 && hold != best_) return false;
    const std::int32_t age = at(lines_.age, best_);
    const int most = at(lines_.weight, best_) < Level(0.5) ? 0 : age / 2;
    if (most < 2) return false;
    block_.begin(line(best_), step_, most);
    sure_before_ = sure_;
    const Level taken = static_cast<Level>(age), half = Level(0.5) * static_cast<Level>(block_.most + 1);
    // While half of them have been taken.
    const Level variance = block_.variance() * taken / (taken + half);
    waits_sd_ = std::sqrt(larger(variance + beside_best_, Level(0)));
    waits_bent_ = age < young ? perhaps_bent : Level(0);
    return true;
  }
  ConditionedLoad<Scalar> wait(Scalar reading, Level dt) {
    const Level y = level_of(reading);
    const Level innovation = block_.add(reading, dt, y), square = block_.drift * block_.drift;
    const bool is_even = std::fabs(dt - step_) <= Level(0.5) * step_;
    const Estimate estimate = {block_.level + off_best_, waits_sd_};
    const Level further = beyond_sure(estimate);
    // Not a number does not agree either.
    const bool agrees =
        square < disagree * disagree * block_.drift_variance && is_even && !has_turned(estimate, further);
    const bool fits = innovation * innovation < doubt * doubt * block_.spread;
    // What is none says nothing of those before.
    if (!agrees || !fits) return take_apart(agrees || !is_reading(reading), fits && is_even);
    if (!block_.has_room()) return take_together(y, square > suspicious * block_.drift_variance);
    go_on(estimate, further, [&](Level way) {
      const Level share = block_.share();
      return larger(way * y - sure_mean, way * (block_.sum * share) - sure_mean * std::sqrt(share));
    });
    ConditionedLoad<Scalar> now;
    say(now, {estimate.level, waits_sd_ + waits_bent_ * std::fabs(block_.drift)}, further);
    return now;
  }
  /// The readings that wait, and their mean as one; the last of them is `y`.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_together(Level y, bool is_suspicious) {
    const Level share = block_.share(), middle = block_.times * share, mean = block_.sum * share;
    const int count = block_.size;
    step_ = usual_ = block_.span * share;
    since_birth_ = static_cast<std::int8_t>(since_birth_ + count);
    lines_.forget(count);
    lines_.advance(middle);
    if (is_suspicious || since_birth_ >= long_pause) begin_line({false, false}, step_, middle, mean, share);
    lines_.weigh(mean, count);
    lines_.advance(block_.span - middle);
    return conclude(true, find_best(), y);
  }
  /// Of those that agree the mean is weighed, others two by two; the last one, if it does not fit, alone.
  /// What has been told of them in the meantime stands: `sure` does not go back, but for a turn.
  [[gnu::noinline]] ConditionedLoad<Scalar> take_apart(bool agree, bool last_fits) {
    const Scalar told = sure_;
    const Level way = way_;
    const int count = block_.size, in_doubt = agree ? 0 : doubtful, last = count - (last_fits ? 0 : 1);
    const int agreeing = agree ? last : count > in_doubt ? count - in_doubt : 0;
    block_.close();
    if (!agree) set_sure(sure_before_);
    ConditionedLoad<Scalar> now;
    Scalar turn = 0;
    for (int i = 0; i < count;) {
      const int together = i < agreeing ? agreeing : i + 2 <= last ? 2 : 1;
      if (together > 1) {
        block_.keep(i, together, [this](Scalar each) { return level_of(each); });
        now = take_together(level_of(at(block_.reading, i + together - 1)), true);
      } else {
        now = take_one(at(block_.reading, i), at(block_.step, i));
      }
      if (now.turned) turn = now.turn;
      i += together;
    }
    // It was by chance if an old line is still by far the likeliest. A load that is held is not on it.
    const bool is_calm =
        !now.refused && at(lines_.weight, best_) > by_far && at(lines_.age, best_) > long_ago;
    calm_ = is_calm ? calm_enough : std::int8_t{0};
    now.turned = way_ != way;
    if (now.turned)
      now.turn = way < 0 ? -larger(-turn, -told) : larger(turn, told);
    else if (now.refused || ahead(sure_, told) > 0)
      set_sure(told);
    now.sure = sure_;
    now.behind = ahead(sure_, now.load) < 0;
    return now;
  }

  /// Lines that began longer ago than this are as good as one another.
  static constexpr int old_age = 1024;
  /// Samples from one new line to the next, but for readings that surprise: by so many standard deviations.
  static constexpr std::int8_t pause = 3;
  /// The same where readings wait, but for a drift whose square is beyond so many of its variances.
  static constexpr std::int8_t long_pause = 24;
  static constexpr Level suspicious = Level(0.5);
  static constexpr Level surprise = 2;
  /// Readings wait after so many without surprise, until they drift off or the last one is in doubt.
  static constexpr std::int8_t calm_enough = 4;
  static constexpr Level disagree = Level(2.4), doubt = 3;
  /// Of the readings that drift off so many are not what the line explains.
  static constexpr int doubtful = 8;
  static constexpr Level by_far = Level(0.8);
  static constexpr int long_ago = 32;
  /// One of those that wait may be the first of a new piece: as long as a line is young, so much of how far
  /// they drift off counts as deviation too.
  static constexpr Level perhaps_bent = Level(0.06);
  static constexpr int young = 150;

  /// The odds that a piece ends now are 1 in its age and this: pieces of every length are as likely.
  static constexpr Level least_length = 15;
  static constexpr Level bends = Level(0.8), jumps = Level(0.002);
  /// Changes of slope to be expected, per sample; in between the better of the two will do.
  static constexpr Level gentle_bend = Level(0.15), steep_bend = 3;
  static constexpr Level slope_after_jump = 10;
  /// Squares, in variances of a reading: beyond the one a steep bend explains it better than a gentle one,
  /// beyond the other, which counts the bend's, a jump better than a bend.
  static constexpr Level gentle = Level(2.6), farthest_bend = 20;
  /// How far a jump is expected to lead, at least: readings that near have the density `anywhere`.
  static constexpr Level least_jump = Level(0.4) / Lines::anywhere;

  /// A step so many times as long as the one before, or longer, is a gap.
  static constexpr Level gap = 4;
  /// That the load went on after a gap somewhere else than it was held, and not on the line's way either.
  static constexpr Level elsewhere = Level(0.02);
  /// A variance, of a line across a gap, that leaves too few digits.
  static constexpr Level vague = Level(1e4);
  /// Times beyond these are taken for the nearer end, or for none.
  static constexpr Level shortest = Level(1e-15), longest = Level(1e15);

  static constexpr Level neglected = Level(1e-9), least_weight = Level(1e-30);
  static constexpr Level patience = Level(1e-4);  ///< weight of a long hold that is enough
  /// A long hold among a million samples has a slope by chance now and then.
  static constexpr Level creeps = 5;
  /// Lines farther apart than this tell different stories: their mean tells none.
  static constexpr Level apart = 6;

  // How many standard deviations make sure. The mean of few readings is tried a million times in a long hold.
  static constexpr Level sure_load = Level(3.3), sure_mean = 5, sure_turn = 5;
  static constexpr Level sure_slope = 3, left_behind = 3;

  template <class Array>
  static auto& at(Array& array, int i) {
    return Lines::at(array, i);
  }
  bool is_new(int i) const { return at(lines_.age, i) == 1 && at(lines_.known, i) == 1; }
  /// Whatever was read before: else what it was led to by one that was none could be the end.
  bool is_reading(Scalar given) const { return std::fabs(given * per_sd_) < Scalar(farthest); }
  Level level_of(Scalar reading) const {
    // What is none, or too far, is farther than any.
    constexpr Scalar end = 2 * Scalar(farthest);
    const Scalar level = (reading - base_) * per_sd_, below = level < end ? level : end;
    return static_cast<Level>(larger(below, -end));
  }
  LineState<Level> line(int i) const {
    return {at(lines_.level, i), at(lines_.slope, i), at(lines_.level_variance, i), at(lines_.covariance, i),
            at(lines_.slope_variance, i)};
  }
  void set_sure(Scalar load) { set_sure(load, level_of(load)); }
  void set_sure(Scalar load, Level level) {
    sure_ = load;
    sure_level_ = level;
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
    if (ahead(sure_, load) < 0) {
      now.turned = true;
      now.turn = sure_;
      way_ = -way_;
    }
    now.load = now.sure = sure_ = load;
    return now;
  }

  ConditionedLoad<Scalar> begin_anew(bool usable, Scalar reading) {
    lines_.clear();
    calm_ = 0;
    if (!usable) return refuse();
    base_ = reading;
    set_sure(sure_);
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

  bool is_surprise(Level y) const {
    const Level r = y - at(lines_.level, best_);
    return r * r > surprise * surprise * (at(lines_.level_variance, best_) + 1);
  }
  struct Why {
    bool surprises, has_no_slope;
  };
  /// A line that began `since` ago, by a bend of what was the best line until then, or by a jump: where the
  /// reading `y`, with this variance, is expected from there. The lines are at this sample, but have not
  /// taken it yet; samples are `dt` apart.
  void begin_line(Why why, Level dt, Level since, Level y, Level noise) {
    const Level odds = static_cast<Level>(since_birth_) * at(lines_.weight, best_) /
                       (static_cast<Level>(at(lines_.age, best_)) + least_length);
    since_birth_ = 0;
    const Level come = corner(since), level = at(lines_.level, best_), slope = at(lines_.slope, best_);
    const Level level_variance = at(lines_.level_variance, best_), covariance = at(lines_.covariance, best_);
    const Level slope_variance = at(lines_.slope_variance, best_);
    const std::int32_t known = at(lines_.known, best_);
    make_room(why.surprises, y);
    const int born = lines_.add();
    const Level square = (y - level) * (y - level), variance = level_variance + noise;
    const bool is_jump = why.has_no_slope || square > farthest_bend * (variance + steep_bend * steep_bend);
    const Level jump = larger(square, least_jump * least_jump);
    const Level bend = square > gentle * variance ? steep_bend : gentle_bend, change = bend / dt;
    const Level bent = change * since;
    at(lines_.level, born) = level;
    at(lines_.slope, born) = is_jump ? Level(0) : slope;
    at(lines_.level_variance, born) = is_jump ? jump : level_variance + bent * bent;
    at(lines_.covariance, born) = is_jump ? Level(0) : covariance + bent * change;
    at(lines_.slope_variance, born) = is_jump ? Level(0) : slope_variance + change * change;
    at(lines_.weight, born) = odds * (is_jump ? jumps : bends);
    at(lines_.corner, born) = come;
    at(lines_.mean, born) = 0;
    at(lines_.age, born) = at(lines_.strays, born) = 0;
    // Else a jump that bends at once were taken for a new one.
    at(lines_.known, born) = is_jump ? 0 : known < 2 ? 2 : known;
  }
  /// The farthest that the load had come `since` ago, as the best line has it. A load that is already on its
  /// way back came farthest before that.
  Level corner(Level since) const {
    const Level last = reached(since), before = at(lines_.corner, best_);
    const bool returns = lines_.has_slope(best_, sure_slope) && ahead(Level(0), at(lines_.slope, best_)) < 0;
    return returns && ahead(last, before) > left_behind ? before : last;
  }
  /// Where the load had come at the last reading that the best line believed. In a hold its slope is known to
  /// be zero, which halves the scatter.
  Level reached(Level since) const {
    const Level level = at(lines_.level, best_), slope = at(lines_.slope, best_);
    const Level slope_variance = at(lines_.slope_variance, best_);
    if (!lines_.has_slope(best_, sure_slope) && slope_variance > 0)
      return level - at(lines_.covariance, best_) / slope_variance * slope;
    return level - (static_cast<Level>(at(lines_.strays, best_)) * step_ + since) * slope;
  }

  /// If there is none, what contributes nothing goes, or the less likely of the two lines whose ages are most
  /// alike, at a surprise with the reading that comes. The other one takes its weight, and its spread: but a
  /// long hold must not become uncertain by what does not last.
  void make_room(bool surprises, Level y) {
    if (lines_.size < Lines::capacity) return;
    int least = 0;
    for (int k = 1; k < Lines::capacity; ++k)
      if (lines_.weight_of(k) < lines_.weight_of(least)) least = k;
    if (lines_.weight_of(least) < neglected) return lines_.drop(least);
    const int rank = most_alike(), older = lines_.place(rank), younger = lines_.place(rank + 1);
    const auto likely = [&](int i) {
      return at(lines_.weight, i) * (surprises ? lines_.density(i, y) : Level(1));
    };
    const bool keeps_older = likely(older) > likely(younger);
    const int gone = keeps_older ? younger : older, kept = keeps_older ? older : younger;
    const Level d = at(lines_.level, gone) - at(lines_.level, kept);
    if (std::fabs(d) < apart / 2) {
      const Level more = at(lines_.weight, gone);
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
  Level find_best() {
    Level total = 0, most = -1;
    for (int i = 0; i < Lines::capacity; ++i) {
      const Level weight = at(lines_.weight, i);
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
    const Level far = std::fabs(at(lines_.slope, best_)) * lasts(),
                on = std::fabs(expected.level - told.level);
    const Level gone = -larger(-far, -on), variance = larger(expected.sd * expected.sd, told.variance);
    return {told.level, std::sqrt(variance + gone * gone)};
  }
  /// `total` is the sum of the weights; it becomes one. `told` is where the load stays if the reading `y` is
  /// not accepted.
  ConditionedLoad<Scalar> conclude(bool accepted, Level total, Level y, const Told& told = {}) {
    Estimate estimate = estimate_load(total);
    const Level unit = 1 / total;
    for (int k = 0; k < lines_.size; ++k) {
      Level& weight = at(lines_.weight, lines_.place(k));
      weight = larger(least_weight, weight * unit);
    }
    if (!accepted) estimate = hold(told, estimate);
    off_best_ = estimate.level - at(lines_.level, best_);
    beside_best_ = estimate.sd * estimate.sd - at(lines_.level_variance, best_);
    ConditionedLoad<Scalar> now;
    if (accepted) {
      if (has_turned(estimate, beyond_sure(estimate))) turn_round(now);
      go_on(estimate, beyond_sure(estimate), [&](Level way) { return least_mean(estimate, way, y); });
    }
    say(now, estimate, beyond_sure(estimate));
    now.refused = !accepted;
    move_base();
    return now;
  }
  void say(ConditionedLoad<Scalar>& now, const Estimate& estimate, Level further) const {
    now.load = force(estimate.level);
    now.sd = static_cast<Scalar>(estimate.sd) * sd_;
    now.sure = sure_;
    // Below zero there is no load: both are zero then.
    if (further < 0) now.behind = now.load != sure_;
  }
  /// How much further the load probably is than it surely is, as it goes at present.
  Level beyond_sure(const Estimate& estimate) const { return way_ * (estimate.level - sure_level_); }
  static bool has_turned(const Estimate& estimate, Level further) {
    return -further > sure_turn * estimate.sd;
  }
  /// The line of a long hold, or -1. It is left only when hardly anything speaks for it any more: among a
  /// million readings there are some that look like a bend. `all` is the sum of the weights.
  int long_hold(Level all) const {
    const int oldest = lines_.place(0);
    const bool holds = at(lines_.age, oldest) >= old_age && at(lines_.weight, oldest) > patience * all &&
                       !lines_.has_slope(oldest, creeps);
    return holds ? oldest : -1;
  }
  /// About the best line, or that of a long hold.
  Estimate estimate_load(Level all) const {
    const int hold = long_hold(all);
    const Level from = at(lines_.level, hold < 0 ? best_ : hold);
    // Side by side, then in a row: sums have an order.
    typename Lines::Lanes weights, means, squares;
    for (std::size_t i = 0; i < Lines::capacity; ++i) {
      const Level d = lines_.level[i] - from;
      const Level given = lines_.weight[i], weight = std::fabs(d) > apart ? Level(0) : given;
      weights[i] = weight;
      means[i] = weight * d;
      squares[i] = weight * (d * d + lines_.level_variance[i]);
    }
    Level total = 0, mean = 0, square = 0;
    for (int i = 0; i < Lines::capacity; ++i) {
      total += at(weights, i);
      mean += at(means, i);
      square += at(squares, i);
    }
    const Level unit = 1 / total;
    if (hold >= 0) return {from, std::sqrt(square * unit)};
    mean *= unit;
    return {from + mean, std::sqrt(larger(square * unit - mean * mean, Level(0)))};
  }
  void turn_round(ConditionedLoad<Scalar>& now) {
    const Scalar corner = force(at(lines_.corner, best_));
    if (ahead(sure_, corner) > 0) set_sure(corner);
    now.turned = true;
    now.turn = sure_;
    way_ = -way_;
    calm_ = 0;
    // The means of older lines are from before the turn.
    while (lines_.size > 1 && lines_.place(0) != best_) lines_.drop(0);
  }
  /// `least(way)` is what the load surely is by means of readings, times the way that it goes.
  template <class Least>
  void go_on(const Estimate& estimate, Level further, const Least& least) {
    if (!(further > sure_load * estimate.sd)) return;
    const Level most = way_ * estimate.level - sure_load * estimate.sd;
    const Level level = way_ * -larger(-least(way_), -most);
    const Scalar come = force(level);
    if (ahead(sure_, come) > 0) set_sure(come, come > 0 ? level : level_of(come));
  }
  Level least_mean(const Estimate& estimate, Level way, Level y) const {
    const auto near = [&](Level level, Level least) {
      return std::fabs(level - estimate.level) <= apart ? least : -farthest;
    };
    // The reading itself is a mean of one.
    Level mean = near(y, way * y - sure_mean);
    const auto deviation = lines_.mean_deviations();
    for (int k = 0; k < lines_.size; ++k) {
      const int i = lines_.place(k);
      const Level least = way * at(lines_.mean, i) - sure_mean * at(deviation, i);
      mean = larger(mean, near(at(lines_.level, i), least));
    }
    return mean;
  }
  /// Keeps levels small, so that no digits are lost where the load is large and the noise is not.
  void move_base() {
    if (std::fabs(at(lines_.level, best_)) < 64) return;
    const Scalar base = base_ + static_cast<Scalar>(at(lines_.level, best_)) * sd_;
    const auto moved = static_cast<Level>((base - base_) * per_sd_);
    base_ = base;
    set_sure(sure_);
    for (auto* const lanes : {&lines_.level, &lines_.mean, &lines_.corner})
      for (Level& each : *lanes) each -= moved;
  }

  Lines lines_;
  Block block_;
  Scalar sd_ = 0, per_sd_ = 0, base_ = 0;
  Scalar sure_ = 0, sure_before_ = 0;  // now; before the readings that wait
  Level sure_level_ = 0;
  // The estimate less the level of the best line, its variance less that of this line.
  Level off_best_ = 0, beside_best_ = 0;
  Level waits_sd_ = 0;           // standard deviation of the estimate while readings wait
  Level waits_bent_ = 0;         // and its growth with their drift
  Level step_ = 0, usual_ = 0;   // the last one; what they usually are
  Level missed_ = 0;             // time since the last reading that was one
  Level way_ = 1;                // that the load goes: up or down
  std::int8_t best_ = 0;         // of the lines, the most likely
  std::int8_t since_birth_ = 0;  // samples since a line began
  std::int8_t calm_ = 0;         // samples without surprise
};

}  // namespace taut
