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

/// A cable as the drawings say, jacked at its end or at both.
struct Cable {
  std::vector<int> path;
  int first_segment = 0;
  double E = 1.95e11, A = 8e-4, alpha = 1.2e-5;
  bool capstan = false, shared = true, two_jacks = false;
  double mu = 0.1, mu_sd = 0.03, seating = 0;
  double full = 0;  ///< the jack force aimed at [N]

  int joints() const { return static_cast<int>(path.size()) - 2; }
  int segments() const { return static_cast<int>(path.size()) - 1; }
};

/// The scene as the drawings say.
struct Ground {
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::uint8_t> held;
  std::vector<Bar> struts;
  std::vector<Cable> cables;
  std::vector<int> loaded;  ///< nodes that the pattern `dead` pushes down
  double strut_E = 2.1e11;
  double dead = 0;  ///< on every loaded node at factor 1 [N]

  /// The two struts that hold joint j (from 0) of a cable below a truss.
  std::array<int, 2> struts_at(const Cable& cable, int j) const {
    std::array<int, 2> found{};
    std::size_t count = 0;
    for (std::size_t b = 0; b < struts.size() && count < 2; ++b)
      if (struts[b].to == cable.path[static_cast<std::size_t>(j) + 1]) found[count++] = static_cast<int>(b);
    return found;
  }
  /// The forces of these two, tension positive, by statics from the tensions before and behind the joint.
  std::array<double, 2> strut_forces(const std::array<int, 2>& bars, const Cable& cable, int j, double before,
                                     double behind) const {
    const auto i = static_cast<std::size_t>(j);
    const auto& joint = at(cable, i + 1);
    const auto toward = [&](const std::array<double, 2>& node) {
      const double x = node[0] - joint[0], y = node[1] - joint[1], length = std::hypot(x, y);
      return std::array<double, 2>{x / length, y / length};
    };
    const auto back = toward(at(cable, i)), on = toward(at(cable, i + 2));
    const auto foot = [&](std::size_t k) {
      return toward(nodes[static_cast<std::size_t>(struts[static_cast<std::size_t>(bars[k])].from)]);
    };
    const auto first = foot(0), second = foot(1);
    const double x = -(before * back[0] + behind * on[0]), y = -(before * back[1] + behind * on[1]),
                 det = first[0] * second[1] - second[0] * first[1];
    return {(x * second[1] - second[0] * y) / det, (first[0] * y - x * first[1]) / det};
  }
  double length(const Cable& cable) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cable.path.size(); ++i) {
      const auto& a = at(cable, i);
      const auto& b = at(cable, i + 1);
      sum += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    return sum;
  }
  /// The angle by which a cable turns at its joint j (from 0) [rad].
  double turning(const Cable& cable, int j) const {
    const auto i = static_cast<std::size_t>(j);
    const auto &a = at(cable, i), &b = at(cable, i + 1), &c = at(cable, i + 2);
    const double first = std::atan2(b[1] - a[1], b[0] - a[0]), second = std::atan2(c[1] - b[1], c[0] - b[0]);
    return std::fabs(std::remainder(second - first, 2 * support::pi));
  }

 private:
  const std::array<double, 2>& at(const Cable& cable, std::size_t i) const {
    return nodes[static_cast<std::size_t>(cable.path[i])];
  }
};

/// What nobody on the site knows of a cable.
struct CableReality {
  std::vector<double> mu;  ///< of every joint
  double stiffness = 1;    ///< true E A over the one of the drawings
  double seating = 0;      ///< true wedge draw-in [m]
};
using Reality = std::vector<CableReality>;

/// A girder on two supports with cables below it on V-struts, one deeper than the other.
inline Ground random_truss(Random& random, int joints, int cables) {
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
  ground.cables.resize(static_cast<std::size_t>(cables));
  for (Cable& cable : ground.cables) cable.path.push_back(bottom.front());
  for (std::size_t i = 0; i + 1 < bottom.size(); ++i) {
    strut(bottom[i], bottom[i + 1]);
    strut(top[i], top[i + 1]);
    strut(bottom[i], top[i + 1]);
    strut(bottom[i], top[i]);
    if (i == 0) continue;
    const double t = 2.0 * static_cast<double>(i) / panels - 1;
    double deeper = 1;
    for (Cable& cable : ground.cables) {
      cable.path.push_back(add(panel * static_cast<double>(i) + panel * random.between(-0.05, 0.05),
                               -deeper * sag * (1 - t * t) * random.between(0.98, 1.02), taut::held_none));
      strut(bottom[i - 1], cable.path.back());
      strut(bottom[i + 1], cable.path.back());
      deeper *= 1.4;
    }
  }
  strut(bottom.back(), top.back());
  for (Cable& cable : ground.cables) cable.path.push_back(bottom.back());
  ground.loaded = top;
  return ground;
}

/// A cable over rigid saddles that all turn it the same way.
inline Ground random_saddles(Random& random, int joints) {
  Ground ground;
  ground.cables.resize(1);
  double x = 0, y = 0, angle = -1;
  const auto add = [&] {
    ground.cables.front().path.push_back(static_cast<int>(ground.nodes.size()));
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
  bool truss_only = false, shared = true, two_jacks = false, wedges = true;
  int most_cables = 1;    ///< of a truss: two at least, if more than one
  double scatter = 0;     ///< relative sd of mu from joint to joint about the common one
  double E_sd = 0;        ///< relative sd of E A
  double seating_sd = 0;  ///< relative to the nominal draw-in

  auto all() const {
    return std::tie(truss_only, shared, two_jacks, wedges, most_cables, scatter, E_sd, seating_sd);
  }
};

inline void draw_cable(Random& random, const GroundRules& rules, const Ground& ground, bool truss,
                       Cable& cable) {
  cable.capstan = random.coin();
  cable.A = random.between(5e-4, 3e-3) * (truss ? 0.5 : 1);
  cable.full = cable.A * random.between(4e8, 1.2e9);
  cable.mu = log_between(random, 0.03, 0.4);
  double turning = 0;
  for (int j = 0; j < cable.joints(); ++j) turning += ground.turning(cable, j);
  // With more loss nobody would pull from one end only.
  cable.mu = std::fmax(0.03, std::fmin(cable.mu, 0.8 / turning));
  cable.mu_sd = 0.3 * cable.mu;
  cable.shared = rules.shared;
  cable.two_jacks = rules.two_jacks;
  cable.seating = random.between(0.02, 0.1) * cable.full * ground.length(cable) / (cable.E * cable.A);
  if (!rules.wedges) cable.seating = 0;
}

inline Ground random_ground(Random& random, const GroundRules& rules) {
  const int joints = 3 + random.below(10);
  const bool truss = random.coin() || rules.truss_only;
  const int cables = rules.most_cables > 1 ? 2 + random.below(rules.most_cables - 1) : 1;
  Ground ground = truss ? random_truss(random, joints, cables) : random_saddles(random, joints);
  int segments = 0;
  double full = 0;
  for (Cable& cable : ground.cables) {
    draw_cable(random, rules, ground, truss, cable);
    cable.first_segment = segments;
    segments += cable.segments();
    full += cable.full;
  }
  ground.dead = full * 0.4 / joints;
  return ground;
}

inline CableReality random_reality(Random& random, const Cable& cable, const GroundRules& rules) {
  CableReality reality;
  const auto draw = [&] { return std::fmax(0.05 * cable.mu, cable.mu + cable.mu_sd * gaussian(random)); };
  const double common = draw();
  for (int j = 0; j < cable.joints(); ++j)
    reality.mu.push_back((cable.shared ? common : draw()) *
                         std::fmax(0.1, 1 + rules.scatter * gaussian(random)));
  reality.stiffness = std::fmax(0.8, 1 + rules.E_sd * gaussian(random));
  reality.seating = cable.seating * std::fmax(0.05, 1 + rules.seating_sd * gaussian(random));
  return reality;
}
inline Reality random_reality(Random& random, const Ground& ground, const GroundRules& rules) {
  Reality reality;
  for (const Cable& cable : ground.cables) reality.push_back(random_reality(random, cable, rules));
  return reality;
}

/// The true structure: pattern `dead` pushes the loaded nodes down, `sun` warms the cables by 1 K.
inline reference::Structure true_structure(const Ground& ground, const Reality& reality) {
  reference::Structure structure;
  for (std::size_t i = 0; i < ground.nodes.size(); ++i)
    structure.nodes.add(
        {reference::in_space(ground.nodes[i]), static_cast<std::uint8_t>(ground.held[i] | taut::held_z)});
  for (const Bar& bar : ground.struts) structure.struts.add({{bar.from, bar.to}, ground.strut_E, bar.A});
  for (std::size_t c = 0; c < ground.cables.size(); ++c) {
    const Cable& drawn = ground.cables[c];
    taut::Cable<double> cable;
    cable.E = drawn.E * reality[c].stiffness;
    cable.A = drawn.A;
    cable.law = drawn.capstan ? taut::FrictionLaw::capstan : taut::FrictionLaw::point;
    cable.alpha = drawn.alpha;
    cable.seating = reality[c].seating;
    cable.nodes = static_cast<int>(drawn.path.size());
    cable.first_path = structure.path.size();
    cable.first_segment = structure.prestrain.size();
    cable.first_joint = structure.mu.size();
    cable.ends = {drawn.two_jacks ? taut::End::jacked : taut::End::anchored, taut::End::jacked};
    structure.cables.add(cable);
    for (const int node : drawn.path) structure.path.add(node);
    for (int i = 0; i < drawn.segments(); ++i) structure.prestrain.add(0);
    for (const double mu : reality[c].mu) structure.mu.add(mu);
    structure.temperatures.add({sun, static_cast<int>(c), 1});
  }
  for (const int node : ground.loaded) structure.forces.add({dead, node, {0, -ground.dead, 0}});
  structure.loads = patterns;
  return structure;
}

}  // namespace estimation_site
