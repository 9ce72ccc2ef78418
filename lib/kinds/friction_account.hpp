// Which readings taught an Estimator how much of friction.
#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "taut/estimation/alarms.hpp"

namespace taut::host {

/// Keeps the information 1/variance that every instrument brought to every unknown of friction: what an
/// update took away from the variance, and nothing else that changes it. Information of one unknown adds up,
/// so the sum over the instruments is what is known more than beforehand. A Capacity::Account.
class FrictionAccount {
 public:
  /// What one instrument brought to one unknown.
  struct Entry {
    std::size_t readings = 0;
    double information = 0;  ///< [1 / square of the unknown]
  };
  /// An instrument: the alarm that its readings raise where they contradict.
  using Source = std::tuple<Alarm::Kind, int, int>;  // kind, cable, place

  template <class Filter>
  void begin(const Filter& filter) {
    entries_.clear();
    known_.clear();
    for (int p = 0; p < filter.belief().friction(); ++p) known_.push_back(information(filter, p));
  }
  template <class Filter>
  void learned(const Alarm& source, int readings, const Filter& filter) {
    for (std::size_t p = 0; p < known_.size(); ++p) {
      const double now = information(filter, static_cast<int>(p)), brought = now - known_[p];
      known_[p] = now;
      // Less is rounding.
      if (!(brought > least * now)) continue;
      Entry& entry = entries_[{static_cast<int>(p), {source.kind, source.cable, source.place}}];
      entry.readings += static_cast<std::size_t>(readings);
      entry.information += brought;
    }
  }
  /// By unknown and instrument.
  const std::map<std::pair<int, Source>, Entry>& entries() const { return entries_; }

 private:
  static constexpr double least = 1e-12;

  template <class Filter>
  static double information(const Filter& filter, int p) {
    return 1 / static_cast<double>(filter.belief().variance(p));
  }

  std::map<std::pair<int, Source>, Entry> entries_;
  std::vector<double> known_;  // information on every unknown of friction
};

}  // namespace taut::host
