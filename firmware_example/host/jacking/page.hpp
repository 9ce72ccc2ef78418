// The record of a simulated jacking as one HTML page.
#pragma once

#include <string>
#include <vector>

namespace monitor::host {

/// One segment, or the friction coefficient, at one instant: what is true, what is estimated with its
/// standard deviation, and what the scene alone would say. Forces in kN.
struct Compared {
  double truth = 0, estimate = 0, deviation = 0, nominal = 0;
};

/// One row of the log.
struct RecordedRow {
  double time = 0;                ///< [s]
  std::vector<Compared> segment;  ///< from the anchored end to the jack
  Compared mu;                    ///< [-]; true: the mean of the joints
};

/// A page without scripts that loads nothing. `summary` are paragraphs of plain text, `shown` is the segment
/// whose force is drawn over time.
std::string jacking_page(const std::string& title, const std::vector<std::string>& summary,
                         const std::vector<RecordedRow>& rows, std::size_t shown);

}  // namespace monitor::host
