// Forces beyond their limits: told without flicker, and how far they went.
#pragma once

#include <cstdint>

#include "taut/estimation/alarms.hpp"
#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// Whether the force of each of `Segments` segments is beyond a limit of AlarmLimits, and the peak of that
/// episode. An episode begins where the force goes beyond the limit, and ends where it has come back by
/// `band` of the limit, or is beyond the other one. The lower limit counts from when the segment has first
/// come up to it, or its cable is held by wedges: before, it is being pulled.
template <class Scalar, int Segments>
class ForceWatch {
 public:
  enum class Side : std::uint8_t {
    not_yet,  ///< within, and the lower limit does not count yet
    within,
    above,
    below,
  };
  /// All that is known between two rows: a plain value.
  struct State {
    FixedArray<Scalar, Segments> peak;  ///< [N]
    FixedArray<Side, Segments> side;
  };

  void start() { state_ = {}; }
  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }

  /// The largest force of a segment in its present episode above the upper limit, or the smallest one below
  /// the lower limit [N]; zero while it is within.
  Scalar peak(int segment) const {
    const Side side = state_.side[segment];
    return side == Side::above || side == Side::below ? state_.peak[segment] : Scalar(0);
  }
  /// Takes the force of a segment in a row [N]. `is_held`: its cable is held by wedges, or has no jack.
  /// Returns where it is. Always possible. Cost: a few comparisons.
  Side take(int segment, Scalar force, bool is_held, const AlarmLimits<Scalar>& limits) {
    Side& side = state_.side[segment];
    const Side before = side;
    if (side == Side::not_yet && (is_held || force >= limits.least_force)) side = Side::within;
    const bool has_most = limits.most_force >= 0,
               has_least = limits.least_force >= 0 && side != Side::not_yet;
    // Once raised, a limit is left only beyond its band.
    const Scalar most = limits.most_force * (before == Side::above ? 1 - limits.band : Scalar(1)),
                 least = limits.least_force * (before == Side::below ? 1 + limits.band : Scalar(1));
    if (has_least && force < limits.least_force)
      side = Side::below;
    else if (has_most && force > most)
      side = Side::above;
    else if (has_least && force < least)
      side = Side::below;
    else if (side != Side::not_yet)
      side = Side::within;
    Scalar& peak = state_.peak[segment];
    if (side != before || (side == Side::above ? force > peak : force < peak)) peak = force;
    return side;
  }

 private:
  State state_;
};

}  // namespace taut
