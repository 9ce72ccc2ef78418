#include "lib/commands/far_end_in_time.hpp"

namespace taut::host {
namespace {

constexpr double most_apart = 10;  // [s]

}  // namespace

FarEndInTime::FarEndInTime(const std::string& log, const SceneDescription& scene, const LogRules& rules,
                           std::size_t cable, std::size_t end, double gap)
    : file_(open_log(log)),
      log_(file_, log, scene, rules),
      ahead_(log_.first_row()),
      cable_(cable),
      end_(end),
      gap_(gap) {}

void FarEndInTime::correct(LogRow& row) {
  std::optional<double>& reading = row.cables[cable_][end_].reading;
  if (!reading) return;
  const double time = row.time + gap_;
  while (after_.time < time && log_.next(ahead_))
    if (const auto& read = ahead_.cables[cable_][end_].reading) {
      before_ = after_;
      after_ = {ahead_.time, *read};
    }
  reading.reset();
  if (time > after_.time || !(after_.time - before_.time <= most_apart)) return;
  reading =
      before_.force + (after_.force - before_.force) * (time - before_.time) / (after_.time - before_.time);
}

}  // namespace taut::host
