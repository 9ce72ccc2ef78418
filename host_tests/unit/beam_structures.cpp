// Structures with beams against closed forms.
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/stepwise/stepwise.hpp"
#include "taut/tracking/tracker.hpp"

namespace beam_structures_test {
using namespace support;
using taut::Code;
using taut::held_r;
using taut::held_rx;
using taut::held_ry;
using taut::held_rz;
using taut::held_xy;
using taut::held_xyz;
using taut::held_y;
using taut::Place;

namespace {

struct BeamCapacity : taut::Capacity {
  static constexpr int nodes = 12, struts = 6, beams = 12, cables = 1, segments = 4, joints = 3;
  static constexpr int loads = 2, forces = 8, substructures = 2, substructure_nodes = 2;
  static constexpr int substructure_entries = 18;
};
template <int Dimension>
using BeamScene = taut::Scene<double, Dimension, BeamCapacity>;

// What has no beams pays for none.
struct NoBeams : BeamCapacity {
  static constexpr int beams = 0;
};
using WithoutBeams = taut::Structure<double, taut::Scene<double, 3, NoBeams>>;
static_assert(std::is_empty<taut::BeamList<double, 3, 0>>::value, "no room in a scene");
static_assert(std::is_empty<taut::BeamElements<double, 3, 0>>::value, "nor among the elements");
static_assert(WithoutBeams::max_unknowns == 3 * NoBeams::nodes, "no unknowns");
static_assert(sizeof(taut::Condensed<float, NoBeams>) == sizeof(taut::Condensed<float, BeamCapacity>) &&
                  sizeof(taut::CondensedStruts<float, NoBeams>) ==
                      sizeof(taut::CondensedStruts<float, BeamCapacity>),
              "and nothing on a device, even if there are some");
struct BeamsAlone : NoBeams {
  static constexpr int struts = 0, beams = 1, substructures = 0;
};
static_assert(!taut::has_rigid_saddles<BeamsAlone>, "saddles on beams are not rigid");

constexpr double E = 2.1e11, G = 8.1e10;
constexpr double A = 0.02, I = 4e-4, EI = E * I;
const taut::BeamSection<double, 2> section{E, A, I};

/// Displacements and rotations under load 0 of a scene.
template <int Dimension>
class Solved {
 public:
  using SceneType = BeamScene<Dimension>;

  explicit Solved(const SceneType& scene) : structure_(new taut::Structure<double, SceneType>) {
    REQUIRE(taut::validate(scene).ok());
    REQUIRE(structure_->make(scene).ok());
    const auto force = [&scene](int node, int axis) {
      double sum = 0;
      for (const auto& given : scene.forces)
        if (given.node == node) sum += given.force[static_cast<std::size_t>(axis)];
      return sum;
    };
    REQUIRE(structure_->solve(force, [](int) { return 0.0; }).ok());
  }
  double at(int node, int axis) const { return structure_->node_displacement(node, axis); }
  double turn(int node, int axis = 0) const { return structure_->node_rotation(node, axis); }
  const taut::Structure<double, SceneType>& operator()() const { return *structure_; }

 private:
  std::unique_ptr<taut::Structure<double, SceneType>> structure_;
};

/// Nodes at these places of the x axis, and beams between them.
BeamScene<2> beam_over(const std::vector<double>& x, const std::vector<int>& held) {
  BeamScene<2> scene;
  for (std::size_t i = 0; i < x.size(); ++i) scene.add_node({x[i], 0}, static_cast<std::uint8_t>(held[i]));
  for (int i = 0; i + 1 < scene.nodes.size(); ++i) scene.add_beam(i, i + 1, section);
  scene.add_load();
  return scene;
}

constexpr double L = 6, P = 1e4;

bool within(double a, double b, double relative) { return close(a, b, relative); }

}  // namespace

TEST_CASE("the tip of a cantilever moves and turns as in the textbook, whatever it is divided into") {
  for (const std::vector<double>& x : {std::vector<double>{0, L}, {0, 1, 1.5, 4, L}}) {
    std::vector<int> held(x.size(), 0);
    held[0] = held_xy | held_r;
    BeamScene<2> scene = beam_over(x, held);
    const int tip = scene.nodes.size() - 1;
    scene.add_force(0, tip, {3 * P, -P});
    const Solved<2> solved(scene);
    CHECK(within(solved.at(tip, 1), -P * L * L * L / (3 * EI), 1e-13));
    CHECK(within(solved.turn(tip), -P * L * L / (2 * EI), 1e-13));
    CHECK(within(solved.at(tip, 0), 3 * P * L / (E * A), 1e-13));
    for (int i = 0; i < scene.beams.size(); ++i) CHECK(within(solved().beam_force(i), 3 * P, 1e-13));
  }
}

TEST_CASE("a load in the middle bends a beam as its ends allow") {
  const auto middle = [](int left, int right) {
    BeamScene<2> scene = beam_over({0, L / 2, L}, {left, 0, right});
    scene.add_force(0, 1, {0, -P});
    return Solved<2>(scene).at(1, 1);
  };
  const double unit = P * L * L * L / EI;
  CHECK(within(middle(held_xy, held_y), -unit / 48, 1e-13));
  CHECK(within(middle(held_xy | held_r, held_xy | held_r), -unit / 192, 1e-13));
  CHECK(within(middle(held_xy | held_r, held_y), -7 * unit / 768, 1e-13));
  CHECK(within(middle(held_xy, held_y | held_r), -7 * unit / 768, 1e-13));
}

TEST_CASE("a Gerber beam is bent as its two parts are, linked by the force in the hinge") {
  constexpr double over = 1.5, span = 4;
  // Hinged at both sides of the node or at one alone.
  for (const int hinges : {0, 1, 2}) {
    CAPTURE(hinges);
    BeamScene<2> scene;
    for (const double x : {0.0, L, L + over, L + over + span / 2, L + over + span})
      scene.add_node({x, 0}, x == 0 ? held_xy : x == L || x > L + over + span / 2 ? held_y : taut::held_none);
    scene.add_beam(0, 1, section);
    scene.add_beam(1, 2, section, {false, hinges != 2});
    scene.add_beam(2, 3, section, {hinges != 1, false});
    scene.add_beam(3, 4, section);
    scene.add_force(scene.add_load(), 3, {0, -P});
    const Solved<2> solved(scene);
    const double hinge = -P / 2 * over * over * (L + over) / (3 * EI);
    CHECK(within(solved.at(2, 1), hinge, 1e-13));
    CHECK(within(solved.at(3, 1), hinge / 2 - P * span * span * span / (48 * EI), 1e-13));
    // -P/2 at the end of an overhang turns the support by P/2 a L / 3 EI.
    CHECK(within(solved.turn(1), -P / 2 * over * L / (3 * EI), 1e-13));
    if (hinges == 0) CHECK(solved.turn(2) == 0);
  }
}

TEST_CASE("a portal frame sways as slope and deflection have it") {
  constexpr double h = 4, column_I = 3e-4, stiff_A = 1e6;  // inextensible to 1e-9
  BeamScene<2> scene;
  for (const double x : {0.0, L}) {
    scene.add_node({x, 0}, held_xy | held_r);
    scene.add_node({x, h});
  }
  const taut::BeamSection<double, 2> column{E, stiff_A, column_I}, girder{E, stiff_A, I};
  scene.add_beam(0, 1, column);
  scene.add_beam(3, 2, column);
  scene.add_beam(1, 3, girder);
  scene.add_force(scene.add_load(), 1, {P, 0});
  const Solved<2> solved(scene);
  // Both corners turn alike by theta: no moment on a corner, and the shear of both columns is P.
  const double k = (I / L) / (column_I / h);
  const double sway = P * h * h * h / (12 * E * column_I) * (3 * k + 2) / (6 * k + 1);
  const double theta = -6 * sway / h / (4 + 6 * k);
  for (const int corner : {1, 3}) {
    CHECK(within(solved.at(corner, 0), sway, 1e-8));
    CHECK(within(solved.turn(corner), theta, 1e-8));
  }
  // The moment of the corner, P h / 2 x 3k / (6k + 1).
  CHECK(within(6 * EI / L * -theta, P * h / 2 * 3 * k / (6 * k + 1), 1e-12));
  // The girder carries half of the load across.
  CHECK(within(solved().beam_force(2), -P / 2, 1e-8));
}

TEST_CASE("in space a cantilever bends about both its axes, which up turns") {
  // x' = (2, 3, 6) / 7; y', z' square to it, turned by 30 degrees about it.
  const Eigen::Vector3d x = Eigen::Vector3d(2, 3, 6) / 7, b = Eigen::Vector3d(-6, -2, 3) / 7,
                        c = Eigen::Vector3d(3, -6, 2) / 7;
  const double cosine = std::sqrt(0.75), sine = 0.5;
  const Eigen::Vector3d z = cosine * c + sine * b, y = z.cross(x);
  constexpr double Iy = 4e-4, Iz = 7e-5, J = 9e-6;
  const Eigen::Vector3d load(2e3, -1e3, 500), up = 3 * z + x;
  BeamScene<3> scene;
  scene.add_node({0, 0, 0}, held_xyz | held_rx | held_ry | held_rz);
  scene.add_node({L * x[0], L * x[1], L * x[2]});
  scene.add_beam(0, 1, {E, A, Iy, Iz, J, G, {up[0], up[1], up[2]}});
  scene.add_force(scene.add_load(), 1, {load[0], load[1], load[2]});
  const Solved<3> solved(scene);
  const Eigen::Vector3d tip = x * load.dot(x) * L / (E * A) + y * load.dot(y) * L * L * L / (3 * E * Iz) +
                              z * load.dot(z) * L * L * L / (3 * E * Iy);
  // The tip turns about y from a force along -z, about z from one along y.
  const Eigen::Vector3d turned =
      z * load.dot(y) * L * L / (2 * E * Iz) - y * load.dot(z) * L * L / (2 * E * Iy);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::fabs(solved.at(1, axis) - tip[axis]) <= 1e-13 * tip.norm());
    CHECK(std::fabs(solved.turn(1, axis) - turned[axis]) <= 1e-13 * turned.norm());
  }
}

TEST_CASE("an arm of a cantilever twists it: P a^3 / 3EI + P b^3 / 3EI + P b^2 a / GJ, however it lies") {
  constexpr double a = 3, b = 2, J = 9e-6;
  const double tip = P * a * a * a / (3 * EI) + P * b * b * b / (3 * EI) + P * b * b * a / (G * J);
  // The axes of the frame: along, across, up.
  const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d askew;
  askew << 2, -6, 3, 3, -2, -6, 6, 3, 2;
  askew /= 7;
  for (const Eigen::Matrix3d& axes : {straight, askew})
    for (const bool reversed : {false, true}) {
      const auto point = [&axes](double along, double across) {
        const Eigen::Vector3d at = axes * Eigen::Vector3d(along, across, 0);
        return std::array<double, 3>{at[0] + 10, at[1] - 20, at[2] + 5};
      };
      const std::array<double, 3> up{axes(0, 2), axes(1, 2), axes(2, 2)};
      const taut::BeamSection<double, 3> each{E, A, I, 1e-4, J, G, up};
      BeamScene<3> scene;
      constexpr std::uint8_t fixed = held_xyz | held_rx | held_ry | held_rz;
      int end;
      if (reversed) {
        end = scene.add_node(point(a, b));
        scene.add_node(point(a, 0));
        scene.add_node(point(0, 0), fixed);
        scene.add_beam(0, 1, each);
        scene.add_beam(2, 1, each);
      } else {
        scene.add_node(point(0, 0), fixed);
        scene.add_node(point(a, 0));
        end = scene.add_node(point(a, b));
        scene.add_beam(0, 1, each);
        scene.add_beam(1, 2, each);
      }
      scene.add_force(scene.add_load(), end, {-P * up[0], -P * up[1], -P * up[2]});
      const Solved<3> solved(scene);
      double down = 0;
      for (int axis = 0; axis < 3; ++axis) down -= solved.at(end, axis) * up[static_cast<std::size_t>(axis)];
      CHECK(within(down, tip, 1e-12));
      // The corner goes down and turns by P b a / GJ about the cantilever.
      double twist = 0;
      for (int axis = 0; axis < 3; ++axis) twist -= solved.turn(1, axis) * axes(axis, 0);
      CHECK(within(twist, P * b * a / (G * J), 1e-12));
    }
}

TEST_CASE("two beams that cross share a load as 1 / L^3") {
  constexpr double other = 4;
  BeamScene<3> scene;
  const int centre = scene.add_node({0, 0, 0});
  const taut::BeamSection<double, 3> each{E, A, I, 1e-4, 9e-6, G, {0, 0, 1}};
  const std::array<std::array<double, 3>, 4> ends{
      {{-L / 2, 0, 0}, {L / 2, 0, 0}, {0, -other / 2, 0}, {0, other / 2, 0}}};
  for (const auto& at : ends) scene.add_beam(scene.add_node(at, held_xyz), centre, each);
  scene.add_force(scene.add_load(), centre, {0, 0, -P});
  const double stiffness = 48 * EI / (L * L * L) + 48 * EI / (other * other * other);
  CHECK(within(Solved<3>(scene).at(centre, 2), -P / stiffness, 1e-13));
}

TEST_CASE("beams that are hinged at both ends are struts") {
  const auto two_bars = [](bool are_beams) {
    BeamScene<3> scene;
    scene.add_node({-3, 0, 1}, held_xyz);
    scene.add_node({2, 1, 0}, held_xyz);
    scene.add_node({0, -2, 0}, held_xyz);
    const int top = scene.add_node({0, 0, 4});
    for (int i = 0; i < 3; ++i) {
      if (are_beams)
        scene.add_beam(i, top, {E, A, I, I, I, G, {0, 0, 1}}, {true, true});
      else
        scene.add_strut(i, top, E, A);
    }
    scene.add_force(scene.add_load(), top, {P, -2 * P, 3 * P});
    return scene;
  };
  const BeamScene<3> beams = two_bars(true), struts = two_bars(false);
  const Solved<3> bent(beams), pulled(struts);
  for (int i = 0; i < 3; ++i) {
    CHECK(within(bent().beam_force(i), pulled().strut_force(i), 1e-14));
    CHECK(within(bent.at(3, i), pulled.at(3, i), 1e-14));
  }
}

TEST_CASE("forces keep their digits in a beam that is next to rigid on springs") {
  // EI / L^3 and EA / L are 1e10 times as stiff as the springs: elongations cancel in ten digits.
  constexpr double k = 1e4, stiff_EI = 1e10 * k * L * L * L, at_A = 12e10 * k * L / E;
  BeamScene<2> scene;
  const taut::BeamSection<double, 2> stiff{E, at_A, stiff_EI / E};
  for (int i = 0; i < 3; ++i) scene.add_node({L * i, 0}, i == 0 ? taut::held_x : taut::held_none);
  for (int i = 0; i < 2; ++i) scene.add_beam(i, i + 1, stiff);
  for (int i = 0; i < 3; ++i)
    scene.add_strut(scene.add_node({L * i, -2}, held_xy), i, 2 * k, 1);  // k = EA / 2 m
  scene.add_force(scene.add_load(), 2, {0, -P});
  const Solved<2> solved(scene);
  // Force method, with the middle spring for what is redundant.
  const double middle = P / (2 * k) / (1.5 / k + 8 * L * L * L / (48 * stiff_EI));
  CHECK(within(solved().strut_force(1), -middle, 1e-13));
  CHECK(within(solved().strut_force(0), middle / 2, 1e-13));
  CHECK(within(solved().strut_force(2), middle / 2 - P, 1e-13));
}

namespace {

/// A beam on two supports with a cable from end to end over the foot of a V of struts.
struct BeamString {
  static constexpr double span = 24, depth = 2.5, half_width = 2, strut_A = 3e-3;
  static constexpr double quarter = span / 4, head = span / 2 - half_width;

  BeamScene<2> scene;

  explicit BeamString(double mu = 0) {
    for (const double x : {0.0, quarter, head, span - head, span})
      scene.add_node({x, 0}, x == 0 ? held_xy : x == span ? held_y : taut::held_none);
    for (int i = 0; i < 4; ++i) scene.add_beam(i, i + 1, section);
    const int foot = scene.add_node({span / 2, -depth});
    scene.add_strut(2, foot, steel, strut_A);
    scene.add_strut(3, foot, steel, strut_A);
    scene.add_cable(steel_cable(mu, anchored), {0, foot, 4});
    scene.add_load();
  }

  /// Of the cable under P down at a quarter of the span, by the force method: with a tension of one the cable
  /// bends the beam upwards, presses it together, and its struts pull the heads apart.
  static double tension() {
    const double side = std::hypot(span / 2, depth), s = depth / side, c = span / 2 / side;
    const double strut = std::hypot(half_width, depth);
    const auto own = [&](double x) { return -s * std::fmin(std::fmin(x, head), span - x); };
    const auto load = [&](double x) { return x < quarter ? P * 0.75 * x : P * 0.25 * (span - x); };
    // Simpson's rule is exact for products of two straight lines.
    const auto integral = [&](auto f) {
      double sum = 0;
      const double ends[] = {0, quarter, head, span - head, span};
      for (int i = 0; i < 4; ++i) {
        const double from = ends[i], to = ends[i + 1];
        sum += (to - from) / 6 * (f(from) + 4 * f((from + to) / 2) + f(to));
      }
      return sum;
    };
    const double bent = integral([&](double x) { return own(x) * own(x); }) / EI;
    const double between = -c + s * half_width / depth;
    const double pressed = (c * c * 2 * head + between * between * 2 * half_width) / (E * A);
    const double struts = 2 * std::pow(s * strut / depth, 2) * strut / (steel * strut_A);
    const double cable = 2 * side / (cable_E * cable_A);
    const double gap = integral([&](double x) { return own(x) * load(x); }) / EI;
    return -gap / (bent + pressed + struts + cable);
  }
};

// A plane scene that the tracker follows, with its strut forces.
struct TrackedString {
  using Model = taut::Condensed<double, BeamCapacity>;
  using Struts = taut::CondensedStruts<double, BeamCapacity>;
  std::unique_ptr<Model> model = std::make_unique<Model>();
  std::unique_ptr<Struts> struts = std::make_unique<Struts>();
  std::unique_ptr<taut::Tracker<Model>> tracker = std::make_unique<taut::Tracker<Model>>();

  explicit TrackedString(const BeamScene<2>& scene) {
    const auto condensation = std::make_unique<taut::Condensation<double, BeamScene<2>>>();
    REQUIRE(condensation->run(scene, *model, struts.get()).ok());
    REQUIRE(tracker->start(*model).status.ok());
  }
  taut::Response<double, BeamCapacity> response() const {
    taut::Response<double, BeamCapacity> found;
    tracker->respond(found, struts.get());
    return found;
  }
};

}  // namespace

TEST_CASE("the frictionless cable under a beam has the force of the force method, wherever the load is") {
  BeamString string;
  string.scene.add_force(0, 1, {0, -P});
  TrackedString tracked(string.scene);
  taut::Sample<double, BeamCapacity> sample;
  for (const double factor : {1.0, 2.5, 0.25}) {
    sample.factor[0] = factor;
    REQUIRE(tracked.tracker->advance(sample).status.ok());
    const auto response = tracked.response();
    for (int i = 0; i < 2; ++i) CHECK(within(response.tension[i], factor * BeamString::tension(), 1e-11));
    // Both struts alike: the foot is in balance.
    const double slope = BeamString::depth / std::hypot(BeamString::half_width, BeamString::depth);
    const double sine = BeamString::depth / std::hypot(BeamString::span / 2, BeamString::depth);
    for (int i = 0; i < 2; ++i)
      CHECK(within(response.strut[i], -factor * BeamString::tension() * sine / slope, 1e-11));
  }
}

TEST_CASE("the paper's procedure finds the forces of the tracker in a cable that slides under a beam") {
  for (const bool hinged : {false, true}) {
    CAPTURE(hinged);
    // A jack at the end, friction, and a load that comes and goes.
    BeamString string(0.3);
    string.scene.cables[0].ends = jacked_end;
    string.scene.add_force(0, 1, {0, -P});
    string.scene.beams[1].hinged[0] = hinged;
    string.scene.nodes[0].held = held_xy | held_r;
    TrackedString tracked(string.scene);
    const auto stepwise = std::make_unique<taut::Stepwise<double, BeamScene<2>>>();
    REQUIRE(stepwise->start(string.scene).ok());
    taut::Sample<double, BeamCapacity> sample;
    int slides = 0;
    for (const auto& [load, jack] : {std::array<double, 2>{1, 2e4}, {1, 5e4}, {3, 5e4}, {3, 1e4}, {0, 2e4}}) {
      sample.factor[0] = load;
      sample.jack[0][1].force = jack;
      REQUIRE(tracked.tracker->advance(sample).status.ok());
      REQUIRE(stepwise->advance(sample).ok());
      const auto response = tracked.response();
      for (int i = 0; i < 2; ++i) {
        CHECK(within(stepwise->response().tension[i], response.tension[i], 1e-11));
        CHECK(within(stepwise->response().strut[i], response.strut[i], 1e-11));
      }
      slides += response.state[0] != taut::JointState::stick;
    }
    CHECK(slides > 1);
  }
}

TEST_CASE("in space the paper's procedure has beams too, and names what twists freely") {
  const taut::BeamSection<double, 3> girder{E, A, I, 1e-4, 9e-6, G, {0, 0, 1}};
  BeamScene<3> scene;
  scene.add_node({0, 0, 0}, held_xyz | held_rx);
  scene.add_node({4, 0, 0});
  scene.add_node({9, 0, 0}, taut::held_y | taut::held_z);
  const int foot = scene.add_node({4, 1, -2});
  for (int i = 0; i < 2; ++i) scene.add_beam(i, i + 1, girder);
  // A bracket below the girder, which the cable pulls askew.
  scene.add_beam(1, foot, {E, A, I, 1e-4, 9e-6, G, {1, 0, 0}});
  scene.add_cable(steel_cable(0.2, jacked_end), {0, foot, 2});
  scene.add_force(scene.add_load(), 1, {0, 500, -P});
  using Model = taut::Condensed<double, BeamCapacity>;
  const auto condensation = std::make_unique<taut::Condensation<double, BeamScene<3>>>();
  const auto model = std::make_unique<Model>();
  REQUIRE(condensation->run(scene, *model).ok());
  const auto tracker = std::make_unique<taut::Tracker<Model>>();
  REQUIRE(tracker->start(*model).status.ok());
  const auto stepwise = std::make_unique<taut::Stepwise<double, BeamScene<3>>>();
  REQUIRE(stepwise->start(scene).ok());
  taut::Sample<double, BeamCapacity> sample;
  for (const auto& [load, jack] : {std::array<double, 2>{1, 2e4}, {1, 5e4}, {3, 3e4}, {0, 1e4}}) {
    sample.factor[0] = load;
    sample.jack[0][1].force = jack;
    REQUIRE(tracker->advance(sample).status.ok());
    REQUIRE(stepwise->advance(sample).ok());
    for (int i = 0; i < 2; ++i) CHECK(within(stepwise->response().tension[i], tracker->tension(i), 1e-11));
  }

  scene.nodes[0].held = held_xyz;
  scene.cables.clear();
  scene.path.clear();
  scene.prestrain.clear();
  scene.mu.clear();
  scene.beams[2].nodes = {0, 1};
  scene.beams[2].section = girder;
  scene.nodes[foot].held = held_xyz;
  scene.nodes[1].at = {4, 0, 0};
  const taut::Status loose = stepwise->start(scene);
  CHECK(loose.code == Code::mechanism);
  CHECK(loose.place == Place::node);
  CHECK(loose.index < foot);
}

TEST_CASE("room for beams changes no bit of a scene without any") {
  const auto condensed = [](auto capacity) {
    using Cap = decltype(capacity);
    using SceneType = taut::Scene<double, 2, Cap>;
    SceneType scene;
    const int a = scene.add_node({0, 0}, held_xy), b = scene.add_node({9, 0}, held_y);
    const int c = scene.add_node({3, 0.5}), d = scene.add_node({5.5, -1.5});
    for (const auto& bar : {std::array<int, 2>{a, c}, {c, b}, {c, d}, {d, b}, {a, d}})
      scene.add_strut(bar[0], bar[1], steel, 1e-3);
    scene.add_cable(steel_cable(0.2), {a, d, b});
    scene.add_force(scene.add_load(), c, {1e3, -2e4});
    const auto condensation = std::make_unique<taut::Condensation<double, SceneType>>();
    taut::Condensed<double, Cap> made;
    REQUIRE(condensation->run(scene, made).ok());
    std::vector<double> numbers;
    for (int i = 0; i < 2; ++i) {
      for (int k = 0; k < 2; ++k) numbers.push_back(made.coupling(i, k));
      numbers.push_back(made.load[0][i]);
    }
    return numbers;
  };
  CHECK(condensed(BeamCapacity()) == condensed(NoBeams()));
}

TEST_CASE("what lets a beam turn is named: no support, or a twist that nothing holds") {
  BeamScene<2> cantilever = beam_over({0, 3, L}, {held_xy, 0, 0});
  CHECK_STATUS(taut::validate(cantilever), Code::unsupported, Place::node, 2);
  cantilever.nodes[0].held = held_xy | held_r;
  CHECK(taut::validate(cantilever).ok());
  // A rotation that is held where the beam has a hinge holds nothing.
  cantilever.beams[0].hinged[0] = true;
  CHECK_STATUS(taut::validate(cantilever), Code::unsupported, Place::node, 2);

  // Supports on a line: all is held but the twist of the beam.
  BeamScene<3> line;
  for (int i = 0; i < 3; ++i) line.add_node({3.0 * i, 0, 0}, i == 1 ? taut::held_none : held_xyz);
  for (int i = 0; i < 2; ++i) line.add_beam(i, i + 1, {E, A, I, I, I, G, {0, 0, 1}});
  CHECK(taut::validate(line).ok());
  const auto structure = std::make_unique<taut::Structure<double, BeamScene<3>>>();
  const taut::Status loose = structure->make(line);
  CHECK(loose.code == Code::mechanism);
  CHECK(loose.place == Place::node);
  line.nodes[2].held |= held_rx;
  CHECK(structure->make(line).ok());
}

TEST_CASE("beams that cannot be used are named") {
  const auto after = [](auto change) {
    BeamScene<3> scene;
    scene.add_node({0, 0, 0}, held_xyz | held_rx | held_ry | held_rz);
    scene.add_node({0, 3, 0});
    scene.add_node({0, 3, 4});
    for (int i = 0; i < 2; ++i) scene.add_beam(i, i + 1, {E, A, I, I, I, G, {1, 0, 0}});
    change(scene);
    return taut::validate(scene);
  };
  CHECK(after([](auto&) {}).ok());
  CHECK_STATUS(after([](auto& s) { s.beams[1].nodes[1] = 3; }), Code::unknown_node, Place::beam, 1, -1, 3);
  CHECK_STATUS(after([](auto& s) { s.beams[1].nodes[1] = 1; }), Code::repeated_node, Place::beam, 1, -1, 1);
  CHECK_STATUS(after([](auto& s) { s.nodes[2].at = s.nodes[1].at; }), Code::coincident_nodes, Place::beam, 1,
               -1, 2);
  const double nothing[] = {0, -1}, infinite = std::numeric_limits<double>::infinity();
  for (const double bad : nothing) {
    CHECK_STATUS(after([bad](auto& s) { s.beams[0].section.E = bad; }), Code::not_positive, Place::beam, 0);
    CHECK_STATUS(after([bad](auto& s) { s.beams[0].section.A = bad; }), Code::not_positive, Place::beam, 0);
    CHECK_STATUS(after([bad](auto& s) { s.beams[1].section.Iy = bad; }), Code::not_positive, Place::beam, 1);
    CHECK_STATUS(after([bad](auto& s) { s.beams[1].section.Iz = bad; }), Code::not_positive, Place::beam, 1);
    CHECK_STATUS(after([bad](auto& s) { s.beams[0].section.J = bad; }), Code::not_positive, Place::beam, 0);
    CHECK_STATUS(after([bad](auto& s) { s.beams[0].section.G = bad; }), Code::not_positive, Place::beam, 0);
  }
  CHECK_STATUS(after([&](auto& s) { s.beams[0].section.Iy = infinite; }), Code::not_finite, Place::beam, 0);
  CHECK_STATUS(after([&](auto& s) { s.beams[0].section.up[1] = infinite; }), Code::not_finite, Place::beam,
               0);
  // Up along the beam, or none.
  CHECK_STATUS(after([](auto& s) {
                 s.beams[1].section.up = {0, 0, -2};
               }),
               Code::out_of_range, Place::beam, 1);
  CHECK_STATUS(after([](auto& s) { s.beams[0].section.up = {0, 0, 0}; }), Code::out_of_range, Place::beam, 0);
  CHECK(after([](auto& s) { s.beams[1].section.up = {0, 1e-5, -2}; }).ok());

  // In the plane z cannot be held, nor rotations about the axes; and no rotation without room for beams.
  for (const int held : {+taut::held_z, +held_rx, +held_ry}) {
    BeamScene<2> plane = beam_over({0, L}, {held_xy | held_r, held});
    CHECK_STATUS(taut::validate(plane), Code::out_of_range, Place::node, 1);
  }
  CHECK_STATUS(taut::validate(beam_over({0, L}, {held_xy | held_r, 64})), Code::out_of_range, Place::node, 1);
  taut::Scene<double, 2, NoBeams> without;
  without.add_node({0, 0}, held_xy | held_r);
  CHECK_STATUS(taut::validate(without), Code::out_of_range, Place::node, 0);

  BeamScene<2> many = beam_over({0, L}, {held_xy | held_r, 0});
  for (int i = 0; i < 14; ++i) many.add_beam(0, 1, section);
  CHECK_STATUS(taut::validate(many), Code::capacity_exceeded, Place::beam, 12, -1, 3);
}

}  // namespace beam_structures_test
