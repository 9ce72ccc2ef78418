// A test bench: a solver on a scene, the sample that drives it, and the independent check after every step.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "support/scenes.hpp"
#include "support/violations.hpp"
#include "taut/scene/sample.hpp"
#include "taut/status.hpp"

namespace support {

/// Who finds the answers: condensation and tracker, or the paper's procedure.
enum class Solver { tracker, stepwise };

inline std::ostream& operator<<(std::ostream& out, Solver solver) {
  return out << (solver == Solver::tracker ? "tracker" : "stepwise");
}

/// What an answer may violate: rounding of a few hundred operations on the scalar type.
template <class Scalar>
constexpr Exact tolerance() {
  return sizeof(Scalar) == sizeof(float) ? Exact(1e-5L) : Exact(1e-11L);
}

/// A solver on one scene.
template <class Scalar, class SceneType>
class Engine {
 public:
  using Cap = typename SceneType::Capacity;

  virtual ~Engine() = default;
  /// Brings the prestrain on, as if nothing had been.
  virtual taut::Status start(const SceneType& scene) = 0;
  /// Follows the straight path to the sample, in so many equal parts.
  virtual taut::Status advance(const taut::Sample<Scalar, Cap>& sample, int parts) = 0;
  virtual const taut::Response<Scalar, Cap>& response() const = 0;
  virtual Scalar displacement(int node, int axis) const = 0;
};

/// Drives a solver over a scene. Every path is followed at once unless said otherwise, and every answer is
/// checked. For the scenes and scalars that are named below.
template <class Scalar, class SceneType>
class Bench {
 public:
  using Cap = typename SceneType::Capacity;

  /// Loads the scene, which must outlive the bench, with its prestrain.
  Bench(const SceneType& scene, Solver solver);
  ~Bench();

  taut::Status started() const { return started_; }
  const Engine<Scalar, SceneType>& solver() const { return *engine_; }
  const taut::Response<Scalar, Cap>& response() const { return engine_->response(); }
  double T(int segment) const { return static_cast<double>(response().tension[segment]); }
  double slip(int joint) const { return static_cast<double>(response().slip[joint]); }
  double extension(int cable, int end) const {
    return static_cast<double>(response().extension[cable][static_cast<std::size_t>(end)]);
  }
  double displacement(int node, int axis) const {
    return static_cast<double>(engine_->displacement(node, axis));
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
  struct Check;

  const SceneType& scene_;
  Solver by_;
  std::unique_ptr<Engine<Scalar, SceneType>> engine_;
  std::unique_ptr<Check> check_;
  taut::Sample<Scalar, Cap> sample_{};
  taut::Status started_;
  Violations found_;
};

extern template class Bench<double, Plane>;
extern template class Bench<float, Plane>;
extern template class Bench<double, Space>;
extern template class Bench<float, Space>;

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

/// A test case that every solver has to pass; `solver` is the one whose turn it is.
#define SOLVER_TEST_CASE(name, solver) SOLVER_TEST_CASE_AS(DOCTEST_ANONYMOUS(of_every_solver_), name, solver)
#define SOLVER_TEST_CASE_AS(function, name, solver)              \
  static void function(support::Solver solver);                  \
  TEST_CASE(name) {                                              \
    SUBCASE("tracker") { function(support::Solver::tracker); }   \
    SUBCASE("stepwise") { function(support::Solver::stepwise); } \
  }                                                              \
  static void function(support::Solver solver)
