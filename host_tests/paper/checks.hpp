// What every experiment is checked for: an answer that obeys statics and friction.
#pragma once

#include <doctest/doctest.h>

#include "experiments.hpp"
#include "support/equilibrium.hpp"

namespace paper {

/// How far an answer may be from equilibrium, relative to the largest force.
template <class Scalar>
constexpr support::Exact equilibrium_tolerance = sizeof(Scalar) == sizeof(float) ? 1e-5L : 1e-11L;

/// The response to an experiment, after checking that there is one, that every node is in equilibrium and
/// that no joint holds more than its friction.
template <class Scalar, class SceneType>
auto checked_answer(const SceneType& scene, const Drive& drive, int substeps = 1) {
  static taut::Stepwise<Scalar, SceneType> solver;
  const taut::Status status = follow(solver, scene, drive, substeps);
  REQUIRE_MESSAGE(status.ok(), taut::describe(status.code));
  const auto sample = sample_of<Scalar, typename SceneType::Capacity>(drive);
  const support::Violations found = support::check_response(scene, solver, sample);
  CHECK_MESSAGE(found.worst() < equilibrium_tolerance<Scalar>, found);
  return solver.response();
}

/// Whether two numbers agree to a part of the size that matters.
inline bool close(double found, double expected, double tolerance, double size) {
  return std::fabs(found - expected) <= tolerance * size;
}
inline bool close(double found, double expected, double tolerance) {
  return close(found, expected, tolerance, std::fabs(expected));
}

}  // namespace paper
