// Linear and second-order theory of one scene, beside each other.
#pragma once

#include <optional>
#include <string>

#include "lib/files/scene_description.hpp"
#include "lib/kinds/model.hpp"

namespace taut::host {

/// Where a theory has no answer, or gives one that does not stand.
struct TheoryEnd {
  Followed path;
  std::string place;  ///< `line 12 of log.csv`, or how far on the way to the target
  std::string loads;  ///< factors and jack forces there, as `roof 1, C.end 1.2e6 N`; empty: none
};

/// How far linear theory is off, as parts of the largest value that second-order theory has.
struct ComparedTheories {
  TargetDescription target;  ///< of second-order theory: that of the scene, or the largest load of the log
  bool begins = false;       ///< whether cables have tension there: else nothing is followed
  bool shown = false;        ///< whether both have an answer somewhere: else the parts are empty
  std::optional<double> segments, struts, extensions;  ///< empty: all are zero, or there are none
  std::optional<TheoryEnd> linear, second;             ///< empty: it has an answer to the end
};

/// Follows the rows of the log with both theories; without one (empty path) the way from no load to the
/// target of the scene, or where there is none prestrain alone. Rows in which nothing goes on by a fiftieth
/// of the most that it ever is are left out: readings scatter. In a log the forces are taken for those of the
/// jacks, negative ones for zero. The method is `tracker` in double. Throws InputError for a log that cannot
/// be used. Cost: two condensations, of which that of second order is done three times over.
ComparedTheories compare_theories(const SceneDescription& scene, const std::string& log_path);

/// `"second_order": { "target": .. }` as it is to be written into the scene.
std::string second_order_key(const SceneDescription& scene, const TargetDescription& target);

}  // namespace taut::host
