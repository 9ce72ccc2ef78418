// Numbers the unknowns so that connected ones lie close together: small bandwidth.
#pragma once

#include "taut/scene/node_order.hpp"

namespace taut {

/// Places of the unknowns of the paper's global system: node by node, for each its free displacements and,
/// where beams turn with it, rotations, then for each friction joint on it the displacements of the cable's
/// point (node 3) and the internal forces (virtual node 5).
template <class SceneType>
class Numbering {
 public:
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;
  static constexpr int per_node = SceneType::motions_of_node;
  static constexpr int max_unknowns = per_node * Cap::nodes + 2 * dimension * Cap::joints;

  void make(const SceneType& scene) {
    order_.make(scene);
    count_ = 0;
    for (int place = 0; place < scene.nodes.size(); ++place) {
      const int node = order_.node(place);
      first_of_node_[node] = count_;
      for (int axis = 0; axis < per_node; ++axis)
        displacement_[node * per_node + axis] = scene.is_fixed(node, axis) ? -1 : count_++;
      for (const auto& cable : scene.cables)
        for (int j = 0; j < cable.joints(); ++j)
          if (scene.joint_nodes(cable, j).at == node) {
            joint_[cable.first_joint + j] = count_;
            count_ += 2 * dimension;
          }
      past_node_[node] = count_;
    }
    band_ = 0;
    for (int node = 0; node < scene.nodes.size(); ++node) {
      widen(node, node);
      NodeOrder<SceneType>::for_each_neighbour(scene, node, [this, node](int other) { widen(node, other); });
    }
  }

  int count() const { return count_; }
  /// Largest distance of two unknowns of one element.
  int band() const { return band_; }

  /// Displacement of a node of the structure (node 4 at a joint), then its rotations; -1 if it is held.
  int displacement(int node, int axis) const { return displacement_[node * per_node + axis]; }
  /// Displacement of the cable's own point at a joint, node 3.
  int cable_point(int joint, int axis) const { return joint_[joint] + axis; }
  /// Internal force of a joint: 0 sigma_n, 1 sigma_s, in space 2 the tie across.
  int internal_force(int joint, int i) const { return joint_[joint] + dimension + i; }

 private:
  void widen(int a, int b) {
    const int reach = past_node_[a] - 1 - first_of_node_[b];
    if (reach > band_) band_ = reach;
  }

  NodeOrder<SceneType> order_;
  FixedArray<int, Cap::nodes> first_of_node_;
  FixedArray<int, Cap::nodes> past_node_;
  FixedArray<int, Cap::nodes * per_node> displacement_;
  FixedArray<int, Cap::joints> joint_;
  int count_ = 0;
  int band_ = 0;
};

}  // namespace taut
