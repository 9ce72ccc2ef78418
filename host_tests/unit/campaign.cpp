// Random scenes and load histories: every answer obeys all laws, whatever the scene.
#include <string>

#include "support/bench.hpp"

namespace campaign_test {
using namespace support;
using taut::Code;

namespace {

constexpr int repetitions = 50;  // of every kind of scene; with sanitizers about ten seconds in all

/// A force history: up, down, up again, and to rest.
struct Row {
  double load, other_load, jack;
};
constexpr Row history[] = {{0, 0, 2e5},   {1, 0, 2e5},      {1, 0, 1e5},      {1, 0.4, 2.6e5},
                           {0.3, 1, 2e5}, {-0.3, 0.5, 3e4}, {0.5, -0.5, 3e5}, {0, 0, 0}};

taut::Cable<double> random_cable(Random& random, std::array<taut::End, 2> ends) {
  taut::Cable<double> cable = steel_cable(random.between(0, 0.6), ends);
  cable.law = random.coin() ? taut::FrictionLaw::point : taut::FrictionLaw::capstan;
  if (cable.law == taut::FrictionLaw::capstan) cable.wobble = random.between(0, 0.02);
  return cable;
}

/// Follows the history in both scalar types and checks every answer.
template <class Scalar, class SceneType>
void follow_history(const SceneType& scene, Solver solver, int jacked_end_index) {
  Bench<Scalar, SceneType> bench(scene, solver);
  CAPTURE(std::string(sizeof(Scalar) == sizeof(float) ? "float" : "double"));
  REQUIRE(bench.started().code == Code::ok);
  CHECK_LAWFUL(bench, Scalar);
  for (const Row& row : history) {
    CAPTURE(row.load);
    CAPTURE(row.other_load);
    CAPTURE(row.jack);
    bench.load(0, row.load).load(1, row.other_load);
    if (jacked_end_index >= 0) bench.jack(0, jacked_end_index, row.jack);
    REQUIRE(bench.go().code == Code::ok);
    CHECK_LAWFUL(bench, Scalar);
  }
}

template <class SceneType>
void follow_in_both(const SceneType& scene, Solver solver, int jacked_end_index) {
  follow_history<double>(scene, solver, jacked_end_index);
  follow_history<float>(scene, solver, jacked_end_index);
}

Plane plane;
Space space;

}  // namespace

SOLVER_TEST_CASE("a plane truss string structure jacked from one end obeys all laws at every load", solver) {
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int end = random.below(2);
    truss_string(plane, random_cable(random, end == 0 ? jacked_start : jacked_end), 3 + random.below(6),
                 Variation(random));
    follow_in_both(plane, solver, end);
  }
}

SOLVER_TEST_CASE(
    "a prestrained cable of a plane truss string structure obeys all laws when the loads turn round",
    solver) {
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    CAPTURE(seed);
    Random random(1000 + seed);
    taut::Cable<double> cable = random_cable(random, anchored);
    cable.prestrain = random.between(0, 2e-3);
    truss_string(plane, cable, 3 + random.below(6), Variation(random));
    follow_in_both(plane, solver, -1);
  }
}

SOLVER_TEST_CASE("a spatial truss string structure jacked from one end obeys all laws at every load",
                 solver) {
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    CAPTURE(seed);
    Random random(2000 + seed);
    const int end = random.below(2);
    space_truss_string(space, random_cable(random, end == 0 ? jacked_start : jacked_end), 2 + random.below(4),
                       Variation(random));
    follow_in_both(space, solver, end);
  }
}

SOLVER_TEST_CASE("a prestrained hoop of a suspen-dome obeys all laws under even and uneven loads", solver) {
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    CAPTURE(seed);
    Random random(3000 + seed);
    taut::Cable<double> cable = random_cable(random, anchored);
    cable.prestrain = random.between(2e-4, 2e-3);
    dome_ring(space, cable, 3 + random.below(6), Variation(random));
    follow_in_both(space, solver, -1);
  }
}

SOLVER_TEST_CASE("a chain on rigid saddles obeys all laws at every jack force", solver) {
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    CAPTURE(seed);
    Random random(4000 + seed);
    const int end = random.below(2);
    rigid_saddles(plane, random_cable(random, end == 0 ? jacked_start : jacked_end),
                  chain_points(1 + random.below(8)));
    vary_friction(plane, Variation(random));
    plane.add_load();
    plane.add_load();
    follow_in_both(plane, solver, end);
  }
}

// Of stepwise alone: the tracker knows no load steps.
TEST_CASE("sixty-four load steps come closer to a thousand than four do") {
  double off_4 = 0, off_64 = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(5000 + seed);
    truss_string(plane, steel_cable(0.1 * static_cast<double>(seed)), 8, Variation(random));
    const auto tensions = [](int substeps) {
      Bench<double, Plane> bench(plane, Solver::stepwise);
      REQUIRE(bench.started().ok());
      for (const Row& row : {Row{0, 0, 2e5}, {3, 0, 2.2e5}, {-1, 0, 1e5}, {2, 0, 3e5}}) {
        bench.load(0, row.load).jack(0, 1, row.jack);
        REQUIRE(bench.go(substeps).code == Code::ok);
      }
      return bench.response().tension;
    };
    const auto fine = tensions(1024), medium = tensions(64), coarse = tensions(4);
    for (int i = 0; i < plane.prestrain.size(); ++i) {
      off_64 += std::fabs(medium[i] - fine[i]);
      off_4 += std::fabs(coarse[i] - fine[i]);
    }
  }
  CHECK(off_4 > 0);
  CHECK(off_64 < off_4 / 4);  // of first order it would be a sixteenth
}

}  // namespace campaign_test
