// Any bytes as a scene file, up to the core's validation.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lib/files/input_error.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/kinds/valid_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    taut::host::require_valid(
        taut::host::read_scene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz"));
  } catch (const taut::host::InputError&) {
  }
  return 0;
}
