// Lock-off with wedge draw-in, re-jacking and temperature on rigid saddles, against hand calculations.
#include <algorithm>
#include <limits>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace lock_off_test {
using namespace support;
using hand::Chain;
using hand::EA;

namespace {

constexpr double F = 2e5;           // [N]
constexpr double rounding = 1e-11;  // the draw-in is a small difference of elongations
using PlaneBench = Bench<double, Plane>;
Plane scene;

void make(const Chain& chain, double seating, double expansion = 0) {
  taut::Cable<double> cable = steel_cable(chain.mu);
  cable.seating = seating;
  cable.alpha = expansion;
  rigid_saddles(scene, cable, chain_points(chain.segments));
}

/// The force at the end of a chain that was pulled with F and then drew in by `seating`: the tensions fall to
/// X / reach in the segments from the first one affected to the end, and the shortening of these is the
/// draw-in. Searched from the end inwards for the first one that fits.
double force_after_draw_in(const Chain& chain, double seating) {
  double lost = -EA * seating, softness = 0, X = 0;
  for (int first = chain.segments - 1; first >= 0; --first) {
    lost += F * chain.reach(first) * chain.length(first);
    softness += chain.length(first) / chain.reach(first);
    X = lost / softness;
    const bool next_is_untouched = first == 0 || F * chain.reach(first - 1) <= X / chain.reach(first - 1);
    if (next_is_untouched) break;
  }
  return X;
}

template <class Expected>
void check_tensions(const PlaneBench& bench, const Expected& expected) {
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < scene.prestrain.size(); ++i) {
    CAPTURE(i);
    CHECK(close(bench.T(i), expected(i), rounding, bench.largest_force()));
  }
}

/// Pulled with F and locked.
void pull_and_lock(PlaneBench& bench) {
  REQUIRE(bench.jack(0, 1, F).go().ok());
  REQUIRE(bench.lock(0, 1).go().ok());
}

}  // namespace

SOLVER_TEST_CASE("locking without draw-in changes nothing", solver) {
  const Chain chain{6, 0.3};
  make(chain, 0);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  check_tensions(bench, [&](int i) { return F * chain.reach(i); });
}

SOLVER_TEST_CASE("without friction the draw-in costs EA / L x seating everywhere", solver) {
  const Chain chain{6, 0};
  make(chain, 6e-3);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  check_tensions(bench, [&](int) { return F - EA / chain.total_length() * 6e-3; });
}

SOLVER_TEST_CASE("with friction the draw-in is felt as far as the change of friction carries it", solver) {
  const Chain chain{8, 0.3};
  bool partly = false, wholly = false;
  for (const double seating : {0.2e-3, 1e-3, 4e-3, 25e-3}) {
    CAPTURE(seating);
    make(chain, seating);
    PlaneBench bench(scene, solver);
    pull_and_lock(bench);
    const double X = force_after_draw_in(chain, seating);
    check_tensions(bench, [&](int i) { return std::min(F * chain.reach(i), X / chain.reach(i)); });
    (bench.T(0) == doctest::Approx(F * chain.reach(0)) ? partly : wholly) = true;
  }
  CHECK(partly);  // both kinds occurred
  CHECK(wholly);
}

SOLVER_TEST_CASE("a locked end keeps its extension less the draw-in", solver) {
  make({6, 0.3}, 3e-3);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  const double drawn = bench.extension(0, 1);
  REQUIRE(bench.lock(0, 1).go().ok());
  CHECK(close(bench.extension(0, 1), drawn - 3e-3, rounding));
  REQUIRE(bench.go().ok());
  CHECK(close(bench.extension(0, 1), drawn - 3e-3, rounding));  // drawn in once only
}

SOLVER_TEST_CASE("a draw-in longer than the elongation leaves the cable slack", solver) {
  const Chain chain{4, 0.2};
  make(chain, 0.1);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  check_tensions(bench, [](int) { return 0.0; });
  for (int j = 0; j < 3; ++j) CHECK(bench.response().state[j] == taut::JointState::open);
}

SOLVER_TEST_CASE(
    "an end that is locked before there is any load leaves the cable slack, and is pulled from the other",
    solver) {
  const Chain chain{4, 0.2};
  auto cable = steel_cable(chain.mu, two_jacks);
  cable.seating = 5e-3;
  rigid_saddles(scene, cable, chain_points(chain.segments));
  PlaneBench bench(scene, solver);
  REQUIRE(bench.lock(0, 0).jack(0, 1, 0).go().ok());
  check_tensions(bench, [](int) { return 0.0; });
  REQUIRE(bench.go().ok());
  REQUIRE(bench.jack(0, 1, F).go().ok());
  check_tensions(bench, [&](int i) { return F * chain.reach(i); });
}

SOLVER_TEST_CASE("a draw-in in many steps is the draw-in in one", solver) {
  make({7, 0.25}, 4e-3);
  PlaneBench at_once(scene, solver), in_steps(scene, solver);
  pull_and_lock(at_once);
  REQUIRE(in_steps.jack(0, 1, F).go().ok());
  REQUIRE(in_steps.lock(0, 1).go(16).ok());
  for (int i = 0; i < 7; ++i) CHECK(close(in_steps.T(i), at_once.T(i), rounding, F));
}

SOLVER_TEST_CASE("what the load cell of a locked end says is of no account", solver) {
  const Chain chain{5, 0.3};
  make(chain, 0);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  for (const double reading : {0.0, -5.0, 9 * F, std::numeric_limits<double>::quiet_NaN()}) {
    REQUIRE(bench.jack(0, 1, reading).lock(0, 1).go().ok());
    check_tensions(bench, [&](int i) { return F * chain.reach(i); });
  }
}

SOLVER_TEST_CASE("a jack set on again lifts the end off at the force that was left there", solver) {
  const Chain chain{7, 0.3};
  const double seating = 3e-3;
  make(chain, seating);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  const double X = force_after_draw_in(chain, seating), extension = bench.extension(0, 1);
  REQUIRE(bench.jack(0, 1, X).go().ok());
  CHECK(close(bench.extension(0, 1), extension, 1e-10));
  for (const double force : {1.02 * X, F, 1.2 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [&](int i) {
      const double left = std::min(F * chain.reach(i), X / chain.reach(i));
      return std::max(left, force * chain.reach(i));
    });
  }
}

SOLVER_TEST_CASE("every lock-off draws in anew", solver) {
  const Chain chain{5, 0};
  make(chain, 2e-3);
  PlaneBench bench(scene, solver);
  for (int stage = 0; stage < 3; ++stage) {
    pull_and_lock(bench);
    check_tensions(bench, [&](int) { return F - EA / chain.total_length() * 2e-3; });
  }
}

SOLVER_TEST_CASE("a cable of one segment loses EA / L x seating at lock-off", solver) {
  make({1, 0}, 1e-3);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  check_tensions(bench, [](int) { return F - EA / chain_length(0) * 1e-3; });
}

SOLVER_TEST_CASE("a locked cable that is warmed loses EA alpha dT and gets it back", solver) {
  const Chain chain{5, 0};
  const double expansion = 1.2e-5;
  make(chain, 0, expansion);
  scene.add_temperature(scene.add_load(), 0, 10);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  for (const double factor : {1.0, 3.0, -2.0, 0.0}) {
    REQUIRE(bench.load(0, factor).go().ok());
    check_tensions(bench, [&](int) { return F - EA * expansion * 10 * factor; });
  }
}

SOLVER_TEST_CASE("a cable that is warmed under a jack keeps its force and is drawn out by alpha dT L",
                 solver) {
  const Chain chain{5, 0};
  make(chain, 0, 1.2e-5);
  scene.add_temperature(scene.add_load(), 0, 10);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  const double before = bench.extension(0, 1);
  REQUIRE(bench.load(0, 1).go().ok());
  check_tensions(bench, [](int) { return F; });
  CHECK(close(bench.extension(0, 1) - before, 1.2e-5 * 10 * chain.total_length(), 1e-9));
}

SOLVER_TEST_CASE(
    "cooling a locked cable adds the same force everywhere, for that brings no joint to its limit", solver) {
  const Chain chain{6, 0.3};
  make(chain, 0, 1.2e-5);
  scene.add_temperature(scene.add_load(), 0, 10);
  PlaneBench bench(scene, solver);
  pull_and_lock(bench);
  REQUIRE(bench.load(0, -1).go().ok());
  check_tensions(bench, [&](int i) { return F * chain.reach(i) + EA * 1.2e-5 * 10; });
}

}  // namespace lock_off_test
