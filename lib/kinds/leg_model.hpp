// A model that goes from event to event and back to where it was: for those who try many paths.
#pragma once

#include <memory>
#include <string>

#include "lib/kinds/model.hpp"

namespace taut::host {

/// A model of the method `tracker` in `double`, of which states can be kept.
class LegModel : public Model {
 public:
  /// Follows the path to the row no further than to the next place where a joint or a run changes its state;
  /// between two such places all forces and extensions are straight lines. `fraction` is of the path that was
  /// left. Fails as advance() does. Cost: that of one event.
  virtual Followed advance_to_event(const LogRow& row) = 0;
  /// After start(): goes back, or on, to a state that save() gave in a model of the same scene. Fails with
  /// `bad_sample` if it is none. Cost: that of one event.
  virtual Followed go_to(const std::string& state) = 0;
  /// The present state without the forces of struts, which take most of the time of read() where there are
  /// many.
  virtual void read_cables(Answer& answer) const = 0;
};

/// The method `tracker` for the capacity `Cap`. Compiled for each kind in a unit of its own.
template <class Scalar, class Cap>
std::unique_ptr<LegModel> make_leg_tracker(const SceneDescription& scene);

/// A model of the scene in the smallest capacity that holds it. Throws InputError if the scene cannot be
/// used. The description must outlive the model.
std::unique_ptr<LegModel> make_leg_model(const SceneDescription& scene);

}  // namespace taut::host
