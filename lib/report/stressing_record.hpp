// The account of a tensioning that is signed: stages, elongations, wedge set, losses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/files/job_file.hpp"
#include "lib/report/load_stages.hpp"
#include "lib/report/run_record.hpp"

namespace taut::host {

/// What a record needs that is not in a run.
struct StressingSheet {
  Job job;
  std::string version;               ///< of the program
  std::string scene_hash, log_hash;  ///< see sha256()
  std::string began;                 ///< date and time of the first row, if the log has them
  std::vector<double> target;        ///< of every segment [N]; 0, or no list: none
  std::vector<double> most_segment;  ///< of every segment [N]; no list: none
  double least_force = 0;            ///< of all segments [N]
  std::optional<double> most_force;  ///< of all segments [N]
};

/// Of the job, or else 0.05, which EN 13670 allows for all tendons together.
double elongation_tolerance(const Job& job);

/// A stage beside what is required of it. Units: N, m.
struct StageLine {
  LoadStage stage;
  std::string name;                      ///< as the job calls it
  std::optional<double> required;        ///< force of the jack
  std::optional<double> force_off;       ///< of the measured force, relative to the required one
  std::optional<double> net;             ///< elongation without slack and without the mark's zero
  std::optional<double> elongation_off;  ///< of the net elongation, relative to the expected one
  bool is_reference = false;             ///< strokes are counted from here
  bool is_judged = false;                ///< the force is at least half of the largest one
  bool passes_force(const Job& job) const;
  bool passes_elongation(const Job& job) const;
};

/// A jack.
struct JackRecord {
  std::size_t cable = 0, end = 0;
  std::vector<StageLine> lines;
  std::vector<std::size_t> missed;                      ///< stages of the job that were not reached
  std::optional<double> wedge_set, expected_wedge_set;  ///< draw-in at the last lock-off [m]
  double largest = 0;                                   ///< measured force [N]
};

/// What a cable has lost on the way. Units: N.
struct CableLosses {
  std::size_t cable = 0;
  double jack = 0;                     ///< the largest force at its jacks, as estimated, of two the larger
  double least_then = 0;               ///< the least force of a segment when the jacks were there
  double at_jack_now = 0;              ///< force of the segment at that jack at the end
  double mean_then = 0, mean_now = 0;  ///< over the length of the cable
};

/// The account of every jack that pulled. The net elongation of a stage is what the stroke has grown by
/// since the reference stage, and what was to be expected there: that takes slack out, and the mark's zero.
/// The reference is the first stage that has both strokes.
std::vector<JackRecord> jack_records(const SceneDescription& scene, const RunRecord& record, const Job& job);

/// Of every cable that was pulled.
std::vector<CableLosses> cable_losses(const SceneDescription& scene, const RunRecord& record);

}  // namespace taut::host
