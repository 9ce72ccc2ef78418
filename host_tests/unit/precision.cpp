// Single precision against double, on every kind of scene.
#include <functional>
#include <string>

#include "support/bench.hpp"
#include "support/status_check.hpp"

namespace precision_test {
using namespace support;

namespace {

constexpr double single = 1e-5;  // parts of the largest force: what the device's type is to achieve

struct Row {
  double load, other_load, jack;
  bool locked;
};
constexpr Row history[] = {{0, 0, 1e5, false},     {1, 0, 2e5, false},   {1, 0, 2e5, true}, {1, 0.5, 0, true},
                           {1, 0.5, 2.2e5, false}, {0.2, 1, 1e5, false}, {0, 0, 0, false}};

template <class SceneType>
void compare(const SceneType& scene, Solver solver, int jacked) {
  Bench<double, SceneType> fine(scene, solver);
  Bench<float, SceneType> coarse(scene, solver);
  REQUIRE(fine.started().ok());
  REQUIRE(coarse.started().ok());
  double largest = 0;
  for (const Row& row : history) {
    CAPTURE(row.jack);
    CAPTURE(row.load);
    const auto go = [&](auto& bench) {
      bench.load(0, row.load).load(1, row.other_load);
      if (jacked >= 0) bench.jack(0, jacked, row.jack);
      if (jacked >= 0 && row.locked) bench.lock(0, jacked);
      return bench.go();
    };
    REQUIRE(go(fine).code == taut::Code::ok);
    REQUIRE(go(coarse).code == taut::Code::ok);
    CHECK_LAWFUL(coarse, float);
    largest = std::fmax(largest, fine.largest_force());
    for (int i = 0; i < scene.prestrain.size(); ++i) {
      CAPTURE(i);
      CHECK(std::fabs(fine.T(i) - coarse.T(i)) <= single * largest);
    }
    for (int i = 0; i < scene.struts.size(); ++i)
      CHECK(std::fabs(fine.response().strut[i] - static_cast<double>(coarse.response().strut[i])) <=
            single * largest);
  }
}

taut::Cable<double> cable_of(double mu, std::array<taut::End, 2> ends, double prestrain) {
  taut::Cable<double> cable = steel_cable(mu, ends);
  cable.prestrain = prestrain;
  cable.seating = 2e-3;
  return cable;
}

Plane plane;
Space space;

}  // namespace

SOLVER_TEST_CASE("chains on rigid saddles have the same forces in single precision", solver) {
  for (const double mu : {0.0, 0.1, 0.3}) {
    rigid_saddles(plane, cable_of(mu, jacked_end, 0), chain_points(8));
    plane.add_load();
    plane.add_load();
    compare(plane, solver, 1);
  }
}

SOLVER_TEST_CASE("plane truss string structures have the same forces in single precision", solver) {
  for (const double mu : {0.0, 0.1, 0.3, 0.6})
    for (const int panels : {3, 6, 8}) {
      CAPTURE(mu);
      CAPTURE(panels);
      truss_string(plane, cable_of(mu, jacked_end, 0), panels);
      compare(plane, solver, 1);
      truss_string(plane, cable_of(mu, jacked_start, 0), panels);
      compare(plane, solver, 0);
      truss_string(plane, cable_of(mu, anchored, 1e-3), panels);
      compare(plane, solver, -1);
    }
}

SOLVER_TEST_CASE("spatial truss string structures have the same forces in single precision", solver) {
  for (const double mu : {0.0, 0.2, 0.5}) {
    CAPTURE(mu);
    space_truss_string(space, cable_of(mu, jacked_end, 0), 4);
    compare(space, solver, 1);
  }
}

SOLVER_TEST_CASE("rings of suspen-domes have the same forces in single precision", solver) {
  for (const double mu : {0.0, 0.1, 0.3}) {
    CAPTURE(mu);
    dome_ring(space, cable_of(mu, anchored, 1e-3), 8);
    compare(space, solver, -1);
  }
}

SOLVER_TEST_CASE("a far origin costs single precision nothing, for geometry is taken in double", solver) {
  truss_string(plane, cable_of(0.2, jacked_end, 0), 6);
  for (auto& node : plane.nodes) {
    node.at[0] += 5e5;
    node.at[1] += 5e6;
  }
  compare(plane, solver, 1);
}

}  // namespace precision_test
