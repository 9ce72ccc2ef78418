#include "lib/kinds/make_model.hpp"

#include "lib/files/input_error.hpp"
#include "lib/kinds/condensed_kind.hpp"
#include "lib/kinds/kind_models.hpp"
#include "lib/kinds/leg_model.hpp"
#include "lib/kinds/valid_scene.hpp"

namespace taut::host {
namespace {

std::unique_ptr<Model> tracker_model(const SceneDescription& scene, ScalarType scalar) {
  require_valid(scene);
  return with_condensed_kind(scene, scalar, [&](auto kind) -> std::unique_ptr<Model> {
    using Kind = decltype(kind);
    return make_tracker<typename Kind::Scalar, typename Kind::Capacity>(scene);
  });
}

std::unique_ptr<Model> estimator_model(const SceneDescription& scene, ScalarType scalar,
                                       const AlarmLimits<double>& limits) {
  require_valid(scene);
  return with_condensed_kind(scene, scalar, [&](auto kind) -> std::unique_ptr<Model> {
    using Kind = decltype(kind);
    return make_estimator<typename Kind::Scalar, typename Kind::Capacity>(scene, limits);
  });
}

std::unique_ptr<Model> stepwise_model(const SceneDescription& scene, ScalarType scalar) {
  if (scene.second_order)
    throw InputError(scene.file, "/second_order", "the method stepwise knows linear theory alone",
                     "leave the key out, or use the method tracker");
  return with_capacity(
      scene,
      [&](auto kind) -> std::unique_ptr<Model> {
        using Kind = decltype(kind);
        using Cap = typename Kind::Capacity;
        return scalar == ScalarType::float32 ? make_stepwise<float, Kind::dimension, Cap>(scene)
                                             : make_stepwise<double, Kind::dimension, Cap>(scene);
      },
      LargestCapacity{});
}

}  // namespace

std::unique_ptr<LegModel> make_leg_model(const SceneDescription& scene) {
  require_valid(scene);
  return with_condensed_kind(scene, ScalarType::float64, [&](auto kind) -> std::unique_ptr<LegModel> {
    using Kind = decltype(kind);
    return make_leg_tracker<typename Kind::Scalar, typename Kind::Capacity>(scene);
  });
}

std::unique_ptr<Model> make_model(const SceneDescription& scene, Method method, ScalarType scalar,
                                  const AlarmLimits<double>& limits) {
  switch (method) {
    case Method::tracker:
      return tracker_model(scene, scalar);
    case Method::stepwise:
      return stepwise_model(scene, scalar);
    case Method::estimate:
      return estimator_model(scene, scalar, limits);
  }
  return nullptr;
}

}  // namespace taut::host
