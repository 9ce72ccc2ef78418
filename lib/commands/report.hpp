// `taut report`: what `taut estimate` finds, as a record to sign and a page to look at.
#pragma once

#include <string>

#include "lib/report/words.hpp"
#include "taut/estimation/alarms.hpp"

namespace taut::host {

struct ReportOptions {
  std::string scene, log, output;
  std::string job, goal;  ///< files; empty: none
  Language language = Language::english;
  AlarmLimits<double> limits;
};

/// Writes the page and returns the exit status as run_log() does: 0, or 1 if there is no answer at some row;
/// the page then shows the rows before it. Throws InputError, with nothing written, for unusable input.
int report(const ReportOptions& options);

}  // namespace taut::host
