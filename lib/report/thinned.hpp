// A series of any length in bounded memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace taut::host {

/// Keeps at most `most` cells of a series, each for the same number of entries but for the last: when it is
/// full, neighbours are joined two by two. `Cell` has a function join(const Cell& later).
template <class Cell>
class Thinned {
 public:
  explicit Thinned(std::size_t most) : most_(most < 2 ? 2 : most) {}

  void add(const Cell& entry) {
    if (in_last_ == entries_a_cell_ && cells_.size() == most_) join_neighbours();
    if (cells_.empty() || in_last_ == entries_a_cell_) {
      cells_.push_back(entry);
      in_last_ = 1;
    } else {
      cells_.back().join(entry);
      ++in_last_;
    }
  }

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  // All cells are full here.
  void join_neighbours() {
    const std::size_t pairs = cells_.size() / 2;
    const bool is_odd = cells_.size() % 2 == 1;
    for (std::size_t i = 0; i < pairs; ++i) {
      if (i > 0) cells_[i] = std::move(cells_[2 * i]);
      cells_[i].join(cells_[2 * i + 1]);
    }
    if (is_odd) cells_[pairs] = std::move(cells_.back());
    cells_.erase(cells_.begin() + static_cast<std::ptrdiff_t>(pairs + (is_odd ? 1 : 0)), cells_.end());
    in_last_ = is_odd ? entries_a_cell_ : 2 * entries_a_cell_;
    entries_a_cell_ *= 2;
  }

  std::size_t most_, entries_a_cell_ = 1, in_last_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace taut::host
