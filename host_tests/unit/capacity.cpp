// What a capacity says that no scene has: left out of the code it changes no bit, and a scene that has it is
// refused.
#include <doctest/doctest.h>

#include <cstdint>

#include "taut/taut.hpp"

namespace capacity_test {
namespace {

constexpr int joints = 6;

struct Whole : taut::Capacity {
  static constexpr int nodes = 2 * joints + 3, struts = 2 * joints, cables = 1, segments = joints + 1;
  static constexpr int loads = 1, temperatures = 1;
  static constexpr int joints = capacity_test::joints, jacks = 1;
};
struct Rigid : Whole {
  static constexpr int struts = 0;
};
template <class Cap>
struct Without : Cap {
  static constexpr int spans = 1;
  static constexpr bool hoops = false, prestrain = false, smooth = false;
};

// A cable over a parabola, on saddles or on pairs of struts.
template <class Cap>
taut::Scene<double, 2, Cap> scene(double mu, double prestrain = 0) {
  taut::Scene<double, 2, Cap> made;
  int path[joints + 2];
  constexpr bool is_rigid = Cap::struts == 0;
  for (int i = 0; i <= joints + 1; ++i) {
    const double t = 2.0 * i / (joints + 1) - 1;
    const bool is_end = i == 0 || i == joints + 1;
    path[i] = made.add_node({double(i), 0.25 * joints * t * t},
                            is_rigid || is_end ? taut::held_x | taut::held_y : taut::held_none);
  }
  for (int i = 0; !is_rigid && i <= joints; ++i) {
    const int ground = made.add_node({i + 0.5, -3.0}, taut::held_x | taut::held_y);
    if (i > 0) made.add_strut(path[i], ground, 2.1e11, 1e-3);
    if (i < joints) made.add_strut(path[i + 1], ground, 2.1e11, 1e-3);
  }
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 1e-3;
  cable.alpha = 1.2e-5;
  cable.mu = mu;
  cable.prestrain = prestrain;
  cable.seating = 0.002;
  cable.ends = {taut::End::anchored, taut::End::jacked};
  made.add_cable(cable, path);
  made.add_temperature(made.add_load(), 0, 20);
  return made;
}

// From 0 to 1, the same everywhere.
struct Random {
  std::uint32_t seed;
  double next() {
    seed = seed * 1664525U + 1013904223U;
    return static_cast<double>(seed >> 8) / 16777216.0;
  }
};

template <class Cap>
struct Follower {
  using SceneType = taut::Scene<double, 2, Cap>;
  taut::Condensed<float, Cap> condensed;
  taut::Tracker<taut::Condensed<float, Cap>, 1> tracker;
  taut::Sample<float, Cap> sample;

  static taut::JointFriction<double> friction(const taut::Condensed<float, Cap>& model, int j) {
    taut::JointFriction<double> given;
    given.rho = model.rho[j];
    given.slope = -0.3;
    given.parameter = 0;
    return given;
  }
  bool start() {
    taut::Condensation<float, SceneType> condensation;
    if (!condensation.run(scene<Cap>(0.2), condensed)) return false;
    return tracker.start(condensed, [this](int j) { return friction(condensed, j); }).status.ok();
  }
};

template <class Cap>
void check_bits() {
  static Follower<Cap> whole;
  static Follower<Without<Cap>> less;
  static_assert(sizeof less.tracker < sizeof whole.tracker);
  REQUIRE(whole.start());
  REQUIRE(less.start());
  Random random{4711};
  int events = 0;
  for (int row = 0; row < 2000; ++row) {
    CAPTURE(row);
    // It pulls, lets go altogether, is locked and put back on; some rows with another temperature.
    const double kind = random.next();
    const float force = kind < 0.1 ? 0.0F : static_cast<float>(3e5 * random.next());
    const bool locked = kind > 0.9;
    const float factor =
        kind > 0.5 && kind < 0.6 ? static_cast<float>(2 * random.next() - 1) : whole.sample.factor[0];
    whole.sample.jack[0][1] = less.sample.jack[0][1] = {force, locked};
    whole.sample.factor[0] = less.sample.factor[0] = factor;
    const auto here = whole.tracker.advance(whole.sample), there = less.tracker.advance(less.sample);
    REQUIRE(here.status.code == there.status.code);
    REQUIRE(here.events == there.events);
    events += here.events;
    for (int i = 0; i <= joints; ++i) {
      REQUIRE(whole.tracker.tension(i) == less.tracker.tension(i));
      REQUIRE(whole.tracker.sensitivity(0, i) == less.tracker.sensitivity(0, i));
    }
    const auto moved = whole.tracker.slip_state();
    const auto other = less.tracker.slip_state();
    REQUIRE(moved.slip == other.slip);
    REQUIRE(moved.extension[0] == other.extension[0]);
    REQUIRE(moved.slack_length[0] == other.slack_length[0]);
    if (row % 7 == 0) {
      const auto friction = [](int j) { return Follower<Without<Cap>>::friction(less.condensed, j); };
      REQUIRE(less.tracker.restore(less.condensed, friction, less.tracker.save()).ok());
    }
  }
  CHECK(events > 2000);
}

template <class Cap>
taut::Code condensing(double mu, double prestrain) {
  static taut::Condensed<float, Cap> condensed;
  taut::Condensation<float, taut::Scene<double, 2, Cap>> condensation;
  return condensation.run(scene<Cap>(mu, prestrain), condensed).code;
}

struct NoHoop : taut::Capacity {
  static constexpr int nodes = 3, segments = 3, joints = 3;
  static constexpr bool hoops = false;
};

}  // namespace

TEST_CASE("what no scene has is left out without another bit") {
  check_bits<Rigid>();
  check_bits<Whole>();
}

TEST_CASE("a scene that has what its capacity says none has is refused") {
  using Cap = Without<Rigid>;
  CHECK(condensing<Cap>(0.2, 0) == taut::Code::ok);
  CHECK(condensing<Cap>(0.2, 1e-4) == taut::Code::capacity_exceeded);  // prestrain
  CHECK(condensing<Cap>(0, 0) == taut::Code::capacity_exceeded);       // joints without friction
  CHECK(condensing<Cap>(50, 0) == taut::Code::capacity_exceeded);  // seven spans between self-locking joints
  CHECK(condensing<Rigid>(50, 1e-4) == taut::Code::ok);
}

TEST_CASE("a hoop is refused where there is none") {
  taut::Scene<double, 2, NoHoop> made;
  int path[3];
  const double at[][2] = {{0, 0}, {1, 0}, {0, 1}};
  for (int i = 0; i < 3; ++i) path[i] = made.add_node({at[i][0], at[i][1]}, taut::held_x | taut::held_y);
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 1e-3;
  cable.mu = 0.1;
  cable.closed = true;
  made.add_cable(cable, path);
  static taut::Condensed<double, NoHoop> condensed;
  taut::Condensation<double, taut::Scene<double, 2, NoHoop>> condensation;
  CHECK(condensation.run(made, condensed).code == taut::Code::capacity_exceeded);
}

}  // namespace capacity_test
