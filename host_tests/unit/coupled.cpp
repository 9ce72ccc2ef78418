// Cables on an elastic structure, against hand calculations and each other.
#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace coupled_test {
using namespace support;
using hand::EA;

namespace {

constexpr double rounding = 1e-11;
using PlaneBench = Bench<double, Plane>;
Plane scene;

constexpr double half_span = 4, sag = 3, side = 5;      // 3-4-5: both segments are 5 m long
constexpr double cos_alpha = sag / side, spring = 3e7;  // of the joint [N/m], upwards

/// A cable hung from two held nodes under a node on a spring, which moves up and down only.
void queen_post(const taut::Cable<double>& cable) {
  scene = {};
  const int left = scene.add_node({-half_span, 0}, taut::held_xy);
  const int foot = scene.add_node({0, -sag}, taut::held_x);
  const int right = scene.add_node({half_span, 0}, taut::held_xy);
  scene.add_cable(cable, {left, foot, right});
  const double stiffness[] = {0, 0, 0, spring};
  scene.add_substructure(&foot, 1, stiffness);
  scene.add_force(scene.add_load(), foot, {0, -1});
}

}  // namespace

SOLVER_TEST_CASE("a jacked cable lifts the spring it runs under by 2 T cos(alpha) / k", solver) {
  queen_post(steel_cable(0));
  PlaneBench bench(scene, solver);
  const double T = 2e5;
  REQUIRE(bench.jack(0, 1, T).go().ok());
  CHECK_LAWFUL(bench, double);
  const double lift = 2 * T * cos_alpha / spring;
  CHECK(close(bench.displacement(1, 1), lift, rounding));
  CHECK(close(bench.extension(0, 1), 2 * T * side / EA + 2 * lift * cos_alpha, rounding));
  CHECK(close(bench.response().contact[0], 2 * T * cos_alpha, rounding));
}

SOLVER_TEST_CASE("an elastic support takes prestrain away", solver) {
  taut::Cable<double> cable = steel_cable(0, anchored);
  cable.prestrain = 2e-3;
  queen_post(cable);
  PlaneBench bench(scene, solver);
  // k u = 2 T cos(alpha), T = EA prestrain - EA / L u cos(alpha).
  const double T = EA * 2e-3 / (1 + 2 * cos_alpha * cos_alpha * EA / (side * spring));
  CHECK_LAWFUL(bench, double);
  CHECK(close(bench.T(0), T, rounding));
  CHECK(close(bench.T(1), T, rounding));
}

SOLVER_TEST_CASE("a load on the joint is shared between spring and cable by their stiffness", solver) {
  taut::Cable<double> cable = steel_cable(0.2, anchored);
  cable.prestrain = 2e-3;
  queen_post(cable);
  PlaneBench bench(scene, solver);
  const double before = bench.T(0);
  const double cable_stiffness = 2 * cos_alpha * cos_alpha * EA / side;
  for (const double load : {1e4, -2e4, 5e4}) {
    REQUIRE(bench.load(0, load).go().ok());
    CHECK_LAWFUL(bench, double);
    const double down = load / (spring + cable_stiffness);
    CHECK(close(bench.T(0), before + EA / side * down * cos_alpha, rounding));
    CHECK(bench.slip(0) == doctest::Approx(0).epsilon(1e-15));
  }
}

SOLVER_TEST_CASE("friction of one joint on a spring is that of the two tensions at its limit", solver) {
  queen_post(steel_cable(0.25));
  PlaneBench bench(scene, solver);
  const double T2 = 2e5, kappa = 0.25 * sag / half_span;  // mu cot(alpha)
  REQUIRE(bench.jack(0, 1, T2).go().ok());
  CHECK_LAWFUL(bench, double);
  const double T1 = T2 * (1 - kappa) / (1 + kappa), lift = (T1 + T2) * cos_alpha / spring;
  CHECK(close(bench.T(0), T1, rounding));
  CHECK(close(bench.slip(0), T1 * side / EA + lift * cos_alpha, rounding));
  CHECK(close(bench.extension(0, 1), bench.slip(0) + T2 * side / EA + lift * cos_alpha, rounding));
}

SOLVER_TEST_CASE("two cables of half the area side by side are one cable", solver) {
  static Plane two;
  Random random(11);
  truss_string(scene, steel_cable(0.3), 6, Variation(random));
  two = scene;
  two.cables[0].A /= 2;
  const taut::Cable<double> twin = two.cables[0];
  std::vector<int> path(two.path.begin(), two.path.begin() + twin.nodes);
  two.add_cable(twin, path.data(), twin.nodes);
  for (int j = 0; j < twin.joints(); ++j) two.mu[twin.joints() + j] = two.mu[j];
  PlaneBench one(scene, solver), pair(two, solver);
  REQUIRE(pair.started().ok());
  for (const double force : {2e5, 1.2e5, 2.5e5}) {
    REQUIRE(one.load(0, 1).jack(0, 1, force).go().ok());
    REQUIRE(pair.load(0, 1).jack(0, 1, force / 2).jack(1, 1, force / 2).go().ok());
    CHECK_LAWFUL(pair, double);
    for (int i = 0; i < 6; ++i) {
      CHECK(close(pair.T(i), one.T(i) / 2, rounding, force));
      CHECK(close(pair.T(i + 6), one.T(i) / 2, rounding, force));
    }
  }
}

SOLVER_TEST_CASE("tensioning one cable relieves the other that hangs on the same structure", solver) {
  truss_string(scene, steel_cable(0.2), 6);
  taut::Cable<double> second = steel_cable(0.2, anchored);
  second.prestrain = 5e-4;
  std::vector<int> path(scene.path.begin(), scene.path.begin() + 7);
  scene.add_cable(second, path.data(), 7);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.load(0, 1).go().ok());
  const double before = bench.T(9);
  REQUIRE(bench.jack(0, 1, 2e5).go().ok());
  CHECK_LAWFUL(bench, double);
  CHECK(bench.T(9) < 0.95 * before);
  REQUIRE(bench.jack(0, 1, 0).go().ok());
  CHECK_LAWFUL(bench, double);
}

SOLVER_TEST_CASE("without friction loads and jack force can be taken back in any order", solver) {
  truss_string(scene, steel_cable(0), 8);
  PlaneBench round_about(scene, solver), straight(scene, solver);
  REQUIRE(round_about.jack(0, 1, 3e5).go().ok());
  REQUIRE(round_about.load(0, 2).go().ok());
  REQUIRE(round_about.jack(0, 1, 1e5).go().ok());
  REQUIRE(round_about.load(0, 0.5).load(1, 0.5).go().ok());
  REQUIRE(straight.load(0, 0.5).load(1, 0.5).jack(0, 1, 1e5).go().ok());
  for (int i = 0; i < 8; ++i) CHECK(close(round_about.T(i), 1e5, rounding, 3e5));
  for (int i = 0; i < scene.struts.size(); ++i)
    CHECK(close(round_about.response().strut[i], straight.response().strut[i], rounding, 3e5));
  for (int j = 0; j < 7; ++j)
    CHECK(close(round_about.slip(j), straight.slip(j), rounding, round_about.largest_force() * 30 / EA));
}

SOLVER_TEST_CASE("with self-locking joints a cable is a chain of bars", solver) {
  taut::Cable<double> cable = steel_cable(100, anchored);
  cable.prestrain = 3e-3;
  truss_string(scene, cable, 6);
  for (double& mu : scene.mu) mu = 1e6;
  static Plane bars;
  bars = scene;
  bars.cables = {};
  bars.path = {};
  bars.prestrain = {};
  bars.mu = {};
  for (int i = 0; i < 6; ++i) bars.add_strut(scene.path[i], scene.path[i + 1], cable_E, cable_A);
  PlaneBench locked(scene, solver), frame(bars, solver);
  const double start = locked.T(2);
  REQUIRE(start > 0);
  const auto before = locked.response().tension;
  REQUIRE(locked.load(0, 1).go().ok());
  REQUIRE(frame.load(0, 1).go().ok());
  CHECK_LAWFUL(locked, double);
  for (int i = 0; i < 6; ++i) {
    CHECK(close(locked.T(i) - before[i], frame.response().strut[scene.struts.size() + i], 1e-10,
                locked.largest_force()));
    if (i < 5) CHECK(locked.slip(i) == 0);
  }
}

}  // namespace coupled_test
