// `taut simulate` and `taut estimate`: forces of all cables for every row of a log.
#pragma once

#include "lib/commands/log_follower.hpp"

namespace taut::host {

/// Writes the result of a log and returns the exit status: 0, or 1 if there is no answer at some row; the
/// rows before it are written. Remarks and failures go to standard error. Throws InputError for
/// unusable input, with nothing written; of a log from standard input, the rows before it are.
int run_log(const RunOptions& options);

}  // namespace taut::host
