// Section 4.3: the four cases of Table 5 on a truss string structure.
//
// The structure is our own (Fig. 15 is not available); every force is compared with a plain stiffness
// solution of the same bars in which the cable is no sliding cable.
#include <Eigen/Dense>

#include "checks.hpp"

namespace truss_string_test {
namespace {

using namespace paper;

constexpr int displacements = 2 * TrussCapacity::nodes;
constexpr double EA = E_steel * A_members;

/// The truss and its struts as plain bars, without the cable.
class PlainTruss {
 public:
  using Vector = Eigen::Matrix<double, displacements, 1>;

  explicit PlainTruss(const TrussScene& scene) : scene_(scene) {
    K_.setZero();
    loads_.setZero();
    for (const auto& strut : scene.struts) add_bar(strut.nodes[0], strut.nodes[1]);
    for (const auto& given : scene.forces) {
      loads_[2 * given.node] += given.force[0];
      loads_[2 * given.node + 1] += given.force[1];
    }
  }

  double length(int a, int b) const { return (position(b) - position(a)).norm(); }
  std::array<int, 2> segment(int i) const { return scene_.segment_nodes(scene_.cables[0], i); }

  /// Elongation of the line between two nodes, a unit of displacement.
  Vector elongation(int a, int b) const {
    const Eigen::Vector2d e = (position(b) - position(a)) / length(a, b);
    Vector g = Vector::Zero();
    g.segment<2>(2 * a) = -e;
    g.segment<2>(2 * b) = e;
    return g;
  }

  void add_bar(int a, int b) { add_stiffness(elongation(a, b), EA / length(a, b)); }
  void add_stiffness(const Vector& g, double stiffness) { K_ += stiffness * g * g.transpose(); }
  /// A force of known size along the line between two nodes, tension positive.
  void add_tension(int a, int b, double tension) { loads_ -= tension * elongation(a, b); }

  Vector solve() const {
    auto K = K_;
    auto p = loads_;
    for (int node = 0; node < scene_.nodes.size(); ++node)
      for (int axis = 0; axis < 2; ++axis) {
        if (!scene_.nodes[node].is_held(axis)) continue;
        const int i = 2 * node + axis;
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = EA;
        p[i] = 0;
      }
    return K.fullPivLu().solve(p);
  }
  double bar_force(const Vector& u, int a, int b) const {
    return EA / length(a, b) * elongation(a, b).dot(u);
  }

 private:
  Eigen::Vector2d position(int node) const { return {scene_.nodes[node].at[0], scene_.nodes[node].at[1]}; }

  const TrussScene& scene_;
  Eigen::Matrix<double, displacements, displacements> K_;
  Vector loads_;
};

struct TrussForces {
  std::array<double, 5> cable{};
  std::array<double, 31> struts{};
};

void take_struts(const PlainTruss& truss, const TrussScene& scene, const PlainTruss::Vector& u,
                 TrussForces& forces) {
  for (int i = 0; i < scene.struts.size(); ++i)
    forces.struts[static_cast<std::size_t>(i)] =
        truss.bar_force(u, scene.struts[i].nodes[0], scene.struts[i].nodes[1]);
}

/// One member over the whole path: the same force everywhere, stretched by the sum of all elongations.
TrussForces with_one_long_member(const TrussScene& scene) {
  PlainTruss truss(scene);
  PlainTruss::Vector path = PlainTruss::Vector::Zero();
  double length = 0;
  for (int i = 0; i < 5; ++i) {
    const auto ends = truss.segment(i);
    path += truss.elongation(ends[0], ends[1]);
    length += truss.length(ends[0], ends[1]);
  }
  truss.add_stiffness(path, EA / length);
  const auto u = truss.solve();
  TrussForces forces;
  forces.cable.fill(EA / length * path.dot(u));
  take_struts(truss, scene, u, forces);
  return forces;
}

/// The discontinuous model: every segment a bar between its nodes.
TrussForces with_separate_bars(const TrussScene& scene) {
  PlainTruss truss(scene);
  for (int i = 0; i < 5; ++i) truss.add_bar(truss.segment(i)[0], truss.segment(i)[1]);
  const auto u = truss.solve();
  TrussForces forces;
  for (int i = 0; i < 5; ++i)
    forces.cable[static_cast<std::size_t>(i)] = truss.bar_force(u, truss.segment(i)[0], truss.segment(i)[1]);
  take_struts(truss, scene, u, forces);
  return forces;
}

/// Segment by segment a known force: that of the jack, less what every joint on the way holds back.
TrussForces with_known_cable_forces(const TrussScene& scene, double jack, double mu) {
  PlainTruss truss(scene);
  TrussForces forces;
  forces.cable[4] = jack;
  for (int j = 3; j >= 0; --j) {
    const auto i = static_cast<std::size_t>(j);
    forces.cable[i] = forces.cable[i + 1] * slid_ratio(mu, truss_alpha(j));
  }
  for (int i = 0; i < 5; ++i)
    truss.add_tension(truss.segment(i)[0], truss.segment(i)[1], forces.cable[static_cast<std::size_t>(i)]);
  take_struts(truss, scene, truss.solve(), forces);
  return forces;
}

using Found = taut::Response<double, TrussCapacity>;

template <class Scalar>
void check_all_forces(const TrussCase& given, const TrussForces& expected, double tolerance) {
  const auto found = checked_answer<Scalar>(given.scene(), given.drive());
  double size = 0;
  for (const double T : expected.cable) size = std::max(size, std::fabs(T));
  for (const double S : expected.struts) size = std::max(size, std::fabs(S));
  for (int i = 0; i < 5; ++i) {
    CAPTURE(i);
    CHECK(close(static_cast<double>(found.tension[i]), expected.cable[static_cast<std::size_t>(i)], tolerance,
                size));
  }
  for (int i = 0; i < 31; ++i) {
    CAPTURE(i);
    CHECK(close(static_cast<double>(found.strut[i]), expected.struts[static_cast<std::size_t>(i)], tolerance,
                size));
  }
}

void check_all_forces(const TrussCase& given, const TrussForces& expected) {
  check_all_forces<double>(given, expected, 1e-10);
  check_all_forces<float>(given, expected, 1e-5);
}

Found forces_of(const TrussCase& given) { return checked_answer<double>(given.scene(), given.drive()); }

/// The node that a node changes places with when left and right are swapped.
int mirrored(int node) {
  if (node < top(0)) return bottom(bottom_nodes - 1 - node);
  if (node < lower(0)) return top(top_nodes - 1 - (node - top(0)));
  return lower(lower_nodes - 1 - (node - lower(0)));
}

int strut_between(const TrussScene& scene, int a, int b) {
  for (int i = 0; i < scene.struts.size(); ++i) {
    const auto& nodes = scene.struts[i].nodes;
    if ((nodes[0] == a && nodes[1] == b) || (nodes[0] == b && nodes[1] == a)) return i;
  }
  return -1;
}

/// The largest difference of a force to that of its mirror image [N].
double asymmetry(const TrussScene& scene, const Found& found) {
  double most = 0;
  for (int i = 0; i < 5; ++i) most = std::max(most, std::fabs(found.tension[i] - found.tension[4 - i]));
  for (int i = 0; i < scene.struts.size(); ++i) {
    const auto& nodes = scene.struts[i].nodes;
    const int image = strut_between(scene, mirrored(nodes[0]), mirrored(nodes[1]));
    REQUIRE(image >= 0);
    most = std::max(most, std::fabs(found.strut[i] - found.strut[image]));
  }
  return most;
}

TEST_CASE("case 1: without friction all segments of the anchored cable carry the same force") {
  const Found found = forces_of(table_5[0]);
  for (int i = 1; i < 5; ++i) CHECK(close(found.tension[i], found.tension[0], 1e-12));
}

TEST_CASE("case 1: without friction the cable is one long member of a plain stiffness solution") {
  check_all_forces(table_5[0], with_one_long_member(table_5[0].scene()));
}

TEST_CASE(
    "case 2: with joints that hold, the cable is a row of separate bars of a plain stiffness solution") {
  check_all_forces(table_5[1], with_separate_bars(table_5[1].scene()));
  const Found found = forces_of(table_5[1]);
  for (int j = 0; j < lower_nodes; ++j) CHECK(found.state[j] == taut::JointState::stick);
}

TEST_CASE("case 2: the discontinuous model makes the cable forces uneven") {
  const Found separate = forces_of(table_5[1]);
  CHECK(separate.tension[2] > 1.1 * separate.tension[0]);
}

TEST_CASE("case 3: all joints slide to the jack and the force falls away from it by Eq. (43) at each") {
  const Found found = forces_of(table_5[2]);
  for (int j = 0; j < lower_nodes; ++j) {
    CAPTURE(j);
    CHECK(found.state[j] == taut::JointState::forward);
    CHECK(found.tension[j] < found.tension[j + 1]);
    CHECK(close(found.tension[j] / found.tension[j + 1], slid_ratio(0.2, truss_alpha(j)), 1e-12));
  }
}

TEST_CASE("cases 3 and 4: the bars carry what statics asks of them under the cable forces by Eq. (43)") {
  for (std::size_t i = 2; i < 4; ++i) {
    CAPTURE(table_5[i].name);
    const TrussCase& given = table_5[i];
    check_all_forces(given, with_known_cable_forces(given.scene(), given.F, given.mu));
  }
}

TEST_CASE("case 4: a jack at one end of a frictionless cable leaves the structure as symmetric as it is") {
  CHECK(asymmetry(table_5[3].scene(), forces_of(table_5[3])) < 1e-11 * table_5[3].F);
}

TEST_CASE("cases 1 and 2: under a symmetric load the anchored cable leaves the structure symmetric") {
  for (std::size_t i = 0; i < 2; ++i) {
    const Found found = forces_of(table_5[i]);
    CHECK(asymmetry(table_5[i].scene(), found) < 1e-11 * found.tension[2]);
  }
}

TEST_CASE("case 3: friction makes the structure asymmetric") {
  CHECK(asymmetry(table_5[2].scene(), forces_of(table_5[2])) > 1000);
}

/// Compression that the two struts of a lower node take up to the truss, vertically [N].
double push(const TrussScene& scene, const Found& found, int node) {
  double upwards = 0;
  for (int leg = 0; leg < 2; ++leg) {
    const int i = first_v_strut + 2 * node + leg;
    const auto& ends = scene.struts[i].nodes;
    const auto& foot = scene.nodes[ends[0]].at;
    const auto& head = scene.nodes[ends[1]].at;
    upwards -= found.strut[i] * (head[1] - foot[1]) / std::hypot(head[0] - foot[0], head[1] - foot[1]);
  }
  return upwards;
}

TEST_CASE("friction lowers the normal pressure at every joint and the push of all struts together") {
  const TrussScene scene = table_5[2].scene();
  const Found with = forces_of(table_5[2]), without = forces_of(table_5[3]);
  double sum_with = 0, sum_without = 0;
  for (int node = 0; node < lower_nodes; ++node) {
    CAPTURE(node);
    CHECK(with.contact[node] < 0.99 * without.contact[node]);
    sum_with += push(scene, with, node);
    sum_without += push(scene, without, node);
  }
  // What the cable pulls down at both ends: by its slope of 1 in 2, once with the force of the jack.
  const double sine = std::sin(std::atan(0.5));
  CHECK(close(sum_without, 2 * 20000 * sine, 1e-11));
  CHECK(close(sum_with, (20000 + with.tension[0]) * sine, 1e-11));
  CHECK(sum_with < 0.95 * sum_without);
}

TEST_CASE("friction does not lower the push of every single node: the last one before the jack pushes more") {
  const TrussScene scene = table_5[2].scene();
  const double steep = std::sin(std::atan(0.5)), flat = std::sin(std::atan(0.25));
  const double with = push(scene, forces_of(table_5[2]), 3), without = push(scene, forces_of(table_5[3]), 3);
  CHECK(close(without, 20000 * (steep - flat), 1e-11));
  CHECK(close(with, 20000 * (steep - slid_ratio(0.2, truss_alpha(3)) * flat), 1e-11));
  CHECK(with > without);
  for (int node = 0; node < 3; ++node) {
    CAPTURE(node);
    CHECK(push(scene, forces_of(table_5[2]), node) < push(scene, forces_of(table_5[3]), node));
  }
}

TEST_CASE("loads and jack that grow together lead to the same forces in one load step and in sixteen") {
  for (const TrussCase& given : table_5) {
    CAPTURE(given.name);
    const auto once = checked_answer<double>(given.scene(), given.drive());
    const auto often = checked_answer<double>(given.scene(), given.drive(), 16);
    for (int i = 0; i < 5; ++i) CHECK(close(often.tension[i], once.tension[i], 1e-11, 20000));
    for (int i = 0; i < 31; ++i) CHECK(close(often.strut[i], once.strut[i], 1e-11, 20000));
  }
}

}  // namespace

}  // namespace truss_string_test
