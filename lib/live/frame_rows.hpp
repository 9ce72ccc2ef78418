// Samples on the line of the firmware's monitor as rows of a log.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// The body of a frame `$<body>*<CRC-32 of the body, 8 hexadecimal digits>`; nothing if the line is none.
std::optional<std::string_view> frame_body(std::string_view line);

/// Listens to what is sent to a device: `S` has a sample, `L` and `J` lock a jack off and jack again, `C`
/// begins anew. A sample that is sent again is one; of all other frames, also those of the device, nothing
/// becomes a row. Time counts in seconds from the first sample.
class FrameRows {
 public:
  explicit FrameRows(const SceneDescription& scene);

  /// The header of the log that the rows belong to.
  const std::string& header() const { return header_; }
  /// The row that a line holds, nothing if it holds another frame. A line that is no whole frame, or a sample
  /// of another scene, comes back as it is: no log has such a row.
  std::optional<std::string> row(const std::string& line);

 private:
  std::optional<std::string> sample(const std::vector<std::string_view>& fields);
  bool lock(const std::vector<std::string_view>& fields, bool is_locked);

  const SceneDescription& scene_;
  std::string header_;
  std::vector<std::array<bool, 2>> locked_;
  std::optional<std::uint32_t> sequence_;
  double time_ = 0;
  bool has_row_ = false;
};

}  // namespace taut::host
