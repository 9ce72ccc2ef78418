// The structure behind condensation where it is statically determinate, and where it cannot be resolved.
#include <cmath>
#include <memory>
#include <vector>

#include "support/bench.hpp"
#include "support/dense.hpp"
#include "support/status_check.hpp"
#include "taut/condensation/condense.hpp"
#include "unit/hand.hpp"

namespace structure_test {
using namespace support;
using taut::Code;
using taut::Place;

namespace {

using Condensation = taut::Condensation<double, Plane>;
using Model = taut::Condensed<double, PlaneCapacity>;

Plane scene;
const auto condensation = std::make_unique<Condensation>();
const auto model = std::make_unique<Model>();

taut::Cable<double> prestrained() {
  taut::Cable<double> cable = steel_cable(0.2, anchored);
  cable.prestrain = 1e-3;
  return cable;
}

/// A node that hangs on its two segments alone, 5 m long each: 3-4-5. Load 0 is 1 N downwards, load 1 to the
/// right.
void hung_node() {
  scene = {};
  const int left = scene.add_node({-4, 0}, taut::held_xy), foot = scene.add_node({0, -3});
  const int right = scene.add_node({4, 0}, taut::held_xy);
  scene.add_cable(prestrained(), {left, foot, right});
  scene.add_force(scene.add_load(), foot, {0, -1});
  scene.add_force(scene.add_load(), foot, {1, 0});
}

/// Two nodes on struts above a cable that turns at two others: eight bars for eight displacements, once a
/// strut and a segment side by side count as one. Load 0 is 10 kN down on both upper nodes.
void two_posts() {
  scene = {};
  const int a = scene.add_node({0, 0}, taut::held_xy), b = scene.add_node({9, 0}, taut::held_xy);
  const int c = scene.add_node({3, 0.5}), d = scene.add_node({6, 0.7});
  const int e = scene.add_node({3.2, -1}), f = scene.add_node({6.1, -1.1});
  for (const auto& bar : {std::array<int, 2>{a, c}, {c, d}, {d, b}, {c, e}, {d, f}, {e, f}})
    scene.add_strut(bar[0], bar[1], steel, 1e-3);
  scene.add_cable(prestrained(), {a, e, f, b});
  const int down = scene.add_load();
  for (const int node : {c, d}) scene.add_force(down, node, {0, -1e4});
}

/// Forces of the bars between `ends` that balance load 0 on all free nodes: the method of joints.
Vector by_method_of_joints(const std::vector<std::array<int, 2>>& ends) {
  std::vector<int> rows;
  int count = 0;
  for (const auto& node : scene.nodes) rows.push_back(node.is_held(0) ? -1 : 2 * count++);
  const auto row = [&](int node) { return rows[static_cast<std::size_t>(node)]; };
  Matrix A = Matrix::Zero(2 * count, static_cast<int>(ends.size()));
  Vector load = Vector::Zero(2 * count);
  for (std::size_t bar = 0; bar < ends.size(); ++bar) {
    const auto &from = scene.nodes[ends[bar][0]].at, &to = scene.nodes[ends[bar][1]].at;
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    for (int axis = 0; axis < 2; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double along = (to[i] - from[i]) / length;
      if (row(ends[bar][0]) >= 0) A(row(ends[bar][0]) + axis, static_cast<int>(bar)) += along;
      if (row(ends[bar][1]) >= 0) A(row(ends[bar][1]) + axis, static_cast<int>(bar)) -= along;
    }
  }
  for (const auto& given : scene.forces)
    for (int axis = 0; axis < 2; ++axis)
      load[row(given.node) + axis] -= given.force[static_cast<std::size_t>(axis)];
  REQUIRE(A.rows() == A.cols());
  return solved(A, load);
}

/// Struts in a row, each softer than the next one by `part`, the softest at the ground.
void row_of_struts(double part) {
  scene = {};
  int last = scene.add_node({0, 0}, taut::held_xy);
  std::vector<int> row;
  double x = 0;
  for (int i = 0; i < 4; ++i) {
    x += 1 + 0.1 * i;
    row.push_back(scene.add_node({x, 0}, taut::held_y));
    scene.add_strut(last, row.back(), steel, 1e-3 * std::pow(part, 3 - i));
    last = row.back();
  }
  const int top = scene.add_node({x + 2.2, 1}, taut::held_xy);
  scene.add_cable(steel_cable(0.1, anchored), {row.front(), row.back(), top});
}

}  // namespace

TEST_CASE("a node that hangs on two segments alone takes its forces from statics, and none from prestrain") {
  hung_node();
  REQUIRE(condensation->run(scene, *model).ok());
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) CHECK(model->coupling(i, k) == 0);
    CHECK(model->prestrain[i] == 0);
    CHECK(close(model->load[0][i], 5.0 / 6, 1e-15));
    CHECK(close(model->load[1][i], i == 0 ? 5.0 / 8 : -5.0 / 8, 1e-15));
  }
}

TEST_CASE(
    "in a statically determinate structure an elongation makes no force, and loads are carried by statics") {
  two_posts();
  REQUIRE(condensation->run(scene, *model).ok());
  CHECK(condensation->condition() < 1e4);
  // Side by side with a strut of the same length a segment does feel its elongation.
  const double length = std::hypot(2.9, 0.1), cable = hand::EA / length, strut = steel * 1e-3 / length;
  const double both = cable * strut / (cable + strut);
  for (const int i : {0, 2}) {
    for (const int k : {0, 2}) CHECK(model->coupling(i, k) == 0);
    CHECK(std::fabs(model->coupling(i, 1)) <= 1e-15 * both);
    CHECK(std::fabs(model->coupling(1, i)) <= 1e-15 * both);
    CHECK(std::fabs(model->prestrain[i]) <= 1e-15 * both * 1e-3 * length);
  }
  CHECK(close(model->coupling(1, 1), both, 1e-14));
  CHECK(close(model->prestrain[1], both * 1e-3 * length, 1e-14));

  // a-c, c-d, d-b, c-e, d-f, then the three sides below.
  const Vector force = by_method_of_joints({{0, 2}, {2, 3}, {3, 1}, {2, 4}, {3, 5}, {0, 4}, {4, 5}, {5, 1}});
  CHECK(close(model->load[0][0], force[5], 1e-12));
  CHECK(close(model->load[0][1], force[6] * cable / (cable + strut), 1e-12));
  CHECK(close(model->load[0][2], force[7], 1e-12));
}

SOLVER_TEST_CASE("a node that hangs on two segments alone has the forces of statics", solver) {
  hung_node();
  Bench<double, Plane> bench(scene, solver);
  REQUIRE(bench.started().ok());
  for (const double load : {3e4, 1e4, 6e4}) {
    REQUIRE(bench.load(0, load).go().ok());
    CHECK_LAWFUL(bench, double);
    for (int i = 0; i < 2; ++i) CHECK(close(bench.T(i), load * 5 / 6, 1e-12));
  }
}

TEST_CASE("without a load prestrain leaves no force in a node that hangs on two segments alone") {
  hung_node();
  Bench<double, Plane> bench(scene, Solver::tracker);
  REQUIRE(bench.started().ok());
  for (int i = 0; i < 2; ++i) CHECK(bench.T(i) == 0);
}

TEST_CASE("the sides of a cable that hold two posts have the forces of statics, and friction hands on") {
  two_posts();
  const Vector force = by_method_of_joints({{0, 2}, {2, 3}, {3, 1}, {2, 4}, {3, 5}, {0, 4}, {4, 5}, {5, 1}});
  Bench<double, Plane> bench(scene, Solver::tracker);
  REQUIRE(bench.started().ok());
  REQUIRE(bench.load(0, 1).go().ok());
  CHECK_LAWFUL(bench, double);
  CHECK(close(bench.T(0), force[5], 1e-11));
  CHECK(close(bench.T(2), force[7], 1e-11));
  // What the load gives the middle through the strut beside it is less than friction lets through at both
  // joints: the tighter side slides.
  const auto turn = [](int from, int at, int to) {
    const auto &p = scene.nodes[from].at, &q = scene.nodes[at].at, &r = scene.nodes[to].at;
    return std::atan2(r[1] - q[1], r[0] - q[0]) - std::atan2(q[1] - p[1], q[0] - p[0]);
  };
  const double from_left = force[5] * hand::point_ratio(0.2, turn(0, 4, 5));
  const double from_right = force[7] * hand::point_ratio(0.2, turn(4, 5, 1));
  REQUIRE(from_left > from_right);
  REQUIRE(from_left > force[6] / 2);
  CHECK(close(bench.T(1), from_left, 1e-11));
}

TEST_CASE("a structure whose forces have no digits in this precision is refused") {
  for (const double part : {1e-4, 1e-6, 1e-7}) {
    CAPTURE(part);
    row_of_struts(part);
    CHECK(condensation->run(scene, *model).ok());
    // The strut at the ground is so much softer than all others that it alone gives way.
    CHECK(close(model->coupling(0, 0), steel * 1e-3 * std::pow(part, 2) / 1.1, 3 * part));
  }
  for (const double part : {1e-8, 1e-10}) {
    CAPTURE(part);
    row_of_struts(part);
    CHECK(condensation->run(scene, *model).code == Code::ill_conditioned);
  }
}

}  // namespace structure_test
