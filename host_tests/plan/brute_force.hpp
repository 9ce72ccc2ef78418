// Brute force on the model of the host, moved row by row: shares nothing with the searches.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "lib/plan/goal.hpp"
#include "lib/plan/jacking.hpp"
#include "lib/plan/objective.hpp"

namespace plan_test {

/// Of where the moves of the past have led to, the least error of a grid: the first jack goes to one or, with
/// two moves, two of `grid` + 1 forces up to twice the first target, and is locked off if the goal says so.
/// Infinite if the past has no answer.
inline double best_of_rest(const taut::host::SceneDescription& scene, const taut::host::PlanGoal& goal,
                           const std::vector<taut::host::PlanJack>& jacks,
                           const std::vector<taut::host::PastMove>& past, int moves, int grid = 120) {
  using namespace taut::host;
  Jacking jacking(scene, goal, jacks);
  double best = std::numeric_limits<double>::infinity();
  if (!jacking.begin_after(past)) return best;
  PlanStage stage = jacking.beginning();
  const std::string here = jacking.state();
  const double most = 2 * goal.target[0];
  const auto look = [&](const std::string& reached) {
    if (goal.lock) {
      PlanStage locked = stage;
      locked.locked[0] = 1;
      if (!jacking.jump(locked).whole) return;
    }
    best = std::min(best, off_target(jacking.here().tension, goal.target));
    jacking.go_to(reached);
  };
  look(here);
  for (int i = 0; i <= grid; ++i) {
    jacking.go_to(here);
    stage.force[0] = most * i / grid;
    if (!jacking.jump(stage).whole) continue;
    const std::string turned = jacking.state();
    look(turned);
    for (int k = 0; k <= grid && moves > 1; ++k) {
      jacking.go_to(turned);
      stage.force[0] = most * k / grid;
      if (jacking.jump(stage).whole) look(jacking.state());
    }
  }
  return best;
}

}  // namespace plan_test
