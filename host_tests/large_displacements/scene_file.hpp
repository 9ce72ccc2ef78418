// Scenes and logs in taut's format, read and written by themselves: only the keys that the reference needs,
// and with less help where something is wrong than `taut` gives.
#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "large_displacements/model.hpp"

namespace large_displacements {

/// Throws std::runtime_error where a key or name is missing or cannot be used.
Model read_scene(const std::string& text);
std::vector<Row> read_log(const std::string& text, const Model& model);
std::string file_text(const std::string& path);

/// The state whose geometric stiffness second-order theory is to take.
struct Target {
  bool given = false;
  std::vector<double> factors;                ///< one a load pattern
  std::vector<std::array<double, 2>> forces;  ///< of the jacks of each cable
};
std::string scene_text(const Model& model, const Target& target);
std::string log_text(const Model& model, const std::vector<Row>& rows);
void write_scene(const Model& model, const Target& target, const std::string& path);
void write_log(const Model& model, const std::vector<Row>& rows, const std::string& path);

}  // namespace large_displacements
