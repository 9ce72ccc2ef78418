// Scenes that the tests share: from one joint to a truss string structure and the ring of a suspen-dome.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/random.hpp"
#include "support/routes_taken.hpp"
#include "taut/scene/scene.hpp"

namespace support {

struct PlaneCapacity : taut::Capacity {
  static constexpr int nodes = 26, struts = 56, cables = 2, segments = 12, joints = 12, loads = 3,
                       forces = 32;
  static constexpr int temperatures = 3, substructures = 12, substructure_nodes = 24;
  static constexpr int substructure_entries = 192;
  static constexpr int displacements = 2 * nodes;
  using Watch = RoutesTaken;
};
struct SpaceCapacity : PlaneCapacity {
  static constexpr int nodes = 28, struts = 72, segments = 8, joints = 8;
  static constexpr int displacements = 3 * nodes;
};
using Plane = taut::Scene<double, 2, PlaneCapacity>;
using Space = taut::Scene<double, 3, SpaceCapacity>;

constexpr double steel = 2e11;                       ///< E [N/m2]
constexpr double cable_E = 1.95e11, cable_A = 8e-4;  ///< of steel_cable()
constexpr std::array<taut::End, 2> anchored{taut::End::anchored, taut::End::anchored};
constexpr std::array<taut::End, 2> jacked_end{taut::End::anchored, taut::End::jacked};
constexpr std::array<taut::End, 2> jacked_start{taut::End::jacked, taut::End::anchored};
constexpr std::array<taut::End, 2> two_jacks{taut::End::jacked, taut::End::jacked};

inline taut::Cable<double> steel_cable(double mu, std::array<taut::End, 2> ends = jacked_end) {
  taut::Cable<double> cable;
  cable.E = cable_E;
  cable.A = cable_A;
  cable.mu = mu;
  cable.ends = ends;
  return cable;
}

/// A factor for every dimension of a scene: always 1, or from 1/2 to 2 at random.
class Variation {
 public:
  Variation() = default;
  explicit Variation(Random& random) : random_(&random) {}
  double operator()() const { return random_ == nullptr ? 1 : std::exp2(random_->between(-1, 1)); }
  /// A distance of at most `size`, zero without variation.
  double shift(double size) const { return random_ == nullptr ? 0 : random_->between(-size, size); }

 private:
  Random* random_ = nullptr;
};

template <class SceneType>
void vary_friction(SceneType& scene, const Variation& vary) {
  for (double& mu : scene.mu) mu *= vary();
}

/// One joint: a cable from a hinge over a held roller to a node on a strut below it, held in x and loaded
/// with 1 kN downwards (load 0). Returns nothing: nodes are hinge, roller, loaded.
inline void cable_roller(Plane& scene, const taut::Cable<double>& cable) {
  scene = {};
  const int hinge = scene.add_node({1, 1}, taut::held_xy);
  const int roller = scene.add_node({0, 0}, taut::held_xy);
  const int loaded = scene.add_node({0, -1}, taut::held_x);
  scene.add_strut(roller, loaded, steel, 1e-4);
  scene.add_cable(cable, {hinge, roller, loaded});
  scene.add_force(scene.add_load(), loaded, {0, -1000});
}

using PlanePoint = std::array<double, 2>;

/// A cable over held nodes: rigid saddles.
template <class SceneType>
void rigid_saddles(SceneType& scene, const taut::Cable<double>& cable,
                   const std::vector<PlanePoint>& points) {
  scene = {};
  std::vector<int> path;
  for (const PlanePoint& point : points) path.push_back(scene.add_node(point, taut::held_xy));
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
}

/// A chain of at most 10 segments, all of different lengths and turning angles. Joint j turns by
/// chain_turn[j].
constexpr std::array<double, 9> chain_turn = {0.35, 0.2, 0.5, 0.1, 0.42, 0.3, 0.25, 0.38, 0.15};
constexpr double chain_length(int segment) { return 2 + 0.7 * segment; }
inline std::vector<PlanePoint> chain_points(int segments) {
  std::vector<PlanePoint> points{{0, 0}};
  double angle = -1;
  for (int i = 0; i < segments; ++i) {
    if (i > 0) angle += chain_turn.at(static_cast<std::size_t>(i) - 1);
    const PlanePoint last = points.back();
    points.push_back(
        {last[0] + chain_length(i) * std::cos(angle), last[1] + chain_length(i) * std::sin(angle)});
  }
  return points;
}

/// Plane truss string structure: a truss girder on two supports, a cable below it on V-struts. Load 0 is
/// 10 kN down on every node of the top chord, load 1 the same upwards on its left half.
template <class SceneType>
void truss_string(SceneType& scene, const taut::Cable<double>& cable, int panels,
                  const Variation& vary = {}) {
  scene = {};
  const double span = 30, depth = 1.5, sag = 3, area = 1e-3;
  std::vector<int> bottom, top, path;
  for (int i = 0; i <= panels; ++i) {
    const double x = span * i / panels;
    const int held = i == 0 ? taut::held_xy : i == panels ? taut::held_y : taut::held_none;
    bottom.push_back(scene.add_node({x, 0}, static_cast<std::uint8_t>(held)));
    top.push_back(scene.add_node({x, depth * vary()}));
  }
  const auto strut = [&](int a, int b) { scene.add_strut(a, b, steel, area * vary()); };
  path.push_back(bottom.front());
  for (std::size_t i = 0; i + 1 < bottom.size(); ++i) {
    strut(bottom[i], bottom[i + 1]);
    strut(top[i], top[i + 1]);
    strut(bottom[i], top[i + 1]);
    strut(bottom[i], top[i]);
    if (i == 0) continue;
    const double t = 2.0 * static_cast<double>(i) / panels - 1;
    const double x = span * static_cast<double>(i) / panels;
    path.push_back(scene.add_node({x + vary.shift(0.2), -sag * (1 - t * t) + vary.shift(0.05)}));
    strut(bottom[i - 1], path.back());
    strut(bottom[i + 1], path.back());
  }
  strut(bottom.back(), top.back());
  path.push_back(bottom.back());
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  vary_friction(scene, vary);
  const int down = scene.add_load(), up_left = scene.add_load();
  for (std::size_t i = 0; i < top.size(); ++i) {
    scene.add_force(down, top[i], {0, -1e4});
    if (2 * i < top.size()) scene.add_force(up_left, top[i], {0, 1e4});
  }
}

/// Ring of a suspen-dome: a closed hoop whose nodes hang on three struts each from held nodes, and lean on
/// radial springs. Load 0 pulls every node outwards, load 1 the first one only, load 2 pushes all inwards.
inline void dome_ring(Space& scene, taut::Cable<double> cable, int sides, const Variation& vary = {}) {
  scene = {};
  const double radius = 10, area = 5e-4;
  const auto at = [](double r, double angle, double z) {
    return Space::Point{r * std::cos(angle), r * std::sin(angle), z};
  };
  std::vector<int> ring, outer;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides + vary.shift(0.05);
    ring.push_back(scene.add_node(at(radius + vary.shift(0.3), angle, vary.shift(0.1))));
    outer.push_back(scene.add_node(at(radius + 3, angle - pi / sides, 3), taut::held_xyz));
  }
  const int apex = scene.add_node({0, 0, 20}, taut::held_xyz);
  const int load_all = scene.add_load(), load_one = scene.add_load(), load_in = scene.add_load();
  for (int i = 0; i < sides; ++i) {
    const auto k = static_cast<std::size_t>(i), next = static_cast<std::size_t>((i + 1) % sides);
    scene.add_strut(ring[k], outer[k], steel, area * vary());
    scene.add_strut(ring[k], outer[next], steel, area * vary());
    scene.add_strut(ring[k], apex, steel, area * vary());
    const double x = std::cos(2 * pi * i / sides), y = std::sin(2 * pi * i / sides), k_r = 1e6 * vary();
    const double spring[] = {k_r * x * x, k_r * x * y, 0, k_r * x * y, k_r * y * y, 0, 0, 0, 0};
    scene.add_substructure(&ring[k], 1, spring);
    scene.add_force(load_all, ring[k], {1e5 * x, 1e5 * y, 0});
    if (i == 0) scene.add_force(load_one, ring[k], {2e5 * x, 2e5 * y, 0});
    scene.add_force(load_in, ring[k], {-4e5 * x, -4e5 * y, 0});
  }
  cable.closed = true;
  scene.add_cable(cable, ring.data(), sides);
  vary_friction(scene, vary);
}

/// Spatial truss string structure: a girder of triangular section held at its four lower corners, a cable
/// below it on inverted pyramids. Load 0 is 10 kN down on every node of the upper chord, load 1 sideways and
/// up on its first half.
inline void space_truss_string(Space& scene, const taut::Cable<double>& cable, int panels,
                               const Variation& vary = {}) {
  scene = {};
  const double span = 24, width = 1, depth = 2, sag = 2.5, area = 1e-3;
  std::vector<int> left, right, top, path;
  for (int i = 0; i <= panels; ++i) {
    const double x = span * i / panels;
    const auto held = static_cast<std::uint8_t>(i == 0 || i == panels ? taut::held_xyz : taut::held_none);
    left.push_back(scene.add_node({x, width, vary.shift(0.1)}, held));
    right.push_back(scene.add_node({x, -width, vary.shift(0.1)}, held));
    top.push_back(scene.add_node({x, vary.shift(0.1), depth}));
  }
  const auto strut = [&](int a, int b) { scene.add_strut(a, b, steel, area * vary()); };
  path.push_back(top.front());
  for (std::size_t i = 0; i < left.size(); ++i) {
    strut(left[i], right[i]);
    strut(right[i], top[i]);
    strut(top[i], left[i]);
    if (i + 1 == left.size()) break;
    for (const auto& chord : {left, right, top}) strut(chord[i], chord[i + 1]);
    strut(left[i], right[i + 1]);
    strut(right[i], top[i + 1]);
    strut(top[i], left[i + 1]);
    const double t = (2.0 * static_cast<double>(i) + 1) / panels - 1;
    const double x = span * (static_cast<double>(i) + 0.5) / panels;
    path.push_back(scene.add_node({x, vary.shift(0.1), -0.5 - sag * (1 - t * t)}));
    for (const int head : {left[i], right[i], left[i + 1], right[i + 1]}) strut(head, path.back());
  }
  path.push_back(top.back());
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  vary_friction(scene, vary);
  const int down = scene.add_load(), aside = scene.add_load();
  for (std::size_t i = 0; i < top.size(); ++i) {
    scene.add_force(down, top[i], {0, 0, -1e4});
    if (2 * i < top.size()) scene.add_force(aside, top[i], {0, 3e3, 1e4});
  }
}

}  // namespace support
