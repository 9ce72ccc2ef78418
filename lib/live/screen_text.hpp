// What a terminal shows of an answer.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lib/live/live_answer.hpp"

namespace taut::host {

/// Lines of at most `columns` characters, not more than `rows` of them: time, alarms, loads of the jacks, and
/// of every cable its forces as bars with their 95 % band, states of the joints and mu. With a plan what is
/// to be done, its stages, and the load of every jack as a bar with a mark at its stage. `live` has a row.
/// Nothing in it is a control character.
std::vector<std::string> screen_text(const SceneDescription& scene, const LiveAnswer& live, std::size_t rows,
                                     std::size_t columns);

/// The answer on one line: `time 12.5 s: C.end 40.00 kN; C 33.35 to 40.00 kN; no alarm`, and behind it what
/// the plan says.
std::string row_text(const SceneDescription& scene, const LiveAnswer& live);

}  // namespace taut::host
