#include "lib/commands/member_turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lib/kinds/capacities.hpp"
#include "lib/kinds/condensed_kind.hpp"

namespace taut::host {
namespace {

bool moves(const SceneDescription& scene, int node, int axis) {
  return ((scene.nodes[static_cast<std::size_t>(node)].held >> static_cast<unsigned>(axis)) & 1U) == 0;
}

}  // namespace

std::vector<DisplacementDescription> MemberTurns::watched(const SceneDescription& scene) {
  std::vector<DisplacementDescription> all;
  if (is_rigid(scene)) return all;
  std::vector<bool> is_taken(scene.nodes.size());
  const auto take = [&](int node) {
    const bool has_room = all.size() + static_cast<std::size_t>(scene.dimension) <=
                          static_cast<std::size_t>(most_watched_displacements);
    if (is_taken[static_cast<std::size_t>(node)] || !has_room) return;
    is_taken[static_cast<std::size_t>(node)] = true;
    for (int axis = 0; axis < scene.dimension; ++axis)
      if (moves(scene, node, axis)) all.push_back({node, axis});
  };
  for (const CableDescription& cable : scene.cables)
    for (const int node : cable.path) take(node);
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) take(static_cast<int>(node));
  return all;
}

MemberTurns::MemberTurns(const SceneDescription& scene) : scene_(scene) {
  // A node is known if all of its directions are watched in which it moves.
  std::vector<int> unknown(scene.nodes.size());
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (int axis = 0; axis < scene.dimension; ++axis)
      unknown[node] += moves(scene, static_cast<int>(node), axis) ? 1 : 0;
  for (const DisplacementDescription& each : scene.watched) --unknown[static_cast<std::size_t>(each.node)];
  const auto add = [&](int a, int b) {
    if (unknown[static_cast<std::size_t>(a)] == 0 && unknown[static_cast<std::size_t>(b)] == 0)
      add_member(a, b);
  };
  for (const StrutDescription& strut : scene.struts) add(strut.nodes[0], strut.nodes[1]);
  for (const BeamDescription& beam : scene.beams)
    for (std::size_t i = 0; i < beam.members(); ++i) add(beam.nodes[i], beam.nodes[i + 1]);
  for (const CableDescription& cable : scene.cables)
    for (std::size_t i = 0; i < cable.segments(); ++i)
      add(cable.path[i], cable.path[(i + 1) % cable.path.size()]);
}

void MemberTurns::add_member(int a, int b) {
  const auto &from = scene_.nodes[static_cast<std::size_t>(a)].at,
             &to = scene_.nodes[static_cast<std::size_t>(b)].at;
  double squared = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene_.dimension); ++axis)
    squared += (to[axis] - from[axis]) * (to[axis] - from[axis]);
  members_.push_back({{a, b}, std::sqrt(squared)});
}

bool MemberTurns::are_wanted(const LogRow& row) {
  constexpr double beyond = 0.02;
  if (members_.empty()) return false;
  bool are = range_.empty();
  std::size_t next = 0;
  const auto look = [&](double number) {
    if (next == range_.size()) range_.push_back({number, number});
    auto& [least, most] = range_[next++];
    const double room = beyond * std::max(std::fabs(least), std::fabs(most));
    if (number < least - room || number > most + room) are = true;
  };
  const auto widen = [&](double number) {
    auto& [least, most] = range_[next++];
    least = std::min(least, number);
    most = std::max(most, number);
  };
  const auto each = [&](const auto& visit) {
    next = 0;
    for (const double factor : row.factor) visit(factor);
    for (const auto& cable : row.cables)
      for (const EndRow& end : cable) visit(end.force);
  };
  each(look);
  if (are) each(widen);
  return are;
}

std::optional<MemberTurn> MemberTurns::largest(const std::vector<double>& displacements) const {
  if (displacements.size() != scene_.watched.size() || members_.empty()) return std::nullopt;
  std::vector<std::array<double, 3>> moved(scene_.nodes.size());
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    const DisplacementDescription& each = scene_.watched[i];
    moved[static_cast<std::size_t>(each.node)][static_cast<std::size_t>(each.axis)] = displacements[i];
  }
  const auto size = [](const std::array<double, 3>& u) { return std::hypot(u[0], u[1], u[2]); };
  MemberTurn most;
  for (const Member& member : members_) {
    const auto &a = moved[static_cast<std::size_t>(member.nodes[0])],
               &b = moved[static_cast<std::size_t>(member.nodes[1])];
    const double turn = size({b[0] - a[0], b[1] - a[1], b[2] - a[2]}) / member.length;
    if (!(turn > most.turn)) continue;
    const bool is_first = size(a) >= size(b);
    most = {member.nodes[is_first ? 0 : 1], member.nodes[is_first ? 1 : 0], std::max(size(a), size(b)), turn};
  }
  return most;
}

}  // namespace taut::host
