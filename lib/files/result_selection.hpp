// Which columns of a result are written.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace taut::host {

/// All columns of a result in their order, or some of them in another.
class ResultSelection {
 public:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  /// All of them.
  ResultSelection() = default;
  /// The columns with these numbers among all, from 0, in this order.
  ResultSelection(const std::vector<std::size_t>& chosen, std::size_t all)
      : count_(chosen.size()), place_(all, nowhere) {
    for (std::size_t i = 0; i < chosen.size(); ++i) place_[chosen[i]] = i;
  }

  bool is_all() const { return place_.empty(); }
  /// How many, if not all.
  std::size_t count() const { return count_; }
  /// Where a column is written among the chosen ones, or `nowhere`.
  std::size_t place(std::size_t column) const { return is_all() ? column : place_[column]; }

 private:
  std::size_t count_ = 0;
  std::vector<std::size_t> place_;
};

}  // namespace taut::host
