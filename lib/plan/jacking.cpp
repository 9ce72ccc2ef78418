#include "lib/plan/jacking.hpp"

#include <algorithm>
#include <utility>

#include "lib/files/plausible_scene.hpp"

namespace taut::host {
namespace {

// Of a leg; no scene needs nearly as many.
constexpr int most_events = 100000;
// Events in the same place.
constexpr int most_stalls = 64;
// Steps in a row that bring next to nothing, as where jacks balance what nothing else holds: such a path has
// no rates, and every step is looked for anew.
constexpr int most_crawls = 1024;
constexpr double crawl = 1e-5;
// Of a cable by what its structure hangs through without it, of its length: twice what a strand stretches.
constexpr double most_slack = 0.01;

}  // namespace

std::vector<PlanJack> plan_jacks(const SceneDescription& scene, const PlanGoal& goal,
                                 const std::vector<double>& most_possible) {
  // A log may hold what is given as its limit, and a limit may not fail by a rounding.
  constexpr double within_reach = 1 - 1e-12;
  std::vector<PlanJack> jacks;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const CableDescription& cable = scene.cables[c];
    double most = within_reach * most_possible[c];
    if (scene.plausible) most = std::min(most, within_reach * largest_plausible_strain * cable.E * cable.A);
    for (std::size_t end = 0; end < 2; ++end)
      if (cable.is_jacked(end))
        jacks.push_back({c, end, std::min(most, goal.most_force[c][end]), goal.most_stroke[c][end],
                         cable.name + "." + end_name(end)});
  }
  return jacks;
}

Jacking::Jacking(const SceneDescription& scene, const PlanGoal& goal, std::vector<PlanJack> jacks,
                 GiveUp give_up)
    : scene_(scene),
      goal_(goal),
      jacks_(std::move(jacks)),
      give_up_(std::move(give_up)),
      model_(make_leg_model(scene)),
      beginning_(at_rest()) {}

bool Jacking::begin() {
  if (const Followed start = model_->start(1); !start.whole()) {
    why_ = start.status;
    return false;
  }
  const std::string before = state();
  const Followed loaded = model_->advance(row_of(at_rest(), goal_.factor), 1);
  loads_come_first_ = loaded.whole() && !hangs_too_low();
  loads_are_on_ = loads_come_first_;
  if (!loads_come_first_) go_to(before);
  return true;
}

// With slack cables, in second-order theory: linear theory has no such limit.
bool Jacking::hangs_too_low() const {
  if (!scene_.second_order) return false;
  const LegPoint loaded = here();
  for (std::size_t k = 0; k < jacks_.size(); ++k)
    if (-loaded.stroke[k] > most_slack * length_of(scene_.cables[jacks_[k].cable], scene_)) return true;
  return false;
}

bool Jacking::begin_after(const std::vector<PastMove>& past) {
  const Followed start = model_->start(1);
  why_ = start.status;
  bool whole = start.whole();
  for (std::size_t i = 0; i < past.size() && start.whole(); ++i) {
    count();
    const std::string before = state();
    const Followed path = model_->advance(row_of(past[i].stage, past[i].factor), 1);
    whole = path.whole();
    why_ = path.status;
    if (!whole) {
      go_to(before);
      continue;
    }
    beginning_ = past[i].stage;
    loads_are_on_ = past[i].factor == goal_.factor;
  }
  return whole;
}

void Jacking::count() {
  if (give_up_ && give_up_()) throw GivenUp();
  ++legs_;
}

LogRow Jacking::row_of(const PlanStage& stage, const std::vector<double>& factor) const {
  LogRow row;
  row.factor = factor;
  row.cables.resize(scene_.cables.size());
  for (std::size_t k = 0; k < jacks_.size(); ++k) {
    EndRow& end = row.cables[jacks_[k].cable][jacks_[k].end];
    end.force = stage.force[k];
    end.locked = stage.locked[k] != 0;
  }
  return row;
}

LegPoint Jacking::here() const {
  Answer answer;
  model_->read_cables(answer);
  LegPoint point;
  point.tension = std::move(answer.tension);
  point.state = std::move(answer.state);
  for (const PlanJack& jack : jacks_) point.stroke.push_back(answer.extension[jack.cable][jack.end]);
  return point;
}

Leg Jacking::follow(const PlanStage& stage, std::vector<std::string>* seen) {
  count();
  const LogRow row = row_of(stage, goal_.factor);
  Leg leg;
  leg.points.push_back(here());
  if (seen != nullptr) seen->push_back(state());
  double rest = 1;
  int stalls = 0, crawls = 0;
  for (int event = 0; event < most_events && stalls < most_stalls && crawls < most_crawls; ++event) {
    const Followed step = model_->advance_to_event(row);
    stalls = step.fraction > 0 ? 0 : stalls + 1;
    crawls = step.fraction > crawl ? 0 : crawls + 1;
    rest *= 1 - step.fraction;
    leg.whole = step.whole();
    if (step.fraction > 0 || leg.whole) {
      leg.points.push_back(here());
      leg.points.back().part = leg.whole ? 1 : 1 - rest;
      if (seen != nullptr) seen->push_back(state());
    }
    if (!step.status && failure_.status) failure_ = {step.status, stage, 1 - rest};
    if (leg.whole || !step.status) break;
  }
  has_moved_ = has_moved_ || (leg.whole && stage.force != beginning_.force);
  return leg;
}

Leg Jacking::jump(const PlanStage& stage) {
  count();
  Leg leg;
  leg.whole = model_->advance(row_of(stage, goal_.factor), 1).whole();
  leg.points.push_back(here());
  leg.points.back().part = 1;
  return leg;
}

}  // namespace taut::host
