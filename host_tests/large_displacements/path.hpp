// Rows of a log, followed along straight lines in small steps.
#pragma once

#include <string>

#include "large_displacements/equilibrium.hpp"

namespace large_displacements {

/// How far along its path an advance has come.
struct Reached {
  bool whole = false;
  double part = 0;     ///< of the path, 0 to 1
  double refused = 0;  ///< from this part on no stable equilibrium is found
  explicit operator bool() const { return whole; }
};

class Path {
 public:
  /// Begins at rest, and lets prestrain grow. Where that has no equilibrium, `started` is not whole.
  explicit Path(const Model& model, int steps_a_row = 8);

  /// On to the next row. Where this is not reached, the state is the last that was found.
  Reached advance(const Row& row);
  Reached go(const Inputs& target);

  Reached started;
  Equilibrium equilibrium;
  State state;
  Inputs inputs;  ///< those of `state`
  int steps;      ///< a row, at least

  double T(int cable, int segment) const { return equilibrium.tension(state, inputs, cable, segment); }
  double strut(int s) const { return equilibrium.strut_force(state, s); }
  double slip(int cable, int joint) const { return state.material[equilibrium.slip(cable, joint)]; }
  double extension(int cable, int end) const { return state.material[equilibrium.extension(cable, end)]; }
  Mode mode(int cable, int joint) const { return state.modes[equilibrium.slip(cable, joint)]; }
  JointFriction friction(int cable, int joint) const { return equilibrium.friction(state, cable, joint); }
  Vector moved(int node) const { return state.moved[node]; }
  double stability() const { return equilibrium.stability(state, inputs); }

 private:
  Reached go_in_steps(const Inputs& target);
};

}  // namespace large_displacements
