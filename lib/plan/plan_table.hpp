// The plan on standard output.
#pragma once

#include <string>

#include "lib/plan/plan_words.hpp"

namespace taut::host {

/// What is to be said as remarks, which begin with #, and a table of comma-separated columns that stand below
/// each other: a row for every row of the log, with stage, time, jack forces, strokes and where 95 % of them
/// are over the prior, and the forces of all segments. SI units, numbers that read back the same.
std::string plan_table(const SceneDescription& scene, const PlanGoal& goal, const PlanResult& result);

/// What a row of the log is: `loads`, the number of a move, or `lock`.
std::string stage_name(const Plan& plan, std::size_t row);
/// The stage of a row of the log, or -1 for that of the loads.
int stage_of_row(const Plan& plan, std::size_t row);

}  // namespace taut::host
