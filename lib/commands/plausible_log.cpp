#include "lib/commands/plausible_log.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/files/deserved_digits.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/plausible_scene.hpp"
#include "lib/files/text.hpp"
#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr double part_of_length = 0.1, clear_of_noise = 20;
// Until a cable is strained as in a first stage, most of a sound log is still to come.
constexpr double part_in_first_stage = 0.5, part_of_largest = 0.1;
constexpr double least_growth = 0.005, most_times_stretch = 100;  // [m], [-]
constexpr std::size_t least_strokes = 3, least_readings = 3;

std::string column_of(const CableDescription& cable, std::size_t end) {
  return cable.name + "." + end_name(end);
}

// A table has the unit of its gauge already.
std::string unit_remedy(const CableDescription& cable, std::size_t end, const std::string& unit) {
  if (!cable.cell[end].calibration.empty()) return "look at the \"calibration\" of this column in the scene";
  return "write the unit of the column after its name, as in " + column_of(cable, end) + " [" + unit + "]";
}

bool is_plausible(double force, const CableDescription& cable) {
  return std::fabs(force) <= largest_plausible_strain * cable.E * cable.A;
}

// The jack of a cable with a far end; two or none have no such end.
std::optional<std::size_t> only_jack(const CableDescription& cable) {
  if (cable.is_jacked(0) == cable.is_jacked(1)) return std::nullopt;
  return static_cast<std::size_t>(cable.is_jacked(0) ? 0 : 1);
}

Sentence clock_text(double gap, const std::string& late, const std::string& other) {
  return Sentence(
      "{1} is read {2} s later than {3}, and that is taken off: let the clocks of loggers agree; "
      "if an amplifier averages, write \"lag\": {2} for it",
      {quote(late), plain(rounded(gap, 3)), quote(other)});
}

[[noreturn]] void refuse(const std::string& file, const std::string& place, const std::string& problem,
                         const std::string& remedy) {
  throw InputError(file, place, problem, remedy + remedy_if_meant);
}

}  // namespace

double PlausibleLog::Jack::pull() const {
  const bool is_clear = within.largest() > clear_of_noise * within.scatter() || within.goes_somewhere();
  return within.readings() >= least_readings && is_clear ? within.largest() : 0;
}

PlausibleLog::PlausibleLog(const SceneDescription& scene) : scene_(scene), cables_(scene.cables.size()) {}

void PlausibleLog::take(const LogRow& row) {
  if (!scene_.plausible) return;
  for (std::size_t c = 0; c < cables_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const CableDescription& cable = scene_.cables[c];
      const EndRow& given = row.cables[c][end];
      if (given.stroke) {
        auto& strokes = cables_[c].stroke[end];
        strokes.add({*given.stroke, row.line, given.reading.value_or(std::nan(""))});
        cables_[c].is_read_under_load |= *given.stroke != strokes.kept().front().at;
      }
      if (cable.is_jacked(end))
        cables_[c].doubts[end].take(row, given, first_stage_strain * cable.E * cable.A, cable.seating > 0);
      if (!given.reading) continue;
      // Behind a wedge the cell of a jack reads whatever is left there.
      if (!given.locked) cables_[c].unit[end].take(*given.reading, row.line);
      if (!cable.is_jacked(end)) {
        cables_[c].is_read_under_load |= *given.reading > 0;
        continue;
      }
      Jack& jack = cables_[c].jack[end];
      if (is_plausible(*given.reading, cable)) {
        jack.within.add(*given.reading);
      } else if (jack.beyond++ == 0) {
        jack.line = row.line;
        jack.force = *given.reading;
      }
    }
  for (std::size_t c = 0; c < cables_.size(); ++c)
    if (const auto jack = only_jack(scene_.cables[c])) {
      const auto read = [&](std::size_t end) {
        const auto& reading = row.cables[c][end].reading;
        return reading && is_plausible(*reading, scene_.cables[c]) ? *reading : std::nan("");
      };
      cables_[c].clock.take(row.time, read(*jack), read(1 - *jack), row.cables[c][*jack].locked);
    }
  for (const MeasuredForce& force : row.forces)
    if (!force.of_strut) cables_[force.cable].is_read_under_load |= force.reading > 0;
}

void PlausibleLog::require(const LogReader& log, const std::string& path, bool has_past) const {
  if (!scene_.plausible) return;
  require_units_of_jacks(log, path);
  for (std::size_t c = 0; c < cables_.size(); ++c) {
    for (std::size_t end = 0; end < 2; ++end) {
      require_one_unit(c, end, log, path);
      if (!scene_.cables[c].is_jacked(end)) continue;
      require_strokes(c, end, log, path);
      require_stretch(c, end, log, path);
    }
    if (!has_past) require_column(c, log, path);
    require_deviations(c);
  }
}

std::vector<Sentence> PlausibleLog::doubts() const {
  std::vector<Sentence> doubts;
  for (std::size_t c = 0; c < cables_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const CableDescription& cable = scene_.cables[c];
      const auto of_end = cables_[c].doubts[end].sentences(column_of(cable, end), cable.cell[end]);
      doubts.insert(doubts.end(), of_end.begin(), of_end.end());
    }
  return doubts;
}

std::vector<LateFarEnd> PlausibleLog::late_far_ends() const {
  std::vector<LateFarEnd> ends;
  for (std::size_t c = 0; c < cables_.size(); ++c) {
    const CableDescription& cable = scene_.cables[c];
    const auto jack = only_jack(cable);
    if (!jack) continue;
    const double gap = cables_[c].clock.found();
    const std::size_t far_end = 1 - *jack, late = gap > 0 ? far_end : *jack;
    if (gap == 0 || cable.cell[late].lag >= std::fabs(gap) / 2) continue;
    ends.push_back(
        {c, far_end, gap, clock_text(std::fabs(gap), column_of(cable, late), column_of(cable, 1 - late))});
  }
  return ends;
}

void PlausibleLog::require_units_of_jacks(const LogReader& log, const std::string& path) const {
  double largest_strain = 0, pull = 0;
  std::size_t readings = 0, first_cable = 0, first_end = 0;
  for (std::size_t c = 0; c < cables_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const Jack& jack = cables_[c].jack[end];
      const CableDescription& cable = scene_.cables[c];
      if (jack.readings() == 0) continue;
      if (readings == 0) {
        first_cable = c;
        first_end = end;
      }
      readings += jack.readings();
      pull = std::max(pull, jack.pull());
      largest_strain = std::max(largest_strain, jack.within.largest() / (cable.E * cable.A));
      if (2 * jack.beyond > jack.readings())
        refuse(path, log.place(jack.line, column_of(cable, end)),
               "the jack force " + plain(jack.force) + ", as most here, strains cable " + quote(cable.name) +
                   " by more than 2 %",
               unit_remedy(cable, end, "N"));
    }
  if (pull == 0 || largest_strain >= least_plausible_strain) return;
  const CableDescription& cable = scene_.cables[first_cable];
  refuse(path, log.place(log.header_line(), column_of(cable, first_end)),
         "no jack strains its cable by as much as 1e-5 in the whole log",
         unit_remedy(cable, first_end, "kN") +
             (log.takes_decimal_commas() ? ", or leave out commas that stand for thousands" : ""));
}

void PlausibleLog::require_one_unit(std::size_t c, std::size_t end, const LogReader& log,
                                    const std::string& path) const {
  const UnitStep& step = cables_[c].unit[end];
  if (!step.is_found()) return;
  refuse(path, log.place(step.line(), column_of(scene_.cables[c], end)),
         "from one row to the next the force goes from " + plain(step.before()) + " to " +
             plain(step.after()) + " N, and stays there",
         "write all rows in one unit" +
             std::string(log.takes_decimal_commas() ? ", without points that stand for thousands" : ""));
}

void PlausibleLog::require_strokes(std::size_t c, std::size_t end, const LogReader& log,
                                   const std::string& path) const {
  const CableDescription& cable = scene_.cables[c];
  const double most = part_of_length * length_of(cable, scene_);
  std::vector<Stroke> sorted = cables_[c].stroke[end].kept();
  if (sorted.size() < least_strokes) return;
  std::sort(sorted.begin(), sorted.end(), [](const Stroke& a, const Stroke& b) { return a.at < b.at; });
  const std::size_t tenth = (sorted.size() - 1) / 10;
  const Stroke &least = sorted[tenth], &largest = sorted[sorted.size() - 1 - tenth];
  if (!(largest.at - least.at > most)) return;
  const std::string column = column_of(cable, end) + ".stroke";
  refuse(path, log.place(largest.line, column),
         "strokes go from " + plain(least.at) + " to " + plain(largest.at) +
             " m, over more than a tenth of cable " + quote(cable.name),
         "write the unit of the column after its name, as in " + column + " [mm]");
}

// Between half of the largest force and all of it slack is out, whatever the friction.
void PlausibleLog::require_stretch(std::size_t c, std::size_t end, const LogReader& log,
                                   const std::string& path) const {
  const CableDescription& cable = scene_.cables[c];
  const double pull = cables_[c].jack[end].pull();
  std::vector<Stroke> high;
  for (const Stroke& stroke : cables_[c].stroke[end].kept())
    if (stroke.force >= pull / 2) high.push_back(stroke);
  if (pull == 0 || high.size() < least_strokes) return;
  std::sort(high.begin(), high.end(), [](const Stroke& a, const Stroke& b) { return a.force < b.force; });
  // Single wrong readings do not count.
  const auto median = [](std::vector<Stroke>::const_iterator from, std::vector<Stroke>::const_iterator to) {
    std::vector<double> at;
    for (; from != to; ++from) at.push_back(from->at);
    std::nth_element(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(at.size() / 2), at.end());
    return at[at.size() / 2];
  };
  const auto third = static_cast<std::ptrdiff_t>(high.size() / 3);
  const double grown = median(high.end() - third, high.end()) - median(high.begin(), high.begin() + third);
  const double further = (high.end() - 1 - third / 2)->force - (high.begin() + third / 2)->force;
  const double stretch = further * length_of(cable, scene_) / (cable.E * cable.A);
  if (!(further > pull / 10) || !(grown > least_growth) || !(grown > most_times_stretch * stretch)) return;
  const std::string column = column_of(cable, end);
  refuse(path, log.place(log.header_line(), column),
         "between half of its largest force and all of it the stroke of " + column + " grows by " +
             trimmed(significant(1000 * grown, 3)) + " mm, where cable " + quote(cable.name) +
             " itself stretches by " + trimmed(significant(1000 * stretch, 2)) + " mm",
         unit_remedy(cable, end, "kN"));
}

void PlausibleLog::require_deviations(std::size_t c) const {
  const CableDescription& cable = scene_.cables[c];
  double largest = 0;
  for (const Jack& jack : cables_[c].jack) largest = std::max(largest, jack.pull());
  if (largest == 0) return;
  const bool is_first_stage = largest < first_stage_strain * cable.E * cable.A;
  const double most = (is_first_stage ? part_in_first_stage : part_of_largest) * largest;
  const auto require = [&](const InstrumentDescription& cell, const std::string& column) {
    if (!cell.exact && !cell.is_assumed && cell.sd && *cell.sd > most)
      refuse(
          scene_.file, "/sensors" + pointer_step(column) + "/sd",
          "a cell that scatters by " + plain(*cell.sd) + " N where the jacks of its cable pull at most " +
              plain(largest) + " N",
          "write sd in N, and in the header of the log the unit of its columns, as in " + column + " [kN]");
  };
  for (std::size_t end = 0; end < 2; ++end) require(cable.cell[end], column_of(cable, end));
}

// A jack that pulls nothing for the whole log has a column, with zeros.
void PlausibleLog::require_column(std::size_t c, const LogReader& log, const std::string& path) const {
  const CableDescription& cable = scene_.cables[c];
  std::string missing;
  for (std::size_t end = 0; end < 2; ++end) {
    const std::string column = column_of(cable, end);
    if (!cable.is_jacked(end)) continue;
    if (log.has(column) || log.has(column + ".locked")) return;
    if (missing.empty()) missing = column;
  }
  if (missing.empty() || !cables_[c].is_read_under_load) return;
  refuse(path, "line " + std::to_string(log.header_line()),
         "there is no column " + quote(missing) + ", though other instruments read cable " +
             quote(cable.name) + " under load",
         "add the force of this jack");
}

}  // namespace taut::host
