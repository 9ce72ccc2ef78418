#include "lib/commands/first_load.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <optional>
#include <vector>

namespace taut::host {

bool begins_under_load(const std::string& path, const LogRules& rules, const SceneDescription& scene) {
  struct Jack {
    std::optional<double> first, second;
    double largest = 0;

    // From a load of its own, and not in one stage from zero.
    bool goes_on() const { return first && *first > 0 && (!second || *second - *first < 0.8 * *first); }
  };
  std::vector<std::array<Jack, 2>> jacks(scene.cables.size());
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  LogRow row = log.first_row();
  // A long log is read on only where some jack is in question.
  const auto may_begin_so = [&] {
    return std::any_of(jacks.begin(), jacks.end(), [](const std::array<Jack, 2>& cable) {
      return std::any_of(cable.begin(), cable.end(), [](const Jack& jack) { return jack.goes_on(); });
    });
  };
  while (log.next(row) && (row.row <= 1 || may_begin_so()))
    for (std::size_t c = 0; c < jacks.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& reading = row.cables[c][end].reading;
        if (!scene.cables[c].is_jacked(end) || !reading || !rules.is_possible_force(c, *reading)) continue;
        Jack& jack = jacks[c][end];
        if (!jack.first)
          jack.first = row.row == 1 ? *reading : 0;
        else if (!jack.second)
          jack.second = *reading;
        jack.largest = std::max(jack.largest, *reading);
      }
  return std::any_of(jacks.begin(), jacks.end(), [](const std::array<Jack, 2>& cable) {
    return std::any_of(cable.begin(), cable.end(),
                       [](const Jack& jack) { return jack.goes_on() && *jack.first > 0.05 * jack.largest; });
  });
}

}  // namespace taut::host
