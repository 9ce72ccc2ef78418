// Errors are values: every call that can fail returns a Status, which names what is wrong and where.
#pragma once

#include <cstdint>

namespace taut {

/// What is wrong. `ok` is zero; the groups say who can mend it.
enum class Code : std::uint8_t {
  ok = 0,

  // The scene cannot be used as it is: found by validate().
  capacity_exceeded,  ///< more of `place` than the capacity holds; `amount` is by how many
  not_finite,         ///< a NaN or an infinity
  not_positive,       ///< E, A or a distance that must be greater than zero
  negative,           ///< mu, wobble, seating or a standard deviation below zero
  unknown_node,       ///< a node number outside the scene; `amount` is the number
  repeated_node,      ///< a node used twice where each may occur once; `amount` is the node
  coincident_nodes,   ///< neighbouring nodes at the same point; `amount` is the other node
  path_too_short,     ///< fewer than 2 nodes in an open cable, or 3 in a closed one
  folded_cable,       ///< the cable folds straight back at this joint (alpha = 0)
  unsupported,        ///< the supports leave a rigid motion free; `place` is a node that it moves
  not_symmetric,      ///< substructure stiffness; `amount` is the row
  not_semidefinite,   ///< substructure stiffness with a negative eigenvalue
  out_of_range,       ///< prestrain not in (-1, 1), or a reference to a load, cable or end that is not there

  // The sample cannot be used: nothing was changed.
  bad_sample,  ///< non-finite factor or force, a negative jack force, or more than the cable can carry

  // The scene has no answer at this load.
  mechanism,         ///< nothing holds this node: add a strut, a support or a substructure
  pulled_through,    ///< two jack forces differ by more than all friction between them
  gives_way,         ///< friction at this joint holds no longer: the structure would jump to a state far away
  state_iterations,  ///< the joint states do not settle; `place` is a joint that keeps flipping
  ill_conditioned,   ///< equilibrium is not reached in this scalar type: use double

  // Calls come in the wrong order: nothing was changed.
  not_started,  ///< start() comes first
};

/// The kind of thing that a Status points at.
enum class Place : std::uint8_t {
  none = 0,
  node,
  strut,
  cable,
  path,       ///< a node of a cable's path; `index` counts along the path
  segment,    ///< `index` counts along the cable
  joint,      ///< `index` counts along the cable
  cable_end,  ///< `index` 0 is the start, 1 the end
  substructure,
  substructure_node,
  substructure_entry,
  load,
  force,
  temperature,
  beam,
};

/// The outcome of a call. It converts to true when all is well and cannot be ignored.
///
/// `index` and `cable` are zero-based; whoever prints a joint or a segment adds one, as the files count
/// from 1.
struct [[nodiscard]] Status {
  Code code = Code::ok;
  Place place = Place::none;
  int index = -1;  ///< which one, of the kind `place`
  int cable = -1;  ///< of which cable, for places along a cable
  int amount = 0;  ///< a number that the code explains

  constexpr bool ok() const { return code == Code::ok; }
  constexpr explicit operator bool() const { return ok(); }

  static constexpr Status success() { return {}; }
  static constexpr Status at(Code code, Place place, int index, int amount = 0) {
    return {code, place, index, -1, amount};
  }
  static constexpr Status along(Code code, Place place, int cable, int index, int amount = 0) {
    return {code, place, index, cable, amount};
  }
};

/// One sentence on a code, without the place. Costs flash only where it is called.
constexpr const char* describe(Code code) {
  switch (code) {
    case Code::ok:
      return "all is well";
    case Code::capacity_exceeded:
      return "the scene holds more than its capacity";
    case Code::not_finite:
      return "a number is not finite";
    case Code::not_positive:
      return "a number must be greater than zero";
    case Code::negative:
      return "a number must not be negative";
    case Code::unknown_node:
      return "there is no such node";
    case Code::repeated_node:
      return "a node is used twice";
    case Code::coincident_nodes:
      return "neighbouring nodes are at the same point";
    case Code::path_too_short:
      return "a cable needs 2 nodes, a closed one 3";
    case Code::folded_cable:
      return "the cable folds straight back";
    case Code::unsupported:
      return "the supports leave the structure free to move as a rigid body";
    case Code::not_symmetric:
      return "the stiffness matrix is not symmetric";
    case Code::not_semidefinite:
      return "the stiffness matrix is not positive semidefinite";
    case Code::out_of_range:
      return "a value or a reference is out of range";
    case Code::bad_sample:
      return "the sample holds a number that cannot be used";
    case Code::mechanism:
      return "mechanism: nothing holds this node";
    case Code::pulled_through:
      return "the cable is pulled through: the jack forces differ by more than all friction";
    case Code::gives_way:
      return "friction gives way: the structure would jump to a state far away";
    case Code::state_iterations:
      return "the joint states do not settle";
    case Code::ill_conditioned:
      return "equilibrium is not reached in this precision";
    case Code::not_started:
      return "start() comes first";
  }
  return "unknown status";
}

}  // namespace taut
