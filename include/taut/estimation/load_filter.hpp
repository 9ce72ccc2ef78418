// The true load behind the noisy readings of a jack's load cell, fit for a model with friction.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/numerics/bits.hpp"
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
/// mean and spread. A new line is weighed at every sample, and as there is room for few, the young ones are
/// kept closer together.
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
  }

  /// Takes the next reading [N], `dt` > 0 after the one before, in any unit of time; for the first it is of
  /// no account. What is not finite is refused.
  ConditionedLoad<Scalar> take(Scalar reading, Scalar dt) {
    if (sd_ == 0) return take_exact(reading);
    const Scalar y = (reading - base_) / sd_;
    const bool usable = std::fabs(y) < farthest;
    if (lines_in_use_ == 0) return usable ? take_first(reading) : refuse();
    const Scalar step = dt > 0 && std::isfinite(dt) ? dt : Scalar(0);
    const Line parent = line(best_);
    for (int i = 0; i < lines_in_use_; ++i) line(i).advance(step);
    if (!usable) return conclude(false, 1);
    for (int i = 0; i < lines_in_use_; ++i) line(i).weigh(y);
    make_room();
    line(lines_in_use_++) = begin_line(parent, step, y);
    const Scalar total = find_best();
    return conclude(line(best_).strays == 0, total);
  }

 private:
  // Forces of lines are in standard deviations of a reading, from `base_`; densities are those of such
  // readings.

  static constexpr std::size_t capacity = 5;
  static constexpr Scalar farthest =
      Scalar(1e9);  ///< what is farther is no reading, and its square overflows

  /// A line remembers so many readings, so that slow creep is followed.
  static constexpr int memory = 2048;
  static constexpr int mean_memory = 4096;
  static constexpr std::uint16_t greatest_age = 65535;
  /// Lines that began longer ago than this are as good as one another.
  static constexpr std::uint16_t old_age = 1024;

  /// The odds that a piece ends now are 1 in its age and this: pieces of every length are as likely.
  static constexpr Scalar least_length = 15;
  static constexpr Scalar bends = Scalar(0.8), jumps = Scalar(0.002);
  /// Changes of slope to be expected, per sample; in between the better of the two will do.
  static constexpr Scalar gentle_bend = Scalar(0.15), steep_bend = 3;
  static constexpr Scalar slope_after_jump = 10;
  /// Density of readings that know nothing of the line: outliers and where jumps lead.
  static constexpr Scalar anywhere = Scalar(0.003);
  static constexpr Scalar outliers = Scalar(0.0005);  ///< makes 5 standard deviations the limit
  static constexpr Scalar again = Scalar(0.01);       ///< outliers come alone
  static constexpr int most_strays = 2;               ///< more in a row were a step
  static constexpr int established = 6;               ///< readings that make a line worth more than a reading

  static constexpr Scalar neglected = Scalar(1e-9), least_weight = Scalar(1e-30);
  static constexpr Scalar patience = Scalar(1e-4);  ///< weight of a long hold that is enough
  /// Lines farther apart than this tell different stories: their mean tells none.
  static constexpr Scalar apart = 6;

  // How many standard deviations make sure. The mean of few readings is tried a million times in a long hold.
  static constexpr Scalar sure_load = Scalar(3.3), sure_mean = 5, sure_turn = 5;
  static constexpr Scalar sure_slope = 3, left_behind = 3;

  /// exp(x), x <= 0, to a part in ten thousand: a power of two, its fraction by a polynomial.
  static Scalar exponential(Scalar x) {
    const Scalar u = (x > -60 ? x : Scalar(-60)) * Scalar(1.44269504);
    const int whole = static_cast<int>(u);
    const Scalar f = u - static_cast<Scalar>(whole);
    return power_of_two<Scalar>(whole) *
           (1 + f * (Scalar(0.6931472) +
                     f * (Scalar(0.2402265) + f * (Scalar(0.0555041) + f * Scalar(0.0096181)))));
  }

  /// Of a number that is `r` off the mean of a normal distribution.
  static Scalar density(Scalar r, Scalar precision) {
    return Scalar(0.39894228) * std::sqrt(precision) * exponential(-r * r * precision / 2);
  }

  /// One way to see the present piece of the path, fitted by recursive least squares.
  struct Line {
    Scalar level = 0, slope = 0;  ///< at the newest sample
    Scalar level_variance = 1, covariance = 0, slope_variance = 0;
    Scalar weight = 1;  ///< probability
    Scalar mean = 0;    ///< of the readings since it began
    Scalar corner = 0;  ///< the farthest that the load had come when it began
    std::uint16_t age = 1;
    std::uint8_t known = 1;   ///< readings since the last jump, at most `established`
    std::uint8_t strays = 0;  ///< readings in a row that it took for outliers

    bool is_new() const { return age == 1 && known == 1; }
    static Scalar averaged(int age) { return age < mean_memory ? Scalar(age) : Scalar(mean_memory); }
    bool has_slope() const { return slope * slope > sure_slope * sure_slope * slope_variance; }

    void advance(Scalar dt) {
      // Only now is it known what a sample is in time.
      if (is_new() && dt > 0) slope_variance = slope_after_jump / dt * (slope_after_jump / dt);
      if (age >= memory) forget();
      level += dt * slope;
      level_variance += dt * (2 * covariance + dt * slope_variance);
      covariance += dt * slope_variance;
    }
    void forget() {
      constexpr Scalar growth = 1 + Scalar(1) / memory;
      level_variance *= growth;
      covariance *= growth;
      slope_variance *= growth;
    }
    Scalar outlier_density() const {
      if (known < established || strays >= most_strays) return 0;
      return (strays == 0 ? outliers : again * outliers) * anywhere;
    }
    /// Takes the reading into account, or for an outlier.
    void weigh(Scalar y) {
      // One division for two.
      const Scalar variance = level_variance + 1, readings = averaged(age + 1);
      const Scalar both = 1 / (variance * readings), precision = both * readings;
      const Scalar fits = density(y - level, precision), stray = outlier_density();
      weight *= fits + stray;
      if (stray > fits) {
        ++strays;
        return;
      }
      strays = 0;
      learn(y, precision);
      if (age < greatest_age) ++age;
      mean += (y - mean) * (both * variance);
    }
    void learn(Scalar y, Scalar precision) {
      const Scalar r = y - level;
      level += level_variance * precision * r;
      slope += covariance * precision * r;
      slope_variance -= covariance * covariance * precision;
      level_variance *= precision;
      covariance *= precision;
      if (known < established) ++known;
    }
    /// Where the load had come at the last reading that it believed. In a hold its slope is known to be zero,
    /// which halves the scatter.
    Scalar reached(Scalar dt) const {
      if (!has_slope() && slope_variance > 0) return level - covariance / slope_variance * slope;
      return level - Scalar(strays) * dt * slope;
    }
  };

  Line& line(int i) { return lines_[static_cast<std::size_t>(i)]; }
  const Line& line(int i) const { return lines_[static_cast<std::size_t>(i)]; }
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

  ConditionedLoad<Scalar> take_first(Scalar reading) {
    base_ = reading;
    lines_in_use_ = 1;
    return conclude(true, 1);
  }

  ConditionedLoad<Scalar> refuse() const {
    ConditionedLoad<Scalar> now;
    now.load = now.sure = sure_;
    now.sd = sd_;
    now.refused = true;
    return now;
  }

  /// The line that begins with this reading: by a bend of what was the best line until then, or by a jump.
  Line begin_line(const Line& parent, Scalar dt, Scalar y) const {
    const Scalar odds = parent.weight / (Scalar(parent.age) + least_length);
    Line born;
    born.level = born.mean = y;
    born.weight = odds * jumps * anywhere;
    born.corner = corner_after(parent, dt);
    if (!(dt > 0) || parent.is_new()) return born;
    const Scalar covariance = parent.covariance + dt * parent.slope_variance;
    const Scalar level_variance = parent.level_variance + dt * (parent.covariance + covariance);
    const Scalar r = y - (parent.level + dt * parent.slope);
    Scalar chosen = 0, chosen_precision = 0;
    for (const Scalar bend : {gentle_bend, steep_bend}) {
      const Scalar variance = level_variance + bend * bend + 1, precision = 1 / variance;
      const Scalar weight = odds * bends * density(r, precision);
      if (weight > born.weight) {
        born.weight = weight;
        chosen = bend;
        chosen_precision = precision;
      }
      // So near, a steep bend explains it worse.
      if (r * r < 2 * variance) break;
    }
    if (chosen > 0) {
      const Scalar change = chosen / dt;
      born.level = y - r;
      born.slope = parent.slope;
      born.level_variance = level_variance + chosen * chosen;
      born.covariance = covariance + chosen * change;
      born.slope_variance = parent.slope_variance + change * change;
      // Else a jump that bends at once were taken for a new one.
      born.known = parent.known < 2 ? std::uint8_t(2) : parent.known;
      born.learn(y, chosen_precision);
    }
    return born;
  }
  /// A load that is already on its way back came farthest before that.
  Scalar corner_after(const Line& parent, Scalar dt) const {
    const Scalar reached = parent.reached(dt);
    const bool returns = parent.has_slope() && ahead(0, parent.slope) < 0;
    return returns && ahead(reached, parent.corner) > left_behind ? parent.corner : reached;
  }

  /// Lines are in the order of their age, the oldest first. What contributes nothing goes; if there still is
  /// no room, the less likely of the two whose ages are most alike.
  void make_room() {
    Scalar total = 0;
    for (int i = 0; i < lines_in_use_; ++i) total += line(i).weight;
    for (int i = lines_in_use_ - 1; i >= 0; --i)
      if (lines_in_use_ > 1 && line(i).weight < neglected * total) drop(i);
    if (lines_in_use_ < static_cast<int>(capacity)) return;
    const int older = most_alike(), younger = older + 1;
    const bool keeps_older = line(older).weight > line(younger).weight;
    const int gone = keeps_older ? younger : older, kept = keeps_older ? older : younger;
    if (std::fabs(line(gone).level - line(kept).level) < apart / 2) line(kept).weight += line(gone).weight;
    drop(gone);
  }
  /// The older one of the pair.
  int most_alike() const {
    const auto age = [this](int i) -> int { return line(i).age < old_age ? line(i).age : old_age; };
    int found = 0;
    for (int i = 1; i + 1 < lines_in_use_; ++i)
      found = age(i) * age(found + 1) <= age(found) * age(i + 1) ? i : found;
    return found;
  }
  void drop(int gone) {
    --lines_in_use_;
    for (int i = gone; i < lines_in_use_; ++i) line(i) = line(i + 1);
  }

  /// Returns the sum of the weights.
  Scalar find_best() {
    Scalar total = 0;
    best_ = 0;
    for (int i = 0; i < lines_in_use_; ++i) {
      if (!(line(i).weight > least_weight)) line(i).weight = least_weight;
      total += line(i).weight;
      if (line(i).weight > line(best_).weight) best_ = static_cast<std::int8_t>(i);
    }
    return total;
  }

  /// `total` is the sum of the weights; it becomes one.
  ConditionedLoad<Scalar> conclude(bool accepted, Scalar total) {
    const Estimate estimate = estimate_load(total);
    const Scalar unit = 1 / total;
    for (int i = 0; i < lines_in_use_; ++i) line(i).weight *= unit;
    ConditionedLoad<Scalar> now;
    now.load = force(estimate.level);
    now.sd = estimate.sd * sd_;
    now.refused = !accepted;
    if (accepted) {
      const Scalar past = ahead(estimate.level, (sure_ - base_) / sd_);
      if (past > sure_turn * estimate.sd) turn_round(now);
      go_on(estimate);
    }
    now.sure = sure_;
    move_base();
    return now;
  }
  struct Estimate {
    Scalar level, sd;
  };
  /// About the best line. A long hold is left only when hardly anything speaks for it any more: among a
  /// million readings there are some that look like a bend.
  Estimate estimate_load(Scalar all) const {
    const Line& oldest = line(0);
    if (oldest.age >= old_age && oldest.weight > patience * all && !oldest.has_slope())
      return {oldest.level, spread_about(oldest.level)};
    const Scalar from = line(best_).level;
    Scalar total = 0, mean = 0, square = 0;
    for (int i = 0; i < lines_in_use_; ++i) {
      const Scalar d = line(i).level - from, weight = line(i).weight;
      if (std::fabs(d) > apart) continue;
      total += weight;
      mean += weight * d;
      square += weight * (d * d + line(i).level_variance);
    }
    const Scalar unit = 1 / total;
    mean *= unit;
    return {from + mean, std::sqrt(square * unit - mean * mean)};
  }
  /// Standard deviation about a level, of the lines near it.
  Scalar spread_about(Scalar level) const {
    Scalar total = 0, square = 0;
    for (int i = 0; i < lines_in_use_; ++i) {
      const Scalar d = line(i).level - level;
      if (std::fabs(d) > apart) continue;
      total += line(i).weight;
      square += line(i).weight * (d * d + line(i).level_variance);
    }
    return std::sqrt(square / total);
  }
  void turn_round(ConditionedLoad<Scalar>& now) {
    const Scalar corner = force(line(best_).corner);
    if (ahead(sure_, corner) > 0) sure_ = corner;
    now.turned = true;
    now.turn = sure_;
    falls_ = !falls_;
    // The means of older lines are from before the turn.
    for (; best_ > 0; --best_) drop(0);
  }
  void go_on(const Estimate& estimate) {
    const Scalar way = falls_ ? Scalar(-1) : Scalar(1);
    const Scalar most = way * estimate.level - sure_load * estimate.sd;
    if (!(ahead(sure_, force(way * most)) > 0)) return;
    Scalar mean = -farthest;
    for (int i = 0; i < lines_in_use_; ++i) {
      const Scalar least = way * line(i).mean - sure_mean / std::sqrt(Line::averaged(line(i).age));
      const bool is_near = std::fabs(line(i).level - estimate.level) <= apart;
      mean = larger(mean, is_near ? least : -farthest);
    }
    mean = -larger(-mean, -most);
    const Scalar come = force(way * mean);
    if (ahead(sure_, come) > 0) sure_ = come;
  }
  /// Keeps levels small, so that no digits are lost where the load is large and the noise is not.
  void move_base() {
    if (std::fabs(line(best_).level) < 64) return;
    const Scalar base = base_ + line(best_).level * sd_;
    const Scalar moved = (base - base_) / sd_;
    base_ = base;
    for (int i = 0; i < lines_in_use_; ++i) {
      line(i).level -= moved;
      line(i).mean -= moved;
      line(i).corner -= moved;
    }
  }

  std::array<Line, capacity> lines_;
  Scalar sd_ = 0, base_ = 0;
  Scalar sure_ = 0;
  std::int8_t lines_in_use_ = 0, best_ = 0;
  bool falls_ = false;
};

}  // namespace taut
