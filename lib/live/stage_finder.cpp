#include "lib/live/stage_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut::host {
namespace {

// A jack has turned when it has come back by so many tolerances.
constexpr double turned = 2;

bool has(const CourseStep& step, std::size_t jack) {
  return std::find(step.jacks.begin(), step.jacks.end(), jack) != step.jacks.end();
}

}  // namespace

StageFinder::StageFinder(CourseShape shape, std::vector<PlanStage> stages, PlanStage first,
                         std::vector<double> tolerance)
    : shape_(std::move(shape)), stages_(std::move(stages)), tolerance_(std::move(tolerance)) {
  const std::size_t jacks = tolerance_.size();
  memory_.extreme = memory_.still_at = first.force;
  memory_.begin = std::move(first);
  memory_.reached.assign(jacks, 0);
  memory_.still_since.assign(jacks, 0);
  memory_.skipped.assign(stages_.size(), 0);
}

int StageFinder::direction(std::size_t jack) const {
  if (is_over()) return 0;
  const double way = stages_[memory_.stage].force[jack] - memory_.begin.force[jack];
  if (std::fabs(way) <= tolerance_[jack]) return 0;
  return way > 0 ? 1 : -1;
}

bool StageFinder::is_reached() const {
  if (is_over() || shape_[memory_.stage].locks) return false;
  const std::vector<std::size_t>& jacks = shape_[memory_.stage].jacks;
  return std::all_of(jacks.begin(), jacks.end(), [this](std::size_t k) { return is_reached(k); });
}

void StageFinder::take(double time, const PlanStage& now) {
  // Every round leaves a stage behind.
  while (!is_over()) {
    look(time, now);
    if (is_passed(time, now)) {
      go_to(memory_.stage + 1, time, now);
      continue;
    }
    const std::size_t other = skipped_to(now);
    if (other == memory_.stage) return;
    for (std::size_t s = memory_.stage; s < other; ++s) memory_.skipped[s] = 1;
    if (is_reached()) memory_.skipped[memory_.stage] = 0;
    go_to(other, time, now);
  }
}

void StageFinder::look(double time, const PlanStage& now) {
  if (shape_[memory_.stage].locks) return;
  for (const std::size_t k : shape_[memory_.stage].jacks) {
    const int way = direction(k);
    const double force = now.force[k];
    if (way * (force - memory_.extreme[k]) > 0) memory_.extreme[k] = force;
    const bool is_there = way * (force - stages_[memory_.stage].force[k]) >= -tolerance_[k];
    if (is_there && memory_.reached[k] == 0) {
      memory_.reached[k] = 1;
      memory_.still_at[k] = force;
      memory_.still_since[k] = time;
    }
    if (way * (force - memory_.still_at[k]) > tolerance_[k] / 2) {
      memory_.still_at[k] = force;
      memory_.still_since[k] = time;
    }
  }
}

bool StageFinder::is_passed(double time, const PlanStage& now) const {
  const CourseStep& step = shape_[memory_.stage];
  if (step.locks)
    return std::all_of(step.jacks.begin(), step.jacks.end(),
                       [&](std::size_t k) { return now.locked[k] != 0; });
  if (!is_reached()) return false;
  bool stand = true, one_turned = false;
  for (const std::size_t k : step.jacks) {
    const int way = direction(k);
    stand = stand && (way == 0 || time - memory_.still_since[k] >= hold);
    one_turned = one_turned || way * (memory_.extreme[k] - now.force[k]) > turned * tolerance_[k];
  }
  return stand || one_turned;
}

std::size_t StageFinder::skipped_to(const PlanStage& now) const {
  const std::size_t present = memory_.stage;
  for (std::size_t s = present + 1; s < stages_.size(); ++s) {
    const CourseStep& later = shape_[s];
    for (const std::size_t k : later.jacks) {
      if (later.locks) {
        if (now.locked[k] != 0 && memory_.begin.locked[k] == 0) return s;
        continue;
      }
      bool is_first = true;
      for (std::size_t before = present; before < s; ++before) is_first = is_first && !has(shape_[before], k);
      const double begin = memory_.begin.force[k], way = stages_[s].force[k] - begin;
      if (is_first) {
        if (std::fabs(way) > tolerance_[k] && (now.force[k] - begin) / way > 0.5) return s;
        continue;
      }
      if (s != present + 1 || shape_[present].locks || !has(shape_[present], k)) continue;
      const double to = stages_[present].force[k], next = stages_[s].force[k], most = memory_.extreme[k];
      const int direct = direction(k);
      if (direct * (to - next) > 0 && direct * (most - next) >= direct * (to - next) / 4 &&
          direct * (most - now.force[k]) > turned * tolerance_[k] &&
          direct * (next - now.force[k]) >= -tolerance_[k])
        return s;
    }
  }
  return present;
}

void StageFinder::go_to(std::size_t stage, double time, const PlanStage& now) {
  if (!shape_[memory_.stage].locks)
    for (const std::size_t k : shape_[memory_.stage].jacks) memory_.begin.force[k] = memory_.extreme[k];
  memory_.begin.locked = now.locked;
  memory_.stage = stage;
  memory_.extreme = memory_.begin.force;
  memory_.reached.assign(memory_.reached.size(), 0);
  memory_.still_at = now.force;
  memory_.still_since.assign(memory_.still_since.size(), time);
}

}  // namespace taut::host
