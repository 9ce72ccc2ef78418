// What is known of friction and of the load cells before anything is measured.
#pragma once

#include <array>
#include <cmath>

#include "taut/elements/friction_element.hpp"
#include "taut/numerics/decay.hpp"
#include "taut/numerics/wide.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// Friction of every joint as a function of its mu, how well mu is known, and the noise of the load cells.
/// Beside Condensed, all that an Estimator needs of a scene; an aggregate, it can be a constant in flash.
template <class Scalar_, class Cap>
struct Knowledge {
  using Scalar = Scalar_;
  using Real = Wide<Scalar>;

  FixedArray<Real, Cap::joints> mu;  ///< nominal [-]
  /// What mu is multiplied by: cot(alpha) of a point contact, beta + k s of a capstan [-].
  FixedArray<Real, Cap::joints> grip;
  FixedArray<bool, Cap::cables> capstan;
  FixedArray<Scalar, Cap::cables> mu_sd;  ///< standard deviation of what is known of mu; 0: known exactly
  FixedArray<bool, Cap::cables> shared;   ///< one unknown a cable: a common factor on the nominal values
  FixedArray<std::array<Scalar, 2>, Cap::cables> sensor_sd;  ///< of the load cells at both ends [N]

  /// rho = T_small / T_big at which a joint of cable `c` slides, and its derivative with respect to mu:
  /// (1 - kappa) / (1 + kappa) with kappa = mu cot(alpha), or exp(-mu (beta + k s)).
  struct Limit {
    Real rho, slope;
  };
  constexpr Limit limit(int c, int joint, Real at_mu) const {
    const Real g = grip[joint];
    if (capstan[c]) {
      const Real rho = decay(at_mu * g);
      return {rho, -g * rho};
    }
    const Real kappa = at_mu * g;
    return {(Real(1) - kappa) / (Real(1) + kappa), Real(-2) * g / ((Real(1) + kappa) * (Real(1) + kappa))};
  }
};

/// Collects it from a valid scene.
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
    for (std::size_t end = 0; end < 2; ++end)
      knowledge.sensor_sd[c][end] = static_cast<Scalar>(cable.sensor_sd[end]);
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const auto at = scene.joint_nodes(cable, k);
      const auto frame = Frame::of(scene.nodes[at.before], scene.nodes[at.at], scene.nodes[at.after]);
      const auto half = [&](int from, int to) {
        return static_cast<Real>(
            Line<Real, SceneType::dimension>::between(scene.nodes[from], scene.nodes[to]).length / 2);
      };
      knowledge.mu[j] = static_cast<Real>(scene.mu[j]);
      knowledge.grip[j] = knowledge.capstan[c] ? Real(2) * std::atan2(frame.cos_alpha, frame.sin_alpha) +
                                                     static_cast<Real>(cable.wobble) *
                                                         (half(at.before, at.at) + half(at.at, at.after))
                                               : frame.cos_alpha / frame.sin_alpha;
    }
  }
}

}  // namespace taut
