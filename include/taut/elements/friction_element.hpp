// Equivalent friction element of a cable-strut joint, after Yan et al., "A new equivalent friction element
// for analysis of cable supported structures", 2015. Tables are those of the paper.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "taut/elements/strut.hpp"
#include "taut/scene/friction.hpp"

namespace taut {

/// The contact between cable and strut node (section 2.3).
enum class Contact : std::uint8_t { fixed, sliding, separated };

/// What an element remembers from the end of load step k-1.
template <class Scalar>
struct ContactMemory {
  Contact state = Contact::fixed;
  Scalar u_n = 0, v_s = 0;          ///< relative displacements of node 4 to node 3 [m] (paper, Eq. (8))
  Scalar sigma_n = 0, sigma_s = 0;  ///< internal forces [N] (paper, Eq. (6)); sigma_n < 0 is contact
};

/// The right-hand sides of the two constraint equations (paper, Eq. (15)).
template <class Scalar>
struct ConstraintValues {
  Scalar a = 0, b = 0;
};

/// Largest friction with the sign of the tangential force (paper, Eq. (24)).
template <class Scalar>
constexpr Scalar limit_friction(Scalar mu, Scalar sigma_n, Scalar sigma_s) {
  const Scalar size = mu * (sigma_n < 0 ? -sigma_n : sigma_n);
  return sigma_s >= 0 ? size : -size;
}

/// Table 1: the constraint values a*, b* of load step k, as increments to `last`.
///
/// `f` is that of Eq. (24) of the paper in this step. `u_n`, `v_s` are the increments of the trial in which
/// the joint stays separated: the gap closes at the part |u_n^{k-1} / u_n^k| of the step, and there the cable
/// comes to rest. (The text of the paper says b* = -v_s^{k-1} instead, which would bring back the point of
/// the cable that touched before; Table 1 is right.)
template <class Scalar>
constexpr ConstraintValues<Scalar> constraint_values(const ContactMemory<Scalar>& last, Contact now, Scalar f,
                                                     Scalar u_n = 0, Scalar v_s = 0) {
  const bool was_open = last.state == Contact::separated;
  switch (now) {
    case Contact::fixed: {
      if (!was_open) return {Scalar(0), Scalar(0)};
      const Scalar part = u_n == 0 ? Scalar(0) : last.u_n / u_n;
      return {-last.u_n, v_s * (part < 0 ? -part : part)};
    }
    case Contact::sliding:
      return was_open ? ConstraintValues<Scalar>{-last.u_n, f}
                      : ConstraintValues<Scalar>{Scalar(0), f - last.sigma_s};
    case Contact::separated:
      break;
  }
  return was_open ? ConstraintValues<Scalar>{} : ConstraintValues<Scalar>{-last.sigma_n, -last.sigma_s};
}

/// What a trial solution found in an element; totals, except for dv_s.
template <class Scalar>
struct ContactTrial {
  Scalar sigma_n = 0, sigma_s = 0;  ///< [N]
  Scalar f = 0;                     ///< largest friction (paper, Eq. (24)) [N]
  Scalar dv_s = 0;                  ///< v_s^k - v_s^{k-1} [m]
  Scalar u_n = 0;                   ///< gap [m]; closed if <= 0
  Scalar force_tolerance = 0;       ///< forces closer than this count as equal [N]
  Scalar slip_tolerance = 0;        ///< [m]
};

/// Table 2: the state that a trial solution calls for, given the state it assumed.
///
/// As printed, Fixed/Fixed and Fixed/Sliding carry the same condition; sliding is |sigma_s| > mu |sigma_n|.
/// A joint exactly at its limit may be either and stays fixed.
template <class Scalar>
constexpr Contact check_contact(Contact assumed, const ContactTrial<Scalar>& trial) {
  if (assumed == Contact::separated) return trial.u_n < 0 ? Contact::fixed : Contact::separated;
  if (trial.sigma_n > trial.force_tolerance) return Contact::separated;
  if (assumed == Contact::fixed) {
    const Scalar pull = trial.sigma_s < 0 ? -trial.sigma_s : trial.sigma_s;
    const Scalar limit = trial.f < 0 ? -trial.f : trial.f;
    return pull > limit + trial.force_tolerance ? Contact::sliding : Contact::fixed;
  }
  // Sliding goes on as long as friction takes work out: (v_s^k - v_s^{k-1}) f^k > 0.
  const Scalar with_friction = trial.f < 0 ? -trial.dv_s : trial.dv_s;
  return with_friction < -trial.slip_tolerance ? Contact::fixed : Contact::sliding;
}

/// The element's own axes and angle.
template <class Scalar, int Dimension>
struct JointFrame {
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;
  Vector n;          ///< bisector of the segments, from the joint into the angle (paper, Eq. (1))
  Vector s;          ///< tangent; in the plane (-sin(theta), cos(theta)), in space from node 1 to node 2
  Scalar cos_alpha;  ///< |e31 + e32| / 2
  Scalar sin_alpha;  ///< |e32 - e31| / 2
  Scalar towards_2;  ///< +1 if s points from node 1 to node 2, otherwise -1

  /// From the joint's node (3 and 4) and its neighbours along the cable (1 and 2), in the scalar type of the
  /// points. A straight cable has no bisector: then n is any normal of the tangent.
  template <class Real>
  static JointFrame of(const Node<Real, Dimension>& node1, const Node<Real, Dimension>& node3,
                       const Node<Real, Dimension>& node2) {
    using RealVector = Eigen::Matrix<Real, Dimension, 1>;
    const RealVector e31 = Line<Real, Dimension>::between(node3, node1).direction;
    const RealVector e32 = Line<Real, Dimension>::between(node3, node2).direction;
    const RealVector sum = e31 + e32, difference = e32 - e31;
    const RealVector along = difference / difference.norm();
    RealVector n, s;
    Real towards_2 = 1;
    if constexpr (Dimension == 2) {
      const RealVector left(-along[1], along[0]);
      n = sum.dot(left) < 0 ? RealVector(-left) : left;
      s = RealVector(-n[1], n[0]);
      towards_2 = s.dot(along) < 0 ? Real(-1) : Real(1);
    } else {
      const RealVector across = sum - along * along.dot(sum);
      n = across.norm() > 0 ? RealVector(across / across.norm()) : any_normal(along);
      s = along;
    }
    return {n.template cast<Scalar>(), s.template cast<Scalar>(), static_cast<Scalar>(sum.norm() / 2),
            static_cast<Scalar>(difference.norm() / 2), static_cast<Scalar>(towards_2)};
  }

 private:
  template <class RealVector>
  static RealVector any_normal(const RealVector& along) {
    int smallest = 0;
    along.cwiseAbs().minCoeff(&smallest);
    const RealVector normal = along.cross(RealVector::Unit(smallest));
    return normal / normal.norm();
  }
};

/// The element, ready for use: matrices on the unknowns (node 3, node 4, internal forces).
///
/// In the plane the internal forces are sigma_n, sigma_s as in the paper: 6 unknowns. In space the paper's
/// element lies in the plane of the two segments, and a third internal force ties the displacements across
/// that plane: 9 unknowns.
template <class Scalar, int Dimension>
struct FrictionElement {
  static constexpr int unknowns = 3 * Dimension;
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;
  using Matrix = Eigen::Matrix<Scalar, unknowns, unknowns>;
  using LoadVector = Eigen::Matrix<Scalar, unknowns, 1>;
  using Differences = Eigen::Matrix<Scalar, Dimension, 2 * Dimension>;
  static constexpr int row_n = 2 * Dimension;      ///< the unknown sigma_n and its constraint
  static constexpr int row_s = 2 * Dimension + 1;  ///< the unknown sigma_s and its constraint

  int node = 0;                   ///< node 4, of the structure
  std::array<int, 2> segments{};  ///< before and after the joint, in the scene's numbering
  FrictionLaw law = FrictionLaw::point;
  Scalar mu = 0;
  FrictionLimit<Scalar> limit;
  JointFrame<Scalar, Dimension> frame;

  /// Joint `j` of cable `c`, both zero-based.
  template <class SceneType>
  static FrictionElement of(const SceneType& scene, int c, int j) {
    using Real = typename SceneType::Scalar;
    const auto& cable = scene.cables[c];
    const auto at = scene.joint_nodes(cable, j);
    const auto& node1 = scene.nodes[at.before];
    const auto& node3 = scene.nodes[at.at];
    const auto& node2 = scene.nodes[at.after];
    const auto fine = JointFrame<Real, Dimension>::of(node1, node3, node2);
    const Real half_lengths = (Line<Real, Dimension>::between(node1, node3).length +
                               Line<Real, Dimension>::between(node3, node2).length) /
                              Real(2);
    const Real mu = scene.mu[cable.first_joint + j];
    FrictionElement made;
    made.node = at.at;
    made.segments = cable.joint_segments(j);
    made.law = cable.law;
    made.mu = static_cast<Scalar>(mu);
    made.limit = {static_cast<Scalar>(
        taut::friction_limit(cable, mu, fine.cos_alpha, fine.sin_alpha, half_lengths).kappa)};
    made.frame = JointFrame<Scalar, Dimension>::of(node1, node3, node2);
    return made;
  }

  /// The element axis of internal force `i`: n, s, and in space the normal of their plane.
  Vector axis(int i) const {
    if (i == 0) return frame.n;
    if (i == 1) return frame.s;
    if constexpr (Dimension == 3) return frame.n.cross(frame.s);
    return Vector::Zero();
  }

  /// L (paper, Eq. (14)): relative displacements from (node 3, node 4) displacements.
  Differences differences() const {
    Differences L;
    for (int i = 0; i < Dimension; ++i) L.row(i) << -axis(i).transpose(), axis(i).transpose();
    return L;
  }

  /// K1 (paper, Eq. (35)), row 4 as its Eqs. (4) and (5) have it: sin, cos. Printed is sin, sin, and K1 would
  /// not be symmetric.
  Matrix fixed_stiffness() const {
    Matrix K = Matrix::Zero();
    const Differences L = differences();
    K.template topRightCorner<2 * Dimension, Dimension>() = L.transpose();
    K.template bottomLeftCorner<Dimension, 2 * Dimension>() = L;
    return K;
  }
  /// f1 (paper, Eq. (36)), with the values of Table 1 in the constraint rows.
  static LoadVector fixed_load(const ConstraintValues<Scalar>& values = {}) {
    LoadVector f = LoadVector::Zero();
    f[row_n] = values.a;
    f[row_s] = values.b;
    return f;
  }

  /// K2 (paper, Eq. (37)): the tangential force is known.
  Matrix sliding_stiffness() const {
    Matrix K = fixed_stiffness();
    K.row(row_s).setZero();
    K.col(row_s).setZero();
    K(row_s, row_s) = 1;
    return K;
  }
  /// f2 (paper, Eq. (38)), `T` the tangential force [N].
  LoadVector sliding_load(Scalar T) const {
    LoadVector f = LoadVector::Zero();
    f.template head<2 * Dimension>() = -T * differences().row(1).transpose();
    f[row_s] = T;
    return f;
  }

  /// K3 (paper, Eq. (39)): both forces are known. (In space so is the third: zero.)
  static Matrix separated_stiffness() {
    Matrix K = Matrix::Zero();
    for (int i = row_n; i < unknowns; ++i) K(i, i) = 1;
    return K;
  }
  /// f3 (paper, Eq. (40)), `N` and `T` the normal and tangential force [N].
  LoadVector separated_load(Scalar N, Scalar T) const {
    const Differences L = differences();
    LoadVector f = LoadVector::Zero();
    f.template head<2 * Dimension>() = -N * L.row(0).transpose() - T * L.row(1).transpose();
    f[row_n] = N;
    f[row_s] = T;
    return f;
  }

  /// K2 with Eq. (24) of the paper put in for T, so that no iteration on f is needed: sigma_s = direction mu
  /// |sigma_n| with |sigma_n| = -sigma_n in contact. `direction` is the sign of sigma_s. Not symmetric.
  Matrix sliding_stiffness_at_limit(Scalar direction) const {
    Matrix K = fixed_stiffness();
    K.row(row_s).setZero();
    K(row_s, row_n) = direction * mu;
    K(row_s, row_s) = 1;
    return K;
  }
};

}  // namespace taut
