// Beam: a straight Euler-Bernoulli member with or without hinges at its ends.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "taut/elements/strut.hpp"
#include "taut/numerics/double_word.hpp"

namespace taut {

/// A beam, ready for use: forces against its own deformations, as "The beam" in include/taut/README.md has
/// it.
///
/// Its unknowns are those of both nodes, of each first the displacements [m], then `arm` x the rotations [m]:
/// with the length `arm` all of them and their forces have the same units. A rotation at a hinged end has no
/// stiffness: whoever assembles the matrices gives it an unknown only if something else turns with the node.
template <class Scalar, int Dimension>
struct BeamElement {
  static constexpr int rotations = rotations_of_node<Dimension>;
  static constexpr int per_node = Dimension + rotations;  ///< unknowns of a node
  static constexpr int unknowns = 2 * per_node;
  /// Elongation; for each of its planes how far both ends turn against the line between the nodes; in space
  /// the twist. All [m].
  static constexpr int deformations = per_node;
  static constexpr int planes = Dimension - 1;  ///< in which it bends
  using Point = Eigen::Matrix<Scalar, Dimension, 1>;
  using Matrix = Eigen::Matrix<Scalar, unknowns, unknowns>;
  using DeformationMatrix = Eigen::Matrix<Scalar, deformations, unknowns>;
  using OwnStiffness = Eigen::Matrix<Scalar, deformations, deformations>;

  std::array<int, 2> nodes{};
  std::array<bool, 2> hinged{};
  Line<Scalar, Dimension> line;
  std::array<Point, planes> normal;      ///< along its y and, in space, its z: the planes in which it bends
  Scalar arm = 1;                        ///< [m]
  Scalar axial = 0;                      ///< EA/L [N/m]
  std::array<Scalar, planes> bending{};  ///< EI/L/arm^2, for deflections along each normal [N/m]
  Scalar torsion = 0;                    ///< GJ/L/arm^2, in space [N/m]
  Scalar stiffest = 0;                   ///< largest entry of its stiffness [N/m]

  /// Beam `index` of a scene; `length` [m] is the arm of its rotations.
  template <class SceneType>
  static BeamElement of(const SceneType& scene, int index, Scalar length) {
    using Real = typename SceneType::Scalar;
    const auto& given = scene.beams[index];
    const auto& section = given.section;
    const auto fine =
        Line<Real, Dimension>::between(scene.nodes[given.nodes[0]], scene.nodes[given.nodes[1]]);
    BeamElement made;
    made.nodes = given.nodes;
    made.hinged = given.hinged;
    made.line = Line<Scalar, Dimension>::between(scene.nodes[given.nodes[0]], scene.nodes[given.nodes[1]]);
    made.arm = length;
    made.axial = static_cast<Scalar>(section.E * section.A) / made.line.length;
    const Scalar turning = Scalar(1) / (made.line.length * length * length);
    if constexpr (Dimension == 2) {
      made.normal[0] << -made.line.direction[1], made.line.direction[0];
      made.bending[0] = static_cast<Scalar>(section.E * section.I) * turning;
    } else {
      const auto z = upward(fine.direction, section.up);
      made.normal[0] = z.cross(fine.direction).template cast<Scalar>();
      made.normal[1] = z.template cast<Scalar>();
      made.bending[0] = static_cast<Scalar>(section.E * section.Iz) * turning;
      made.bending[1] = static_cast<Scalar>(section.E * section.Iy) * turning;
      made.torsion = static_cast<Scalar>(section.G * section.J) * turning;
    }
    made.stiffest = made.stiffness().diagonal().maxCoeff();
    return made;
  }

  /// The part of `up` square to a direction, as a unit vector: the beam's z.
  template <class Real>
  static Eigen::Matrix<Real, 3, 1> upward(const Eigen::Matrix<Real, 3, 1>& direction,
                                          const std::array<Real, 3>& up) {
    using Vector = Eigen::Matrix<Real, 3, 1>;
    const Vector given = Vector(up[0], up[1], up[2]).stableNormalized();
    const Vector square = given - direction * direction.dot(given);
    return square / square.norm();
  }

  bool has_torsion() const { return Dimension == 3 && !hinged[0] && !hinged[1]; }

  /// B: deformations from the unknowns.
  DeformationMatrix deformation() const {
    DeformationMatrix B = DeformationMatrix::Zero();
    const auto stretch = [&B](int row, const auto& along) {
      B.template block<1, Dimension>(row, 0) = -along.transpose();
      B.template block<1, Dimension>(row, per_node) = along.transpose();
    };
    stretch(0, line.direction);
    for (int plane = 0; plane < planes; ++plane)
      for (int end = 0; end < 2; ++end) {
        const int row = 1 + 2 * plane + end;
        stretch(row, Point(normal[static_cast<std::size_t>(plane)] * (-arm / line.length)));
        turn(B, row, end, plane);
      }
    if constexpr (Dimension == 3) {
      B.template block<1, 3>(5, 3) = -line.direction.transpose();
      B.template block<1, 3>(5, 9) = line.direction.transpose();
    }
    return B;
  }

  /// Forces [N] against the deformations; hinges are condensed out.
  OwnStiffness own_stiffness() const {
    OwnStiffness k = OwnStiffness::Zero();
    k(0, 0) = axial;
    for (int plane = 0; plane < planes; ++plane)
      add_to_ends(k, plane, bending[static_cast<std::size_t>(plane)], {4, 2, 3});
    if constexpr (Dimension == 3) k(5, 5) = has_torsion() ? torsion : Scalar(0);
    return k;
  }

  /// On the unknowns [N/m].
  Matrix stiffness() const { return assembled(own_stiffness()); }

  /// Geometric stiffness [N/m] of an axial force N (tension positive): consistent with the shapes
  /// that the beam bends to, with its hinges. None for torsion.
  Matrix geometric(Scalar N) const {
    OwnStiffness k = OwnStiffness::Zero();
    const Scalar per_arm = N * line.length / (arm * arm);
    for (int plane = 0; plane < planes; ++plane)
      add_to_ends(k, plane, per_arm, {Scalar(2) / 15, -Scalar(1) / 30, Scalar(1) / 5});
    Matrix K = assembled(k);
    for (const Point& n : normal) {
      Eigen::Matrix<Scalar, unknowns, 1> across = Eigen::Matrix<Scalar, unknowns, 1>::Zero();
      across.template segment<Dimension>(0) = -n;
      across.template segment<Dimension>(per_node) = n;
      K += (N / line.length * across).lazyProduct(across.transpose());
    }
    return K;
  }

  /// Axial force [N], tension positive, from the displacements of its two nodes.
  Scalar axial_force(const Point& first, const Point& second) const {
    return axial * line.direction.dot(second - first);
  }

  /// The forces [N] that hold its ends at displacements in double words, so that they keep the digits that
  /// cancel in deformations; at(i) is unknown i.
  template <class At>
  std::array<Scalar, unknowns> end_forces(At at) const {
    const DeformationMatrix B = deformation();
    const OwnStiffness k = own_stiffness();
    const auto deformed = deformed_by(B, at);
    std::array<Scalar, unknowns> forces{};
    for (int row = 0; row < deformations; ++row) {
      DoubleWord<Scalar> force;
      for (int column = 0; column < deformations; ++column)
        if (k(row, column) != 0) force += k(row, column) * deformed[static_cast<std::size_t>(column)];
      for (int i = 0; i < unknowns; ++i) forces[static_cast<std::size_t>(i)] += B(row, i) * force.value();
    }
    return forces;
  }

  /// The largest of the deformations that it resists [m].
  template <class At>
  Scalar largest_deformation(At at) const {
    const OwnStiffness k = own_stiffness();
    const auto deformed = deformed_by(deformation(), at);
    Scalar most = 0;
    for (int row = 0; row < deformations; ++row)
      if (k(row, row) > 0) most = std::fmax(most, std::fabs(deformed[static_cast<std::size_t>(row)].value()));
    return most;
  }

 private:
  template <class At>
  static std::array<DoubleWord<Scalar>, deformations> deformed_by(const DeformationMatrix& B, At at) {
    std::array<DoubleWord<Scalar>, deformations> deformed;
    for (int row = 0; row < deformations; ++row)
      for (int i = 0; i < unknowns; ++i)
        if (B(row, i) != 0) deformed[static_cast<std::size_t>(row)] += B(row, i) * at(i);
    return deformed;
  }

  /// Entries for an end that is rigid: its own, beside the other end's, and its own beside a hinge.
  struct EndEntries {
    Scalar own, other, beside_hinge;
  };

  void add_to_ends(OwnStiffness& k, int plane, Scalar factor, const EndEntries& entries) const {
    const int first = 1 + 2 * plane;
    for (int end = 0; end < 2; ++end)
      if (!hinged[static_cast<std::size_t>(end)])
        k(first + end, first + end) =
            factor * (hinged[static_cast<std::size_t>(1 - end)] ? entries.beside_hinge : entries.own);
    if (hinged[0] || hinged[1]) return;
    k(first, first + 1) = k(first + 1, first) = factor * entries.other;
  }

  /// The rotation of an end in a plane: about the axis that turns the beam's direction to the normal.
  void turn(DeformationMatrix& B, int row, int end, int plane) const {
    const int column = end * per_node + Dimension;
    if constexpr (Dimension == 2) {
      static_cast<void>(plane);
      B(row, column) = 1;
    } else {
      const Point about = line.direction.cross(normal[static_cast<std::size_t>(plane)]);
      B.template block<1, 3>(row, column) = about.transpose();
    }
  }

  Matrix assembled(const OwnStiffness& k) const {
    const DeformationMatrix B = deformation();
    const DeformationMatrix kB = k.lazyProduct(B);
    return B.transpose().lazyProduct(kB);
  }
};

}  // namespace taut
