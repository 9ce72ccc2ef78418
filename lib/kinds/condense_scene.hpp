// Condensation of scenes of every kind the program is compiled for.
#pragma once

#include "lib/files/scene_description.hpp"
#include "lib/kinds/condensed_kind.hpp"
#include "taut/condensation/condensed.hpp"
#include "taut/estimation/friction_prior.hpp"
#include "taut/status.hpp"

namespace taut::host {

/// What condensation says of a structure.
struct Condensing {
  Status status;
  double condition = 1;  ///< see Structure::condition()
};

/// Condenses a scene, its strut forces and, if given, the displacements that it asks for and those that are
/// watched; the factor of the structure is freed. Throws InputError if the scene cannot be used. `Cap` is a
/// capacity of the program, or Rigid or Leaning of one. Compiled for each dimension and capacity in a unit of
/// its own.
template <class Scalar, int Dimension, class Cap>
Condensing condense_scene(const SceneDescription& scene, CondensedOf<Scalar, Cap>& condensed,
                          StrutsOf<Scalar, Cap>& struts,
                          DisplacementsOf<Scalar, Cap>* displacements = nullptr);

/// What the scene says of friction and load cells, for an Estimator. Compiled with condense_scene().
template <class Scalar, int Dimension, class Cap>
void know_scene(const SceneDescription& scene, FrictionPrior<Scalar, Cap>& prior);

}  // namespace taut::host
