// The capacity classes of the program, and the choice of one for a scene.
#pragma once

#include <array>
#include <cstddef>

#include "lib/files/scene_description.hpp"
#include "lib/kinds/friction_account.hpp"
#include "taut/scene/capacity.hpp"

namespace taut::host {

/// Displacements that can be asked for at once, and how many are looked at beside them.
constexpr int most_displacements = 48, most_watched_displacements = 336;

struct Small : Capacity {
  static constexpr const char* name = "small";
  static constexpr int nodes = 24, struts = 64, beams = 32, cables = 4, segments = 16, joints = 12;
  static constexpr int substructures = 4, substructure_nodes = 8, substructure_entries = 576;
  static constexpr int loads = 8, forces = 64, temperatures = 8;
  static constexpr int displacements = most_displacements + 3 * nodes;
  using Account = FrictionAccount;
};

struct Large : Capacity {
  static constexpr const char* name = "large";
  static constexpr int nodes = 512, struts = 2048, beams = 1024, cables = 64, segments = 256, joints = 128;
  static constexpr int substructures = 128, substructure_nodes = 256, substructure_entries = 147456;
  static constexpr int loads = 32, forces = 2048, temperatures = 512;
  static constexpr int displacements = most_displacements + most_watched_displacements;
  using Account = FrictionAccount;
};

template <class... Caps>
struct CapacityList {};

/// The classes that the program is compiled for, the smallest first: CMake's TAUT_CAPACITIES.
using Capacities = CapacityList<TAUT_CAPACITIES>;
/// That of the method `stepwise`, which is a reference and need not be fast.
using LargestCapacity = CapacityList<Large>;

/// Load cells whose gain, zero and turning points may be unknown: so many at jacks, and as many others.
constexpr int most_unknown_cells = 32;

/// Numbers of everything that a capacity counts, in the order of `amount_names`.
constexpr std::size_t amount_count = 12;
using Amounts = std::array<std::size_t, amount_count>;

/// What is counted, in words, and where it is in a scene file.
struct AmountName {
  const char* noun;
  const char* place;
};
extern const std::array<AmountName, amount_count> amount_names;

/// What a scene needs.
Amounts needs(const SceneDescription& scene);

/// What a capacity holds.
template <class Cap>
constexpr Amounts holds() {
  const std::array<int, amount_count> counts = {
      Cap::nodes,
      Cap::struts,
      Cap::beams,
      Cap::cables,
      Cap::segments,
      Cap::joints,
      Cap::substructures,
      Cap::substructure_nodes,
      Cap::substructure_entries,
      Cap::loads,
      Cap::forces,
      Cap::temperatures,
  };
  Amounts amounts{};
  for (std::size_t i = 0; i < amounts.size(); ++i) amounts[i] = static_cast<std::size_t>(counts[i]);
  return amounts;
}

/// Whether nothing is needed beyond what there is.
bool fits(const Amounts& needed, const Amounts& held);

/// Throws InputError: even the largest capacity does not hold the scene.
[[noreturn]] void refuse_too_large(const SceneDescription& scene, const Amounts& needed, const Amounts& held);

/// The type of scene to compile for.
template <int Dimension, class Cap>
struct SceneKind {
  static constexpr int dimension = Dimension;
  using Capacity = Cap;
};

namespace detail {

template <int Dimension, class Call, class Cap, class... Larger>
auto with_capacity(const SceneDescription& scene, Call&& call, CapacityList<Cap, Larger...>) {
  const Amounts needed = needs(scene);
  if (fits(needed, holds<Cap>())) return call(SceneKind<Dimension, Cap>{});
  if constexpr (sizeof...(Larger) > 0)
    return with_capacity<Dimension>(scene, call, CapacityList<Larger...>{});
  else
    refuse_too_large(scene, needed, holds<Cap>());
}

}  // namespace detail

/// Calls `call` with the SceneKind of the scene's dimension and the smallest of the capacities that holds it;
/// returns what it returns, which must be of one type. Throws InputError if none holds it.
template <class Call, class List = Capacities>
auto with_capacity(const SceneDescription& scene, Call&& call, List capacities = {}) {
  if (scene.dimension == 2) return detail::with_capacity<2>(scene, call, capacities);
  return detail::with_capacity<3>(scene, call, capacities);
}

}  // namespace taut::host
