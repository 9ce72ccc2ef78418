// Far ends whose readings come later than those of their jacks.
#pragma once

#include <cstddef>
#include <deque>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/commands/plausible_log.hpp"
#include "lib/files/date_time.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Reads a log once more, ahead of where it is followed or behind, for cells at ends whose clocks differ from
/// the others', see ClockGap. Memory: the readings of the time by which the gaps of these ends differ, and of
/// ten seconds.
class FarEndsInTime {
 public:
  /// Of a log that has been checked, and of ends of which there is one at least. The scene must outlive it.
  FarEndsInTime(const std::string& log, const SceneDescription& scene, const LogRules& rules,
                const std::vector<LateFarEnd>& late);

  /// Where the log's times count from.
  void count_from(const std::optional<Moment>& origin) { log_.count_from(origin); }
  /// Gives each of these cells that is read in the next row of the log what it should read there: on a
  /// straight line between two readings ten seconds apart at most; none if the log has no such readings.
  void correct(LogRow& row);

 private:
  struct Reading {
    double time = -std::numeric_limits<double>::infinity(), force = 0;
  };
  struct FarEnd {
    std::size_t cable, end;
    double gap;
    Reading before, after;
    std::deque<Reading> ahead;
  };

  /// Goes on to the next reading of an end, if there is one until some time; what others have before it waits
  /// for them.
  bool next(FarEnd& end, double until);

  std::ifstream file_;
  LogReader log_;
  LogRow read_;
  std::vector<FarEnd> ends_;
};

}  // namespace taut::host
