// What has no answer is refused by name, and nothing is changed by it.
#include <cstring>
#include <limits>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace refusals_test {
using namespace support;
using taut::Code;
using taut::Place;

namespace {

using PlaneBench = Bench<double, Plane>;
Plane scene;

/// Every number of a state, for comparison bit by bit.
std::vector<double> state_of(const PlaneBench& bench) {
  std::vector<double> all;
  const auto& response = bench.response();
  for (int i = 0; i < scene.prestrain.size(); ++i) all.push_back(response.tension[i]);
  for (int j = 0; j < scene.mu.size(); ++j) {
    all.push_back(response.slip[j]);
    all.push_back(response.contact[j]);
    all.push_back(response.friction[j]);
    all.push_back(static_cast<double>(response.state[j]));
  }
  for (int i = 0; i < scene.struts.size(); ++i) all.push_back(response.strut[i]);
  for (const double extension : response.extension[0]) all.push_back(extension);
  for (int node = 0; node < scene.nodes.size(); ++node)
    for (int axis = 0; axis < 2; ++axis) all.push_back(bench.displacement(node, axis));
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// A lower node on one vertical strut; the cable is flatter to its left than to its right.
void one_vertical_strut(double mu, bool second_strut) {
  scene = {};
  const int left = scene.add_node({-6, 0}, taut::held_xy);
  const int head = scene.add_node({0, 0}, taut::held_xy);
  const int right = scene.add_node({2, 0}, taut::held_xy);
  const int foot = scene.add_node({0, -2});
  scene.add_strut(head, foot, steel, 1e-3);
  if (second_strut) scene.add_strut(left, foot, steel, 1e-3);
  scene.add_cable(steel_cable(mu), {left, foot, right});
}

/// A state in the middle of things on a truss string structure.
PlaneBench& busy(PlaneBench& bench) {
  REQUIRE(bench.load(0, 1).jack(0, 1, 2e5).go().ok());
  REQUIRE(bench.load(0, 0.5).jack(0, 1, 1.5e5).go().ok());
  return bench;
}

}  // namespace

SOLVER_TEST_CASE("a lower node on one vertical strut is named as a mechanism when its joint slides", solver) {
  one_vertical_strut(0.05, false);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.started().ok());
  // Stepwise names the node, the tracker the joint whose sliding sets it free.
  const taut::Status status = bench.jack(0, 1, 1e5).go();
  if (solver == Solver::stepwise)
    CHECK_STATUS(status, Code::mechanism, Place::node, 3);
  else
    CHECK_STATUS(status, Code::mechanism, Place::joint, 0, 0);
}

SOLVER_TEST_CASE("a second strut is the remedy for that mechanism", solver) {
  one_vertical_strut(0.05, true);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, 1e5).go().ok());
  CHECK_LAWFUL(bench, double);
}

SOLVER_TEST_CASE("a lower node on one vertical strut is held by a joint that does not slide", solver) {
  // T1 cos(a1) = T2 cos(a2) in the horizontal: T1 / T2 = sqrt(1/2) / (3 / sqrt(10)), held by mu cot(alpha) >
  // (1 - that) / (1 + that).
  one_vertical_strut(0.6, false);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, 1e5).go().ok());
  CHECK_LAWFUL(bench, double);
  CHECK(close(bench.T(0) / bench.T(1), std::sqrt(5.0) / 3, 1e-11));
}

SOLVER_TEST_CASE("a node that hangs on a single bar is named as a mechanism at the start", solver) {
  scene = {};
  scene.add_node({0, 0}, taut::held_xy);
  scene.add_node({1, 0}, taut::held_xy);
  scene.add_node({1, -1});
  scene.add_strut(1, 2, steel, 1e-3);
  PlaneBench bench(scene, solver);
  CHECK_STATUS(bench.started(), Code::mechanism, Place::node, 2);
}

SOLVER_TEST_CASE("a node that a soft substructure holds is no mechanism, but too soft to tell its forces",
                 solver) {
  scene = {};
  scene.add_node({0, 0}, taut::held_xy);
  scene.add_node({1, 0}, taut::held_xy);
  scene.add_node({2, -1});
  scene.add_strut(1, 2, steel, 1e-3);
  const std::array<double, 4> soft{1e-12, 0, 0, 1e-12};
  const int held = 2;
  scene.add_substructure(&held, 1, soft.data());
  CHECK_STATUS(PlaneBench(scene, solver).started(), Code::ill_conditioned, Place::node, 2);
  for (double& entry : scene.substructure_entries) entry *= 1e16;
  CHECK(PlaneBench(scene, solver).started().ok());
}

SOLVER_TEST_CASE("a scene with a fault does not start", solver) {
  truss_string(scene, steel_cable(-1), 4);
  PlaneBench bench(scene, solver);
  CHECK_STATUS(bench.started(), Code::negative, Place::joint, 0, 0);
  CHECK(bench.jack(0, 1, 1e5).go().code == Code::not_started);
}

SOLVER_TEST_CASE("two jacks that differ by more than all friction pull the cable through", solver) {
  const hand::Chain chain{5, 0.3};
  rigid_saddles(scene, steel_cable(chain.mu, two_jacks), chain_points(chain.segments));
  const double F = 2e5, held = F * chain.reach(0);
  PlaneBench bench(scene, solver);
  CHECK_STATUS(bench.jack(0, 0, 0.999 * held).jack(0, 1, F).go(), Code::pulled_through, Place::cable, 0);
  CHECK_STATUS(bench.jack(0, 0, F).jack(0, 1, 0.999 * held).go(), Code::pulled_through, Place::cable, 0);
  CHECK(bench.jack(0, 0, 1.001 * held).jack(0, 1, F).go().ok());
}

SOLVER_TEST_CASE("without friction two jacks that differ at all pull the cable through", solver) {
  rigid_saddles(scene, steel_cable(0, two_jacks), chain_points(4));
  PlaneBench bench(scene, solver);
  CHECK(bench.jack(0, 0, 1e5).jack(0, 1, 1e5).go().ok());
  CHECK_STATUS(bench.jack(0, 0, 0.99e5).go(), Code::pulled_through, Place::cable, 0);
}

SOLVER_TEST_CASE("two different jacks on a cable of one segment pull it through", solver) {
  rigid_saddles(scene, steel_cable(0, two_jacks), chain_points(1));
  PlaneBench bench(scene, solver);
  CHECK(bench.jack(0, 0, 1e5).jack(0, 1, 1.1e5).go().code == Code::pulled_through);
}

SOLVER_TEST_CASE(
    "jacks that differ on both sides of a node which nothing else holds are no equilibrium, in any row",
    solver) {
  // Stays on both sides of a pinned mast, and one cable that sticks on the strut between its jacks.
  for (const bool over_strut : {false, true}) {
    CAPTURE(over_strut);
    scene = {};
    const int left = scene.add_node({-10, 0}, taut::held_xy);
    const int right = scene.add_node({10, 0}, taut::held_xy);
    const int foot = scene.add_node({0, over_strut ? 2.0 : 0.0}, taut::held_xy);
    const int top = scene.add_node({0, over_strut ? -1.0 : 10.0});
    scene.add_strut(foot, top, steel, 5e-3);
    if (over_strut) {
      scene.add_cable(steel_cable(0.3, two_jacks), {left, top, right});
    } else {
      scene.add_cable(steel_cable(0, jacked_end), {top, left});
      scene.add_cable(steel_cable(0, jacked_end), {top, right});
    }
    const int other = over_strut ? 0 : 1;
    PlaneBench bench(scene, solver);
    const taut::Status equal = bench.started().ok()
                                   ? bench.jack(0, 1, 1e5).jack(other, over_strut ? 0 : 1, 1e5).go()
                                   : bench.started();
    // Stepwise has no answer where jacks alone hold a node.
    if (solver == Solver::stepwise) {
      CHECK(equal.code == Code::mechanism);
      continue;
    }
    REQUIRE(equal.ok());
    const taut::Status status = bench.jack(0, 1, 1.1e5).go();
    CHECK(status.code == Code::mechanism);
    // From an equilibrium on which it stands again.
    CHECK(bench.T(0) == doctest::Approx(1e5));
  }
}

SOLVER_TEST_CASE("a self-locking joint between two jacks holds any difference", solver) {
  rigid_saddles(scene, steel_cable(0.1, two_jacks), chain_points(3));
  scene.mu[1] = 100;
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 0, 0).jack(0, 1, 2e5).go().ok());
  CHECK_LAWFUL(bench, double);
  CHECK(bench.T(0) == 0);
}

SOLVER_TEST_CASE("a sample that is no number or a negative force is refused, and no bit of the state changes",
                 solver) {
  truss_string(scene, steel_cable(0.3), 6);
  PlaneBench bench(scene, solver);
  const auto before = state_of(busy(bench));
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {not_a_number, infinite, -infinite}) {
    CHECK_STATUS(bench.load(1, bad).go(), Code::bad_sample, Place::load, 1);
    bench.load(1, 0);
  }
  for (const double bad : {not_a_number, infinite, -1.0, -1e-30})
    CHECK_STATUS(bench.jack(0, 1, bad).go(), Code::bad_sample, Place::cable_end, 1, 0);
  CHECK(same_bits(before, state_of(bench)));
}

SOLVER_TEST_CASE("after a refused sample everything goes on as if it had never been given", solver) {
  truss_string(scene, steel_cable(0.3), 6);
  PlaneBench disturbed(scene, solver), calm(scene, solver);
  busy(disturbed);
  busy(calm);
  CHECK_FALSE(disturbed.jack(0, 1, -1).go().ok());
  for (PlaneBench* bench : {&disturbed, &calm}) REQUIRE(bench->load(0, 2).jack(0, 1, 2.5e5).go(3).ok());
  CHECK(same_bits(state_of(disturbed), state_of(calm)));
}

SOLVER_TEST_CASE("an anchored end needs no jack force, whatever stands in its place", solver) {
  truss_string(scene, steel_cable(0.3), 6);
  PlaneBench bench(scene, solver);
  CHECK(bench.jack(0, 0, -7).jack(0, 1, 1e5).go().ok());
}

// Of stepwise alone: the tracker stops on the way, see below.
TEST_CASE("a load step that fails leaves the state before it, to go on from") {
  rigid_saddles(scene, steel_cable(0.3, two_jacks), chain_points(5));
  PlaneBench failing(scene, Solver::stepwise), calm(scene, Solver::stepwise);
  for (PlaneBench* bench : {&failing, &calm}) {
    REQUIRE(bench->jack(0, 0, 2e5).jack(0, 1, 2e5).go().ok());
    REQUIRE(bench->jack(0, 0, 1.8e5).jack(0, 1, 1.9e5).go().ok());
  }
  const auto before = state_of(failing);
  CHECK(failing.jack(0, 0, 0).go().code == Code::pulled_through);
  CHECK(same_bits(before, state_of(failing)));
  for (PlaneBench* bench : {&failing, &calm}) REQUIRE(bench->jack(0, 0, 2.1e5).go().ok());
  CHECK(same_bits(state_of(failing), state_of(calm)));
}

// Of the tracker alone: within a load step stepwise knows no last state.
TEST_CASE("a path that ends where the cable is pulled through is followed as far as friction holds") {
  const hand::Chain chain{5, 0.3};
  rigid_saddles(scene, steel_cable(chain.mu, two_jacks), chain_points(chain.segments));
  PlaneBench bench(scene, Solver::tracker);
  REQUIRE(bench.jack(0, 0, 2e5).jack(0, 1, 2e5).go().ok());
  REQUIRE(bench.jack(0, 0, 1.8e5).jack(0, 1, 1.9e5).go().ok());
  CHECK(bench.jack(0, 0, 0).go().code == Code::pulled_through);
  // The other jack has kept its force, and all joints slide towards it.
  for (int i = 0; i < chain.segments; ++i) CHECK(close(bench.T(i), 1.9e5 * chain.reach(i), 1e-11));
  REQUIRE(bench.jack(0, 0, 2.1e5).go().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < chain.segments; ++i)
    CHECK(close(bench.T(i), std::fmax(1.9e5 * chain.reach(i), 2.1e5 * chain.reach_from_start(i)), 1e-11));
}

SOLVER_TEST_CASE("an advance that runs into a mechanism leaves the last state", solver) {
  one_vertical_strut(0.05, false);
  PlaneBench bench(scene, solver);
  const auto before = state_of(bench);
  CHECK(bench.jack(0, 1, 1e5).go().code == Code::mechanism);
  CHECK(same_bits(before, state_of(bench)));
  CHECK(bench.jack(0, 1, 0).go().ok());
}

}  // namespace refusals_test
