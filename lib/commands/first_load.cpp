#include "lib/commands/first_load.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "lib/commands/usual_deviations.hpp"
#include "lib/files/text.hpp"
#include "taut/estimation/under_load.hpp"

namespace taut::host {
namespace {

template <class Jacks, class Is>
bool any(const Jacks& jacks, const Is& is) {
  return std::any_of(jacks.begin(), jacks.end(),
                     [&](const auto& cable) { return std::any_of(cable.begin(), cable.end(), is); });
}

// As is_under_load() of a device has it. What was taken for the noise of a cell that the scene does not know
// comes from readings, and of a few near zero says little.
double read_of_no_load(const CableDescription& cable, std::size_t end) {
  const InstrumentDescription& cell = cable.cell[end];
  if (cell.exact) return 0;
  const double taken = cell.sd.value_or(0),
               noise = cell.is_given ? taken : std::max(taken, usual_noise(cable));
  return 5 *
         std::sqrt(noise * noise + std::pow(cell.zero_sd.value_or(0), 2) + std::pow(cell.resolution, 2) / 12);
}

}  // namespace

FirstLoad::FirstLoad(const LogRules& rules, const SceneDescription& scene)
    : rules_(rules), scene_(scene), jacks_(scene.cables.size()) {
  for (std::size_t c = 0; c < jacks_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) jacks_[c][end].none = read_of_no_load(scene.cables[c], end);
}

// Whether only wedges hold a cable, and what the other end reads of it.
FirstLoad::Held FirstLoad::held_by_wedges(const LogRow& row, std::size_t c) const {
  const CableDescription& cable = scene_.cables[c];
  bool wedges = false;
  Held held = Held::unread;
  for (std::size_t end = 0; end < 2; ++end) {
    const auto& reading = row.cables[c][end].reading;
    if (cable.is_jacked(end)) {
      if (!row.cables[c][end].locked) return Held::no;
      wedges = true;
    } else if (reading) {
      held = *reading > jacks_[c][end].none ? Held::under_load : Held::no;
    }
  }
  return wedges ? held : Held::no;
}

// As tells_load() of a device has it.
bool FirstLoad::tells(const LogRow& row) const {
  return tells_load(static_cast<int>(jacks_.size()), [&](int cable, std::size_t end) -> EndTells {
    const auto c = static_cast<std::size_t>(cable);
    const EndRow& given = row.cables[c][end];
    const bool is_jacked = scene_.cables[c].is_jacked(end);
    // The force of a jack without a column is zero.
    return {is_jacked, given.locked, given.reading || (is_jacked && !given.has_column),
            given.reading && *given.reading > jacks_[c][end].none};
  });
}

void FirstLoad::take(const LogRow& row) {
  if (telling_ > 0 || tells(row)) ++telling_;
  ++rows_;
  if (telling_ <= 1) unread_.clear();
  for (std::size_t c = 0; c < jacks_.size() && telling_ <= 1; ++c) {
    const Held held = held_by_wedges(row, c);
    is_held_ = is_held_ || held == Held::under_load;
    if (held == Held::unread) unread_ += (unread_.empty() ? "" : ", ") + quote(scene_.cables[c].name);
  }
  for (std::size_t c = 0; c < jacks_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& given = row.cables[c][end];
      // While wedges hold it, the cell of a jack reads nothing of its cable.
      if (!scene_.cables[c].is_jacked(end) || given.locked) continue;
      const auto& reading = given.reading;
      if (!reading || !rules_.is_possible_force(c, *reading)) continue;
      Jack& jack = jacks_[c][end];
      if (!jack.first)
        jack.first = telling_ == 1 ? *reading : 0;
      else if (!jack.second)
        jack.second = *reading;
      jack.largest = std::max(jack.largest, *reading);
    }
}

bool FirstLoad::is_under_load() const {
  return is_held_ ||
         any(jacks_, [](const Jack& jack) { return jack.goes_on() && *jack.first > 0.05 * jack.largest; });
}

bool FirstLoad::is_open() const {
  return telling_ == 0 || (!is_held_ && any(jacks_, [](const Jack& jack) { return jack.goes_on(); }));
}

FirstLoad first_load_of(const std::string& path, const LogRules& rules, const SceneDescription& scene) {
  FirstLoad load(rules, scene);
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  LogRow row = log.first_row();
  // A long log is read on only where some jack is in question.
  while (load.is_open() && log.next(row)) load.take(row);
  return load;
}

}  // namespace taut::host
