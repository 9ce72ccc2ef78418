// The same structure written down differently gives the same answer.
#include <Eigen/Geometry>
#include <numeric>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "support/transform.hpp"

namespace equivalent_test {
using namespace support;

namespace {

constexpr double rounding = 1e-10;  // other order of elimination: rounding times the condition number

Plane scene, other;
Space space, turned;

/// The forces of a history that loads, jacks, gives way and jacks again.
struct Row {
  double load, other_load, jack;
};
constexpr Row history[] = {{0, 0, 1.5e5}, {1, 0, 2e5}, {1, 0.5, 1e5}, {0.5, 1, 2.4e5}};

/// Where the parts of one scene are in the other, and the units there.
struct Mapping {
  bool mirrored = false;
  double length = 1, force = 1;
};

template <class A, class B>
void compare(const A& a, const B& b, int segments, int struts, const Mapping& map) {
  const double scale = a.largest_force();
  const double sign = map.mirrored ? -1 : 1;
  for (int i = 0; i < segments; ++i) {
    CAPTURE(i);
    CHECK(close(a.T(i) * map.force, b.T(map.mirrored ? segments - 1 - i : i), rounding, scale * map.force));
  }
  for (int j = 0; j + 1 < segments; ++j) {
    CAPTURE(j);
    const int k = map.mirrored ? segments - 2 - j : j;
    CHECK(close(sign * a.slip(j) * map.length, b.slip(k), rounding, 1e-2 * map.length));
    CHECK(close(sign * a.response().friction[j] * map.force, b.response().friction[k], rounding,
                scale * map.force));
    CHECK(close(a.response().contact[j] * map.force, b.response().contact[k], rounding, scale * map.force));
  }
  for (int i = 0; i < struts; ++i)
    CHECK(close(a.response().strut[i] * map.force, b.response().strut[i], rounding, scale * map.force));
  for (const int end : {0, 1})
    CHECK(close(a.extension(0, end) * map.length, b.extension(0, map.mirrored ? 1 - end : end), rounding,
                1e-2 * map.length));
}

/// Follows the history in both scenes, jacked at the end of the first.
template <class SceneA, class SceneB>
void follow(const SceneA& a, const SceneB& b, Solver solver, const Mapping& map = {}) {
  Bench<double, SceneA> first(a, solver);
  Bench<double, SceneB> second(b, solver);
  REQUIRE(first.started().ok());
  REQUIRE(second.started().ok());
  for (const Row& row : history) {
    CAPTURE(row.jack);
    first.load(0, row.load).load(1, row.other_load).jack(0, 1, row.jack);
    second.load(0, row.load).load(1, row.other_load).jack(0, map.mirrored ? 0 : 1, row.jack * map.force);
    REQUIRE(first.go().ok());
    REQUIRE(second.go().ok());
    compare(first, second, a.prestrain.size(), a.struts.size(), map);
  }
}

/// A truss string structure with random sizes and a little prestrain in the cable.
void random_truss(std::uint64_t seed, double seating = 0) {
  Random random(seed);
  taut::Cable<double> cable = steel_cable(random.between(0.1, 0.5));
  cable.prestrain = 2e-4;
  cable.seating = seating;
  truss_string(scene, cable, 3 + random.below(6), Variation(random));
}

}  // namespace

SOLVER_TEST_CASE("the order of the nodes does not matter", solver) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    random_truss(seed);
    std::vector<int> order(static_cast<std::size_t>(scene.nodes.size()));
    std::iota(order.begin(), order.end(), 0);
    Random random(100 + seed);
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.below(static_cast<int>(i) + 1))]);
    permute_nodes(scene, other, order);
    follow(scene, other, solver);
  }
}

SOLVER_TEST_CASE("a path run through backwards gives the mirrored answer", solver) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    random_truss(seed);
    reverse_paths(scene, other);
    Mapping map;
    map.mirrored = true;
    follow(scene, other, solver, map);
  }
}

SOLVER_TEST_CASE("a structure turned in space has the same forces", solver) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  for (const double angle : {0.3, 1.0, 2.5}) {
    CAPTURE(angle);
    Random random(3);
    space_truss_string(space, steel_cable(0.3), 4, Variation(random));
    rotate(space, turned, Eigen::AngleAxisd(angle, axis).toRotationMatrix());
    follow(space, turned, solver);
  }
}

SOLVER_TEST_CASE("a plane structure in space has the same forces", solver) {
  taut::Cable<double> cable = steel_cable(0.3);
  cable.prestrain = 2e-4;
  Random random(5);
  truss_string(scene, cable, 6, Variation(random));
  embed(scene, space);
  follow(scene, space, solver);
}

SOLVER_TEST_CASE("saddles and wobble in space are those in the plane", solver) {
  taut::Cable<double> cable = steel_cable(0.2);
  cable.law = taut::FrictionLaw::capstan;
  cable.wobble = 0.02;
  truss_string(scene, cable, 5);
  embed(scene, space);
  follow(scene, space, solver);
}

SOLVER_TEST_CASE(
    "in newton and millimetre, or kilonewton and metre, the numbers are those of newton and metre", solver) {
  for (const auto& units : {std::pair<double, double>{1e3, 1.0}, {1.0, 1e-3}, {1e-3, 1e-6}}) {
    CAPTURE(units.first);
    CAPTURE(units.second);
    random_truss(4);
    Mapping map;
    map.length = units.first;
    map.force = units.second;
    change_units(scene, other, map.length, map.force);
    follow(scene, other, solver, map);
  }
}

SOLVER_TEST_CASE("a substructure with the matrix of a bar is a strut", solver) {
  random_truss(6);
  const int struts = scene.struts.size();
  other = scene;
  other.struts = {};
  for (const auto& strut : scene.struts) {
    if (other.struts.size() + 5 < struts) {
      other.struts.add(strut);
      continue;
    }
    const auto& a = scene.nodes[strut.nodes[0]].at;
    const auto& b = scene.nodes[strut.nodes[1]].at;
    const double dx = b[0] - a[0], dy = b[1] - a[1], L = std::hypot(dx, dy);
    const double along[] = {-dx / L, -dy / L, dx / L, dy / L};
    double stiffness[16];
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k) stiffness[4 * i + k] = strut.E * strut.A / L * along[i] * along[k];
    other.add_substructure(strut.nodes.data(), 2, stiffness);
  }
  REQUIRE(other.substructures.size() == 5);
  Bench<double, Plane> first(scene, solver), second(other, solver);
  for (const Row& row : history) {
    for (auto* bench : {&first, &second}) {
      bench->load(0, row.load).load(1, row.other_load).jack(0, 1, row.jack);
      REQUIRE(bench->go().ok());
    }
    CHECK_LAWFUL(second, double);
    compare(first, second, scene.prestrain.size(), other.struts.size(), {});
  }
}

SOLVER_TEST_CASE("what happened before a start leaves no trace", solver) {
  random_truss(7, 3e-3);
  Bench<double, Plane> used(scene, solver), fresh(scene, solver);
  REQUIRE(used.load(0, 1).load(1, -3).jack(0, 1, 3e5).go().ok());
  REQUIRE(used.lock(0, 1).go().ok());
  REQUIRE(used.restart().ok());
  for (auto* bench : {&used, &fresh}) REQUIRE(bench->load(0, 1).jack(0, 1, 2e5).go().ok());
  for (int i = 0; i < scene.prestrain.size(); ++i) CHECK(used.T(i) == fresh.T(i));
  for (int j = 0; j < scene.mu.size(); ++j) CHECK(used.slip(j) == fresh.slip(j));
}

}  // namespace equivalent_test
