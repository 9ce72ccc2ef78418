// The scenes of the device, by the numbers of the command C, and the application with them.
#pragma once

#include "flash_scene.hpp"  // made by the build from the output of `taut export`
#include "monitor/application.hpp"
#include "monitor/scene_sources.hpp"
#include "monitor/scenes/truss_string.hpp"

#ifdef __FAST_MATH__
#error "taut needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace monitor {

template <class Board, class SettingsType>
struct ApplicationOn {
  template <class... Sources>
  using With = Application<Board, SettingsType, Sources...>;
};

template <class Board, class SettingsType = Settings>
using Monitor = OfFlashScenes<ApplicationOn<Board, SettingsType>::template With, FromFlash,
                              CondensedAtStartUp<scenes::truss_string>>;

}  // namespace monitor
