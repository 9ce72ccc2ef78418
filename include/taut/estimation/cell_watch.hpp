// What is noticed of a load cell beside its readings: its noise, whether it fits the model, whether it lives.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/estimation/consistency.hpp"
#include "taut/estimation/lone_outliers.hpp"
#include "taut/estimation/noise_level.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Of the load cell at an anchored end. A plain value.
template <class Scalar>
struct CellWatch {
  /// A cell that reads the very same while the force should have gone by so many deviations of its noise, and
  /// by this part of itself, does not live: a display that is coarser than that must say so (`resolution`).
  static constexpr Scalar far = 10, part = Scalar(0.02);
  static constexpr std::uint8_t often = 3;

  NoiseLevel<Scalar> noise;
  Scalar sd = 0;     ///< that readings are taken to scatter by [N]
  Scalar lasts = 0;  ///< what they are off by together, NoiseLevel::Found::lasting [N]
  Consistency<Scalar> fit;
  LoneOutliers<Scalar> outliers;
  Scalar last = 0;         ///< reading [N]
  Scalar expected = 0;     ///< of the force when it was first read [N]
  std::uint8_t same = 0;   ///< readings in a row that were no other
  bool is_frozen = false;  ///< it keeps `last` although the force has gone on
  bool is_told = false;    ///< that nothing is learned from it at present

  void start(Scalar at_least) {
    *this = CellWatch();
    noise.start(at_least);
    sd = at_least;
  }
  /// Another reading [N], `dt` [s] after the one before, tells how much they scatter. Returns by how many
  /// times their variance is larger than it was ever taken to be, or one.
  Scalar follow_noise(Scalar reading, Scalar dt) {
    if (!noise.take(reading, dt)) return 1;
    const auto found = noise.found();
    lasts = found.lasting;
    const Scalar times = found.sd / sd;
    if (!NoiseLevel<Scalar>::is_worth_it(times)) return 1;
    sd = found.sd;
    return noise.rises_to(sd);
  }
  /// Whether it goes on being frozen with this reading [N].
  bool stays_frozen(Scalar reading) const { return is_frozen && reading == last; }
  /// A reading of what should be `force` [N], with the variances of that and of the noise.
  void take(Scalar reading, Scalar force, Scalar of_model, Scalar of_noise) {
    fit.take(outliers.confirmed(reading - force, std::sqrt(of_model + of_noise)), of_model, of_noise);
    follow(reading, force, std::sqrt(of_model));
  }
  /// `deviation` is that of the force: what may not have gone on is no sign that the cell does not live.
  void follow(Scalar reading, Scalar force, Scalar deviation) {
    if (reading != last || same == 0) {
      last = reading;
      expected = force;
      same = 1;
      is_frozen = false;
      return;
    }
    if (same < often) ++same;
    const Scalar gone = std::fabs(force - expected) - 2 * deviation;
    is_frozen = same == often && gone > far * sd && gone > part * std::fabs(force);
    // What it should not have read says nothing of the model.
    if (is_frozen) fit = {};
  }
};

}  // namespace taut
