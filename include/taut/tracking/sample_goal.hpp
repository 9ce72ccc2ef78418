// From a sample to the straight path that leads there: the goal of the loads, jacks that lock or take hold.
#pragma once

#include <cstddef>

#include "taut/scene/path.hpp"
#include "taut/scene/sample.hpp"
#include "taut/status.hpp"
#include "taut/tracking/cable_system.hpp"

namespace taut {

/// What a slack span has too much goes out through the jack: over every joint, if that is at its far end.
template <class Cables>
void draw_straight(Cables& cables, int r) {
  const typename Cables::Span& span = cables.spans[r];
  const auto& cable = cables.model->cables[span.cable];
  const bool at_start = span.segment(0) == cable.end_segment(0) && cable.ends[0] == End::jacked &&
                        !cables.state.goal.jack[span.cable][0].locked;
  cables.state.slack[r] = false;
  const auto straighten = [&](auto& moved) {
    for (int i = 0; !at_start && i < span.joints(); ++i) moved.slip[span.joint(i)] += moved.slack_length[r];
    moved.slack_length[r] = 0;
  };
  straighten(cables.state.moved);
  if constexpr (Cables::is_adjustable)
    cables.derivatives.for_each([&](auto& moved, int) { straighten(moved); });
}

/// Sets the goal; where a lock changes, also the present loads at the state reached.
template <class Cables>
void set_goal(Cables& cables, const Sample<typename Cables::Scalar, typename Cables::Cap>& sample) {
  using JackedEnd = typename Cables::JackedEnd;
  bool changes = false;
  for (const JackedEnd& jack : cables.jacks)
    changes = changes ||
              sample.jack[jack.cable][jack.end].locked != cables.state.goal.jack[jack.cable][jack.end].locked;
  if (changes) {
    cables.freeze();
    cables.find_forces();
  }
  const auto force = [&](int c, std::size_t end) {
    return cables.force[cables.model->cables[c].end_segment(end)];
  };
  const auto extension = [&](int c, std::size_t end) { return cables.state.moved.extension[c][end]; };
  set_path(cables.model->cables, cables.model->loads, sample, force, extension, cables.state.now,
           cables.state.goal);
  if (!changes) return;
  for (const JackedEnd& jack : cables.jacks)
    cables.state.now.jack[jack.cable][jack.end].locked = cables.state.goal.jack[jack.cable][jack.end].locked;
  cables.find_redundant_jack();
  // A jack that takes hold of a slack span draws it straight; its extension follows from its force.
  for (int r = 0; r < cables.spans.size(); ++r)
    if (cables.state.slack[r] && cables.is_jacked(cables.spans[r])) draw_straight(cables, r);
  cables.drop_set();
}

/// Turns to a sample, whose numbers check_sample() has passed: sets the goal, and drops the map where that
/// has not the loads which change. Fails with `pulled_through` (names the cable) if and only if two jacks on
/// one segment do not pull alike. Cost: a pass over jacks and loads, and where a lock changes that of
/// CableSystem::freeze().
template <class Cables>
Status turn_to(Cables& cables, const Sample<typename Cables::Scalar, typename Cables::Cap>& sample) {
  set_goal(cables, sample);
  for (const auto& jack : cables.jacks)
    if (cables.is_redundant(jack.cable, jack.end) && !cables.redundant_agrees(jack.cable))
      return Status::at(Code::pulled_through, Place::cable, jack.cable);
  for (int i = 0; i < cables.model->loads; ++i) {
    if (cables.state.has_load[i] || cables.state.goal.factor[i] == cables.state.now.factor[i]) continue;
    cables.find_forces();
    cables.freeze();
    cables.drop_map();
  }
  return Status::success();
}

}  // namespace taut
