// What an estimator consists of, and what can be said of all of it at once.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/alarms.hpp"
#include "taut/estimation/between_jacks.hpp"
#include "taut/estimation/beyond_friction.hpp"
#include "taut/estimation/far_ends.hpp"
#include "taut/estimation/following_jack.hpp"
#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/force_watch.hpp"
#include "taut/estimation/friction_filter.hpp"
#include "taut/estimation/gauges.hpp"
#include "taut/estimation/held_reading.hpp"
#include "taut/estimation/jack_loads.hpp"
#include "taut/estimation/joint_reach.hpp"
#include "taut/estimation/lagging_reading.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/estimation/row_strokes.hpp"
#include "taut/estimation/sliding_way.hpp"
#include "taut/estimation/turned_forces.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// The state of an Estimator: the tracker with its filters, and the flags that its stages share. The stages
/// are functions of it, each in a file of its own; what is here changes nothing.
template <class CondensedType, int Parameters, int Further>
struct EstimatorParts : CondensedType::Capacity::Account {
  using Condensed = CondensedType;
  using Scalar = typename CondensedType::Scalar;
  using Cap = typename CondensedType::Capacity;
  using Account = typename Cap::Account;
  using TrackerType = Tracker<CondensedType, Parameters>;
  using PriorType = FrictionPrior<Scalar, Cap>;
  using ReadingsType = Readings<Scalar, Cap>;
  using SampleType = Sample<Scalar, Cap>;
  using FilterType = FrictionFilter<CondensedType, Parameters, Further>;
  using JacksType = JackLoads<Scalar, Cap, remembered_corners(Cap::loads, max_jacks<Cap>)>;
  /// Where the tracker is driven to, by jack.
  using Drives = FixedArray<Jack<Scalar>, JacksType::capacity>;
  using FarEndsType = FarEnds<FilterType, JacksType>;
  using GaugesType = Gauges<Scalar, Further, Cap::lags>;
  using HeldCellsType = HeldCells<Scalar, Cap>;
  using LaggingCellsType = LaggingCells<Scalar, Cap>;
  using SlidingWayType = SlidingWay<Scalar, Cap::cables>;
  using ForceWatchType = ForceWatch<Scalar, Cap::segments>;
  using Strokes = RowStrokes<Scalar, JacksType::capacity == 1 ? 0 : Cap::cables>;
  using FollowingJacks = FixedArray<FollowingJack<Scalar>, JacksType::capacity == 1 ? 0 : Cap::cables>;
  using TurnedForcesType = TurnedForces<Scalar, Cap, Parameters>;
  using Alarms = FixedList<Alarm, 8 + 5 * Cap::cables + Cap::joints + Cap::segments>;
  using EndType = CableEnd<Cap>;

  /// Where the loads are confirmed to have come, while the tracker looks ahead.
  struct Confirmed {
    typename TrackerType::State tracker;
    Drives jack;
  };

  using Values = typename FilterType::Values;
  static constexpr int unknowns = Parameters + Further;

  /// Where the way of a jack began that it is on, see begin_leg().
  struct Leg {
    typename TrackerType::State from;
    Values linearized_at;                            ///< where the model was linearized there
    FixedArray<bool, JacksType::capacity> erred_up;  ///< the branches that loads were read on there
    bool is_known = false;
  };
  /// By how much further a jack's wedge is drawn in than the model has it [m].
  using DrawnFurther = FixedArray<Scalar, JacksType::capacity>;
  /// Where wedges were about to be drawn in, see begin_lock_off(): confirmed.tracker is there.
  struct LockOff {
    /// By the cell at the far end of a cable, since then.
    struct Read {
      Scalar sum;  ///< [N]
      std::int16_t readings;
      bool is_elsewhere;  ///< the last one was, and does not count
    };
    Values linearized_at;   ///< where the model was linearized there
    DrawnFurther still_in;  ///< how much of an earlier draw-in a jack's unknown has [-]
    FixedArray<Read, Cap::cables> read;
    bool is_known = false;
  };
  static constexpr bool has_several = Cap::cables > 1;
  /// Whether it may be unknown how far a wedge is drawn in.
  static constexpr bool has_seating = Cap::seating;
  /// Only strokes are compared all along it.
  static constexpr int legs = Cap::strokes && Further > 0 ? 1 : 0;

  // What every row needs comes first: instructions reach it directly.
  AlarmLimits<Scalar> limits = {0, 0, 0, 0, 0, 0, 0};  ///< all zeros until start(): no flash to copy from
  bool is_belief_fine = false;  ///< nothing is odd about what is believed of friction and gains
  FarEndsType far_ends;
  FixedArray<std::int16_t, Cap::cables> drift;  ///< unknown strains of cables, or -1
  JacksType jacks;
  TrackerType tracker;
  FilterType filter;
  GaugesType gauges;
  HeldCellsType held;
  LaggingCellsType lagging;
  Strokes strokes;
  SlidingWayType sliding_way;
  ForceWatchType forces;
  TurnedForcesType turned;
  FollowingJacks following;
  Alarms alarms;
  Confirmed confirmed;
  FixedArray<Leg, legs> leg;
  LockOff lock_off;
  bool is_ahead = false;  ///< of what is confirmed
  /// Where the loads are confirmed to have come: whether the best estimate of a jack of the cable lies behind
  /// an event that may be one of its own joints.
  FixedArray<bool, Cap::cables> is_beyond;
  /// Whether a cable slid throughout where the tracker was ahead in the row before.
  FixedArray<bool, has_several ? Cap::cables : 0> slides_ahead;
  bool misfits = false;  ///< some load cell at an anchored end is off the model

  const auto& model() const { return tracker.model(); }
  /// The scene without second-order theory.
  const auto& linear() const { return linear_part(tracker.condensed()); }
  int patterns() const { return load_patterns(model()); }
  /// Of a jack.
  int corners() const { return remembered_corners(patterns(), jacks.size()); }
  static Alarm alarm_at(Alarm::Kind kind, const EndType& at) {
    return Alarm::of(kind, at.cable(), static_cast<int>(at.end));
  }

  // Of jack `k`.

  int end_segment(int k) const { return jacks.end(k).segment(model()); }
  Scalar most_force(int k) const { return model().most_force[jacks.end(k).cable()]; }
  const LoadCell<Scalar>& cell(int k) const { return jacks.in(filter.prior().cell, k); }
  /// Whether it strains its cable by AlarmLimits::initial_strain. It carries at most a tenth of E A.
  bool is_bedded(int k) const {
    return jacks[k].at.load >= limits.initial_strain * Scalar(1 / breaking_strain) * most_force(k);
  }

  /// Whether there are any beside the jacks' own.
  bool has_instruments() const { return far_ends.ends().size() > 0 || gauges.size() > 0; }
  /// What all jacks pull where the tracker is, or was when they were locked [N].
  Scalar sum_of_loads() const {
    Scalar sum = 0;
    for (int k = 0; k < jacks.size(); ++k) sum += jacks[k].driven.force;
    return sum;
  }

  // Of cable `c`.

  /// Whether all jacks that pull it strain it by AlarmLimits::initial_strain.
  bool is_cable_bedded(int c) const {
    for (int k = 0; k < jacks.size(); ++k)
      if (jacks.end(k).cable() == c && !jacks[k].locked && !is_bedded(k)) return false;
    return true;
  }
  /// Whether it surely slides throughout, with friction as well as it is known. Cost: a pass over its joints.
  bool surely_slides(int c) const {
    // Where nobody saw a load turn, joints begin to slide as much sooner or later.
    Scalar unseen = 0;
    for (int k = 0; k < jacks.size(); ++k)
      if (jacks[k].turned_unseen && jacks.end(k).cable() == c) unseen += jacks[k].turn_sd;
    return sliding_way.surely_slides(c, filter.relative_deviation(tracker, c), unseen);
  }
  /// Whether forces teach its friction: it surely slides throughout, on the present piece.
  bool teaches(int c) const { return !is_beyond[c] && surely_slides(c); }

  /// Whether all its jacks are locked, if there are any.
  bool is_held(int c) const {
    for (int k = 0; k < jacks.size(); ++k)
      if (jacks.end(k).cable() == c && !jacks[k].locked) return false;
    return true;
  }
  /// Whether a wedge that holds it may have held before the log says so, see may_have_held_before().
  bool is_locked_late(int c) const {
    for (int k = 0; k < jacks.size(); ++k)
      if (jacks.end(k).cable() == c && jacks[k].locked_late) return true;
    return false;
  }
  /// Whether it drifts: its strain does where wedges hold it.
  bool drifts(int c) const { return drift[c] >= 0 && is_held(c); }
  /// Whether a cell at its far end tells how far wedges were drawn in that hold it, or how it drifts.
  bool is_corrected(int c) const {
    bool is_uncertain = drift[c] >= 0;
    for (int k = 0; has_seating && k < jacks.size(); ++k)
      is_uncertain |= jacks.end(k).cable() == c && jacks[k].seating >= 0;
    return is_uncertain && is_held(c);
  }

  // What is read.

  /// Whether an end was read, and no more than its cable can carry.
  bool can_be(const EndReading<Scalar>& given, int cable) const {
    return given.has_force && std::fabs(given.force) <= model().most_force[cable];
  }
  /// Whether what is read of a cable cannot be compared with what its own jacks would make of it, for their
  /// loads may be others; any jack counts if `cable` is negative.
  bool loads_are_in_doubt(int cable = -1) const {
    return jacks.are_in_doubt(cable) || (held.any_may_be_old() && may_be_old(cable));
  }
  /// Whether what was read of a jack may be its load of before; any jack that surely pulls counts if `cable`
  /// is negative.
  [[gnu::noinline]] bool may_be_old(int cable) const {
    for (int k = 0; k < jacks.size(); ++k) {
      const int c = jacks.end(k).cable();
      const bool counts = cable < 0 ? !jacks[k].may_idle() : c == cable;
      if (counts && !jacks[k].locked && held.may_be_old(c, jacks.end(k).end)) return true;
    }
    return false;
  }
  /// Whether it is known of all its jacks that are not locked what they pull.
  bool loads_are_read(int c) const {
    if (held.any_may_be_old() && may_be_old(c)) return false;
    for (int k = 0; k < jacks.size(); ++k)
      if (jacks.end(k).cable() == c && !jacks[k].locked && !jacks[k].at.is_sure()) return false;
    return true;
  }
  /// Whether the tracker pulls less than one of two jacks of a cable does, as much as friction holds where it
  /// is: the state that it has there, pulled through, is not that of the cable. Any cable counts if `cable`
  /// is negative.
  bool is_held_back(int cable) const {
    if constexpr (JacksType::capacity < 2) return false;
    for (int k = 0; k < jacks.size(); ++k) {
      const int c = jacks.end(k).cable();
      const auto pulls = jacks.pulls(c);
      if ((cable < 0 || c == cable) && pulls[0] && pulls[1] && jacks[k].leads() &&
          jacks[k].beyond() > 3 * jacks[k].at.sd && !tracker.reaches(k, jacks[k].best()))
        return true;
    }
    return false;
  }
  /// Whether what is read of a cable can teach anything.
  bool can_teach(int cable) const {
    return filter.belief().has_friction() && !loads_are_in_doubt(cable) && !is_held_back(cable);
  }
  /// Forces teach nothing of a cable for whose own jacks the tracker is ahead: what is read belongs to no
  /// place that is confirmed. `cable` is negative if they are of no cable in particular.
  bool can_learn(int cable) const { return can_teach(cable) && !(is_ahead && is_all_beyond(cable)); }
  bool is_all_beyond(int cable) const {
    if (cable >= 0) return is_beyond[cable];
    for (int c = 0; c < model().cables.size(); ++c)
      if (!is_beyond[c]) return false;
    return true;
  }

  // What is known of a segment.

  Scalar force(int segment) const {
    return estimate_force<false>(tracker, jacks, filter, turned, segment).force;
  }
  /// The force of a segment with its deviation, all joints being as they are where the tracker is.
  ForceEstimate<Scalar> estimate_segment(int segment) const {
    return estimate_force<true>(tracker, jacks, filter, turned, segment);
  }
  /// The force of a segment with its deviation: joints that slide where the tracker is may stick, and the
  /// other way round. In a cable whose cells are off the model, the deviation is wider by that. Beside other
  /// loads it reaches to what friction can hold, see beyond_friction().
  ForceEstimate<Scalar> estimate(int segment) const {
    auto estimate = estimate_segment(segment);
    const Scalar reached = deviation_by_reach(*this, segment, estimate.force);
    Scalar kept = 0;
    // While it sticks, what a far end has taught of it since counts, too.
    if (far_ends.ends().size() == 0 || turned.has_gone_on(segment, estimate.force) ||
        is_locked_late(model().cable_of(segment)))
      kept = turned.deviation_by_loads(segment, estimate.force);
    estimate.deviation = larger(estimate.deviation, larger(reached, kept));
    if (may_be_beyond_friction(*this))
      estimate.deviation = larger(estimate.deviation, beyond_friction(*this, segment, estimate.force));
    estimate.deviation = larger(estimate.deviation, deviation_between_jacks(*this, segment, estimate.force));
    if (misfits) {
      const Scalar misfit = far_ends.misfit(model().cable_of(segment));
      estimate.deviation = std::sqrt(estimate.deviation * estimate.deviation + misfit * misfit);
    }
    return estimate;
  }
};

}  // namespace taut
