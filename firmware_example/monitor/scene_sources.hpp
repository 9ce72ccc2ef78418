// Where the condensed scene of a session comes from.
#pragma once

#include <cstdint>
#include <type_traits>

#include "monitor/crc32.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/condensation/condensed.hpp"
#include "taut/status.hpp"

namespace monitor {

/// A scene that `taut export` has condensed: constants in flash. `Exported` has model() and struts().
template <class Exported>
class FromFlash {
 public:
  using Capacity = typename Exported::Capacity;

  taut::Status prepare() { return taut::Status::success(); }
  static constexpr const taut::Condensed<float, Capacity>& model() { return Exported::model(); }
  static constexpr const taut::CondensedStruts<float, Capacity>* struts() { return Exported::struts(); }
};

/// A scene as it was drawn, in flash too, that the device condenses itself when it is chosen.
template <const auto& scene>
class CondensedAtStartUp {
 public:
  using SceneType = std::decay_t<decltype(scene)>;
  using Capacity = typename SceneType::Capacity;

  taut::Status prepare() { return condensation_.run(scene, condensed_, &struts_); }
  const taut::Condensed<float, Capacity>& model() const { return condensed_; }
  const taut::CondensedStruts<float, Capacity>* struts() const { return &struts_; }

 private:
  taut::Condensation<float, SceneType> condensation_;
  taut::Condensed<float, Capacity> condensed_;
  taut::CondensedStruts<float, Capacity> struts_;
};

/// A number that changes with everything that the scene's answers depend on.
template <class Capacity>
std::uint32_t fingerprint(const taut::Condensed<float, Capacity>& model) {
  Crc32 crc;
  const auto add = [&crc](const auto& value) { crc.add(&value, sizeof value); };
  for (const auto& cable : model.cables) {
    // Field by field: what lies between them is undefined.
    add(cable.closed);
    add(cable.ends);
    add(cable.seating);
    add(cable.nodes);
    add(cable.first_segment);
    add(cable.first_joint);
  }
  add(model.segments);
  add(model.joints);
  add(model.loads);
  add(model.coupling);
  if constexpr (Capacity::segments > 0) add(model.prestrain);
  if constexpr (Capacity::loads > 0) add(model.load);
  if constexpr (Capacity::joints > 0) add(model.rho);
  return crc.value();
}

}  // namespace monitor
