// Whether what a log says of a jacked end is what happened there.
#pragma once

#include <string>
#include <vector>

#include "lib/commands/late_lock.hpp"
#include "lib/commands/locked_with_load.hpp"
#include "lib/commands/never_locked.hpp"
#include "lib/commands/rest_off_zero.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"

namespace taut::host {

/// Takes the rows of a jacked end, and asks what was meant where it is locked rows after its load was let
/// out, or in the very row of a load, or is let out and never locked though it has a wedge; or where its cell
/// rests three deviations of its zero or more off before the load rises, which a scene that says none has at
/// 0.2 % of the largest reading.
class EndDoubts {
 public:
  /// What `row` gives of the end; a reading below `least` [N] is no load.
  void take(const LogRow& row, const EndRow& given, double least, bool has_wedge);
  /// One for each of these that was found; `column` is that of the end, and `cell` what is known of it.
  std::vector<Sentence> sentences(const std::string& column, const InstrumentDescription& cell) const;

 private:
  LateLock late_;
  NeverLocked never_;
  LockedWithLoad with_load_;
  RestOffZero rest_;
};

}  // namespace taut::host
