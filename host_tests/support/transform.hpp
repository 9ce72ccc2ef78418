// The same structure written down in another way: the answer must be the same, or change in a known way.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "support/scenes.hpp"

namespace support {

/// Moves the cables' paths, struts, forces and substructures of `from` to other nodes: new_number[old] is a
/// node of `to`, which has its nodes already.
template <class From, class To, class Lift>
void copy_parts(const From& from, To& to, const std::vector<int>& new_number, Lift lift) {
  const auto moved = [&](int node) { return new_number[static_cast<std::size_t>(node)]; };
  for (const auto& strut : from.struts)
    to.add_strut(moved(strut.nodes[0]), moved(strut.nodes[1]), strut.E, strut.A);
  for (const auto& cable : from.cables) {
    std::vector<int> path;
    for (int i = 0; i < cable.nodes; ++i) path.push_back(moved(from.path[cable.first_path + i]));
    to.add_cable(cable, path.data(), cable.nodes);
  }
  for (int i = 0; i < from.prestrain.size(); ++i) to.prestrain[i] = from.prestrain[i];
  for (int i = 0; i < from.mu.size(); ++i) to.mu[i] = from.mu[i];
  for (int i = 0; i < from.loads; ++i) to.add_load();
  for (const auto& force : from.forces) to.add_force(force.load, moved(force.node), lift(force.force));
  for (const auto& change : from.temperatures) to.add_temperature(change.load, change.cable, change.kelvin);
}

template <class SceneType>
void copy_substructures(const SceneType& from, SceneType& to, const std::vector<int>& new_number) {
  for (const auto& body : from.substructures) {
    std::vector<int> nodes;
    for (int i = 0; i < body.nodes; ++i)
      nodes.push_back(new_number[static_cast<std::size_t>(from.substructure_nodes[body.first_node + i])]);
    to.add_substructure(nodes.data(), body.nodes, &from.substructure_entries[body.first_entry]);
  }
}

/// The nodes in another order: node i becomes node order[i].
template <class SceneType>
void permute_nodes(const SceneType& from, SceneType& to, const std::vector<int>& order) {
  to = {};
  for (int place = 0; place < from.nodes.size(); ++place) {
    const auto old = std::find(order.begin(), order.end(), place) - order.begin();
    const auto& node = from.nodes[static_cast<int>(old)];
    to.add_node(node.at, node.held);
  }
  copy_parts(from, to, order, [](const auto& force) { return force; });
  copy_substructures(from, to, order);
}

/// Every cable run through from its end to its start.
template <class SceneType>
void reverse_paths(const SceneType& from, SceneType& to) {
  to = from;
  for (auto& cable : to.cables) {
    std::reverse(to.path.begin() + cable.first_path, to.path.begin() + cable.first_path + cable.nodes);
    std::reverse(to.prestrain.begin() + cable.first_segment,
                 to.prestrain.begin() + cable.first_segment + cable.segments());
    std::reverse(to.mu.begin() + cable.first_joint, to.mu.begin() + cable.first_joint + cable.joints());
    std::swap(cable.ends[0], cable.ends[1]);
  }
}

/// Turned about the origin; supports must hold a node in all directions or none. Without substructures.
inline void rotate(const Space& from, Space& to, const Eigen::Matrix3d& rotation) {
  to = {};
  const auto turned = [&rotation](const Space::Point& p) {
    const Eigen::Vector3d q = rotation * Eigen::Vector3d(p[0], p[1], p[2]);
    return Space::Point{q[0], q[1], q[2]};
  };
  std::vector<int> same;
  for (const auto& node : from.nodes) same.push_back(to.add_node(turned(node.at), node.held));
  copy_parts(from, to, same, turned);
}

/// The plane of a 2D scene in space: every node is held across. Without substructures.
template <class SpaceScene>
void embed(const Plane& from, SpaceScene& to) {
  to = {};
  const auto lifted = [](const PlanePoint& p) { return Space::Point{p[0], p[1], 0}; };
  std::vector<int> same;
  for (const auto& node : from.nodes)
    same.push_back(to.add_node(lifted(node.at), static_cast<std::uint8_t>(node.held | taut::held_z)));
  copy_parts(from, to, same, lifted);
}

/// In other units: lengths are `length` times, forces `force` times the numbers they were.
template <class SceneType>
void change_units(const SceneType& from, SceneType& to, double length, double force) {
  to = from;
  for (auto& node : to.nodes)
    for (double& x : node.at) x *= length;
  for (auto& strut : to.struts) {
    strut.E *= force / (length * length);
    strut.A *= length * length;
  }
  for (auto& cable : to.cables) {
    cable.E *= force / (length * length);
    cable.A *= length * length;
    cable.seating *= length;
    cable.wobble /= length;
  }
  for (double& entry : to.substructure_entries) entry *= force / length;
  for (auto& given : to.forces)
    for (double& x : given.force) x *= force;
}

}  // namespace support
