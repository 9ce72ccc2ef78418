// What a trial assumes of every joint and span.
#pragma once

#include "taut/elements/friction_element.hpp"
#include "taut/scene/path.hpp"

namespace taut {

/// The assumed state of the joints and spans, and what they remember.
///
/// A span is the part of a cable between anchors, jacks and self-locking joints: since every joint inside can
/// slide, it is taut or slack as a whole.
template <class Scalar, class Cap>
struct Situation {
  FixedArray<Contact, Cap::joints> contact;   ///< separated: the segments on both sides are slack
  FixedArray<Scalar, Cap::joints> direction;  ///< of sliding: sign of sigma_s
  FixedArray<Scalar, Cap::joints> v_s;        ///< where a fixed joint rests (paper, Eq. (8)) [m]
  FixedArray<bool, Cap::segments> slack;      ///< by span
};

}  // namespace taut
