// A scene and the method that computes it, behind one interface for all their types.
#pragma once

#include <string>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/learned_friction.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "taut/estimation/alarms.hpp"
#include "taut/status.hpp"

namespace taut::host {

/// How far a model came on its path.
struct [[nodiscard]] Followed {
  Status status;
  double fraction = 1;  ///< of the path; 0 if it is not known where the path ends for lack of an answer

  bool whole() const { return status.ok() && fraction >= 1; }
};

/// A valid scene with a solver for it.
class Model {
 public:
  virtual ~Model() = default;

  /// Brings the prestrain on. Methods that need load steps take `substeps`, here and in advance().
  virtual Followed start(int substeps) = 0;
  /// After start(): cables were under load before the first row, and nobody knows how they came there.
  virtual void forget_past() {}
  /// After start(): the first row is to say whether there was such a load, see is_under_load().
  virtual void doubt_past() {}
  /// After all there was none.
  virtual void deny_past() {}
  /// Follows the path to the loads and jack forces of the row.
  virtual Followed advance(const LogRow& row, int substeps) = 0;
  /// All that restore() needs, as bytes; empty for a method that cannot go on.
  virtual std::string save() const { return ""; }
  /// Whether forces still depend on a past that is not known.
  virtual bool has_unknown_past() const { return false; }
  /// In place of start(): goes on where a model of the same scene was saved, with its last row at `time` [s].
  virtual Followed restore(const std::string& bytes, double time);
  /// The present state.
  virtual void read(Answer& answer) const = 0;
  /// The displacements of SceneDescription::watched [m]; empty for a method that knows none.
  virtual std::vector<double> watched() const { return {}; }
  /// What has been learned since the start of every mu that was not known, and from what; of the method
  /// `estimate` alone.
  virtual std::vector<LearnedFriction> learned() const { return {}; }
  /// Axial forces of the struts with their standard deviations [N]; of the method `estimate` alone.
  virtual std::vector<StrutEstimate> struts() const { return {}; }
};

inline Followed Model::restore(const std::string&, double) {
  return {Status::at(Code::bad_sample, Place::none, 0), 0};
}

}  // namespace taut::host
