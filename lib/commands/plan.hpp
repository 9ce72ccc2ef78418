// `taut plan`: how to jack so that every segment comes as near to its target as friction allows.
#pragma once

#include <string>

namespace taut::host {

struct PlanOptions {
  std::string scene, goal;
  std::string log;         ///< where the log goes; empty: nowhere
  std::string sheet;       ///< where the sheet for the site goes; empty: nowhere
  bool is_robust = false;  ///< against all that is known of mu, not for its mean alone
};

/// Prints the plan and writes its log and its sheet. Returns the exit status: 0; or 1 if the structure has no
/// answer, or none as soon as a jack moves, with nothing written, or if limits of the goal leave the best
/// plan further than far_off, which is written all the same. Throws InputError, with nothing written, for
/// unusable input.
int plan(const PlanOptions& options);

}  // namespace taut::host
