// The friction that a tracker computes with: the one it was given, at the level that the forces have reached.
#pragma once

#include "taut/tracking/cable_system.hpp"
#include "taut/tracking/level.hpp"

namespace taut {

/// Gives every joint that is not self-locking the friction `friction(joint)`, a JointFriction, where that
/// depends on an unknown; all others keep that of the model. Nothing is done without unknowns. Cost: one pass
/// over the joints.
template <class Cables, class LevelType, class Friction>
void depend_on_friction(Cables& cables, const LevelType& level, const Friction& friction) {
  if constexpr (Cables::is_adjustable)
    for (int j = 0; j < cables.joints(); ++j) {
      if (cables.model->is_self_locking(j)) continue;
      const JointFriction<typename Cables::Real> given = level.leant(j, friction(j));
      if (given.parameter < 0) continue;
      cables.laws.set_rho(j, given.rho);
      cables.derivatives.depend(j, given.parameter, given.slope);
    }
  else
    static_cast<void>(friction);
}

/// The numbers of the model are those of another level: friction and its derivatives follow. Cost: one pass
/// over the joints.
template <class Cables, class LevelType>
void take_level(Cables& cables, const LevelType& level) {
  using Real = typename Cables::Real;
  cables.take_model();
  if constexpr (Cables::is_adjustable)
    for (int j = 0; j < cables.joints(); ++j) {
      if (!cables.derivatives.depends(j)) {
        cables.laws.set_rho(j, cables.model->rho[j]);
        continue;
      }
      const Real before = cables.laws.rho(j);
      cables.laws.set_rho(j, Cables::Model::scaled(before, level.growth(j)));
      const Real ratio = (1 + kappa_of(before)) / (1 + kappa_of(cables.laws.rho(j)));
      cables.derivatives.scale(j, level.growth(j) * ratio * ratio);
    }
}

}  // namespace taut
