#include "lib/commands/first_load.hpp"

#include <algorithm>
#include <fstream>

namespace taut::host {
namespace {

template <class Jacks, class Is>
bool any(const Jacks& jacks, const Is& is) {
  return std::any_of(jacks.begin(), jacks.end(),
                     [&](const auto& cable) { return std::any_of(cable.begin(), cable.end(), is); });
}

}  // namespace

FirstLoad::FirstLoad(const LogRules& rules, const SceneDescription& scene)
    : rules_(rules), scene_(scene), jacks_(scene.cables.size()) {}

void FirstLoad::take(const LogRow& row) {
  ++rows_;
  for (std::size_t c = 0; c < jacks_.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& reading = row.cables[c][end].reading;
      if (!scene_.cables[c].is_jacked(end) || !reading || !rules_.is_possible_force(c, *reading)) continue;
      Jack& jack = jacks_[c][end];
      if (!jack.first)
        jack.first = rows_ == 1 ? *reading : 0;
      else if (!jack.second)
        jack.second = *reading;
      jack.largest = std::max(jack.largest, *reading);
    }
}

bool FirstLoad::is_under_load() const {
  return any(jacks_, [](const Jack& jack) { return jack.goes_on() && *jack.first > 0.05 * jack.largest; });
}

bool FirstLoad::is_open() const {
  return rows_ == 0 || any(jacks_, [](const Jack& jack) { return jack.goes_on(); });
}

bool begins_under_load(const std::string& path, const LogRules& rules, const SceneDescription& scene) {
  FirstLoad load(rules, scene);
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  LogRow row = log.first_row();
  // A long log is read on only where some jack is in question.
  while (load.is_open() && log.next(row)) load.take(row);
  return load.is_under_load();
}

}  // namespace taut::host
