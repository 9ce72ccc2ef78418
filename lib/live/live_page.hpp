// The page of `taut watch`.
#pragma once

#include <string>

#include "lib/live/answer_board.hpp"

namespace taut::host {

/// One self-contained page of HTML that is well-formed XML, with the answer as it is now; a browser with
/// JavaScript keeps it up to date from `/events`. `log` is what the rows come from.
std::string live_page(const SceneDescription& scene, const std::string& log, const LiveAnswerPtr& now);

}  // namespace taut::host
