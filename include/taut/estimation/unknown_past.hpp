// The forces of cables that were under load before anything was read.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/estimation/under_load.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Beside an Estimator whose loads came up from zero, a second one whose loads came down from so high that
/// every joint slid back: between the two lie the forces of every past of the jacks, for a joint's clamp
/// between rho T and T / rho keeps the order of two pasts. Between rigid saddles that is exact; on a
/// structure the springs between segments make it an approximation. As cables slide, both come together;
/// until then neither may learn from other readings than those of jacks, see withhold(). A past of load
/// patterns is not covered: their factors are taken to have been there. Costs what a second Estimator does.
///
/// A row: withhold(), advance() of the other estimator and of this, and settle() when both came to the end of
/// the row. `below` is always the other estimator. Between two rows, phase() and save() are all that
/// restore() needs.
template <class EstimatorType>
class UnknownPast {
 public:
  using Scalar = typename EstimatorType::Scalar;
  using Cap = typename EstimatorType::Cap;
  using Readings = typename EstimatorType::ReadingsType;
  using State = typename EstimatorType::State;

  enum class Phase : std::uint8_t {
    unread,  ///< no row has been seen
    begins,  ///< it is not known; the estimator from above has yet to begin
    open,    ///< it is not known; both go on
    known,   ///< there was none, or it is wiped out
    silent   ///< no row has told yet whether cables are under load, see tells_load()
  };

  // What is known of it.

  /// Begins anew, before the first row.
  void reset() { phase_ = Phase::unread; }
  /// Before the first row: cables are under load in it.
  void forget() { phase_ = Phase::begins; }
  /// Before every row: of the first one that tells, is_under_load() decides; until then it is not known.
  template <class CondensedType, class PriorType>
  void look(const CondensedType& condensed, const PriorType& prior, const Readings& readings) {
    if (phase_ == Phase::known || has_above(phase_)) return;
    if (!tells_load(condensed, prior, readings))
      phase_ = Phase::silent;
    else if (phase_ != Phase::begins)
      phase_ = is_under_load(condensed, prior, readings) ? Phase::begins : Phase::known;
  }
  /// Whether forces still depend on a past that is not known.
  bool is_unknown() const { return phase_ != Phase::unread && phase_ != Phase::known; }
  Phase phase() const { return phase_; }
  /// Whether there is something to save().
  static constexpr bool has_above(Phase phase) { return phase == Phase::open; }

  // A row of readings.

  /// Leaves out what neither estimator may learn from while the past is not known: load cells at anchored
  /// ends, and strokes: how one grows depends on which joints stick, and so on the past.
  template <class CondensedType>
  void withhold(const CondensedType& condensed, Readings& readings) const {
    if (!is_unknown()) return;
    const auto& cables = linear_part(condensed).cables;
    for (int c = 0; c < cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        readings.ends[c][end].has_stroke = false;
        if (cables[c].ends[end] != End::jacked) readings.ends[c][end].has_force = false;
      }
  }
  /// Follows a row that the other estimator follows, too; the first one from above. The arguments are those
  /// of Estimator::start() and advance(). Fails as start(), come_down() and advance() do.
  template <class CondensedType, class PriorType, class Limits, class Gauges>
  Progress<Scalar> advance(const CondensedType& condensed, const PriorType& prior, const Limits& limits,
                           const Gauges& gauges, const Readings& readings,
                           int event_budget = EstimatorType::TrackerType::default_budget) {
    if (has_above(phase_)) return above_.advance(readings, event_budget);
    if (phase_ == Phase::silent) return {Status::success(), Scalar(1), 0};
    Progress<Scalar> progress = above_.start(condensed, prior, limits, gauges);
    if (progress.status) progress = above_.come_down(readings);
    if (progress.status) phase_ = Phase::open;
    return progress;
  }
  /// At the end of a row: nothing is unknown any more once both agree everywhere.
  void settle(const EstimatorType& below) {
    bool is_all = has_above(phase_);
    if (!is_all) return;
    for (const auto& cable : below.tracker().model().cables) is_all = is_all && is_wiped_out(below, cable);
    if (is_all) phase_ = Phase::known;
  }

  // The answers.

  /// The middle of all that a force can be, with the deviation whose 95 % interval holds the intervals of
  /// both; while no row has told anything, all that the cable can carry.
  ForceEstimate<Scalar> estimate(const EstimatorType& below, int segment) const {
    const auto& model = below.tracker().model();
    if (phase_ == Phase::silent)
      return between(Scalar(0), static_cast<Scalar>(model.most_force[model.cable_of(segment)]));
    const ForceEstimate<Scalar> a = below.estimate(segment);
    return has_above(phase_) ? either(a, above_.estimate(segment), Scalar(0)) : a;
  }
  /// The same of a strut; see Estimator::estimate_strut(). While no row has told anything, either way as much
  /// as the strongest cable can carry.
  template <class StrutRows>
  ForceEstimate<Scalar> estimate_strut(const EstimatorType& below, const StrutRows& rows, int strut) const {
    const auto& model = below.tracker().model();
    if (phase_ == Phase::silent) {
      Scalar strongest = 0;
      for (int c = 0; c < model.cables.size(); ++c)
        strongest = larger(strongest, static_cast<Scalar>(model.most_force[c]));
      return between(-strongest, strongest);
    }
    const ForceEstimate<Scalar> a = below.estimate_strut(rows, strut);
    return has_above(phase_)
               ? either(a, above_.estimate_strut(rows, strut), std::numeric_limits<Scalar>::lowest())
               : a;
  }
  /// Puts these tensions, and what follows from them, into a response of the other estimator.
  void respond(const EstimatorType& below, Response<Scalar, Cap>& response) const {
    if (phase_ != Phase::silent && !has_above(phase_)) return;
    const auto& model = below.tracker().model();
    for (int i = 0; i < model.segments; ++i) response.tension[i] = estimate(below, i).force;
    model.resolve_joints(response);
  }
  /// Whether the forces of a cable depend on no past: both agree in all of its segments, within a fifth of
  /// their deviation or by rounding.
  template <class CableLayout>
  bool is_wiped_out(const EstimatorType& below, const CableLayout& cable) const {
    if (!has_above(phase_)) return !is_unknown();
    for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
      const ForceEstimate<Scalar> a = below.estimate(i), b = above_.estimate(i);
      if (std::fabs(a.force - b.force) > Scalar(0.2) * a.deviation + Scalar(1e-5) * a.force) return false;
    }
    return true;
  }
  /// The estimator from above, while there is one.
  const EstimatorType& above() const { return above_; }

  // Saving.

  /// Of the estimator from above, between two rows. Cost: a copy.
  State save() const { return above_.save(); }
  /// Goes on in this phase where save() was called; `state` counts only if has_above(phase). Fails as
  /// Estimator::restore() does.
  template <class CondensedType, class PriorType, class Limits, class Gauges>
  Status restore(Phase phase, const State& state, const CondensedType& condensed, const PriorType& prior,
                 const Limits& limits, const Gauges& gauges) {
    phase_ = phase;
    if (!has_above(phase)) return Status::success();
    return above_.restore(condensed, prior, state, limits, gauges);
  }

 private:
  static constexpr Scalar interval = Scalar(1.96);

  static ForceEstimate<Scalar> between(Scalar least, Scalar most) {
    return {(least + most) / 2, (most - least) / (2 * interval)};
  }
  /// Not below `least`.
  static ForceEstimate<Scalar> either(const ForceEstimate<Scalar>& a, const ForceEstimate<Scalar>& b,
                                      Scalar least) {
    least = larger(-larger(-(a.force - interval * a.deviation), -(b.force - interval * b.deviation)), least);
    return between(least, larger(a.force + interval * a.deviation, b.force + interval * b.deviation));
  }

  EstimatorType above_;
  Phase phase_ = Phase::unread;
};

}  // namespace taut
