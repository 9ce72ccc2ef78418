#include "lib/commands/clock_gap.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace taut::host {
namespace {

constexpr std::size_t least_compared = 12;
constexpr double longest_gap = 120, shortest_gap = 0.5, gap_step = 0.25, unsure = 4, longest_held = 5,
                 stages_apart = 5;  // [s]
// Parts of the largest load: where slack is out, how far it comes down as it is let out, and how far readings
// scatter at least.
constexpr double taut_from = 0.1, pulls_from = 0.3, let_out = 0.1, least_scatter = 0.001;
// How far readings may be from a path and what a gap has to mend of that, as parts of the largest: other
// errors are no gap. And how much smaller a gap makes their variance.
constexpr double on_path = 0.007, mended = 0.002, times_less = 3;
constexpr double as_good = 2;  // of variances
// A step so many times as long as those beside it says nothing of what the load does meanwhile.
constexpr double far_apart = 3;

double middle_of(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Whether one variance is so much less than another one.
bool is_better(double now, double least, double least_mended) {
  return times_less * least < now && std::sqrt(now - least) > least_mended && std::isfinite(now);
}

// Of readings that scatter about a line, by what they are off the middle of those beside them.
template <class Reading>
double deviation_of(const std::vector<Reading>& read) {
  std::vector<double> off;
  for (std::size_t i = 1; i + 1 < read.size(); ++i)
    off.push_back(std::fabs(read[i - 1].force - 2 * read[i].force + read[i + 1].force));
  if (off.empty()) return 0;
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  return off[off.size() / 2] / (0.6745 * std::sqrt(6.0));
}

// Noise that goes to and fro is none in it, and could have a beat of its own.
template <class Value>
Value mean_of(const Value& before, const Value& value, const Value& after) {
  return (before + 2 * value + after) / 4;
}

}  // namespace

void ClockGap::Series::add(const Reading& reading) {
  if (!std::isnan(before_.force))
    kept_.add({last_.time, middle_of(before_.force, last_.force, reading.force)});
  before_ = last_;
  last_ = reading;
}

// A jack's value that is written again is as old as it is, but in a hold; a far end that shows the very same
// may be dead.
void ClockGap::take(double time, double jack, double far_end, bool is_over) {
  is_over_ = is_over_ || is_over;
  if (is_over_) return;
  if (!std::isnan(jack) && !(jack_.is_last(jack) && time - jack_.read_at() < longest_held))
    jack_.add({time, jack});
  if (!std::isnan(far_end) && !far_end_.is_last(far_end)) far_end_.add({time, far_end});
}

// The rising path nearest to what is read, by pooling neighbours that fall: the highest of readings that
// scatter would be above what the load was, most of all in a hold. It ends at the top: what is let out after
// that comes through to the far end, too, where friction is low.
std::vector<ClockGap::Step> ClockGap::way_up() const {
  struct Level {
    double sum;
    std::size_t readings;

    double mean() const { return sum / static_cast<double>(readings); }
  };
  const std::vector<Reading>& read = jack_.kept();
  double largest = 0, highest = 0;
  for (const Reading& reading : read) largest = std::max(largest, reading.force);
  const double scatter = std::max(3 * deviation_of(read), least_scatter * largest);
  const auto step = [&](std::size_t i) { return read[i + 1].time - read[i].time; };
  const auto is_near = [&](std::size_t i) {
    return step(i) < far_apart * std::max(step(i - 1), step(i + 1)) ||
           std::fabs(read[i + 1].force - read[i].force) < on_path * largest;
  };
  std::vector<Step> jack;
  for (std::size_t i = 2; i + 2 < read.size(); ++i) {
    const bool comes = is_near(i - 1);
    const double mean = mean_of(read[i - 1].force, read[i].force, read[i + 1].force);
    jack.push_back({{read[i].time, comes && is_near(i) ? mean : read[i].force}, comes});
  }
  std::vector<Step> way;
  bool is_known = true;
  for (const Step& reading : jack) {
    is_known = is_known && reading.is_known;
    highest = std::max(highest, reading.force);
    if (highest > pulls_from * largest && reading.force < (1 - let_out) * highest) break;
    if (!(highest > taut_from * largest && reading.force > highest - scatter)) continue;
    way.push_back({reading, is_known});
    is_known = true;
  }
  std::vector<Level> levels;
  for (const Step& reading : way) {
    levels.push_back({reading.force, 1});
    while (levels.size() > 1 && levels.back().mean() <= levels[levels.size() - 2].mean()) {
      const Level last = levels.back();
      levels.pop_back();
      levels.back() = {levels.back().sum + last.sum, levels.back().readings + last.readings};
    }
  }
  std::size_t at = 0;
  for (const Level& level : levels)
    for (std::size_t i = 0; i < level.readings; ++i) way[at++].force = level.mean();
  return way;
}

// Where the structure gives way the part that arrives changes a little with the load: a parabola.
template <class IsUsed>
ClockGap::Path ClockGap::path(const std::vector<Step>& way, double gap, const IsUsed& is_used) const {
  // A row for each reading: what the parabola is made of, and the reading.
  Eigen::Vector4d before = Eigen::Vector4d::Zero(), last = before;
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  int rows = 0;
  std::size_t i = 1;
  for (const Reading& reading : far_end_.kept()) {
    const double at = reading.time - gap;
    if (at < way.front().time) continue;
    while (i < way.size() && way[i].time < at) ++i;
    if (i == way.size()) break;
    const Step &from = way[i - 1], &to = way[i];
    if (!to.is_known || !is_used(reading.time)) continue;
    const double load = from.force + (to.force - from.force) * (at - from.time) / (to.time - from.time),
                 part = load / way.back().force;
    const Eigen::Vector4d row(1, part, part * part, reading.force);
    if (++rows > 2) {
      const Eigen::Vector4d mean = mean_of(before, last, row);
      products += mean * mean.transpose();
    }
    before = last;
    last = row;
  }
  const Eigen::Matrix3d normal = products.topLeftCorner<3, 3>();
  const Eigen::Vector3d sum = products.topRightCorner<3, 1>();
  const auto solver = normal.ldlt();
  if (rows < static_cast<int>(least_compared) || !(solver.rcond() > 1e-9)) return {};
  const Eigen::Vector3d parabola = solver.solve(sum), bottom(1, taut_from, taut_from * taut_from);
  return {std::max(0.0, products(3, 3) - sum.dot(parabola)) / (rows - 5),
          parabola.dot(bottom) < parabola.sum() / 2};
}

bool ClockGap::is_on(const std::vector<Step>& way, double time) {
  const auto to = std::lower_bound(way.begin(), way.end(), time,
                                   [](const Step& step, double at) { return step.time < at; });
  return to != way.end() && to != way.begin() && to->is_known;
}

// What is found because of one place, as where a plug is loose or nothing is read, is no gap: without any
// quarter of the way it is found, too, in the same readings, but for one corner, which may be the only one.
bool ClockGap::is_everywhere(const std::vector<Step>& way, double gap, double least_mended) const {
  constexpr int parts = 8, without = 2;
  constexpr double as_bad = 1.1;  // of variances
  const double begin = way.front().time, part = (way.back().time - begin) / parts;
  int first_not = -1;
  for (int i = 0; i + without <= parts; ++i) {
    const double from = begin + i * part, to = from + without * part;
    const auto is_used = [&](double time) {
      return (time < from || time > to) && is_on(way, time) && is_on(way, time - gap);
    };
    const double now = path(way, 0, is_used).variance, least = path(way, gap, is_used).variance;
    if (is_better(now, least, least_mended)) continue;
    const bool is_worse = std::isfinite(least) && least > as_bad * now;
    if (is_worse || (first_not >= 0 && i - first_not >= without)) return false;
    if (first_not < 0) first_not = i;
  }
  return true;
}

double ClockGap::found() const {
  const std::vector<Reading>& far_end = far_end_.kept();
  if (far_end.size() < least_compared) return 0;
  const std::vector<Step> way = way_up();
  if (way.size() < least_compared) return 0;
  const double lasts = way.back().time - way.front().time;
  // A cell that has stopped on the way is compared with too little of it.
  if (way.back().time - far_end.back().time > lasts / 10) return 0;
  if (lasts > stages_apart * static_cast<double>(jack_.every() * (way.size() - 1))) return 0;
  const auto all = [](double) { return true; };
  const double now = path(way, 0, all).variance, most = std::min(longest_gap, lasts / 2);
  const auto variance = [&](double gap) {
    const Path found = path(way, gap, all);
    return found.rises ? found.variance : std::numeric_limits<double>::infinity();
  };
  const auto steps = static_cast<int>(most / gap_step);
  std::vector<double> tried;
  for (int i = -steps; i <= steps; ++i) tried.push_back(variance(i * gap_step));
  const auto best = std::min_element(tried.begin(), tried.end());
  double least = *best;
  const int at = static_cast<int>(best - tried.begin()) - steps;
  // Of a way that is straight for long any of many gaps is as good: the shortest of them.
  int shortest = at;
  for (int i = -steps; i <= steps; ++i)
    if (std::abs(i) < std::abs(shortest) && tried[static_cast<std::size_t>(i + steps)] < as_good * least)
      shortest = i;
  double gap = shortest * gap_step;
  if (std::abs(at - shortest) * gap_step < unsure) {
    gap = at * gap_step;
    for (int i = -10; i <= 10; ++i) {
      const double near = at * gap_step + i * gap_step / 10, found = variance(near);
      if (found < least) {
        least = found;
        gap = near;
      }
    }
  }
  double force = 0;
  for (const Reading& reading : far_end) force = std::max(force, reading.force);
  const bool is_path = std::sqrt(least) < on_path * force;
  const bool is_inside = std::fabs(gap) >= shortest_gap && std::fabs(gap) + gap_step < most;
  return is_path && is_inside && is_better(now, least, mended * force) &&
                 is_everywhere(way, gap, mended * force)
             ? gap
             : 0;
}

}  // namespace taut::host
