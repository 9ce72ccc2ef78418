// The unknown constants of load cells and gauges: which unknown is whose, and what depends on it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "taut/numerics/fixed_list.hpp"
#include "taut/scene/load_cell.hpp"
#include "taut/tracking/sensitivity.hpp"

namespace taut {

/// Numbers of the unknowns of one instrument, or -1.
struct InstrumentUnknowns {
  std::int16_t gain = 0, zero = 0, hysteresis = 0;

  /// Gives them numbers by add(standard deviation); what is known has none. Returns how many found no room.
  template <class Scalar, class Add>
  int add(const LoadCell<Scalar>& cell, const Add& add) {
    int missing = 0;
    const auto number = [&](Scalar sd) {
      const int p = sd > 0 ? add(sd) : -1;
      if (sd > 0 && p < 0) ++missing;
      return static_cast<std::int16_t>(p);
    };
    gain = number(cell.gain_sd);
    zero = number(cell.zero_sd);
    hysteresis = number(cell.hysteresis_sd);
    return missing;
  }
  /// Calls visit(error) for every unknown that the force of a jack depends on as JackError: the force behind
  /// a reading R is F = (R - zero) / (1 + gain) / (branch +- hysteresis).
  template <class Scalar, class Visit>
  void for_each_error(const LoadCell<Scalar>& cell, int jack, bool pulls, const Visit& visit) const {
    const Scalar branch = pulls ? cell.up : cell.down;
    const auto error = [&](std::int16_t p, Scalar constant, Scalar proportional) {
      if (p >= 0) visit(JackError<Scalar>{p, static_cast<std::int16_t>(jack), constant, proportional});
    };
    error(gain, 0, -1);
    error(zero, -1 / branch, 0);
    error(hysteresis, 0, (pulls ? -1 : 1) / branch);
  }
};

/// Unknown constants of all load cells at the ends of cables.
template <class Scalar, class Cap>
class Instruments {
 public:
  void clear() {
    constexpr InstrumentUnknowns none = {-1, -1, -1};
    of_.fill({none, none});
  }
  InstrumentUnknowns& at(int cable, std::size_t end) { return of_[cable][end]; }
  const InstrumentUnknowns& at(int cable, std::size_t end) const { return of_[cable][end]; }

 private:
  FixedArray<std::array<InstrumentUnknowns, 2>, Cap::cables> of_;
};

/// How many loads of a jack friction is taken to remember, by unknowns of an Estimator: where it reversed,
/// was locked, or rested while one of so many load patterns, or one of several jacks, changed.
constexpr int remembered_corners(int load_patterns, int jacks) {
  return load_patterns > 0 || jacks > 1 ? 3 : 2;
}

/// How many unknowns an Estimator of these cables needs room for: forces depend on those that are carried,
/// readings alone on the further ones, without those of gauges. is_self_locking(joint) tells which joints
/// have no friction to be found, `load_patterns` how many other loads there are.
struct UnknownCounts {
  int carried = 0, further = 0;
};
template <class Cables, class IsSelfLocking, class PriorType>
constexpr UnknownCounts count_unknowns(const Cables& cables, const IsSelfLocking& is_self_locking,
                                       const PriorType& known, int load_patterns) {
  UnknownCounts count;
  int jacks = 0, noisy_jacks = 0;
  decltype(cables.size()) c = 0;  // a vector counts without sign
  for (const auto& cable : cables) {
    int free = 0;
    for (int j = 0; j < cable.joints(); ++j) free += is_self_locking(cable.first_joint + j) ? 0 : 1;
    if (known.drift_sd[c] > 0) ++count.carried;
    if (known.mu_sd[c] > 0) count.carried += known.shared[c] && free > 1 ? 1 : free;
    for (std::size_t end = 0; end < 2 && !cable.closed; ++end) {
      const auto& cell = known.cell[c][end];
      if (cable.ends[end] == End::jacked) {
        ++jacks;
        noisy_jacks += cell.sd > 0 ? 1 : 0;
        count.carried += cell.unknowns() + (known.seating_sd[c] > 0 ? 1 : 0);
      } else if (cell.sd > 0) {
        count.further += cell.unknowns();
      }
    }
    ++c;
  }
  count.carried += noisy_jacks * remembered_corners(load_patterns, jacks);
  return count;
}

}  // namespace taut
