// Whether friction is at its limit everywhere along a cable.
#pragma once

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// Joints that can slide at all; while some of them stick, a measurement has no derivative to go by: which
/// ones do depends on friction itself.
template <class Cap>
class SlidingCheck {
 public:
  template <class CondensedType>
  void start(const CondensedType& model) {
    for (int j = 0; j < Cap::joints; ++j) can_slide_[j] = j < model.joints && !model.is_self_locking(j);
  }
  /// Whether friction is at its limit at every joint of cable `c` that can slide, but for those that stick
  /// for sure: holds(joint). Cost: one look a joint.
  template <class TrackerType, class Holds>
  bool slides_throughout(const TrackerType& tracker, int c, const Holds& holds) const {
    // With one cable the compiler knows how many there are.
    constexpr bool is_alone = Cap::cables == 1;
    const auto& cables = tracker.model().cables;
    const int first = is_alone ? 0 : cables[c].first_joint;
    const int joints = is_alone ? Cap::joints : cables[c].joints();
    bool sticks = false;
    for (int j = first; j < first + joints; ++j)
      sticks |= can_slide_[j] && !tracker.is_at_limit(j) && !holds(j);
    return !sticks;
  }

 private:
  FixedArray<bool, Cap::joints> can_slide_;
};

}  // namespace taut
