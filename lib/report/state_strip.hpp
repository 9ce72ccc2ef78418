// The states of a cable's joints over time.
#pragma once

#include <cstddef>
#include <string>

#include "lib/report/axis.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/words.hpp"

namespace taut::host {

/// A row for every joint of a cable. Where one place stands for several rows of the log, its height is shared
/// by the states in them, so that short ones stay visible.
std::string state_strip(const SceneDescription& scene, std::size_t cable, const RunRecord& record,
                        const Axis& time, const std::string& x_title, const Words& say = Words());

/// Colours and words of the states.
std::string state_legend(const Words& say = Words());

}  // namespace taut::host
