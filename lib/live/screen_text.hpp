// What a terminal shows of an answer.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lib/live/live_answer.hpp"

namespace taut::host {

/// Lines of at most `columns` characters, not more than `rows` of them: time, alarms, loads of the jacks, and
/// of every cable its forces as bars with their 95 % band, states of the joints and mu. `live` has a row.
/// Nothing in it is a control character.
std::vector<std::string> screen_text(const SceneDescription& scene, const LiveAnswer& live, std::size_t rows,
                                     std::size_t columns);

/// The answer on one line: `time 12.5 s: C.end 40.00 kN; C 33.35 to 40.00 kN; no alarm`.
std::string row_text(const SceneDescription& scene, const LiveAnswer& live);

}  // namespace taut::host
