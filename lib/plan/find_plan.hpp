// The plan that brings forces nearest to their targets.
#pragma once

#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/plan/course.hpp"
#include "lib/plan/friction_chain.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/jacking.hpp"
#include "taut/status.hpp"

namespace taut::host {

/// How far that a plan is the best is certain.
enum class Certainty {
  best_found,     ///< no better one was found
  best_of_moves,  ///< no other forces of so many moves are nearer
  best_of_all     ///< friction allows nothing nearer, however it is jacked
};

/// A plan, and what it leads to by the model. Units: N, m.
struct Plan {
  Status status = Status::success();  ///< else the structure has no answer before any jack moves
  std::vector<PlanJack> jacks;
  CourseShape shape;
  std::vector<PlanStage> stages;  ///< one a step of the shape
  bool loads_come_first = true;   ///< in a row of their own, before the first stage
  LegPoint before;                ///< under the loads alone
  CourseOutcome outcome;          ///< after every stage
  Certainty certainty = Certainty::best_found;
  /// The cable and its segments that friction keeps from being nearer however they are jacked, and how near.
  std::size_t bound_cable = 0;
  FrictionBound bound;
  std::vector<std::size_t> unmoved;  ///< segments with a target that no jack has anything to do with
  double without_limits = 0;  ///< error of the best plan that heeds none, where one is heeded and it is large
  bool limits_stop_it = false;
  std::size_t moves_tried = 0;
};

/// How far from its target a plan is useless.
inline constexpr double far_off = 0.2;

/// The best plan of at most `goal.stages` moves (two a cable where the goal does not say). A move is one of
/// the jacks of one cable, both at once where it has two; cables with fewer moves than there are of them move
/// together. Throws InputError for a scene or a goal that cannot be used. Deterministic and bounded; methods
/// and what of them is proved: see README.md of lib.
Plan find_plan(const SceneDescription& scene, const PlanGoal& goal);

/// What is usual in place of a plan: a pull to the target of the segment at each jack; with an `excess`,
/// beyond it by this part and back. With lock-off where the goal asks for it.
struct UsualJacking {
  std::vector<PlanStage> stages;
  CourseOutcome outcome;
};
UsualJacking usual_jacking(const SceneDescription& scene, const PlanGoal& goal, double excess);

}  // namespace taut::host
