// A truss string as a constant for flash, to be condensed on the device. data/truss_string.json is the same.
#pragma once

#include <utility>

#include "taut/scene/scene.hpp"

namespace monitor::scenes {

struct TrussStringCapacity : taut::Capacity {
  static constexpr int nodes = 8, struts = 13, cables = 1, segments = 4, joints = 3, loads = 1, forces = 3;
  static constexpr bool lags = false;
};
using TrussString = taut::Scene<double, 2, TrussStringCapacity>;

constexpr TrussString make_truss_string() {
  TrussString scene;
  const int a = scene.add_node({0, 0}, taut::held_xy);
  const int b = scene.add_node({4, 0.6});
  const int c = scene.add_node({8, 0.8});
  const int d = scene.add_node({12, 0.6});
  const int e = scene.add_node({16, 0}, taut::held_y);
  const int p = scene.add_node({4, -1});
  const int q = scene.add_node({8, -1.4});
  const int r = scene.add_node({12, -1});
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, e)})
    scene.add_strut(from, to, 2.1e11, 6.0e-3);
  for (const auto& [from, to] :
       {std::pair(a, p), std::pair(e, r), std::pair(b, p), std::pair(c, p), std::pair(b, q), std::pair(c, q),
        std::pair(d, q), std::pair(c, r), std::pair(d, r)})
    scene.add_strut(from, to, 2.1e11, 3.0e-3);
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 1.4e-3;
  cable.mu = 0.12;
  cable.mu_sd = 0.03;
  cable.shared_mu = true;
  cable.cell[0].sd = 500;
  cable.ends[1] = taut::End::jacked;
  cable.scatter = 0.1;
  cable.seating = 0.004;
  cable.seating_sd = 0.0010071742649611338;  // a quarter of it, and 3 % for E A
  scene.add_cable(cable, {a, p, q, r, e});
  const int roof = scene.add_load();
  scene.add_force(roof, b, {0, -40000});
  scene.add_force(roof, c, {0, -40000});
  scene.add_force(roof, d, {0, -40000});
  return scene;
}

inline constexpr TrussString truss_string = make_truss_string();
static_assert(truss_string.nodes.size() == TrussStringCapacity::nodes, "the scene fits its capacity");

}  // namespace monitor::scenes
