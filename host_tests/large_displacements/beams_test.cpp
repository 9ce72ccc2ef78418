// Corotational beams against the elastica and Euler's load.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "large_displacements/path.hpp"

namespace beams_test {
using namespace large_displacements;

namespace {

const double pi = std::acos(-1.0);
constexpr double length = 4, EI = 3e5;

/// A straight chain of beams of `length` from the origin along `axis`.
Model chain(int dimension, const Vector& axis, const char* first_held, const char* last_held, double EA) {
  Model model;
  model.dimension = dimension;
  Beam beam;
  for (int i = 0; i <= 20; ++i)
    beam.nodes.push_back(model.add_node(std::to_string(i), axis * (length * i / 20),
                                        i == 0    ? first_held
                                        : i == 20 ? last_held
                                                  : ""));
  beam.E = 2e11;
  beam.A = EA / beam.E;
  beam.Iz = EI / beam.E;
  beam.Iy = 4 * beam.Iz;
  beam.J = beam.Iz;
  beam.up = Vector(0, 0, 1);
  model.beams.push_back(beam);
  model.loads.emplace_back();
  return model;
}
Row loaded(double factor) {
  Row row;
  row.factors = {factor};
  return row;
}

}  // namespace

TEST_CASE("a cantilever with a moment at its end is rolled up to a circle") {
  Model model = chain(2, {1, 0, 0}, "xyr", "", 1e10);
  model.loads[0].forces.push_back({20, Vector::Zero(), Vector(0, 0, 2 * pi * EI / length)});
  Path path(model, 100);
  path.equilibrium.step_limit = 1;
  REQUIRE(path.advance(loaded(.5)));
  // Half a circle of radius length / pi.
  CHECK(std::fabs(path.moved(20).x() + length) < 1e-5 * length);
  CHECK(std::fabs(path.moved(20).y() - 2 * length / pi) < 1e-5 * length);
  REQUIRE(path.advance(loaded(1)));
  CHECK(std::fabs(path.moved(20).x() + length) < 1e-8 * length);
  CHECK(std::fabs(path.moved(20).y()) < 1e-8 * length);
  CHECK(std::fabs(path.equilibrium.rotation(path.state, 20).z() - 2 * pi) < 1e-8);
  CHECK(path.stability() > 0);
}

TEST_CASE("a cantilever with a load across its end follows the elastica") {
  struct Elastica {  // Mattiasson, Numerical results from large deflection beam and frame problems (1981)
    double load, along, across, slope;
  };
  const Vector axis = Vector(2, 1, .5).normalized();
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Vector x = dimension == 2 ? Vector(1, 0, 0) : axis;
    Model model = chain(dimension, x, dimension == 2 ? "x y r" : "x y z rx ry rz", "", 1e11);
    const Vector y = Vector(0, 0, 1).cross(x).normalized();  // bends about local z, which `up` gives
    model.loads[0].forces.push_back({20, y * (EI / (length * length)), Vector::Zero()});
    Path path(model, 20);
    path.equilibrium.step_limit = 1;
    for (const Elastica& e : {Elastica{1, .05643, .30172, .46135}, Elastica{2, .16064, .49346, .78175},
                              Elastica{5, .38763, .71379, 1.21537}, Elastica{10, .55500, .81061, 1.43029}}) {
      CAPTURE(e.load);
      REQUIRE(path.advance(loaded(e.load)));
      CHECK(std::fabs(-path.moved(20).dot(x) / length - e.along) < 1.5e-5);
      CHECK(std::fabs(path.moved(20).dot(y) / length - e.across) < 1.5e-5);
      CHECK(std::fabs(path.equilibrium.rotation(path.state, 20).dot(x.cross(y)) - e.slope) < 2.5e-5);
    }
  }
}

TEST_CASE("a pinned bar has no stable equilibrium beyond Euler's load, in space that of its weaker axis") {
  const double euler = pi * pi * EI / (length * length);
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    Model model =
        chain(dimension, {1, 0, 0}, dimension == 2 ? "x y" : "x y z rx", dimension == 2 ? "y" : "y z", 1e12);
    model.loads[0].forces.push_back({20, Vector(-euler, 0, 0), Vector::Zero()});
    Path path(model);
    const Reached reached = path.advance(loaded(2));
    CHECK_FALSE(reached);
    CHECK(std::fabs(2 * reached.part - 1) < 5e-6);
    CHECK(std::fabs(2 * reached.refused - 1) < 5e-6);
  }
}

TEST_CASE("a beam bends about the axis that `up` says") {
  // The second axis has four times the stiffness: w = P L^3 / 3 E I.
  Model model = chain(3, {1, 0, 0}, "x y z rx ry rz", "", 1e12);
  const double P = 1e-5 * EI / (length * length);
  model.loads[0].forces.push_back({20, Vector(0, P, P), Vector::Zero()});
  Path path(model);
  REQUIRE(path.advance(loaded(1)));
  const double bent = P * length * length * length / (3 * EI);
  CHECK(std::fabs(path.moved(20).y() / bent - 1) < 1e-8);
  CHECK(std::fabs(path.moved(20).z() / (bent / 4) - 1) < 1e-8);
}

TEST_CASE("a hinge passes on no moment") {
  // Two cantilevers, from both sides, joined by a hinge in the middle: each carries half of the load.
  Model model;
  for (int i = 0; i <= 2; ++i) model.add_node(std::to_string(i), {i * length, 0, 0}, i == 1 ? "" : "x y r");
  for (int i = 0; i < 2; ++i) {
    Beam beam;
    beam.nodes = {i, i + 1};
    beam.E = 2e11;
    beam.A = 1;
    beam.Iz = EI / beam.E;
    if (i == 1) beam.hinges = {1};
    model.beams.push_back(beam);
  }
  const double P = 1e-6 * EI / (length * length);
  model.loads.emplace_back();
  model.loads[0].forces.push_back({1, Vector(0, -P, 0), Vector::Zero()});
  Path path(model);
  REQUIRE(path.advance(loaded(1)));
  const double bent = P / 2 * length * length * length / (3 * EI);
  CHECK(std::fabs(-path.moved(1).y() / bent - 1) < 1e-6);
  CHECK(std::fabs(path.equilibrium.rotation(path.state, 1).z() + 1.5 * bent / length) < 1e-6 * bent);
}

}  // namespace beams_test
