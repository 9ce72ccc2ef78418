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
  };
  std::vector<std::array<Jack, 2>> jacks(scene.cables.size());
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  LogRow row = log.first_row();
  while (log.next(row))
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
    return std::any_of(cable.begin(), cable.end(), [](const Jack& jack) {
      return jack.first && *jack.first > 0.05 * jack.largest &&
             (!jack.second || *jack.second - *jack.first < 0.8 * *jack.first);
    });
  });
}

}  // namespace taut::host
