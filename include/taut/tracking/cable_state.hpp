// The one plain value of a tensioning: what has moved, what sticks and slides, the loads reached.
#pragma once

#include <cstdint>

#include "taut/scene/path.hpp"
#include "taut/tracking/slip_variables.hpp"

namespace taut {

/// What a decision may try and take back: modes of joints and of spans, the parts of cables between anchors,
/// jacks and self-locking joints, and all that has moved.
template <class Real, class Cap>
struct CableModes {
  FixedArray<JointState, Cap::joints> slides;  ///< stick, or the way: its friction is at this limit
  FixedList<std::int16_t, Cap::joints> order;  ///< joints that slide, as they began
  FixedArray<bool, max_spans<Cap>> slack;      ///< of spans: without tension, with length to spare
  FixedArray<bool, max_spans<Cap>> rests;      ///< of spans: without tension, whatever their length
  SlipState<Real, Cap> moved;  ///< slips, extensions and slack lengths where the piece was begun

  friend bool operator==(const CableModes& a, const CableModes& b) {
    return a.slides == b.slides && a.order == b.order && a.slack == b.slack && a.rests == b.rests &&
           a.moved == b.moved;
  }
};

/// Where a tensioning has come to. All else that a tracker holds is made from it and from the condensed
/// scene: saved whole, restored whole, it gives the same bits. A plain value: it may be stored and read back
/// byte by byte, on the same machine and with the same build. SI units.
template <class CondensedType, int MaxInputs>
struct CableState : CableModes<typename CondensedType::Real, typename CondensedType::Capacity> {
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Loads = Drive<Real, Cap>;
  using Modes = CableModes<Real, Cap>;

  Loads now;   ///< load factors, jack forces and locked extensions reached
  Loads goal;  ///< the end of the path that was asked for

  /// Of spans: the segment with the largest tension.
  FixedArray<std::int16_t, max_spans<Cap>> representative;

  // The present affine piece.
  Loads built;                            ///< the loads there
  FixedArray<bool, Cap::loads> has_load;  ///< load patterns that change along it
  bool has_map = false;                   ///< there is one
  bool arrived = false;                   ///< the goal was reached
  FixedArray<Real, MaxInputs> last;       ///< how the inputs changed last: the direction of sliding

  // Samples without an event.
  FixedArray<Scalar, Cap::segments> tension;  ///< at `now` [N]
  FixedArray<bool, MaxInputs> live;           ///< inputs that change from sample to sample
  FixedArray<Scalar, MaxInputs> reach;        ///< so large forces are still of the order of `peak`
  bool has_range = false;                     ///< one input alone changes, and how far it may go is known

  Real peak = 0;  ///< the largest force so far: what is small against it is zero [N]

  /// Compares the whole.
  friend bool operator==(const CableState& a, const CableState& b) {
    return static_cast<const Modes&>(a) == static_cast<const Modes&>(b) && a.now == b.now &&
           a.goal == b.goal && a.representative == b.representative && a.built == b.built &&
           a.has_load == b.has_load && a.has_map == b.has_map && a.arrived == b.arrived && a.last == b.last &&
           a.tension == b.tension && a.live == b.live && a.reach == b.reach && a.has_range == b.has_range &&
           a.peak == b.peak;
  }
};

}  // namespace taut
