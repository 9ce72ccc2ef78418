// The charts of a report, for one cable each.
#pragma once

#include <cstddef>
#include <string>

#include "lib/report/report_view.hpp"

namespace taut::host {

/// Force in the segments after the last row, with its band, beside readings and the prediction.
std::string force_chart(const ReportView& view, std::size_t cable);

/// Jack loads and the force in the segments over time, with alarms.
std::string time_chart(const ReportView& view, std::size_t cable);

/// Friction coefficients over time, with their bands.
std::string mu_chart(const ReportView& view, std::size_t cable);

}  // namespace taut::host
