// What the reference is asked about: a scene and a sample of any type, written out at run time and in space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"

namespace reference {

using Exact = long double;

/// A vector that counts in int, as scenes do.
template <class T>
class List {
 public:
  void add(const T& item) { items_.push_back(item); }
  int size() const { return static_cast<int>(items_.size()); }
  const T& operator[](int i) const { return items_[static_cast<std::size_t>(i)]; }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

 private:
  std::vector<T> items_;
};

/// A taut::Scene without capacities. What is plane lies at z = 0 and is held across.
struct Structure {
  static constexpr int dimension = 3;
  using Point = std::array<double, 3>;

  List<taut::Node<double, 3>> nodes;
  List<taut::Strut<double>> struts;
  List<taut::Cable<double>> cables;
  List<int> path;
  List<double> prestrain, mu;
  List<taut::Substructure> substructures;
  List<int> substructure_nodes;
  List<double> substructure_entries;
  List<taut::NodalForce<double, 3>> forces;
  List<taut::Temperature<double>> temperatures;
  int loads = 0;

  std::array<int, 2> segment_nodes(const taut::Cable<double>& cable, int i) const {
    return {on_path(cable, i), on_path(cable, i + 1)};
  }
  struct JointNodes {
    int before, at, after;
  };
  JointNodes joint_nodes(const taut::Cable<double>& cable, int j) const {
    const int at = cable.closed ? j : j + 1;
    return {on_path(cable, at - 1), on_path(cable, at), on_path(cable, at + 1)};
  }

 private:
  int on_path(const taut::Cable<double>& cable, int i) const {
    return path[cable.first_path + (i + cable.nodes) % cable.nodes];
  }
};

/// A taut::Sample without capacities.
struct Row {
  List<double> factor;
  List<std::array<taut::Jack<double>, 2>> jack;
};

template <std::size_t Dimension>
Structure::Point in_space(const std::array<double, Dimension>& vector) {
  Structure::Point lifted{};
  for (std::size_t axis = 0; axis < Dimension; ++axis) lifted[axis] = vector[axis];
  return lifted;
}

/// Adds a substructure of the scene, with rows of zeros where it has no axes.
template <int Dimension, class Cap>
void add_body(const taut::Scene<double, Dimension, Cap>& scene, const taut::Substructure& body,
              Structure& written) {
  written.substructures.add(
      {written.substructure_nodes.size(), body.nodes, written.substructure_entries.size()});
  for (int i = 0; i < body.nodes; ++i)
    written.substructure_nodes.add(scene.substructure_nodes[body.first_node + i]);
  const auto entry = [&](int row, int column) {
    if (row % 3 >= Dimension || column % 3 >= Dimension) return 0.0;
    const int i = row / 3 * Dimension + row % 3, k = column / 3 * Dimension + column % 3;
    return scene.substructure_entries[body.first_entry + i * body.nodes * Dimension + k];
  };
  for (int row = 0; row < 3 * body.nodes; ++row)
    for (int column = 0; column < 3 * body.nodes; ++column)
      written.substructure_entries.add(entry(row, column));
}

template <int Dimension, class Cap>
Structure write_out(const taut::Scene<double, Dimension, Cap>& scene) {
  Structure written;
  const int across = Dimension == 2 ? taut::held_z : taut::held_none;
  for (const auto& node : scene.nodes)
    written.nodes.add({in_space(node.at), static_cast<std::uint8_t>(node.held | across)});
  for (const auto& strut : scene.struts) written.struts.add(strut);
  for (const auto& cable : scene.cables) written.cables.add(cable);
  for (const int node : scene.path) written.path.add(node);
  for (const double prestrain : scene.prestrain) written.prestrain.add(prestrain);
  for (const double mu : scene.mu) written.mu.add(mu);
  for (const auto& body : scene.substructures) add_body(scene, body, written);
  for (const auto& given : scene.forces) written.forces.add({given.load, given.node, in_space(given.force)});
  for (const auto& change : scene.temperatures) written.temperatures.add(change);
  written.loads = scene.loads;
  return written;
}

template <class Cap>
Row write_out(const taut::Sample<double, Cap>& sample) {
  Row written;
  for (int i = 0; i < Cap::loads; ++i) written.factor.add(sample.factor[i]);
  for (int c = 0; c < Cap::cables; ++c) written.jack.add(sample.jack[c]);
  return written;
}

}  // namespace reference
