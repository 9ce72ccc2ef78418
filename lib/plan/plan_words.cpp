#include "lib/plan/plan_words.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

// The segments that are the furthest off.
struct Furthest {
  std::size_t low = 0, high = 0;
  double least = 0, most = 0;
};
Furthest furthest(const std::vector<double>& tension, const PlanGoal& goal) {
  Furthest found;
  for (std::size_t i = 0; i < goal.target.size(); ++i) {
    if (!goal.matters(i)) continue;
    const double off = tension[i] / goal.target[i] - 1;
    if (off < found.least) {
      found.least = off;
      found.low = i;
    }
    if (off > found.most) {
      found.most = off;
      found.high = i;
    }
  }
  return found;
}

std::string moves_text(const Plan& plan) {
  std::size_t moves = 0;
  for (const CourseStep& step : plan.shape) moves += step.locks ? 0 : 1;
  return counted(moves, "move");
}

}  // namespace

std::string segment_text(const SceneDescription& scene, std::size_t segment) {
  for (const CableDescription& cable : scene.cables) {
    if (segment < cable.segments())
      return "segment " + std::to_string(segment + 1) + " of cable " + quote(cable.name);
    segment -= cable.segments();
  }
  return "";
}

std::string part_text(double part) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f %%", 100 * part);
  return text.data();
}

std::vector<std::string> plan_sentences(const SceneDescription& scene, const PlanGoal& goal,
                                        const PlanResult& result) {
  const Plan& plan = result.plan;
  std::vector<std::string> said;
  const double error = plan.outcome.error;
  said.push_back("with " + moves_text(plan) + (goal.lock ? " and lock-off" : "") +
                 " the forces come within " + part_text(error) + " of their targets, at the mean of mu");
  if (result.prior) {
    const PriorOutcome& prior = *result.prior;
    said.push_back("over what is known of mu: at its mean " + part_text(error) + ", expected " +
                   part_text(prior.expected) + ", at 95 % " + part_text(prior.at_95));
    if (prior.failed > 0)
      said.push_back(counted(prior.failed, "draw") + " of " + std::to_string(prior.draws) +
                     " of mu had no answer and do not count");
  }
  if (result.for_mean)
    said.push_back("the plan for the mean of mu alone: at its mean " + part_text(result.for_mean->at_mean) +
                   ", expected " + part_text(result.for_mean->expected) + ", at 95 % " +
                   part_text(result.for_mean->at_95));
  const Furthest far = furthest(plan.outcome.tension.back(), goal);
  std::string stop;
  if (far.least < 0) stop += segment_text(scene, far.low) + " (" + part_text(-far.least) + " too low)";
  if (far.most > 0)
    stop += (stop.empty() ? "" : " and ") + segment_text(scene, far.high) + " (" + part_text(far.most) +
            " too high)";
  const bool is_pair = far.least < 0 && far.most > 0;
  if (error > 1e-9 && result.for_mean)
    said.push_back("no smaller expected error was found (not proved); at the mean of mu " + stop +
                   (is_pair ? " are" : " is") + " the furthest");
  else if (error > 1e-9) {
    const std::string friction = has_limits(goal) ? "friction and the limits allow" : "friction allows";
    const std::string stops = is_pair ? " stop it" : " stops it";
    switch (plan.certainty) {
      case Certainty::best_of_all:
        said.push_back(friction + " nothing nearer, however it is jacked: " + stop + stops);
        break;
      case Certainty::best_of_moves:
        said.push_back(friction + " nothing nearer in so many moves (proved): " + stop + stops);
        break;
      case Certainty::best_found:
        said.push_back("nothing nearer was found (not proved): " + stop + stops);
        break;
    }
  }
  for (const std::size_t segment : plan.unmoved)
    said.push_back("no jack has any effect on " + segment_text(scene, segment) + ", which stays " +
                   part_text(std::fabs(plan.outcome.tension.back()[segment] / goal.target[segment] - 1)) +
                   " off");
  if (plan.bound.error > 1e-9 && plan.certainty != Certainty::best_of_all) {
    const std::size_t first = scene.first_segment(plan.bound_cable);
    const std::string low = segment_text(scene, first + plan.bound.low);
    said.push_back("by friction alone no jacking whatever comes nearer than " + part_text(plan.bound.error) +
                   ": " + low +
                   (plan.bound.low == plan.bound.high
                        ? " is held by its limit"
                        : " and segment " + std::to_string(plan.bound.high + 1) +
                              " differ by more than the joints between them hold"));
  }
  if (plan.limits_stop_it)
    said.push_back("the limits of " + goal.file + " stand in the way: without them " +
                   part_text(plan.without_limits) + " would be possible");
  return said;
}

std::string no_plan_text(const SceneDescription& scene, const Plan& plan) {
  const FailedMove& failure = plan.failure;
  if (failure.to.force.empty()) return failure_text(failure.status, scene).english();
  std::string way;
  for (std::size_t k = 0; k < plan.jacks.size(); ++k)
    way += (k == 0 ? "" : ", ") + plan.jacks[k].name + " " +
           std::to_string(std::llround(failure.to.force[k])) + " N";
  if (!plan.loads_come_first) way += " with the loads of the goal";
  const std::string where = failure.part < 1e-6 ? "at once" : "after " + part_text(failure.part);
  // Jacks alone balance one another only while they pull just so; a length that is given takes what is left.
  Sentence remedy;
  if (failure.status.code == Code::mechanism && plan.jacks.size() > 1 && !scene.second_order)
    remedy = Sentence("{1}, or {2}", {failure_remedy(failure.status, scene),
                                      Sentence("make all but one of the jacked ends that pull at it "
                                               "\"anchored\": a jack gives a force, and holds nothing")});
  return "no jack can be moved; on the way to " + way + ", " + where + ": " +
         failure_text(failure.status, scene, remedy).english();
}

}  // namespace taut::host
