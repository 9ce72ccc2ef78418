#include "large_displacements/estimated.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>

#include <nlohmann/json.hpp>

#include "files/run_program.hpp"
#include "large_displacements/comparison.hpp"
#include "large_displacements/path.hpp"

namespace large_displacements {
namespace {

/// Five rows for one as long as the jack is at work.
std::vector<Row> more_rows(const Jacking& jacking, bool ramp_alone) {
  std::vector<Row> rows;
  Row before;
  before.factors.assign(jacking.model.loads.size(), 0);
  before.jacks.assign(jacking.model.cables.size(), {});
  for (const Row& row : jacking.rows) {
    const auto &to = row.jacks[0][1], &from = before.jacks[0][1];
    if (ramp_alone && (to.locked || to.force < from.force)) break;
    for (int k = to.locked ? 5 : 1; k <= 5; ++k) {
      Row part = row;
      const auto between = [&](double a, double b) { return a + (b - a) * k / 5; };
      part.time = between(before.time, row.time);
      for (std::size_t i = 0; i < row.factors.size(); ++i)
        part.factors[i] = between(before.factors[i], row.factors[i]);
      if (!to.locked) part.jacks[0][1].force = between(from.force, to.force);
      rows.push_back(part);
    }
    before = row;
  }
  return rows;
}

/// The number of the first row that a remark is about, or that the program did not come to, counted from one.
std::size_t first_row_named(const std::string& said, std::size_t none) {
  std::size_t first = none;
  for (std::size_t at = said.find("(row "); at != std::string::npos; at = said.find("(row ", at + 1))
    first = std::min<std::size_t>(first, std::stoul(said.substr(at + 5)));
  return first;
}

Outcome run(const Scratch& scratch, const std::string& taut, const std::string& command) {
  return run_program(scratch, taut,
                     command + " " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv") + " -o " +
                         scratch.quoted("found.csv"));
}

}  // namespace

std::optional<Estimated> estimate(const Jacking& jacking, const Known& known, const std::string& taut) {
  const Model& model = jacking.model;
  const Cable& cable = model.cables[0];
  auto rows = more_rows(jacking, known.ramp_alone);
  Path path(model);
  if (!path.started) return std::nullopt;
  Estimated found;
  for (const Row& row : rows) {
    if (!path.advance(row)) break;
    found.truth.emplace_back();
    for (int i = 0; i < cable.segments(); ++i) found.truth.back().push_back(path.T(0, i));
  }
  const Scratch scratch;
  write_scene(model, jacking.target, (scratch.path / "scene.json").string());
  write_log(model, rows, (scratch.path / "log.csv").string());
  const std::size_t stands = found.truth.size(),
                    named = first_row_named(run(scratch, taut, "simulate").err, rows.size() + 1),
                    last = std::min(stands < rows.size() ? stands - std::min<std::size_t>(stands, 1) : stands,
                                    named < 2 ? 0 : named - 2);
  if (last < 20) return std::nullopt;
  rows.resize(last);
  found.truth.resize(last);
  found.rows = last;
  for (const Row& row : rows) found.full = std::max(found.full, row.jacks[0][1].force);

  auto scene = nlohmann::json::parse(scene_text(model, jacking.target));
  auto& friction = scene["cables"][0]["friction"];
  const double mu = known.mu * std::accumulate(cable.mu.begin(), cable.mu.end(), 0.0) /
                    static_cast<double>(cable.mu.size());
  friction["mu"] = mu;
  friction["mu_sd"] = known.mu_sd * mu;
  friction["shared"] = true;
  if (known.scatter > 0) friction["scatter"] = known.scatter;
  const double sd = known.noise * found.full;
  const nlohmann::json cell = {{"sd", sd}, {"gain_sd", 0}, {"zero_sd", 0}, {"resolution", 0}};
  const std::string end = cable.name + ".end", start = cable.name + ".start";
  scene["sensors"][end] = cell;
  if (known.has_far_end) scene["sensors"][start] = cell;
  std::ofstream(scratch.path / "scene.json") << scene.dump();
  std::ofstream log(scratch.path / "log.csv");
  log.precision(9);
  log << "time," << end << "," << end << ".locked";
  if (known.has_far_end) log << "," << start;
  for (const Load& load : model.loads) log << "," << load.name;
  log << "\n";
  std::mt19937_64 generator(known.seed);
  std::normal_distribution<double> noise(0, sd);
  for (std::size_t r = 0; r < last; ++r) {
    const auto& jack = rows[r].jacks[0][1];
    log << rows[r].time << ",";
    if (!jack.locked) log << std::max(0.0, jack.force + noise(generator));
    log << "," << jack.locked;
    if (known.has_far_end) log << "," << found.truth[r][0] + noise(generator);
    for (const double factor : rows[r].factors) log << "," << factor;
    log << "\n";
  }
  log.close();
  const Outcome outcome = run(scratch, taut, "estimate");
  found.status = outcome.status;
  found.said = outcome.err;
  const Table columns = table_of(text_of(scratch.path / "found.csv"));
  if (columns.count(cable.name + ".T1") == 0) return found;
  const auto number = [&](const std::string& column, std::size_t row) {
    return std::stod(columns.at(cable.name + column)[row]);
  };
  const std::size_t answered = columns.at(cable.name + ".T1").size();
  found.force.assign(answered, {});
  found.sd.assign(answered, {});
  for (int i = 1; i <= cable.segments(); ++i)
    for (std::size_t r = 0; r < answered; ++r) {
      found.force[r].push_back(number(".T" + std::to_string(i), r));
      found.sd[r].push_back(number(".sd" + std::to_string(i), r));
    }
  found.mu = number(".mu1", answered - 1);
  found.mu_sd = number(".mu_sd1", answered - 1);
  return found;
}

void Summary::add(const Estimated& one) {
  ++jackings;
  unanswered += one.force.size() < one.rows ? 1 : 0;
  for (std::size_t r = 0; r < one.force.size(); ++r)
    for (std::size_t i = 0; i < one.force[r].size(); ++i) {
      const double truth = one.truth[r][i], off = one.force[r][i] - truth, sd = one.sd[r][i];
      if (truth < 0.01 * one.full) continue;
      ++count;
      held += std::fabs(off) <= 1.96 * sd ? 1 : 0;
      off_squared += off / one.full * (off / one.full);
      share_squared += off / sd * (off / sd);
    }
}

}  // namespace large_displacements
