// Random scenes of many cables, of many joints and near to locking, the same for the same seed on every
// machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "campaign/world.hpp"
#include "support/equilibrium.hpp"

namespace campaign {

struct WebCapacity : taut::Capacity {
  static constexpr int nodes = 128, struts = 128, cables = 20, segments = 112, joints = 96, loads = 4;
  static constexpr int forces = 256, temperatures = 20;
  static constexpr int substructures = 112, substructure_nodes = 128, substructure_entries = 1600;
  using Watch = support::RoutesTaken;
};
using PlaneWeb = taut::Scene<double, 2, WebCapacity>;
using SpaceWeb = taut::Scene<double, 3, WebCapacity>;

enum class ManyKind { grid, dome, lacing, near_locking, two_jacks, six_jacked, lock_slack, count };

inline const char* name_of(ManyKind kind) {
  switch (kind) {
    case ManyKind::grid:
      return "grid";
    case ManyKind::dome:
      return "dome";
    case ManyKind::lacing:
      return "lacing";
    case ManyKind::near_locking:
      return "near-locking";
    case ManyKind::two_jacks:
      return "two-jacks";
    case ManyKind::six_jacked:
      return "six-jacked";
    case ManyKind::lock_slack:
      return "lock-slack";
    case ManyKind::count:
      break;
  }
  return "?";
}

/// Builds one world. Lengths are metres, forces newtons.
template <class SceneType>
class WebMaker {
 public:
  using Point = typename SceneType::Point;
  using Sample = taut::Sample<double, typename SceneType::Capacity>;
  static constexpr int dimension = SceneType::dimension;
  static constexpr bool in_space = dimension == 3;

  WebMaker(World<SceneType>& world, support::Random& random)
      : world_(world), scene_(world.scene), random_(random) {}

  void make(ManyKind kind) {
    world_.kind = name_of(kind);
    switch (kind) {
      case ManyKind::grid:
        force_ = 5e3;
        if (random_.coin())
          grid(6 + random_.below(11), support::anchored);
        else
          web(6 + random_.below(11), support::anchored);
        loads(2, force_);
        log();
        break;
      case ManyKind::dome:
        force_ = 2e4;
        dome();
        loads(2, force_);
        log();
        break;
      case ManyKind::lacing:
        lacing(17 + random_.below(44));
        log();
        break;
      case ManyKind::near_locking:
        near_locking(4 + random_.below(11));
        log();
        break;
      case ManyKind::two_jacks:
        two_jacks();
        break;
      case ManyKind::six_jacked:
        force_ = 5e3;
        if (random_.coin())
          grid(6, support::jacked_end);
        else
          web(6, support::jacked_end);
        loads(2, force_);
        log_in_turns();
        break;
      case ManyKind::lock_slack:
        lock_slack();
        break;
      case ManyKind::count:
        break;
    }
  }

 private:
  // Parts.

  double spread(double low, double high) { return low * std::exp(random_.between(0, std::log(high / low))); }
  Point point(double x, double y, double z) const {
    Point at{};
    at[0] = x;
    at[1] = y;
    if constexpr (in_space) at[2] = z;
    return at;
  }
  Point random_direction() {
    for (;;) {
      Point d{};
      double square = 0;
      for (double& part : d) {
        part = random_.between(-1, 1);
        square += part * part;
      }
      if (square < 1e-4 || square > 1) continue;
      for (double& part : d) part /= std::sqrt(square);
      return d;
    }
  }
  static std::uint8_t all_held() { return in_space ? taut::held_xyz : taut::held_xy; }

  /// An elastic node: as many springs as there are axes, each along its own random direction.
  void spring(int node, double softest, double stiffest) {
    std::array<double, dimension * dimension> K{};
    const auto entry = [&K](int i, int k) -> double& { return K[std::size_t(i * dimension + k)]; };
    for (int s = 0; s < dimension; ++s) {
      const Point d = random_direction();
      const double k = spread(softest, stiffest);
      for (std::size_t i = 0; i < d.size(); ++i)
        for (std::size_t j = i; j < d.size(); ++j) entry(int(i), int(j)) += k * d[i] * d[j];
    }
    for (int i = 0; i < dimension; ++i) {
      entry(i, i) *= 1 + 1e-9;
      for (int j = 0; j < i; ++j) entry(i, j) = entry(j, i);
    }
    scene_.add_substructure(&node, 1, K.data());
  }
  /// The same stiffness along all axes between two nodes.
  void link(int a, int b, double k) {
    constexpr int size = 2 * dimension;
    std::array<double, size * size> K{};
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (i % dimension == j % dimension) K[std::size_t(i * size + j)] = i == j ? k : -k;
    const int nodes[] = {a, b};
    scene_.add_substructure(nodes, 2, K.data());
  }
  taut::Cable<double> cable(double area, double most_mu, std::array<taut::End, 2> ends) {
    taut::Cable<double> made;
    made.E = support::steel;
    made.A = area;
    made.mu = random_.between(0.01, most_mu);
    made.law = random_.coin() ? taut::FrictionLaw::capstan : taut::FrictionLaw::point;
    made.alpha = 1.2e-5;
    made.ends = ends;
    return made;
  }
  int add(const taut::Cable<double>& cable, const std::vector<int>& path) {
    return scene_.add_cable(cable, path.data(), int(path.size()));
  }
  /// Every mu and prestrain a little different, in most scenes.
  void vary() {
    if (random_.below(4) == 0) return;
    for (double& mu : scene_.mu) mu *= random_.between(0.5, 1.5);
    for (double& prestrain : scene_.prestrain) prestrain *= random_.between(0.5, 1.5);
  }
  /// Patterns of forces on all free nodes, and one of temperature on some cables.
  void loads(int patterns, double size) {
    for (int k = 0; k < patterns; ++k) {
      const int load = scene_.add_load();
      const bool down = random_.coin();
      const int last = dimension - 1;
      for (int node = 0; node < scene_.nodes.size(); ++node) {
        if (scene_.nodes[node].is_held(last) && scene_.nodes[node].is_held(0)) continue;
        if (!carried(node)) continue;
        Point force{};
        if (down)
          force[std::size_t(last)] = -size;
        else
          for (double& part : force) part = random_.between(-size, size);
        scene_.add_force(load, node, force);
      }
    }
    const int warm = scene_.add_load();
    for (int c = 0; c < scene_.cables.size(); ++c)
      if (random_.coin()) scene_.add_temperature(warm, c, 20);
  }
  /// On the path of a cable.
  bool carried(int node) const {
    for (const int at : scene_.path)
      if (at == node) return true;
    return false;
  }

  // Kinds.

  /// What holds a node of a net beside its cables.
  void hold(int node, const Point& at, int way) {
    if (way == 0) return spring(node, 1e5, 3e7);
    Point below = at;
    below[std::size_t(dimension - 1)] -= 3;
    below[0] += random_.between(-0.1, 0.1);
    scene_.add_strut(node, scene_.add_node(below, all_held()), support::steel, spread(1e-4, 1e-3));
    if (way == 1) spring(node, 1e4, 1e6);
  }
  std::vector<double> prestrains(int cables) {
    const double equal = random_.between(1e-4, 1e-3);
    const int way = random_.below(4);
    std::vector<double> all(std::size_t(cables), way == 0 ? 0 : equal);
    if (way > 1)
      for (double& one : all) one = random_.between(way == 3 ? -1e-4 : 0, 1e-3);
    return all;
  }

  /// Two families of cables that cross; every crossing is a node shared by one of each.
  void grid(int cables, std::array<taut::End, 2> ends) {
    int nx = 0, ny = 0;
    do {
      nx = 2 + random_.below(cables - 3);
      ny = cables - nx;
    } while (nx * ny > 36);
    const int way = random_.below(3);
    const double width = random_.between(2, 5), sag = random_.between(-2, 2), off = random_.between(0, 0.8);
    const auto at = [&](int i, int j) {
      const double u = 2.0 * i / (nx + 1) - 1, v = 2.0 * j / (ny + 1) - 1;
      const double y = width * j + random_.between(-off, off), x = width * i + random_.between(-off, off);
      return point(x, y, sag * (u * u - v * v) + 3);
    };
    std::vector<std::vector<int>> node(std::size_t(nx + 2), std::vector<int>(std::size_t(ny + 2), -1));
    for (int i = 0; i < nx + 2; ++i)
      for (int j = 0; j < ny + 2; ++j) {
        const bool side_x = i == 0 || i == nx + 1, side_y = j == 0 || j == ny + 1;
        if (side_x && side_y) continue;
        const Point here = at(i, j);
        int& made = node[std::size_t(i)][std::size_t(j)];
        made = scene_.add_node(here, side_x || side_y ? all_held() : std::uint8_t(taut::held_none));
        if (!side_x && !side_y && scene_.nodes.size() + nx * ny < 120) hold(made, here, way);
        if (!side_x && !side_y && scene_.nodes.size() + nx * ny >= 120) spring(made, 1e5, 3e7);
      }
    const std::vector<double> prestrain = prestrains(cables);
    for (int i = 1; i <= nx; ++i) {
      taut::Cable<double> made = cable(spread(1e-4, 2e-3), 0.4, ends);
      made.prestrain = prestrain[std::size_t(i - 1)];
      add(made, node[std::size_t(i)]);
    }
    for (int j = 1; j <= ny; ++j) {
      taut::Cable<double> made = cable(spread(1e-4, 2e-3), 0.4, ends);
      made.prestrain = prestrain[std::size_t(nx + j - 1)];
      std::vector<int> path;
      for (int i = 0; i < nx + 2; ++i) path.push_back(node[std::size_t(i)][std::size_t(j)]);
      add(made, path);
    }
    vary();
  }

  /// Cables over any three to five nodes of a square of elastic ones: they overlap, cross and turn sharply.
  void web(int cables, std::array<taut::End, 2> ends) {
    const int side = cables > 9 || random_.coin() ? 4 : 3;
    std::vector<int> node;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const bool corner = (i == 0 || i == side - 1) && (j == 0 || j == side - 1);
        const double z = random_.between(-1.5, 2.5), y = 4 * j + random_.between(-0.7, 0.7),
                     x = 4 * i + random_.between(-0.7, 0.7);
        node.push_back(scene_.add_node(point(x, y, z), corner ? all_held() : std::uint8_t(taut::held_none)));
        if (!corner) spring(node.back(), 3e4, 5e7);
      }
    for (int k = 0; k < side; ++k) {
      const int a = random_.below(side * side - 1);
      scene_.add_strut(node[std::size_t(a)], node[std::size_t(a + 1)], support::steel, spread(1e-4, 1e-3));
    }
    const std::vector<double> prestrain = prestrains(cables);
    for (int c = 0; c < cables; ++c) {
      const std::size_t length = std::size_t(random_.coin() ? 3 : 3 + random_.below(3));
      taut::Cable<double> made = cable(spread(5e-5, 2e-3), 0.4, ends);
      made.prestrain = prestrain[std::size_t(c)];
      add(made, path_over(node, length));
    }
    vary();
  }
  /// A random path without a node twice and without a fold.
  std::vector<int> path_over(const std::vector<int>& nodes, std::size_t length) {
    std::vector<int> path;
    while (path.size() < length) {
      const int next = nodes[std::size_t(random_.below(int(nodes.size())))];
      if (std::find(path.begin(), path.end(), next) != path.end()) continue;
      if (path.size() >= 2 && folds(path[path.size() - 2], path.back(), next)) continue;
      path.push_back(next);
    }
    return path;
  }
  /// Whether a cable would turn by more than about 150 degrees.
  bool folds(int a, int b, int c) const {
    double dot = 0, aa = 0, cc = 0;
    for (std::size_t i = 0; i < std::size_t(dimension); ++i) {
      const double u = scene_.nodes[a].at[i] - scene_.nodes[b].at[i];
      const double v = scene_.nodes[c].at[i] - scene_.nodes[b].at[i];
      dot += u * v;
      aa += u * u;
      cc += v * v;
    }
    return dot > 0.85 * std::sqrt(aa * cc);
  }

  /// A suspen-dome: hoops of cable below elastic top nodes, struts between, and cables from the hoops over
  /// elastic middle nodes to held outer ones, straight out and across.
  void dome() {
    const int sides = 3 + random_.below(6);
    const bool both = random_.coin(), two_hoops = sides <= 6 && random_.below(3) == 0;
    const double radius = random_.between(8, 25), height = radius / random_.between(3, 8);
    const std::vector<double> prestrain = prestrains(2 * sides + 2);
    const double soft = spread(1e4, 1e7);
    std::vector<std::vector<int>> hoops;
    std::vector<int> outer, middle;
    for (int ring = 0; ring < (two_hoops ? 2 : 1); ++ring) {
      const double r = ring == 0 ? radius : radius / 2, lift = ring == 0 ? 0 : height / 2;
      std::vector<int> hoop;
      for (int i = 0; i < sides; ++i) {
        const double angle = 2 * support::pi * i / sides + random_.between(-0.02, 0.02);
        const double x = std::cos(angle), y = std::sin(angle);
        hoop.push_back(scene_.add_node(point(r * x, r * y, lift - height)));
        const int top = scene_.add_node(point(r * x, r * y, lift));
        spring(top, 1e8, 5e8);
        link(hoop.back(), top, random_.coin() ? soft : spread(1e4, 1e7));
        if (random_.below(3) != 0) scene_.add_strut(hoop.back(), top, support::steel, spread(5e-4, 5e-3));
      }
      hoops.push_back(hoop);
    }
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * support::pi * i / sides, r = radius;
      outer.push_back(scene_.add_node(
          point(1.4 * r * std::cos(angle), 1.4 * r * std::sin(angle), -0.3 * height), all_held()));
      middle.push_back(
          scene_.add_node(point(1.2 * r * std::cos(angle), 1.2 * r * std::sin(angle), -0.6 * height)));
      spring(middle.back(), 1e5, 1e8);
    }
    for (std::size_t ring = 0; ring < hoops.size(); ++ring) {
      taut::Cable<double> made = cable(spread(5e-4, 3e-3), 0.3, support::anchored);
      made.closed = true;
      made.prestrain = prestrain[ring];
      add(made, hoops[ring]);
      const bool inner = ring == 1;
      for (int i = 0; i < sides; ++i) {
        const auto k = std::size_t(i), next = std::size_t((i + 1) % sides);
        taut::Cable<double> radial = cable(spread(5e-5, 5e-4), 0.3, support::anchored);
        radial.prestrain = prestrain[2 + k];
        if (inner)
          add(radial, {hoops[1][k], hoops[0][k], outer[k]});
        else if (both || i % 2 == 0)
          add(radial, {hoops[0][k], middle[k], outer[k]});
        if (inner || (!two_hoops && random_.below(8) == 0)) continue;
        taut::Cable<double> across = cable(spread(5e-5, 5e-4), 0.3, support::anchored);
        across.prestrain = prestrain[2 + std::size_t(sides) + k];
        add(across, {hoops[0][k], middle[next], outer[next]});
      }
    }
    vary();
  }

  std::array<taut::End, 2> random_ends() {
    const int way = random_.below(3);
    return way == 0 ? support::jacked_end : way == 1 ? support::jacked_start : support::two_jacks;
  }

  /// A lace through two rows of eyelets, or a winding round a post.
  void lacing(int joints) {
    const int nodes = joints + 2;
    const bool zigzag = random_.coin(), stiff = random_.coin();
    const double turn = random_.between(0.3, 1.3), pitch = random_.between(0.2, 0.3);
    std::vector<int> path;
    for (int i = 0; i < nodes; ++i) {
      const double dx = random_.between(-0.02, 0.02), dy = random_.between(-0.02, 0.02);
      const double r = in_space ? 0.3 : 0.3 + 0.02 * i;
      const Point at = zigzag ? point(pitch * i + dx, (i % 2 == 0 ? 0 : 0.35) + dy, dx)
                              : point(r * std::cos(turn * i) + dx, r * std::sin(turn * i) + dy, 0.05 * i);
      const bool end = i == 0 || i + 1 == nodes;
      path.push_back(scene_.add_node(at, end ? all_held() : std::uint8_t(taut::held_none)));
      if (!end) stiff ? spring(path.back(), 1e7, 3e9) : spring(path.back(), 5e4, 2e7);
    }
    taut::Cable<double> made = cable(random_.between(4e-6, 8e-6), zigzag ? 0.35 : 0.2, random_ends());
    if (random_.coin()) made.seating = 1e-3;
    if (random_.below(4) == 0) made.prestrain = random_.between(0, 1e-3);
    add(made, path);
    vary();
    force_ = 4e3;
    loads(1, 400);
  }

  /// A curve of elastic nodes with struts beside it whose joints hold back nearly everything.
  void near_locking(int joints) {
    const bool capstan = random_.below(3) == 0;
    curve(joints, capstan);
    // The product of all rho from 1e-14 on, or each rho for itself down to 1e-9; some joints lock.
    const bool by_product = random_.below(3) != 0;
    const double each = std::pow(spread(1e-14, 1e-3), 1.0 / joints);
    const auto& cable = scene_.cables[0];
    for (int j = 0; j < joints; ++j) {
      const double rho =
          by_product ? std::pow(each, random_.between(0.6, 1.4)) : spread(random_.coin() ? 1e-9 : 1e-4, 0.5);
      scene_.mu[j] = mu_for(cable, j, std::min(rho, 0.999));
      if (!by_product && random_.below(10) == 0) scene_.mu[j] *= 1.001;
    }
    force_ = 2e5;
    loads(2, 3e4);
  }
  /// The mu at which a joint holds T_small / T_big = rho.
  double mu_for(const taut::Cable<double>& cable, int j, double rho) const {
    const auto at = scene_.joint_nodes(cable, j);
    double dot = 0, aa = 0, cc = 0;
    for (std::size_t i = 0; i < std::size_t(dimension); ++i) {
      const double u = scene_.nodes[at.before].at[i] - scene_.nodes[at.at].at[i];
      const double v = scene_.nodes[at.after].at[i] - scene_.nodes[at.at].at[i];
      dot += u * v;
      aa += u * u;
      cc += v * v;
    }
    const double half = std::acos(std::max(-1.0, std::min(1.0, dot / std::sqrt(aa * cc)))) / 2;
    if (cable.law == taut::FrictionLaw::capstan) return -std::log(rho) / (support::pi - 2 * half);
    return (1 - rho) / (1 + rho) * std::tan(half);
  }
  void curve(int joints, bool capstan) {
    std::vector<int> path;
    double heading = 0, x = 0, y = 0, z = 0;
    const double way = random_.between(0.2, capstan ? 1.6 : 0.6);
    for (int i = 0; i < joints + 2; ++i) {
      const bool end = i == 0 || i == joints + 1;
      path.push_back(scene_.add_node(point(x, y, z), end ? all_held() : std::uint8_t(taut::held_none)));
      if (!end) spring(path.back(), 3e5, 5e7);
      const double length = random_.between(1.5, 4.5);
      heading += way * random_.between(0.3, 1.4);
      x += length * std::cos(heading);
      y += length * std::sin(heading);
      z += random_.between(0, 1.5);
    }
    for (std::size_t i = 0; i + 2 < path.size(); ++i)
      if (random_.below(5) != 0) scene_.add_strut(path[i], path[i + 2], support::steel, spread(3e-5, 8e-4));
    auto ends = random_ends();
    if (random_.below(5) == 0) ends = support::anchored;
    taut::Cable<double> made = cable(random_.between(2e-4, 6e-4), 0.4, ends);
    made.law = capstan ? taut::FrictionLaw::capstan : taut::FrictionLaw::point;
    made.prestrain = ends == support::anchored ? random_.between(0, 2e-3) : 0;
    if (random_.below(3) == 0) made.seating = 3e-3;
    add(made, path);
  }

  /// T_small / T_big that all joints of a cable hold together.
  double product(int c) const {
    const support::Anatomy<SceneType> anatomy(scene_);
    support::Exact carried = 1;
    for (int j = 0; j < scene_.cables[c].joints(); ++j) carried *= anatomy.ratio(c, j);
    return double(carried);
  }
  void two_jacks() {
    const int joints = 2 + random_.below(13);
    curve(joints, random_.coin());
    auto& cable = scene_.cables[0];
    cable.ends = support::two_jacks;
    cable.prestrain = 0;
    for (double& prestrain : scene_.prestrain) prestrain = 0;
    for (double& mu : scene_.mu) mu *= random_.between(0.1, 1.5);
    force_ = 2e5;
    loads(1, 2e4);
    const double carried = product(0);
    Sample sample;
    const int rows = 6 + random_.below(8);
    for (int row = 0; row < rows; ++row) {
      step_loads(sample);
      const double spare = spread(1e-12, 1e-2), F = random_.between(0.1, 1) * force_;
      auto& jacks = sample.jack[0];
      const std::size_t low = std::size_t(random_.below(2));
      const int way = random_.below(10);
      if (way == 0) {
        jacks[0].force = jacks[1].force = 0;
      } else if (way == 1) {
        jacks[0].force = jacks[1].force = F;
      } else if (way == 2) {
        jacks[low].force = jacks[1 - low].force * (carried + (1 - carried) * random_.between(0, 1));
      } else if (way == 3 && random_.below(12) == 0) {
        jacks[1 - low].force = F;
        jacks[low].force = F * carried * (1 - spare);
      } else {
        jacks[1 - low].force = F;
        jacks[low].force = F * std::min(1.0, carried * (1 + spare));
      }
      world_.samples.push_back(sample);
    }
  }

  void lock_slack() {
    const int way = random_.below(3);
    if (way == 0) {
      const bool capstan = random_.coin();
      curve(2 + random_.below(7), capstan);
      force_ = 2e5;
      loads(2, 3e4);
    } else if (way == 1) {
      lacing(4 + random_.below(12));
      loads(1, 400);
    } else {
      force_ = 2e4;
      const auto ends = random_.coin() ? support::jacked_end : support::anchored;
      random_.coin() ? grid(4 + random_.below(3), ends) : web(4 + random_.below(3), ends);
      loads(2, force_);
    }
    for (auto& cable : scene_.cables)
      if (random_.coin()) cable.seating = random_.between(0, 1e-2);
    Sample sample;
    const int rows = 8 + random_.below(8);
    for (int row = 0; row < rows; ++row) {
      for (int load = 0; load < scene_.loads; ++load)
        if (random_.below(3) != 0) sample.factor[load] = random_factor(random_, -3, 3);
      for_each_jack(sample, [&](auto& jack) {
        const int what = random_.below(4);
        if (what == 0) jack.force = 0;
        if (what == 1) jack.force = random_.between(0, force_);
        if (what == 2) jack.locked = !jack.locked;
      });
      even_out(sample);
      world_.samples.push_back(sample);
    }
  }

  // Logs.

  template <class Visit>
  void for_each_jack(Sample& sample, Visit visit) {
    for (int c = 0; c < scene_.cables.size(); ++c) {
      const auto& cable = scene_.cables[c];
      for (std::size_t end = 0; end < 2; ++end)
        if (!cable.closed && cable.ends[end] == taut::End::jacked) visit(sample.jack[c][end]);
    }
  }
  /// Two jacks on one cable differ by no more than friction holds, in most rows.
  void even_out(Sample& sample) {
    for (int c = 0; c < scene_.cables.size(); ++c) {
      const auto& cable = scene_.cables[c];
      if (cable.closed || cable.ends[0] != taut::End::jacked || cable.ends[1] != taut::End::jacked) continue;
      if (random_.below(40) == 0) continue;
      auto& jacks = sample.jack[c];
      const double least = product(c) * 1.0001, big = std::max(jacks[0].force, jacks[1].force);
      for (auto& jack : jacks) jack.force = std::max(jack.force, std::min(least, 1.0) * big);
    }
  }
  /// Up, down, back, hold or anywhere.
  void step_loads(Sample& sample) {
    for (int load = 0; load < scene_.loads; ++load) {
      double& factor = sample.factor[load];
      const int what = random_.below(6);
      if (what == 0) factor += random_.between(0, 0.7);
      if (what == 1) factor -= random_.between(0, 0.7);
      if (what == 2) factor = -factor;
      if (what == 3) factor = random_factor(random_, -1, 1);
      if (what == 4) factor += random_.between(-0.01, 0.01);
    }
  }
  /// Ramp, overstress, release, jack again, lock, hold.
  void step_jack(taut::Jack<double>& jack) {
    const int what = random_.below(8);
    if (what == 0) jack.force = 0;
    if (what == 1) jack.force = 1.2 * force_;
    if (what == 2 || what == 3) jack.force = std::min(1.2 * force_, jack.force + 0.3 * force_);
    if (what == 4) jack.force = random_.between(0.1, 1) * force_;
    if (what == 5) jack.force *= random_.between(0.8, 1);
    if (what == 6) jack.locked = !jack.locked;
  }
  void log() {
    Sample sample;
    const int rows = 4 + random_.below(9);
    for (int row = 0; row < rows; ++row) {
      step_loads(sample);
      for_each_jack(sample, [&](auto& jack) { step_jack(jack); });
      even_out(sample);
      world_.samples.push_back(sample);
    }
  }
  /// One cable after the other, twice; the ones that are done may be locked.
  void log_in_turns() {
    force_ = 1e5;
    Sample sample;
    const bool locks = random_.coin();
    for (int round = 0; round < 2; ++round)
      for (int c = 0; c < scene_.cables.size(); ++c) {
        if (random_.below(3) == 0) step_loads(sample);
        auto& jack = sample.jack[c][1];
        if (round > 0 && random_.below(6) == 0) {
          step_jack(jack);
        } else {
          jack.force = (round == 0 ? 0.5 : 1) * force_ * random_.between(0.7, 1.2);
          jack.locked = false;
        }
        world_.samples.push_back(sample);
        if (locks && random_.coin()) jack.locked = true;
      }
  }

  World<SceneType>& world_;
  SceneType& scene_;
  support::Random& random_;
  double force_ = 0;  ///< that jacks work with [N]
};

/// Makes the world of a kind and a seed and hands it to visit().
template <class Visit>
void visit_many(ManyKind kind, std::uint64_t seed, Visit visit) {
  support::Random random(seed * std::uint64_t(ManyKind::count) + std::uint64_t(kind));
  const auto make = [&](auto& world) {
    WebMaker<std::decay_t<decltype(world.scene)>>(world, random).make(kind);
    visit(world, random);
  };
  if (kind == ManyKind::dome || random.coin()) {
    const auto world = std::make_unique<World<SpaceWeb>>();
    make(*world);
  } else {
    const auto world = std::make_unique<World<PlaneWeb>>();
    make(*world);
  }
}

}  // namespace campaign
