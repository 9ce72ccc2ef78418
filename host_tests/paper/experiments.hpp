// The experiments of the paper as scenes, with the printed figures and what follows from statics alone.
//
// Yan et al., "A new equivalent friction element for analysis of cable supported structures", 2015. Shared by
// the tests and by paper_table, so that the table shows what is tested. Formulas here use the trigonometry of
// the paper, which the library avoids.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "taut/taut.hpp"

namespace paper {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double E_steel = 2e11;    ///< [N/m2], as in sections 4.1, 4.2 and 4.3
constexpr double A_members = 1e-4;  ///< [m2], as in sections 4.1 and 4.3
constexpr double roller_alpha = 67.5 * degree;

/// Eq. (43): the force left over behind a sliding joint, as a part of the force before it.
inline double slid_ratio(double mu, double alpha) {
  return std::max(0.0, (std::tan(alpha) - mu) / (std::tan(alpha) + mu));
}

/// The note under Table 4: mu from the forces on both sides of a sliding joint.
inline double identified_mu(double T1, double T2, double alpha) {
  return (T1 - T2) * std::sin(alpha) / ((T1 + T2) * std::cos(alpha));
}

/// What drives an experiment: the factor of its load pattern, if it has one, and the jack at the cable's end.
struct Drive {
  double factor = 0;
  double jack = 0;  ///< [N]
};

template <class Scalar, class Cap>
taut::Sample<Scalar, Cap> sample_of(const Drive& drive) {
  taut::Sample<Scalar, Cap> sample;
  if constexpr (Cap::loads > 0) sample.factor[0] = static_cast<Scalar>(drive.factor);
  sample.jack[0][1].force = static_cast<Scalar>(drive.jack);
  return sample;
}

/// Takes a solver from nothing along one straight path to `drive`.
template <class Scalar, class SceneType>
taut::Status follow(taut::Stepwise<Scalar, SceneType>& solver, const SceneType& scene, const Drive& drive,
                    int substeps = 1) {
  const taut::Status started = solver.start(scene);
  if (!started) return started;
  return solver.advance(sample_of<Scalar, typename SceneType::Capacity>(drive), substeps);
}

// Section 4.1.1, Table 3: cable-roller model.

struct RollerCapacity : taut::Capacity {
  static constexpr int nodes = 3, struts = 1, segments = 2, joints = 1, loads = 1, forces = 1;
};
using RollerScene = taut::Scene<double, 2, RollerCapacity>;

/// Figure 7 is described, not dimensioned; this geometry is the one that gives all columns of Table 3. Strut
/// and lower segment run side by side from the roller straight down to the loaded node, the upper segment
/// rises at 45 degrees to a hinge.
constexpr RollerScene cable_roller(double mu) {
  RollerScene scene;
  const int hinge = scene.add_node({1, 1}, taut::held_xy);
  const int roller = scene.add_node({0, 0}, taut::held_xy);
  const int loaded = scene.add_node({0, -1}, taut::held_x);
  scene.add_strut(roller, loaded, E_steel, A_members);
  taut::Cable<double> cable;
  cable.E = E_steel;
  cable.A = A_members;
  cable.mu = mu;
  scene.add_cable(cable, {hinge, roller, loaded});
  scene.add_force(scene.add_load(), loaded, {0, -1000});
  return scene;
}
constexpr Drive roller_drive{1, 0};

/// A column of Table 3 [N]; the normal pressure without its sign, which is that of sigma_n.
struct RollerColumn {
  double mu, friction, contact;
};
constexpr std::array<RollerColumn, 4> table_3{
    {{0, 0, 224.2}, {0.1, 22.3, 222.6}, {0.5, 108.7, 216.4}, {2.42, 461.9, 191.3}}};
constexpr double misprinted_mu = 0.5;  ///< the column of Table 3 whose friction is a misprint

struct RollerForces {
  double upper, lower, strut, contact, friction;  ///< [N]
};

/// Table 3 without a computer. With k the stiffness of strut and lower segment, u what the loaded node sinks
/// and d the cable drawn over the roller: lower = k (u - d), upper = k / sqrt(2) d, strut = k u, and strut +
/// lower = P. Elimination of u and d leaves lower + upper / sqrt(2) = P / 2; Eq. (43) is the second equation.
inline RollerForces roller_by_hand(double mu) {
  constexpr double P = 1000;
  const double ratio = slid_ratio(mu, roller_alpha);
  RollerForces forces{};
  forces.lower = P / 2 / (1 + ratio / std::sqrt(2.0));
  forces.upper = ratio * forces.lower;
  forces.strut = P - forces.lower;
  forces.contact = (forces.lower + forces.upper) * std::cos(roller_alpha);
  forces.friction = (forces.lower - forces.upper) * std::sin(roller_alpha);
  return forces;
}

// Section 4.1.2, Table 4: experiment with a rolling cable-strut joint.

struct JointCapacity : taut::Capacity {
  static constexpr int nodes = 3, segments = 2, joints = 1;
};
using JointScene = taut::Scene<double, 2, JointCapacity>;

/// One joint on a rigid saddle with 135 degrees between the segments, anchored at the start, jacked at the
/// end. Stiffness and lengths are not given in the paper and have no effect on the forces.
inline JointScene rolling_joint(double mu) {
  JointScene scene;
  const int fixed_end = scene.add_node({-1, 0}, taut::held_xy);
  const int joint = scene.add_node({0, 0}, taut::held_xy);
  const int loading_end = scene.add_node({1, 1}, taut::held_xy);
  taut::Cable<double> cable;
  cable.E = E_steel;
  cable.A = A_members;
  cable.mu = mu;
  cable.ends[1] = taut::End::jacked;
  scene.add_cable(cable, {fixed_end, joint, loading_end});
  return scene;
}

/// A row of Table 4.
struct RollingJointRow {
  const char* name;
  double T1, T2;        ///< measured at the loading and the fixed end [N]
  double mu;            ///< as printed
  double T2_numerical;  ///< as printed [N]
};
constexpr std::array<RollingJointRow, 3> table_4{{{"original state", 40000, 33350, 0.1675, 33400},
                                                  {"Teflon layer", 40000, 35660, 0.1060, 35700},
                                                  {"roller and pivot welded", 40000, 31340, 0.2243, 31300}}};

/// The other reading of mu, which gives the printed column.
inline double printed_mu(const RollingJointRow& row) {
  return 2 * std::sin(roller_alpha) * (row.T1 - row.T2) / (row.T1 + row.T2);
}

// Section 4.2: continuous sliding cable.

struct ChainCapacity : taut::Capacity {
  static constexpr int nodes = 5, segments = 4, joints = 3;
};
using ChainScene = taut::Scene<double, 2, ChainCapacity>;

constexpr double chain_mu = 0.26;    ///< measured, as printed
constexpr double chain_A = 19.6e-6;  ///< [m2], as printed
constexpr Drive chain_drive{0, 400};
/// Of our own choice, since Fig. 10 with the angles of the experiment is not available.
constexpr std::array<double, 3> chain_alpha{75 * degree, 67.5 * degree, 60 * degree};
constexpr std::array<double, 4> chain_length{2, 1.5, 1, 0.75};  ///< likewise [m]

/// Four segments over three rigid saddles, anchored at the start, jacked at the end of segment 4.
inline ChainScene sliding_chain() {
  ChainScene scene;
  std::array<int, 5> path{};
  double x = 0, y = 0, heading = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i] = scene.add_node({x, y}, taut::held_xy);
    if (i >= chain_length.size()) break;
    x += chain_length[i] * std::cos(heading);
    y += chain_length[i] * std::sin(heading);
    if (i < chain_alpha.size()) heading += 180 * degree - 2 * chain_alpha[i];
  }
  taut::Cable<double> cable;
  cable.E = E_steel;
  cable.A = chain_A;
  cable.mu = chain_mu;
  cable.ends[1] = taut::End::jacked;
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  return scene;
}

/// Eq. (43) from the jack backwards, joint by joint [N].
inline std::array<double, 4> chain_by_hand() {
  std::array<double, 4> T{};
  T[3] = chain_drive.jack;
  for (std::size_t j = 3; j > 0; --j) T[j - 1] = T[j] * slid_ratio(chain_mu, chain_alpha[j - 1]);
  return T;
}

// Section 4.3: truss string structure.

struct TrussCapacity : taut::Capacity {
  static constexpr int nodes = 17, struts = 31, segments = 5, joints = 4, loads = 1, forces = 6;
};
using TrussScene = taut::Scene<double, 2, TrussCapacity>;

constexpr int bottom_nodes = 7, top_nodes = 6, lower_nodes = 4;
/// Numbers of the nodes, from left to right.
constexpr int bottom(int i) { return i; }
constexpr int top(int i) { return bottom_nodes + i; }
constexpr int lower(int i) { return bottom_nodes + top_nodes + i; }
/// Numbers of the V-struts: two a lower node, left and right, after the bars of the truss.
constexpr int first_v_strut = 23;

/// A symmetric plane truss of 12 m span over a cable with four joints, of our own design, since Fig. 15 is
/// not available. The lower nodes hang on two struts each: on vertical pin-ended ones they could swing freely
/// along the cable as soon as it slides. Materials, loads and supports are those of the paper.
inline TrussScene truss_string(double mu, taut::End right_end) {
  TrussScene scene;
  for (int i = 0; i < bottom_nodes; ++i) {
    const auto held = i == 0 ? taut::held_xy : i == bottom_nodes - 1 ? taut::held_y : taut::held_none;
    scene.add_node({2.0 * i, 0}, held);
  }
  for (int i = 0; i < top_nodes; ++i) scene.add_node({1 + 2.0 * i, 1.5});
  for (int i = 0; i < lower_nodes; ++i) scene.add_node({3 + 2.0 * i, i == 0 || i == 3 ? -1.5 : -2.0});

  const auto bar = [&scene](int a, int b) { scene.add_strut(a, b, E_steel, A_members); };
  for (int i = 0; i + 1 < bottom_nodes; ++i) bar(bottom(i), bottom(i + 1));
  for (int i = 0; i + 1 < top_nodes; ++i) bar(top(i), top(i + 1));
  for (int i = 0; i < top_nodes; ++i) {
    bar(top(i), bottom(i));
    bar(top(i), bottom(i + 1));
  }
  for (int i = 0; i < lower_nodes; ++i) {
    bar(lower(i), bottom(i + 1));
    bar(lower(i), bottom(i + 2));
  }

  taut::Cable<double> cable;
  cable.E = E_steel;
  cable.A = A_members;
  cable.mu = mu;
  cable.ends[1] = right_end;
  scene.add_cable(cable, {bottom(0), lower(0), lower(1), lower(2), lower(3), bottom(6)});
  const int P = scene.add_load();
  for (int i = 0; i < top_nodes; ++i) scene.add_force(P, top(i), {0, -1000});
  return scene;
}

/// A row of Table 5.
struct TrussCase {
  const char* name;
  double mu;
  double F;  ///< [N]; 0: the right end is anchored

  taut::End right_end() const { return F > 0 ? taut::End::jacked : taut::End::anchored; }
  TrussScene scene() const { return truss_string(mu, right_end()); }
  Drive drive() const { return {1, F}; }
};
constexpr std::array<TrussCase, 4> table_5{{{"case 1, no friction", 0, 0},
                                            {"case 2, discontinuous cable", 12.7, 0},
                                            {"case 3, stretched with friction", 0.2, 20000},
                                            {"case 4, stretched without friction", 0, 20000}}};

/// Half the angle between the segments at the two kinds of joints: the cable falls by 1 in 2, by 1 in 4 and
/// not at all, and half of what it turns is missing to a right angle.
inline double truss_alpha(int joint) {
  const bool outer = joint == 0 || joint == lower_nodes - 1;
  const double turn = outer ? std::atan(0.5) - std::atan(0.25) : std::atan(0.25);
  return 90 * degree - turn / 2;
}

}  // namespace paper
