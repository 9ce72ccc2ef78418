// A hard case: a scene and its samples, followed by the tracker in both scalar types and by the reference.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "reference/reference.hpp"
#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace hard {

using support::Exact;

/// Capacity of a scene without anything elastic but its cables.
struct SaddleCapacity : taut::Capacity {
  static constexpr int nodes = 18, cables = 2, segments = 16, joints = 16, loads = 2, temperatures = 2;
};
using Saddles = taut::Scene<double, 2, SaddleCapacity>;

template <class SceneType>
using SampleOf = taut::Sample<double, typename SceneType::Capacity>;
template <class SceneType>
using Samples = std::vector<SampleOf<SceneType>>;

template <class Scalar, class Cap>
taut::Sample<Scalar, Cap> rounded(const taut::Sample<double, Cap>& sample) {
  taut::Sample<Scalar, Cap> copy;
  for (int i = 0; i < Cap::loads; ++i) copy.factor[i] = static_cast<Scalar>(sample.factor[i]);
  for (int c = 0; c < Cap::cables; ++c)
    for (std::size_t end = 0; end < 2; ++end)
      copy.jack[c][end] = {static_cast<Scalar>(sample.jack[c][end].force), sample.jack[c][end].locked};
  return copy;
}

/// The samples of one jack at the end of the first cable.
template <class SceneType>
Samples<SceneType> jack_forces(const std::vector<double>& forces) {
  Samples<SceneType> samples;
  for (const double force : forces) {
    samples.push_back({});
    samples.back().jack[0][1].force = force;
  }
  return samples;
}
/// The same of two jacks.
template <class SceneType>
Samples<SceneType> two_jack_forces(const std::vector<std::array<double, 2>>& forces) {
  Samples<SceneType> samples;
  for (const auto& force : forces) {
    samples.push_back({});
    for (std::size_t end = 0; end < 2; ++end) samples.back().jack[0][end].force = force[end];
  }
  return samples;
}

/// A tracker with the condensed scene that it follows, somewhere on the heap.
template <class Scalar, class SceneType>
class Run {
 public:
  using Cap = typename SceneType::Capacity;
  using Model = taut::Condensed<Scalar, Cap>;

  explicit Run(const SceneType& scene) : model_(new Model), tracker_(new taut::Tracker<Model>) {
    const auto condensation = std::make_unique<taut::Condensation<Scalar, SceneType>>();
    status_ = condensation->run(scene, *model_);
    if (status_) status_ = tracker_->start(*model_).status;
  }
  taut::Status status() const { return status_; }
  const Model& model() const { return *model_; }
  taut::Tracker<Model>& tracker() { return *tracker_; }
  double tension(int segment) const { return static_cast<double>(tracker_->tension(segment)); }
  taut::Progress<Scalar> advance(const SampleOf<SceneType>& sample) {
    return tracker_->advance(rounded<Scalar>(sample));
  }
  std::vector<double> tensions() const {
    std::vector<double> all;
    for (int i = 0; i < model_->segments; ++i) all.push_back(tension(i));
    return all;
  }
  double verified() const { return static_cast<double>(taut::verify(*tracker_).worst()); }

 private:
  std::unique_ptr<Model> model_;
  std::unique_ptr<taut::Tracker<Model>> tracker_;
  taut::Status status_;
};

/// The largest deviation of one scalar type over all samples, as parts of the largest force so far.
struct Deviation {
  double from_reference = 0;
  double verified = 0;  ///< worst of verify()
  int events = 0;
  std::string trouble;  ///< what was refused and where; empty if nothing
  bool refused_as_it_should = false;
};
struct Measured {
  Deviation in_double, in_float;
  int several_answers = 0;  ///< events at which the reference could have gone on in more than one way

  /// The worse one of two parts of a case.
  Measured& operator|=(const Measured& other) {
    merge(in_double, other.in_double);
    merge(in_float, other.in_float);
    several_answers += other.several_answers;
    return *this;
  }

 private:
  static void merge(Deviation& a, const Deviation& b) {
    a.from_reference = std::max(a.from_reference, b.from_reference);
    a.verified = std::max(a.verified, b.verified);
    a.events += b.events;
    if (a.trouble.empty()) a.trouble = b.trouble;
  }
};

inline std::string in_words(const taut::Status& status, std::size_t row) {
  return "row " + std::to_string(row) + ": " + taut::describe(status.code) + ", index " +
         std::to_string(status.index);
}

/// What the reference answers at start and after every sample.
struct Expected {
  std::vector<std::vector<Exact>> tensions;
  std::vector<Exact> peak;
  int several_answers = 0;
  std::string trouble;
};

template <class SceneType>
Expected answer(const SceneType& scene, const Samples<SceneType>& samples) {
  Expected expected;
  reference::Reference<SceneType> found(scene);
  bool good = found.start();
  for (std::size_t row = 0;; ++row) {
    if (!good) {
      expected.trouble =
          "row " + std::to_string(row) + ": no answer at " + std::to_string(double(found.fraction()));
      break;
    }
    expected.tensions.emplace_back();
    for (int i = 0; i < scene.prestrain.size(); ++i) expected.tensions.back().push_back(found.tension(i));
    expected.peak.push_back(found.peak());
    if (row == samples.size()) break;
    good = found.advance(samples[row]);
  }
  expected.several_answers = found.events_with_several_answers();
  return expected;
}

template <class Scalar, class SceneType>
Deviation deviation(const SceneType& scene, const Samples<SceneType>& samples, const Expected& expected) {
  Deviation found;
  Run<Scalar, SceneType> run(scene);
  if (!run.status()) {
    found.trouble = "start: " + in_words(run.status(), 0);
    return found;
  }
  for (std::size_t row = 0; row < expected.tensions.size(); ++row) {
    const auto& tensions = expected.tensions[row];
    for (std::size_t i = 0; i < tensions.size(); ++i) {
      const Exact off = std::fabs(Exact(run.tension(int(i))) - tensions[i]);
      if (off > 0) found.from_reference = std::max(found.from_reference, double(off / expected.peak[row]));
    }
    found.verified = std::max(found.verified, run.verified());
    if (row + 1 == expected.tensions.size()) break;
    const auto progress = run.advance(samples[row]);
    found.events += progress.events;
    if (!progress.status || progress.fraction < 1) {
      found.trouble = in_words(progress.status, row + 1);
      break;
    }
  }
  return found;
}

template <class SceneType>
Measured follow(const SceneType& scene, const Samples<SceneType>& samples) {
  const Expected expected = answer(scene, samples);
  Measured measured;
  measured.in_double = deviation<double>(scene, samples, expected);
  measured.in_float = deviation<float>(scene, samples, expected);
  measured.several_answers = expected.several_answers;
  if (!expected.trouble.empty()) measured.in_double.trouble = "reference, " + expected.trouble;
  return measured;
}

/// A cable over held nodes, in a scene type that has room for nothing else.
inline void saddles(Saddles& scene, const taut::Cable<double>& cable,
                    const std::vector<support::PlanePoint>& points) {
  scene = {};
  std::vector<int> path;
  for (const auto& point : points) path.push_back(scene.add_node(point, taut::held_xy));
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
}

/// Points of a path from its segment lengths and the angles by which it turns between them.
inline std::vector<support::PlanePoint> path_points(const std::vector<double>& lengths,
                                                    const std::vector<double>& turns) {
  std::vector<support::PlanePoint> points{{0, 0}};
  double angle = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (i > 0) angle += turns[i - 1];
    const auto last = points.back();
    points.push_back({last[0] + lengths[i] * std::cos(angle), last[1] + lengths[i] * std::sin(angle)});
  }
  return points;
}

}  // namespace hard
