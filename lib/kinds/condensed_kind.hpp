// The kinds of condensed scenes that the program is compiled for.
#pragma once

#include "lib/files/result_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/capacities.hpp"
#include "taut/condensation/second_order.hpp"

namespace taut::host {

/// The same capacity for rigid saddles. Condensed with it, a scene has the bits that a device finds for a
/// capacity without struts, beams and substructures.
template <class Cap>
struct Rigid : Cap {
  static constexpr int struts = 0, beams = 0;
  static constexpr int substructures = 0, substructure_nodes = 0, substructure_entries = 0;
};

/// The same capacity in second-order theory.
template <class Cap>
struct Leaning : Cap {};

namespace detail {

template <class Scalar, class Cap>
struct CondensedFor {
  using Type = Condensed<Scalar, Cap>;
};
template <class Scalar, class Cap>
struct CondensedFor<Scalar, Leaning<Cap>> {
  using Type = SecondOrder<Scalar, Leaning<Cap>>;
};

}  // namespace detail

/// What a scene is condensed to.
template <class Scalar, class Cap>
using CondensedOf = typename detail::CondensedFor<Scalar, Cap>::Type;
template <class Scalar, class Cap>
using DisplacementsOf = typename CondensedOf<Scalar, Cap>::Displacements;
template <class Scalar, class Cap>
using StrutsOf = typename CondensedOf<Scalar, Cap>::Struts;

/// Whether nothing of the scene is elastic but its cables: no struts, no beams, no substructures, all nodes
/// held.
inline bool is_rigid(const SceneDescription& scene) {
  const unsigned all = (1U << scene.dimension) - 1U;
  for (const NodeDescription& node : scene.nodes)
    if ((node.held & all) != all) return false;
  return scene.struts.empty() && scene.beams.empty() && scene.substructures.empty();
}

/// Whether second-order theory makes a difference to the scene.
inline bool leans(const SceneDescription& scene) { return scene.second_order && !is_rigid(scene); }

/// What a scene is condensed and solved in.
template <class Number, int Dimension, class Cap>
struct CondensedKind {
  using Scalar = Number;
  static constexpr int dimension = Dimension;
  using Capacity = Cap;
};

namespace detail {

template <class Scalar, class Call, class List>
auto with_condensed_kind(const SceneDescription& scene, Call&& call, List capacities) {
  if (leans(scene))
    return with_capacity(
        scene,
        [&](auto kind) {
          using Kind = decltype(kind);
          return call(CondensedKind<Scalar, Kind::dimension, Leaning<typename Kind::Capacity>>{});
        },
        LargestCapacity{});
  return with_capacity(
      scene,
      [&](auto kind) {
        using Kind = decltype(kind);
        using Cap = typename Kind::Capacity;
        if (is_rigid(scene)) return call(CondensedKind<Scalar, Kind::dimension, Rigid<Cap>>{});
        return call(CondensedKind<Scalar, Kind::dimension, Cap>{});
      },
      capacities);
}

}  // namespace detail

/// Calls `call` with the CondensedKind of the scene in `scalar`, as with_capacity() does. Second-order theory
/// has the largest capacity alone, and so has float, in which a scene is computed to be compared with a
/// device.
template <class Call>
auto with_condensed_kind(const SceneDescription& scene, ScalarType scalar, Call&& call) {
  if (scalar == ScalarType::float32)
    return detail::with_condensed_kind<float>(scene, call, LargestCapacity{});
  return detail::with_condensed_kind<double>(scene, call, Capacities{});
}

}  // namespace taut::host
