// What is given and what is found at one instant: the sample that drives the model, and its response.
#pragma once

#include <array>
#include <cstdint>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// The jack at one end of a cable.
template <class Scalar>
struct Jack {
  Scalar force = 0;     ///< of the load cell [N]; without effect while locked
  bool locked = false;  ///< the wedge holds: the extension stays, less the seating at the moment of locking
};

/// One row of a log: where the straight path from the present state leads to.
template <class Scalar, class Cap>
struct Sample {
  FixedArray<Scalar, Cap::loads> factor;                      ///< of every load pattern [-]
  FixedArray<std::array<Jack<Scalar>, 2>, Cap::cables> jack;  ///< at the start and the end of every cable
};

/// What a joint does at the end of the path to the sample.
enum class JointState : std::uint8_t {
  stick,     ///< nothing moves over the joint
  forward,   ///< the slip grows: cable moves from the segment before the joint to the one after it
  backward,  ///< the slip shrinks
  open,      ///< the segments on both sides are slack
};

/// The state of all cables at the end of the path to a sample.
template <class Scalar, class Cap>
struct Response {
  FixedArray<Scalar, Cap::segments> tension;  ///< of every segment [N], >= 0
  FixedArray<Scalar, Cap::joints>
      slip;  ///< delta: length of cable moved over every joint, in path direction [m]
  FixedArray<Scalar, Cap::joints> contact;   ///< N = (T_j + T_j+1) cos(alpha) [N], >= 0
  FixedArray<Scalar, Cap::joints> friction;  ///< f = (T_j+1 - T_j) sin(alpha) [N]
  FixedArray<JointState, Cap::joints> state;
  FixedArray<std::array<Scalar, 2>, Cap::cables> extension;  ///< extension of the jacks at start and end [m]
  FixedArray<Scalar, Cap::struts> strut;  ///< axial force of every strut [N], tension positive
};

}  // namespace taut
