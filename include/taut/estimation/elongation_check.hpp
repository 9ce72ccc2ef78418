// Whether the stroke of a jack grows as it should: the slope of elongation over a leg of pulling.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "taut/estimation/alarms.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The extension of a jack that is expected in a row, at the best estimate of loads and unknowns.
template <class Scalar>
struct ExpectedExtension {
  Scalar value = 0;        ///< [m]
  Scalar of_unknowns = 0;  ///< its variance by what is not known of constants [m^2]
  Scalar by_friction = 0;  ///< by the friction of all joints at once [m / unit of an unknown]
  Scalar of_loads = 0;     ///< its variance by the errors of the loads of this row [m^2]
};

/// Compares the increments of a measured stroke s with those of the expected extension E along one leg of a
/// jack: between two reversals or lock-offs, without what lies below AlarmLimits::initial_strain. From a row
/// back to an earlier place of the leg, Eq. (40),
///     q = (s - s_0) / (E - E_0)
/// is off where |q - 1| exceeds the tolerance by more than five of its standard deviations, and stays off
/// until by less than half as many. Where a stroke is read from does not matter, nor slack that was taken out
/// before.
///
/// Readings are averaged over up to eight in a row between which the extension hardly goes on, and three
/// earlier places are kept: where the leg began, and two that follow, so that a slope that changes late is
/// seen over the last part of the leg, too. No place is kept while the slope is off. A plain value: it can be
/// saved and read back byte by byte. Cost: some ten operations and a root for every place.
template <class Scalar>
class ElongationCheck {
 public:
  static constexpr Scalar sigmas = 5;

  /// The next stroke belongs to another leg.
  void begin_leg() { *this = ElongationCheck(); }
  /// Takes a stroke [m] with what was expected of it. Returns whether the slope is off. Always possible.
  [[nodiscard]] bool take(Scalar stroke, const ExpectedExtension<Scalar>& expected,
                          const AlarmLimits<Scalar>& limits) {
    const Scalar misfit = stroke - expected.value, sd = limits.stroke_sd;
    // What has gone on, or jumps away, is averaged with nothing before.
    if (readings_ > 0 &&
        (std::fabs(expected.value - first_) >= 2 * sd || std::fabs(misfit - here_.misfit) > sigmas * sd))
      finish();
    if (readings_ == 0) first_ = expected.value;
    readings_ += 1;
    here_.misfit += (misfit - here_.misfit) / readings_;
    here_.expected += (expected.value - here_.expected) / readings_;
    here_.of_unknowns = expected.of_unknowns;
    here_.by_friction = expected.by_friction;
    here_.noise = expected.of_loads + sd * sd / readings_;
    const Scalar gate = is_off_ ? sigmas / 2 : sigmas;
    is_off_ = false;
    for (const Place& place : places_)
      is_off_ = is_off_ || (has_places_ && is_beyond(here_, place, limits.elongation, gate));
    if (readings_ == most_readings) finish();
    return is_off_;
  }
  /// Whether it was when the last stroke was taken.
  bool is_off() const { return is_off_; }

 private:
  /// The mean of readings.
  struct Place {
    Scalar misfit = 0;       ///< s - E [m]
    Scalar expected = 0;     ///< E [m]
    Scalar of_unknowns = 0;  ///< variance of E by unknowns when it was read [m^2]
    Scalar by_friction = 0;
    Scalar noise = 0;  ///< variance of s - E by what is independent from place to place [m^2]
  };
  static constexpr Scalar most_readings = 8;

  static bool is_beyond(const Place& here, const Place& before, Scalar tolerance, Scalar gate) {
    const Scalar off =
        std::fabs(here.misfit - before.misfit) - tolerance * std::fabs(here.expected - before.expected);
    return off > 0 && off * off > gate * gate * (here.noise + before.noise + of_unknowns(here, before));
  }
  /// Variance of E - E_0 by unknowns of which more may be known now, Eq. (41).
  static Scalar of_unknowns(const Place& here, const Place& before) {
    const Scalar now = here.of_unknowns, then = before.of_unknowns, most = std::sqrt(now * then);
    // Without friction all unknowns scale the extension.
    const Scalar common = here.by_friction == 0 ? most : now * (before.by_friction / here.by_friction);
    return larger(now + then - 2 * larger(-most, -larger(-most, -common)), Scalar(0));
  }
  /// The next reading belongs to another place. The last one kept is a quarter of the leg back or less, the
  /// one before up to about half.
  void finish() {
    readings_ = 0;
    if (is_off_) return;
    if (!has_places_) places_.fill(here_);
    has_places_ = true;
    const Scalar leg = std::fabs(here_.expected - places_[0].expected);
    if (!(4 * std::fabs(here_.expected - places_[2].expected) > leg)) return;
    places_[1] = places_[2];
    places_[2] = here_;
  }

  std::array<Place, 3> places_{};
  Place here_;           // the mean of the readings since
  Scalar readings_ = 0;  // their number
  Scalar first_ = 0;     // what was expected of the first of them [m]
  bool has_places_ = false, is_off_ = false;
};

}  // namespace taut
