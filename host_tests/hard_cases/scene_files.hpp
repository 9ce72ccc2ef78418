// The scenes and samples of hard cases as files, for everything that reads those: boards, the program taut.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"

namespace hard {

/// A number that reads back the same.
inline std::string digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

/// "a, b, c" of what `item` says of the numbers below `count`.
template <class Item>
std::string listed(int count, Item item) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + item(i);
  return text;
}

/// Scenes of one type as JSON, and samples as logs: lib/README.md has both formats. Nodes, cables and load
/// patterns are called n, C and L with their numbers.
template <class SceneType>
class SceneText {
 public:
  explicit SceneText(const SceneType& scene) : scene_(scene) {}

  std::string json(const std::string& name) const {
    return "{ \"taut\": 1, \"plausible\": false, \"name\": \"" + name +
           "\", \"dimension\": " + std::to_string(dimension) + ",\n  \"nodes\": { " + nodes() +
           " },\n  \"supports\": { " + supports() + " },\n  \"struts\": [ " +
           listed(scene_.struts.size(), [&](int i) { return strut(i); }) + " ],\n  \"cables\": [ " +
           listed(scene_.cables.size(), [&](int c) { return cable(c); }) + " ],\n  \"substructures\": [ " +
           listed(scene_.substructures.size(), [&](int i) { return substructure(i); }) +
           " ],\n  \"loads\": { " + listed(scene_.loads, [&](int i) { return load(i); }) +
           " },\n  \"sensors\": { " + sensors() + " }\n}\n";
  }

  /// A row a second. Jacks have a column for their force and one for their wedge.
  template <class Samples>
  std::string log(const Samples& samples) const {
    std::string text = "time";
    for (int i = 0; i < scene_.loads; ++i) text += ",L" + std::to_string(i);
    for_each_jack([&](int c, std::size_t end) {
      const std::string column = ",C" + std::to_string(c) + (end == 0 ? ".start" : ".end");
      text += column + column + ".locked";
    });
    text += "\n";
    for (std::size_t row = 0; row < samples.size(); ++row) {
      text += std::to_string(row + 1);
      for (int i = 0; i < scene_.loads; ++i) text += "," + digits(samples[row].factor[i]);
      for_each_jack([&](int c, std::size_t end) {
        const auto& jack = samples[row].jack[c][end];
        text += "," + digits(jack.force) + (jack.locked ? ",1" : ",0");
      });
      text += "\n";
    }
    return text;
  }

 private:
  static constexpr int dimension = SceneType::dimension;

  static std::string node(int number) { return "\"n" + std::to_string(number) + "\""; }
  template <class Values>
  static std::string vector(const Values& values) {
    return "[" + listed(dimension, [&](int axis) { return digits(values[static_cast<std::size_t>(axis)]); }) +
           "]";
  }
  /// Of `count` values from `first` on.
  template <class Values>
  static std::string numbers(const Values& values, int first, int count) {
    return "[" + listed(count, [&](int i) { return digits(values[first + i]); }) + "]";
  }

  std::string nodes() const {
    return listed(scene_.nodes.size(), [&](int i) { return node(i) + ": " + vector(scene_.nodes[i].at); });
  }
  std::string supports() const {
    std::string text;
    for (int i = 0; i < scene_.nodes.size(); ++i) {
      std::string axes;
      for (int axis = 0; axis < dimension; ++axis)
        if (scene_.nodes[i].is_held(axis)) axes += "xyz"[axis];
      if (!axes.empty()) text += (text.empty() ? "" : ", ") + node(i) + ": \"" + axes + "\"";
    }
    return text;
  }
  std::string strut(int i) const {
    const auto& strut = scene_.struts[i];
    return "{ \"nodes\": [" + node(strut.nodes[0]) + ", " + node(strut.nodes[1]) +
           "], \"E\": " + digits(strut.E) + ", \"A\": " + digits(strut.A) + " }";
  }
  std::string cable(int c) const {
    const auto& cable = scene_.cables[c];
    const auto end = [&](std::size_t i) {
      return cable.ends[i] == taut::End::jacked ? "\"jacked\"" : "\"anchored\"";
    };
    return "{ \"name\": \"C" + std::to_string(c) + "\", \"path\": [" +
           listed(cable.nodes, [&](int i) { return node(scene_.path[cable.first_path + i]); }) +
           "], \"E\": " + digits(cable.E) + ", \"A\": " + digits(cable.A) + ", " +
           (cable.closed ? "\"closed\": true"
                         : std::string("\"start\": ") + end(0) + ", \"end\": " + end(1)) +
           ", \"friction\": { " + friction(c) +
           " }, \"prestrain\": " + numbers(scene_.prestrain, cable.first_segment, cable.segments()) +
           ", \"alpha\": " + digits(cable.alpha) + ", \"seating\": " + digits(cable.seating) + " }";
  }
  std::string friction(int c) const {
    const auto& cable = scene_.cables[c];
    const std::string mu = "\"mu\": " + numbers(scene_.mu, cable.first_joint, cable.joints());
    if (cable.law == taut::FrictionLaw::point) return "\"law\": \"point\", " + mu;
    return "\"law\": \"capstan\", " + mu + ", \"wobble\": " + digits(cable.wobble);
  }
  std::string substructure(int i) const {
    const auto& body = scene_.substructures[i];
    const int size = body.nodes * dimension;
    return "{ \"name\": \"S" + std::to_string(i) + "\", \"nodes\": [" +
           listed(body.nodes, [&](int k) { return node(scene_.substructure_nodes[body.first_node + k]); }) +
           "], \"stiffness\": [" +
           listed(size,
                  [&](int row) {
                    return numbers(scene_.substructure_entries, body.first_entry + row * size, size);
                  }) +
           "] }";
  }
  std::string load(int i) const {
    std::string forces, temperatures;
    for (const auto& given : scene_.forces)
      if (given.load == i)
        forces += (forces.empty() ? "" : ", ") + node(given.node) + ": " + vector(given.force);
    for (const auto& given : scene_.temperatures)
      if (given.load == i)
        temperatures += (temperatures.empty() ? "\"C" : ", \"C") + std::to_string(given.cable) +
                        "\": " + digits(given.kelvin);
    return "\"L" + std::to_string(i) + "\": { \"forces\": { " + forces + " }, \"temperature\": { " +
           temperatures + " } }";
  }

  // Estimated with exact jacks, a case is followed as it is simulated.
  std::string sensors() const {
    std::string text;
    for_each_jack([&](int c, std::size_t end) {
      text += (text.empty() ? "\"C" : ", \"C") + std::to_string(c) + (end == 0 ? ".start\"" : ".end\"") +
              ": { \"exact\": true }";
    });
    return text;
  }

  template <class Call>
  void for_each_jack(Call call) const {
    for (int c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (!scene_.cables[c].closed && scene_.cables[c].ends[end] == taut::End::jacked) call(c, end);
  }

  const SceneType& scene_;
};

/// Writes what a hard case follows into a folder: case_1.json and case_1.csv, case_2.json, ...
class SceneFiles {
 public:
  SceneFiles(std::filesystem::path folder, std::string hard_case)
      : folder_(std::move(folder)), hard_case_(std::move(hard_case)) {}

  template <class SceneType, class Samples>
  void write(const SceneType& scene, const Samples& samples) {
    const SceneText<SceneType> text(scene);
    const std::string name = hard_case_ + "_" + std::to_string(++count_);
    put(name + ".json", text.json(name));
    put(name + ".csv", text.log(samples));
  }

 private:
  void put(const std::string& file, const std::string& text) const {
    std::ofstream stream(folder_ / file, std::ios::binary);
    stream << text;
    if (!stream.flush()) throw std::runtime_error((folder_ / file).string() + " cannot be written");
  }

  std::filesystem::path folder_;
  std::string hard_case_;
  int count_ = 0;
};

/// If there are any, follow() writes there and follows nothing.
inline std::optional<SceneFiles> scene_files;

}  // namespace hard
