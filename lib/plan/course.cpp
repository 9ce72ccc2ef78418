#include "lib/plan/course.hpp"

#include <algorithm>
#include <utility>

#include "lib/plan/objective.hpp"

namespace taut::host {
namespace {

// A limit is kept in the log, too, whose forces may differ by rounding.
constexpr double just_below = 1 - 1e-9;
constexpr double no_answer = 1e12, beyond_limits = 1e6;

}  // namespace

std::size_t open_forces(const CourseShape& shape) {
  std::size_t count = 0;
  for (const CourseStep& step : shape) count += step.locks ? 0 : step.jacks.size();
  return count;
}

std::vector<PlanStage> stages_of(const CourseShape& shape, const std::vector<double>& force,
                                 PlanStage first) {
  std::vector<PlanStage> stages;
  PlanStage stage = std::move(first);
  std::size_t next = 0;
  for (const CourseStep& step : shape) {
    for (const std::size_t jack : step.jacks) {
      if (step.locks)
        stage.locked[jack] = 1;
      else
        stage.force[jack] = force[next++];
    }
    stages.push_back(stage);
  }
  return stages;
}

std::vector<double> forces_of(const CourseShape& shape, const std::vector<PlanStage>& stages,
                              std::size_t first) {
  std::vector<double> force;
  for (std::size_t s = first; s < shape.size(); ++s)
    for (const std::size_t jack : shape[s].jacks)
      if (!shape[s].locks) force.push_back(stages[s].force[jack]);
  return force;
}

double CourseOutcome::merit() const {
  if (!whole) return no_answer;
  return excess > 0 ? beyond_limits * (1 + excess) : error;
}

double excess_at(const LegPoint& point, const PlanGoal& goal, const std::vector<PlanJack>& jacks) {
  double most = 0;
  for (std::size_t i = 0; i < point.tension.size(); ++i)
    most = std::max(most, point.tension[i] / (just_below * goal.most_segment[i]) - 1);
  for (std::size_t k = 0; k < jacks.size(); ++k)
    most = std::max(most, point.stroke[k] / (just_below * jacks[k].most_stroke) - 1);
  return most;
}

Course::Course(Jacking& jacking, const PlanGoal& goal, CourseShape shape, std::string start,
               std::vector<double> least_ratio)
    : jacking_(jacking),
      goal_(goal),
      shape_(std::move(shape)),
      least_ratio_(std::move(least_ratio)),
      state_{std::move(start)},
      excess_{0} {
  for (std::size_t s = 0; s < shape_.size(); ++s)
    for (const std::size_t jack : shape_[s].jacks) {
      if (shape_[s].locks) continue;
      step_of_.push_back(s);
      jack_of_.push_back(jack);
    }
}

double Course::least_ratio(std::size_t force) const {
  if (force + 1 >= step_of_.size() || step_of_[force] != step_of_[force + 1]) return 0;
  const std::size_t cable = jacking_.jacks()[jack_of_[force]].cable;
  return jacking_.jacks()[jack_of_[force + 1]].cable == cable ? least_ratio_[cable] : 0;
}

void Course::bring_together(std::vector<double>& force) const {
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double ratio = least_ratio(k);
    if (ratio == 0) continue;
    force[k] = std::min(force[k], force[k + 1] / ratio);
    force[k + 1] = std::min(force[k + 1], force[k] / ratio);
  }
}

double Course::excess_of(const Leg& leg) const {
  double most = 0;
  for (const LegPoint& point : leg.points) most = std::max(most, excess_at(point, goal_, jacking_.jacks()));
  return most;
}

CourseOutcome Course::at(const std::vector<double>& force) {
  const std::vector<PlanStage> stages = stages_of(shape_, force, jacking_.beginning());
  std::size_t same = 0;
  while (same < known_.size() && stages[same].force == known_[same].force) ++same;
  known_.resize(same);
  state_.resize(same + 1);
  excess_.resize(same + 1);
  last_.tension.resize(same);
  last_.stroke.resize(same);
  last_.whole = true;
  if (same < shape_.size()) jacking_.go_to(state_[same]);
  for (std::size_t s = same; s < shape_.size(); ++s) {
    const Leg leg = jacking_.follow(stages[s]);
    last_.whole = leg.whole;
    if (!leg.whole) return last_;
    excess_.push_back(std::max(excess_.back(), excess_of(leg)));
    known_.push_back(stages[s]);
    state_.push_back(jacking_.state());
    last_.tension.push_back(leg.end().tension);
    last_.stroke.push_back(leg.end().stroke);
  }
  last_.excess = excess_.back();
  last_.error = off_target(last_.tension.back(), goal_.target);
  return last_;
}

}  // namespace taut::host
