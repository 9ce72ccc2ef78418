// What a cell at an anchored end reads before anything pulls: its zero.
#pragma once

#include <cmath>

#include "taut/estimation/belief.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The unknown zero of a cell at an anchored end, as it is asked about for one reading: what that is before
/// anything pulls is the zero and nothing else, however far off. A view of all that it is made from; where no
/// zero can be unknown the compiler leaves nothing of it.
template <class FilterType, class Jacks>
class ZeroAtRest {
 public:
  using Scalar = typename FilterType::Scalar;
  using TrackerType = typename FilterType::TrackerType;

  /// Of the cell at `end`, whose readings have the standard deviation `sd` [N]. Cost: a few operations a
  /// jack.
  template <class EndType>
  ZeroAtRest(const EndType& end, Scalar sd, const TrackerType& tracker, FilterType& filter,
             const Jacks& jacks)
      : tracker_(tracker),
        filter_(filter),
        jacks_(jacks),
        sd_(sd),
        cable_(end.cable()),
        zero_(FilterType::has_further ? filter.instruments().at(end.cable(), end.end).zero : -1),
        is_told_(zero_ >= 0 && has_rested(sd, tracker, jacks)) {}

  /// Whether there is such a zero, and a reading tells it at present.
  bool tells_zero() const { return is_told_; }
  /// Where it does, whether that is unknown `p`.
  bool tells(int p) const { return is_told_ && p == zero_; }
  /// How well it does at best: the variance of the zeros of the jacks' cells of the same cable, which say
  /// that nothing pulls [N^2].
  Scalar variance_of_zeros() const {
    Scalar variance = 0;
    for (int k = 0; k < jacks_.size(); ++k) {
      const int zero = filter_.instruments().at(jacks_.end(k).cable(), jacks_.end(k).end).zero;
      if (jacks_.end(k).cable() == cable_ && zero >= 0) variance += filter_.belief().variance(zero);
    }
    return variance;
  }
  /// Lets the zero be as far off as a reading [N] that is outside of the gate before anything pulls, or where
  /// no force so far is so large that it would explain it: the next ones tell how far. expect() gives what
  /// the force is expected to be. Returns whether the reading was one.
  template <class Expect>
  bool open_zero(Scalar reading, const Expect& expect) const {
    constexpr Scalar far = 4;
    const bool explains = !(far * static_cast<Scalar>(tracker_.peak()) < std::fabs(reading));
    return zero_ >= 0 && (is_told_ || !explains) && open_outside(reading, expect());
  }

 private:
  /// Whether no force has been larger than noise so far, as a few readings of every jack say.
  [[gnu::noinline]] static bool has_rested(Scalar sd, const TrackerType& tracker, const Jacks& jacks) {
    constexpr Scalar at_most = 4;
    constexpr int few = 3;
    Scalar noise = sd;
    bool are_few = false;
    for (int k = 0; k < jacks.size(); ++k) {
      noise = larger(noise, jacks[k].filter.sd());
      are_few = are_few || jacks[k].filter.run_length() < few;
    }
    return !are_few && static_cast<Scalar>(tracker.peak()) < at_most * noise;
  }
  [[gnu::noinline]] bool open_outside(Scalar reading, const Expected<Scalar>& force) const {
    const Scalar off = reading - force.value;
    if (!(off * off > FilterType::BeliefType::gate * (force.variance + sd_ * sd_))) return false;
    filter_.widen(zero_, std::fabs(reading));
    return true;
  }

  const TrackerType& tracker_;
  FilterType& filter_;
  const Jacks& jacks_;
  Scalar sd_;
  int cable_, zero_;
  bool is_told_;
};

}  // namespace taut
