// Models of one kind: each is compiled in a unit of its own.
#pragma once

#include <memory>

#include "lib/kinds/model.hpp"

namespace taut::host {

/// A model of the scene with the solver Tracker<Condensed<Scalar, Cap>>.
template <class Scalar, class Cap>
std::unique_ptr<Model> make_tracker(const SceneDescription& scene);

/// A model of the scene with the solver Estimator<Condensed<Scalar, Cap>>.
template <class Scalar, class Cap>
std::unique_ptr<Model> make_estimator(const SceneDescription& scene, const AlarmLimits<double>& limits);

/// A model of the scene with the solver Stepwise<Scalar, Scene<double, Dimension, Cap>>.
template <class Scalar, int Dimension, class Cap>
std::unique_ptr<Model> make_stepwise(const SceneDescription& scene);

}  // namespace taut::host
