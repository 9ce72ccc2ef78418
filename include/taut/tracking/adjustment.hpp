// A state whose friction turns out to be another one, or remembers something else from here on.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "taut/status.hpp"
#include "taut/tracking/constraints.hpp"

namespace taut {

/// Other joints slide from here on, or slips have changed: the forces follow, without
/// CableSystem::differentiate(). Fails with `mechanism`, at the joint that sets its node free, if one does.
/// Cost: that of one event.
template <class Cables>
Status find_forces_anew(Cables& cables) {
  cables.drop_set();
  Constraints<Cables> constraints(cables);
  if (!constraints.set_up()) return cables.at_joint(Code::mechanism, constraints.joint_without_pivot());
  constraints.make_map();
  cables.find_forces();
  return Status::success();
}
/// The same, with derivatives.
template <class Cables>
Status make_map_anew(Cables& cables) {
  const Status status = find_forces_anew(cables);
  if (status) cables.differentiate();
  return status;
}

/// Takes the slips where they are: another map follows.
template <class Cables>
void freeze_here(Cables& cables) {
  cables.find_forces();
  cables.freeze();
}

/// No joint of a cable slides from here on.
template <class Cables, class CableLayout>
void come_to_rest(Cables& cables, const CableLayout& cable) {
  freeze_here(cables);
  cables.drop_map();
  for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
    if (cables.can_slide(j)) cables.stop(j);
}

/// Moves all that has slipped by its derivative times the change of an unknown.
template <class Cables, class Derivative>
void shift(Cables& cables, const Derivative& derivative, typename Cables::Scalar change) {
  using Real = typename Cables::Real;
  const auto by = static_cast<Real>(change);
  auto& state = cables.state;
  for (int j = 0; j < cables.joints(); ++j) state.moved.slip[j] += by * static_cast<Real>(derivative.slip[j]);
  for (int r = 0; r < cables.spans.size(); ++r)
    state.moved.slack_length[r] =
        larger(Real(0), state.moved.slack_length[r] + by * static_cast<Real>(derivative.slack_length[r]));
  for (const auto& jack : cables.jacks) {
    const Real more = by * static_cast<Real>(derivative.extension[jack.cable][jack.end]);
    state.moved.extension[jack.cable][jack.end] += more;
    if (!state.goal.jack[jack.cable][jack.end].locked) continue;
    for (auto* loads : {&state.now, &state.goal, &state.built})
      loads->jack[jack.cable][jack.end].extension += more;
  }
}

/// Two jacks that pull a cable leave no force between joints that all slide, to either side: once `joint`
/// does, the nearest one that slides the other way sticks. Cost: a pass over the joints of the cable.
template <class Cables>
void leave_one_to_stick(Cables& cables, int joint) {
  if constexpr (max_jacks<typename Cables::Cap> < 2) return;
  auto& state = cables.state;
  const int c = cables.model->cable_of(cables.laws.sides(joint)[0]);
  int pulled = 0;
  for (const auto& jack : cables.jacks)
    pulled += jack.cable == c && !state.goal.jack[jack.cable][jack.end].locked ? 1 : 0;
  if (pulled < 2) return;
  const auto& cable = cables.model->cables[c];
  const auto slides = [&](int j) {
    return state.slides[j] == JointState::forward || state.slides[j] == JointState::backward;
  };
  int nearest = -1;
  for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
    if (!slides(j)) return;
    if (state.slides[j] == state.slides[joint]) continue;
    if (nearest < 0 || std::abs(j - joint) < std::abs(nearest - joint)) nearest = j;
  }
  if (nearest >= 0) cables.stop(nearest);
}

/// Joints that stick outside of their cone slide from here on. Returns whether there are any.
template <class Cables>
bool put_on_edge(Cables& cables) {
  bool any = false;
  for (int j = 0; j < cables.joints(); ++j) {
    if (!cables.can_slide(j)) continue;
    for (const JointState way : {JointState::forward, JointState::backward})
      if (cables.state.slides[j] == JointState::stick &&
          cables.laws.limit(SlipMode::of(j, way)).of(cables.force) < -cables.force_tolerance()) {
        cables.state.slides[j] = way;
        cables.state.order.add(static_cast<std::int16_t>(j));
        leave_one_to_stick(cables, j);
        any = true;
      }
  }
  return any;
}

/// Spans that no jack pulls, and would push, are slack from here on. Returns whether there are any.
template <class Cables>
bool let_slack(Cables& cables) {
  auto& state = cables.state;
  bool any = false;
  for (int r = 0; r < cables.spans.size(); ++r) {
    const auto& span = cables.spans[r];
    if (state.slack[r] || state.rests[r] || cables.is_jacked(span)) continue;
    for (int i = 0; i < span.count && !state.slack[r]; ++i)
      state.slack[r] = cables.force[span.segment(i)] < -cables.force_tolerance();
    any = any || state.slack[r];
  }
  if (!any) return false;
  const auto slid = state.order;
  state.order.clear();
  for (const std::int16_t j : slid) {
    if (cables.can_slide(j))
      state.order.add(j);
    else
      state.slides[j] = JointState::stick;
  }
  return true;
}

/// Brings the state to what it would be had every unknown been larger by `change[unknown]` all along, to
/// first order. Fails with `mechanism`, everything being as before but the map, where joints on their edges
/// leave a node free. Cost: that of one event, and of one more for every joint that is put on its edge and
/// every span that is let slack.
template <class Cables, class Changes>
Status change_unknowns(Cables& cables, const Changes& change) {
  cables.freeze();
  const auto before = cables.state;
  cables.derivatives.for_each([&](const auto& derivative, int p) { shift(cables, derivative, change[p]); });
  for (int count = 0; count <= cables.joints() + cables.spans.size(); ++count) {
    const Status status = find_forces_anew(cables);
    if (!status) {
      cables.state = before;
      return status;
    }
    if (!let_slack(cables) && !put_on_edge(cables)) break;
  }
  cables.differentiate();
  cables.state.peak = largest(cables.model->segments, &cables.force[0], cables.state.peak);
  return Status::success();
}

}  // namespace taut
