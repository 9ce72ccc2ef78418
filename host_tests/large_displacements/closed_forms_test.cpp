// Cables over one joint, against closed forms at large displacements.
#include <doctest/doctest.h>

#include <cmath>

#include "large_displacements/path.hpp"

namespace closed_forms_test {
using namespace large_displacements;

namespace {

constexpr double EA = 8e8;

Cable jacked_cable(double mu, std::vector<int> path) {
  Cable cable;
  cable.name = "C";
  cable.path = std::move(path);
  cable.E = 2e11;
  cable.A = EA / 2e11;
  cable.jacked = {false, true};
  cable.mu.assign(cable.joints(), mu);
  cable.prestrain.assign(cable.segments(), 0);
  return cable;
}

/// A strut that hangs from a pin, the cable under it.
Model leaning_strut(double mu) {
  Model model;
  const int left = model.add_node("l", {-10, .5, 0}, "xy"), foot = model.add_node("p", {0, 0, 0});
  const int right = model.add_node("r", {10, .5, 0}, "xy"), top = model.add_node("t", {0, 2, 0}, "xy");
  model.struts.push_back({foot, top, 2e13, 1});
  model.cables.push_back(jacked_cable(mu, {left, foot, right}));
  return model;
}

/// A joint that is guided up and down, with a load on it.
Model guided_joint(double mu) {
  Model model;
  const int left = model.add_node("l", {-10, 0, 0}, "xy"), joint = model.add_node("p", {0, -1, 0}, "x");
  const int right = model.add_node("r", {10, 0, 0}, "xy");
  model.cables.push_back(jacked_cable(mu, {left, joint, right}));
  model.loads.emplace_back();
  model.loads[0].forces.push_back({joint, Vector(0, -2e5, 0)});
  return model;
}

Row at(const Model& model, double force, double factor = 0) {
  Row row;
  row.factors.assign(model.loads.size(), factor);
  row.jacks.resize(model.cables.size());
  row.jacks[0][1].force = force;
  return row;
}
bool near(double value, double expected, double within) { return std::fabs(value - expected) <= within; }

}  // namespace

TEST_CASE("a pinned strut leans towards the jack, and the far segment has more tension than the jack") {
  struct Rounded {
    double lean, F, T1, strut, extension;
  };
  for (const Rounded& e : {Rounded{.005, 797508, 797903, -79668, .0199501},
                           Rounded{.0125, 1991880, 1994345, -199017, .0497816}}) {
    CAPTURE(e.lean);
    // The foot goes along its arc; the far segment has not slipped, and balance across the strut gives the
    // jack.
    const double x = 2 * std::sin(e.lean), y = 2 - 2 * std::cos(e.lean), distance = std::sqrt(100.25);
    const Vector e1(-10 - x, .5 - y, 0), e2(10 - x, .5 - y, 0);
    const Vector across(std::cos(e.lean), std::sin(e.lean), 0), along(-std::sin(e.lean), std::cos(e.lean), 0);
    const double T1 = EA * (e1.norm() - distance) / distance;
    const double F = -T1 * e1.normalized().dot(across) / e2.normalized().dot(across);
    const double strut = -(T1 * e1.normalized() + F * e2.normalized()).dot(along);
    const double extension = distance - e2.norm() / (1 + F / EA);
    CHECK(near(F, e.F, 1));

    Model model = leaning_strut(.1);
    model.reference_length = ReferenceLength::present;
    Path path(model);
    REQUIRE(path.advance(at(model, F)));
    const Vector foot = path.equilibrium.position(path.state, 1);
    // The strut gets shorter by 2e-8 m, which the closed form leaves out.
    CHECK(near(std::atan2(foot.x(), 2 - foot.y()), e.lean, 1e-9));
    CHECK(near(path.T(0, 0), T1, .05));
    CHECK(near(path.T(0, 0), e.T1, .6));
    CHECK(near(path.T(0, 1), F, 1e-3));
    CHECK(near(path.strut(0), strut, .05));
    CHECK(near(path.strut(0), e.strut, .6));
    CHECK(near(path.extension(0, 1), extension, 4e-9));
    CHECK(near(path.extension(0, 1), e.extension, 6e-8));
    CHECK(path.mode(0, 0) == Mode::stick);
    CHECK(path.slip(0, 0) == 0);
    CHECK(path.stability() > 0);
  }
}

TEST_CASE("with little friction a pinned strut runs away, at the load of the limit point") {
  struct Limit {
    double mu, F;
  };
  for (const Limit& limit : {Limit{.005, 805531}, Limit{.01, 1609993}}) {
    CAPTURE(limit.mu);
    Model model = leaning_strut(limit.mu);
    Path path(model);
    const double target = 2e6;
    const Reached reached = path.advance(at(model, target));
    CHECK_FALSE(reached);
    CHECK(near(reached.part * target, limit.F, 2));
    CHECK(reached.refused - reached.part < 1e-7);
    // It sticks up to there: to slide is to run away. Then friction is used up by the lean to the bisector.
    const auto& now = path.state;
    const Vector foot = path.equilibrium.position(now, 1);
    const Vector e1 = (path.equilibrium.position(now, 0) - foot).normalized();
    const Vector e2 = (path.equilibrium.position(now, 2) - foot).normalized();
    const Vector bisector = (e1 + e2).normalized(), strut = (Vector(0, 2, 0) - foot).normalized();
    CHECK(path.slip(0, 0) == 0);
    CHECK(near(bisector.cross(strut).norm() / bisector.dot(strut), limit.mu, 1e-6 * limit.mu));
  }
}

TEST_CASE("a guided joint rises as equilibrium with friction at the present angle has it") {
  struct Expected {
    double mu, F, y, T1, extension;
  };
  for (const Expected& e : {Expected{.1, 1.05e6, .9660582, 1029906.9, .0327271},
                            Expected{.3, 1.1e6, .9388046, 1039736.2, .0386376},
                            Expected{.1, 1.3e6, .7775518, 1279939.6, .0716782}}) {
    CAPTURE(e.F);
    Model model = guided_joint(e.mu);
    model.reference_length = ReferenceLength::present;
    Path path(model);
    REQUIRE(path.advance(at(model, 9e5, 1)));
    REQUIRE(path.advance(at(model, e.F, 1)));
    CHECK(near(-path.equilibrium.position(path.state, 1).y(), e.y, 6e-8));
    CHECK(near(path.T(0, 0), e.T1, .06));
    CHECK(near(path.extension(0, 1), e.extension, 6e-8));
  }
}

TEST_CASE("between two jacks a pinned strut is unstable beyond what a spring at its foot can hold") {
  // With both forces kept, the cable's pull on the foot turns back less than the strut's push turns away.
  const double spring = 2e4, l = std::sqrt(100.25), sine = .5 / l, h = 2;
  const double limit = spring / (2 * sine * (1 / h - sine / l));
  Model model = leaning_strut(.1);
  model.cables[0].jacked = {true, true};
  model.substructures.push_back({"spring", {1}, Vector(spring, 0, 0).head(2).asDiagonal()});
  Row row = at(model, 2 * limit);
  row.jacks[0][0].force = 2 * limit;
  Path path(model);
  const Reached reached = path.advance(row);
  CHECK_FALSE(reached);
  CHECK(near(2 * reached.part, 1, 1e-5));
  CHECK(path.stability() > 0);
  CHECK(path.stability() < 1e-6);
}

}  // namespace closed_forms_test
