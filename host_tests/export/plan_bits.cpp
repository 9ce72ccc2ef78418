// What c_plan_test.c does, in C++: settings are the same. -DSCENE= exported header, -DSPACE= its namespace.
#include <cstdio>
#include <type_traits>

#include "put_bits.h"
#include "taut/device.hpp"

#include SCENE

namespace scene = ::SPACE;
using Model = std::decay_t<decltype(scene::condensed<float>)>;
using Estimator = taut::Estimator<Model, scene::unknowns, scene::reading_unknowns>;
using Planner = taut::JackPlanner<Estimator::TrackerType>;

static Estimator estimator;
static Planner planner;
static Estimator::ReadingsType readings;

static void put(float value) {
  std::putchar(' ');
  put_bits(value);
}

static bool read_row(float force) {
  readings.dt = 1;
  auto& [start, end] = readings.ends[0];
  end.has_force = true;
  end.force = force;
  start.has_force = force > 0;
  start.force = 0.8f * force;
  readings.sample.jack[0][1].force = force;
  return estimator.advance(readings).status.ok();
}

static bool look(const Planner::Goal& goal) {
  if (!planner.begin(estimator, goal, 0, 1)) return false;
  for (int events = 0; events < EVENTS && !planner.step(5); events += 5)
    if (!read_row(readings.ends[0][1].force)) return false;
  const auto& best = planner.best();
  std::printf("%d", best.count);
  put(best.force[0]);
  put(best.force[1]);
  put(best.error);
  for (int i = 0; i < taut::linear_part(scene::condensed<float>).segments; ++i) put(best.tension[i]);
  std::putchar('\n');
  return true;
}

int main() {
  if (!estimator.start(scene::condensed<float>, scene::prior<float>).status) return 1;
  if constexpr (scene::Capacity::loads > 0) readings.sample.factor[0] = 1;
  Planner::Goal goal;
  for (int i = 0; i < 4; ++i) goal.target[i] = TARGET;
  goal.worth_a_move = 0;
  if (!read_row(0) || !look(goal)) return 1;
  for (int i = 1; i <= 10; ++i)
    if (!read_row(PULL * 0.1f * static_cast<float>(i))) return 1;
  if (!look(goal)) return 1;
  goal.lock = true;
  goal.most_force = 0.95f * PULL;
  goal.worth_a_move = 0.001f;
  return look(goal) ? 0 : 1;
}
