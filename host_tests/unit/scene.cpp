// Building a scene, and how segments and joints are numbered.
#include "taut/scene/scene.hpp"

#include <doctest/doctest.h>

#include "taut/scene/validation.hpp"

namespace scene_test {
using namespace taut;

namespace {

struct Small : Capacity {
  static constexpr int nodes = 8, struts = 2, cables = 2, segments = 9, joints = 8, loads = 2, forces = 2;
  static constexpr int substructures = 1, substructure_nodes = 2, substructure_entries = 16, temperatures = 1;
};
using SmallScene = Scene<double, 2, Small>;

constexpr Cable<double> cable_of(double mu, double prestrain) {
  Cable<double> cable;
  cable.E = 2e11;
  cable.A = 1e-4;
  cable.mu = mu;
  cable.prestrain = prestrain;
  return cable;
}

struct None : Capacity {};
struct Many : Capacity {
  static constexpr int struts = 100;
};

/// An open cable over nodes 3, 0, 4 and 1, and a hoop over 0, 2 and 4.
constexpr SmallScene two_cables() {
  SmallScene scene;
  for (int i = 0; i < 5; ++i) scene.add_node({1.0 * i, 1.0 * i * i}, held_xy);
  scene.add_cable(cable_of(0.1, 1e-3), {3, 0, 4, 1});
  Cable<double> hoop = cable_of(0.2, 2e-3);
  hoop.closed = true;
  scene.add_cable(hoop, {0, 2, 4});
  return scene;
}

constexpr SmallScene fixed_scene = two_cables();

}  // namespace

TEST_CASE("a whole scene is a constant expression") {
  static_assert(fixed_scene.cables.size() == 2 && fixed_scene.nodes.size() == 5);
  static_assert(fixed_scene.prestrain.size() == 6 && fixed_scene.mu.size() == 5);
  static_assert(fixed_scene.cables[1].closed && fixed_scene.nodes[2].is_held(1));
  CHECK(validate(fixed_scene).ok());
}

TEST_CASE("segments and joints of all cables are numbered one cable after the other") {
  const auto& open = fixed_scene.cables[0];
  const auto& hoop = fixed_scene.cables[1];
  CHECK(open.segments() == 3);
  CHECK(open.joints() == 2);
  CHECK(hoop.segments() == 3);
  CHECK(hoop.joints() == 3);
  CHECK(open.first_segment == 0);
  CHECK(open.first_joint == 0);
  CHECK(hoop.first_segment == 3);
  CHECK(hoop.first_joint == 2);
  CHECK(hoop.first_path == 4);
}

TEST_CASE("mu and prestrain of a cable go to each of its joints and segments") {
  for (int j = 0; j < 5; ++j) CHECK(fixed_scene.mu[j] == (j < 2 ? 0.1 : 0.2));
  for (int i = 0; i < 6; ++i) CHECK(fixed_scene.prestrain[i] == (i < 3 ? 1e-3 : 2e-3));
}

TEST_CASE("joint j of an open cable lies at its inner path node between segments j and j+1") {
  const auto& open = fixed_scene.cables[0];
  const auto first = fixed_scene.joint_nodes(open, 0), second = fixed_scene.joint_nodes(open, 1);
  CHECK(first.before == 3);
  CHECK(first.at == 0);
  CHECK(first.after == 4);
  CHECK(second.before == 0);
  CHECK(second.at == 4);
  CHECK(second.after == 1);
  CHECK(SmallScene::joint_segments(open, 1) == std::array<int, 2>{1, 2});
  CHECK(SmallScene::segment_joints(open, 0) == std::array<int, 2>{-1, 0});
  CHECK(SmallScene::segment_joints(open, 1) == std::array<int, 2>{0, 1});
  CHECK(SmallScene::segment_joints(open, 2) == std::array<int, 2>{1, -1});
  CHECK(fixed_scene.segment_nodes(open, 2) == std::array<int, 2>{4, 1});
}

TEST_CASE("joint j of a hoop lies at path node j, between the segment before it and its own") {
  const auto& hoop = fixed_scene.cables[1];
  const auto first = fixed_scene.joint_nodes(hoop, 0), last = fixed_scene.joint_nodes(hoop, 2);
  CHECK(first.before == 4);
  CHECK(first.at == 0);
  CHECK(first.after == 2);
  CHECK(last.before == 2);
  CHECK(last.at == 4);
  CHECK(last.after == 0);
  CHECK(SmallScene::joint_segments(hoop, 0) == std::array<int, 2>{5, 3});
  CHECK(SmallScene::joint_segments(hoop, 2) == std::array<int, 2>{4, 5});
  CHECK(SmallScene::segment_joints(hoop, 0) == std::array<int, 2>{2, 3});
  CHECK(SmallScene::segment_joints(hoop, 2) == std::array<int, 2>{4, 2});
  CHECK(fixed_scene.segment_nodes(hoop, 2) == std::array<int, 2>{4, 0});
}

TEST_CASE("everything that is added gets the next number, and -1 when there is no room") {
  SmallScene scene;
  CHECK(scene.add_node({0, 0}) == 0);
  CHECK(scene.add_node({1, 0}) == 1);
  CHECK(scene.add_strut(0, 1, 1, 1) == 0);
  CHECK(scene.add_strut(1, 0, 1, 1) == 1);
  CHECK(scene.add_strut(0, 1, 1, 1) == -1);
  CHECK(scene.add_load() == 0);
  CHECK(scene.add_load() == 1);
  CHECK(scene.add_load() == -1);
  CHECK(scene.excess_loads == 1);
  CHECK(scene.add_force(0, 1, {1, 2}) == 0);
  CHECK(scene.add_temperature(1, 0, 10) == 0);
  const double stiffness[4] = {1, 0, 0, 1};
  const int node = 1;
  CHECK(scene.add_substructure(&node, 1, stiffness) == 0);
  CHECK(scene.add_substructure(&node, 1, stiffness) == -1);
}

TEST_CASE("a part that a capacity leaves at zero takes hardly any room") {
  CHECK(sizeof(Scene<double, 2, Many>) >= sizeof(Scene<double, 2, None>) + 100 * sizeof(Strut<double>) - 8);
  CHECK(sizeof(Scene<double, 2, None>) < sizeof(Scene<double, 3, None>));
}

}  // namespace scene_test
