// A scene that is itself in single precision.
#include <memory>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace single_scene_test {
using namespace support;

namespace {

using Single = taut::Scene<float, 2, PlaneCapacity>;

}  // namespace

TEST_CASE("a scene in single precision is solved like the same numbers in double") {
  static Single single;
  static Plane rounded;
  single = {};
  rounded = {};
  const float x[] = {0, 3, 5, 9}, y[] = {0, -1, -0.5f, 0.25f};
  std::vector<int> path;
  for (int i = 0; i < 4; ++i) {
    path.push_back(single.add_node({x[i], y[i]}, taut::held_xy));
    rounded.add_node({double(x[i]), double(y[i])}, taut::held_xy);
  }
  taut::Cable<float> cable;
  cable.E = 2e11f;
  cable.A = 1e-3f;
  cable.mu = 0.25f;
  cable.ends = jacked_end;
  single.add_cable(cable, path.data(), 4);
  taut::Cable<double> same = steel_cable(0.25);
  same.E = double(cable.E);
  same.A = double(cable.A);
  rounded.add_cable(same, path.data(), 4);
  const auto solver = std::make_unique<taut::Stepwise<float, Single>>();
  Bench<double, Plane> bench(rounded, Solver::stepwise);
  taut::Sample<float, PlaneCapacity> sample;
  sample.jack[0][1].force = 1e5f;
  REQUIRE(solver->start(single).ok());
  REQUIRE(solver->advance(sample).ok());
  REQUIRE(bench.jack(0, 1, 1e5).go().ok());
  for (int i = 0; i < 3; ++i) CHECK(close(double(solver->response().tension[i]), bench.T(i), 1e-5));
}

}  // namespace single_scene_test
