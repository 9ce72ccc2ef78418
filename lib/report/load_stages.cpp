#include "lib/report/load_stages.hpp"

#include <algorithm>
#include <cmath>

namespace taut::host {
namespace {

constexpr double step_part = 0.01, widest_step_part = 0.05, turn_part = 0.02, idle_part = 1.0 / 30,
                 low_part = 1.0 / 3, reference_part = 0.1;
constexpr double steps_a_rest = 1.5, steps_a_lone_row = 4, slope_part = 0.25, slow_part = 0.25;
constexpr double lone_time = 300;      // [s]: no ramp is logged at such a rate
constexpr std::size_t least_rows = 3;  // for a slope

}  // namespace

void ReadingNoise::add(double time, double reading) {
  if (count_ >= 2 && time > before_ && before_ > two_before_) {
    // Off the straight line through the two readings before.
    const double part = (time - before_) / (before_ - two_before_);
    const double off = reading - (last_ + part * (last_ - second_last_));
    const double variance = off * off / (1 + (1 + part) * (1 + part) + part * part);
    const int bin = variance > 0 ? std::clamp(std::ilogb(variance) + half_bins, 0, 2 * half_bins - 1) : 0;
    ++bins_[static_cast<std::size_t>(bin)];
    ++total_;
  }
  two_before_ = before_;
  before_ = time;
  second_last_ = last_;
  last_ = reading;
  ++count_;
}

double ReadingNoise::deviation() const {
  constexpr double median_of_square = 0.455;  // of a normal variable with the variance 1
  constexpr std::size_t enough = 100;         // a row a stage is no noise
  if (total_ < enough) return 0;
  std::size_t sum = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin)
    if (2 * (sum += bins_[bin]) >= total_)
      return bin == 0 ? 0 : std::sqrt(std::ldexp(1.5, static_cast<int>(bin) - half_bins) / median_of_square);
  return 0;
}

void Trend::add(double x, double y) {
  Trend point;
  point.count_ = 1;
  point.x_ = x;
  point.y_ = y;
  join(point);
}

void Trend::join(const Trend& later) {
  const auto n = static_cast<double>(count_), m = static_cast<double>(later.count_);
  if (count_ + later.count_ == 0) return;
  const double dx = later.x_ - x_, dy = later.y_ - y_, weight = n * m / (n + m);
  xx_ += later.xx_ + weight * dx * dx;
  xy_ += later.xy_ + weight * dx * dy;
  x_ += dx * m / (n + m);
  y_ += dy * m / (n + m);
  count_ += later.count_;
}

bool LoadStages::Step::takes(const Step& later, double band) const {
  return locked == later.locked &&
         (locked || std::max(most, later.most) - std::min(least, later.least) <= band);
}

void LoadStages::Step::join(const Step& later) {
  last_row = later.last_row;
  last_time = later.last_time;
  least = std::min(least, later.least);
  most = std::max(most, later.most);
  force.join(later.force);
  stroke.join(later.stroke);
  expected.join(later.expected);
  trend.join(later.trend);
}

LoadStage LoadStages::Step::stage(LoadStage::Kind kind) const {
  return {kind,      first_row,     last_row,          first_time,
          last_time, force.value(), stroke.optional(), expected.optional()};
}

void LoadStages::add(const JackRow& row) {
  Step step;
  step.first_row = step.last_row = row.row;
  step.first_time = step.last_time = row.time;
  step.locked = row.locked;
  const double force = row.locked ? row.anchored : row.force;
  step.least = step.most = force;
  step.force.add(force);
  step.trend.add(row.time, force);
  if (row.stroke) step.stroke.add(*row.stroke);
  if (row.expected) step.expected.add(*row.expected);
  if (!row.locked) largest_ = std::max(largest_, force);
  if (!row.locked) noise_.add(row.time, force);
  const double band = coarse_ * this->band();
  if (!steps_.empty() && steps_.back().takes(step, band)) {
    steps_.back().join(step);
    return;
  }
  steps_.push_back(step);
  while (steps_.size() > most_steps) {
    coarse_ *= 2;
    steps_ = joined(steps_, coarse_ * this->band());
  }
}

double LoadStages::band() const {
  constexpr double deviations = 8;  // nearly all readings of a hold lie within so many
  return std::clamp(deviations * noise_.deviation(), step_part * largest_, widest_step_part * largest_);
}

std::vector<LoadStages::Step> LoadStages::joined(const std::vector<Step>& steps, double band) {
  std::vector<Step> fewer;
  for (const Step& step : steps)
    if (!fewer.empty() && fewer.back().takes(step, band))
      fewer.back().join(step);
    else
      fewer.push_back(step);
  return fewer;
}

// The speed below which the force grows by a quarter of all that it grows by.
// A jack that waits for its turn without force does not pull yet.
double LoadStages::pulling_speed(const std::vector<Step>& steps, double idle) {
  struct Way {
    double speed, length;
  };
  std::vector<Way> ways;
  double total = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double begin = steps[i - 1].mean() < idle ? steps[i - 1].last_time : steps[i - 1].middle();
    const double length = steps[i].mean() - steps[i - 1].mean(), time = steps[i].middle() - begin;
    if (steps[i].locked || steps[i - 1].locked || !(length > 0) || !(time > 0)) continue;
    ways.push_back({length / time, length});
    total += length;
  }
  std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.speed < b.speed; });
  double sum = 0;
  for (const Way& way : ways)
    if ((sum += way.length) >= slow_part * total) return way.speed;
  return 0;
}

// A rest that noise has cut into pieces is one.
std::vector<LoadStages::Step> LoadStages::rested(const std::vector<Step>& steps, double band, double idle) {
  const double speed = pulling_speed(steps, idle);

  std::vector<Step> found;
  std::size_t last_rest = 0;  // in `found`, from which on nothing has left its band
  bool has_rest = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Step step = steps[i];
    // A row stands until the next one.
    const double until = i + 1 < steps.size() ? steps[i + 1].first_time : step.last_time;
    const bool has_slope = step.trend.count() >= least_rows;
    const bool is_flat = !has_slope || std::fabs(step.trend.slope()) < slope_part * speed;
    const double rest = (has_slope ? steps_a_rest : steps_a_lone_row) * band;
    const double stood = until - step.first_time;
    const bool is_lone = step.trend.count() == 1 && stood >= lone_time;
    step.rests = !step.locked && is_flat && (stood * speed >= rest || (is_lone && speed > 0));
    has_rest = has_rest && !step.locked && std::fabs(found[last_rest].mean() - step.mean()) <= band;
    if (step.rests && has_rest) {
      for (std::size_t k = last_rest + 1; k < found.size(); ++k) found[last_rest].join(found[k]);
      found.resize(last_rest + 1);
      found[last_rest].join(step);
      continue;
    }
    found.push_back(step);
    if (step.rests) {
      last_rest = found.size() - 1;
      has_rest = true;
    }
  }
  return found;
}

// Where the force comes back by more than noise, and before the wedge is set.
void LoadStages::mark_turns(std::vector<Step>& steps, double least) {
  std::size_t high = 0, low = 0;
  int direction = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].locked) {
      if (i > 0) steps[i - 1].turns = true;
      high = low = i + 1;
      direction = 0;
      continue;
    }
    const double force = steps[i].mean();
    if (force > steps[high].mean()) high = i;
    if (force < steps[low].mean()) low = i;
    if (direction >= 0 && steps[high].mean() - force > least) {
      if (direction > 0) steps[high].turns = true;
      direction = -1;
      low = i;
    } else if (direction <= 0 && force - steps[low].mean() > least) {
      if (direction < 0) steps[low].turns = true;
      direction = 1;
      high = i;
    }
  }
}

std::vector<LoadStage> LoadStages::stages() const {
  if (!(largest_ > 0)) return {};
  std::vector<Step> steps = rested(joined(steps_, band()), band(), idle_part * largest_);
  mark_turns(steps, std::max(turn_part * largest_, band()));
  std::vector<LoadStage> stages;
  bool has_pulled = false;
  for (const Step& step : steps) {
    has_pulled = has_pulled || step.most >= largest_;
    if (!has_pulled && !step.locked && step.mean() < idle_part * largest_) continue;
    if (step.locked)
      stages.push_back(step.stage(LoadStage::Kind::locked));
    else if (step.rests)
      stages.push_back(step.stage(LoadStage::Kind::hold));
    else if (step.turns)
      stages.push_back(step.stage(LoadStage::Kind::turn));
    else if (&step == &steps.back())
      stages.push_back(step.stage(LoadStage::Kind::last));
  }
  if (stages.front().force > low_part * largest_)
    for (const Step& step : steps) {
      if (step.first_row >= stages.front().first_row) break;
      if (step.mean() < reference_part * largest_) continue;
      stages.insert(stages.begin(), step.stage(LoadStage::Kind::reference));
      break;
    }
  if (stages.size() > most_stages)
    stages.erase(stages.begin() + static_cast<std::ptrdiff_t>(most_stages) - 1, stages.end() - 1);
  return stages;
}

std::optional<LoadStage> LoadStages::passing(double force, double part, std::size_t after_row) const {
  const Step* nearest = nullptr;
  for (const Step& step : steps_) {
    if (step.locked || step.first_row <= after_row) continue;
    const double off = std::fabs(step.mean() - force);
    if (off <= part * force && (nearest == nullptr || off < std::fabs(nearest->mean() - force)))
      nearest = &step;
  }
  return nearest == nullptr ? std::nullopt
                            : std::optional<LoadStage>(nearest->stage(LoadStage::Kind::passed));
}

}  // namespace taut::host
