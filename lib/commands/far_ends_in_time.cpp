#include "lib/commands/far_ends_in_time.hpp"

namespace taut::host {
namespace {

constexpr double most_apart = 10;  // [s]

}  // namespace

FarEndsInTime::FarEndsInTime(const std::string& log, const SceneDescription& scene, const LogRules& rules,
                             const std::vector<LateFarEnd>& late)
    : file_(open_log(log)), log_(file_, log, scene, rules), read_(log_.first_row()) {
  for (const LateFarEnd& each : late) ends_.push_back({each.cable, each.end, each.gap, {}, {}, {}});
}

bool FarEndsInTime::next(FarEnd& end, double until) {
  while (end.ahead.empty()) {
    if (read_.time > until || !log_.next(read_)) return false;
    for (FarEnd& each : ends_)
      if (const auto& reading = read_.cables[each.cable][each.end].reading)
        each.ahead.push_back({read_.time, *reading});
  }
  end.before = end.after;
  end.after = end.ahead.front();
  end.ahead.pop_front();
  return true;
}

void FarEndsInTime::correct(LogRow& row) {
  for (FarEnd& end : ends_) {
    std::optional<double>& reading = row.cables[end.cable][end.end].reading;
    if (!reading) continue;
    const double time = row.time + end.gap;
    while (end.after.time < time && next(end, time + most_apart)) {
    }
    reading.reset();
    const Reading &before = end.before, &after = end.after;
    if (time > after.time || !(after.time - before.time <= most_apart)) continue;
    reading = before.force + (after.force - before.force) * (time - before.time) / (after.time - before.time);
  }
}

}  // namespace taut::host
