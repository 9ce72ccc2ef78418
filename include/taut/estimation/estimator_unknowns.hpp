// Which unknowns an estimator has: they are numbered once, and those of jacks' loads told to the tracker.
#pragma once

#include <cstddef>
#include <cstdint>

#include "taut/estimation/estimator_parts.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/status.hpp"

namespace taut {

/// Numbers the unknowns of friction and of instruments, and those that friction remembers. Fails with
/// `capacity_exceeded` as Estimator::start() does. Cost: two passes over the joints.
template <class Parts, class Cells>
Status number_unknowns(Parts& parts, const typename Parts::Condensed& condensed,
                       const typename Parts::PriorType& prior, const Cells& gauges) {
  const auto& linear = linear_part(condensed);
  auto& jacks = parts.jacks;
  auto& filter = parts.filter;
  const auto number = [&filter](bool is_uncertain) {
    return static_cast<std::int16_t>(is_uncertain ? filter.add_load_error() : -1);
  };
  jacks.start(linear, prior);
  Status known = filter.start(linear, prior);
  const auto corners = static_cast<std::size_t>(remembered_corners(load_patterns(linear), jacks.size()));
  for (std::size_t m = 0; m < jacks[0].memory.size(); ++m)
    for (int k = 0; k < jacks.size(); ++k)
      jacks[k].memory[m] = number(m < corners && jacks.in(prior.cell, k).sd > 0);
  const auto refuse = [&known](int c) {
    if (known) known = Status::at(Code::capacity_exceeded, Place::cable, c, 1);
  };
  for (int c = 0; c < linear.cables.size(); ++c) {
    parts.drift[c] = number(prior.drift_sd[c] > 0);
    if (prior.drift_sd[c] > 0 && parts.drift[c] < 0) refuse(c);
  }
  for (int k = 0; k < jacks.size(); ++k) {
    const int c = jacks.end(k).cable();
    jacks[k].seating = -1;
    if (!(prior.seating_sd[c] > 0)) continue;
    if constexpr (Parts::has_seating) {
      const auto seating = static_cast<typename Parts::Scalar>(linear.cables[c].seating);
      jacks[k].seating = static_cast<std::int16_t>(filter.add_draw_in(seating));
    }
    if (jacks[k].seating < 0) refuse(c);
  }
  for (int c = 0; !Parts::Cap::lags && c < linear.cables.size(); ++c)
    for (const auto& cell : prior.cell[c])
      if (cell.lag > 0) refuse(c);
  if (known) known = filter.end(linear, [&](const auto& add) { return parts.gauges.start(gauges, add); });
  parts.far_ends.start(linear, filter, jacks);
  return known;
}

/// The error of a jack's load that friction comes to rest at while other loads change: jack `k` has one.
template <class Parts>
JackError<typename Parts::Scalar> resting_error(const Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& at = parts.jacks.end(k);
  return {parts.jacks[k].at_rest, static_cast<std::int16_t>(2 * at.cable() + static_cast<int>(at.end)),
          Scalar(1), Scalar(0)};
}

/// Calls visit(JackError) for every unknown of the load cell of jack `k`.
template <class Parts, class Visit>
void for_each_cell_error(const Parts& parts, int k, const Visit& visit) {
  const auto& at = parts.jacks.end(k);
  parts.filter.instruments()
      .at(at.cable(), at.end)
      .for_each_error(parts.cell(k), 2 * at.cable() + static_cast<int>(at.end), parts.jacks[k].erred_up,
                      visit);
}

/// The same for every unknown that the force of jack `k` depends on.
template <class Parts, class Visit>
void for_each_load_error(const Parts& parts, int k, const Visit& visit) {
  for_each_cell_error(parts, k, visit);
  if (parts.jacks[k].at_rest >= 0) visit(resting_error(parts, k));
}

/// The unknowns that forces of jacks depend on.
template <class Parts>
auto load_errors(const Parts& parts) {
  using Error = JackError<typename Parts::Scalar>;
  FixedList<Error, 4 * Parts::JacksType::capacity> errors;
  for (int k = 0; k < parts.jacks.size(); ++k)
    for_each_load_error(parts, k, [&](const Error& error) { errors.add(error); });
  return errors;
}

/// Brings the tracker back to a state that it had with the model linearized where it is now. Fails as
/// Tracker::restore() does. Cost: that.
template <class Parts>
Status put_back(Parts& parts, const typename Parts::TrackerType::State& saved) {
  return parts.tracker.restore(parts.tracker.condensed(), parts.filter.friction(parts.linear()), saved,
                               load_errors(parts));
}

/// The force of jack `k` depends on its unknowns in another way from here on.
template <class Parts>
void change_errors(Parts& parts, int k) {
  for_each_load_error(parts, k, [&](const auto& error) { parts.tracker.change_load_error(error); });
}

/// A load that leaves the place of its last turn is read on the other branch from there on; the tracker is at
/// that place.
template <class Parts>
void change_branch(Parts& parts, int k) {
  auto& jack = parts.jacks[k];
  if (!jack.changes_branch()) return;
  jack.erred_up = jack.pulls;
  change_errors(parts, k);
}

}  // namespace taut
