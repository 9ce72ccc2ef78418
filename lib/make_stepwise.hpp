// Models that use the method `stepwise`.
#pragma once

#include <memory>

#include "lib/model.hpp"

namespace taut::host {

/// A model of the scene with the solver Stepwise<Scalar, Scene<double, Dimension, Cap>>. Compiled for each in
/// a unit of its own.
template <class Scalar, int Dimension, class Cap>
std::unique_ptr<Model> make_stepwise(const SceneDescription& scene);

}  // namespace taut::host
