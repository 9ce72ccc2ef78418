// The sheet of a plan, to take to the site.
#pragma once

#include <string>

#include "lib/plan/plan_words.hpp"

namespace taut::host {

/// What the sheet compares the plan with.
struct SheetContent {
  const SceneDescription& scene;
  const PlanGoal& goal;
  const PlanResult& result;
  std::string scene_file;
  UsualJacking straight, rule;  ///< a straight pull; a pull beyond it by `rule_excess`, and back
};

/// How far the rule of thumb pulls beyond the target.
inline constexpr double rule_excess = 0.05;

/// One self-contained HTML page for A4: per stage what each jack does, what its gauge should show (by its
/// calibration and the friction of its ram), the stroke to expect with its tolerance, and when to stop, with
/// room for what is read; then the forces along the cables beside those of usual jacking, and after every
/// stage. The same input gives the same bytes.
std::string plan_sheet(const SheetContent& content);

}  // namespace taut::host
