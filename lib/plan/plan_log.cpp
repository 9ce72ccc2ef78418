#include "lib/plan/plan_log.hpp"

#include <sstream>

#include "lib/files/log_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/make_model.hpp"

namespace taut::host {
namespace {

constexpr int seconds_a_stage = 60;

}  // namespace

double reading_of(const InstrumentDescription& gauge, double force) {
  const auto& table = gauge.calibration;
  if (table.size() < 2) return force;
  std::size_t i = 1;
  while (i + 1 < table.size() && force > table[i][1]) ++i;
  const auto &from = table[i - 1], &to = table[i];
  return from[0] + (force - from[1]) * (to[0] - from[0]) / (to[1] - from[1]);
}

double gauge_shows(const InstrumentDescription& gauge, double force, bool pulls) {
  double branch = pulls ? 1 + gauge.part : 1 - gauge.part;
  if (gauge.right_while_it_pulls) branch = pulls ? 1 : 1 - 2 * gauge.part;
  return reading_of(gauge, branch * force);
}

std::string plan_log(const SceneDescription& scene, const PlanGoal& goal, const Plan& plan) {
  std::string text = "time";
  for (const LoadDescription& load : scene.loads) text += "," + load.name;
  for (const PlanJack& jack : plan.jacks) text += "," + jack.name;
  if (goal.lock)
    for (const PlanJack& jack : plan.jacks) text += "," + jack.name + ".locked";
  text += "\n";
  int row = 0;
  const auto add = [&](const PlanStage& stage) {
    text += std::to_string(seconds_a_stage * row++);
    for (const double factor : goal.factor) text += "," + plain(factor);
    for (std::size_t k = 0; k < plan.jacks.size(); ++k)
      text +=
          "," + plain(reading_of(scene.cables[plan.jacks[k].cable].cell[plan.jacks[k].end], stage.force[k]));
    if (goal.lock)
      for (const char locked : stage.locked) text += locked != 0 ? ",1" : ",0";
    text += "\n";
  };
  if (plan.loads_come_first)
    add({std::vector<double>(plan.jacks.size(), 0), std::vector<char>(plan.jacks.size(), 0)});
  for (const PlanStage& stage : plan.stages) add(stage);
  return text;
}

SimulatedPlan simulate(const std::string& log, const SceneDescription& scene) {
  SimulatedPlan simulated;
  std::istringstream stream(log);
  LogReader reader(stream, "the log of the plan", scene);
  const auto model = make_model(scene, Method::tracker, ScalarType::float64);
  const auto stop = [&](const Followed& path) {
    simulated.stopped = path.status ? "too many events" : failure_text(path.status, scene).english();
    return simulated;
  };
  if (const Followed start = model->start(1); !start.whole()) return stop(start);
  LogRow row = reader.first_row();
  while (reader.next(row)) {
    if (const Followed path = model->advance(row, 1); !path.whole()) return stop(path);
    simulated.time.push_back(row.time);
    simulated.answers.emplace_back();
    model->read(simulated.answers.back());
  }
  return simulated;
}

}  // namespace taut::host
