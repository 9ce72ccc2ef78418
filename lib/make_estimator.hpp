// Models that use the method `estimate`.
#pragma once

#include <memory>

#include "lib/model.hpp"

namespace taut::host {

/// A model of the scene with the solver Estimator<Condensed<Scalar, Cap>>. Compiled for each in a unit of its
/// own.
template <class Scalar, class Cap>
std::unique_ptr<Model> make_estimator(const SceneDescription& scene, const AlarmLimits<double>& limits);

}  // namespace taut::host
