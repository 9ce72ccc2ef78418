// What a report needs to remember of a run, however long it is.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/log_file.hpp"
#include "lib/report/alarm_record.hpp"
#include "lib/report/curve.hpp"
#include "lib/report/load_stages.hpp"
#include "lib/report/thinned.hpp"

namespace taut::host {

/// In how many rows a joint was in each state.
using StateCounts = std::array<std::size_t, 4>;

/// States of all joints in some consecutive rows.
struct StateSpan {
  double first_time = 0, last_time = 0;
  std::vector<StateCounts> joints;
  void join(const StateSpan& later);
};

/// Whether there was an alarm in some consecutive rows.
struct AlarmSpan {
  double first_time = 0, last_time = 0;
  bool any = false;
  void join(const AlarmSpan& later);
};

/// The structure at one moment.
struct Frame {
  double time = 0;
  std::vector<double> tension, deviation;               ///< of every segment
  std::vector<double> mu, mu_deviation, contact, used;  ///< of every joint
  std::vector<JointState> state;
  void join(const Frame& later) { *this = later; }  // so that the last one is the end of the log
};

/// A load cell's last reading.
struct LastReading {
  bool given = false;
  double force = 0, time = 0;
};

/// The largest force of all segments in all rows.
struct LargestForce {
  double force = -1, deviation = 0, time = 0;
  std::size_t segment = 0, row = 0;
};

/// Takes a run row by row. Forces in N, times in s; segments and joints in the numbering of the scene.
class RunRecord {
 public:
  explicit RunRecord(const SceneDescription& scene);

  /// `expected` is what would be the answer with what the scene says of friction; null: there is none.
  void add(const LogRow& row, const Answer& answer, const Answer* expected = nullptr);

  std::size_t rows = 0;
  double first_time = 0, last_time = 0;
  Answer end;                ///< the last answer
  double verdict_since = 0;  ///< trusted, or for whatever reasons not, from this time on without a break
  LargestForce largest;
  std::vector<Curve> tension;                    ///< of every segment
  std::vector<std::array<Curve, 2>> cell;        ///< loads of jacks and readings at anchored ends
  std::vector<std::array<LastReading, 2>> read;  ///< of those, where it still says something of the cable
  std::vector<Curve> mu, least_mu, most_mu;      ///< of every joint, with its 95 % band
  Thinned<StateSpan> states;
  Thinned<AlarmSpan> alarm_spans;
  Thinned<Frame> frames;
  AlarmRecord alarms, notices;
  std::vector<std::array<LoadStages, 2>> stages;  ///< of every jack

  /// All forces when a jack pulled most, as estimated.
  struct Peak {
    double force = 0;
    std::vector<double> tension;  ///< of every segment; empty: it never pulled
  };
  std::vector<std::array<Peak, 2>> peaks;

 private:
  void add_jacks(const LogRow& row, const Answer& answer, const Answer* expected);
  void add_stage(std::size_t cable, std::size_t end, const JackRow& jack, bool is_outlier);
  void add_cells(const LogRow& row);
  void add_tensions(const LogRow& row, const Answer& answer);
  void add_mu(const LogRow& row, const Answer& answer);
  void add_states(const LogRow& row, const Answer& answer);

  /// Of a jack: what was read last, and then what is an outlier to the estimator, as long as nobody knows
  /// whether it lies between the readings about it.
  struct Waiting {
    double before = 0;
    std::optional<JackRow> outlier;
  };

  const SceneDescription& scene_;
  std::vector<std::array<Waiting, 2>> waiting_;
};

/// Half the width of a 95 % band in standard deviations.
inline constexpr double band_width = 1.96;

/// Segments and joints of all cables before cable `c`.
struct CableStart {
  std::size_t segment = 0, joint = 0;
};
CableStart start_of(const SceneDescription& scene, std::size_t c);

}  // namespace taut::host
