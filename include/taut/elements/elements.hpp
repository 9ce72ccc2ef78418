// All elements of a scene, made once: struts, cable segments, friction elements, substructures.
#pragma once

#include "taut/elements/cable_segment.hpp"
#include "taut/elements/friction_element.hpp"
#include "taut/elements/strut.hpp"
#include "taut/elements/substructure.hpp"

namespace taut {

/// The elements of a scene in the scalar type of the calculation; geometry is taken in that of the scene.
template <class Scalar, class SceneType>
struct Elements {
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;

  FixedArray<StrutElement<Scalar, dimension>, Cap::struts> struts;
  FixedArray<CableElement<Scalar, dimension>, Cap::segments> segments;
  FixedArray<FrictionElement<Scalar, dimension>, Cap::joints> joints;

  /// `scene` must be valid.
  void make(const SceneType& scene) {
    for (int i = 0; i < scene.struts.size(); ++i) struts[i] = StrutElement<Scalar, dimension>::of(scene, i);
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
