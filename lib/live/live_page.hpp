// The page of `taut watch`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/live/answer_board.hpp"

namespace taut::host {

/// What the forces are compared with [N].
struct LiveBounds {
  std::vector<double> target;        ///< of every segment; 0, or no list: none
  std::vector<double> most_segment;  ///< of every segment; no list: none
  double least_force = 0;            ///< of all segments
  double most_force = std::numeric_limits<double>::infinity();
};

/// One self-contained page of HTML that is well-formed XML, with the answer as it is now; a browser with
/// JavaScript keeps it up to date from `/events`. `log` is what the rows come from.
std::string live_page(const SceneDescription& scene, const std::string& log, const LiveBounds& bounds,
                      const LiveAnswerPtr& now);

}  // namespace taut::host
