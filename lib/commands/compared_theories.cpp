#include "lib/commands/compared_theories.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <utility>

#include "lib/files/deserved_digits.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/condensed_arrays.hpp"
#include "lib/kinds/make_model.hpp"

namespace taut::host {
namespace {

// A row, and what it is called.
using StepVisitor = std::function<bool(const LogRow&, const std::string& place)>;

// The largest difference of one kind of values, and their largest size.
struct Gap {
  double difference = 0, largest = 0;

  void take(const std::vector<double>& linear, const std::vector<double>& second) {
    for (std::size_t i = 0; i < second.size(); ++i) {
      difference = std::max(difference, std::fabs(linear[i] - second[i]));
      largest = std::max(largest, std::fabs(second[i]));
    }
  }
  std::optional<double> part() const {
    if (!(largest > 0)) return std::nullopt;
    return difference / largest;
  }
};

// Readings are taken for the forces themselves.
void make_possible(LogRow& row) {
  for (auto& cable : row.cables)
    for (EndRow& end : cable) end.force = std::max(0.0, end.force);
}

// What is possible in a log is what linear theory says, if it can be asked.
LogRules rules_for(const SceneDescription& linear) {
  LogRules rules;
  rules.are_readings = true;
  const CondensedArrays condensed = condense(linear, ScalarType::float64);
  rules.most_factor = condensed.most_factor;
  rules.most_force = condensed.most_force;
  return rules;
}

void each_row(const std::string& log_path, const SceneDescription& scene, const LogRules& rules,
              const StepVisitor& visit) {
  std::ifstream stream = open_log(log_path);
  LogReader log(stream, log_path, scene, rules);
  LogRow row = log.first_row();
  while (log.next(row)) {
    LogRow possible = row;
    make_possible(possible);
    const std::string place = log_path + ": line " + std::to_string(row.line) + " (row " +
                              std::to_string(row.row) + ", time " + plain(row.time) + " s)";
    if (!visit(possible, place)) return;
  }
}

// The way to the target in steps in which a difference shows.
void each_step(const SceneDescription& scene, const TargetDescription& target, const StepVisitor& visit) {
  constexpr int steps = 20;
  LogRow row;
  row.factor.resize(scene.loads.size());
  row.cables.resize(scene.cables.size());
  for (int step = 1; step <= steps; ++step) {
    const double part = static_cast<double>(step) / steps;
    for (std::size_t i = 0; i < row.factor.size(); ++i) row.factor[i] = part * target.factor[i];
    for (std::size_t c = 0; c < row.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) row.cables[c][end].force = part * target.force[c][end];
    if (!visit(row, "at " + std::to_string(100 * step / steps) + " % of the target")) return;
  }
}

TargetDescription empty_target(const SceneDescription& scene) {
  return {std::vector<double>(scene.loads.size()), std::vector<std::array<double, 2>>(scene.cables.size())};
}

// The row with the largest strains by jacks, else with the largest factors; of what has a jack, only rows in
// which one is at work: a target takes no locked end. What is locked beside it keeps its force.
TargetDescription largest_load(const SceneDescription& scene, const std::string& log_path,
                               const LogRules& rules) {
  TargetDescription largest = empty_target(scene), now = largest;
  double most_force = 0, most_factor = 0;
  each_row(log_path, scene, rules, [&](const LogRow& row, const std::string&) {
    now.factor = row.factor;
    double force = 0, factor = 0;
    bool has_jack = false, works = false;
    for (std::size_t c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        if (!scene.cables[c].is_jacked(end)) continue;
        has_jack = true;
        works = works || !row.cables[c][end].locked;
        if (!row.cables[c][end].locked) now.force[c][end] = row.cables[c][end].force;
        force += now.force[c][end] / (scene.cables[c].E * scene.cables[c].A);
      }
    for (const double each : row.factor) factor += std::fabs(each);
    if (has_jack && !works) return true;
    if (force > most_force || (force >= most_force && factor > most_factor)) {
      most_force = force;
      most_factor = factor;
      largest = now;
    }
    return true;
  });
  return largest;
}

// Rows between which something goes on by more than a fiftieth of the most it ever is: readings scatter, and
// friction remembers every reversal. The last row is one of them, and every lock-off.
class Steps {
 public:
  Steps(const SceneDescription& scene, const std::string& log_path, const LogRules& rules) {
    each_row(log_path, scene, rules, [&](const LogRow& row, const std::string&) {
      const std::vector<double> now = values(row);
      most_.resize(now.size());
      for (std::size_t i = 0; i < now.size(); ++i) most_[i] = std::max(most_[i], std::fabs(now[i]));
      last_ = row.row;
      return true;
    });
    before_.resize(most_.size());
  }

  bool counts(const LogRow& row) {
    constexpr double least = 0.02;
    const std::vector<double> now = values(row);
    bool any = row.row == last_;
    for (std::size_t i = 0; i < now.size(); ++i)
      any = any || std::fabs(now[i] - before_[i]) > least * most_[i];
    if (any) before_ = now;
    return any;
  }

 private:
  static std::vector<double> values(const LogRow& row) {
    std::vector<double> all = row.factor;
    for (const auto& cable : row.cables)
      for (const EndRow& end : cable) {
        all.push_back(end.force);
        all.push_back(end.locked ? 1 : 0);
      }
    return all;
  }

  std::vector<double> most_, before_;
  std::size_t last_ = 0;
};

std::string loads_of(const SceneDescription& scene, const TargetDescription& load) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  std::array<char, 32> digits{};
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    if (load.factor[i] == 0) continue;
    std::snprintf(digits.data(), digits.size(), "%.4g", load.factor[i]);
    add(scene.loads[i].name + " " + digits.data());
  }
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      if (!scene.cables[c].is_jacked(end)) continue;
      std::snprintf(digits.data(), digits.size(), "%.4g N", load.force[c][end]);
      add(scene.cables[c].name + "." + end_name(end) + " " + digits.data());
    }
  return text;
}

// Without any there is no geometric stiffness.
bool has_load(const SceneDescription& scene, const TargetDescription& target) {
  const auto is_any = [](double number) { return number != 0; };
  for (const CableDescription& cable : scene.cables)
    if (std::any_of(cable.prestrain.begin(), cable.prestrain.end(), is_any)) return true;
  for (const auto& force : target.force)
    if (std::any_of(force.begin(), force.end(), is_any)) return true;
  return std::any_of(target.factor.begin(), target.factor.end(), is_any);
}

// One theory on its way.
class Theory {
 public:
  explicit Theory(const SceneDescription& scene) : scene_(scene), before_(empty_target(scene)) {
    model_ = make_model(scene_, Method::tracker, ScalarType::float64);
    if (const Followed start = model_->start(1); !start.whole()) end_ = {start, "before any load", ""};
  }

  bool goes_on() const { return !end_; }
  const std::optional<TheoryEnd>& end() const { return end_; }
  const Answer& answer() {
    model_->read(answer_);
    return answer_;
  }
  void advance(const LogRow& row, const std::string& place) {
    if (end_) return;
    const Followed path = model_->advance(row, 1);
    TargetDescription now = before_;
    for (std::size_t i = 0; i < now.factor.size(); ++i)
      now.factor[i] += path.fraction * (row.factor[i] - now.factor[i]);
    for (std::size_t c = 0; c < now.force.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (!row.cables[c][end].locked)
          now.force[c][end] += path.fraction * (row.cables[c][end].force - now.force[c][end]);
    if (!path.whole()) end_ = {path, place, loads_of(scene_, now)};
    before_ = std::move(now);
  }

 private:
  const SceneDescription& scene_;
  TargetDescription before_;  // where the path has come to
  std::unique_ptr<Model> model_;
  Answer answer_;
  std::optional<TheoryEnd> end_;
};

std::vector<double> extensions_of(const Answer& answer) {
  std::vector<double> all;
  for (const auto& ends : answer.extension) all.insert(all.end(), ends.begin(), ends.end());
  return all;
}

}  // namespace

ComparedTheories compare_theories(const SceneDescription& scene, const std::string& log_path) {
  SceneDescription linear_scene = scene, second_scene = scene;
  linear_scene.second_order.reset();
  const LogRules rules = log_path.empty() ? LogRules() : rules_for(linear_scene);
  if (!log_path.empty()) check_log(log_path, scene, rules);
  if (!second_scene.second_order)
    second_scene.second_order = log_path.empty() ? empty_target(scene) : largest_load(scene, log_path, rules);

  ComparedTheories compared;
  compared.target = *second_scene.second_order;
  if (!has_load(scene, compared.target)) return compared;
  std::optional<Theory> begun;
  try {
    begun.emplace(second_scene);
  } catch (const InputError&) {
    if (scene.second_order) throw;  // else nobody asked for a theory that no tension begins
    return compared;
  }
  compared.begins = true;
  Theory linear(linear_scene);
  Theory& second = *begun;
  Gap segments, struts, extensions;
  const auto take = [&] {
    if (!linear.goes_on() || !second.goes_on()) return;
    compared.shown = true;
    const Answer &of_linear = linear.answer(), &of_second = second.answer();
    segments.take(of_linear.tension, of_second.tension);
    struts.take(of_linear.strut, of_second.strut);
    extensions.take(extensions_of(of_linear), extensions_of(of_second));
  };
  take();
  const auto visit = [&](const LogRow& row, const std::string& place) {
    linear.advance(row, place);
    second.advance(row, place);
    take();
    return linear.goes_on() || second.goes_on();
  };
  if (!log_path.empty()) {
    Steps steps(scene, log_path, rules);
    each_row(log_path, scene, rules, [&](const LogRow& row, const std::string& place) {
      return !steps.counts(row) || visit(row, place);
    });
  }
  if (log_path.empty() && scene.second_order) each_step(scene, compared.target, visit);
  compared.segments = segments.part();
  compared.struts = struts.part();
  compared.extensions = extensions.part();
  compared.linear = linear.end();
  compared.second = second.end();
  return compared;
}

std::string second_order_key(const SceneDescription& scene, const TargetDescription& target) {
  constexpr int target_digits = 5;  // more say nothing
  std::string loads, forces;
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    if (target.factor[i] != 0)
      loads += (loads.empty() ? " " : ", ") + quote(scene.loads[i].name) + ": " +
               plain(rounded(target.factor[i], target_digits));
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (target.force[c][end] > 0)
        forces += (forces.empty() ? " " : ", ") + quote(scene.cables[c].name + "." + end_name(end)) + ": " +
                  plain(rounded(target.force[c][end], target_digits));
  const auto object = [](const std::string& entries) {
    return entries.empty() ? "{}" : "{" + entries + " }";
  };
  return "\"second_order\": { \"target\": { \"loads\": " + object(loads) + ", \"forces\": " + object(forces) +
         " } }";
}

}  // namespace taut::host
