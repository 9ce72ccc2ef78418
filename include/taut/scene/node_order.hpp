// An order of the nodes in which connected ones lie close together.
#pragma once

#include "taut/scene/scene.hpp"

namespace taut {

/// Reverse Cuthill-McKee: small bandwidth and a small skyline for matrices assembled from the scene's
/// elements.
///
/// Takes as many steps as nodes times elements; no lists of neighbours are stored.
template <class SceneType>
class NodeOrder {
 public:
  using Cap = typename SceneType::Capacity;

  void make(const SceneType& scene) {
    scene_ = &scene;
    order();
    for (int i = 0, k = scene.nodes.size() - 1; i < k; ++i, --k) {
      const int kept = order_[i];
      order_[i] = order_[k];
      order_[k] = kept;
    }
  }

  /// The node at a place of the order.
  int node(int place) const { return order_[place]; }

  /// Calls visit(other) for every node that shares an element with `node`; more than once if they share
  /// several.
  template <class Visit>
  static void for_each_neighbour(const SceneType& scene, int node, Visit visit) {
    const auto edge = [node, &visit](int a, int b) {
      if (a == node && b != node) visit(b);
      if (b == node && a != node) visit(a);
    };
    for (const auto& strut : scene.struts) edge(strut.nodes[0], strut.nodes[1]);
    for (const auto& beam : scene.beams) edge(beam.nodes[0], beam.nodes[1]);
    for (const auto& cable : scene.cables)
      for (int i = 0; i < cable.segments(); ++i) {
        const auto ends = scene.segment_nodes(cable, i);
        edge(ends[0], ends[1]);
      }
    for (const Substructure& body : scene.substructures) {
      const int* const first = scene.substructure_nodes.begin() + body.first_node;
      bool touches = false;
      for (int i = 0; i < body.nodes; ++i) touches = touches || first[i] == node;
      for (int i = 0; touches && i < body.nodes; ++i) edge(node, first[i]);
    }
  }

 private:
  /// Cuthill-McKee, each connected part from a node that lies at its edge.
  void order() {
    const int n = scene_->nodes.size();
    for (int i = 0; i < n; ++i) {
      degree_[i] = 0;
      for_each_neighbour(*scene_, i, [this, i](int) { ++degree_[i]; });
      placed_[i] = false;
    }
    int done = 0;
    while (done < n) {
      int seed = -1;
      for (int i = 0; i < n; ++i)
        if (!placed_[i] && (seed < 0 || degree_[i] < degree_[seed])) seed = i;
      // Twice to the far end of the part: close to a diameter.
      for (int round = 0; round < 2; ++round) {
        const int end = spread(seed, done);
        seed = order_[end - 1];
        for (int i = done; i < end; ++i) placed_[order_[i]] = false;
      }
      done = spread(seed, done);
    }
  }

  /// Breadth first from `seed`, neighbours of low degree first, into order_ from `begin`; returns the end.
  int spread(int seed, int begin) {
    int end = begin;
    order_[end++] = seed;
    placed_[seed] = true;
    for (int next = begin; next < end; ++next) {
      const int first_new = end;
      for_each_neighbour(*scene_, order_[next], [this, &end, first_new](int other) {
        if (placed_[other]) return;
        placed_[other] = true;
        int at = end++;
        for (; at > first_new && degree_[order_[at - 1]] > degree_[other]; --at) order_[at] = order_[at - 1];
        order_[at] = other;
      });
    }
    return end;
  }

  const SceneType* scene_ = nullptr;
  FixedArray<int, Cap::nodes> order_;
  FixedArray<int, Cap::nodes> degree_;
  FixedArray<bool, Cap::nodes> placed_;
};

}  // namespace taut
