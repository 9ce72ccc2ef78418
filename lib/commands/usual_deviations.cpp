#include "lib/commands/usual_deviations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lib/commands/reading_scatter.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/capacities.hpp"
#include "lib/report/number_text.hpp"
#include "taut/estimation/jump_guard.hpp"
#include "taut/estimation/load_filter.hpp"
#include "taut/estimation/noise_level.hpp"

namespace taut::host {
namespace {

constexpr double usual_mu_sd = 0.5, usual_gain_sd = 0.01, usual_hysteresis_sd = 0.01, least_noise = 1e-4,
                 expected_noise = 1e-3, usual_noise_of_stage = 3e-3, usual_stroke_sd = 1e-3;
// Of a tendon when it is tensioned, and of a strut.
constexpr double usual_strain = 0.005, usual_strain_of_strut = 0.001;

std::string digits(double number) { return trimmed(significant(number, 3)); }

/// What a gauge is called in a log, and what is known of it.
struct GaugeColumn {
  std::string name;
  InstrumentDescription* instrument;
  bool of_strut;
  std::size_t cable, index;
};

std::vector<GaugeColumn> gauges_of(const LogReader& log, SceneDescription& scene) {
  std::vector<GaugeColumn> gauges;
  const auto add = [&](const std::string& name, InstrumentDescription& instrument, bool of_strut,
                       std::size_t cable, std::size_t index) {
    const bool is_known = instrument.sd && instrument.gain_sd && instrument.zero_sd;
    if (log.has(name) && !is_known) gauges.push_back({name, &instrument, of_strut, cable, index});
  };
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t i = 0; i < scene.cables[c].segments(); ++i)
      add(scene.cables[c].name + ".T" + std::to_string(i + 1), scene.cables[c].force[i], false, c, i);
  for (std::size_t i = 0; i < scene.struts.size(); ++i)
    add("strut" + std::to_string(i + 1), scene.struts[i].gauge, true, 0, i);
  return gauges;
}

// A gauge that the scene says nothing of, or not all, is an ordinary one.
void take_gauges(const std::vector<GaugeColumn>& gauges, std::vector<ReadingScatter>& columns,
                 std::vector<Sentence>& remarks) {
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    InstrumentDescription& instrument = *gauges[g].instrument;
    if (columns[g].largest() == 0) continue;
    instrument.is_given = true;
    if (!instrument.sd) instrument.sd = std::max(least_noise * columns[g].largest(), columns[g].scatter());
    if (!instrument.gain_sd) instrument.gain_sd = usual_gain_sd;
    if (!instrument.zero_sd) instrument.zero_sd = usual_zero_sd * columns[g].largest();
    remarks.push_back(Sentence(
        "the scene does not say all of the gauge {1} in \"sensors\": \"sd\" {2} N, \"gain_sd\" {3} and "
        "\"zero_sd\" {4} N are taken",
        {quote(gauges[g].name), digits(*instrument.sd), digits(*instrument.gain_sd),
         digits(*instrument.zero_sd)}));
  }
}

void fill_in_gauges(const std::string& path, const LogRules& rules, SceneDescription& scene,
                    std::vector<Sentence>& remarks) {
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  const std::vector<GaugeColumn> gauges = gauges_of(log, scene);
  if (gauges.empty()) return;
  std::vector<ReadingScatter> columns(gauges.size());
  LogRow row = log.first_row();
  while (log.next(row))
    for (const MeasuredForce& force : row.forces)
      for (std::size_t g = 0; g < gauges.size(); ++g)
        if (gauges[g].of_strut == force.of_strut && gauges[g].cable == force.cable &&
            gauges[g].index == force.index)
          columns[g].add(force.reading);
  take_gauges(gauges, columns, remarks);
}

void expect_gauges(const LogReader& log, SceneDescription& scene, std::vector<Sentence>& remarks) {
  const std::vector<GaugeColumn> gauges = gauges_of(log, scene);
  std::vector<ReadingScatter> columns(gauges.size());
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const StrutDescription* const strut = gauges[g].of_strut ? &scene.struts[gauges[g].index] : nullptr;
    const CableDescription* const cable = strut != nullptr ? nullptr : &scene.cables[gauges[g].cable];
    const double largest =
        strut != nullptr ? usual_strain_of_strut * strut->E * strut->A : usual_strain * cable->E * cable->A;
    columns[g].expect(largest, expected_noise * largest);
  }
  take_gauges(gauges, columns, remarks);
}

void fill_in_strokes(const LogReader& log, SceneDescription& scene, std::vector<Sentence>& remarks) {
  for (CableDescription& cable : scene.cables)
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string column = cable.name + "." + end_name(end) + ".stroke";
      InstrumentDescription& stroke = cable.stroke[end];
      if (!cable.is_jacked(end) || stroke.is_given || !log.has(column)) continue;
      stroke.is_given = stroke.is_assumed = stroke.has_free_zero = true;
      stroke.sd = usual_stroke_sd;
      remarks.push_back(Sentence(
          "the stroke {1} is not in \"sensors\": \"sd\" 0.001 m and a free zero are taken", {quote(column)}));
    }
}

// What the readings of a load cell say of it, which are taken twice: first as they are, then with their
// scatter known. The noise level begins low and needs some hundred rows to come up; the scatter needs few,
// but takes noise with a memory for less than it is. Load stages tell neither.
struct CellReadings {
  static constexpr std::size_t enough = 14;  // for a median

  double largest = 0;
  ReadingScatter scatter;
  NoiseLevel<double> noise;
  double time = 0;
  long count = 0;

  // Nothing but the size that its readings may come to is known.
  void expect(double expected) {
    largest = expected;
    noise.start(expected_noise * expected);
  }
  bool tells_noise() const { return scatter.on_lines() >= enough; }
  double sd() const {
    if (tells_noise()) return std::max(noise.sd(), scatter.scatter());
    return count > 0 ? std::max(noise.sd(), usual_noise_of_stage * largest) : noise.sd();
  }
  void look(double reading, double at) {
    largest = std::max(largest, std::fabs(reading));
    if (count > 0 && JumpGuard<double>::is_stage(at - time)) scatter.interrupt();
    scatter.add(reading);
    time = at;
    ++count;
  }
  // From the least that is taken on: a level that begins with a first reading near zero does not come up to
  // the noise of a thousand rows.
  void begin() {
    const double least = least_noise * largest;
    noise.start(least);
    path_.start(std::max(least, scatter.scatter()));
    time = 0;
  }
  // A corner of the path is no noise.
  void take(double reading, double at) {
    const int run_length = path_.run_length();
    const bool is_refused = path_.take(reading, at - time).refused;
    if (path_.run_length() < run_length) noise.bend();
    if (!is_refused) noise.take(reading, at - time);
    time = at;
  }

 private:
  LoadFilter<double> path_;
};

using CellTable = std::vector<std::array<CellReadings, 2>>;

// Whether the scene says all of the cells that the log reads.
bool is_all_said(const LogReader& log, const SceneDescription& scene) {
  for (const CableDescription& cable : scene.cables)
    for (std::size_t end = 0; end < 2; ++end) {
      const InstrumentDescription& cell = cable.cell[end];
      const bool is_said = cell.exact || (cell.sd && cell.gain_sd && cell.zero_sd);
      if (!is_said && log.has(cable.name + "." + end_name(end))) return false;
    }
  return true;
}

// Shows every possible reading of a cell to `visit`.
template <class Visit>
void for_each_reading(const std::string& path, const SceneDescription& scene, const LogRules& rules,
                      CellTable& cells, const Visit& visit) {
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  LogRow row = log.first_row();
  while (log.next(row))
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (const auto& reading = row.cables[c][end].reading; reading && rules.is_possible_force(c, *reading))
          visit(cells[c][end], *reading, row.time);
}

// Without readings if nothing is missing, so that a long log is not read twice more.
CellTable read_cells(const std::string& path, const SceneDescription& scene, const LogRules& rules) {
  CellTable cells(scene.cables.size());
  std::ifstream stream = open_log(path);
  if (is_all_said(LogReader(stream, path, scene, rules), scene)) return cells;
  for_each_reading(path, scene, rules, cells,
                   [](CellReadings& cell, double reading, double time) { cell.look(reading, time); });
  for (auto& cable : cells)
    for (CellReadings& cell : cable) cell.begin();
  for_each_reading(path, scene, rules, cells,
                   [](CellReadings& cell, double reading, double time) { cell.take(reading, time); });
  return cells;
}

Sentence listed(const Sentence& list, const Sentence& next) {
  return list.empty() ? next : Sentence("{1}, {2}", {list, next});
}

// What is taken for the parts of an instrument that the scene does not say; with its gain and zero only if
// they may be unknown.
Sentence fill_in(const CellReadings& readings, bool has_constants, InstrumentDescription& instrument) {
  Sentence taken;
  const auto take = [&](std::optional<double>& value, double usual, const Sentence& what) {
    if (value) return;
    value = usual;
    taken = listed(taken, what);
  };
  const double noise = std::max(readings.sd(), least_noise * readings.largest),
               zero = usual_zero_sd * readings.largest;
  take(instrument.sd, noise,
       Sentence(readings.tells_noise() ? "sd {1} N as its readings scatter" : "sd {1} N", {digits(noise)}));
  if (!has_constants) return taken;
  take(instrument.gain_sd, usual_gain_sd, Sentence("gain_sd {1}", {digits(usual_gain_sd)}));
  take(instrument.zero_sd, zero, Sentence("zero_sd {1} N", {digits(zero)}));
  return taken;
}

// How many cells are read at ends with a jack, or without.
int count_cells(const CellTable& cells, const SceneDescription& scene, bool at_jacks) {
  int count = 0;
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (cells[c][end].largest > 0 && scene.cables[c].is_jacked(end) == at_jacks) ++count;
  return count;
}

// Cells without readings are none.
void fill_in_cells(const CellTable& cells, SceneDescription& scene, std::vector<Sentence>& remarks) {
  const int at_jacks = count_cells(cells, scene, true), others = count_cells(cells, scene, false);
  if (std::max(at_jacks, others) > most_unknown_cells)
    remarks.push_back(
        Sentence("more than {1} load cells: gain and zero that the scene does not say are taken for exact",
                 {std::to_string(most_unknown_cells)}));
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    CableDescription& cable = scene.cables[c];
    for (std::size_t end = 0; end < 2; ++end) {
      InstrumentDescription& cell = cable.cell[end];
      if (cell.exact || cells[c][end].largest == 0) continue;
      const bool has_constants = (cable.is_jacked(end) ? at_jacks : others) <= most_unknown_cells;
      Sentence taken = fill_in(cells[c][end], has_constants, cell);
      // What has a table is the gauge of a ram's pressure.
      const bool has_ram = !cell.is_given || (!cell.calibration.empty() && !cell.has_hysteresis);
      if (cable.is_jacked(end) && has_ram && has_constants) {
        cell.part_sd = usual_hysteresis_sd;
        taken = listed(taken, Sentence("hysteresis sd {1}", {digits(usual_hysteresis_sd)}));
      }
      if (!taken.empty())
        remarks.push_back(Sentence(
            "the load cell {1} is taken for an ordinary one in what \"sensors\" does not say of it: {2}",
            {quote(cable.name + "." + end_name(end)), taken}));
    }
  }
}

}  // namespace

double usual_noise(const CableDescription& cable) {
  return expected_noise * usual_strain * cable.E * cable.A;
}

std::vector<Sentence> fill_in_mu_deviations(SceneDescription& scene) {
  std::vector<Sentence> remarks;
  for (CableDescription& cable : scene.cables) {
    if (cable.has_mu_sd || cable.joints() == 0) continue;
    double sum = 0;
    for (const double mu : cable.mu) sum += mu;
    cable.mu_sd = usual_mu_sd * sum / static_cast<double>(cable.joints());
    if (cable.mu_sd > 0)
      remarks.push_back(
          Sentence("cable {1} has no \"mu_sd\": half of mu, {2}, is taken for its standard deviation",
                   {quote(cable.name), digits(cable.mu_sd)}));
  }
  return remarks;
}

std::vector<Sentence> fill_in_jacks(SceneDescription& scene) {
  std::vector<Sentence> remarks;
  CellTable cells(scene.cables.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (scene.cables[c].is_jacked(end))
        cells[c][end].largest = usual_strain * scene.cables[c].E * scene.cables[c].A;
  fill_in_cells(cells, scene, remarks);
  return remarks;
}

std::vector<Sentence> fill_in_deviations(const std::string& path, const LogRules& rules,
                                         SceneDescription& scene) {
  std::vector<Sentence> remarks = fill_in_mu_deviations(scene);
  fill_in_gauges(path, rules, scene, remarks);
  std::ifstream stream = open_log(path);
  fill_in_strokes(LogReader(stream, path, scene, rules), scene, remarks);
  fill_in_cells(read_cells(path, scene, rules), scene, remarks);
  return remarks;
}

std::vector<Sentence> fill_in_deviations(const LogReader& log, SceneDescription& scene) {
  std::vector<Sentence> remarks = fill_in_mu_deviations(scene);
  expect_gauges(log, scene, remarks);
  fill_in_strokes(log, scene, remarks);
  CellTable cells(scene.cables.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (const CableDescription& cable = scene.cables[c]; log.has(cable.name + "." + end_name(end)))
        cells[c][end].expect(usual_strain * cable.E * cable.A);
  fill_in_cells(cells, scene, remarks);
  return remarks;
}

}  // namespace taut::host
