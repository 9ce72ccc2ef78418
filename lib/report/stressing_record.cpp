#include "lib/report/stressing_record.hpp"

#include <algorithm>
#include <cmath>

namespace taut::host {
namespace {

constexpr double judged_part = 0.5;
constexpr double near_part = 0.05;  // of the required force, for a stage that is meant to be there

double length_of(const SceneDescription& scene, const CableDescription& cable, std::size_t segment) {
  const auto& a = scene.nodes[static_cast<std::size_t>(cable.path[segment])].at;
  const auto& b = scene.nodes[static_cast<std::size_t>(cable.path[(segment + 1) % cable.path.size()])].at;
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

double mean_force(const SceneDescription& scene, std::size_t c, const std::vector<double>& tension) {
  const std::size_t first = start_of(scene, c).segment;
  double sum = 0, length = 0;
  for (std::size_t i = 0; i < scene.cables[c].segments(); ++i) {
    const double L = length_of(scene, scene.cables[c], i);
    sum += L * tension[first + i];
    length += L;
  }
  return length > 0 ? sum / length : 0;
}

// Where the jack comes near to a force, from this line on: a stage, or else a step that it passed, which
// becomes a line.
std::optional<std::size_t> line_near(double force, std::size_t from, const LoadStages& stages,
                                     JackRecord& jack) {
  std::optional<std::size_t> nearest;  // of the stages that are near one after the other
  const auto off = [&](std::size_t i) { return std::fabs(jack.lines[i].stage.force - force); };
  for (std::size_t i = from; i < jack.lines.size(); ++i) {
    const bool is_near = jack.lines[i].stage.kind != LoadStage::Kind::locked && off(i) <= near_part * force;
    if (nearest && !is_near) break;
    if (is_near && (!nearest || off(i) < off(*nearest))) nearest = i;
  }
  if (nearest) return nearest;
  const auto passed = stages.passing(force, near_part, from == 0 ? 0 : jack.lines[from - 1].stage.last_row);
  if (!passed) return std::nullopt;
  const auto later = std::find_if(jack.lines.begin(), jack.lines.end(), [&](const StageLine& line) {
    return line.stage.first_row > passed->first_row;
  });
  const auto place = later - jack.lines.begin();
  StageLine line;
  line.stage = *passed;
  jack.lines.insert(later, line);
  return static_cast<std::size_t>(place);
}

// Stages of the job one after the other.
void take_required(const Job& job, const LoadStages& stages, JackRecord& jack) {
  std::size_t from = 0;
  for (std::size_t s = 0; s < job.stages.size(); ++s) {
    const std::optional<double>& required = job.stages[s].force[jack.cable][jack.end];
    if (!required) continue;
    const std::optional<std::size_t> near = line_near(*required, from, stages, jack);
    if (!near) {
      jack.missed.push_back(s);
      continue;
    }
    StageLine& line = jack.lines[*near];
    line.name = job.stages[s].name;
    line.required = required;
    line.force_off = line.stage.force / *required - 1;
    from = *near + 1;
  }
}

void take_elongations(JackRecord& jack) {
  const StageLine* reference = nullptr;
  for (StageLine& line : jack.lines) {
    const LoadStage& stage = line.stage;
    if (!stage.stroke || !stage.expected) continue;
    if (reference == nullptr) {
      if (stage.kind == LoadStage::Kind::locked) return;
      reference = &line;
      line.is_reference = true;
    }
    line.net = *stage.stroke - *reference->stage.stroke + *reference->stage.expected;
    if (line.is_reference || stage.kind == LoadStage::Kind::locked || *stage.expected <= 0) continue;
    line.elongation_off = *line.net / *stage.expected - 1;
    line.is_judged = stage.force >= judged_part * jack.largest;
  }
}

void take_wedge_set(JackRecord& jack) {
  for (std::size_t i = 1; i < jack.lines.size(); ++i) {
    const LoadStage &before = jack.lines[i - 1].stage, &after = jack.lines[i].stage;
    if (after.kind != LoadStage::Kind::locked || before.kind == LoadStage::Kind::locked) continue;
    if (before.stroke && after.stroke) jack.wedge_set = *before.stroke - *after.stroke;
    if (before.expected && after.expected) jack.expected_wedge_set = *before.expected - *after.expected;
  }
}

}  // namespace

double elongation_tolerance(const Job& job) {
  constexpr double of_all_tendons = 0.05;  // EN 13670
  return job.elongation_tolerance.value_or(of_all_tendons);
}

bool StageLine::passes_force(const Job& job) const {
  return !force_off || std::fabs(*force_off) <= job.force_tolerance;
}
bool StageLine::passes_elongation(const Job& job) const {
  return !is_judged || !elongation_off || std::fabs(*elongation_off) <= elongation_tolerance(job);
}

std::vector<JackRecord> jack_records(const SceneDescription& scene, const RunRecord& record, const Job& job) {
  std::vector<JackRecord> jacks;
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      if (!scene.cables[c].is_jacked(end)) continue;
      JackRecord jack;
      jack.cable = c;
      jack.end = end;
      jack.largest = record.stages[c][end].largest();
      for (const LoadStage& stage : record.stages[c][end].stages()) {
        StageLine line;
        line.stage = stage;
        jack.lines.push_back(line);
      }
      if (jack.lines.empty()) continue;
      take_required(job, record.stages[c][end], jack);
      take_elongations(jack);
      take_wedge_set(jack);
      jacks.push_back(std::move(jack));
    }
  return jacks;
}

std::vector<CableLosses> cable_losses(const SceneDescription& scene, const RunRecord& record) {
  std::vector<CableLosses> all;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const auto& peaks = record.peaks[c];
    const std::size_t end = peaks[0].force > peaks[1].force ? 0 : 1;
    const RunRecord::Peak& peak = peaks[end];
    if (peak.tension.empty()) continue;
    const CableDescription& cable = scene.cables[c];
    const auto first = static_cast<std::ptrdiff_t>(start_of(scene, c).segment);
    const auto from = peak.tension.begin() + first;
    CableLosses losses;
    losses.cable = c;
    losses.jack = peak.force;
    losses.least_then = *std::min_element(from, from + static_cast<std::ptrdiff_t>(cable.segments()));
    losses.at_jack_now =
        record.end.tension[static_cast<std::size_t>(first) + (end == 0 ? 0 : cable.segments() - 1)];
    losses.mean_then = mean_force(scene, c, peak.tension);
    losses.mean_now = mean_force(scene, c, record.end.tension);
    all.push_back(losses);
  }
  return all;
}

}  // namespace taut::host
