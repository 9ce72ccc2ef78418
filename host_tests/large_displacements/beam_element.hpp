// A corotational Euler-Bernoulli beam, by its energy.
#pragma once

#include <Eigen/Core>

#include "large_displacements/model.hpp"

namespace large_displacements {

struct BeamElement {
  int a = 0, b = 0;              ///< nodes
  int frame_a = 0, frame_b = 0;  ///< rotations of its ends
  double length = 0, EA = 0, EIy = 0, EIz = 0, GJ = 0;
  Eigen::Matrix3d axes;  ///< columns: local x, y, z in the initial state
};

/// Gradient and second derivatives of the energy by the displacements and spins of both ends: ux uy uz wx wy
/// wz at a, then at b. The spins turn the present rotations.
struct BeamForces {
  Eigen::Matrix<double, 12, 1> force = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Matrix<double, 12, 12> stiffness = Eigen::Matrix<double, 12, 12>::Zero();
  double axial = 0;
};

/// `initial`: from a to b; `moved`: by how much that has changed. `plane`: derivatives by ux, uy and wz
/// alone, the others stay zero.
BeamForces beam_forces(const BeamElement& beam, const Vector& initial, const Vector& moved,
                       const Eigen::Matrix3d& turned_a, const Eigen::Matrix3d& turned_b, bool plane);

}  // namespace large_displacements
