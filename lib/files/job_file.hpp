// What a stressing record says beside the numbers: project, instruments, required stages.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// An instrument as its certificate names it.
struct JobInstrument {
  std::string id, calibrated, certificate;
};

/// A required stage: the forces of the jacks that it names [N].
struct JobStage {
  std::string name;
  std::vector<std::array<std::optional<double>, 2>> force;  ///< of the jacks of every cable
};

/// A job file. What it does not say is left open on the record, to be written by hand.
struct Job {
  std::string project, drawing, contractor, crew, witness, date, remarks;
  std::map<std::string, JobInstrument> instruments;  ///< by column of the log
  std::vector<JobStage> stages;
  std::optional<double> elongation_tolerance;  ///< of the net elongation, relative to the expected one
  double force_tolerance = 0.02;               ///< of the measured force, relative to the required one
};

/// Reads a job file (JSON; see README.md of lib). Throws InputError with file, JSON pointer and remedy for
/// what does not fit the format or the scene.
Job read_job_file(const std::string& path, const SceneDescription& scene);

}  // namespace taut::host
