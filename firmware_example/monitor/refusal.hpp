// Why a command is refused. Nothing has changed then.
#pragma once

#include <cstdint>

namespace monitor {

enum class Refusal : std::uint8_t {
  none,
  fields,    ///< of another scene, or a time that stands still
  sequence,  ///< older than the last sample
  scene,     ///< there is no such scene
  cell,      ///< no such end, or one without a jack to lock
  zero,      ///< loaded
  limits,    ///< not finite, or zero is not between them
  no_scene,  ///< the scene on the device was refused: there is nothing to sample
};

/// What the line says of it.
constexpr const char* word_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::sequence:
      return "sequence";
    case Refusal::scene:
    case Refusal::no_scene:
      return "scene";
    case Refusal::cell:
      return "cell";
    case Refusal::zero:
      return "zero";
    case Refusal::limits:
      return "limits";
    default:
      return "fields";
  }
}

}  // namespace monitor
