// What friction, equilibrium and symmetry ask of cables over several joints.
#include <doctest/doctest.h>

#include <cmath>

#include "large_displacements/path.hpp"

namespace friction_test {
using namespace large_displacements;

namespace {

const double pi = std::acos(-1.0);

Cable steel_cable(std::vector<int> path, double mu, bool closed = false) {
  Cable cable;
  cable.name = "C";
  cable.path = std::move(path);
  cable.E = 1.6e11;
  cable.A = 5e-3;
  cable.closed = closed;
  if (!closed) cable.jacked = {false, true};
  cable.mu.assign(cable.joints(), mu);
  cable.prestrain.assign(cable.segments(), 0);
  return cable;
}

/// A cable around an arc: every joint hangs from a strut along the bisector, or is rigid.
Model arc(int joints, double mu, bool rigid, const Eigen::Matrix3d& turned = Eigen::Matrix3d::Identity()) {
  Model model;
  model.dimension = turned.isIdentity() || turned(2, 2) == 1 ? 2 : 3;
  const char* const all = model.dimension == 2 ? "xy" : "xyz";
  std::vector<int> path;
  for (int i = 0; i <= joints + 1; ++i) {
    const double angle = (i - (joints + 1) / 2.0) * 0.05;
    const Vector at(100 * std::sin(angle), -100 * std::cos(angle), 0);
    const bool end = i == 0 || i == joints + 1;
    path.push_back(model.add_node("p" + std::to_string(i), turned * at, end || rigid ? all : ""));
    if (end || rigid) continue;
    const int top = model.add_node("t" + std::to_string(i), turned * (at * 0.96), all);
    model.struts.push_back({path.back(), top, 2e11, 4e-3});
    if (model.dimension == 3) {
      // Across the plane the foot is held by a spring.
      const Vector normal = turned.col(2);
      model.substructures.push_back({"across", {path.back()}, 1e8 * normal * normal.transpose()});
    }
  }
  model.cables.push_back(steel_cable(path, mu));
  return model;
}
Row jack(double force, bool locked = false) {
  Row row;
  row.jacks.resize(1);
  row.jacks[0][1] = {force, locked};
  return row;
}

/// Each joint: ratio of tensions where it slides, and equilibrium across its strut with the present angles.
void check_joints(const Path& path, bool pinned) {
  const Model& model = path.equilibrium.model();
  const Cable& cable = model.cables[0];
  for (int j = 0; j < cable.joints(); ++j) {
    CAPTURE(j);
    const double before = path.T(0, j), behind = path.T(0, j + 1), rho = path.friction(0, j).rho;
    if (path.mode(0, j) == Mode::forward) CHECK(std::fabs(before - rho * behind) < 1e-8 * behind);
    if (path.mode(0, j) == Mode::backward) CHECK(std::fabs(behind - rho * before) < 1e-8 * before);
    CHECK(before >= rho * behind - 1e-8 * behind);
    CHECK(behind >= rho * before - 1e-8 * before);
    if (!pinned) continue;
    const auto at = [&](int node) { return path.equilibrium.position(path.state, node); };
    const Vector foot = at(cable.on_path(j + 1));
    const Vector e1 = (at(cable.on_path(j)) - foot).normalized();
    const Vector e2 = (at(cable.on_path(j + 2)) - foot).normalized();
    const Vector strut = (at(model.struts[j].b) - foot).normalized();
    const Vector bisector = (e1 + e2).normalized(), forward = (e2 - e1).normalized();
    const double tan_lean = strut.dot(forward) / strut.dot(bisector);
    // Positive where the foot leans back from the jack.
    const double cot = path.friction(0, j).cot;
    CHECK(std::fabs((before - behind) / (before + behind) + cot * tan_lean) < 1e-9);
  }
}

}  // namespace

TEST_CASE(
    "over rigid saddles the jack's force falls by the ratio of every joint, and the release turns it round") {
  for (const Law law : {Law::point, Law::capstan}) {
    Model model = arc(7, 0.2, true);
    model.cables[0].law = law;
    Path path(model);
    const double F = 2e6, angle = 0.05;
    const double kappa = 0.2 * std::tan(angle / 2);
    const double rho = law == Law::point ? (1 - kappa) / (1 + kappa) : std::exp(-0.2 * angle);
    REQUIRE(path.advance(jack(F)));
    for (int i = 0; i <= 7; ++i) CHECK(std::fabs(path.T(0, i) / (F * std::pow(rho, 7 - i)) - 1) < 1e-9);
    // Let out by less than twice the friction of three joints: these have turned, the others hold what they
    // have.
    const double let_out = F * std::pow(rho, 5);
    REQUIRE(path.advance(jack(let_out)));
    for (int i = 0; i <= 7; ++i) {
      const double pulled = F * std::pow(rho, 7 - i), let = let_out * std::pow(rho, i - 7);
      CHECK(std::fabs(path.T(0, i) / std::min(pulled, let) - 1) < 1e-9);
    }
  }
}

TEST_CASE(
    "pinned struts: the ratio of tensions is what the lean to the bisector makes of it, and slides on its "
    "cone") {
  for (const double mu : {.03, .1, .3}) {
    CAPTURE(mu);
    Model model = arc(6, mu, false);
    Path path(model, 20);
    for (const double F : {2e5, 5e5, 1e6, 2e6, 1.9e6, 1.5e6}) {
      CAPTURE(F);
      const Reached reached = path.advance(jack(F));
      if (!reached) break;  // runs away
      check_joints(path, true);
      CHECK(path.equilibrium.imbalance(path.state, path.inputs) < 1e-8);
      CHECK(path.stability() > 0);
    }
    CHECK(path.T(0, 6) > 0);
  }
}

TEST_CASE("a hoop draws the nodes of a regular polygon inwards alike") {
  const int n = 8;
  const double R = 20, prestrain = 3e-3, EA_bar = 2e11 * 1e-3, bar = 10;
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    Model model;
    model.dimension = dimension;
    std::vector<int> path_nodes;
    for (int i = 0; i < n; ++i) {
      const Vector out(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0);
      path_nodes.push_back(model.add_node("p" + std::to_string(i), R * out));
      const int support =
          model.add_node("s" + std::to_string(i), (R + bar) * out, dimension == 2 ? "xy" : "xyz");
      model.struts.push_back({path_nodes.back(), support, 2e11, 1e-3});
    }
    model.cables.push_back(steel_cable(path_nodes, .1, true));
    model.cables[0].prestrain.assign(n, prestrain);
    Path path(model);
    REQUIRE(path.started);
    // The radius R - w: T = EA (prestrain - w / R), the bar's force 2 T sin(pi / n) = EA_bar w / bar.
    const double EA = 1.6e11 * 5e-3, s = 2 * std::sin(pi / n);
    const double T = EA * prestrain / (1 + EA * s * bar / (EA_bar * R));
    for (int i = 0; i < n; ++i) {
      CHECK(std::fabs(path.T(0, i) / T - 1) < 1e-9);
      CHECK(std::fabs(path.strut(i) / (T * s) - 1) < 1e-9);
      CHECK(std::fabs(path.moved(path_nodes[i]).norm() - T * s * bar / EA_bar) < 1e-9);
      CHECK(path.slip(0, i) == doctest::Approx(0).epsilon(1e-12));
    }
  }
}

TEST_CASE("a scene that is turned, mirrored or carried into space has the same forces") {
  const auto forces = [](const Model& model) {
    Path path(model);
    std::vector<double> found;
    for (const double F : {3e5, 6e5, 5.5e5}) {
      REQUIRE(path.advance(jack(F)));
      for (int i = 0; i <= 5; ++i) found.push_back(path.T(0, i));
      for (int s = 0; s < 5; ++s) found.push_back(path.strut(s));
      for (int j = 0; j < 5; ++j) found.push_back(1e6 * path.slip(0, j));
      found.push_back(1e6 * path.extension(0, 1));
    }
    return found;
  };
  const auto expected = forces(arc(5, .1, false));
  const Eigen::Matrix3d in_plane = Eigen::AngleAxisd(.7, Vector::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d mirrored = Vector(-1, 1, 1).asDiagonal();
  const Eigen::Matrix3d in_space = Eigen::AngleAxisd(1.1, Vector(1, 2, 3).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& turned : {in_plane, mirrored, in_space}) {
    const auto found = forces(arc(5, .1, false, turned));
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::fabs(found[i] - expected[i]) < 1e-6 * 6e5);
  }
}

TEST_CASE(
    "a locked end keeps its extension less the seating, and takes its force from there when it is unlocked") {
  Model model = arc(3, .1, true);
  model.cables[0].seating = .006;
  Path path(model);
  REQUIRE(path.advance(jack(1e6)));
  const double extension = path.extension(0, 1), before = path.T(0, 3);
  REQUIRE(path.advance(jack(1e6, true)));
  CHECK(std::fabs(path.extension(0, 1) - (extension - .006)) < 1e-15);
  CHECK(path.T(0, 3) < before);
  const double seated = path.T(0, 3);
  REQUIRE(path.advance(jack(0, true)));
  CHECK(std::fabs(path.T(0, 3) - seated) < 1e-9 * seated);
  REQUIRE(path.advance(jack(1.1e6)));
  CHECK(std::fabs(path.T(0, 3) - 1.1e6) < 1e-3);
}

TEST_CASE("a cable that is let out goes slack as a whole, and is tight again where it was") {
  Model model = arc(3, .1, true);
  model.cables[0].alpha = 1.2e-5;
  model.loads.emplace_back();
  model.loads[0].temperatures.push_back({0, 1});
  Path path(model);
  const auto row = [&](double kelvin) {
    Row r = jack(1e6, true);
    r.factors = {kelvin};
    return r;
  };
  Row pulled = jack(1e6);
  pulled.factors = {0};
  REQUIRE(path.advance(pulled));
  REQUIRE(path.advance(row(0)));
  double strain = 0;
  for (int i = 0; i <= 3; ++i) strain += path.T(0, i) / 4 / 8e8;
  REQUIRE(path.advance(row(1.5 * strain / 1.2e-5)));
  for (int i = 0; i <= 3; ++i) CHECK(path.T(0, i) == 0);
  REQUIRE(path.advance(row(0)));
  double again = 0;
  for (int i = 0; i <= 3; ++i) again += path.T(0, i) / 4 / 8e8;
  CHECK(std::fabs(again / strain - 1) < 1e-9);
}

}  // namespace friction_test
