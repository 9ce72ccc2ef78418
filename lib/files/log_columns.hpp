// The columns that a log of a scene can have.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// What a column of a log holds.
enum class Quantity { time, factor, force, locked, stroke, segment_force, strut_force };

/// A column: its quantity and whose it is.
struct LogColumn {
  Quantity quantity = Quantity::time;
  std::size_t index = 0;  ///< of the load pattern, the cable or the strut
  std::size_t end = 0;    ///< of the cable: 0 start, 1 end; or the segment
};

/// All columns of a scene by name: `time`, those of every load pattern and every end of an open cable, and
/// measured forces of segments and struts.
class LogColumns {
 public:
  explicit LogColumns(const SceneDescription& scene) {
    add("time", {});
    for (std::size_t i = 0; i < scene.loads.size(); ++i) add(scene.loads[i].name, {Quantity::factor, i, 0});
    for (std::size_t i = 0; i < scene.cables.size(); ++i) {
      if (scene.cables[i].closed) continue;
      for (std::size_t end = 0; end < 2; ++end) {
        const std::string name = scene.cables[i].name + "." + end_name(end);
        add(name, {Quantity::force, i, end});
        add(name + ".locked", {Quantity::locked, i, end});
        add(name + ".stroke", {Quantity::stroke, i, end});
      }
    }
    for (std::size_t i = 0; i < scene.cables.size(); ++i)
      for (std::size_t k = 0; k < scene.cables[i].segments(); ++k)
        add(scene.cables[i].name + ".T" + std::to_string(k + 1), {Quantity::segment_force, i, k});
    for (std::size_t i = 0; i < scene.struts.size(); ++i)
      add("strut" + std::to_string(i + 1), {Quantity::strut_force, i, 0});
  }

  /// Null if there is no such column.
  const LogColumn* find(const std::string& name) const {
    const auto found = columns_.find(name);
    return found == columns_.end() ? nullptr : &found->second;
  }

  /// In the order of the scene.
  const std::vector<std::string>& names() const { return names_; }

 private:
  void add(const std::string& name, LogColumn column) {
    columns_.emplace(name, column);
    names_.push_back(name);
  }

  std::unordered_map<std::string, LogColumn> columns_;
  std::vector<std::string> names_;
};

}  // namespace taut::host
