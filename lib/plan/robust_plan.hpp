// A plan against all that is known of mu, rather than for its mean.
#pragma once

#include "lib/files/scene_description.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/prior.hpp"

namespace taut::host {

/// What comes of a plan at the mean of mu and over what is known of it.
struct PlanErrors {
  double at_mean = 0, expected = 0, at_95 = 0;
};

/// The plan whose expected error over the draws of drawn() is the smallest that was found, its limits kept at
/// the mean of mu; `for_mean` is what find_plan() gives, and comes back where nothing is better. Begins with
/// that, with the plans for five other values of mu, two standard deviations up and down, and with a grid
/// where one jack pulls and lets out; goes downhill from the best three, along one force or two that follow
/// each other, with steps from a twentieth of them down to a two thousandth. Nothing is proved. Throws what
/// find_plan() does. Deterministic; at most some 1000 trials, each as long as draws_of() plans.
Plan find_robust_plan(const SceneDescription& scene, const PlanGoal& goal, const Plan& for_mean);

}  // namespace taut::host
