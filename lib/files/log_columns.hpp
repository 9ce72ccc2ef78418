// The columns that a log of a scene can have.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// What a column of a log holds.
enum class Quantity { time, factor, force, locked, stroke };

/// A column: its quantity and whose it is.
struct LogColumn {
  Quantity quantity = Quantity::time;
  std::size_t index = 0;  ///< of the load pattern or the cable
  std::size_t end = 0;    ///< of the cable: 0 start, 1 end
};

/// All columns of a scene by name, `time` and those of every load pattern and every end of an open cable.
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
