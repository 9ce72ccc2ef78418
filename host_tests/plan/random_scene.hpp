// Random scenes with one jack or two, and goals for them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/plan/goal.hpp"

namespace plan_test {

/// SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return low + (high - low) * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  int whole(int low, int high) { return low + static_cast<int>(between(0, high - low + 1)); }

 private:
  std::uint64_t state_;
};

enum class SceneKind { saddles, truss, second_order };
inline const char* name_of(SceneKind kind) {
  return kind == SceneKind::saddles ? "saddles" : kind == SceneKind::truss ? "truss" : "second order";
}

struct Site {
  taut::host::SceneDescription scene;
  taut::host::PlanGoal goal;
};

/// A cable over 3 to 15 joints: over saddles on rocks, or under a truss whose chord carries a load, in linear
/// or second-order theory. Targets are the same for all segments, or each its own, some without any.
inline Site random_site(Random& random, SceneKind kind, bool two_jacks) {
  using namespace taut;
  using namespace taut::host;
  Site site;
  SceneDescription& scene = site.scene;
  scene.file = "random.json";
  scene.name = name_of(kind);
  const int joints = random.whole(3, 15);
  const double pitch = random.between(3, 8), sag = random.between(0.02, 0.15) * pitch * (joints + 1);
  const bool held = kind == SceneKind::saddles;
  CableDescription cable;
  cable.name = "C";
  cable.E = 1.95e11;
  cable.A = random.between(5e-4, 4e-3);
  cable.ends = {two_jacks ? End::jacked : End::anchored, End::jacked};
  cable.cell.fill({});
  const auto node = [&](double x, double y, unsigned support) {
    scene.nodes.push_back(
        {"n" + std::to_string(scene.nodes.size()), {x, y, 0}, static_cast<std::uint8_t>(support)});
    return static_cast<int>(scene.nodes.size()) - 1;
  };
  const double pi = std::acos(-1.0);
  std::vector<int> below, above;
  for (int i = 0; i <= joints + 1; ++i) {
    const double at = pi * i / (joints + 1), x = pitch * i;
    const bool end = i == 0 || i == joints + 1;
    const double y = end ? 0 : -sag * std::sin(at) * random.between(0.9, 1.1);
    below.push_back(node(x, y,
                         held     ? held_x | held_y
                         : !end   ? held_none
                         : i == 0 ? held_x | held_y
                                  : held_y));
    if (!held && !end) above.push_back(node(x, random.between(0.3, 0.6) * pitch, held_none));
  }
  cable.path = below;
  const bool point = random.between(0, 1) < 0.5;
  cable.law = point ? FrictionLaw::point : FrictionLaw::capstan;
  const double mu = random.between(0.05, 0.3);
  for (int j = 0; j < joints; ++j) cable.mu.push_back(mu * random.between(0.8, 1.2));
  cable.mu_is_list = true;
  if (!point) cable.wobble = random.between(0, 0.004);
  cable.prestrain.assign(cable.segments(), 0);
  cable.force.assign(cable.segments(), {});
  scene.cables.push_back(cable);
  if (!held) {
    above.insert(above.begin(), below.front());
    above.push_back(below.back());
    const double A = random.between(3e-3, 1e-2);
    for (std::size_t i = 0; i + 1 < above.size(); ++i)
      scene.struts.push_back({{above[i], above[i + 1]}, 2.1e11, 2 * A, {}});
    for (std::size_t i = 1; i + 1 < above.size(); ++i)
      for (const std::size_t k : {i - 1, i, i + 1})
        scene.struts.push_back({{above[k], below[i]}, 2.1e11, A, {}});
    LoadDescription load;
    load.name = "dead";
    for (std::size_t i = 1; i + 1 < above.size(); ++i)
      load.forces.push_back({above[i], {0, -random.between(0, 4e4), 0}});
    scene.loads.push_back(load);
  }
  PlanGoal& goal = site.goal;
  goal.file = "random goal";
  const double target = random.between(2e8, 8e8) * cable.A;
  const bool alike = random.between(0, 1) < 0.7;
  for (std::size_t i = 0; i < cable.segments(); ++i) {
    const bool matters = alike || random.between(0, 1) < 0.8 || i == 0;
    goal.target.push_back(matters ? alike ? target : target * random.between(0.9, 1.1) : 0);
  }
  goal.factor.assign(scene.loads.size(), 1);
  goal.most_segment.assign(cable.segments(), no_limit);
  goal.most_force.assign(1, {no_limit, no_limit});
  goal.most_stroke = goal.most_force;
  goal.stages = 2;
  goal.has_stages = true;
  if (kind == SceneKind::second_order) {
    TargetDescription at;
    at.factor.assign(1, 1);
    at.force.assign(1, {two_jacks ? target : 0, target});
    scene.second_order = at;
  }
  return site;
}

}  // namespace plan_test
