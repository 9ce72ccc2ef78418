// A plan as a log: what is jacked, row by row.
#pragma once

#include <string>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal.hpp"

namespace taut::host {

/// The reading of a gauge for a force: by its calibration, else the force itself.
double reading_of(const InstrumentDescription& gauge, double force);

/// What a gauge shows while its jack pulls with a force, or is let out: with the friction of its ram.
double gauge_shows(const InstrumentDescription& gauge, double force, bool pulls);

/// The log of a plan: a row for the loads, one for every stage, a minute apart; `simulate` follows it.
/// Columns of calibrated jacks are in the unit of their gauge.
std::string plan_log(const SceneDescription& scene, const PlanGoal& goal, const Plan& plan);

/// What `taut simulate` finds for such a log.
struct SimulatedPlan {
  std::vector<double> time;     ///< [s]
  std::vector<Answer> answers;  ///< of every row
  std::string stopped;          ///< why there is no answer for all rows; empty: there is
};
SimulatedPlan simulate(const std::string& log, const SceneDescription& scene);

}  // namespace taut::host
