// Whether the readings of a single row say that cables are under load.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/scene/scene.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Whether the load cell at an end reads more than five standard deviations of its zero and its noise, which
/// it would not without load, and not more than the cable can carry.
template <class CondensedType, class PriorType, class Readings>
bool reads_load(const CondensedType& condensed, const PriorType& prior, const Readings& readings, int c,
                std::size_t end) {
  const auto& given = readings.ends[c][end];
  const auto& cell = prior.cell[c][end];
  return given.has_force && given.force > 5 * std::sqrt(cell.zero_sd * cell.zero_sd + cell.sd * cell.sd) &&
         given.force <= linear_part(condensed).most_force[c];
}

/// Whether cables are under load in these readings: the cell of some jack reads_load(); one that is not read
/// pulls nothing. Or only wedges hold some cable, and a load cell at its other end says that they do: where
/// none is read they hold nothing, see tells_load(). For who has nothing but one row to tell whether cables
/// were under load before.
template <class CondensedType, class PriorType, class Readings>
bool is_under_load(const CondensedType& condensed, const PriorType& prior, const Readings& readings) {
  const auto& cables = linear_part(condensed).cables;
  bool is_loaded = false;
  for (int c = 0; c < cables.size(); ++c) {
    bool wedges = false, jacks = false, far_end = false;
    for (std::size_t end = 0; end < 2 && !cables[c].closed; ++end) {
      const bool pulls = reads_load(condensed, prior, readings, c, end);
      if (cables[c].ends[end] != End::jacked) {
        far_end |= pulls;
      } else if (readings.sample.jack[c][end].locked) {
        wedges = true;
      } else {
        jacks = true;
        is_loaded |= pulls;
      }
    }
    is_loaded |= wedges && !jacks && far_end;
  }
  return is_loaded;
}

/// What a row says of an end of a cable.
struct EndTells {
  bool is_jacked = false, is_locked = false, is_read = false;
  bool is_loaded = false;  ///< its load cell says so
};

/// Whether a row can tell that of so many cables: some load cell is read, but those behind wedges; and where
/// one at an anchored end says that there is load, so is some jack of its cable that is not locked: how far
/// that pulls nobody knows before. Always where there are no jacks. `end_of(cable, end)` is an EndTells.
template <class EndOf>
bool tells_load(int cables, const EndOf& end_of) {
  bool has_jacks = false, is_read = false;
  for (int c = 0; c < cables; ++c) {
    bool jack_is_read = false, jack_is_unread = false, is_loaded = false;
    for (std::size_t end = 0; end < 2; ++end) {
      const EndTells told = end_of(c, end);
      has_jacks |= told.is_jacked;
      if (told.is_jacked && told.is_locked) continue;
      is_read |= told.is_read;
      if (!told.is_jacked) is_loaded |= told.is_loaded;
      jack_is_read |= told.is_jacked && told.is_read;
      jack_is_unread |= told.is_jacked && !told.is_read;
    }
    if (is_loaded && jack_is_unread && !jack_is_read) return false;
  }
  return is_read || !has_jacks;
}

/// The same of these readings.
template <class CondensedType, class PriorType, class Readings>
bool tells_load(const CondensedType& condensed, const PriorType& prior, const Readings& readings) {
  const auto& cables = linear_part(condensed).cables;
  return tells_load(cables.size(), [&](int c, std::size_t end) -> EndTells {
    if (cables[c].closed) return {};
    return {cables[c].ends[end] == End::jacked, readings.sample.jack[c][end].locked,
            readings.ends[c][end].has_force, reads_load(condensed, prior, readings, c, end)};
  });
}

}  // namespace taut
