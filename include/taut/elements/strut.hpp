// Strut: a pin-ended elastic bar in tension or compression.
#pragma once

#include <Eigen/Core>

#include "taut/scene/scene.hpp"

namespace taut {

/// The line between two points.
template <class Scalar, int Dimension>
struct Line {
  Eigen::Matrix<Scalar, Dimension, 1> direction;  ///< unit vector from the first point to the second
  Scalar length;                                  ///< [m]

  /// Computed in the scalar type of the points, so that a short line far from the origin keeps its digits.
  template <class Real>
  static Line between(const Node<Real, Dimension>& a, const Node<Real, Dimension>& b) {
    Eigen::Matrix<Real, Dimension, 1> d;
    for (int axis = 0; axis < Dimension; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      d[axis] = b.at[i] - a.at[i];
    }
    const Real length = d.stableNorm();
    return {(d / length).template cast<Scalar>(), static_cast<Scalar>(length)};
  }
};

/// The axial stiffness matrix of a bar, EA/L [N/m], on the displacements of its two ends [N/m].
template <class Scalar, int Dimension>
Eigen::Matrix<Scalar, 2 * Dimension, 2 * Dimension> bar_stiffness(
    const Eigen::Matrix<Scalar, Dimension, 1>& direction, Scalar axial) {
  Eigen::Matrix<Scalar, 2 * Dimension, 1> b;
  b << -direction, direction;
  return (axial * b).lazyProduct(b.transpose());
}

/// The geometric stiffness matrix of a bar, N/L [N/m] across its axis: what a force in it does when it leans.
template <class Scalar, int Dimension>
Eigen::Matrix<Scalar, 2 * Dimension, 2 * Dimension> lateral_stiffness(
    const Eigen::Matrix<Scalar, Dimension, 1>& direction, Scalar force_by_length) {
  using Block = Eigen::Matrix<Scalar, Dimension, Dimension>;
  const Block across = force_by_length * (Block::Identity() - direction.lazyProduct(direction.transpose()));
  Eigen::Matrix<Scalar, 2 * Dimension, 2 * Dimension> K;
  K << across, -across, -across, across;
  return K;
}

/// A strut, ready for use: force = EA/L x elongation, tension positive.
template <class Scalar, int Dimension>
struct StrutElement {
  std::array<int, 2> nodes{};
  Line<Scalar, Dimension> line;
  Scalar axial = 0;  ///< EA/L [N/m]

  template <class SceneType>
  static StrutElement of(const SceneType& scene, int strut) {
    const auto& given = scene.struts[strut];
    StrutElement made;
    made.nodes = given.nodes;
    made.line = Line<Scalar, Dimension>::between(scene.nodes[given.nodes[0]], scene.nodes[given.nodes[1]]);
    made.axial = static_cast<Scalar>(given.E * given.A) / made.line.length;
    return made;
  }

  /// 2D x 2D, on the displacements of both nodes [N/m].
  auto stiffness() const { return bar_stiffness<Scalar, Dimension>(line.direction, axial); }
};

}  // namespace taut
