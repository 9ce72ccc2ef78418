// What a plan is to reach, and within which limits.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace taut::host {

/// What is not limited.
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// A goal file. Units: N, m.
struct PlanGoal {
  std::string file;                                ///< where it comes from, for messages
  std::vector<double> factor;                      ///< of every load pattern, while jacking
  std::vector<double> target;                      ///< of every segment of the scene; 0: does not matter
  std::vector<double> most_segment;                ///< largest force of every segment
  std::vector<std::array<double, 2>> most_force;   ///< of the jacks of every cable
  std::vector<std::array<double, 2>> most_stroke;  ///< of the jacks of every cable
  int stages = 0;                                  ///< at most so many moves of jacks
  bool has_stages = false;                         ///< the file gives them
  bool lock = false;                               ///< what counts is after lock-off

  bool matters(std::size_t segment) const { return target[segment] > 0; }
};

/// Whether the goal limits anything.
inline bool has_limits(const PlanGoal& goal) {
  for (const double most : goal.most_segment)
    if (most < no_limit) return true;
  for (const auto* list : {&goal.most_force, &goal.most_stroke})
    for (const auto& most : *list)
      if (most[0] < no_limit || most[1] < no_limit) return true;
  return false;
}

}  // namespace taut::host
