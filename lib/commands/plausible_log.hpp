// Whether the readings of a log can be those of its scene.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lib/commands/clock_gap.hpp"
#include "lib/commands/end_doubts.hpp"
#include "lib/commands/every_so_many.hpp"
#include "lib/commands/reading_scatter.hpp"
#include "lib/commands/unit_step.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"

namespace taut::host {

/// A far end that is shown `gap` [s] later than its jack, below zero if the jack is, and what to say of that.
struct LateFarEnd {
  std::size_t cable, end;
  double gap;
  Sentence remark;
};

/// Takes the readings of a log row by row and judges them together, so that single wrong readings, which are
/// for the estimator to leave out, do not count. Memory: bounded.
class PlausibleLog {
 public:
  explicit PlausibleLog(const SceneDescription& scene);

  void take(const LogRow& row);
  /// Throws InputError, unless the scene says "plausible": false, if most readings of a jack strain its cable
  /// by more than 2 %, or all jacks together none by 1e-5, which is what kN of an ordinary jacking look like,
  /// though they pull; if a cell goes over to another unit, see UnitStep; if a stroke grows a hundred times
  /// faster with the force than the cable stretches; if a stroke, but for the tenth of its readings at either
  /// end, goes over more than a tenth of the cable; if a described cell scatters by more than a tenth of what
  /// the jacks of its cable ever pull, by more than half of it while that strains the cable by less than
  /// 1e-4, though these readings do not; and, where the log does not go on from a state, if no jack of a
  /// cable has a column though other instruments read it under load.
  void require(const LogReader& log, const std::string& path, bool has_past) const;
  /// What may be meant and probably is not: see EndDoubts.
  std::vector<Sentence> doubts() const;
  /// The far ends whose clock, or filter, differs from that of their jack, see ClockGap; not those of which a
  /// `lag` of the later one says at least half of that. Cost: that of ClockGap::found() a cable.
  std::vector<LateFarEnd> late_far_ends() const;

 private:
  struct Jack {
    ReadingScatter within;
    std::size_t beyond = 0, line = 0;  // the first beyond
    double force = 0;                  // there

    std::size_t readings() const { return within.readings() + beyond; }
    /// What it pulls at most, if its readings are not noise alone; otherwise 0.
    double pull() const;
  };
  struct Stroke {
    double at;
    std::size_t line;
    double force;  ///< that the jack read in the same row; not a number: none
  };
  struct Cable {
    std::array<Jack, 2> jack;
    std::array<EverySoMany<Stroke, 4096>, 2> stroke;  // every so many of a long log are enough
    std::array<UnitStep, 2> unit;
    std::array<EndDoubts, 2> doubts;
    ClockGap clock;
    bool is_read_under_load = false;  ///< by other instruments
  };

  void require_units_of_jacks(const LogReader& log, const std::string& path) const;
  void require_one_unit(std::size_t c, std::size_t end, const LogReader& log, const std::string& path) const;
  void require_stretch(std::size_t c, std::size_t end, const LogReader& log, const std::string& path) const;
  void require_strokes(std::size_t c, std::size_t end, const LogReader& log, const std::string& path) const;
  void require_deviations(std::size_t c) const;
  void require_column(std::size_t c, const LogReader& log, const std::string& path) const;

  const SceneDescription& scene_;
  std::vector<Cable> cables_;
};

}  // namespace taut::host
