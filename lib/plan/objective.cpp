#include "lib/plan/objective.hpp"

namespace taut::host {

double off_target(const std::vector<double>& tension, const std::vector<double>& target) {
  return taut::off_target(tension.data(), target.data(), static_cast<int>(target.size()));
}

NearestPart nearest_part(const std::vector<double>& from, const std::vector<double>& to,
                         const std::vector<double>& target, double least_part, double most_part) {
  return taut::nearest_part(from.data(), to.data(), target.data(), static_cast<int>(target.size()),
                            least_part, most_part);
}

}  // namespace taut::host
