// The monitor: takes a sample of the jack loads, yields the force of every segment and the state of every
// joint. Portable: single precision, no heap, no files, no clock.
#pragma once

#include "taut/scene/sample.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace monitor {

/// Follows one scene from sample to sample. Holds all its storage: make it static.
template <class SceneType>
class Monitor {
 public:
  using Scalar = float;
  using Capacity = typename SceneType::Capacity;
  using Sample = taut::Sample<Scalar, Capacity>;

  /// What is known after a sample. `forces` are those of the last sample that had an answer.
  struct Reading {
    taut::Status status;
    taut::Response<Scalar, Capacity> forces;
  };

  /// Takes on a scene, which must outlive the monitor, without loads.
  taut::Status start(const SceneType& scene) { return solver_.start(scene); }

  /// Follows the straight path from the sample before to this one.
  Reading take(const Sample& sample) {
    const taut::Status status = solver_.advance(sample, load_steps);
    return {status, solver_.response()};
  }

 private:
  /// Load steps a sample: within one, a joint slides one way only.
  static constexpr int load_steps = 4;

  taut::Stepwise<Scalar, SceneType> solver_;
};

}  // namespace monitor
