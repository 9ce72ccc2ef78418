// Time a sample beside the error that it buys, for both methods and both precisions, in one run.
//
// The log is a ramp to the full jack force, a hold, a release to a third, a hold, and a ramp back: 1000
// samples. The error is the largest deviation of a tension from the tracker in long double, relative to the
// jack force.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace {

using support::Plane;
using Cap = support::PlaneCapacity;
constexpr double full_force = 2e5;

std::vector<double> jack_log() {
  const double turns[] = {0, 1, 1, 1.0 / 3, 1.0 / 3, 1};
  std::vector<double> forces;
  for (int piece = 0; piece < 5; ++piece)
    for (int i = 1; i <= 200; ++i)
      forces.push_back(full_force * (turns[piece] + (turns[piece + 1] - turns[piece]) * i / 200.0));
  return forces;
}

template <class Scalar>
taut::Sample<Scalar, Cap> jacked(double force) {
  taut::Sample<Scalar, Cap> sample;
  sample.jack[0][1].force = static_cast<Scalar>(force);
  return sample;
}

/// A method on a scene; restart() goes back to no load.
template <class Scalar>
class Tracking {
 public:
  explicit Tracking(const Plane& scene) {
    taut::Condensation<Scalar, Plane> condensation;
    good_ = condensation.run(scene, condensed_).ok();
  }
  void restart() { good_ = tracker_.start(condensed_).status.ok() && good_; }
  void advance(double force) { good_ = tracker_.advance(jacked<Scalar>(force)).status.ok() && good_; }
  Scalar tension(int segment) const { return tracker_.tension(segment); }
  bool good() const { return good_; }

 private:
  taut::Condensed<Scalar, Cap> condensed_;
  taut::Tracker<taut::Condensed<Scalar, Cap>> tracker_;
  bool good_ = true;
};

template <class Scalar>
class Stepping {
 public:
  Stepping(const Plane& scene, int substeps) : scene_(scene), substeps_(substeps) {}
  void restart() { good_ = solver_.start(scene_).ok(); }
  void advance(double force) { good_ = solver_.advance(jacked<Scalar>(force), substeps_).ok() && good_; }
  Scalar tension(int segment) const { return solver_.response().tension[segment]; }
  bool good() const { return good_; }

 private:
  const Plane& scene_;
  int substeps_;
  taut::Stepwise<Scalar, Plane> solver_;
  bool good_ = true;
};

template <class Method>
void run(benchmark::State& state, const Plane& scene, Method& method) {
  const std::vector<double> forces = jack_log();
  const auto exact = std::make_unique<Tracking<long double>>(scene);
  double error = 0;
  method.restart();
  exact->restart();
  for (const double force : forces) {
    method.advance(force);
    exact->advance(force);
    for (int i = 0; i < scene.prestrain.size(); ++i)
      error = std::fmax(
          error, std::fabs(static_cast<double>(method.tension(i)) - static_cast<double>(exact->tension(i))));
  }
  if (!method.good() || !exact->good()) state.SkipWithError("no answer");
  for (auto round : state) {
    static_cast<void>(round);
    method.restart();
    for (const double force : forces) method.advance(force);
    benchmark::DoNotOptimize(method.tension(0));
  }
  state.counters["ns_a_sample"] =
      benchmark::Counter(static_cast<double>(forces.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["error"] = error / full_force;
}

template <class Scalar>
void register_all(const std::string& name, const Plane& scene) {
  benchmark::RegisterBenchmark((name + "/tracker").c_str(), [&scene](benchmark::State& state) {
    const auto method = std::make_unique<Tracking<Scalar>>(scene);
    run(state, scene, *method);
  });
  for (const int substeps : {1, 4, 16, 64, 256})
    benchmark::RegisterBenchmark((name + "/stepwise/" + std::to_string(substeps)).c_str(),
                                 [&scene, substeps](benchmark::State& state) {
                                   const auto method = std::make_unique<Stepping<Scalar>>(scene, substeps);
                                   run(state, scene, *method);
                                 });
}

}  // namespace

int main(int argc, char** argv) {
  static Plane truss, saddles;
  support::truss_string(truss, support::steel_cable(0.2), 8);
  support::rigid_saddles(saddles, support::steel_cable(0.2), support::chain_points(8));
  register_all<double>("truss string, 7 joints/double", truss);
  register_all<float>("truss string, 7 joints/float", truss);
  register_all<double>("rigid saddles, 7 joints/double", saddles);
  register_all<float>("rigid saddles, 7 joints/float", saddles);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
