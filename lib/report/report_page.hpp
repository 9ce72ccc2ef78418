// The page of `taut report`.
#pragma once

#include <string>

#include "lib/report/report_view.hpp"

namespace taut::host {

/// One self-contained page of HTML that is well-formed XML.
std::string report_page(const ReportContent& content);

}  // namespace taut::host
