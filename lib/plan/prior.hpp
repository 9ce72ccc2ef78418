// What comes of a plan when mu is other than its mean: a fixed, even sample of what is known of it.
#pragma once

#include <array>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/jacking.hpp"

namespace taut::host {

/// Whether the scene says of any cable that its mu is not known exactly.
bool has_prior(const SceneDescription& scene);

/// The scene with mu drawn from what it knows: of point `number` of a sequence that fills the prior evenly
/// (Kronecker, with square roots of primes), always the same. Normal, one factor for a cable whose mu is
/// `shared`, with `scatter` from joint to joint about it; below zero it is zero.
SceneDescription drawn(const SceneDescription& scene, std::size_t number);

/// The scene with what has been learned of mu in place of what it says: of every joint its mean and standard
/// deviation, one after the other as in an Answer.
SceneDescription with_mu(const SceneDescription& scene, const std::vector<double>& mu,
                         const std::vector<double>& deviation);

/// How many draws stand for the prior: 100, and 32 in second-order theory, where condensing takes long.
std::size_t draws_of(const SceneDescription& scene);

/// What a plan does over the prior.
struct PriorOutcome {
  std::size_t draws = 0, failed = 0;  ///< of these the model has no answer
  double expected = 0, at_95 = 0;     ///< off_target() after the last stage
  /// Of every stage and jack [m]: between these 95 % of the draws are.
  std::vector<std::vector<std::array<double, 2>>> stroke;
};
/// Of a plan that goes on where the moves of `past` have led to, with a `past`.
PriorOutcome outcome_over_prior(const SceneDescription& scene, const PlanGoal& goal,
                                const std::vector<PlanJack>& jacks, const std::vector<PlanStage>& stages,
                                const std::vector<PastMove>& past = {}, const GiveUp& give_up = {});

}  // namespace taut::host
