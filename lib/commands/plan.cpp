#include "lib/commands/plan.hpp"

#include <iostream>
#include <optional>

#include "lib/files/input_error.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/valid_scene.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal_file.hpp"
#include "lib/plan/objective.hpp"
#include "lib/plan/plan_log.hpp"
#include "lib/plan/plan_sheet.hpp"
#include "lib/plan/plan_table.hpp"
#include "lib/plan/plan_words.hpp"
#include "lib/plan/prior.hpp"

namespace taut::host {
namespace {

void keep_files_apart(const PlanOptions& options) {
  keep_inputs(options.log, {options.scene, options.goal});
  keep_inputs(options.sheet, {options.scene, options.goal});
  keep_apart(options.log, options.sheet, "the log and the sheet of one plan");
  require_writable(options.log);
  require_writable(options.sheet);
}

// What is said of the plan is what simulate finds for its log.
void take_simulated(const PlanGoal& goal, PlanResult& result) {
  CourseOutcome& outcome = result.plan.outcome;
  for (std::size_t row = 0; row < result.simulated.answers.size(); ++row)
    if (const int stage = stage_of_row(result.plan, row); stage >= 0)
      outcome.tension[static_cast<std::size_t>(stage)] = result.simulated.answers[row].tension;
  outcome.error = off_target(outcome.tension.back(), goal.target);
}

}  // namespace

int plan(const PlanOptions& options) {
  const SceneDescription scene = read_scene_file(options.scene);
  require_valid(scene);
  const PlanGoal goal = read_goal_file(options.goal, scene);
  keep_files_apart(options);
  PlanResult result;
  result.plan = find_plan(scene, goal);
  if (!result.plan.status()) {
    std::cerr << options.scene << ": " << no_plan_text(scene, result.plan) << '\n';
    return 1;
  }
  if (options.is_robust) {
    if (!has_prior(scene))
      throw InputError(scene.file, "/cables",
                       "says of no cable how well mu is known, so no plan can be robust",
                       "write mu_sd into \"friction\", or leave --robust out");
    const PriorOutcome prior = outcome_over_prior(scene, goal, result.plan.jacks, result.plan.stages);
    result.for_mean = {result.plan.outcome.error, prior.expected, prior.at_95};
    result.plan = find_robust_plan(scene, goal, result.plan);
  }
  const std::string log = plan_log(scene, goal, result.plan);
  result.simulated = simulate(log, scene);
  if (!result.simulated.stopped.empty()) {
    std::cerr << options.scene << ": the plan comes to no end: " << result.simulated.stopped << '\n';
    return 1;
  }
  take_simulated(goal, result);
  if (has_prior(scene)) result.prior = outcome_over_prior(scene, goal, result.plan.jacks, result.plan.stages);
  if (!options.log.empty()) {
    OutputFile file(options.log);
    file.write(log);
    file.finish();
  }
  if (!options.sheet.empty()) {
    OutputFile file(options.sheet);
    file.write(plan_sheet({scene, goal, result, options.scene, usual_jacking(scene, goal, 0),
                           usual_jacking(scene, goal, rule_excess)}));
    file.finish();
  }
  OutputFile table("");
  table.write(plan_table(scene, goal, result));
  table.finish();
  if (!result.plan.limits_stop_it) return 0;
  std::cerr << options.goal << ": /limits: they leave no way to come nearer to the targets than "
            << part_text(result.plan.outcome.error) << ", without them "
            << part_text(result.plan.without_limits)
            << " is possible; write larger limits, or other targets\n";
  return 1;
}

}  // namespace taut::host
