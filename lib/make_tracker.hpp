// Models that use the method `tracker`.
#pragma once

#include <memory>

#include "lib/model.hpp"

namespace taut::host {

/// A model of the scene with the solver Tracker<Condensed<Scalar, Cap>>. Compiled for each in a unit of its
/// own.
template <class Scalar, class Cap>
std::unique_ptr<Model> make_tracker(const SceneDescription& scene);

}  // namespace taut::host
