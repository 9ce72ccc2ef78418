// A hard case: a scene and its samples, followed by the tracker in both scalar types and by the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hard_cases/scene_files.hpp"
#include "reference/reference.hpp"
#include "support/run.hpp"
#include "support/saddles.hpp"
#include "support/scenes.hpp"

namespace hard {

using reference::Exact;

template <class SceneType>
using SampleOf = taut::Sample<double, typename SceneType::Capacity>;
template <class SceneType>
using Samples = std::vector<SampleOf<SceneType>>;

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

/// The largest deviation of one scalar type over all samples, as parts of the largest force so far.
struct Deviation {
  double from_reference = 0;
  double verified = 0;  ///< worst of verify()
  int events = 0;
  std::string trouble;  ///< what was refused and where; empty if nothing
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
  reference::Reference found(scene);
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
  support::Run<Scalar, SceneType> run(scene);
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
  if (scene_files) {
    scene_files->write(scene, samples);
    return {};
  }
  const Expected expected = answer(scene, samples);
  Measured measured;
  measured.in_double = deviation<double>(scene, samples, expected);
  measured.in_float = deviation<float>(scene, samples, expected);
  measured.several_answers = expected.several_answers;
  if (!expected.trouble.empty()) measured.in_double.trouble = "reference, " + expected.trouble;
  return measured;
}

}  // namespace hard
