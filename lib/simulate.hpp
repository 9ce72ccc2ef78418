// `taut simulate`: forces of all cables for every row of a log.
#pragma once

#include <string>

#include "lib/model.hpp"

namespace taut::host {

struct SimulateOptions {
  std::string scene, log;
  std::string output;  ///< empty: standard output
  Method method = methods.front().second;
  NumberFormat numbers;
  int substeps = 1;  ///< load steps a row, for the method stepwise
};

/// Writes the result of a log and returns the exit status: 0, or 1 if there is no answer at some row; the
/// rows before it are written. Remarks and failures go to standard error. Throws InputError, with nothing
/// written, for unusable input.
int simulate(const SimulateOptions& options);

}  // namespace taut::host
