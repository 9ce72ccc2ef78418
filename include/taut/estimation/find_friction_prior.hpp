// Collects what a scene says of friction and load cells.
#pragma once

#include <cmath>

#include "taut/elements/friction_element.hpp"
#include "taut/estimation/friction_prior.hpp"

namespace taut {

/// Standard deviation of the strain that a cable takes on by itself once its jacks are locked [-].
template <class Real>
constexpr Real drift_sd(const Cable<Real>& cable) {
  const bool has_jack = cable.ends[0] == End::jacked || cable.ends[1] == End::jacked;
  return has_jack && !cable.closed ? cable.alpha * cable.temperature_sd : Real(0);
}

/// Standard deviation of the shared mu of cable `c` [-], which stands for the friction of all of its joints
/// together: sqrt(sd^2 + (s m)^2 sum k^2 / (sum k)^2), with the standard deviation `sd` of what is known of
/// mu, the scatter s of Eq. (29), k what mu times the contact factor is at a joint that can slide, and the
/// mean m of their mu. `prior` has all else of that cable. Cost: a pass over the joints.
template <class Scalar, class Cap, class CableType>
Scalar shared_deviation(const CableType& cable, int c, const FrictionPrior<Scalar, Cap>& prior) {
  using Real = Wide<Scalar>;
  Real mu = 0, kappa = 0, square = 0;
  int free = 0;
  for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
    if (!(prior.limit(c, j, prior.mu[j]).rho > 0)) continue;
    const Real at = prior.mu[j] * prior.contact_factor[j];
    mu += prior.mu[j];
    kappa += at;
    square += at * at;
    ++free;
  }
  if (!(kappa > 0)) return prior.mu_sd[c];
  const Real sd = static_cast<Real>(prior.mu_sd[c]),
             part = static_cast<Real>(prior.scatter[c]) * mu / (static_cast<Real>(free) * kappa);
  return static_cast<Scalar>(std::sqrt(sd * sd + part * part * square));
}

/// Fills `prior` from a valid scene.
template <class Scalar, class SceneType>
void find_friction_prior(const SceneType& scene, FrictionPrior<Scalar, typename SceneType::Capacity>& prior) {
  using Real = Wide<Scalar>;
  using Frame = JointFrame<Real, SceneType::dimension>;
  prior = {};
  for (int c = 0; c < scene.cables.size(); ++c) {
    const auto& cable = scene.cables[c];
    prior.capstan[c] = cable.law == FrictionLaw::capstan;
    prior.mu_sd[c] = static_cast<Scalar>(cable.mu_sd);
    prior.shared[c] = cable.shared_mu;
    prior.seating_sd[c] = static_cast<Scalar>(cable.seating_sd);
    prior.drift_sd[c] = static_cast<Scalar>(drift_sd(cable));
    for (int i = 0; prior.drift_sd[c] > 0 && i < cable.segments(); ++i) {
      const auto at = scene.segment_nodes(cable, i);
      prior.length[cable.first_segment + i] = static_cast<Scalar>(
          Line<Real, SceneType::dimension>::between(scene.nodes[at[0]], scene.nodes[at[1]]).length);
    }
    prior.scatter[c] = static_cast<Scalar>(cable.scatter);
    for (std::size_t end = 0; end < 2; ++end) prior.cell[c][end] = LoadCell<Scalar>::of(cable.cell[end]);
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const auto at = scene.joint_nodes(cable, k);
      const auto frame = Frame::of(scene.nodes[at.before], scene.nodes[at.at], scene.nodes[at.after]);
      const auto half = [&](int from, int to) {
        return static_cast<Real>(
            Line<Real, SceneType::dimension>::between(scene.nodes[from], scene.nodes[to]).length / 2);
      };
      prior.mu[j] = static_cast<Real>(scene.mu[j]);
      prior.contact_factor[j] =
          prior.capstan[c] ? capstan_angle(frame.cos_alpha, frame.sin_alpha, static_cast<Real>(cable.wobble),
                                           half(at.before, at.at) + half(at.at, at.after))
                           : frame.cos_alpha / frame.sin_alpha;
    }
    if (prior.shared[c] && prior.scatter[c] > 0) prior.mu_sd[c] = shared_deviation(cable, c, prior);
  }
}

}  // namespace taut
