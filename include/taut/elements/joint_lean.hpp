// How displacements of a joint and its neighbours change the bend of the cable, and what friction can hold.
#pragma once

#include "taut/elements/friction_element.hpp"

namespace taut {

/// Displacements of the neighbours of a joint along the cable, relative to the joint [m].
template <class Scalar, int Dimension>
struct JointLean {
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;
  Vector before;
  Vector after;

  /// By what part of itself cot(alpha), the bend of the cable at the joint, changes, to first order in the
  /// displacements: Eq. (44). `line1` and `line2` lead from the joint to its neighbours. A straight cable has
  /// no such part; that gives zero.
  Scalar bend_change(const Line<Scalar, Dimension>& line1, const Line<Scalar, Dimension>& line2) const {
    const Vector e1 = line1.direction, e2 = line2.direction;
    const Vector de1 = (before - e1 * e1.dot(before)) / line1.length;
    const Vector de2 = (after - e2 * e2.dot(after)) / line2.length;
    const Vector sum = e1 + e2, difference = e2 - e1;
    const Scalar s = sum.norm(), d = difference.norm();
    if (!(s > 0) || !(d > 0)) return 0;
    return sum.dot(de1 + de2) / (s * s) - difference.dot(de2 - de1) / (d * d);
  }
  /// By what part of itself kappa of Eq. (3) changes where the bend does by such a part: kappa = mu
  /// cot(alpha) of a point, kappa = tanh(mu (beta + k s) / 2) with beta = 2 atan(cot(alpha)) of a saddle.
  static Scalar kappa_by_bend(const FrictionElement<Scalar, Dimension>& joint) {
    const Scalar kappa = joint.limit.kappa;
    if (joint.law == FrictionLaw::point || !(kappa > 0)) return 1;
    return (1 - kappa * kappa) * joint.mu * joint.frame.cos_alpha * joint.frame.sin_alpha / kappa;
  }
};

}  // namespace taut
