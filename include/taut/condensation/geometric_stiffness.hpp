// Geometric stiffness: the forces whose lean second-order theory takes into account.
#pragma once

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// Linear theory: forces keep the directions that they have in the scene. Costs nothing.
struct NoGeometry {
  static constexpr int strut(int) { return 0; }
  static constexpr int beam(int) { return 0; }
  static constexpr int segment(int) { return 0; }
  static constexpr int substructure(int) { return 0; }
};

/// Forces of all bars at the target state, and the part of it at which stiffness is taken: K_E + tau K_G*,
/// Eq. (42).
template <class Real, class Cap>
struct GeometricStiffness {
  Real level = 0;                             ///< tau: of the forces at the target [-]
  FixedArray<Real, Cap::struts> strut_force;  ///< at the target [N], tension positive
  FixedArray<Real, Cap::beams> beam_force;    ///< at the target [N], tension positive
  /// At the target [N], by the length in the scene over that at the target: Eq. (42).
  FixedArray<Real, Cap::segments> segment_force;
  /// Geometric stiffness of substructures at the target [N/m], entry by entry as Scene::substructure_entries;
  /// null: they have none.
  const Real* substructure_entries = nullptr;

  Real strut(int i) const { return level * strut_force[i]; }
  Real beam(int i) const { return level * beam_force[i]; }
  Real segment(int i) const { return level * segment_force[i]; }
  Real substructure(int entry) const {
    return substructure_entries == nullptr ? Real(0) : level * substructure_entries[entry];
  }
};

}  // namespace taut
