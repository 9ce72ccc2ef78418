// What is odd, and where.
#pragma once

#include <cstdint>

namespace taut {

struct Alarm {
  enum class Kind : std::uint8_t {
    outlier,      ///< a jack's load cell gave a reading that does not belong to the others; it was left out
    sensor,       ///< a load cell at an anchored end contradicts the model by more than five sigma
    mu_band,      ///< mu is surely outside of what was known of it: `place` is a joint, or -1 for all
    stuck_joint,  ///< a joint holds back more than its mu allows: it does not slide though it should
    elongation,   ///< the measured extension does not grow as the expected one, see ElongationCheck; as a
                  ///< measurement, it contradicts the model by more than five sigma
    force_high,   ///< a segment is above its limit, or has not come back from there by AlarmLimits::band
    force_low,    ///< a segment is below its limit, or likewise; see ForceWatch for when that counts
    no_information,  ///< a far-end cell was read, but joints stick: nothing is learned of mu
    strut,           ///< a strain gauge contradicts the model by more than five sigma: `place` is the strut
    lift_off,        ///< the jack pulls what a locked end holds: the wedge is free, the end can be unlocked
    segment,         ///< the measured force of a segment contradicts the model by more than five sigma
    unknown_past,    ///< the cable was under load before the first reading, and has not slid enough since
    misfit,     ///< readings at an anchored end are off what the model says for longer than chance allows
    frozen,     ///< a load cell keeps one value although the load moves, or it had noise: see StandingCell
    gain,       ///< the load cells at the anchored end and at the jack of a cable surely differ in gain
    unread,     ///< the load cell of a jack has not been read for long: its load is taken to be where it was
    late_lock,  ///< an end was locked while its load fell: the wedge may have held before
    early_unlock,  ///< an end was unlocked before its jack pulls what the wedge holds: it holds until then
  } kind = Kind::outlier;
  std::int16_t cable = 0;  ///< -1: `place` is a strut
  std::int16_t place = 0;  ///< joint or segment of the cable; end 0 or 1

  /// Whether it needs no action: it is raised once where it begins.
  constexpr bool is_notice() const { return kind == Kind::no_information || kind == Kind::early_unlock; }

  static constexpr Alarm of(Kind kind, int cable, int place) {
    return {kind, static_cast<std::int16_t>(cable), static_cast<std::int16_t>(place)};
  }
};

/// From when on something is odd.
template <class Scalar>
struct AlarmLimits {
  Scalar least_force = -1;  ///< of any segment [N]; below zero: none
  Scalar most_force = -1;   ///< of any segment [N]; below zero: none
  Scalar elongation =
      Scalar(0.05);  ///< of a stroke, part of its growth; EN 13670 allows 0.05 for all tendons together
  Scalar stroke_sd = Scalar(1e-3);  ///< standard deviation of the reading of a stroke [m], above zero
  Scalar band = Scalar(0.01);  ///< part of a limit by which a force has to come back for its alarm to end
  /// Of a cable at its jack: below, slack and bedding are taken out, and strokes are not compared. A tenth of
  /// what a tendon has when it is tensioned.
  Scalar initial_strain = Scalar(5e-4);
  Scalar gain =
      Scalar(0.01);  ///< by which the load cells at both ends of a cable may differ, part of a force

  constexpr bool has_force() const { return most_force >= 0 || least_force >= 0; }
  /// These where strokes have noise of this standard deviation [m]; if it is zero, the usual one.
  constexpr AlarmLimits with_stroke_noise(Scalar sd) const {
    AlarmLimits limits = *this;
    if (sd > 0) limits.stroke_sd = sd;
    return limits;
  }

  template <class Other>
  static constexpr AlarmLimits of(const AlarmLimits<Other>& other) {
    return {static_cast<Scalar>(other.least_force), static_cast<Scalar>(other.most_force),
            static_cast<Scalar>(other.elongation),  static_cast<Scalar>(other.stroke_sd),
            static_cast<Scalar>(other.band),        static_cast<Scalar>(other.initial_strain),
            static_cast<Scalar>(other.gain)};
  }
};

}  // namespace taut
