// What is possible and yet surely a mistake, as a modulus in GPa.
#pragma once

#include <string>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// What is said at the end of every such refusal.
inline constexpr const char* remedy_if_meant =
    "; if it is meant, \"plausible\": false in the scene switches such checks off";

/// A cable that is strained by more is not elastic any more, or no cable.
inline constexpr double largest_plausible_strain = 0.02;

/// Where nothing strains its cable as much, forces are in another unit: a hundredth of the least that is
/// usual.
inline constexpr double least_plausible_strain = 1e-5;

/// What a first stage of a jacking strains its cable by, at least: less is next to no load.
inline constexpr double first_stage_strain = 1e-4;

/// Length of a cable along its nodes [m].
double length_of(const CableDescription& cable, const SceneDescription& scene);

/// Throws InputError, unless the scene says "plausible": false, if the modulus of a cable is not between 1e9
/// and 1e12 N/m2; that of a strut below 1e6 N/m2, unless its cross-section is above 1 m2, as of a spring with
/// E = 1; a prestrain above 2 %; a cable longer than 10 km; a wedge that is drawn in by more than 0.1 m;
/// friction of a capstan above 2; a relative standard deviation, or one of such friction, of 1 and more; a
/// load pattern that puts more than 1e10 N on a node or changes a temperature by more than 1000 K, in itself
/// or in the target of second-order theory; or a jack that pulls more than most_force_of() there.
void require_plausible(const SceneDescription& scene);

/// A tenth of E A: no cable carries more, for wires break at a few per cent of strain [N].
double most_force_of(const CableDescription& cable);

}  // namespace taut::host
