// What an estimate leaves behind for the next log of the same site.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lib/files/date_time.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/log_verdict.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Where a log ended, with all that an Estimator needs to go on from there with the same bits.
struct SavedState {
  std::string scalar;                         ///< floating-point type of the computation
  std::vector<double> assumed;                ///< see assumptions()
  double time = 0;                            ///< of the last row [s]
  std::optional<Moment> origin;               ///< where times that are dates count from
  std::vector<double> factor;                 ///< of every load pattern
  std::vector<std::array<EndRow, 2>> cables;  ///< forces and wedges at both ends
  LogVerdict::Memory verdict;                 ///< what it remembers of the rows before
  std::string bytes;                          ///< of the model
};

/// A number that other text is most unlikely to have.
std::string fingerprint(const std::string& text);

/// What the scene says, or was taken for what it does not say, of how well instruments are known: a list of
/// numbers whose order and length depend on the scene alone.
std::vector<double> assumptions(const SceneDescription& scene);
/// Takes such a list over; its length must be that of assumptions().
void assume(const std::vector<double>& assumed, SceneDescription& scene);

/// The state as the text of a file. `scene_text` is the text of the scene file.
std::string state_text(const SavedState& state, const std::string& scene_text);
/// Reads it back. Throws InputError if `text` is not whole, or was written by another version or build of the
/// program, for another scene or with another floating-point type than `scalar`.
SavedState read_state(const std::string& path, const std::string& text, const std::string& scene_text,
                      const std::string& scalar);

}  // namespace taut::host
