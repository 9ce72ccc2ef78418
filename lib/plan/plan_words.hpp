// What is to be said of a plan, in sentences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/plan_log.hpp"
#include "lib/plan/prior.hpp"
#include "lib/plan/robust_plan.hpp"

namespace taut::host {

/// A plan with all that was found of it, for the table and the sheet.
struct PlanResult {
  Plan plan;
  SimulatedPlan simulated;             ///< by the log of the plan
  std::optional<PriorOutcome> prior;   ///< where mu is not known exactly
  std::optional<PlanErrors> for_mean;  ///< of the plan for the mean of mu, where this is a robust one
};

/// `segment 3 of cable "C"`, for a segment of the scene.
std::string segment_text(const SceneDescription& scene, std::size_t segment);
/// A part as per cent with three digits behind the point.
std::string part_text(double part);

/// How near the forces come, over the prior too, and what keeps them from being nearer.
std::vector<std::string> plan_sentences(const SceneDescription& scene, const PlanGoal& goal,
                                        const PlanResult& result);

/// Why there is no plan, where its status says so: what is free, on which way, and what helps.
std::string no_plan_text(const SceneDescription& scene, const Plan& plan);

}  // namespace taut::host
