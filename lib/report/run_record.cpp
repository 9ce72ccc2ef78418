#include "lib/report/run_record.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "lib/files/alarm_words.hpp"
#include "lib/files/verdict.hpp"

namespace taut::host {
namespace {

constexpr std::size_t most_points = 100000;  // of all curves of one kind, which keeps the page within some MB
constexpr std::size_t most_strip_cells = 60000, most_frames = 120, frame_values = 100000;
constexpr std::size_t alarm_cells = 500, values_a_frame = 6;

// Each of so many things gets its share, within limits.
std::size_t share(std::size_t total, std::size_t things, std::size_t least, std::size_t most) {
  return std::clamp(total / std::max<std::size_t>(things, 1), least, most);
}

// Of a list that blanks separate.
bool has_word(const std::string& list, const std::string& word) {
  return (" " + list + " ").find(" " + word + " ") != std::string::npos;
}

Curve curve_among(std::size_t curves) { return Curve(share(most_points, curves, 200, Curve::usual_points)); }

}  // namespace

CableStart start_of(const SceneDescription& scene, std::size_t c) {
  CableStart start;
  for (std::size_t i = 0; i < c; ++i) {
    start.segment += scene.cables[i].segments();
    start.joint += scene.cables[i].joints();
  }
  return start;
}

void StateSpan::join(const StateSpan& later) {
  last_time = later.last_time;
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (std::size_t s = 0; s < joints[j].size(); ++s) joints[j][s] += later.joints[j][s];
}

void AlarmSpan::join(const AlarmSpan& later) {
  last_time = later.last_time;
  any = any || later.any;
}

RunRecord::RunRecord(const SceneDescription& scene)
    : states(share(most_strip_cells, start_of(scene, scene.cables.size()).joint, 250, 1000)),
      alarm_spans(alarm_cells),
      frames(share(frame_values, values_a_frame * start_of(scene, scene.cables.size()).segment, 30,
                   most_frames)),
      scene_(scene) {
  const CableStart all = start_of(scene, scene.cables.size());
  tension.assign(all.segment, curve_among(all.segment));
  cell.resize(scene.cables.size());
  stages.resize(scene.cables.size());
  peaks.resize(scene.cables.size());
  waiting_.resize(scene.cables.size());
  read.resize(scene.cables.size());
  for (auto* curves : {&mu, &least_mu, &most_mu}) curves->assign(all.joint, curve_among(3 * all.joint));
}

void RunRecord::add(const LogRow& row, const Answer& answer, const Answer* expected) {
  if (rows == 0) first_time = row.time;
  if (rows == 0 || is_trust(answer.verdict) != is_trust(end.verdict)) verdict_since = row.time;
  last_time = row.time;
  ++rows;
  end = answer;
  add_cells(row);
  add_jacks(row, answer, expected);
  add_tensions(row, answer);
  add_mu(row, answer);
  add_states(row, answer);
  alarms.add(row, answer.alarms, answer.peaks);
  notices.add(row, answer.notices);
  alarm_spans.add({row.time, row.time, !answer.alarms.empty()});
  frames.add({row.time, answer.tension, answer.deviation, answer.mu, answer.mu_deviation, answer.contact,
              answer.friction_used, answer.state});
}

void RunRecord::add_cells(const LogRow& row) {
  for (std::size_t c = 0; c < scene_.cables.size(); ++c)
    for (std::size_t e = 0; e < 2; ++e) {
      const EndRow& given = row.cables[c][e];
      if (given.locked) {
        // Now the cell measures the jack and no longer the cable.
        read[c][e].given = false;
        if (!cell[c][e].empty()) cell[c][e].add(row.time, std::numeric_limits<double>::quiet_NaN());
      } else if (given.reading) {
        cell[c][e].add(row.time, *given.reading);
        read[c][e] = {true, *given.reading, row.time};
      } else if (scene_.cables[c].is_jacked(e) && !cell[c][e].empty()) {
        cell[c][e].add(row.time, given.force);  // an empty field keeps the load
      }
    }
}

void RunRecord::add_jacks(const LogRow& row, const Answer& answer, const Answer* expected) {
  std::size_t first = 0;
  for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
    const CableDescription& cable = scene_.cables[c];
    for (std::size_t e = 0; e < 2; ++e) {
      if (!cable.is_jacked(e)) continue;
      const EndRow& given = row.cables[c][e];
      const double anchored = answer.tension[first + (e == 0 ? 0 : cable.segments() - 1)];
      if (!given.locked && anchored > peaks[c][e].force) peaks[c][e] = {anchored, answer.tension};
      const Alarm outlier = Alarm::of(Alarm::Kind::outlier, static_cast<int>(c), static_cast<int>(e));
      JackRow jack;
      jack.row = row.row;
      jack.time = row.time;
      jack.force = given.force;
      jack.locked = given.locked;
      jack.stroke = given.stroke;
      if (expected != nullptr) jack.expected = expected->extension[c][e];
      jack.anchored = anchored;
      add_stage(c, e, jack, has_word(answer.alarms, alarm_word(outlier, scene_)));
    }
    first += cable.segments();
  }
}

// A jack that goes far from one row to the next is an outlier to the estimator at first. Only what sticks out
// is none of the jack's forces.
void RunRecord::add_stage(std::size_t c, std::size_t e, const JackRow& jack, bool is_outlier) {
  Waiting& waiting = waiting_[c][e];
  if (is_outlier) {
    waiting.outlier = jack;
    return;
  }
  if (waiting.outlier) {
    const auto [low, high] = std::minmax(waiting.before, jack.force);
    if (waiting.outlier->force >= low && waiting.outlier->force <= high) stages[c][e].add(*waiting.outlier);
    waiting.outlier.reset();
  }
  waiting.before = jack.force;
  stages[c][e].add(jack);
}

void RunRecord::add_tensions(const LogRow& row, const Answer& answer) {
  for (std::size_t i = 0; i < answer.tension.size(); ++i) {
    tension[i].add(row.time, answer.tension[i]);
    if (answer.tension[i] > largest.force)
      largest = {answer.tension[i], answer.deviation[i], row.time, i, row.row};
  }
}

void RunRecord::add_mu(const LogRow& row, const Answer& answer) {
  for (std::size_t j = 0; j < answer.mu.size(); ++j) {
    const double half = band_width * answer.mu_deviation[j];
    mu[j].add(row.time, answer.mu[j]);
    least_mu[j].add(row.time, std::max(answer.mu[j] - half, 0.0));
    most_mu[j].add(row.time, answer.mu[j] + half);
  }
}

void RunRecord::add_states(const LogRow& row, const Answer& answer) {
  StateSpan span{row.time, row.time, std::vector<StateCounts>(answer.state.size(), StateCounts{})};
  for (std::size_t j = 0; j < answer.state.size(); ++j)
    span.joints[j].at(static_cast<std::size_t>(answer.state[j])) = 1;
  states.add(span);
}

}  // namespace taut::host
