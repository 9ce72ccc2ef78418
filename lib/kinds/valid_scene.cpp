#include "lib/kinds/valid_scene.hpp"

#include "lib/files/plausible_scene.hpp"
#include "lib/kinds/capacities.hpp"

namespace taut::host {

void require_valid(const SceneDescription& described) {
  with_capacity(described, [&](auto kind) {
    using Kind = decltype(kind);
    return make_valid_scene<Kind::dimension, typename Kind::Capacity>(described) != nullptr;
  });
  require_plausible(described);
}

}  // namespace taut::host
