// Second-order theory on random cables over pinned struts: what must hold whatever the numbers are.
#include <doctest/doctest.h>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "support/random.hpp"
#include "taut/taut.hpp"

namespace second_order_random_test {

#ifndef TAUT_SECOND_ORDER_SCENES
#define TAUT_SECOND_ORDER_SCENES 400
#endif

namespace {

using taut::End;

struct Cap : taut::Capacity {
  static constexpr int nodes = 14, struts = 6, segments = 7, joints = 6, normals = 1;
};
using Scene = taut::Scene<double, 2, Cap>;
using Model = taut::SecondOrder<double, Cap>;
using Tracker = taut::Tracker<Model>;
using Sample = taut::Sample<double, Cap>;

struct Jacking {
  Scene scene;
  int segments = 0;
  std::vector<double> forces;
  bool from_start = false;
};

// A cable below struts whose heads are held; each leans from the bisector of the cable's angle by less than
// what friction holds, for otherwise there is no equilibrium at all. Turned by `angle`; mirrored, its path
// runs the other way too.
Jacking random_jacking(support::Random random, double angle, bool mirrored) {
  Jacking made;
  const int struts = 1 + random.below(6);
  const double spacing = random.between(4, 12), sag = random.between(0.03, 0.15) * spacing * (struts + 1);
  const double span = spacing * (struts + 1), force = random.between(2e5, 3e6);
  const double mu = random.between(0.02, 0.5), strain = random.between(1e-3, 4e-3);
  const auto at = [&](double x, double y) {
    if (mirrored) x = -x;
    return std::array<double, 2>{x * std::cos(angle) - y * std::sin(angle),
                                 x * std::sin(angle) + y * std::cos(angle)};
  };
  std::vector<int> path{made.scene.add_node(at(0, 0), taut::held_xy)};
  for (int i = 1; i <= struts; ++i) {
    const double x = i * spacing, y = -4 * sag * x * (span - x) / (span * span);
    // The bisector of two chords of a parabola, from their slopes.
    const double across = 4 * sag * spacing / (span * span);
    const double slope = -4 * sag * (span - 2 * x) / (span * span);
    const double turned = (std::atan(slope - across) + std::atan(slope + across)) / 2;
    const double lean = turned + std::atan(random.between(-0.6, 0.6) * mu);
    const double height = random.between(0.3, 1.5) * spacing;
    const int foot = made.scene.add_node(at(x, y));
    const int head =
        made.scene.add_node(at(x - height * std::sin(lean), y + height * std::cos(lean)), taut::held_xy);
    made.scene.add_strut(foot, head, 2.1e11, random.between(2e-3, 2e-2));
    path.push_back(foot);
  }
  path.push_back(made.scene.add_node(at(span, 0), taut::held_xy));
  taut::Cable<double> cable;
  cable.E = 1.6e11;
  cable.A = force / strain / cable.E;
  cable.mu = mu;
  made.from_start = mirrored;
  cable.ends[mirrored ? 0 : 1] = End::jacked;
  if (mirrored) path = {path.rbegin(), path.rend()};
  made.scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  made.segments = struts + 1;
  for (double part : {random.between(0.3, 1), random.between(0, 0.6), random.between(0.5, 1.1)})
    made.forces.push_back(part * force);
  return made;
}

struct Run {
  Model model;
  Model::Struts struts;
  Tracker tracker;
};

Sample pulled(const Jacking& given, double force) {
  Sample sample;
  sample.jack[0][given.from_start ? 0 : 1].force = force;
  return sample;
}

bool begin(const Jacking& given, Run& run) {
  const auto condensation = std::make_unique<taut::SecondOrderCondensation<double, Scene>>();
  if (!condensation->run(given.scene, pulled(given, given.forces[0]), run.model, run.struts)) return false;
  return run.tracker.start(run.model).status.ok();
}

// Follows the forces, each path in so many pieces; where it ends, and the force there.
double follow(const Jacking& given, Run& run, int pieces) {
  double from = 0;
  for (const double to : given.forces) {
    for (int i = 1; i <= pieces; ++i) {
      const auto progress = run.tracker.advance(pulled(given, from + (to - from) * i / pieces));
      CHECK(verify(run.tracker).worst() < 1e-9);
      if (!progress.status || progress.fraction < 1)
        return run.tracker.loads().jack[0][given.from_start ? 0 : 1].force;
    }
    from = to;
  }
  return from;
}

}  // namespace

TEST_CASE(
    "second-order theory gives random struts the same forces however a path is cut, turned and mirrored") {
  const std::uint64_t first = 20261123;
  constexpr int scenes = TAUT_SECOND_ORDER_SCENES;
  int ran = 0, ended = 0;
  for (std::uint64_t seed = first; seed < first + scenes; ++seed) {
    INFO("seed ", seed);
    const Jacking plain = random_jacking(support::Random(seed), 0, false);
    const auto one = std::make_unique<Run>();
    if (!begin(plain, *one)) continue;
    ++ran;
    const double end = follow(plain, *one, 1);
    ended += end == plain.forces.back() ? 0 : 1;
    const double most = one->tracker.peak();
    struct Other {
      double angle;
      bool mirrored;
      int pieces;
    };
    for (const Other& each : {Other{0, false, 7}, Other{0.7, false, 1}, Other{0, true, 1}}) {
      const Jacking other = random_jacking(support::Random(seed), each.angle, each.mirrored);
      const auto run = std::make_unique<Run>();
      REQUIRE(begin(other, *run));
      const double other_end = follow(other, *run, each.pieces);
      CHECK(std::fabs(other_end - end) <= 1e-6 * most);
      for (int i = 0; i < plain.segments; ++i) {
        const int same = each.mirrored ? plain.segments - 1 - i : i;
        CHECK(std::fabs(run->tracker.tension(same) - one->tracker.tension(i)) <= 1e-6 * most);
      }
    }
  }
  MESSAGE(ran, " of ", scenes, " scenes from seed ", first, ", ", ended, " of them until a strut ran away");
  CHECK(ran == scenes);
}

}  // namespace second_order_random_test
