// The verdict on an estimate, from what its alarms say and from what its log does not say.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"
#include "lib/files/unsaid_lock.hpp"
#include "lib/files/verdict.hpp"

namespace taut::host {

/// Takes the rows of a log with the alarms of their answers and judges each, see Verdict and UnsaidLock.
/// Whoever shows a verdict has it from here: the program, what plays a log to a device, exported headers.
class LogVerdict {
 public:
  /// A plain value that does not grow with the log.
  struct Memory {
    Verdict::Memory raised;
    std::vector<std::array<UnsaidLock::Memory, 2>> locks;  ///< of both ends of every cable
  };

  /// The scene must outlive it.
  explicit LogVerdict(const SceneDescription& scene);
  /// Goes on where another one of the same scene, whose memory() this is, has come to.
  LogVerdict(const SceneDescription& scene, const Memory& memory);

  /// The next row, with its alarms as alarm_word() writes them, separated by blanks; `is_stage` as for
  /// Verdict::take(), which says what is returned.
  Sentence take(const LogRow& row, const std::string& alarms, bool is_stage = false);

  Memory memory() const;

 private:
  /// A word of each end whose wedge may hold, with a blank before it, as in ` unsaid-lock:C.end`.
  std::string unsaid_locks(const LogRow& row);

  const SceneDescription* scene_;
  Verdict verdict_;
  std::vector<std::array<UnsaidLock, 2>> locks_;
};

}  // namespace taut::host
