// Random scenes and logs, the same for the same seed on every machine.
#pragma once

#include <string>
#include <vector>

#include "support/saddles.hpp"
#include "support/scenes.hpp"
#include "taut/scene/sample.hpp"

namespace campaign {

using support::Saddles;

/// A scene of one type with its log.
template <class SceneType>
struct World {
  SceneType scene;
  std::vector<taut::Sample<double, typename SceneType::Capacity>> samples;
  std::string kind;
};

enum class Kind { string_one_jack, string_two_jacks, string_prestrained, hoop, coupled, saddles, count };

inline taut::Cable<double> random_cable(support::Random& random, std::array<taut::End, 2> ends) {
  taut::Cable<double> cable = support::steel_cable(random.between(0, 0.6), ends);
  cable.alpha = 1.2e-5;
  if (random.coin()) cable.law = taut::FrictionLaw::capstan;
  if (cable.law == taut::FrictionLaw::capstan) cable.wobble = random.between(0, 0.02);
  if (random.coin()) cable.seating = random.between(0, 8e-3);
  return cable;
}

/// A number that is often one of the awkward ones.
inline double random_factor(support::Random& random, double low, double high) {
  const int special = random.below(8);
  if (special == 0) return 0;
  if (special == 1) return high;
  return random.between(low, high);
}

/// Loads wander; jacks pull, hold and release, and are locked now and then.
template <class SceneType>
void random_log(World<SceneType>& world, support::Random& random) {
  const auto& scene = world.scene;
  const double even = random.between(0.85, 1);
  taut::Sample<double, typename SceneType::Capacity> sample;
  const int rows = 4 + random.below(8);
  for (int row = 0; row < rows; ++row) {
    for (int load = 0; load < scene.loads; ++load)
      if (random.coin()) sample.factor[load] = random_factor(random, -1, 2);
    for (int c = 0; c < scene.cables.size(); ++c) {
      const auto& cable = scene.cables[c];
      if (cable.closed) continue;
      const double force = random_factor(random, 0, 3e5);
      const bool both = cable.ends[0] == taut::End::jacked && cable.ends[1] == taut::End::jacked;
      const bool hold = random.below(3) == 0;
      for (std::size_t end = 0; end < 2; ++end) {
        if (cable.ends[end] != taut::End::jacked) continue;
        auto& jack = sample.jack[c][end];
        if (!hold) jack.force = both ? force * random.between(even, 1) : force;
        if (random.below(6) == 0) jack.locked = !jack.locked;
      }
    }
    world.samples.push_back(sample);
  }
}

inline void make_string(World<support::Plane>& world, support::Random& random, Kind kind) {
  using namespace support;
  const auto ends = kind == Kind::string_one_jack    ? (random.coin() ? jacked_end : jacked_start)
                    : kind == Kind::string_two_jacks ? two_jacks
                                                     : anchored;
  taut::Cable<double> cable = random_cable(random, ends);
  if (kind == Kind::string_prestrained) cable.prestrain = random.between(0, 2e-3);
  // One scene in eight is symmetric to the last digit.
  const Variation vary = random.below(8) == 0 ? Variation() : Variation(random);
  truss_string(world.scene, cable, 3 + random.below(5), vary);
  if (random.below(6) == 0 && world.scene.mu.size() > 1)
    world.scene.mu[random.below(world.scene.mu.size())] = 50;
  if (random.coin()) world.scene.add_temperature(world.scene.add_load(), 0, 30);
}

inline void make_hoop(World<support::Space>& world, support::Random& random) {
  taut::Cable<double> cable = random_cable(random, support::anchored);
  cable.mu *= 0.5;
  cable.prestrain = random.between(0, 2e-3);
  support::dome_ring(world.scene, cable, 3 + random.below(5),
                     random.below(8) == 0 ? support::Variation() : support::Variation(random));
}

/// A second cable over the lower nodes of the truss string structure, the other way round.
inline void make_coupled(World<support::Plane>& world, support::Random& random) {
  using namespace support;
  make_string(world, random, Kind::string_one_jack);
  while (world.scene.prestrain.size() > 5) {
    world = {};
    make_string(world, random, Kind::string_one_jack);
  }
  const auto& first = world.scene.cables[0];
  std::vector<int> path;
  for (int i = first.nodes - 1; i >= 0; --i) path.push_back(world.scene.path[first.first_path + i]);
  taut::Cable<double> cable = random_cable(random, random.coin() ? jacked_end : anchored);
  cable.prestrain = random.coin() ? random.between(0, 1e-3) : 0;
  world.scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
}

inline void make_saddles(World<Saddles>& world, support::Random& random) {
  using namespace support;
  const std::array<std::array<taut::End, 2>, 4> all = {anchored, jacked_end, jacked_start, two_jacks};
  taut::Cable<double> cable = random_cable(random, all[static_cast<std::size_t>(random.below(4))]);
  cable.mu *= 0.5;
  if (random.coin()) cable.prestrain = random.between(0, 1e-3);
  const int segments = 1 + random.below(8);
  std::vector<int> path;
  double x = 0, y = 0, angle = 0;
  for (int i = 0; i <= segments; ++i) {
    path.push_back(world.scene.add_node({x, y}, taut::held_xy));
    const double length = random.between(1, 20);
    x += length * std::cos(angle);
    y += length * std::sin(angle);
    angle += random.between(-0.8, 0.8);
  }
  world.scene.add_cable(cable, path.data(), segments + 1);
  for (double& mu : world.scene.mu) mu *= random.between(0.3, 1.5);
  for (double& prestrain : world.scene.prestrain) prestrain *= random.between(0.8, 1.2);
  world.scene.add_temperature(world.scene.add_load(), 0, 30);
}

/// Makes the world of a seed and hands it to visit().
template <class Visit>
void visit_world(std::uint64_t seed, Visit visit) {
  support::Random random(seed);
  const Kind kind = static_cast<Kind>(random.below(static_cast<int>(Kind::count)));
  const auto hand_over = [&](auto& world, const char* name) {
    world.kind = name;
    random_log(world, random);
    visit(world, random);
  };
  if (kind == Kind::hoop) {
    World<support::Space> world;
    make_hoop(world, random);
    hand_over(world, "hoop");
  } else if (kind == Kind::saddles) {
    World<Saddles> world;
    make_saddles(world, random);
    hand_over(world, "saddles");
  } else if (kind == Kind::coupled) {
    World<support::Plane> world;
    make_coupled(world, random);
    hand_over(world, "coupled");
  } else {
    World<support::Plane> world;
    make_string(world, random, kind);
    hand_over(world, kind == Kind::string_one_jack    ? "string, one jack"
                     : kind == Kind::string_two_jacks ? "string, two jacks"
                                                      : "string, prestrained");
  }
}

}  // namespace campaign
