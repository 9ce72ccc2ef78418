#include "lib/plan/robust_plan.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/plan/objective.hpp"

namespace taut::host {
namespace {

constexpr std::size_t most_trials = 400, most_trials_second_order = 40, starts = 3;
constexpr int grid = 24, grid_second_order = 5;
constexpr double first_step = 0.05, last_step = 0.0005;  // of a force
constexpr double out_of_question = 1e12;

// Plans as their open forces, tried at the mean of mu for the limits and over some draws for the error.
class Trials {
 public:
  Trials(const SceneDescription& scene, const PlanGoal& goal, const std::vector<PlanJack>& jacks)
      : goal_(goal),
        jacks_(jacks),
        mean_(std::make_unique<Site>(scene, goal, jacks)),
        least_ratio_(scene.cables.size(), 0) {
    for (std::size_t number = 0; number < draws_of(scene); ++number)
      draws_.push_back(std::make_unique<Site>(drawn(scene, number), goal, jacks));
  }

  /// The mean error over the draws; out of question where a limit is passed or half of them have no answer.
  double expected(const CourseShape& shape, const std::vector<double>& force) {
    for (std::size_t i = 0, next = 0; i < shape.size(); ++i)
      for (std::size_t k = 0; !shape[i].locks && k < shape[i].jacks.size(); ++k, ++next)
        if (!(force[next] >= 0 && force[next] <= jacks_[shape[i].jacks[k]].most_force))
          return out_of_question;
    if (has_limits(goal_) && !keeps_limits(at_mean(shape, force))) return out_of_question;
    double sum = 0;
    std::size_t whole = 0;
    for (const auto& draw : draws_) {
      if (!draw->stands) continue;
      draw->jacking.go_to(draw->start);
      LegPoint end;
      bool goes_on = true;
      for (const PlanStage& stage : stages_of(shape, force, draw->jacking.beginning())) {
        const Leg leg = draw->jacking.jump(stage);
        goes_on = leg.whole;
        if (!goes_on) break;
        end = leg.end();
      }
      if (!goes_on) continue;
      ++whole;
      sum += off_target(end.tension, goal_.target);
    }
    return 2 * whole > draws_.size() ? sum / static_cast<double>(whole) : out_of_question;
  }

  /// At the mean of mu.
  CourseOutcome at_mean(const CourseShape& shape, const std::vector<double>& force) {
    mean_->jacking.go_to(mean_->start);
    // Jacks that pull a cable through have no answer here, so their forces need not be kept together.
    return Course(mean_->jacking, goal_, shape, mean_->start, least_ratio_).at(force);
  }
  std::vector<PlanStage> stages(const CourseShape& shape, const std::vector<double>& force) const {
    return stages_of(shape, force, mean_->jacking.beginning());
  }
  bool stands() const { return mean_->stands; }

 private:
  // A site with a mu of its own. The jacking refers to the scene beside it.
  struct Site {
    Site(SceneDescription of, const PlanGoal& goal, const std::vector<PlanJack>& jacks)
        : scene(std::move(of)),
          jacking(scene, goal, jacks),
          stands(jacking.begin()),
          start(jacking.state()) {}
    SceneDescription scene;
    Jacking jacking;
    bool stands;
    std::string start;
  };

  static bool keeps_limits(const CourseOutcome& outcome) { return outcome.whole && outcome.excess == 0; }

  const PlanGoal& goal_;
  const std::vector<PlanJack>& jacks_;
  std::unique_ptr<Site> mean_;
  std::vector<double> least_ratio_;
  std::vector<std::unique_ptr<Site>> draws_;
};

struct Candidate {
  CourseShape shape;
  std::vector<double> force;
  double expected = out_of_question;
};

// Along one force at a time and two neighbours together, up and down, with steps that halve where none gains.
void descend(Trials& trials, Candidate& at, std::size_t most) {
  struct Direction {
    std::size_t force;
    double by, by_next;
  };
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < at.force.size(); ++i)
    for (const double way : {1.0, -1.0}) {
      directions.push_back({i, way, 0});
      if (i + 1 == at.force.size()) continue;
      directions.push_back({i, way, way});
      directions.push_back({i, way, -way});
    }
  std::size_t tried = 0;
  for (double step = first_step; step >= last_step; step /= 2) {
    for (bool gains = true; gains && tried < most;) {
      gains = false;
      for (const Direction& direction : directions) {
        std::vector<double> force = at.force;
        force[direction.force] *= 1 + direction.by * step;
        if (direction.by_next != 0) force[direction.force + 1] *= 1 + direction.by_next * step;
        const double expected = trials.expected(at.shape, force);
        ++tried;
        if (!(expected < at.expected)) continue;
        at.force = std::move(force);
        at.expected = expected;
        gains = true;
      }
    }
  }
}

// With mu higher by so many standard deviations.
SceneDescription shifted(const SceneDescription& scene, double deviations) {
  SceneDescription other = scene;
  for (CableDescription& cable : other.cables)
    for (double& mu : cable.mu) mu = std::max(mu + deviations * cable.mu_sd, 0.0);
  return other;
}

// Of one jack that pulls and lets out: pairs of a grid of forces, from half of the target to twice of it.
void add_pairs(Trials& trials, const CourseShape& shape, double target, int count,
               std::vector<Candidate>& found) {
  const auto force = [&](int k) { return target * (0.5 + 1.5 * k / count); };
  for (int up = 0; up <= count; ++up)
    for (int back = 0; back <= up; ++back) {
      Candidate pair{shape, {force(up), force(back)}};
      pair.expected = trials.expected(pair.shape, pair.force);
      found.push_back(std::move(pair));
    }
}

// The best of those that differ from the better ones by more than a tenth in a force.
std::vector<Candidate> best_apart(std::vector<Candidate> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.expected < b.expected; });
  std::vector<Candidate> best;
  for (Candidate& each : all) {
    if (best.size() == starts || !(each.expected < out_of_question)) break;
    const bool is_apart = std::all_of(best.begin(), best.end(), [&](const Candidate& other) {
      if (other.force.size() != each.force.size()) return true;
      for (std::size_t i = 0; i < each.force.size(); ++i)
        if (std::fabs(each.force[i] - other.force[i]) > 0.1 * other.force[i]) return true;
      return false;
    });
    if (is_apart) best.push_back(std::move(each));
  }
  return best;
}

}  // namespace

Plan find_robust_plan(const SceneDescription& scene, const PlanGoal& goal, const Plan& for_mean) {
  Trials trials(scene, goal, for_mean.jacks);
  if (!trials.stands()) return for_mean;
  std::vector<Candidate> found;
  const auto add = [&](const Plan& plan) {
    Candidate candidate{plan.shape, forces_of(plan.shape, plan.stages)};
    candidate.expected = trials.expected(candidate.shape, candidate.force);
    found.push_back(std::move(candidate));
  };
  add(for_mean);
  double least = found[0].expected;
  for (const double deviations : {-2.0, -1.0, 0.5, 1.0, 2.0})
    if (const Plan plan = find_plan(shifted(scene, deviations), goal); plan.status() && plan.outcome.whole)
      add(plan);
  const CourseShape shape = found[0].shape;
  if (open_forces(shape) == 2 && shape[0].jacks == shape[1].jacks)
    add_pairs(trials, shape, *std::max_element(goal.target.begin(), goal.target.end()),
              scene.second_order ? grid_second_order : grid, found);
  found = best_apart(std::move(found));
  const std::size_t most = scene.second_order ? most_trials_second_order : most_trials;
  for (Candidate& each : found) descend(trials, each, most);

  Plan best = for_mean;
  for (const Candidate& each : found) {
    if (!(each.expected < least)) continue;
    CourseOutcome outcome = trials.at_mean(each.shape, each.force);
    if (!outcome.whole) continue;
    least = each.expected;
    best.shape = each.shape;
    best.stages = trials.stages(each.shape, each.force);
    best.outcome = std::move(outcome);
    best.certainty = Certainty::best_found;
  }
  return best;
}

}  // namespace taut::host
