// Time a sample beside the error that it buys, for both methods and both precisions, in one run:
//
//     speed_against_error [--figure FILE.svg] [Google Benchmark's options]
//
// Two logs of 1000 samples: a ramp to the full jack force and a hold; and ramp, hold, release to a third,
// hold, ramp. A third one, the upper half of a ramp, is for samples without an event alone. The error is the
// largest deviation of a tension from the independent long double reference, relative to the jack force.
// Prints a table at the end, and how the cost of an event grows with the number of joints; draws the figure
// of README.md here.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "benchmark/figure.hpp"
#include "reference/reference.hpp"
#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace {

constexpr double full_force = 2e5;
constexpr int samples = 1000;

/// A truss string structure, or as many rigid saddles.
template <int Joints>
struct Elastic : taut::Capacity {
  static constexpr int jacks = 1, panels = Joints + 1, nodes = 3 * panels + 1, struts = 6 * panels - 1;
  static constexpr int segments = panels, joints = Joints, loads = 2, forces = 2 * panels + 2;
  using Watch = support::RoutesTaken;
};
template <int Joints>
struct Rigid : taut::Capacity {
  static constexpr int jacks = 1, nodes = Joints + 2, segments = Joints + 1, joints = Joints;
  using Watch = support::RoutesTaken;
};

template <class Cap>
void make_scene(taut::Scene<double, 2, Cap>& scene) {
  const auto cable = support::steel_cable(0.5);
  if constexpr (Cap::struts > 0) {
    support::truss_string(scene, cable, Cap::panels);
  } else {
    // An arc that turns by 0.1 at every saddle.
    std::vector<support::PlanePoint> points{{0, 0}};
    for (int i = 0; i < Cap::segments; ++i) {
      const double angle = 0.1 * (i - Cap::segments / 2.0), length = 2 + 0.1 * i;
      points.push_back(
          {points.back()[0] + length * std::cos(angle), points.back()[1] + length * std::sin(angle)});
    }
    support::rigid_saddles(scene, cable, points);
  }
}

std::vector<double> log_through(const std::vector<double>& turns) {
  const int pieces = static_cast<int>(turns.size()) - 1, each = samples / pieces;
  std::vector<double> forces;
  for (std::size_t piece = 0; piece + 1 < turns.size(); ++piece)
    for (int i = 1; i <= each; ++i)
      forces.push_back(full_force * (turns[piece] + (turns[piece + 1] - turns[piece]) * i / each));
  return forces;
}
struct Log {
  const char* name;
  std::vector<double> forces;
};
const Log& ramp_and_hold() {
  static const Log log{"ramp and hold", log_through({0, 1, 1})};
  return log;
}
const Log& cycle() {
  static const Log log{"up, down, up", log_through({0, 1, 1, 1.0 / 3, 1.0 / 3, 1})};
  return log;
}

/// All joints slide throughout.
const Log& upper_half() {
  static const Log log{"upper half of a ramp", log_through({0.5, 1})};
  return log;
}

template <class Scalar, class Cap>
taut::Sample<Scalar, Cap> jacked(double force) {
  taut::Sample<Scalar, Cap> sample;
  sample.jack[0][1].force = static_cast<Scalar>(force);
  return sample;
}

template <class Cap>
using Scene = taut::Scene<double, 2, Cap>;

using Rows = std::vector<std::vector<double>>;

/// The right answer, sample after sample; empty if there is none.
template <class Cap>
Rows follow_reference(const Scene<Cap>& scene, const Log& log) {
  reference::Reference reference(scene);
  Rows all;
  if (!reference.start()) return all;
  for (const double force : log.forces) {
    if (!reference.advance(jacked<double, Cap>(force))) return {};
    all.emplace_back();
    for (int i = 0; i < Cap::segments; ++i) all.back().push_back(static_cast<double>(reference.tension(i)));
  }
  return all;
}
/// Found once: every capacity has one scene.
template <class Cap>
const Rows& reference_of(const Scene<Cap>& scene, const Log& log) {
  static std::map<const Log*, Rows> known;
  const auto found = known.find(&log);
  return found != known.end() ? found->second : known[&log] = follow_reference(scene, log);
}

/// A method on a scene; restart() goes back to no load.
template <class Scalar_, class Cap_>
class Tracking {
 public:
  using Scalar = Scalar_;
  using Cap = Cap_;
  Tracking(const Scene<Cap>& scene, int) {
    const auto condensation = std::make_unique<taut::Condensation<Scalar, Scene<Cap>>>();
    good_ = condensation->run(scene, condensed_).ok();
  }
  void restart() { good_ = tracker_.start(condensed_).status.ok() && good_; }
  void advance(const taut::Sample<Scalar, Cap>& sample) {
    good_ = tracker_.advance(sample).status.ok() && good_;
    benchmark::DoNotOptimize(tracker_.tension(0));
  }
  Scalar tension(int segment) const { return tracker_.tension(segment); }
  bool good() const { return good_; }

 protected:
  taut::Condensed<Scalar, Cap> condensed_;
  taut::Tracker<taut::Condensed<Scalar, Cap>> tracker_;
  bool good_ = true;
};

/// The tracker from where it has been pulled to half of the full force: what follows on the way up is without
/// an event.
template <class Scalar, class Cap>
class TrackingOn : public Tracking<Scalar, Cap> {
 public:
  TrackingOn(const Scene<Cap>& scene, int) : Tracking<Scalar, Cap>(scene, 0) {
    Tracking<Scalar, Cap>::restart();
    for (const double part : {0.4, 0.45, 0.5}) this->advance(jacked<Scalar, Cap>(part * full_force));
    half_ = this->tracker_;
  }
  void restart() { this->tracker_ = half_; }

 private:
  taut::Tracker<taut::Condensed<Scalar, Cap>> half_;
};

constexpr double noise = 0.005 * full_force;
/// Of load cells, always the same.
template <class Scalar>
std::array<Scalar, 2 * samples> scatter() {
  support::Random random(1);
  std::array<Scalar, 2 * samples> numbers{};
  for (Scalar& each : numbers) each = static_cast<Scalar>(noise * support::gaussian(random));
  return numbers;
}

/// The tracker, fed with readings as they come: every other one is a reversal.
template <class Scalar, class Cap>
class TrackingReadings : public Tracking<Scalar, Cap> {
 public:
  using Tracking<Scalar, Cap>::Tracking;
  void restart() {
    row_ = 0;
    support::RoutesTaken::counts() = {};
    Tracking<Scalar, Cap>::restart();
  }
  void advance(const taut::Sample<Scalar, Cap>& sample) {
    const Scalar reading = sample.jack[0][1].force + scatter_[2 * row_++];
    Tracking<Scalar, Cap>::advance(
        jacked<Scalar, Cap>(static_cast<double>(reading > 0 ? reading : Scalar(0))));
  }
  /// Decisions since restart(), those at the reversals too.
  static long events() { return support::total(support::RoutesTaken::counts()); }

 private:
  std::array<Scalar, 2 * samples> scatter_ = scatter<Scalar>();
  std::size_t row_ = 0;
};

/// With 0.5 % of noise on the jack's load cell and one at the far end, and one mu to be found.
template <class Scalar_, class Cap_>
class Estimating {
 public:
  using Scalar = Scalar_;
  using Cap = Cap_;
  Estimating(const Scene<Cap>& scene, int) {
    auto known = std::make_unique<Scene<Cap>>(scene);
    auto& cable = known->cables[0];
    cable.mu_sd = 0.1;
    cable.shared_mu = true;
    cable.cell[0].sd = cable.cell[1].sd = noise;
    const auto condensation = std::make_unique<taut::Condensation<Scalar, Scene<Cap>>>();
    good_ = condensation->run(*known, condensed_).ok();
    taut::find_friction_prior(*known, prior_);
    readings_.ends[0][0].has_force = readings_.ends[0][1].has_force = true;
  }
  /// Reads the far end as it is with a mu of 0.4.
  void prepare(const Scene<Cap>& scene, const Log& log) {
    auto actual = std::make_unique<Scene<Cap>>(scene);
    for (int j = 0; j < actual->mu.size(); ++j) actual->mu[j] = 0.4;
    const auto condensation = std::make_unique<taut::Condensation<Scalar, Scene<Cap>>>();
    const auto condensed = std::make_unique<taut::Condensed<Scalar, Cap>>();
    const auto truth = std::make_unique<taut::Tracker<taut::Condensed<Scalar, Cap>>>();
    good_ = good_ && condensation->run(*actual, *condensed).ok() && truth->start(*condensed).status.ok();
    for (const double force : log.forces) {
      good_ = truth->advance(jacked<Scalar, Cap>(force)).status.ok() && good_;
      far_.push_back(truth->tension(0));
    }
  }
  void restart() {
    row_ = 0;
    good_ = estimator_.start(condensed_, prior_).status.ok() && good_;
  }
  void advance(const taut::Sample<Scalar, Cap>& sample) {
    const Scalar force = sample.jack[0][1].force;
    readings_.ends[0][1].force = force + scatter_[2 * row_];
    readings_.ends[0][0].force = far_[row_] + scatter_[2 * row_ + 1];
    ++row_;
    good_ = estimator_.advance(readings_).status.ok() && good_;
    const auto [force_there, deviation] = estimator_.estimate(0);
    benchmark::DoNotOptimize(force_there + deviation);
  }
  Scalar tension(int segment) const { return estimator_.force(segment); }
  bool good() const { return good_; }

 private:
  taut::Condensed<Scalar, Cap> condensed_;
  taut::FrictionPrior<Scalar, Cap> prior_;
  taut::Estimator<taut::Condensed<Scalar, Cap>, 3> estimator_;
  taut::Readings<Scalar, Cap> readings_;
  std::array<Scalar, 2 * samples> scatter_ = scatter<Scalar>();
  std::vector<Scalar> far_;
  std::size_t row_ = 0;
  bool good_ = true;
};

template <class Scalar_, class Cap_>
class Stepping {
 public:
  using Scalar = Scalar_;
  using Cap = Cap_;
  Stepping(const Scene<Cap>& scene, int substeps) : scene_(scene), substeps_(substeps) {}
  void restart() { good_ = solver_.start(scene_).ok(); }
  void advance(const taut::Sample<Scalar, Cap>& sample) {
    good_ = solver_.advance(sample, substeps_).ok() && good_;
  }
  Scalar tension(int segment) const { return solver_.response().tension[segment]; }
  bool good() const { return good_; }

 private:
  const Scene<Cap>& scene_;
  int substeps_;
  taut::Stepwise<Scalar, Scene<Cap>> solver_;
  bool good_ = true;
};

/// The least that a sample can cost: T = base + column x load, and two comparisons a joint.
template <class Scalar_, class Cap_>
class BareMap {
 public:
  using Scalar = Scalar_;
  using Cap = Cap_;
  BareMap(const Scene<Cap>&, int) {
    column_.fill(Scalar(1));
    rho_.fill(Scalar(0.9));
    base_.fill(Scalar(0));
  }
  void restart() {}
  void advance(const taut::Sample<Scalar, Cap>& sample) {
    const Scalar x = sample.jack[0][1].force;
    for (int i = 0; i < Cap::segments; ++i) T_[i] = base_[i] + x * column_[i];
    bool within = true;
    for (int i = 0; i < Cap::joints; ++i)
      within = within & (T_[i] >= rho_[i] * T_[i + 1]) & (T_[i + 1] >= rho_[i] * T_[i]);
    good_ = good_ && within;
    benchmark::ClobberMemory();
  }
  Scalar tension(int segment) const { return T_[segment]; }
  bool good() const { return good_; }

 private:
  taut::FixedArray<Scalar, Cap::segments> base_, column_, T_;
  taut::FixedArray<Scalar, Cap::joints> rho_;
  bool good_ = true;
};

template <class Method>
double error_of(Method& method, const Scene<typename Method::Cap>& scene, const Log& log) {
  using Cap = typename Method::Cap;
  const Rows& expected = reference_of(scene, log);
  if (expected.empty()) return -1;
  double error = 0;
  method.restart();
  for (std::size_t row = 0; row < log.forces.size(); ++row) {
    method.advance(jacked<typename Method::Scalar, Cap>(log.forces[row]));
    for (int i = 0; i < Cap::segments; ++i)
      error = std::fmax(error, std::fabs(static_cast<double>(method.tension(i)) -
                                         expected[row][static_cast<std::size_t>(i)]));
  }
  return error / full_force;
}

template <class Method>
void run(benchmark::State& state, const Scene<typename Method::Cap>& scene, const Log& log, int substeps,
         bool has_error) {
  using Cap = typename Method::Cap;
  const auto method = std::make_unique<Method>(scene, substeps);
  if constexpr (std::is_same<Method, Estimating<typename Method::Scalar, Cap>>::value)
    method->prepare(scene, log);
  const double error = has_error ? error_of(*method, scene, log) : 0;
  if (error < 0) state.SkipWithError("the reference has no answer");
  std::vector<taut::Sample<typename Method::Scalar, Cap>> rows;
  for (const double force : log.forces) rows.push_back(jacked<typename Method::Scalar, Cap>(force));
  for (auto round : state) {
    static_cast<void>(round);
    method->restart();
    for (const auto& row : rows) method->advance(row);
    benchmark::DoNotOptimize(method->tension(0));
  }
  if (!method->good()) state.SkipWithError("no answer");
  state.counters["ns_a_sample"] =
      benchmark::Counter(static_cast<double>(rows.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  if (has_error) state.counters["error"] = error;
  if constexpr (std::is_same<Method, TrackingReadings<typename Method::Scalar, Cap>>::value)
    state.counters["events_a_sample"] =
        static_cast<double>(Method::events()) / static_cast<double>(rows.size());
}

/// Names in the order of the table.
std::vector<std::string>& registered() {
  static std::vector<std::string> names;
  return names;
}
template <class Method>
benchmark::internal::Benchmark* add(const Scene<typename Method::Cap>& scene, const std::string& name,
                                    const Log& log, const std::string& method, bool has_error,
                                    int substeps = 0) {
  const char* const scalar = sizeof(typename Method::Scalar) == sizeof(float) ? "float" : "double";
  registered().push_back(name + "/" + log.name + "/" + scalar + "/" + method);
  return benchmark::RegisterBenchmark(registered().back().c_str(),
                                      [&scene, &log, has_error, substeps](benchmark::State& state) {
                                        run<Method>(state, scene, log, substeps, has_error);
                                      });
}

template <class Scalar, class Cap>
void register_methods(const Scene<Cap>& scene, const std::string& name, const Log& log) {
  add<BareMap<Scalar, Cap>>(scene, name, log, "bare map", false);
  add<Tracking<Scalar, Cap>>(scene, name, log, "tracker", true);
  add<TrackingReadings<Scalar, Cap>>(scene, name, log, "tracker on raw readings", false);
  add<Estimating<Scalar, Cap>>(scene, name, log, "estimator", false);
  for (const int substeps : {1, 4, 16, 64, 256})
    add<Stepping<Scalar, Cap>>(scene, name, log, "stepwise " + std::to_string(substeps), true, substeps)
        ->Iterations(1);
}
template <class Scalar, class Cap>
void register_samples_without_event(const Scene<Cap>& scene, const std::string& name) {
  add<BareMap<Scalar, Cap>>(scene, name, upper_half(), "bare map", false);
  add<TrackingOn<Scalar, Cap>>(scene, name, upper_half(), "tracker", true);
}

template <class Cap>
void register_scene(const std::string& name) {
  static Scene<Cap> scene;
  make_scene(scene);
  for (const Log* log : {&ramp_and_hold(), &cycle()}) {
    register_methods<double>(scene, name, *log);
    register_methods<float>(scene, name, *log);
  }
  register_samples_without_event<double>(scene, name);
  register_samples_without_event<float>(scene, name);
}

/// Prints as usual, and keeps what the table and the figure need: of several repetitions the fastest, for
/// whatever else the machine does only adds.
class Collector : public benchmark::ConsoleReporter {
 public:
  std::vector<bench::Point> points() const {
    std::vector<bench::Point> all;
    for (const std::string& name : registered()) {
      const auto found = fastest_.find(name);
      if (found == fastest_.end()) continue;
      all.push_back(
          bench::Point::of(name, found->second.ns_a_sample, found->second.error, found->second.events));
    }
    return all;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const bool counts = run.run_type == Run::RT_Iteration && !run.error_occurred;
      if (!counts || run.counters.count("ns_a_sample") == 0) continue;
      const bool has_error = run.counters.count("error") > 0;
      const bool has_events = run.counters.count("events_a_sample") > 0;
      const Found found{run.counters.at("ns_a_sample"), has_error ? double(run.counters.at("error")) : -1,
                        has_events ? double(run.counters.at("events_a_sample")) : 0};
      const auto place = fastest_.emplace(run.run_name.function_name, found).first;
      if (found.ns_a_sample < place->second.ns_a_sample) place->second = found;
    }
  }

 private:
  struct Found {
    double ns_a_sample, error, events;
  };
  std::map<std::string, Found> fastest_;
};

}  // namespace

int main(int argc, char** argv) {
  std::string figure;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], "--figure") == 0) figure = argv[i + 1];
  register_scene<Elastic<4>>("truss string, 4 joints");
  register_scene<Elastic<15>>("truss string, 15 joints");
  register_scene<Elastic<16>>("truss string, 16 joints");
  register_scene<Elastic<64>>("truss string, 64 joints");
  register_scene<Rigid<4>>("rigid saddles, 4 joints");
  register_scene<Rigid<16>>("rigid saddles, 16 joints");
  register_scene<Rigid<64>>("rigid saddles, 64 joints");
  benchmark::Initialize(&argc, argv);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::Shutdown();
  bench::print_table(collector.points());
  bench::print_growth(collector.points());
  if (!figure.empty()) bench::draw(collector.points(), "truss string, 4 joints", "up, down, up", figure);
}
