#include "lib/report/report_view.hpp"

#include <cmath>

namespace taut::host {

ReportView::ReportView(const ReportContent& shown)
    : content(shown),
      scene(shown.scene),
      record(shown.record),
      say(shown.say),
      unit(ForceUnit::for_largest(shown.record.largest.force)) {
  Range range;
  range.include(record.first_time);
  range.include(record.last_time);
  const double duration = record.last_time - record.first_time;
  const bool is_far = std::fabs(record.first_time) > 3 * duration && duration > 0;
  if (is_far) origin = record.first_time;
  time = Axis::exact(range, 5, origin);
  constexpr std::size_t long_label = 6;
  if (!time.ticks.empty() && time.ticks.back().label.size() >= long_label)
    time = Axis::exact(range, 3, origin);
  time_title = is_far ? say("time since {1} [s]", {time_text(origin)}) : say("time [s]");
}

std::string ReportView::time_text(double seconds) const {
  const double duration = record.last_time - record.first_time;
  return coordinate(seconds, duration >= 10 ? 2 : duration >= 0.1 || duration == 0 ? 4 : 7);
}

std::string ReportView::at_end() const {
  return content.end.empty() ? say("at the end of the log")
                             : say("after row {1}", {std::to_string(record.rows)});
}

std::vector<double> ReportView::of_cable(const std::vector<double>& all, std::size_t c) const {
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(start_of(scene, c).segment);
  return {first, first + static_cast<std::ptrdiff_t>(scene.cables[c].segments())};
}

}  // namespace taut::host
