// The forces of cables that were under load before anything was read.
#pragma once

#include <cmath>

#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/fixed_list.hpp"
#include "taut/scene/scene.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Beside an Estimator whose loads came up from zero, a second one whose loads came down from so high that
/// every joint slid back: between the two lie the forces of every past of the jacks, for a joint's clamp
/// between rho T and T / rho keeps the order of two pasts. Between rigid saddles that is exact; on a
/// structure the springs between segments make it an approximation. As cables slide, both come together;
/// until then neither may learn from other readings than those of jacks, see withhold(). A past of load
/// patterns is not covered: their factors are taken to have been there. Costs what a second Estimator does.
template <class EstimatorType>
class UnknownPast {
 public:
  using Scalar = typename EstimatorType::Scalar;
  using Readings = typename EstimatorType::ReadingsType;

  /// Begins at the loads of the first readings, from above. Fails as Estimator::start() and come_down() do.
  template <class CondensedType, class KnowledgeType, class Limits, class Cells>
  Progress<Scalar> start(const CondensedType& condensed, const KnowledgeType& knowledge, const Limits& limits,
                         const Cells& gauges, const Readings& first) {
    const Progress<Scalar> progress = above_.start(condensed, knowledge, limits, gauges);
    if (!progress.status) return progress;
    return above_.come_down(first);
  }
  /// Follows a row that the other estimator follows, too. Fails as Estimator::advance() does.
  Progress<Scalar> advance(const Readings& readings) { return above_.advance(readings); }
  /// The readings without those of load cells at anchored ends, and of strokes: how one grows depends on
  /// which joints stick, and so on the past.
  template <class CondensedType>
  static void withhold(const CondensedType& condensed, Readings& readings) {
    for (int c = 0; c < condensed.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        readings.ends[c][end].has_stroke = false;
        if (condensed.cables[c].ends[end] != End::jacked) readings.ends[c][end].has_force = false;
      }
  }

  /// The middle of all that a force can be, with the deviation whose 95 % interval holds the intervals of
  /// both. `below` is the other estimator.
  ForceEstimate<Scalar> estimate(const EstimatorType& below, int segment) const {
    constexpr Scalar interval = Scalar(1.96);
    const ForceEstimate<Scalar> a = below.estimate(segment), b = above_.estimate(segment);
    const Scalar least =
                     larger(-larger(-(a.force - interval * a.deviation), -(b.force - interval * b.deviation)),
                            Scalar(0)),
                 most = larger(a.force + interval * a.deviation, b.force + interval * b.deviation);
    return {(least + most) / 2, (most - least) / (2 * interval)};
  }
  /// Whether both agree in all segments of a cable: within a fifth of their deviation, or by rounding.
  template <class CableLayout>
  bool is_wiped_out(const EstimatorType& below, const CableLayout& cable) const {
    for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
      const ForceEstimate<Scalar> a = below.estimate(i), b = above_.estimate(i);
      if (std::fabs(a.force - b.force) > Scalar(0.2) * a.deviation + Scalar(1e-5) * a.force) return false;
    }
    return true;
  }

 private:
  EstimatorType above_;
};

}  // namespace taut
