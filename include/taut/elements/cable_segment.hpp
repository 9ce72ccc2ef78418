// Cable segment: an elastic bar between two neighbouring joints or cable ends, in tension only.
#pragma once

#include "taut/elements/strut.hpp"

namespace taut {

/// A cable segment, ready for use: Eq. (6).
///
/// T = EA/L x (elongation between its ends + extension of a jack) + EA x prestrain - EA x alpha x warming.
/// The elongation is that of the line between the cable's own points (node 3 of the friction elements), or
/// the structure's node at a cable end. Linear: L is the distance of the nodes.
template <class Scalar, int Dimension>
struct CableElement {
  std::array<int, 2> nodes{};   ///< of the structure
  std::array<int, 2> joints{};  ///< friction joints at its ends, -1 at a cable end
  int cable = 0;
  Line<Scalar, Dimension> line;
  Scalar axial = 0;    ///< EA/L [N/m]
  Scalar initial = 0;  ///< EA x prestrain [N]
  Scalar thermal = 0;  ///< EA x alpha [N/K]: force lost a kelvin

  /// Segment `i` of cable `c`, both zero-based.
  template <class SceneType>
  static CableElement of(const SceneType& scene, int c, int i) {
    const auto& given = scene.cables[c];
    const auto EA = given.E * given.A;
    CableElement made;
    made.nodes = scene.segment_nodes(given, i);
    made.joints = given.segment_joints(i);
    made.cable = c;
    made.line = Line<Scalar, Dimension>::between(scene.nodes[made.nodes[0]], scene.nodes[made.nodes[1]]);
    made.axial = static_cast<Scalar>(EA) / made.line.length;
    made.initial = static_cast<Scalar>(EA * scene.prestrain[given.first_segment + i]);
    made.thermal = static_cast<Scalar>(EA * given.alpha);
    return made;
  }

  /// 2D x 2D, on the displacements of both ends [N/m].
  auto stiffness() const { return bar_stiffness<Scalar, Dimension>(line.direction, axial); }
};

}  // namespace taut
