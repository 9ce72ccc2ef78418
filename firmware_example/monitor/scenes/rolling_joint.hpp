// Scene: the experiment with a rolling cable-strut joint, as a constant for flash.
//
// Yan et al., "A new equivalent friction element for analysis of cable supported structures", 2015, section
// 4.1.2: a cable runs over one joint with 135 degrees between its segments, is pulled at one end and held at
// the other. Three set-ups of the joint were tested one after the other; here they lie side by side.
// data/rolling_joint.json is the same scene for the program taut.
#pragma once

#include "taut/scene/scene.hpp"

namespace monitor::scenes {

struct RollingJointCapacity : taut::Capacity {
  static constexpr int nodes = 9, cables = 3, segments = 6, joints = 3;
};
using RollingJoint = taut::Scene<double, 2, RollingJointCapacity>;

/// Names of the cables, as in the columns of the log.
inline constexpr const char* rolling_joint_cables[RollingJointCapacity::cables] = {"original", "teflon",
                                                                                   "welded"};

/// Friction coefficients of the three set-ups: (T1 - T2) / (T1 + T2) tan(67.5 degrees), from both forces that
/// Table 4 gives for each, to four digits. They are thus identified from the very readings that are replayed.
/// (The coefficients printed in that table follow from another formula and do not give back the forces.)
inline constexpr double rolling_joint_mu[RollingJointCapacity::cables] = {0.2189, 0.1385, 0.2931};

/// One cable over its joint at height `y`, anchored at the start, jacked at the end. The saddle is rigid, so
/// that lengths and stiffness, which are not published, have no effect on the forces.
constexpr void add_set_up(RollingJoint& scene, double mu, double y) {
  const int fixed_end = scene.add_node({-1, y}, taut::held_xy);
  const int joint = scene.add_node({0, y}, taut::held_xy);
  const int loading_end = scene.add_node({1, y + 1}, taut::held_xy);
  taut::Cable<double> cable;
  cable.E = 2.0e11;
  cable.A = 1.0e-4;
  cable.mu = mu;
  cable.ends[1] = taut::End::jacked;
  scene.add_cable(cable, {fixed_end, joint, loading_end});
}

constexpr RollingJoint make_rolling_joint() {
  RollingJoint scene;
  for (int i = 0; i < RollingJointCapacity::cables; ++i) add_set_up(scene, rolling_joint_mu[i], 3.0 * i);
  return scene;
}

inline constexpr RollingJoint rolling_joint = make_rolling_joint();
static_assert(rolling_joint.path.size() == RollingJointCapacity::nodes, "the scene fits its capacity");

}  // namespace monitor::scenes
