// All elements of a scene, made once: struts, beams, cable segments, friction elements, substructures.
#pragma once

#include "taut/elements/beam.hpp"
#include "taut/elements/cable_segment.hpp"
#include "taut/elements/friction_element.hpp"
#include "taut/elements/strut.hpp"
#include "taut/elements/substructure.hpp"

namespace taut {

/// The beams' elements.
template <class Scalar, int Dimension, int Count>
struct BeamElements {
  FixedArray<BeamElement<Scalar, Dimension>, Count> beams;

  /// `scene` must be valid. The arm of the rotations is the longest beam.
  template <class SceneType>
  void make_beams(const SceneType& scene) {
    Scalar arm = 0;
    for (const auto& beam : scene.beams)
      arm = std::fmax(
          arm,
          Line<Scalar, Dimension>::between(scene.nodes[beam.nodes[0]], scene.nodes[beam.nodes[1]]).length);
    for (int i = 0; i < scene.beams.size(); ++i) beams[i] = BeamElement<Scalar, Dimension>::of(scene, i, arm);
  }
};
/// Where there cannot be any.
template <class Scalar, int Dimension>
struct BeamElements<Scalar, Dimension, 0> {
  template <class SceneType>
  void make_beams(const SceneType&) {}
};

/// The elements of a scene in the scalar type of the calculation; geometry is taken in that of the scene.
template <class Scalar, class SceneType>
struct Elements : BeamElements<Scalar, SceneType::dimension, SceneType::Capacity::beams> {
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;

  FixedArray<StrutElement<Scalar, dimension>, Cap::struts> struts;
  FixedArray<CableElement<Scalar, dimension>, Cap::segments> segments;
  FixedArray<FrictionElement<Scalar, dimension>, Cap::joints> joints;

  /// `scene` must be valid.
  void make(const SceneType& scene) {
    for (int i = 0; i < scene.struts.size(); ++i) struts[i] = StrutElement<Scalar, dimension>::of(scene, i);
    this->make_beams(scene);
    for (int c = 0; c < scene.cables.size(); ++c) {
      const auto& cable = scene.cables[c];
      for (int i = 0; i < cable.segments(); ++i)
        segments[cable.first_segment + i] = CableElement<Scalar, dimension>::of(scene, c, i);
      for (int j = 0; j < cable.joints(); ++j)
        joints[cable.first_joint + j] = FrictionElement<Scalar, dimension>::of(scene, c, j);
    }
  }
};

}  // namespace taut
