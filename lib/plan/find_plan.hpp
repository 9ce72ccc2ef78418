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
  /// The first trial, if the structure has no answer as soon as a jack moves; it goes to no forces where it
  /// has none before.
  FailedMove failure;
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
  bool is_as_before = false;  ///< of a rest: it is that of the plan until now

  /// That of the failure: success if there is a plan.
  const Status& status() const { return failure.status; }
};

/// How far from its target a plan is useless.
inline constexpr double far_off = 0.2;

/// The best plan of at most `goal.stages` moves (two a cable where the goal does not say). A move is one of
/// the jacks of one cable, both at once where it has two; cables with fewer moves than there are of them move
/// together. Throws InputError for a scene or a goal that cannot be used. Deterministic and bounded; methods
/// and what of them is proved: see README.md of lib.
///
/// `give_up`, if given, is asked all the time; GivenUp is thrown where nobody needs the plan any more.
Plan find_plan(const SceneDescription& scene, const PlanGoal& goal, const GiveUp& give_up = {});

/// By how much nearer to the targets another plan has to come before anybody is told to jack otherwise.
inline constexpr double worth_a_change = 5e-4;

/// What has been jacked, and what is left to do.
struct PlanPast {
  std::vector<PastMove> moves;  ///< the jacks' turning points, the last one where they stand now
  CourseShape rest;             ///< the stages to come of the plan until now, with the present one
  std::size_t moves_left = 1;   ///< at most so many where one cable alone is jacked
  bool stays = false;           ///< no other is looked for: what comes of this one is the question
  std::vector<double> force;    ///< those of the plan until now in `rest`, to begin from
};

/// The best plan from there on: friction remembers what was jacked, so it is followed first. With one cable
/// to jack it has at most `moves_left` moves, with several those of `rest`. The plan until now stays if no
/// other comes nearer by more than worth_a_change. `before` is under the loads alone. Nothing is proved.
/// Throws and costs what find_plan() does.
Plan find_rest_of_plan(const SceneDescription& scene, const PlanGoal& goal, const PlanPast& past,
                       const GiveUp& give_up = {});

/// What is usual in place of a plan: a pull to the target of the segment at each jack; with an `excess`,
/// beyond it by this part and back. With lock-off where the goal asks for it.
struct UsualJacking {
  std::vector<PlanStage> stages;
  CourseOutcome outcome;
};
UsualJacking usual_jacking(const SceneDescription& scene, const PlanGoal& goal, double excess);

}  // namespace taut::host
