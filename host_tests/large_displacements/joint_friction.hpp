// Friction at the present angle of a joint.
#pragma once

#include <cmath>

#include "large_displacements/model.hpp"

namespace large_displacements {

/// cot(alpha) and the smallest ratio of tensions; 2 alpha is the angle between e1 and e2, which point from
/// the joint to its neighbours. Derivatives by the positions of these.
struct JointFriction {
  double cot = 0, rho = 1;
  Vector by_before = Vector::Zero(), by_behind = Vector::Zero();  ///< of rho; the joint's: minus their sum
};

inline JointFriction joint_friction(Law law, double mu, double wobble_angle, const Vector& e1, double l1,
                                    const Vector& e2, double l2) {
  JointFriction found;
  const double across = (e1 - e2).norm();
  found.cot = (e1 + e2).norm() / across;
  double by_cot = 0;
  if (law == Law::point) {
    const double kappa = mu * found.cot;
    found.rho = (1 - kappa) / (1 + kappa);
    by_cot = -2 * mu / ((1 + kappa) * (1 + kappa));
  } else {
    found.rho = std::exp(-mu * (2 * std::atan(found.cot) + wobble_angle));
    by_cot = -found.rho * mu * 2 / (1 + found.cot * found.cot);
  }
  if (found.cot > 1e-9) {
    // cot^2 = (1 + q) / (1 - q) with q = e1 . e2
    const double rest = across * across / 2, q = e1.dot(e2), by_q = by_cot / (found.cot * rest * rest);
    found.by_before = by_q / l1 * (e2 - q * e1);
    found.by_behind = by_q / l2 * (e1 - q * e2);
  }
  return found;
}

}  // namespace large_displacements
