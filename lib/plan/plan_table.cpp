#include "lib/plan/plan_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

using Cells = std::vector<std::string>;

// Twelve digits, without an exponent where there is room for a plain number.
std::string digits(double number) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.12g", number);
  const double size = std::fabs(number);
  if (std::strchr(text.data(), 'e') != nullptr && size >= 1 && size < 1e15)
    std::snprintf(text.data(), text.size(), "%.0f", number);
  return text.data();
}

std::string aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const Cells& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string text;
  for (const Cells& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += (k == 0 ? "" : ", ") + std::string(width[k] - row[k].size(), ' ') + row[k];
    text += "\n";
  }
  return text;
}

}  // namespace

int stage_of_row(const Plan& plan, std::size_t row) {
  return static_cast<int>(row) - (plan.loads_come_first ? 1 : 0);
}

std::string stage_name(const Plan& plan, std::size_t row) {
  const int stage = stage_of_row(plan, row);
  if (stage < 0) return "loads";
  if (plan.shape[static_cast<std::size_t>(stage)].locks) return "lock";
  int number = 0;
  for (int s = 0; s <= stage; ++s) number += plan.shape[static_cast<std::size_t>(s)].locks ? 0 : 1;
  return std::to_string(number);
}

std::string plan_table(const SceneDescription& scene, const PlanGoal& goal, const PlanResult& result) {
  const Plan& plan = result.plan;
  std::string text = "# Plan for " + quote(scene.name) + " to the goal " + goal.file + "\n";
  for (const std::string& said : plan_sentences(scene, goal, result)) text += "# " + said + "\n";
  std::vector<Cells> rows(1);
  rows[0] = {"stage", "time [s]"};
  for (const PlanJack& jack : plan.jacks) rows[0].push_back(jack.name + " [N]");
  for (const PlanJack& jack : plan.jacks) {
    rows[0].push_back(jack.name + ".stroke [m]");
    if (!result.prior) continue;
    rows[0].push_back(jack.name + ".stroke.low [m]");
    rows[0].push_back(jack.name + ".stroke.high [m]");
  }
  for (const CableDescription& cable : scene.cables)
    for (std::size_t i = 0; i < cable.segments(); ++i)
      rows[0].push_back(cable.name + ".T" + std::to_string(i + 1) + " [N]");
  for (std::size_t row = 0; row < result.simulated.answers.size(); ++row) {
    const Answer& answer = result.simulated.answers[row];
    const int stage = stage_of_row(plan, row);
    Cells cells = {stage_name(plan, row), plain(result.simulated.time[row])};
    for (std::size_t k = 0; k < plan.jacks.size(); ++k) {
      const bool locked = stage >= 0 && plan.stages[static_cast<std::size_t>(stage)].locked[k] != 0;
      cells.push_back(locked ? "locked"
                             : digits(stage < 0 ? 0 : plan.stages[static_cast<std::size_t>(stage)].force[k]));
    }
    for (std::size_t k = 0; k < plan.jacks.size(); ++k) {
      const double stroke = answer.extension[plan.jacks[k].cable][plan.jacks[k].end];
      cells.push_back(digits(stroke));
      if (!result.prior) continue;
      const bool has_band = stage >= 0 && !result.prior->stroke.empty();
      for (std::size_t side = 0; side < 2; ++side)
        cells.push_back(has_band ? digits(result.prior->stroke[static_cast<std::size_t>(stage)][k][side])
                                 : digits(stroke));
    }
    for (const double force : answer.tension) cells.push_back(digits(force));
    rows.push_back(std::move(cells));
  }
  return text + aligned(rows);
}

}  // namespace taut::host
