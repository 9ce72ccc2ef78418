// Between the files and the solvers of the core: rows of a log to samples, responses to answers.
#pragma once

#include <cstddef>

#include "lib/files/alarm_words.hpp"
#include "lib/files/answer.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/scene/sample.hpp"

namespace taut::host {

/// The sample of a row. Forces of load cells at anchored ends are measurements, not part of what drives the
/// model.
template <class Scalar, class Cap>
Sample<Scalar, Cap> sample_of(const LogRow& row, const SceneDescription& scene) {
  Sample<Scalar, Cap> sample;
  for (std::size_t i = 0; i < row.factor.size(); ++i)
    sample.factor[static_cast<int>(i)] = static_cast<Scalar>(row.factor[i]);
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    for (std::size_t end = 0; end < 2; ++end) {
      if (!scene.cables[c].is_jacked(end)) continue;
      const EndRow& given = row.cables[c][end];
      sample.jack[static_cast<int>(c)][end] = {static_cast<Scalar>(given.force), given.locked};
    }
  }
  return sample;
}

/// The readings of a row; `dt` is the time since the row before [s].
template <class Scalar, class Cap>
void read_row(const LogRow& row, const SceneDescription& scene, double dt, Readings<Scalar, Cap>& readings) {
  readings.sample = sample_of<Scalar, Cap>(row, scene);
  readings.dt = static_cast<Scalar>(dt);
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const EndRow& given = row.cables[c][end];
      readings.ends[static_cast<int>(c)][end] = {given.reading.has_value(), given.stroke.has_value(),
                                                 static_cast<Scalar>(given.reading.value_or(0)),
                                                 static_cast<Scalar>(given.stroke.value_or(0))};
    }
}

namespace detail {

/// A number of the answer; adding zero makes a positive zero of a negative one.
template <class Scalar>
double answered(Scalar value) {
  return static_cast<double>(value) + 0.0;
}

template <class Values>
void copy_numbers(const Values& from, std::size_t count, std::vector<double>& to) {
  to.resize(count);
  for (std::size_t i = 0; i < count; ++i) to[i] = answered(from[static_cast<int>(i)]);
}

}  // namespace detail

/// Copies what the scene holds out of the response.
template <class Scalar, class Cap>
void read_response(const Response<Scalar, Cap>& response, const SceneDescription& scene, Answer& answer) {
  std::size_t segments = 0, joints = 0;
  answer.extension.resize(scene.cables.size());
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    segments += scene.cables[c].segments();
    joints += scene.cables[c].joints();
    for (std::size_t end = 0; end < 2; ++end)
      answer.extension[c][end] = detail::answered(response.extension[static_cast<int>(c)][end]);
  }
  detail::copy_numbers(response.tension, segments, answer.tension);
  detail::copy_numbers(response.slip, joints, answer.slip);
  detail::copy_numbers(response.contact, joints, answer.contact);
  detail::copy_numbers(response.friction, joints, answer.friction);
  detail::copy_numbers(response.strut, scene.struts.size(), answer.strut);
  answer.state.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) answer.state[j] = response.state[static_cast<int>(j)];
}

/// Copies how much of friction is used, and what displacements have done to the bend of cables.
template <class TrackerType>
void read_lean(const TrackerType& tracker, const SceneDescription& scene, Answer& answer) {
  std::size_t joints = 0;
  for (const CableDescription& cable : scene.cables) joints += cable.joints();
  answer.friction_used.resize(joints);
  answer.bend_change.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const int joint = static_cast<int>(j);
    answer.friction_used[j] = detail::answered(tracker.friction_used(joint));
    answer.bend_change[j] = detail::answered(tracker.bend_change(joint));
  }
}

inline bool asks_for_displacements(const SceneDescription& scene) {
  return !scene.displaced.empty() || !scene.watched.empty();
}

/// Some of the displacements that the scene asks for and watches, from the rows for all of them; without rows
/// there are none.
template <class Rows, class TrackerType>
void read_displacements(const Rows* rows, const TrackerType& tracker, std::size_t first, std::size_t count,
                        std::vector<double>& found) {
  found.clear();
  if (rows == nullptr || count == 0) return;
  FixedArray<typename TrackerType::Scalar, TrackerType::Cap::displacements> all;
  rows->evaluate(tracker.model(), tracker.loads(), tracker.elongations(), all);
  for (std::size_t i = first; i < first + count; ++i)
    found.push_back(detail::answered(all[static_cast<int>(i)]));
}

/// Copies what an Estimator finds beyond its response.
template <class EstimatorType>
void read_certainty(const EstimatorType& estimator, const SceneDescription& scene, Answer& answer) {
  const auto copy = [](std::vector<double>& to, std::size_t count, auto number) {
    to.resize(count);
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(number(static_cast<int>(i)));
  };
  copy(answer.deviation, answer.tension.size(), [&](int i) { return estimator.deviation(i); });
  copy(answer.mu, answer.slip.size(), [&](int j) { return estimator.mu(j); });
  copy(answer.mu_deviation, answer.slip.size(), [&](int j) { return estimator.mu_deviation(j); });
  read_alarms(estimator.alarms(), scene, answer);
  answer.peaks.clear();
  for (const Alarm& alarm : estimator.alarms())
    if (alarm.kind == Alarm::Kind::force_high || alarm.kind == Alarm::Kind::force_low) {
      const int first = estimator.tracker().model().cables[alarm.cable].first_segment;
      answer.peaks[alarm_word(alarm, scene)] = static_cast<double>(estimator.peak(first + alarm.place));
    }
}

}  // namespace taut::host
