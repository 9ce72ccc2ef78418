// The tables of a report.
#pragma once

#include <cstddef>
#include <string>

#include "lib/report/report_view.hpp"

namespace taut::host {

/// What alarms there were, what they mean and what to do.
std::string alarm_table(const ReportView& view);

/// What was noticed that needs no action, and what it means, every episode once; empty if there is none.
std::string notice_table(const ReportView& view);

/// One mu in a sentence: what was known of it, what is, and from which columns of the log that comes.
std::string learned_sentence(const LearnedFriction& learned, const Words& say = Words());

/// Every mu that was not known, in a sentence each and as a table of the columns that taught it; empty if
/// there is none.
std::string learned_table(const ReportView& view);

/// Force, friction and contact of one cable after the last row.
std::string final_table(const ReportView& view, std::size_t cable);

}  // namespace taut::host
