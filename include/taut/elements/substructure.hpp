// Substructure: a linear elastic body known by its stiffness matrix on a few nodes.
#pragma once

#include <cmath>

#include "taut/numerics/larger.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// A view of one substructure: its matrix and the displacements it acts on, in the order of its list, axis by
/// axis.
template <class SceneType>
class SubstructureElement {
 public:
  using Scalar = typename SceneType::Scalar;
  static constexpr int dimension = SceneType::dimension;

  constexpr SubstructureElement(const SceneType& scene, int index)
      : scene_(&scene), given_(&scene.substructures[index]) {}

  /// Number of displacements: rows and columns of the matrix.
  constexpr int size() const { return given_->nodes * dimension; }
  constexpr int node(int row) const {
    return scene_->substructure_nodes[given_->first_node + row / dimension];
  }
  static constexpr int axis(int row) { return row % dimension; }
  /// Stiffness [N/m].
  constexpr Scalar operator()(int row, int column) const {
    return scene_->substructure_entries[entry(row, column)];
  }
  /// The number of an entry in the scene's list.
  constexpr int entry(int row, int column) const { return given_->first_entry + row * size() + column; }

  /// How much it resists the displacements u(node, axis) [m]: the largest force on a node, over the largest
  /// entry of the matrix [m]. Zero where it moves as a rigid body. Cost: the square of its rows.
  template <class Displacement>
  Scalar strain(const Displacement& u) const {
    Scalar force = 0, stiffest = 0;
    for (int row = 0; row < size(); ++row) {
      Scalar held = 0;
      for (int column = 0; column < size(); ++column) {
        held += (*this)(row, column) * static_cast<Scalar>(u(node(column), axis(column)));
        stiffest = larger(stiffest, std::fabs((*this)(row, column)));
      }
      force = larger(force, std::fabs(held));
    }
    return stiffest > 0 ? force / stiffest : Scalar(0);
  }

 private:
  const SceneType* scene_;
  const Substructure* given_;
};

/// The largest SubstructureElement::strain() of a scene [m]; zero if it has no substructure.
template <class SceneType, class Displacement>
typename SceneType::Scalar largest_strain(const SceneType& scene, const Displacement& u) {
  typename SceneType::Scalar most = 0;
  for (int i = 0; i < scene.substructures.size(); ++i)
    most = larger(most, SubstructureElement<SceneType>(scene, i).strain(u));
  return most;
}

}  // namespace taut
