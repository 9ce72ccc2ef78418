// `taut watch`: forces while the structure is being tensioned.
#pragma once

#include <optional>
#include <string>

#include "taut/estimation/alarms.hpp"

namespace taut::host {

struct WatchOptions {
  std::string scene;
  std::string log;            ///< a file, or `-` for standard input; empty: `serial`
  std::string serial;         ///< DEVICE[:BAUD]; empty: `log`
  std::string http;           ///< [ADDRESS:]PORT; empty: none
  std::string record, state;  ///< empty: none
  std::string goal;           ///< of a plan to jack by; empty: none
  std::optional<double>
      speed;  ///< of the time column of the log, which is a file then; absent: the file is followed
  AlarmLimits<double> limits;
};

/// Follows the rows until they end or a signal asks for it, and returns the exit status: 0, or 1 if there is
/// no answer at some row, or no plan to the goal. Remarks and failures go to standard error. Throws
/// InputError for unusable input; what was answered before is recorded.
int watch(const WatchOptions& options);

}  // namespace taut::host
