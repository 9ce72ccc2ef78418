#include "lib/plan/linear_program.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace taut::host {
namespace {

constexpr double tolerance = 1e-11;
constexpr std::size_t none = static_cast<std::size_t>(-1);

// The tableau: unknowns that are not in the basis as columns, those that are as rows, costs below them.
class Tableau {
 public:
  explicit Tableau(const LinearProgram& program)
      : columns_(program.cost.size() + 1), rows_(program.rows.size()), at_(rows_ + 2) {
    for (std::size_t r = 0; r < rows_; ++r) {
      at_[r] = program.rows[r];
      at_[r].push_back(-1);  // the unknown that makes every start possible
      at_[r].push_back(program.bound[r]);
    }
    at_[rows_] = program.cost;
    at_[rows_].resize(columns_ + 1);
    at_[rows_ + 1].assign(columns_ + 1, 0);
    at_[rows_ + 1][columns_ - 1] = 1;
    for (std::size_t c = 0; c < columns_; ++c) outside_.push_back(c);
    for (std::size_t r = 0; r < rows_; ++r) inside_.push_back(columns_ + r);
  }

  std::optional<std::vector<double>> solve() {
    std::size_t worst = none;
    for (std::size_t r = 0; r < rows_; ++r)
      if (at_[r][columns_] < -tolerance && (worst == none || at_[r][columns_] < at_[worst][columns_]))
        worst = r;
    if (worst != none) {
      pivot(worst, columns_ - 1);
      if (!minimize(rows_ + 1, none) || at_[rows_ + 1][columns_] < -1e-9) return std::nullopt;
    }
    const std::size_t helper = leave_helper();
    if (!minimize(rows_, helper)) return std::nullopt;
    std::vector<double> x(columns_ - 1, 0);
    for (std::size_t r = 0; r < rows_; ++r)
      if (inside_[r] + 1 < columns_) x[inside_[r]] = at_[r][columns_];
    return x;
  }

 private:
  // The helping unknown is zero from here on: its column, once it has one.
  std::size_t leave_helper() {
    for (std::size_t r = 0; r < rows_; ++r) {
      if (inside_[r] + 1 != columns_) continue;
      std::size_t best = 0;
      for (std::size_t c = 1; c < columns_; ++c)
        if (std::fabs(at_[r][c]) > std::fabs(at_[r][best])) best = c;
      pivot(r, best);
    }
    for (std::size_t c = 0; c < columns_; ++c)
      if (outside_[c] + 1 == columns_) return c;
    return none;
  }
  bool minimize(std::size_t cost, std::size_t barred) {
    const std::size_t most = 50 * (columns_ + rows_);
    for (std::size_t count = 0; count < most; ++count) {
      const bool careful = count > most / 2;
      std::size_t enters = none, leaves = none;
      for (std::size_t c = 0; c < columns_; ++c) {
        if (c == barred || at_[cost][c] >= -tolerance) continue;
        if (enters == none || (careful ? outside_[c] < outside_[enters] : at_[cost][c] < at_[cost][enters]))
          enters = c;
      }
      if (enters == none) return true;
      double least = 0;
      for (std::size_t r = 0; r < rows_; ++r) {
        if (at_[r][enters] <= tolerance) continue;
        const double ratio = at_[r][columns_] / at_[r][enters];
        if (leaves == none || ratio < least || (ratio == least && inside_[r] < inside_[leaves])) {
          leaves = r;
          least = ratio;
        }
      }
      if (leaves == none) return false;
      pivot(leaves, enters);
    }
    return false;
  }
  void pivot(std::size_t row, std::size_t column) {
    const double by = at_[row][column];
    for (double& each : at_[row]) each /= by;
    at_[row][column] = 1 / by;
    for (std::size_t r = 0; r < at_.size(); ++r) {
      if (r == row) continue;
      const double factor = at_[r][column];
      if (factor == 0) continue;
      at_[r][column] = 0;
      for (std::size_t c = 0; c <= columns_; ++c) at_[r][c] -= factor * at_[row][c];
    }
    std::swap(inside_[row], outside_[column]);
  }

  std::size_t columns_, rows_;
  std::vector<std::vector<double>> at_;
  std::vector<std::size_t> outside_, inside_;
};

}  // namespace

std::optional<std::vector<double>> solve(const LinearProgram& program) { return Tableau(program).solve(); }

}  // namespace taut::host
