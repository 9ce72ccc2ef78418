#include "lib/commands/usual_deviations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr double usual_mu_sd = 0.5, usual_cell_sd = 0.005;

// The largest force in the column of every load cell; zeros if the scene knows the deviation of all that are
// read, so that a long log is not read once more.
std::vector<std::array<double, 2>> largest_readings(const std::string& path, const SceneDescription& scene,
                                                    const LogRules& rules) {
  std::vector<std::array<double, 2>> largest(scene.cables.size());
  std::ifstream stream = open_log(path);
  LogReader log(stream, path, scene, rules);
  bool all_known = true;
  for (const CableDescription& cable : scene.cables)
    for (std::size_t end = 0; end < 2; ++end)
      all_known = all_known && (cable.sensor_sd[end] > 0 || !log.has(cable.name + "." + end_name(end)));
  if (all_known) return largest;
  LogRow row = log.first_row();
  while (log.next(row))
    for (std::size_t c = 0; c < largest.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (const double reading = std::fabs(row.cables[c][end].reading.value_or(0));
            rules.is_possible_force(c, reading))
          largest[c][end] = std::max(largest[c][end], reading);
  return largest;
}

}  // namespace

std::vector<std::string> fill_in_mu_deviations(SceneDescription& scene) {
  std::vector<std::string> remarks;
  for (CableDescription& cable : scene.cables) {
    if (cable.has_mu_sd || cable.joints() == 0) continue;
    double sum = 0;
    for (const double mu : cable.mu) sum += mu;
    cable.mu_sd = usual_mu_sd * sum / static_cast<double>(cable.joints());
    if (cable.mu_sd > 0)
      remarks.push_back("cable " + quote(cable.name) + " has no \"mu_sd\": half of mu, " +
                        plain(cable.mu_sd) + ", is taken for its standard deviation");
  }
  return remarks;
}

std::vector<std::string> fill_in_deviations(const std::string& path, const LogRules& rules,
                                            SceneDescription& scene) {
  std::vector<std::string> remarks = fill_in_mu_deviations(scene);
  const auto largest = largest_readings(path, scene, rules);
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    CableDescription& cable = scene.cables[c];
    for (std::size_t end = 0; end < 2; ++end) {
      if (cable.sensor_sd[end] > 0 || largest[c][end] == 0) continue;
      const std::string cell = quote(cable.name + "." + end_name(end));
      if (cable.is_jacked(end)) {
        remarks.push_back("the load cell " + cell +
                          " has no \"sd\" in \"sensors\": its readings are taken for exact");
        continue;
      }
      cable.sensor_sd[end] = usual_cell_sd * largest[c][end];
      remarks.push_back("the load cell " + cell +
                        " has no \"sd\" in \"sensors\": 0.5 % of its largest reading, " +
                        plain(cable.sensor_sd[end]) + " N, is taken");
    }
  }
  return remarks;
}

}  // namespace taut::host
