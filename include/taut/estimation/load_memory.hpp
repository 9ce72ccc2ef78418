// What friction remembers: errors of the loads at which jacks reversed, were locked, or rested.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/status.hpp"

namespace taut {

/// The memory of jack `k` that matters least to forces, of several the oldest; -1 if it has none. Cost: one
/// derivative a segment and memory.
template <class Parts>
int next_memory(Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  auto& jack = parts.jacks[k];
  const int corners = parts.corners();
  int found = jack.oldest;
  Scalar smallest = -1;
  for (int i = 0; i < corners; ++i) {
    const int slot = (jack.oldest + i) % corners, p = jack.memory[static_cast<std::size_t>(slot)];
    if (p < 0) return p;
    Scalar matters = 0;
    for (int s = 0; s < parts.model().segments; ++s) {
      const Scalar S = parts.tracker.sensitivity(p, s);
      matters += S * S * parts.filter.belief().variance(p);
    }
    if (smallest >= 0 && !(matters < smallest)) continue;
    smallest = matters;
    found = slot;
  }
  jack.oldest = (found + 1) % corners;
  return jack.memory[static_cast<std::size_t>(found)];
}

/// What friction remembers of the loads of jacks that rest where they turned begins here, of those with
/// leaves(k): until now their joints slid, and followed the loads as they are. Cost: that of Tracker::turn().
template <class Parts, class Leaves>
void leave_turns_of(Parts& parts, const Leaves& leaves) {
  using Scalar = typename Parts::Scalar;
  const auto error_of = [&](int k) {
    const auto& jack = parts.jacks[k];
    const auto& at = parts.jacks.in(parts.tracker.loads().jack, k);
    const bool rests = !at.locked && static_cast<Scalar>(at.force) == jack.turned_at;
    return rests && leaves(k) ? static_cast<int>(jack.at_turn) : -1;
  };
  bool any = false;
  for (int k = 0; k < parts.jacks.size(); ++k) any |= error_of(k) >= 0;
  if (any) parts.tracker.turn(error_of);
}

/// The tracker is about to go to `to`: jacks that are another load there, or locked, leave where they turned.
/// Cost: that of Tracker::turn().
template <class Parts>
void leave_turns(Parts& parts, const typename Parts::SampleType& to) {
  leave_turns_of(parts, [&](int k) {
    const auto& next = parts.jacks.in(to.jack, k);
    return next.locked || next.force != parts.jacks[k].turned_at;
  });
}

/// The same, where a row has it go there: of loads that go on, errors are those of the other branch from here
/// on. Cost: that of Tracker::turn().
template <class Parts>
void leave(Parts& parts, const typename Parts::SampleType& to) {
  leave_turns(parts, to);
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& at = parts.jacks.in(parts.tracker.loads().jack, k);
    const auto& next = parts.jacks.in(to.jack, k);
    if (at.locked != next.locked || static_cast<typename Parts::Scalar>(at.force) != next.force)
      change_branch(parts, k);
  }
}

/// Other loads change no longer: what friction remembers of jack `k` stays as it is.
template <class Parts>
void forget_other_loads(Parts& parts, int k) {
  auto& jack = parts.jacks[k];
  if (jack.at_rest < 0) return;
  leave_turns_of(parts, [](int) { return true; });
  // A failure shows on the way on.
  static_cast<void>(parts.tracker.end_load_error(jack.at_rest));
  jack.at_rest = -1;
  jack.rested_at = static_cast<typename Parts::Scalar>(parts.jacks.in(parts.tracker.loads().jack, k).force);
}

/// Jack `k` reverses or is locked where the tracker is now: once it leaves, friction will remember the error
/// of its load there, with the standard deviation `sd` [N]. Cost: that of FrictionFilter::renew(), and of
/// next_memory().
template <class Parts>
void remember_turn(Parts& parts, int k, typename Parts::Scalar sd) {
  using Scalar = typename Parts::Scalar;
  auto& jack = parts.jacks[k];
  const bool loads_change = jack.at_rest >= 0;
  if (loads_change) {
    // What slides follows the load as it is here.
    parts.tracker.change_load_error({jack.at_rest, -1, Scalar(0), Scalar(0)});
    jack.at_rest = -1;
  }
  if (!jack.locked && (parts.far_ends.ends().size() > 0 || parts.gauges.size() > 0))
    parts.filter.come_to_what_is_known(parts.tracker);
  jack.at_turn = static_cast<std::int16_t>(next_memory(parts, k));
  if (jack.at_turn < 0) return;
  jack.turned_at = static_cast<Scalar>(parts.jacks.in(parts.tracker.loads().jack, k).force);
  parts.is_belief_fine = false;
  if (loads_change && !jack.locked && jack.rests_beside) {
    std::swap(jack.at_rest, jack.at_turn);
    parts.filter.remember_load(parts.tracker, resting_error(parts, k), sd);
  } else {
    parts.filter.renew(parts.tracker, jack.at_turn, sd);
  }
}

template <class Parts>
bool changes_factors(const Parts& parts, const typename Parts::SampleType& sample) {
  for (int i = 0; i < parts.jacks.patterns(); ++i)
    if (sample.factor[i] != parts.jacks.factor(i)) return true;
  return false;
}

/// Whether another jack than `k` has gone on in this row, or its wedge is drawn in.
template <class Parts>
bool another_has_gone(const Parts& parts, int k) {
  for (int other = 0; other < parts.jacks.size(); ++other)
    if (other != k && (parts.jacks[other].moves.has_gone() || parts.jacks[other].locks_now)) return true;
  return false;
}

/// Whether all that depends on the error of jack `k` at rest depends on its load in the same way, where the
/// tracker is: nothing has come to rest at a load of before. Cost: two derivatives a segment.
template <class Parts>
bool follows_throughout(const Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  for (int s = 0; s < parts.model().segments; ++s) {
    const Scalar slope = parts.tracker.slope(k, s);
    if (std::fabs(parts.tracker.sensitivity(parts.jacks[k].at_rest, s) - slope) > Scalar(1e-3)) return false;
  }
  return true;
}

/// While other loads change, friction comes to rest at the loads that jacks have then, known or not. To a
/// jack at rest another jack's load is one, too, and so it is to one that may have turned, or that goes on
/// where the other one is found to have turned; it then rests beside it until it surely goes on itself. Cost:
/// a few operations a jack, and a pair of jacks.
template <class Parts>
void follow_other_loads(Parts& parts, const typename Parts::ReadingsType& readings,
                        Corners<typename Parts::Scalar>& corners) {
  const bool has_others = Parts::JacksType::capacity > 1 && parts.jacks.size() > 1;
  if (parts.jacks.patterns() == 0 && !has_others) return;
  const bool factors_change = changes_factors(parts, readings.sample);
  for (int k = 0; has_others && k < parts.jacks.size(); ++k)
    parts.jacks[k].follow_moves(readings.dt, parts.cell(k));
  for (int k = 0; k < parts.jacks.size(); ++k) {
    auto& jack = parts.jacks[k];
    if (jack.locked || jack.memory[0] < 0) continue;
    // Of a load that is none there is nothing to remember.
    const bool is_beside = has_others && !jack.may_idle(),
               meets_turn = is_beside && corners.reverses && !jack.has_reversed() && !jack.stays_taken(),
               rests = is_beside && jack.may_rest(),
               changes = factors_change || meets_turn || (rests && another_has_gone(parts, k));
    if (meets_turn && jack.at_rest < 0)
      jack.come_to_farthest(parts.cell(k));
    else if (changes)
      jack.come_to_best(parts.cell(k));
    if (changes && jack.at_rest >= 0) {
      if (follows_throughout(parts, k))
        parts.filter.know(jack.at_rest, parts.filter.belief().linearized_at(jack.at_rest), jack.come_sd);
      else
        parts.filter.widen(jack.at_rest, jack.come_sd);
    }
    jack.rests_beside = changes || (rests && jack.at_rest >= 0);
    corners.loads |= jack.changes_rest();
  }
}

/// Where jack `k` has come to its load of this row, and other loads begin to change or cease to. Cost: that
/// of FrictionFilter::remember_load(), and of next_memory().
template <class Parts>
void remember_load(Parts& parts, int k) {
  auto& jack = parts.jacks[k];
  if (jack.locked || jack.memory[0] < 0 || !jack.changes_rest()) return;
  if (!jack.rests_beside) return forget_other_loads(parts, k);
  jack.at_turn = -1;
  jack.at_rest = static_cast<std::int16_t>(next_memory(parts, k));
  parts.filter.remember_load(parts.tracker, resting_error(parts, k), jack.come_sd);
  parts.is_belief_fine = false;
}

/// How far the wedges were drawn in that hold since this row is not known exactly. Returns whether there are
/// any. Cost: that of FrictionFilter::remember_seating() for each.
template <class Parts>
bool remember_seating(Parts& parts) {
  if constexpr (!Parts::has_seating) return false;
  bool any = false;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& jack = parts.jacks[k];
    if (!jack.locks_now || jack.seating < 0) continue;
    const auto& at = parts.jacks.end(k);
    parts.filter.remember_seating(parts.tracker, jack.seating, at.cable(), at.end,
                                  parts.filter.prior().seating_sd[at.cable()]);
    any = true;
  }
  return any;
}

/// Cables that are held since this row drift from here on. Fails as Tracker::strain() does. Cost: that for
/// each.
template <class Parts>
Status remember_drift(Parts& parts) {
  Status status = Status::success();
  for (int k = 0; k < parts.jacks.size() && status; ++k) {
    const auto& at = parts.jacks.end(k);
    if (parts.jacks[k].locks_now && parts.drifts(at.cable()))
      status = parts.filter.remember_drift(parts.tracker, parts.drift[at.cable()], at.cable(), at.end);
  }
  return status;
}

}  // namespace taut
