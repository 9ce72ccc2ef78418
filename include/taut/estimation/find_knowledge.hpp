// Collects what a scene says of friction and load cells.
#pragma once

#include "taut/elements/friction_element.hpp"
#include "taut/estimation/knowledge.hpp"

namespace taut {

/// Fills `knowledge` from a valid scene.
template <class Scalar, class SceneType>
void find_knowledge(const SceneType& scene, Knowledge<Scalar, typename SceneType::Capacity>& knowledge) {
  using Real = Wide<Scalar>;
  using Frame = JointFrame<Real, SceneType::dimension>;
  knowledge = {};
  for (int c = 0; c < scene.cables.size(); ++c) {
    const auto& cable = scene.cables[c];
    knowledge.capstan[c] = cable.law == FrictionLaw::capstan;
    knowledge.mu_sd[c] = static_cast<Scalar>(cable.mu_sd);
    knowledge.shared[c] = cable.shared_mu;
    knowledge.seating_sd[c] = static_cast<Scalar>(cable.seating_sd);
    knowledge.scatter[c] = static_cast<Scalar>(cable.scatter);
    for (std::size_t end = 0; end < 2; ++end) knowledge.cell[c][end] = LoadCell<Scalar>::of(cable.cell[end]);
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const auto at = scene.joint_nodes(cable, k);
      const auto frame = Frame::of(scene.nodes[at.before], scene.nodes[at.at], scene.nodes[at.after]);
      const auto half = [&](int from, int to) {
        return static_cast<Real>(
            Line<Real, SceneType::dimension>::between(scene.nodes[from], scene.nodes[to]).length / 2);
      };
      knowledge.mu[j] = static_cast<Real>(scene.mu[j]);
      knowledge.grip[j] = knowledge.capstan[c] ? capstan_angle(frame.cos_alpha, frame.sin_alpha,
                                                               static_cast<Real>(cable.wobble),
                                                               half(at.before, at.at) + half(at.at, at.after))
                                               : frame.cos_alpha / frame.sin_alpha;
    }
  }
}

}  // namespace taut
