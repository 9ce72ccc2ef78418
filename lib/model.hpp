// A scene and the method that computes it, behind one interface for all their types.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/answer.hpp"
#include "lib/log_file.hpp"
#include "lib/result_file.hpp"
#include "lib/scene_description.hpp"
#include "taut/estimation/alarms.hpp"
#include "taut/status.hpp"

namespace taut::host {

/// The methods of computation.
enum class Method { tracker, stepwise, estimate };

/// Those of `taut simulate` by the name that the command line gives them, the default one first.
inline const std::vector<std::pair<std::string, Method>> methods = {{"tracker", Method::tracker},
                                                                    {"stepwise", Method::stepwise}};

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
  /// Follows the path to the loads and jack forces of the row.
  virtual Followed advance(const LogRow& row, int substeps) = 0;
  /// The present state.
  virtual void read(Answer& answer) const = 0;
};

/// A model of the scene in the smallest capacity that holds it; `limits` are for the alarms of `estimate`.
/// Throws InputError if the scene cannot be used. The description must outlive the model.
std::unique_ptr<Model> make_model(const SceneDescription& scene, Method method, ScalarType scalar,
                                  const AlarmLimits<double>& limits = {});

}  // namespace taut::host
