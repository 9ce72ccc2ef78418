// Closed hoops: no end, every node a joint.
#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace hoop_test {
using namespace support;
using hand::EA;

namespace {

constexpr double rounding = 1e-11;
Plane scene;
Space ring;

taut::Cable<double> hoop_cable(double mu, double prestrain) {
  taut::Cable<double> cable = steel_cable(mu, anchored);
  cable.closed = true;
  cable.prestrain = prestrain;
  return cable;
}

/// A hexagon on held nodes, sides of 5 m.
void hexagon(double mu, double prestrain) {
  std::vector<PlanePoint> corners;
  for (int i = 0; i < 6; ++i) corners.push_back({5 * std::cos(pi / 3 * i), 5 * std::sin(pi / 3 * i)});
  rigid_saddles(scene, hoop_cable(mu, prestrain), corners);
}

}  // namespace

SOLVER_TEST_CASE(
    "an evenly prestrained hoop on rigid saddles has EA x prestrain everywhere, whatever the friction",
    solver) {
  for (const double mu : {0.0, 0.2, 3.0}) {
    hexagon(mu, 1e-3);
    Bench<double, Plane> bench(scene, solver);
    REQUIRE(bench.started().ok());
    CHECK_LAWFUL(bench, double);
    for (int i = 0; i < 6; ++i) CHECK(close(bench.T(i), EA * 1e-3, rounding));
  }
}

SOLVER_TEST_CASE("without friction uneven prestrain of a hoop evens out to its mean", solver) {
  hexagon(0, 0);
  for (int i = 0; i < 6; ++i) scene.prestrain[i] = 1e-4 * (1 + i * i);
  Bench<double, Plane> bench(scene, solver);
  REQUIRE(bench.started().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < 6; ++i) CHECK(close(bench.T(i), EA * 1e-4 * (6 + 55) / 6, rounding));
}

SOLVER_TEST_CASE("with friction one tighter side of a hoop hands on as much as its joints let through",
                 solver) {
  hexagon(0.2, 5e-4);
  scene.prestrain[2] = 1.5e-3;
  Bench<double, Plane> bench(scene, solver);
  REQUIRE(bench.started().ok());
  CHECK_LAWFUL(bench, double);
  // By symmetry about side 2: the two joints beside it slide to their limit, then the next two; the last two
  // hold. The material in the five sides between them stays. The corners turn by 60 degrees.
  const double rho = hand::point_ratio(0.2, pi / 3), low = EA * 5e-4, tight = EA * 1.5e-3;
  const double expected = (tight + 4 * low) / (1 + 2 * rho + 2 * rho * rho);
  const double if_one_holds = (tight + 2 * low) / (1 + 2 * rho);
  REQUIRE(low < rho * rho * if_one_holds);    // the joints next to the first two cannot hold,
  REQUIRE(low > rho * rho * rho * expected);  // the last two can
  CHECK(close(bench.T(2), expected, rounding));
  CHECK(close(bench.T(1), rho * expected, rounding));
  CHECK(close(bench.T(3), rho * expected, rounding));
  CHECK(close(bench.T(5), low, rounding));
}

SOLVER_TEST_CASE("without friction all sides of a dome ring have the same tension under an uneven load",
                 solver) {
  dome_ring(ring, hoop_cable(0, 1e-3), 8);
  Bench<double, Space> bench(ring, solver);
  REQUIRE(bench.started().ok());
  for (const double factor : {1.0, -0.5, 3.0}) {
    REQUIRE(bench.load(1, factor).go().ok());
    CHECK_LAWFUL(bench, double);
    for (int i = 1; i < 8; ++i) CHECK(close(bench.T(i), bench.T(0), rounding));
  }
}

SOLVER_TEST_CASE("an even load on an even dome ring moves no cable, whatever the friction", solver) {
  for (const double mu : {0.0, 0.3}) {
    dome_ring(ring, hoop_cable(mu, 1e-3), 6);
    Bench<double, Space> bench(ring, solver);
    REQUIRE(bench.started().ok());
    const double before = bench.T(0);
    REQUIRE(bench.load(0, 1).go().ok());
    CHECK_LAWFUL(bench, double);
    CHECK(bench.T(0) > 1.01 * before);
    for (int i = 0; i < 6; ++i) {
      CHECK(close(bench.T(i), bench.T(0), rounding));
      CHECK(std::fabs(bench.slip(i)) <= 1e-9 * bench.T(0) * 10 / EA);
    }
  }
}

SOLVER_TEST_CASE("a dome ring goes slack as a whole and comes back", solver) {
  dome_ring(ring, hoop_cable(0.2, 2e-4), 6);
  Bench<double, Space> bench(ring, solver);
  REQUIRE(bench.started().ok());
  const double before = bench.T(0);
  REQUIRE(bench.load(2, 3).go().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < 6; ++i) CHECK(bench.T(i) == 0);
  REQUIRE(bench.load(2, 0).go().ok());
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < 6; ++i) CHECK(close(bench.T(i), before, rounding));
}

SOLVER_TEST_CASE("a hoop with hardly any friction finds the state of its joints", solver) {
  // Of four hundred random rings one in which changing all joints that disagree at once goes round in
  // circles.
  Random random(3019);
  taut::Cable<double> cable = hoop_cable(random.between(0, 0.6), 0);
  (void)random.coin();
  cable.prestrain = random.between(2e-4, 2e-3);
  const int sides = 3 + random.below(6);
  dome_ring(ring, cable, sides, Variation(random));
  Bench<double, Space> bench(ring, solver);
  REQUIRE(bench.started().code == taut::Code::ok);
  CHECK_LAWFUL(bench, double);
}

}  // namespace hoop_test
