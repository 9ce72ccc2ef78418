// The condensed scene: the few arrays that a running controller needs.
#pragma once

#include <type_traits>

#include "taut/numerics/wide.hpp"
#include "taut/scene/fixed_list.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// Whether scenes of this capacity have nothing elastic but their cables.
template <class Cap>
constexpr bool has_rigid_saddles = Cap::struts == 0 && Cap::substructures == 0;

/// Tensions of all segments from elongations imposed on them, all joints stuck: a symmetric matrix [N/m].
template <class Scalar, int Segments>
struct ElasticCoupling {
  FixedArray<Scalar, Segments * Segments> entries;

  constexpr Scalar operator()(int i, int k) const { return entries[i * Segments + k]; }
  constexpr void set(int i, int k, Scalar value) { entries[i * Segments + k] = value; }
  /// T += coupling x e, for n segments.
  template <class Vector>
  void add(int n, const Vector& e, Vector& T) const {
    for (int k = 0; k < n; ++k)
      if (e[k] != 0)
        for (int i = 0; i < n; ++i) T[i] += entries[k * Segments + i] * e[k];
  }
};

/// The same between rigid saddles: EA/L of each segment, which knows nothing of the others.
template <class Scalar, int Segments>
struct NoCoupling {
  FixedArray<Scalar, Segments> axial;

  constexpr Scalar operator()(int i, int k) const { return i == k ? axial[i] : Scalar(0); }
  constexpr void set(int i, int k, Scalar value) {
    if (i == k) axial[i] = value;
  }
  template <class Vector>
  void add(int n, const Vector& e, Vector& T) const {
    for (int i = 0; i < n; ++i) T[i] += axial[i] * e[i];
  }
};

/// A scene after static condensation of its structure.
///
/// T = load x factors + prestrain + coupling x e, where e is the elongation imposed on each segment by what
/// moves along the cable: e_i = delta_i - delta_{i-1} + payout at a jacked end + slack. An aggregate: it can
/// be a constant in flash.
///
/// The numbers are double for a tracker in float too: what is redundant in a structure makes rows that all
/// but depend on one another, and rounded one by one they would contradict.
template <class Scalar_, class Cap>
struct Condensed {
  using Scalar = Scalar_;
  using Capacity = Cap;
  using Real = Wide<Scalar>;
  using Coupling = std::conditional_t<has_rigid_saddles<Cap>, NoCoupling<Real, Cap::segments>,
                                      ElasticCoupling<Real, Cap::segments>>;

  FixedList<CableLayout<Scalar>, Cap::cables> cables;
  int segments = 0;
  int joints = 0;
  int loads = 0;
  Coupling coupling;
  FixedArray<Real, Cap::segments> prestrain;                     ///< tensions from prestrain alone [N]
  FixedArray<FixedArray<Real, Cap::segments>, Cap::loads> load;  ///< tensions from a unit factor [N]
  FixedArray<Real, Cap::joints> rho;          ///< smallest T_small / T_big of every joint; 0: locked
  FixedArray<Scalar, Cap::joints> cos_alpha;  ///< half the angle between the segments, for N and f
  FixedArray<Scalar, Cap::joints> sin_alpha;

  constexpr bool is_locked(int joint) const { return !(rho[joint] > 0); }
};

/// On request: the rows that give strut forces, S = load x factors + prestrain + elongation x e [N].
template <class Scalar, class Cap>
struct CondensedStruts {
  using Real = Wide<Scalar>;

  FixedArray<FixedArray<Real, Cap::struts>, Cap::loads> load;
  FixedArray<Real, Cap::struts> prestrain;
  FixedArray<FixedArray<Real, Cap::struts>, Cap::segments>
      elongation;  ///< for a unit elongation of each segment [N/m]
};

}  // namespace taut
