// What is refused and how it is named, and what must not be refused.
#include "taut/scene/validation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/scenes.hpp"
#include "support/status_check.hpp"

namespace validation_test {
using namespace support;
using taut::Code;
using taut::held_none;
using taut::held_x;
using taut::held_xy;
using taut::held_xyz;
using taut::held_y;
using taut::held_z;
using taut::Place;
using taut::Status;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Two struts and a cable over three held nodes and a free one; a spring, a load and a warming cable.
Plane good_scene() {
  Plane scene;
  scene.add_node({0, 0}, held_xy);
  scene.add_node({4, 0}, held_xy);
  scene.add_node({2, -1});
  scene.add_node({2, 1}, held_xy);
  scene.add_strut(0, 2, steel, 1e-3);
  scene.add_strut(1, 2, steel, 1e-3);
  scene.add_cable(steel_cable(0.2), {0, 2, 1});
  const int on = 2;
  const double spring[] = {1e6, 0, 0, 2e6};
  scene.add_substructure(&on, 1, spring);
  const int load = scene.add_load();
  scene.add_force(load, 2, {0, -1e3});
  scene.add_temperature(load, 0, 20);
  return scene;
}

/// The status of the good scene after `change`.
template <class Change>
Status after(Change change) {
  Plane scene = good_scene();
  change(scene);
  return validate(scene);
}

/// Room for a cable with one joint and for hardly anything else.
struct Tiny : taut::Capacity {
  static constexpr int nodes = 5, struts = 1, cables = 1, jacks = 1, segments = 4, joints = 1, loads = 1,
                       forces = 1;
  static constexpr int substructures = 1, substructure_nodes = 2, substructure_entries = 4, temperatures = 1;
};
using TinyScene = taut::Scene<double, 2, Tiny>;

template <class Fill>
Status tiny(Fill fill) {
  TinyScene scene;
  scene.add_node({0, 0}, held_xy);
  scene.add_node({1, 0}, held_xy);
  fill(scene);
  return validate(scene);
}

Status spatial(const std::vector<std::pair<Space::Point, int>>& nodes) {
  static Space scene;
  scene = {};
  for (const auto& node : nodes) scene.add_node(node.first, static_cast<std::uint8_t>(node.second));
  return validate(scene);
}
Status planar(const std::vector<std::pair<PlanePoint, int>>& nodes) {
  Plane scene;
  for (const auto& node : nodes) scene.add_node(node.first, static_cast<std::uint8_t>(node.second));
  return validate(scene);
}

}  // namespace

TEST_CASE("a scene without faults is accepted") { CHECK(validate(good_scene()).ok()); }

TEST_CASE("a node with a coordinate that is no number is named") {
  CHECK_STATUS(after([](Plane& s) { s.nodes[2].at[1] = not_a_number; }), Code::not_finite, Place::node, 2);
  CHECK_STATUS(after([](Plane& s) { s.nodes[3].at[0] = -infinite; }), Code::not_finite, Place::node, 3);
}

TEST_CASE("a support along an axis that the plane does not have is refused") {
  CHECK_STATUS(after([](Plane& s) { s.nodes[1].held = held_z; }), Code::out_of_range, Place::node, 1);
}

TEST_CASE("a strut with a stiffness that is not positive is named") {
  for (const double bad : {0.0, -1.0}) {
    CHECK_STATUS(after([bad](Plane& s) { s.struts[1].E = bad; }), Code::not_positive, Place::strut, 1);
    CHECK_STATUS(after([bad](Plane& s) { s.struts[1].A = bad; }), Code::not_positive, Place::strut, 1);
  }
  CHECK_STATUS(after([](Plane& s) { s.struts[0].E = not_a_number; }), Code::not_finite, Place::strut, 0);
  CHECK_STATUS(after([](Plane& s) { s.struts[0].A = infinite; }), Code::not_finite, Place::strut, 0);
}

TEST_CASE("a strut to a node that is not there is named with the node") {
  CHECK_STATUS(after([](Plane& s) { s.struts[1].nodes[0] = 4; }), Code::unknown_node, Place::strut, 1, -1, 4);
  CHECK_STATUS(after([](Plane& s) { s.struts[1].nodes[1] = -1; }), Code::unknown_node, Place::strut, 1, -1,
               -1);
}

TEST_CASE("a strut from a node to itself or to one at the same point is named") {
  CHECK_STATUS(after([](Plane& s) {
                 s.struts[0].nodes = {2, 2};
               }),
               Code::repeated_node, Place::strut, 0, -1, 2);
  CHECK_STATUS(after([](Plane& s) { s.nodes[2].at = s.nodes[0].at; }), Code::coincident_nodes, Place::strut,
               0, -1, 2);
}

TEST_CASE("a cable with a stiffness that is not positive is named") {
  CHECK_STATUS(after([](Plane& s) { s.cables[0].E = 0; }), Code::not_positive, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].A = -1; }), Code::not_positive, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].A = not_a_number; }), Code::not_finite, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].alpha = infinite; }), Code::not_finite, Place::cable, 0);
}

TEST_CASE("wobble, seating and standard deviations below zero are refused") {
  CHECK_STATUS(after([](Plane& s) { s.cables[0].wobble = -1e-3; }), Code::negative, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].seating = -1e-3; }), Code::negative, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].mu_sd = -1; }), Code::negative, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].cell[1].sd = -1; }), Code::negative, Place::cable, 0);
  CHECK_STATUS(after([](Plane& s) { s.cables[0].seating = not_a_number; }), Code::not_finite, Place::cable,
               0);
}

TEST_CASE("a joint with a friction coefficient that is negative or no number is named") {
  CHECK_STATUS(after([](Plane& s) { s.mu[0] = -0.1; }), Code::negative, Place::joint, 0, 0);
  CHECK_STATUS(after([](Plane& s) { s.mu[0] = not_a_number; }), Code::not_finite, Place::joint, 0, 0);
}

TEST_CASE("a path over a node that is not there, or twice over one, is named along the path") {
  CHECK_STATUS(after([](Plane& s) { s.path[1] = 9; }), Code::unknown_node, Place::path, 1, 0, 9);
  CHECK_STATUS(after([](Plane& s) { s.path[2] = 0; }), Code::repeated_node, Place::path, 2, 0, 0);
}

TEST_CASE("a cable along itself between two points that are one is named by segment") {
  CHECK_STATUS(after([](Plane& s) {
                 s.struts = {};
                 s.nodes[1].at = {2, -1 + 1e-16};
               }),
               Code::coincident_nodes, Place::segment, 1, 0, 1);
}

TEST_CASE("a prestrain of one or more, or that is no number, is named by segment") {
  CHECK_STATUS(after([](Plane& s) { s.prestrain[1] = 1; }), Code::out_of_range, Place::segment, 1, 0);
  CHECK_STATUS(after([](Plane& s) { s.prestrain[0] = -1.5; }), Code::out_of_range, Place::segment, 0, 0);
  CHECK_STATUS(after([](Plane& s) { s.prestrain[0] = not_a_number; }), Code::not_finite, Place::segment, 0,
               0);
  CHECK(after([](Plane& s) { s.prestrain[0] = -0.5; }).ok());
}

TEST_CASE("a cable that folds straight back is named by joint") {
  CHECK_STATUS(after([](Plane& s) { s.nodes[2].at = {8, 0}; }), Code::folded_cable, Place::joint, 0, 0);
}

TEST_CASE("an open cable needs two nodes and a closed one three") {
  const int path[] = {0, 2};
  Plane scene = good_scene();
  scene.add_cable(steel_cable(0), path, 1);
  CHECK_STATUS(validate(scene), Code::path_too_short, Place::cable, 1, -1, 1);
  scene = good_scene();
  taut::Cable<double> hoop = steel_cable(0);
  hoop.closed = true;
  scene.add_cable(hoop, path, 2);
  CHECK_STATUS(validate(scene), Code::path_too_short, Place::cable, 1, -1, 2);
  scene = good_scene();
  scene.add_cable(steel_cable(0), path, 2);
  CHECK(validate(scene).ok());
}

TEST_CASE("a substructure that is not symmetric is named with the row") {
  CHECK_STATUS(after([](Plane& s) { s.substructure_entries[2] = 1e3; }), Code::not_symmetric,
               Place::substructure, 0, -1, 1);
  // As printed by another program: the last digits need not agree.
  CHECK(after([](Plane& s) { s.substructure_entries[1] = 1e-4; }).ok());
}

TEST_CASE("a substructure that gives way under its own force is refused") {
  CHECK_STATUS(after([](Plane& s) { s.substructure_entries[3] = -1; }), Code::not_semidefinite,
               Place::substructure, 0);
  // Positive diagonal, but eigenvalues 1.5e6 + 0.5e6 sqrt(1 + 36) and 1.5e6 - 0.5e6 sqrt(1 + 36) < 0.
  CHECK_STATUS(after([](Plane& s) { s.substructure_entries[1] = s.substructure_entries[2] = 3e6; }),
               Code::not_semidefinite, Place::substructure, 0);
  // Zero diagonal beside an entry that is not.
  CHECK_STATUS(after([](Plane& s) {
                 s.substructure_entries[0] = s.substructure_entries[3] = 0;
                 s.substructure_entries[1] = s.substructure_entries[2] = 1;
               }),
               Code::not_semidefinite, Place::substructure, 0);
  CHECK(after([](Plane& s) { s.substructure_entries[0] = 0; }).ok());
}

TEST_CASE("a substructure on a node that is not there, twice on one, or with a NaN is named") {
  CHECK_STATUS(after([](Plane& s) { s.substructure_nodes[0] = 7; }), Code::unknown_node, Place::substructure,
               0, -1, 7);
  CHECK_STATUS(after([](Plane& s) { s.substructure_entries[3] = not_a_number; }), Code::not_finite,
               Place::substructure, 0, -1, 1);
  const int twice[] = {2, 2};
  const double zeros[16] = {};
  Plane scene = good_scene();
  scene.add_substructure(twice, 2, zeros);
  CHECK_STATUS(validate(scene), Code::repeated_node, Place::substructure, 1, -1, 2);
}

TEST_CASE("loads on what is not there are named") {
  CHECK_STATUS(after([](Plane& s) { s.forces[0].load = 1; }), Code::out_of_range, Place::force, 0, -1, 1);
  CHECK_STATUS(after([](Plane& s) { s.forces[0].load = -1; }), Code::out_of_range, Place::force, 0, -1, -1);
  CHECK_STATUS(after([](Plane& s) { s.forces[0].node = 12; }), Code::unknown_node, Place::force, 0, -1, 12);
  CHECK_STATUS(after([](Plane& s) { s.forces[0].force[1] = not_a_number; }), Code::not_finite, Place::force,
               0);
  CHECK_STATUS(after([](Plane& s) { s.temperatures[0].load = 3; }), Code::out_of_range, Place::temperature, 0,
               -1, 3);
  CHECK_STATUS(after([](Plane& s) { s.temperatures[0].cable = 1; }), Code::out_of_range, Place::temperature,
               0, -1, 1);
  CHECK_STATUS(after([](Plane& s) { s.temperatures[0].kelvin = infinite; }), Code::not_finite,
               Place::temperature, 0);
}

TEST_CASE("every list that overflows is named with its capacity and with what is missing") {
  const double zeros[36] = {};
  const int on[] = {0, 1, 0}, zigzag[] = {0, 1, 0, 1, 0, 1, 0};
  CHECK_STATUS(tiny([](TinyScene& s) {
                 for (int i = 0; i < 6; ++i) s.add_node({5.0 + i, 0});
               }),
               Code::capacity_exceeded, Place::node, 5, -1, 3);
  CHECK_STATUS(tiny([](TinyScene& s) {
                 s.add_strut(0, 1, 1, 1);
                 s.add_strut(0, 1, 1, 1);
               }),
               Code::capacity_exceeded, Place::strut, 1, -1, 1);
  CHECK_STATUS(tiny([&](TinyScene& s) {
                 s.add_cable(steel_cable(0), zigzag, 2);
                 s.add_cable(steel_cable(0), zigzag, 2);
               }),
               Code::capacity_exceeded, Place::cable, 1, -1, 1);
  CHECK_STATUS(tiny([&](TinyScene& s) {
                 auto cable = steel_cable(0);
                 cable.ends = {taut::End::jacked, taut::End::jacked};
                 s.add_cable(cable, zigzag, 2);
               }),
               Code::capacity_exceeded, Place::cable_end, 1, -1, 1);
  CHECK_STATUS(tiny([&](TinyScene& s) { s.add_cable(steel_cable(0), zigzag, 7); }), Code::capacity_exceeded,
               Place::segment, 4, -1, 2);
  CHECK_STATUS(tiny([&](TinyScene& s) { s.add_cable(steel_cable(0), zigzag, 5); }), Code::capacity_exceeded,
               Place::joint, 1, -1, 2);
  CHECK_STATUS(tiny([&](TinyScene& s) {
                 for (int i = 0; i < 3; ++i) s.add_substructure(on, 0, zeros);
               }),
               Code::capacity_exceeded, Place::substructure, 1, -1, 2);
  CHECK_STATUS(tiny([&](TinyScene& s) { s.add_substructure(on, 3, zeros); }), Code::capacity_exceeded,
               Place::substructure_node, 2, -1, 1);
  CHECK_STATUS(tiny([&](TinyScene& s) { s.add_substructure(on, 2, zeros); }), Code::capacity_exceeded,
               Place::substructure_entry, 4, -1, 12);
  CHECK_STATUS(tiny([](TinyScene& s) {
                 for (int i = 0; i < 3; ++i) s.add_load();
               }),
               Code::capacity_exceeded, Place::load, 1, -1, 2);
  CHECK_STATUS(tiny([](TinyScene& s) {
                 s.add_load();
                 s.add_force(0, 0, {1, 0});
                 s.add_force(0, 0, {1, 0});
               }),
               Code::capacity_exceeded, Place::force, 1, -1, 1);
  CHECK_STATUS(tiny([](TinyScene& s) {
                 for (int i = 0; i < 4; ++i) s.add_temperature(0, 0, 1);
               }),
               Code::capacity_exceeded, Place::temperature, 1, -1, 3);
}

TEST_CASE("a plane structure that its supports leave free to shift or turn is refused by a node that moves") {
  CHECK(planar({{{0, 0}, held_xy}, {{5, 0}, held_y}}).ok());
  CHECK(planar({{{0, 0}, held_none}, {{5, 0}, held_none}}).code == Code::unsupported);
  CHECK(planar({{{0, 0}, held_y}, {{5, 0}, held_y}}).code == Code::unsupported);  // shifts along x
  const Status turns = planar({{{0, 0}, held_xy}, {{5, 0}, held_none}});
  CHECK_STATUS(turns, Code::unsupported, Place::node, 1);  // turns about node 0
  // Three supports whose lines meet in one point, the first node.
  CHECK(planar({{{0, 0}, held_none}, {{5, 0}, held_x}, {{0, 5}, held_y}, {{-5, 0}, held_x}}).code ==
        Code::unsupported);
  CHECK(planar({}).code == Code::unsupported);
}

TEST_CASE(
    "a spatial structure that its supports leave free to shift or turn is refused by a node that moves") {
  CHECK(spatial({{{0, 0, 0}, held_xyz}, {{5, 0, 0}, held_xyz}, {{0, 5, 0}, held_xyz}}).ok());
  CHECK(spatial({{{0, 0, 0}, held_xyz}, {{5, 0, 0}, taut::held_y | held_z}, {{0, 5, 0}, held_z}}).ok());
  CHECK(spatial({{{0, 0, 0}, held_z}, {{5, 0, 0}, held_z}, {{0, 5, 0}, held_z}}).code == Code::unsupported);
  const Status about_a_line = spatial({{{0, 0, 0}, held_xyz}, {{6, 0, 0}, held_xyz}, {{3, 0, 4}, held_none}});
  CHECK_STATUS(about_a_line, Code::unsupported, Place::node, 2);
}

TEST_CASE("supports in one line are enough for a structure of which nothing lies off that line") {
  CHECK(spatial({{{0, 0, 0}, held_xyz}, {{6, 0, 0}, held_xyz}, {{3, 0, 0}, held_none}}).ok());
  CHECK(spatial({{{1, 1, 1}, held_xyz}, {{3, 4, 5}, held_xyz}, {{5, 7, 9}, held_none}}).ok());
}

TEST_CASE("a substructure can be the only support") {
  Plane scene;
  scene.add_node({0, 0});
  scene.add_node({4, 0});
  const int on[] = {0, 1};
  double stiffness[16] = {};
  for (const int i : {0, 5, 10, 15}) stiffness[i] = 1e6;
  scene.add_substructure(on, 2, stiffness);
  CHECK(validate(scene).ok());
  // The matrix of a bar holds no rigid motion.
  const double bar[16] = {1, 0, -1, 0, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, 0};
  for (int i = 0; i < 16; ++i) scene.substructure_entries[i] = 1e6 * bar[i];
  CHECK(validate(scene).code == Code::unsupported);
}

TEST_CASE("a soft bearing holds as well as a stiff one") {
  for (const double stiffness : {1e-3, 1.0, 1e12}) {
    Plane scene;
    scene.add_node({0, 0}, held_y);
    scene.add_node({4, 0}, held_y);
    const int on = 1;
    const double bearing[] = {stiffness, 0, 0, 0};
    scene.add_substructure(&on, 1, bearing);
    CHECK(validate(scene).ok());
  }
}

TEST_CASE("a joint of one degree opening passes") {
  const double opening = pi / 180;
  Plane scene;
  rigid_saddles(scene, steel_cable(0.1), {{5, 0}, {0, 0}, {5 * std::cos(opening), 5 * std::sin(opening)}});
  CHECK(validate(scene).ok());
}

TEST_CASE("a joint that turns by a millionth passes") {
  Plane scene;
  rigid_saddles(scene, steel_cable(0.1), {{-5, 0}, {0, 0}, {5, 5e-6}});
  CHECK(validate(scene).ok());
}

TEST_CASE("points far from the origin are told apart as far as their digits reach") {
  Plane scene;
  rigid_saddles(scene, steel_cable(0.1), {{1e6, 0}, {1e6 + 1e-3, 0}, {1e6 + 2e-3, 1e-3}});
  CHECK(validate(scene).ok());
  rigid_saddles(scene, steel_cable(0.1), {{1e6, 0}, {1e6 + 1e-10, 0}, {1e6 + 1, 1e-3}});
  CHECK(validate(scene).code == Code::coincident_nodes);
}

TEST_CASE("a scene in single precision is held to single precision") {
  taut::Scene<float, 2, Tiny> scene;
  scene.add_node({0, 0}, held_xy);
  scene.add_node({1, 0}, held_xy);
  scene.add_strut(0, 1, 2e11f, 1e-3f);
  CHECK(validate(scene).ok());
  scene.nodes[0].at = {1000, 0};
  scene.nodes[1].at = {1000.0001f, 0};
  CHECK(validate(scene).code == Code::coincident_nodes);
}

TEST_CASE("the first fault in the order of the lists is the one reported") {
  CHECK_STATUS(after([](Plane& s) {
                 s.mu[0] = -1;
                 s.struts[0].E = -1;
               }),
               Code::not_positive, Place::strut, 0);
}

}  // namespace validation_test
