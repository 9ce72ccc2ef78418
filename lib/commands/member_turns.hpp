// By how much members turn: where that is no small angle, displacements are no small ones.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// A strut, a piece of a beam or a segment of a cable that has turned.
struct MemberTurn {
  int node = 0, other = 0;  ///< its ends: first the one that has moved further
  double displacement = 0;  ///< of `node` [m]
  double turn = 0;          ///< by how much its ends have moved against each other, as a part of its length
};

/// Looks at displacements in those rows of a log that go beyond what was looked at before.
class MemberTurns {
 public:
  /// The displacements that are needed, for SceneDescription::watched: of the nodes of cables first, then of
  /// all others, as many as there is room for.
  static std::vector<DisplacementDescription> watched(const SceneDescription& scene);

  /// The description must outlive it.
  explicit MemberTurns(const SceneDescription& scene);

  /// Whether a load factor or the force of a jack is beyond all those for which it was, by a fiftieth of the
  /// largest. Cost: a comparison each.
  bool are_wanted(const LogRow& row);
  /// The member that has turned most; `displacements` are those of SceneDescription::watched [m]. Nothing
  /// where they are not known.
  std::optional<MemberTurn> largest(const std::vector<double>& displacements) const;

 private:
  struct Member {
    std::array<int, 2> nodes;
    double length;
  };
  void add_member(int a, int b);

  const SceneDescription& scene_;
  std::vector<Member> members_;               // both of whose ends are watched or held
  std::vector<std::array<double, 2>> range_;  // of every factor, then of every jack
};

}  // namespace taut::host
