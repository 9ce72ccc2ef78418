// The least that a program does with taut: it describes a cable over a post and asks for the forces in it.
#include <taut/taut.hpp>

namespace {

struct Post : taut::Capacity {
  static constexpr int nodes = 4, struts = 1, cables = 1, segments = 2, joints = 1;
};

constexpr taut::Scene<double, 2, Post> describe() {
  taut::Scene<double, 2, Post> scene;
  const int left = scene.add_node({-4.0, 0.0}, taut::held_xy);
  const int top = scene.add_node({0.0, 3.0});
  const int right = scene.add_node({4.0, 0.0}, taut::held_xy);
  const int foot = scene.add_node({0.0, 0.0}, taut::held_xy);
  scene.add_strut(foot, top, 210e9, 2e-3);
  taut::Cable<double> cable;
  cable.E = 160e9;
  cable.A = 150e-6;
  cable.mu = 0.2;
  cable.prestrain = 1e-3;
  scene.add_cable(cable, {left, top, right});
  return scene;
}

}  // namespace

int main() {
  static constexpr auto scene = describe();
  static taut::Stepwise<double, decltype(scene)> cable_forces;
  if (!cable_forces.start(scene)) return 1;
  const auto& tension = cable_forces.response().tension;
  return tension[0] > 0 && tension[1] > 0 ? 0 : 1;
}
