// The page of a report that is signed.
#pragma once

#include <string>

#include "lib/report/report_view.hpp"

namespace taut::host {

/// Project, input with its hash, instruments; of every jack the stages with required and measured forces,
/// expected, measured and net elongation; wedge set and losses; forces of all segments and struts at the end
/// with their bands, targets and limits; the verdict; room for signatures. What nobody said is left open.
std::string record_page(const ReportView& view);

}  // namespace taut::host
