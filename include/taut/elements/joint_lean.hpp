// How displacements of a joint and its neighbours change what friction can hold there.
#pragma once

#include "taut/elements/friction_element.hpp"

namespace taut {

/// Displacements of the neighbours of a joint along the cable, relative to the joint [m].
template <class Scalar, int Dimension>
struct JointLean {
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;
  Vector before;
  Vector after;

  /// The change of kappa of Eq. (3), to first order in the displacements: Eq. (44). `line1` and `line2` lead
  /// from the joint to its neighbours. A straight cable, whose kappa has no derivative, gives zero.
  Scalar kappa_change(const FrictionElement<Scalar, Dimension>& joint, const Line<Scalar, Dimension>& line1,
                      const Line<Scalar, Dimension>& line2) const {
    const Vector e1 = line1.direction, e2 = line2.direction;
    const Vector de1 = (before - e1 * e1.dot(before)) / line1.length;
    const Vector de2 = (after - e2 * e2.dot(after)) / line2.length;
    const Vector sum = e1 + e2, difference = e2 - e1;
    const Scalar s = sum.norm(), d = difference.norm();
    if (!(s > 0) || !(d > 0)) return 0;
    const Scalar cot = s / d;
    const Scalar change = (sum.dot(de1 + de2) / s - cot * difference.dot(de2 - de1) / d) / d;
    if (joint.law == FrictionLaw::point) return joint.mu * change;
    // kappa = tanh(mu (beta + k s) / 2), and beta = 2 atan(cot).
    const Scalar kappa = joint.grip.kappa;
    return (1 - kappa * kappa) * joint.mu * change / (1 + cot * cot);
  }
};

}  // namespace taut
