// Cables that lose their tension and get it back.
#include <algorithm>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace slack_test {
using namespace support;
using hand::EA;
using taut::JointState;

namespace {

constexpr double rounding = 1e-11;
using PlaneBench = Bench<double, Plane>;
Plane scene, bare;

taut::Cable<double> prestrained(double mu, double prestrain) {
  taut::Cable<double> cable = steel_cable(mu, anchored);
  cable.prestrain = prestrain;
  return cable;
}

/// Largest difference of the tensions of two benches.
double tension_difference(const PlaneBench& a, const PlaneBench& b) {
  double most = 0;
  for (int i = 0; i < scene.prestrain.size(); ++i) most = std::fmax(most, std::fabs(a.T(i) - b.T(i)));
  return most;
}

}  // namespace

SOLVER_TEST_CASE("a warmed cable goes slack at the temperature that eats its prestrain, and comes back",
                 solver) {
  taut::Cable<double> cable = prestrained(0, 1e-3);
  cable.alpha = 1e-5;
  rigid_saddles(scene, cable, chain_points(4));
  scene.add_temperature(scene.add_load(), 0, 1);
  PlaneBench bench(scene, solver);
  for (const double kelvin : {50.0, 99.0, 101.0, 150.0, 120.0, 99.0, 0.0, 200.0, 20.0}) {
    CAPTURE(kelvin);
    REQUIRE(bench.load(0, kelvin).go().ok());
    CHECK_LAWFUL(bench, double);
    for (int i = 0; i < 4; ++i)
      CHECK(close(bench.T(i), EA * std::max(0.0, 1e-3 - 1e-5 * kelvin), rounding, EA * 1e-3));
    for (int j = 0; j < 3; ++j) CHECK((bench.response().state[j] == JointState::open) == (kelvin > 100));
  }
}

SOLVER_TEST_CASE("while the cable is slack the structure carries the load alone", solver) {
  truss_string(scene, prestrained(0.2, 2e-4), 6);
  truss_string(bare, prestrained(0.2, 2e-4), 6);
  bare.cables = {};
  bare.path = {};
  bare.prestrain = {};
  bare.mu = {};
  PlaneBench with(scene, solver), without(bare, solver);
  REQUIRE(with.load(1, 8).go().ok());
  REQUIRE(without.load(1, 8).go().ok());
  REQUIRE(with.T(0) == 0);
  // The lower nodes hang on their V-struts, so the same structure stands without the cable.
  for (int i = 0; i < scene.struts.size(); ++i)
    CHECK(close(with.response().strut[i], without.response().strut[i], rounding, with.largest_force()));
}

SOLVER_TEST_CASE("without friction a cable that was slack on the way has the tension of the straight way",
                 solver) {
  truss_string(scene, prestrained(0, 4e-4), 6);
  PlaneBench there_and_back(scene, solver), straight(scene, solver);
  for (const double relief : {8.0, 1.0, 10.0}) REQUIRE(there_and_back.load(1, relief).go().ok());
  REQUIRE(there_and_back.load(1, 0).load(0, 1).go().ok());
  REQUIRE(straight.load(0, 1).go().ok());
  REQUIRE(straight.T(0) > 0);
  CHECK(tension_difference(there_and_back, straight) <= rounding * there_and_back.largest_force());
}

SOLVER_TEST_CASE("with friction a cable that was slack obeys all laws when it is tightened again", solver) {
  bool was_slack = false;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    truss_string(scene, prestrained(random.between(0.05, 0.6), 3e-4), 3 + random.below(6), Variation(random));
    PlaneBench bench(scene, solver);
    for (const double relief : {0.0, 12.0, 3.0, 0.0, -3.0, 14.0, -1.0}) {
      REQUIRE(bench.load(1, relief).load(0, 0.3).go().ok());
      CHECK_LAWFUL(bench, double);
      was_slack = was_slack || bench.T(0) == 0;
    }
    CHECK(bench.T(0) > 0);
  }
  CHECK(was_slack);
}

SOLVER_TEST_CASE("a cable between anchors is slack from a negative prestrain on", solver) {
  rigid_saddles(scene, prestrained(0.2, -1e-4), chain_points(5));
  PlaneBench bench(scene, solver);
  REQUIRE(bench.started().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < 5; ++i) CHECK(bench.T(i) == 0);
}

SOLVER_TEST_CASE("one slack segment pulls its neighbours slack unless a self-locking joint lies between",
                 solver) {
  rigid_saddles(scene, prestrained(0.2, 0), chain_points(4));
  scene.prestrain[0] = 1e-3;
  scene.prestrain[1] = -3e-3;  // too long by more than the first segment is too short
  scene.prestrain[2] = scene.prestrain[3] = 5e-4;
  scene.mu[1] = 10;
  PlaneBench bench(scene, solver);
  CHECK_LAWFUL(bench, double);
  CHECK(bench.T(0) == 0);
  CHECK(bench.T(1) == 0);
  CHECK(close(bench.T(2), EA * 5e-4, rounding));
  CHECK(close(bench.T(3), EA * 5e-4, rounding));
  CHECK(bench.response().state[0] == JointState::open);
  CHECK(bench.response().state[1] != JointState::open);
}

SOLVER_TEST_CASE("a jack draws a cable straight that was laid too long", solver) {
  taut::Cable<double> cable = steel_cable(0.2);
  cable.prestrain = -1e-3;
  rigid_saddles(scene, cable, chain_points(4));
  const hand::Chain chain{4, 0.2};
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, 1e5).go().ok());
  CHECK_LAWFUL(bench, double);
  double elongation = 1e-3 * chain.total_length();
  for (int i = 0; i < 4; ++i) {
    CHECK(close(bench.T(i), 1e5 * chain.reach(i), rounding));
    elongation += bench.T(i) * chain.length(i) / EA;
  }
  CHECK(close(bench.extension(0, 1), elongation, rounding));
}

SOLVER_TEST_CASE("a jack takes hold of a cable that went slack behind its locked end", solver) {
  taut::Cable<double> cable = steel_cable(0.3);
  cable.seating = 0.1;
  rigid_saddles(scene, cable, chain_points(5));
  const hand::Chain chain{5, 0.3};
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, 2e5).go().ok());
  REQUIRE(bench.lock(0, 1).go().ok());
  REQUIRE(bench.T(4) == 0);
  REQUIRE(bench.jack(0, 1, 1e5).go().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < 5; ++i) CHECK(close(bench.T(i), 1e5 * chain.reach(i), rounding));
}

SOLVER_TEST_CASE("a cable that was slack has forgotten the forces that friction had kept in it", solver) {
  taut::Cable<double> cable = steel_cable(0.3);
  cable.alpha = 1e-5;
  rigid_saddles(scene, cable, chain_points(5));
  scene.add_temperature(scene.add_load(), 0, 1);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, 2e5).go().ok());
  REQUIRE(bench.lock(0, 1).go().ok());
  const hand::Chain chain{5, 0.3};
  double elongation = 0;
  for (int i = 0; i < 5; ++i) elongation += bench.T(i) * chain.length(i) / EA;
  const double slack_at = elongation / chain.total_length() / 1e-5;  // [K]
  REQUIRE(bench.load(0, slack_at + 5).go().ok());
  REQUIRE(bench.T(0) == 0);
  REQUIRE(bench.load(0, slack_at - 20).go().ok());
  CHECK_LAWFUL(bench, double);
  // From zero strain everywhere 20 K bring the same force everywhere.
  for (int i = 0; i < 5; ++i) CHECK(close(bench.T(i), EA * 1e-5 * 20, 1e-10));
}

SOLVER_TEST_CASE("a prestrained cable that was slack takes the same forces in one step as in a hundred",
                 solver) {
  truss_string(scene, prestrained(0.3, 4e-4), 6);
  PlaneBench at_once(scene, solver), in_steps(scene, solver);
  for (PlaneBench* bench : {&at_once, &in_steps}) {
    REQUIRE(bench->load(0, 1).go(100).ok());
    REQUIRE(bench->load(1, 20).load(0, 0).go(100).ok());
    REQUIRE(bench->T(0) == 0);
  }
  REQUIRE(at_once.load(1, 0).load(0, 1).go(1).ok());
  REQUIRE(in_steps.load(1, 0).load(0, 1).go(100).ok());
  // The step size is the only error; the load that tightens grows in proportion.
  CHECK(tension_difference(at_once, in_steps) <= 1e-3 * at_once.T(0));
}

}  // namespace slack_test
