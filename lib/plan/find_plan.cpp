#include "lib/plan/find_plan.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/condensed_arrays.hpp"
#include "lib/plan/descent.hpp"
#include "lib/plan/objective.hpp"
#include "lib/plan/up_and_back.hpp"

namespace taut::host {
namespace {

constexpr std::size_t moves_up_and_back = 100, moves_polish = 28, moves_short = 500, moves_long = 4000;
constexpr std::size_t samples = 48, most_descents = 8, most_built_up = 6;
// As equal as makes no difference on a gauge.
constexpr double as_good = 1e-9;

// The segments of a cable; of a hoop, cut open where it begins.
FrictionChain chain_of(const SceneDescription& scene, const PlanGoal& goal, const std::vector<double>& rho,
                       std::size_t c) {
  const CableDescription& cable = scene.cables[c];
  const std::size_t segment = scene.first_segment(c), joint = scene.first_joint(c);
  FrictionChain chain;
  for (std::size_t i = 0; i < cable.segments(); ++i) {
    chain.target.push_back(goal.target[segment + i]);
    chain.most.push_back(goal.most_segment[segment + i]);
    if (i + 1 < cable.segments()) chain.rho.push_back(rho[joint + i + (cable.closed ? 1 : 0)]);
  }
  for (std::size_t end = 0; end < 2; ++end) {
    if (!cable.is_jacked(end)) continue;
    double& most = end == 0 ? chain.most.front() : chain.most.back();
    if (!goal.lock) most = std::min(most, goal.most_force[c][end]);
  }
  return chain;
}

// How far apart the forces of two jacks may be on every cable, and a little less.
std::vector<double> least_ratios(const SceneDescription& scene, const std::vector<double>& rho) {
  const double inside = scene.second_order ? 1 + 1e-3 : 1 + 1e-7;
  std::vector<double> ratios;
  std::size_t joint = 0;
  for (const CableDescription& cable : scene.cables) {
    double ratio = 1;
    for (std::size_t j = 0; j < cable.joints(); ++j) ratio *= rho[joint++];
    ratios.push_back(std::min(1.0, inside * ratio));
  }
  return ratios;
}

// Jacks that move together.
struct Group {
  std::size_t cable = 0;
  std::vector<std::size_t> jacks;
};

// Of every cable that has a target and a jack; of all with a jack, if those with a target have none.
std::vector<Group> groups_of(const SceneDescription& scene, const PlanGoal& goal,
                             const std::vector<PlanJack>& jacks) {
  std::vector<Group> with_target, all;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    Group group{c, {}};
    for (std::size_t k = 0; k < jacks.size(); ++k)
      if (jacks[k].cable == c) group.jacks.push_back(k);
    if (group.jacks.empty()) continue;
    bool matters = false;
    const std::size_t first = scene.first_segment(c);
    for (std::size_t i = first; i < first + scene.cables[c].segments(); ++i)
      matters = matters || goal.matters(i);
    if (matters) with_target.push_back(group);
    all.push_back(std::move(group));
  }
  return with_target.empty() ? all : with_target;
}

std::vector<std::size_t> jacks_of(const std::vector<Group>& groups) {
  std::vector<std::size_t> all;
  for (const Group& group : groups) all.insert(all.end(), group.jacks.begin(), group.jacks.end());
  return all;
}

// Each cable has its moves one after the other and is locked then; or all have them in rounds.
CourseShape shape_in_turn(const std::vector<Group>& groups, std::size_t stages, bool lock, bool in_rounds) {
  CourseShape shape;
  const std::size_t count = groups.size();
  if (in_rounds) {
    for (std::size_t s = 0; s < stages; ++s) shape.push_back({groups[s % count].jacks, false});
    if (lock) shape.push_back({jacks_of(groups), true});
    return shape;
  }
  for (std::size_t g = 0; g < count; ++g) {
    const std::size_t moves = stages / count + (g < stages % count ? 1 : 0);
    for (std::size_t m = 0; m < moves; ++m) shape.push_back({groups[g].jacks, false});
    if (lock) shape.push_back({groups[g].jacks, true});
  }
  return shape;
}
CourseShape shape_at_once(const std::vector<Group>& groups, std::size_t stages, bool lock) {
  CourseShape shape(stages, {jacks_of(groups), false});
  if (lock) shape.push_back({jacks_of(groups), true});
  return shape;
}

class PlanSearch {
 public:
  PlanSearch(const SceneDescription& scene, const PlanGoal& goal, const GiveUp& give_up,
             const PlanPast* past = nullptr)
      : scene_(scene), goal_(goal), full_target_(goal.target), past_(past) {
    condensed_ = condense(scene, ScalarType::float64);
    if (!condensed_.condensing.status) return;
    jacks_ = plan_jacks(scene, goal, condensed_.most_force);
    jacking_ = std::make_unique<Jacking>(scene_, goal_, jacks_, give_up);
    groups_ = groups_of(scene, goal, jacks_);
    least_ratio_ = least_ratios(scene, condensed_.rho);
  }

  Plan find() {
    Plan plan;
    plan.jacks = jacks_;
    plan.failure.status = condensed_.condensing.status;
    if (!plan.status()) return plan;
    if (!jacking_->begin()) {
      plan.failure.status = jacking_->why();
      return plan;
    }
    start_ = jacking_->state();
    plan.before = jacking_->here();
    require_reach(plan.before);
    require_limits_to_hold(plan.before);
    find_bound(plan);
    leave_out_what_stays(plan);
    stages_ = goal_.has_stages ? static_cast<std::size_t>(goal_.stages) : 2 * groups_.size();

    Found best;
    Found before;
    if (past_ != nullptr) {
      stages_ = past_->moves_left;
      // What would be jacked if nothing had been yet: a part of the first pull takes nothing away from it.
      Found from_rest;
      if (is_one_jack() && !past_->stays) search_all(from_rest);
      if (!jacking_->begin_after(past_->moves)) {
        plan.failure.status = jacking_->why();
        return plan;
      }
      start_ = jacking_->state();
      is_on_the_way_ = true;
      best = before = from_here(past_->rest, past_->force);
      if (past_->stays) return finished(plan, best, true);
      if (!from_rest.shape.empty()) take_better(best, from_here(from_rest.shape, from_rest.plan.force));
    }
    search_all(best);
    if (past_ == nullptr && !jacking_->has_moved() && best.merit() > far_off) {
      plan.failure = jacking_->first_failure();
      plan.loads_come_first = jacking_->loads_come_first();
      if (!plan.status()) return plan;
    }
    if (past_ != nullptr && before.merit() <= best.merit() + worth_a_change)
      return finished(plan, before, true);
    be_gentle(best);
    drop_idle_moves(best);
    return finished(plan, best, false);
  }

 private:
  struct Found {
    CourseShape shape;
    CoursePlan plan;
    bool is_closed = false;  // nothing of as many moves is better
    double merit() const { return shape.empty() ? 1e300 : plan.outcome.merit(); }
  };

  // All that is tried from where the jacks stand.
  void search_all(Found& best) {
    if (is_one_jack()) take_better(best, one_jack());
    const bool is_whole = is_one_jack() && stages_ <= 2 && (stages_ == 2 || !goal_.lock);
    if (is_whole && best.merit() < 1) {
      if (!is_settled_) polish(best);
    } else {
      // One move more at a time: what fewer moves reach is where more begin.
      if (is_one_jack())
        for (std::size_t moves = 3; moves < std::min(stages_, most_built_up); ++moves)
          take_better(best, search(shape_at_once(groups_, moves, goal_.lock), best));
      for (const CourseShape& shape : shapes()) take_better(best, search(shape, best));
      best.is_closed = false;
    }
    if (goal_.lock && stages_ > 1 && groups_.size() == 1) {
      // A pull alone does as well where the lock-off slides all back.
      Found pull = search(shape_at_once(groups_, 1, true), {});
      if (pull.merit() <= best.merit() + as_good) {
        pull.is_closed = best.is_closed;
        best = std::move(pull);
      }
    }
  }

  Plan finished(Plan plan, const Found& best, bool is_as_before) const {
    plan.is_as_before = is_as_before;
    plan.loads_come_first = jacking_->loads_come_first();
    plan.shape = best.shape;
    plan.stages = stages_of(best.shape, best.plan.force, jacking_->beginning());
    plan.outcome = best.plan.outcome;
    if (plan.outcome.whole) plan.outcome.error = off_target(plan.outcome.tension.back(), full_target_);
    plan.moves_tried = jacking_->legs();
    // In second-order theory friction follows the displaced geometry, and pieces do not quite meet.
    const bool is_linear = past_ == nullptr && (!scene_.second_order || condensed_.rigid);
    if (is_linear && plan.outcome.error <= plan.bound.error + as_good)
      plan.certainty = Certainty::best_of_all;
    else if (is_linear && best.is_closed)
      plan.certainty = Certainty::best_of_moves;
    return plan;
  }

  static void take_better(Found& best, Found other) {
    if (other.merit() < best.merit()) best = std::move(other);
  }

  // Between rigid saddles nothing comes over a joint that is self-locking.
  void require_reach(const LegPoint& rest) const {
    for (std::size_t c = 0; condensed_.rigid && c < scene_.cables.size(); ++c) {
      const CableDescription& cable = scene_.cables[c];
      const std::size_t n = cable.segments(), segment = scene_.first_segment(c),
                        joint = scene_.first_joint(c);
      if (cable.closed || !(cable.is_jacked(0) || cable.is_jacked(1))) continue;
      for (std::size_t i = 0; i < n; ++i) {
        if (!goal_.matters(segment + i) || rest.tension[segment + i] > 0) continue;
        // The joint next to it that is in the way of each jack; n: none.
        std::size_t before = n, behind = n;
        for (std::size_t j = 0; j < i; ++j)
          if (condensed_.rho[joint + j] == 0) before = j;
        for (std::size_t j = i; j + 1 < n && behind == n; ++j)
          if (condensed_.rho[joint + j] == 0) behind = j;
        if ((cable.is_jacked(0) && before == n) || (cable.is_jacked(1) && behind == n)) continue;
        throw InputError(goal_.file, "/target" + pointer_step(cable.name),
                         "no jack reaches segment " + std::to_string(i + 1) + " of cable " +
                             quote(cable.name) + ": joint " +
                             std::to_string((cable.is_jacked(1) ? behind : before) + 1) + " is self-locking",
                         "write null for this segment, or a smaller mu in the scene");
      }
    }
  }

  void require_limits_to_hold(const LegPoint& rest) const {
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t i = 0; i < scene_.cables[c].segments(); ++i) {
        const std::size_t segment = scene_.first_segment(c) + i;
        if (rest.tension[segment] <= goal_.most_segment[segment]) continue;
        throw InputError(goal_.file, "/limits" + pointer_step(scene_.cables[c].name),
                         "segment " + std::to_string(i + 1) + " of cable " + quote(scene_.cables[c].name) +
                             " has " + plain(std::round(rest.tension[segment])) + " N before any jack pulls",
                         "write a larger limit, or other loads");
      }
  }

  // Targets of segments that no pull changes would hide what can be done for the others.
  void leave_out_what_stays(Plan& plan) {
    std::vector<char> changes(goal_.target.size(), 0);
    for (const Group& group : groups_)
      for (const double part : {0.3, 1.0}) {
        jacking_->go_to(start_);
        PlanStage stage = jacking_->at_rest();
        for (const std::size_t k : group.jacks)
          stage.force[k] = std::min(jacks_[k].most_force, part * usual_force(k));
        const Leg leg = jacking_->jump(stage);
        for (std::size_t i = 0; leg.whole && i < changes.size(); ++i)
          if (std::fabs(leg.end().tension[i] - plan.before.tension[i]) > 1e-9 * goal_.target[i])
            changes[i] = 1;
      }
    jacking_->go_to(start_);
    bool any = false;
    for (std::size_t i = 0; i < changes.size(); ++i) any = any || (goal_.matters(i) && changes[i] != 0);
    for (std::size_t i = 0; any && i < changes.size(); ++i) {
      if (!goal_.matters(i) || changes[i] != 0) continue;
      plan.unmoved.push_back(i);
      goal_.target[i] = 0;
    }
  }

  void find_bound(Plan& plan) const {
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
      const FrictionBound bound = friction_bound(chain_of(scene_, goal_, condensed_.rho, c));
      if (bound.error <= plan.bound.error) continue;
      plan.bound = bound;
      plan.bound_cable = c;
    }
  }

  bool is_one_jack() const { return groups_.size() == 1 && groups_[0].jacks.size() == 1; }

  // Pulls and releases of one jack on a grid, each pair with the best pull that can follow: one leg shows all
  // of those. The best few are where more moves begin.
  void add_triples(const Course& course, double width, std::vector<CoursePlan>& starts) {
    const std::size_t jack = groups_[0].jacks[0], moves = open_forces(course.shape());
    const int grid = scene_.second_order ? 16 : 32;
    struct Triple {
      double up, back, again, error;
    };
    std::vector<Triple> found;
    const auto force = [&](int k) {
      return std::min(jacks_[jack].most_force, width * (0.5 + 0.65 * k / grid));
    };
    const auto stage = [&](double pull) {
      PlanStage at = jacking_->beginning();
      at.force[jack] = pull;
      return at;
    };
    jacking_->go_to(start_);
    for (int up = 1; up <= grid && jacking_->jump(stage(force(up))).whole; ++up) {
      const std::string pulled = jacking_->state();
      Triple best{0, 0, 0, 1e300};
      for (int back = up - 1; back >= 0 && jacking_->jump(stage(force(back))).whole; --back) {
        const std::string released = jacking_->state();
        const Leg leg = jacking_->follow(stage(force(up)));
        for (std::size_t k = 1; k < leg.points.size(); ++k) {
          const LegPoint &from = leg.points[k - 1], &to = leg.points[k];
          const NearestPart nearest = nearest_part(from.tension, to.tension, goal_.target);
          if (nearest.error >= best.error) continue;
          const double part = from.part + nearest.part * (to.part - from.part);
          best = {force(up), force(back), force(back) + part * (force(up) - force(back)), nearest.error};
        }
        jacking_->go_to(released);
      }
      jacking_->go_to(pulled);
      if (best.error < 1e300) found.push_back(best);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Triple& a, const Triple& b) { return a.error < b.error; });
    for (std::size_t n = 0; n < most_descents && n < found.size(); ++n) {
      std::vector<double> all(moves, found[n].again);
      all[0] = found[n].up;
      all[1] = found[n].back;
      starts.push_back({std::move(all), {}});
    }
  }

  // From a jack that pulls already: releases on a grid, each with the best of all pulls that can follow, and
  // downhill from the best few.
  Found back_and_up() {
    const std::size_t jack = groups_[0].jacks[0];
    const PlanStage beginning = jacking_->beginning();
    const double pulled = beginning.force[jack];
    const int grid = scene_.second_order ? 12 : 48;
    const auto stage = [&](double force) {
      PlanStage at = beginning;
      at.force[jack] = force;
      return at;
    };
    struct Pair {
      double back, again, error;
    };
    std::vector<Pair> pairs;
    jacking_->go_to(start_);
    for (int i = grid - 1; i >= 0 && pulled > 0; --i) {
      const double back = pulled * i / grid;
      if (!jacking_->jump(stage(back)).whole) break;
      const std::string released = jacking_->state();
      const Leg leg = jacking_->follow(stage(pulled));
      Pair best{back, 0, 1e300};
      for (std::size_t k = 1; k < leg.points.size(); ++k) {
        const LegPoint &from = leg.points[k - 1], &to = leg.points[k];
        const NearestPart nearest = nearest_part(from.tension, to.tension, goal_.target);
        if (nearest.error >= best.error) continue;
        best.again = back + (from.part + nearest.part * (to.part - from.part)) * (pulled - back);
        best.error = nearest.error;
      }
      jacking_->go_to(released);
      if (best.error < 1e300) pairs.push_back(best);
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.error < b.error; });
    Found best;
    best.shape = shape_at_once(groups_, 2, goal_.lock);
    Course course(*jacking_, goal_, best.shape, start_, least_ratio_);
    for (std::size_t n = 0; n < most_descents / 2 && n < pairs.size(); ++n) {
      CoursePlan found =
          descend(course, goal_, {pairs[n].back, pairs[n].again}, pulled / grid, moves_short / 5);
      if (n == 0 || found.outcome.merit() < best.plan.outcome.merit()) best.plan = std::move(found);
    }
    return best.plan.force.empty() ? Found() : best;
  }

  // The whole of what one jack can do in two moves.
  Found one_jack() {
    const std::size_t jack = groups_[0].jacks[0];
    const double seating = goal_.lock ? scene_.cables[groups_[0].cable].seating : 0;
    Found best;
    const auto take = [&](const UpAndBack& found, const std::vector<double>& force) {
      if (!found.found) return;
      Found other;
      other.shape = shape_at_once(groups_, force.size(), goal_.lock);
      Course course(*jacking_, goal_, other.shape, start_, least_ratio_);
      other.plan = {force, course.at(force)};
      // A lock-off may show what a release does not.
      other.is_closed = found.is_closed() && std::fabs(other.plan.outcome.merit() - found.error) <= as_good;
      take_better(best, std::move(other));
    };
    if (!goal_.lock && jacking_->loads_are_on()) {
      const UpAndBack pull = best_pull(*jacking_, goal_, jack, start_);
      take(pull, {pull.up});
    }
    if (is_on_the_way_) {
      const UpAndBack release = best_release(*jacking_, goal_, jack, seating, start_);
      take(release, {release.back});
      if (stages_ >= 2) take_better(best, back_and_up());
    }
    if (stages_ >= 2) {
      const UpAndBack both = best_up_and_back(*jacking_, goal_, jack, seating, condensed_.rigid ? 1 : 2,
                                              start_, moves_up_and_back);
      Found before = best;
      take(both, {both.up, both.back});
      // A pull alone is one of the two, let out by nothing.
      if (before.merit() <= both.error + as_good && both.is_closed()) best.is_closed = true;
    }
    is_settled_ = best.is_closed;
    // Only with rigid saddles is the steepness proved.
    best.is_closed = best.is_closed && (condensed_.rigid || (stages_ == 1 && !goal_.lock));
    return best;
  }

  // What the whole of it did not settle within its moves, as in second-order theory, whose pieces do not
  // quite meet.
  void polish(Found& best) {
    Course course(*jacking_, goal_, best.shape, start_, least_ratio_);
    CoursePlan plan = descend(course, goal_, best.plan.force, best.plan.force[0] / 50, moves_polish);
    if (plan.outcome.merit() < best.plan.outcome.merit()) best.plan = std::move(plan);
  }

  // What comes of a plan from where the jacks stand, on the structure as it is known now.
  Found from_here(CourseShape shape, const std::vector<double>& force) {
    Found found;
    found.shape = std::move(shape);
    Course course(*jacking_, goal_, found.shape, start_, least_ratio_);
    found.plan = {force, course.at(force)};
    return found;
  }

  std::vector<CourseShape> shapes() const {
    std::vector<CourseShape> all;
    if (past_ != nullptr && groups_.size() > 1) {
      all.push_back(past_->rest);
    } else if (groups_.size() == 1 || stages_ < groups_.size()) {
      all.push_back(shape_at_once(groups_, stages_, goal_.lock));
    } else {
      all.push_back(shape_in_turn(groups_, stages_, goal_.lock, false));
      if (!goal_.lock && stages_ > groups_.size())
        all.push_back(shape_in_turn(groups_, stages_, goal_.lock, true));
    }
    return all;
  }

  // Forces for the moves of every jack, by friction between rigid saddles.
  std::vector<double> teeth_of(const CourseShape& shape, std::size_t fewer) const {
    std::vector<std::vector<double>> moves(jacks_.size());
    for (const Group& group : groups_) {
      std::size_t count = 0;
      for (const CourseStep& step : shape)
        if (!step.locks &&
            std::find(step.jacks.begin(), step.jacks.end(), group.jacks[0]) != step.jacks.end())
          ++count;
      const CableDescription& cable = scene_.cables[group.cable];
      const JackMoves teeth =
          nearest_teeth(chain_of(scene_, goal_, condensed_.rho, group.cable),
                        {cable.is_jacked(0), cable.is_jacked(1)}, count > fewer ? count - fewer : 1);
      for (const std::size_t k : group.jacks) moves[k] = teeth[jacks_[k].end];
    }
    std::vector<std::size_t> next(jacks_.size(), 0);
    std::vector<double> force;
    for (const CourseStep& step : shape) {
      if (step.locks) continue;
      for (const std::size_t k : step.jacks) {
        const std::vector<double>& of = moves[k];
        const double value = of.empty() ? usual_force(k) : of[std::min(next[k]++, of.size() - 1)];
        force.push_back(std::min(value, jacks_[k].most_force));
      }
    }
    return force;
  }
  // The target next to a jack.
  double usual_force(std::size_t k) const {
    const std::size_t c = jacks_[k].cable, first = scene_.first_segment(c), n = scene_.cables[c].segments();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t segment = first + (jacks_[k].end == 0 ? i : n - 1 - i);
      if (goal_.matters(segment)) return goal_.target[segment];
    }
    return *std::max_element(goal_.target.begin(), goal_.target.end());
  }

  Found search(const CourseShape& shape, const Found& known) {
    Course course(*jacking_, goal_, shape, start_, least_ratio_);
    std::vector<CoursePlan> starts;
    const auto add = [&](std::vector<double> force) {
      course.bring_together(force);
      bring_within_limits(course, force);
      CourseOutcome outcome = course.at(force);
      starts.push_back({std::move(force), std::move(outcome)});
    };
    double width = 0;
    for (std::size_t fewer = 0; fewer < 3 && fewer < shape.size(); ++fewer) add(teeth_of(shape, fewer));
    for (std::size_t k = 0; k < starts[0].force.size(); ++k)
      width = std::max({width, starts[0].force[k], usual_force(course.jack_of(k))});
    if (!known.shape.empty()) add(extended(known, course));
    if (is_one_jack() && !goal_.lock && open_forces(shape) >= 3) {
      std::vector<CoursePlan> triples;
      add_triples(course, width, triples);
      for (CoursePlan& triple : triples) add(std::move(triple.force));
    }
    // Plans that fill what is possible evenly, by the sequence of the generalized golden ratio.
    const std::size_t count = starts[0].force.size();
    double ratio = 2;
    for (int round = 0; round < 30; ++round)
      ratio = std::pow(1 + ratio, 1 / (1 + static_cast<double>(count)));
    for (std::size_t n = 0; n < samples; ++n) {
      std::vector<double> force, at;
      for (std::size_t k = 0; k < count; ++k) {
        const double turns = 0.5 + static_cast<double>(n) * std::pow(ratio, -1 - static_cast<double>(k));
        at.push_back(turns - std::floor(turns));
        // The second of two jacks within what friction lets it differ.
        const double least = k > 0 ? course.least_ratio(k - 1) : 0;
        force.push_back(
            std::min(course.most(k), least > 0 ? force[k - 1] * std::pow(std::max(least, 0.7), 1 - 2 * at[k])
                                               : width * (0.5 + 0.7 * at[k])));
      }
      add(std::move(force));
    }
    // Beyond the targets at the jacks by more and more, and back to them.
    for (const double beyond : {1.02, 1.05, 1.1, 1.2, 1.35}) {
      std::vector<double> force;
      std::vector<std::size_t> left(jacks_.size(), 0);
      for (std::size_t k = 0; k < count; ++k) ++left[course.jack_of(k)];
      for (std::size_t k = 0; k < count; ++k)
        force.push_back(std::min(
            course.most(k), usual_force(course.jack_of(k)) * (--left[course.jack_of(k)] > 0 ? beyond : 1)));
      add(std::move(force));
    }
    std::stable_sort(starts.begin(), starts.end(), [](const CoursePlan& a, const CoursePlan& b) {
      return a.outcome.merit() < b.outcome.merit();
    });
    Found best;
    best.shape = shape;
    best.plan = starts[0];
    // Where no jack could be moved at all there is no way down.
    if (!jacking_->has_moved()) return best;
    // A move takes ten times as long in second-order theory.
    const std::size_t scale = scene_.second_order ? 5 : 1;
    const auto go_down = [&](const std::vector<double>& force, double from, std::size_t most_legs) {
      CoursePlan found = descend(course, goal_, force, from, most_legs);
      if (found.outcome.merit() < best.plan.outcome.merit()) best.plan = std::move(found);
    };
    for (std::size_t n = 0; n < most_descents && n < starts.size(); ++n)
      go_down(starts[n].force, width / 5, moves_short * shape.size() / scale);
    go_down(best.plan.force, width / 20, moves_long * shape.size() / scale);
    return best;
  }

  // The forces of a plan with fewer moves, the last of each jack repeated.
  std::vector<double> extended(const Found& known, const Course& course) const {
    std::vector<std::vector<double>> moves(jacks_.size());
    std::size_t next = 0;
    for (const CourseStep& step : known.shape)
      for (const std::size_t k : step.jacks)
        if (!step.locks) moves[k].push_back(known.plan.force[next++]);
    std::vector<std::size_t> taken(jacks_.size(), 0);
    std::vector<double> force;
    for (std::size_t n = 0; n < open_forces(course.shape()); ++n) {
      const std::size_t k = course.jack_of(n);
      force.push_back(moves[k].empty() ? usual_force(k)
                                       : moves[k][std::min(taken[k]++, moves[k].size() - 1)]);
    }
    return force;
  }

  static void bring_within_limits(Course& course, std::vector<double>& force) {
    const CourseOutcome outcome = course.at(force);
    if (outcome.whole && !(outcome.excess > 0)) return;
    double inside = 0, outside = 1;
    std::vector<double> scaled = force;
    for (int round = 0; round < 12; ++round) {
      const double part = (inside + outside) / 2;
      for (std::size_t k = 0; k < force.size(); ++k) scaled[k] = part * force[k];
      const CourseOutcome at = course.at(scaled);
      (at.whole && !(at.excess > 0) ? inside : outside) = part;
    }
    for (double& each : force) each *= inside;
  }

  // No jack goes further than it has to: turning points come nearer to those before and after.
  void be_gentle(Found& best) {
    Course course(*jacking_, goal_, best.shape, start_, least_ratio_);
    const double enough = best.merit() + as_good / 10;
    for (std::size_t n = 0; n < best.plan.force.size(); ++n) {
      // The force that the jack comes from, and the one that it goes to next.
      double before = jacking_->beginning().force[course.jack_of(n)], after = -1;
      for (std::size_t k = 0; k < best.plan.force.size(); ++k) {
        if (course.jack_of(k) != course.jack_of(n)) continue;
        if (k < n) before = best.plan.force[k];
        if (k > n && after < 0) after = best.plan.force[k];
      }
      const double force = best.plan.force[n];
      if (after < 0 || (force - before) * (after - force) >= 0) continue;
      const double nearest = force > before ? std::max(before, after) : std::min(before, after);
      CoursePlan plan = best.plan;
      const auto is_enough = [&](double part) {
        plan.force[n] = force + part * (nearest - force);
        plan.outcome = course.at(plan.force);
        if (!(plan.outcome.merit() <= enough)) return false;
        best.plan = plan;
        return true;
      };
      if (!is_enough(1e-4)) continue;
      double good = 1e-4, bad = 1;
      for (int round = 0; round < 8; ++round) {
        const double part = (good + bad) / 2;
        (is_enough(part) ? good : bad) = part;
      }
    }
  }

  // What does nothing is not asked of anybody.
  void drop_idle_moves(Found& best) {
    for (std::size_t s = best.shape.size(); s-- > 0;) {
      if (best.shape[s].locks || best.shape.size() == 1) continue;
      Found other = best;
      std::size_t before = 0;
      for (std::size_t k = 0; k < s; ++k) before += best.shape[k].locks ? 0 : best.shape[k].jacks.size();
      const auto from = other.plan.force.begin() + static_cast<std::ptrdiff_t>(before);
      other.plan.force.erase(from, from + static_cast<std::ptrdiff_t>(best.shape[s].jacks.size()));
      other.shape.erase(other.shape.begin() + static_cast<std::ptrdiff_t>(s));
      if (open_forces(other.shape) == 0) continue;
      Course course(*jacking_, goal_, other.shape, start_, least_ratio_);
      other.plan.outcome = course.at(other.plan.force);
      if (other.merit() <= best.merit() + as_good) best = std::move(other);
    }
  }

  const SceneDescription& scene_;
  PlanGoal goal_;  // but for find_bound() without the targets that no jack has anything to do with
  std::vector<double> full_target_;
  const PlanPast* past_;  // null: jacks are at rest
  CondensedArrays condensed_;
  std::vector<PlanJack> jacks_;
  std::unique_ptr<Jacking> jacking_;
  std::vector<Group> groups_;
  std::string start_;
  std::vector<double> least_ratio_;  // of two jacks of a cable
  std::size_t stages_ = 0;
  bool is_on_the_way_ = false;  // the past has been jacked
  bool is_settled_ = false;     // all that one jack can do in the moves was looked at
};

}  // namespace

Plan find_plan(const SceneDescription& scene, const PlanGoal& goal, const GiveUp& give_up) {
  Plan plan = PlanSearch(scene, goal, give_up).find();
  if (!plan.status() || plan.outcome.merit() <= far_off || !has_limits(goal)) return plan;
  PlanGoal free = goal;
  free.most_segment.assign(goal.most_segment.size(), no_limit);
  free.most_force.assign(goal.most_force.size(), {no_limit, no_limit});
  free.most_stroke = free.most_force;
  plan.without_limits = PlanSearch(scene, free, give_up).find().outcome.merit();
  plan.limits_stop_it = plan.without_limits < plan.outcome.merit() - 1e-6;
  return plan;
}

Plan find_rest_of_plan(const SceneDescription& scene, const PlanGoal& goal, const PlanPast& past,
                       const GiveUp& give_up) {
  return PlanSearch(scene, goal, give_up, &past).find();
}

UsualJacking usual_jacking(const SceneDescription& scene, const PlanGoal& goal, double excess) {
  UsualJacking usual;
  const CondensedArrays condensed = condense(scene, ScalarType::float64);
  const std::vector<PlanJack> jacks = plan_jacks(scene, goal, condensed.most_force);
  Jacking jacking(scene, goal, jacks);
  if (!condensed.condensing.status || !jacking.begin()) return usual;
  const std::vector<Group> groups = groups_of(scene, goal, jacks);
  const std::size_t moves = excess > 0 ? 2 : 1;
  const CourseShape shape = shape_in_turn(groups, moves * groups.size(), goal.lock, false);
  std::vector<double> force;
  for (const Group& group : groups)
    for (std::size_t m = 0; m < moves; ++m)
      for (const std::size_t k : group.jacks) {
        const std::size_t first = scene.first_segment(group.cable), n = scene.cables[group.cable].segments();
        double target = 0;
        for (std::size_t i = 0; i < n && target == 0; ++i)
          target = goal.target[first + (jacks[k].end == 0 ? i : n - 1 - i)];
        force.push_back(m + 1 < moves ? (1 + excess) * target : target);
      }
  Course course(jacking, goal, shape, jacking.state(), least_ratios(scene, condensed.rho));
  usual.stages = stages_of(shape, force, jacking.beginning());
  usual.outcome = course.at(force);
  return usual;
}

}  // namespace taut::host
