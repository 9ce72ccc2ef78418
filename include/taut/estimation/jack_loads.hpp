// The conditioned loads of all jacks, and where the tracker has been driven to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/cable_end.hpp"
#include "taut/estimation/friction_prior.hpp"
#include "taut/estimation/jack_load.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/sample.hpp"

namespace taut {

/// Load patterns of a condensed scene: zero at compile time where the capacity is.
template <class CondensedType>
int load_patterns(const CondensedType& model) {
  return CondensedType::Capacity::loads == 0 ? 0 : model.loads;
}

/// Jacked ends in the order in which a tracker counts them, with their loads; and the load factors that the
/// tracker was driven to.
template <class Scalar, class Cap, int Reversals>
class JackLoads {
 public:
  static constexpr int capacity = max_jacks<Cap>;
  using Load = JackLoad<Scalar, Reversals>;
  using SampleType = Sample<Scalar, Cap>;
  using Readings = FixedList<JackReading<Scalar>, capacity>;
  /// All that is known of loads, between two rows.
  struct State {
    FixedArray<Scalar, Cap::loads> factor;  ///< where the tracker was driven to [-]
    FixedArray<Load, capacity> jack;
  };

  template <class CondensedType>
  void start(const CondensedType& model, const FrictionPrior<Scalar, Cap>& prior) {
    ends_.clear();
    patterns_ = load_patterns(model);
    for_each_jacked_end(model.cables, [&](int c, std::size_t end) { ends_.add(CableEnd<Cap>::of(c, end)); });
    state_.factor.fill(Scalar(0));
    for (int k = 0; k < size(); ++k) {
      state_.jack[k].start(in(prior.cell, k));
    }
  }
  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }

  /// The load factor of a pattern that the tracker was driven to [-].
  Scalar factor(int pattern) const { return state_.factor[pattern]; }
  /// Load patterns of the scene, none before start(): zero at compile time where the capacity is.
  int patterns() const { return Cap::loads == 0 ? 0 : patterns_; }
  int size() const { return ends_.size(); }
  bool empty() const { return ends_.empty(); }
  const FixedList<CableEnd<Cap>, capacity>& ends() const { return ends_; }
  const CableEnd<Cap>& end(int k) const { return ends_[k]; }
  Load& operator[](int k) { return state_.jack[k]; }
  const Load& operator[](int k) const { return state_.jack[k]; }
  /// The entry of jack `k` in a table `table[cable][end]`.
  template <class Table>
  auto& in(Table& table, int k) const {
    return ends_[k].in(table);
  }
  /// The number of the jack at an end, or -1.
  int find(int cable, std::size_t end) const {
    for (int k = 0; k < size(); ++k)
      if (ends_[k].is(cable, end)) return k;
    return -1;
  }
  /// Whether there is a jack at either end of a cable that is not locked.
  std::array<bool, 2> pulls(int cable) const {
    const int first = find(cable, 0), last = find(cable, 1);
    return {first >= 0 && !state_.jack[first].locked, last >= 0 && !state_.jack[last].locked};
  }
  /// Every load as the measurements of the row see it.
  Readings readings(const FrictionPrior<Scalar, Cap>& prior) const {
    Readings all;
    for (int k = 0; k < size(); ++k) all.add(state_.jack[k].reading(in(prior.cell, k)));
    return all;
  }
  /// Whether the load of a jack is in doubt, of `cable` or, if that is negative, of any. See
  /// JackLoad::is_in_doubt().
  bool are_in_doubt(int cable = -1) const {
    for (int k = 0; k < size(); ++k)
      if (state_.jack[k].is_in_doubt() && (cable < 0 || ends_[k].cable() == cable)) return true;
    return false;
  }
  /// Calls visit(unknown) for the error of every load that friction remembers.
  template <class Visit>
  void for_each_memory(const Visit& visit) const {
    for (int k = 0; k < size(); ++k)
      for (const int p : state_.jack[k].memory)
        if (p >= 0) visit(p);
  }
  /// Whether unknown `p` is one of them.
  bool remember(int p) const {
    bool any = false;
    for_each_memory([&](int memory) { any |= memory == p; });
    return any;
  }
  /// While other loads change, a jack's load is off by what friction comes to rest at: an error that is an
  /// unknown, and that its readings have, too. It counts with them, so that derivatives `H` by the unknowns
  /// are those with the load as it is read. Cost: a few operations a jack.
  template <class ByJack, class ByUnknown>
  void count_once(const ByJack& by_jack, ByUnknown& H) const {
    if constexpr (Reversals > 2)
      for (int k = 0; k < size(); ++k)
        if (state_.jack[k].at_rest >= 0) H[state_.jack[k].at_rest] -= by_jack[k];
  }
  /// What count_once() takes from the derivative by unknown `p`.
  template <class ByJack>
  Scalar counted_elsewhere(int p, const ByJack& by_jack) const {
    if constexpr (Reversals > 2)
      for (int k = 0; k < size(); ++k)
        if (state_.jack[k].at_rest == p) return by_jack[k];
    return 0;
  }
  /// Where the tracker is driven to for a row.
  SampleType target(const SampleType& given) const {
    SampleType to = given;
    for (int k = 0; k < size(); ++k) in(to.jack, k) = {state_.jack[k].target(), state_.jack[k].locked};
    return to;
  }
  /// The best estimates of the loads, where none has perhaps reversed or has just taken over.
  SampleType best(const SampleType& given) const {
    SampleType to = target(given);
    for (int k = 0; k < size(); ++k)
      if (state_.jack[k].leads()) in(to.jack, k).force = state_.jack[k].best();
    return to;
  }
  /// Where it was driven to last.
  SampleType driven(int patterns) const {
    SampleType from;
    for (int i = 0; i < patterns; ++i) from.factor[i] = state_.factor[i];
    for (int k = 0; k < size(); ++k) in(from.jack, k) = state_.jack[k].driven;
    return from;
  }
  /// The tracker has come to these loads: those of a row, or its own where it came to its end before.
  template <class Loads>
  void arrive(const Loads& loads, int patterns) {
    for (int i = 0; i < patterns; ++i) state_.factor[i] = static_cast<Scalar>(loads.factor[i]);
    for (int k = 0; k < size(); ++k) {
      const auto& at = in(loads.jack, k);
      state_.jack[k].driven = {static_cast<Scalar>(at.force), at.locked};
    }
  }

 private:
  FixedList<CableEnd<Cap>, capacity> ends_;
  State state_;
  int patterns_ = 0;
};

}  // namespace taut
