// A test bench: a solver on a scene, the sample that drives it, and the independent check after every step.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "support/equilibrium.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace support {

/// What an answer may violate: rounding of a few hundred operations on the scalar type.
template <class Scalar>
constexpr Exact tolerance() {
  return sizeof(Scalar) == sizeof(float) ? Exact(1e-5L) : Exact(1e-11L);
}

/// Drives a solver over a scene. Every path is one load step unless said otherwise, and every answer is
/// checked.
template <class Scalar, class SceneType>
class Bench {
 public:
  using Solver = taut::Stepwise<Scalar, SceneType>;
  using Cap = typename SceneType::Capacity;

  /// Loads the scene, which must outlive the bench, with its prestrain.
  explicit Bench(const SceneType& scene);

  taut::Status started() const { return started_; }
  const Solver& solver() const { return *solver_; }
  const taut::Response<Scalar, Cap>& response() const { return solver_->response(); }
  double T(int segment) const { return static_cast<double>(response().tension[segment]); }
  double slip(int joint) const { return static_cast<double>(response().slip[joint]); }
  double payout(int cable, int end) const {
    return static_cast<double>(response().payout[cable][static_cast<std::size_t>(end)]);
  }
  const Violations& violations() const { return found_; }
  double largest_force() const { return static_cast<double>(found_.largest_force); }

  /// Changes the goal, without going there.
  Bench& load(int load, double factor) {
    sample_.factor[load] = static_cast<Scalar>(factor);
    return *this;
  }
  Bench& jack(int cable, int end, double force) {
    sample_.jack[cable][static_cast<std::size_t>(end)] = {static_cast<Scalar>(force), false};
    return *this;
  }
  Bench& lock(int cable, int end) {
    sample_.jack[cable][static_cast<std::size_t>(end)].locked = true;
    return *this;
  }

  /// Goes there in one or more load steps.
  taut::Status go(int substeps = 1);
  /// Loads the scene once more with the same solver, as if nothing had been.
  taut::Status restart();

 private:
  const SceneType& scene_;
  std::unique_ptr<Solver> solver_;
  Watch<SceneType, Scalar> watch_;
  taut::Sample<Scalar, Cap> sample_{};
  taut::Status started_;
  Violations found_;
};

// Outside the class, and so not inline: an instance that is declared extern is not compiled again.

template <class Scalar, class SceneType>
Bench<Scalar, SceneType>::Bench(const SceneType& scene) : scene_(scene), solver_(new Solver), watch_(scene) {
  (void)restart();
}

template <class Scalar, class SceneType>
taut::Status Bench<Scalar, SceneType>::restart() {
  watch_.restart();
  sample_ = {};
  started_ = solver_->start(scene_);
  if (started_) found_ = watch_.check(*solver_, sample_);
  return started_;
}

template <class Scalar, class SceneType>
taut::Status Bench<Scalar, SceneType>::go(int substeps) {
  const taut::Status status = solver_->advance(sample_, substeps);
  if (!status) return status;
  if (substeps > 1) watch_.forget_slips();
  found_ = watch_.check(*solver_, sample_);
  return status;
}

/// Close as parts of the larger of the two and of `scale`.
inline bool close(double a, double b, double relative, double scale = 0) {
  return std::fabs(a - b) <= relative * std::fmax(scale, std::fmax(std::fabs(a), std::fabs(b)));
}

}  // namespace support

/// The last answer of a bench obeys all laws.
#define CHECK_LAWFUL(bench, Scalar)                                      \
  do {                                                                   \
    CAPTURE((bench).violations());                                       \
    CHECK((bench).violations().worst() <= support::tolerance<Scalar>()); \
  } while (false)
