// A scene that does not stand.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "files/run_program.hpp"

/// The arch with a node that nothing holds.
inline void write_loose_scene(const std::filesystem::path& file) {
  std::string scene = text_of(TAUT_EXPORT "/arch.json");
  scene.insert(scene.find("\"p\": [4, -1]"), "\"loose\": [20, 20], ");
  std::ofstream(file) << scene;
}
