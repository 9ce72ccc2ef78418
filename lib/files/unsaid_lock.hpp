// A jack that is let out while the log does not have its end locked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "lib/files/alarm_words.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/plausible_scene.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// Whether the wedge of an end may hold though no row says so: its jack has been let out to next to nothing,
/// for two rows at least, after it had pulled. So it may until the end is locked, its jack has pulled more
/// than ever before, or the far end has come down to less than half, too.
class UnsaidLock {
 public:
  /// A row of a jacked end that has a wedge; `reading` [N], and that of the far end, is not a number if there
  /// is none, and less than `least` is no load.
  void take(double reading, double far_end, bool locked, double least) {
    if (!std::isnan(far_end)) highest_far_ = std::max(highest_far_, far_end);
    const bool has_come_down = highest_far_ > least && far_end < highest_far_ / 2;
    if (locked || has_come_down) *this = {};
    if (locked || std::isnan(reading)) return;
    // Of two in a row, for one may be wrong.
    const double both = std::min(reading, last_);
    last_ = reading;
    if (both > highest_) {
      highest_ = both;
      let_out_ = 0;
    } else if (highest_ > least && reading < nothing * highest_) {
      ++let_out_;
    } else if (!may_hold()) {
      let_out_ = 0;
    }
  }
  bool may_hold() const { return let_out_ >= few; }

 private:
  static constexpr double nothing = 0.05;
  static constexpr int few = 2;

  double highest_ = 0, highest_far_ = 0, last_ = 0;
  int let_out_ = 0;  // rows with next to no load
};

/// The same of all ends of a scene.
class UnsaidLocks {
 public:
  /// The next row of a log. Returns a word for Verdict::take() of each end whose wedge may hold, with a blank
  /// before it, as in ` unsaid-lock:C.end`.
  std::string take(const LogRow& row, const SceneDescription& scene) {
    std::string words;
    ends_.resize(scene.cables.size());
    for (std::size_t c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const CableDescription& cable = scene.cables[c];
        if (!cable.is_jacked(end) || !(cable.seating > 0)) continue;
        const double none = std::nan("");
        const EndRow &own = row.cables[c][end], &other = row.cables[c][1 - end];
        ends_[c][end].take(own.reading.value_or(none),
                           cable.is_jacked(1 - end) ? none : other.reading.value_or(none), own.locked,
                           first_stage_strain * cable.E * cable.A);
        if (ends_[c][end].may_hold()) words += " unsaid-lock:" + end_word(cable.name, end);
      }
    return words;
  }

 private:
  std::vector<std::array<UnsaidLock, 2>> ends_;  // of every cable
};

}  // namespace taut::host
