// Random sites: a scene as the drawings say, what it is like in reality, and the way it is jacked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "estimation_site/deed.hpp"
#include "reference/structure.hpp"
#include "support/random.hpp"

namespace estimation_site {

using support::gaussian;
using support::Random;

/// Evenly distributed in its logarithm.
inline double log_between(Random& random, double low, double high) {
  return low * std::exp(random.between(0, std::log(high / low)));
}

struct Bar {
  int from, to;
  double A;
};

/// The scene as the drawings say. One cable, jacked at its end or at both.
struct Ground {
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::uint8_t> held;
  std::vector<Bar> struts;
  std::vector<int> path;
  std::vector<int> loaded;  ///< nodes that the pattern `dead` pushes down
  double strut_E = 2.1e11, E = 1.95e11, A = 8e-4, alpha = 1.2e-5;
  bool capstan = false, shared = true, two_jacks = false;
  double mu = 0.1, mu_sd = 0.03, seating = 0;
  double full = 0;  ///< the jack force aimed at [N]
  double dead = 0;  ///< on every loaded node at factor 1 [N]

  int joints() const { return static_cast<int>(path.size()) - 2; }
  int segments() const { return static_cast<int>(path.size()) - 1; }
  double length() const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const auto& a = at(i);
      const auto& b = at(i + 1);
      sum += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    return sum;
  }
  /// The angle by which the cable turns at joint j (from 0) [rad].
  double turning(int j) const {
    const auto i = static_cast<std::size_t>(j);
    const auto &a = at(i), &b = at(i + 1), &c = at(i + 2);
    const double first = std::atan2(b[1] - a[1], b[0] - a[0]), second = std::atan2(c[1] - b[1], c[0] - b[0]);
    return std::fabs(std::remainder(second - first, 2 * support::pi));
  }

 private:
  const std::array<double, 2>& at(std::size_t i) const { return nodes[static_cast<std::size_t>(path[i])]; }
};

/// What nobody on the site knows.
struct Reality {
  std::vector<double> mu;  ///< of every joint
  double stiffness = 1;    ///< true E A over the one of the drawings
  double seating = 0;      ///< true wedge draw-in [m]
};

/// A girder on two supports with a cable below it on V-struts.
inline Ground random_truss(Random& random, int joints) {
  Ground ground;
  const int panels = joints + 1;
  const double panel = random.between(2.5, 5), span = panel * panels, sag = span * random.between(0.05, 0.12),
               depth = panel * random.between(0.4, 0.8), area = 6e-3;
  const auto add = [&](double x, double y, int held) {
    ground.nodes.push_back({x, y});
    ground.held.push_back(static_cast<std::uint8_t>(held));
    return static_cast<int>(ground.nodes.size()) - 1;
  };
  std::vector<int> bottom, top;
  for (int i = 0; i <= panels; ++i) {
    const int held = i == 0 ? taut::held_xy : i == panels ? taut::held_y : taut::held_none;
    bottom.push_back(add(panel * i, 0, held));
    top.push_back(add(panel * i, depth, taut::held_none));
  }
  const auto strut = [&](int a, int b) { ground.struts.push_back({a, b, area * random.between(0.6, 1.6)}); };
  ground.path.push_back(bottom.front());
  for (std::size_t i = 0; i + 1 < bottom.size(); ++i) {
    strut(bottom[i], bottom[i + 1]);
    strut(top[i], top[i + 1]);
    strut(bottom[i], top[i + 1]);
    strut(bottom[i], top[i]);
    if (i == 0) continue;
    const double t = 2.0 * static_cast<double>(i) / panels - 1;
    ground.path.push_back(add(panel * static_cast<double>(i) + panel * random.between(-0.05, 0.05),
                              -sag * (1 - t * t) * random.between(0.98, 1.02), taut::held_none));
    strut(bottom[i - 1], ground.path.back());
    strut(bottom[i + 1], ground.path.back());
  }
  strut(bottom.back(), top.back());
  ground.path.push_back(bottom.back());
  ground.loaded = top;
  return ground;
}

/// A cable over rigid saddles that all turn it the same way.
inline Ground random_saddles(Random& random, int joints) {
  Ground ground;
  double x = 0, y = 0, angle = -1;
  const auto add = [&] {
    ground.path.push_back(static_cast<int>(ground.nodes.size()));
    ground.nodes.push_back({x, y});
    ground.held.push_back(taut::held_xy);
  };
  add();
  for (int i = 0; i <= joints; ++i) {
    if (i > 0) angle += random.between(0.04, 0.4);
    const double length = random.between(2, 9);
    x += length * std::cos(angle);
    y += length * std::sin(angle);
    add();
  }
  return ground;
}

/// What a case asks of the scene and its reality.
struct GroundRules {
  bool truss_only = false, shared = true, two_jacks = false;
  double scatter = 0;     ///< relative sd of mu from joint to joint about the common one
  double E_sd = 0;        ///< relative sd of E A
  double seating_sd = 0;  ///< relative to the nominal draw-in

  auto all() const { return std::tie(truss_only, shared, two_jacks, scatter, E_sd, seating_sd); }
};

inline Ground random_ground(Random& random, const GroundRules& rules) {
  const int joints = 3 + random.below(10);
  const bool truss = random.coin() || rules.truss_only;
  Ground ground = truss ? random_truss(random, joints) : random_saddles(random, joints);
  ground.capstan = random.coin();
  ground.A = random.between(5e-4, 3e-3) * (truss ? 0.5 : 1);
  ground.full = ground.A * random.between(4e8, 1.2e9);
  ground.dead = ground.full * 0.4 / joints;
  ground.mu = log_between(random, 0.03, 0.4);
  double turning = 0;
  for (int j = 0; j < ground.joints(); ++j) turning += ground.turning(j);
  // With more loss nobody would pull from one end only.
  ground.mu = std::fmax(0.03, std::fmin(ground.mu, 0.8 / turning));
  ground.mu_sd = 0.3 * ground.mu;
  ground.shared = rules.shared;
  ground.two_jacks = rules.two_jacks;
  ground.seating = random.between(0.02, 0.1) * ground.full * ground.length() / (ground.E * ground.A);
  return ground;
}

inline Reality random_reality(Random& random, const Ground& ground, const GroundRules& rules) {
  Reality reality;
  const auto draw = [&] { return std::fmax(0.05 * ground.mu, ground.mu + ground.mu_sd * gaussian(random)); };
  const double common = draw();
  for (int j = 0; j < ground.joints(); ++j)
    reality.mu.push_back((ground.shared ? common : draw()) *
                         std::fmax(0.1, 1 + rules.scatter * gaussian(random)));
  reality.stiffness = std::fmax(0.8, 1 + rules.E_sd * gaussian(random));
  reality.seating = ground.seating * std::fmax(0.05, 1 + rules.seating_sd * gaussian(random));
  return reality;
}

/// The true structure: pattern `dead` pushes the loaded nodes down, `sun` warms the cable by 1 K.
inline reference::Structure true_structure(const Ground& ground, const Reality& reality) {
  reference::Structure structure;
  for (std::size_t i = 0; i < ground.nodes.size(); ++i)
    structure.nodes.add(
        {reference::in_space(ground.nodes[i]), static_cast<std::uint8_t>(ground.held[i] | taut::held_z)});
  for (const Bar& bar : ground.struts) structure.struts.add({{bar.from, bar.to}, ground.strut_E, bar.A});
  taut::Cable<double> cable;
  cable.E = ground.E * reality.stiffness;
  cable.A = ground.A;
  cable.law = ground.capstan ? taut::FrictionLaw::capstan : taut::FrictionLaw::point;
  cable.alpha = ground.alpha;
  cable.seating = reality.seating;
  cable.nodes = static_cast<int>(ground.path.size());
  cable.ends = {ground.two_jacks ? taut::End::jacked : taut::End::anchored, taut::End::jacked};
  structure.cables.add(cable);
  for (const int node : ground.path) structure.path.add(node);
  for (int i = 0; i < ground.segments(); ++i) structure.prestrain.add(0);
  for (const double mu : reality.mu) structure.mu.add(mu);
  for (const int node : ground.loaded) structure.forces.add({dead, node, {0, -ground.dead, 0}});
  structure.temperatures.add({sun, 0, 1});
  structure.loads = patterns;
  return structure;
}

}  // namespace estimation_site
