// A far end whose readings come later than those of its jack.
#pragma once

#include <cstddef>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "lib/files/date_time.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Reads a log once more, ahead of where it is followed or behind, for the cell at an end whose clock differs
/// from the others', see ClockGap. Memory: two readings.
class FarEndInTime {
 public:
  /// Of a log that has been checked, and of the cell at `end` of cable `cable`, which shows what it should
  /// `gap` [s] later. The scene must outlive it.
  FarEndInTime(const std::string& log, const SceneDescription& scene, const LogRules& rules,
               std::size_t cable, std::size_t end, double gap);

  /// Where the log's times count from.
  void count_from(const std::optional<Moment>& origin) { log_.count_from(origin); }
  /// If the next row of the log has a reading of the cell, gives it what it should have: on a straight line
  /// between two readings ten seconds apart at most; none if the log has no such readings.
  void correct(LogRow& row);

 private:
  struct Reading {
    double time = -std::numeric_limits<double>::infinity(), force = 0;
  };

  std::ifstream file_;
  LogReader log_;
  LogRow ahead_;
  std::size_t cable_, end_;
  double gap_;
  Reading before_, after_;
};

}  // namespace taut::host
