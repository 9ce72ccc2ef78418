// A few straight lines in time that compete to explain the same readings.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/numerics/bits.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Lines fitted by recursive least squares to readings with Gaussian noise of standard deviation one, each
/// begun at another sample, with the probability that it is the true one.
///
/// Every number of all of them is one array, so that a processor which can computes the hypotheses side by
/// side. `order` has the places of those in use, the oldest line first; the others have no weight.
template <class Scalar, int Capacity>
struct LoadHypotheses {
  static constexpr int capacity = Capacity;
  using Lanes = std::array<Scalar, static_cast<std::size_t>(Capacity)>;
  using Counts = std::array<std::int32_t, static_cast<std::size_t>(Capacity)>;

  /// A line remembers so many readings, so that slow creep is followed.
  static constexpr int memory = 2048;
  static constexpr Scalar mean_memory = 4096;
  static constexpr int longest_run = 65535;
  /// Density of readings that know nothing of the line.
  static constexpr Scalar clutter_density = Scalar(0.003);
  static constexpr Scalar outlier_probability = Scalar(0.0005);  ///< makes 5 standard deviations the limit
  static constexpr Scalar repeated_outlier = Scalar(0.01);       ///< outliers come alone
  static constexpr int most_outliers = 2;                        ///< more in a row were a step
  static constexpr int established = 6;  ///< readings that make a line worth more than a reading

  Lanes level{}, slope{};  ///< at the newest sample
  Lanes level_variance{}, covariance{}, slope_variance{};
  Lanes weight{};              ///< probability
  Lanes mean{};                ///< of the readings since it began
  Lanes corner{};              ///< the farthest that the load had come when it began
  Counts run_length{};         ///< readings that it has taken
  Counts known{};              ///< readings since the last jump, at most `established`
  Counts outliers_in_a_row{};  ///< readings in a row that it took for outliers
  std::array<std::int8_t, static_cast<std::size_t>(Capacity)> order{};
  std::int8_t size = 0;

  template <class Array>
  static auto& at(Array& array, int i) {
    return array[static_cast<std::size_t>(i)];
  }
  /// The place of a line, by rank: the longest run first.
  int place(int rank) const { return at(order, rank); }
  Scalar weight_of(int rank) const { return at(weight, place(rank)); }

  void clear() {
    *this = LoadHypotheses();
    for (int i = 0; i < capacity; ++i) at(order, i) = static_cast<std::int8_t>(i);
  }
  /// Returns the place of a new line; there must be room.
  int add() { return at(order, size++); }
  void drop(int rank) {
    const std::int8_t gone = at(order, rank);
    --size;
    for (int k = rank; k < size; ++k) at(order, k) = at(order, k + 1);
    at(order, size) = gone;
    at(run_length, gone) = 0;
    // It is computed with the others: what has no variance and no weight stays finite and without weight.
    for (Lanes* const each : {&level, &slope, &level_variance, &covariance, &slope_variance, &weight, &mean})
      at(*each, gone) = 0;
  }

  /// Before so many readings more: those of long ago count less.
  void forget(int count) {
    if (at(run_length, place(0)) < memory) return;
    const Scalar growth = 1 + static_cast<Scalar>(count) / memory;
    for (std::size_t i = 0; i < lanes; ++i) {
      const Scalar factor = run_length[i] >= memory ? growth : Scalar(1);
      level_variance[i] *= factor;
      covariance[i] *= factor;
      slope_variance[i] *= factor;
    }
  }
  /// Lets time pass.
  void advance(Scalar dt) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const Scalar covaries = covariance[i] + dt * slope_variance[i];
      level[i] += dt * slope[i];
      level_variance[i] += dt * (covariance[i] + covaries);
      covariance[i] = covaries;
    }
  }
  /// Every line takes the mean `y` of so many readings into account; a single one perhaps for an outlier.
  void update(Scalar y, int count) {
    const Scalar n = static_cast<Scalar>(count), noise = 1 / n, alone = count == 1 ? Scalar(1) : Scalar(0);
    Lanes precision, root, share, square, fit;
    for (std::size_t i = 0; i < lanes; ++i) {
      // One division for two.
      const Scalar older = static_cast<Scalar>(run_length[i] + count),
                   readings = older < mean_memory ? older : mean_memory;
      const Scalar variance = level_variance[i] + noise, both = 1 / (variance * readings);
      precision[i] = both * readings;
      share[i] = both * variance * n;
      square[i] = (y - level[i]) * (y - level[i]) * precision[i];
    }
    for (std::size_t i = 0; i < lanes; ++i) root[i] = std::sqrt(precision[i]);
    for (std::size_t i = 0; i < lanes; ++i) square[i] = square[i] < farthest ? square[i] : farthest;
    for (std::size_t i = 0; i < lanes; ++i) fit[i] = density(square[i], root[i]);
    for (std::size_t i = 0; i < lanes; ++i) {
      const Scalar r = y - level[i], fits = fit[i];
      const Scalar stray = alone * outlier_density(known[i], outliers_in_a_row[i]);
      weight[i] *= fits + stray;
      // One, or zero for an outlier: a product instead of a branch.
      const std::int32_t taken = stray > fits ? 0 : 1, older = run_length[i] + count * taken,
                         better = known[i] + count * taken;
      const Scalar takes = static_cast<Scalar>(taken), p = precision[i] * takes, left = 1 - takes + p * noise;
      const Scalar level_gain = level_variance[i] * p, slope_gain = covariance[i] * p;
      level[i] += level_gain * r;
      slope[i] += slope_gain * r;
      // Where a step was long, rounding could make it negative.
      slope_variance[i] = larger(slope_variance[i] - covariance[i] * slope_gain, Scalar(0));
      level_variance[i] *= left;
      covariance[i] *= left;
      mean[i] += (y - mean[i]) * (share[i] * takes);
      outliers_in_a_row[i] = (outliers_in_a_row[i] + 1) * (1 - taken);
      run_length[i] = older < longest_run ? older : longest_run;
      known[i] = better < established ? better : established;
    }
  }

  /// Of a reading, as the line expects it.
  Scalar density(int i, Scalar y) const {
    const Scalar precision = 1 / (at(level_variance, i) + 1), r = y - at(level, i),
                 square = r * r * precision;
    return density(square < farthest ? square : farthest, std::sqrt(precision)) +
           outlier_density(at(known, i), at(outliers_in_a_row, i));
  }
  /// Whether the slope is beyond so many of its standard deviations.
  bool has_slope(int i, Scalar deviations) const {
    return at(slope, i) * at(slope, i) > deviations * deviations * at(slope_variance, i);
  }
  /// Standard deviations of mean.
  Lanes mean_deviations() const {
    Lanes deviation;
    for (std::size_t i = 0; i < lanes; ++i) {
      const Scalar readings = static_cast<Scalar>(run_length[i]);
      deviation[i] = readings < mean_memory ? readings : mean_memory;
    }
    for (std::size_t i = 0; i < lanes; ++i) deviation[i] = 1 / std::sqrt(deviation[i]);
    return deviation;
  }

 private:
  static constexpr Scalar farthest = 120;
  static constexpr std::size_t lanes = static_cast<std::size_t>(Capacity);

  /// Of a number whose distance from the mean of a normal distribution has this square, in standard
  /// deviations, at most `farthest`; `root` is the root of the precision. To a part in ten thousand: exp() is
  /// a power of two, its fraction by a polynomial.
  static Scalar density(Scalar square, Scalar root) {
    const Scalar u = Scalar(-0.72134752) * square;
    const auto [whole, power] = whole_power_of_two(u);
    const Scalar f = u - whole;
    return Scalar(0.39894228) * root * power *
           (1 + f * (Scalar(0.6931472) +
                     f * (Scalar(0.2402265) + f * (Scalar(0.0555041) + f * Scalar(0.0096181)))));
  }
  static Scalar outlier_density(std::int32_t known, std::int32_t outliers_in_a_row) {
    const Scalar alone = outlier_probability * clutter_density,
                 repeated = outliers_in_a_row == 0 ? alone : repeated_outlier * alone;
    return known < established || outliers_in_a_row >= most_outliers ? Scalar(0) : repeated;
  }
};

}  // namespace taut
