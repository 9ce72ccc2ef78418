// What a report shows, and what all its parts agree on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lib/files/learned_friction.hpp"
#include "lib/files/sentence.hpp"
#include "lib/report/axis.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/stressing_record.hpp"
#include "lib/report/words.hpp"

namespace taut::host {

/// What was to be expected with the friction of the scene: forces of the segments after the last row.
struct NominalRun {
  std::vector<double> tension;  ///< empty: no answer
  Sentence reason;              ///< why there is none
};

/// Everything that a report shows.
struct ReportContent {
  const SceneDescription& scene;
  std::string scene_file, log_file;
  const RunRecord& record;
  NominalRun nominal;
  Sentence end;  ///< where and why the answer ends before the log does; empty if it does not
  std::vector<Sentence> remarks;
  std::vector<LearnedFriction> learned;  ///< every mu that was not known beforehand
  StressingSheet sheet;                  ///< what is signed
  std::vector<StrutEstimate> struts;     ///< of every strut after the last row; no list: not known
  Words say;
};

/// The content with one unit of force and one axis of time for all drawings and tables.
struct ReportView {
  explicit ReportView(const ReportContent& shown);

  const ReportContent& content;
  const SceneDescription& scene;
  const RunRecord& record;
  const Words& say;
  ForceUnit unit;
  double origin = 0;  ///< times count from here where they would be too long
  Axis time;
  std::string time_title;

  /// With as many decimals as the duration asks for.
  std::string time_text(double seconds) const;
  /// `at the end of the log`, unless the answer ends before it, and the same after a title.
  std::string at_end() const;
  /// The values of one cable out of those of all segments.
  std::vector<double> of_cable(const std::vector<double>& all, std::size_t cable) const;
};

}  // namespace taut::host
