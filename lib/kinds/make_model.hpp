// A model for any scene, method and precision.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/files/result_file.hpp"
#include "lib/kinds/model.hpp"

namespace taut::host {

/// The methods of computation.
enum class Method { tracker, stepwise, estimate };

/// Those of `taut simulate` by the name that the command line gives them, the default one first.
inline const std::vector<std::pair<std::string, Method>> methods = {{"tracker", Method::tracker},
                                                                    {"stepwise", Method::stepwise}};

/// A model of the scene in the smallest capacity that holds it; `limits` are for the alarms of `estimate`.
/// Throws InputError if the scene cannot be used. The description must outlive the model.
std::unique_ptr<Model> make_model(const SceneDescription& scene, Method method, ScalarType scalar,
                                  const AlarmLimits<double>& limits = {});

}  // namespace taut::host
