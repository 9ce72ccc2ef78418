// Linear programs of a few unknowns.
#pragma once

#include <optional>
#include <vector>

namespace taut::host {

/// Minimizes cost x over x >= 0 with rows x <= bound. Every row has as many numbers as `cost`.
struct LinearProgram {
  std::vector<double> cost;
  std::vector<std::vector<double>> rows;
  std::vector<double> bound;

  void add(std::vector<double> row, double most) {
    rows.push_back(std::move(row));
    bound.push_back(most);
  }
};

/// The solution by the simplex method in two phases, with Bland's rule once it has stalled; nothing if there
/// is none, or none within 50 pivots an unknown and row. Numbers should be around one. (Chvátal, Linear
/// Programming, 1983, chapters 2 and 3.)
std::optional<std::vector<double>> solve(const LinearProgram& program);

}  // namespace taut::host
