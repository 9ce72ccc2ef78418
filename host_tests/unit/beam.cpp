// The beam element against matrices of textbooks, statics, and loads at which columns buckle.
#include "taut/elements/beam.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/dense.hpp"
#include "taut/elements/elements.hpp"

namespace beam_test {
using namespace support;

namespace {

struct FrameCapacity : taut::Capacity {
  static constexpr int nodes = 12, beams = 12;
};
template <int Dimension>
using Frame = taut::Scene<double, Dimension, FrameCapacity>;
template <int Dimension>
using Element = taut::BeamElement<double, Dimension>;

constexpr double E = 2.1e11;
const taut::BeamSection<double, 2> plane_section{E, 0.02, 4e-4};
const taut::BeamSection<double, 3> space_section{E, 0.02, 4e-4, 7e-5, 9e-6, 8e10, {0, 0, 1}};

/// A beam from the origin to `to`.
Element<2> plane_beam(const std::array<double, 2>& to, std::array<bool, 2> hinged = {}) {
  Frame<2> scene;
  const int first = scene.add_node({0, 0}), last = scene.add_node(to);
  scene.add_beam(first, last, plane_section, hinged);
  return Element<2>::of(scene, 0, 1.0);
}
Element<3> space_beam(const std::array<double, 3>& to, std::array<bool, 2> hinged = {},
                      const std::array<double, 3>& up = {0, 0, 1}) {
  Frame<3> scene;
  const int first = scene.add_node({0, 0, 0}), last = scene.add_node(to);
  taut::BeamSection<double, 3> section = space_section;
  section.up = up;
  scene.add_beam(first, last, section, hinged);
  return Element<3>::of(scene, 0, 1.0);
}

/// Deflections and rotations of both ends in one plane, for EI/L^3 and for N/L.
Matrix bending_matrix(double L) {
  Matrix K(4, 4);
  K << 12, 6 * L, -12, 6 * L,               //
      6 * L, 4 * L * L, -6 * L, 2 * L * L,  //
      -12, -6 * L, 12, -6 * L,              //
      6 * L, 2 * L * L, -6 * L, 4 * L * L;
  return K;
}
Matrix string_matrix(double L) {
  Matrix K(4, 4);
  K << 36, 3 * L, -36, 3 * L,            //
      3 * L, 4 * L * L, -3 * L, -L * L,  //
      -36, -3 * L, 36, -3 * L,           //
      3 * L, -L * L, -3 * L, 4 * L * L;
  return K / 30;
}

void add_part(Matrix& K, const std::vector<int>& rows, const Matrix& part) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows.size(); ++k)
      K(rows[i], rows[k]) += part(static_cast<int>(i), static_cast<int>(k));
}
/// A deflection along -z grows with a rotation about y.
Matrix reversed(const Matrix& bending) {
  Matrix signs = Matrix::Identity(4, 4);
  signs(1, 1) = signs(3, 3) = -1;
  return product(product(signs, bending), signs);
}

bool near(const Matrix& A, const Matrix& B, double relative) {
  return (A - B).cwiseAbs().maxCoeff() <= relative * B.cwiseAbs().maxCoeff();
}

/// Rotations of the nodes by which a beam along x becomes one along `x`: columns x, y, z.
Matrix turned(const Matrix& K, const Matrix& axes, int blocks) {
  const int n = static_cast<int>(K.rows());
  Matrix R = Matrix::Zero(n, n);
  for (int i = 0; i < blocks; ++i) R.block(3 * i, 3 * i, 3, 3) = axes;
  return product(product(R, K), R.transpose());
}

/// What is left of K when unknown `row` follows the others.
Matrix condensed(const Matrix& K, int row) {
  Matrix left = K;
  for (int i = 0; i < K.rows(); ++i)
    for (int k = 0; k < K.cols(); ++k) left(i, k) -= K(i, row) * K(row, k) / K(row, row);
  return left;
}

/// A column of equal members under compression N = 1, its foot at the origin.
template <int Dimension>
class Column {
 public:
  using Point = typename Frame<Dimension>::Point;
  static constexpr int per_node = Element<Dimension>::per_node;

  Column(int members, const Point& to, const taut::BeamSection<double, Dimension>& section,
         bool hinged_at_foot = false)
      : members_(members) {
    Frame<Dimension> scene;
    for (int i = 0; i <= members; ++i) {
      Point at = to;
      for (double& x : at) x *= static_cast<double>(i) / members;
      scene.add_node(at);
    }
    for (int i = 0; i < members; ++i) scene.add_beam(i, i + 1, section, {i == 0 && hinged_at_foot, false});
    taut::Elements<double, Frame<Dimension>> elements;
    elements.make(scene);
    const int n = per_node * (members + 1);
    stiffness_ = geometric_ = Matrix::Zero(n, n);
    for (int i = 0; i < members; ++i) {
      const auto& beam = elements.beams[i];
      stiffness_.block(per_node * i, per_node * i, 2 * per_node, 2 * per_node) += beam.stiffness();
      geometric_.block(per_node * i, per_node * i, 2 * per_node, 2 * per_node) += beam.geometric(1.0);
    }
  }

  /// The smallest compression at which K + N K_G is singular, by inverse iteration; held: unknowns of the
  /// foot and of the head.
  double buckles_at(const std::vector<int>& foot, const std::vector<int>& head) const {
    std::vector<int> free;
    for (int i = 0; i < stiffness_.rows(); ++i) {
      const int node = i / per_node, unknown = i % per_node;
      const std::vector<int>* held = node == 0 ? &foot : node == members_ ? &head : nullptr;
      if (held == nullptr || std::find(held->begin(), held->end(), unknown) == held->end()) free.push_back(i);
    }
    const int n = static_cast<int>(free.size());
    Matrix K(n, n), G(n, n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const int row = free[static_cast<std::size_t>(i)], column = free[static_cast<std::size_t>(k)];
        K(i, k) = stiffness_(row, column);
        G(i, k) = geometric_(row, column);
      }
    Random random(7);
    Vector x = random_vector(random, n);
    double load = 0;
    for (int round = 0; round < 60; ++round) {
      const Vector pushed = product(G, x);
      x = solved(K, pushed);
      load = x.dot(pushed) / x.dot(Vector(product(G, x)));
      x /= largest(x);
    }
    return load;
  }

 private:
  int members_;
  Matrix stiffness_, geometric_;
};

}  // namespace

TEST_CASE("a beam along x has the stiffness of the textbook, in the plane and in space") {
  const double L = 3.5;
  const auto plane = plane_beam({L, 0});
  Matrix K = Matrix::Zero(6, 6);
  Matrix bar(2, 2);
  bar << 1, -1, -1, 1;
  add_part(K, {0, 3}, E * 0.02 / L * bar);
  add_part(K, {1, 2, 4, 5}, E * 4e-4 / (L * L * L) * bending_matrix(L));
  CHECK(near(plane.stiffness(), K, 1e-15));

  const auto space = space_beam({L, 0, 0});
  K = Matrix::Zero(12, 12);
  add_part(K, {0, 6}, E * 0.02 / L * bar);
  add_part(K, {1, 5, 7, 11}, E * 7e-5 / (L * L * L) * bending_matrix(L));
  add_part(K, {2, 4, 8, 10}, E * 4e-4 / (L * L * L) * reversed(bending_matrix(L)));
  add_part(K, {3, 9}, 8e10 * 9e-6 / L * bar);
  CHECK(near(space.stiffness(), K, 1e-15));
}

TEST_CASE("a beam along x has the geometric stiffness of the textbook, and none for torsion") {
  const double L = 3.5, N = -4e5;
  Matrix G = Matrix::Zero(6, 6);
  add_part(G, {1, 2, 4, 5}, N / L * string_matrix(L));
  CHECK(near(plane_beam({L, 0}).geometric(N), G, 1e-15));

  G = Matrix::Zero(12, 12);
  add_part(G, {1, 5, 7, 11}, N / L * string_matrix(L));
  add_part(G, {2, 4, 8, 10}, N / L * reversed(string_matrix(L)));
  CHECK(near(space_beam({L, 0, 0}).geometric(N), G, 1e-15));
}

TEST_CASE("a beam that is turned has the same matrices in turned axes; up sets its z") {
  const double L = 7;
  const auto along = plane_beam({L, 0});
  const double c = 0.6, s = 0.8;
  Matrix axes = Matrix::Identity(3, 3);
  axes.topLeftCorner(2, 2) << c, -s, s, c;
  const auto plane = plane_beam({c * L, s * L});
  CHECK(near(plane.stiffness(), turned(along.stiffness(), axes, 2), 1e-14));
  CHECK(near(plane.geometric(5.0), turned(along.geometric(5.0), axes, 2), 1e-14));

  // x = (2, 3, 6) / 7 with z along (3, -6, 2) / 7, which any up in their plane gives.
  axes << 2, -6, 3, 3, -2, -6, 6, 3, 2;
  axes /= 7;
  REQUIRE(near(product(axes, axes.transpose()), Matrix::Identity(3, 3), 1e-15));
  const std::array<double, 3> up{3 + 2 * 2, -6 + 2 * 3, 2 + 2 * 6};
  const auto straight = space_beam({L, 0, 0}), space = space_beam({2, 3, 6}, {}, up);
  CHECK(near(space.stiffness(), turned(straight.stiffness(), axes, 4), 1e-14));
  CHECK(near(space.geometric(5.0), turned(straight.geometric(5.0), axes, 4), 1e-14));
}

TEST_CASE("a hinge leaves what condensation of its rotations leaves, of both matrices") {
  const double L = 3.5, N = 1e4;
  for (const std::array<bool, 2> hinged : {std::array<bool, 2>{true, false}, {false, true}, {true, true}}) {
    CAPTURE(hinged[0]);
    CAPTURE(hinged[1]);
    Matrix K = plane_beam({L, 0}).stiffness(), under = K + plane_beam({L, 0}).geometric(N),
           relaxed = K - plane_beam({L, 0}).geometric(N);
    for (int end = 0; end < 2; ++end)
      if (hinged[static_cast<std::size_t>(end)])
        for (Matrix* each : {&K, &under, &relaxed}) *each = condensed(*each, 2 + 3 * end);
    const auto beam = plane_beam({L, 0}, hinged);
    CHECK(near(beam.stiffness(), K, 1e-14));
    // The difference of small forces either way is the derivative by N.
    CHECK(near(plane_beam({L, 0}, hinged).geometric(1.0), (under - relaxed) / (2 * N), 1e-7));
  }
  // Beside a hinge in space: 3 EI / L about both axes, and no torsion.
  const Matrix K = space_beam({L, 0, 0}, {true, false}).stiffness();
  CHECK(K(10, 10) == doctest::Approx(3 * E * 4e-4 / L).epsilon(1e-15));
  CHECK(K(11, 11) == doctest::Approx(3 * E * 7e-5 / L).epsilon(1e-15));
  for (const int i : {3, 4, 5, 9}) CHECK(K.row(i).cwiseAbs().maxCoeff() == 0);
  // Between two hinges it is a strut, with N / L across.
  const auto strut = space_beam({L, 0, 0}, {true, true});
  CHECK(strut.stiffness().block(1, 1, 5, 5).cwiseAbs().maxCoeff() == 0);
  Matrix across = Matrix::Zero(12, 12);
  for (const int axis : {1, 2}) {
    across(axis, axis) = across(axis + 6, axis + 6) = 1 / L;
    across(axis, axis + 6) = across(axis + 6, axis) = -1 / L;
  }
  CHECK(near(strut.geometric(1.0), across, 1e-15));
}

TEST_CASE("rotations in units of an arm change no force") {
  Frame<3> scene;
  scene.add_node({0.3, -1, 2});
  scene.add_node({2, 3, 6});
  scene.add_beam(0, 1, space_section);
  const auto metre = Element<3>::of(scene, 0, 1.0), other = Element<3>::of(scene, 0, 0.125);
  Matrix units = Matrix::Identity(12, 12);
  for (const int i : {3, 4, 5, 9, 10, 11}) units(i, i) = 8;
  CHECK(near(other.stiffness(), product(product(units, metre.stiffness()), units), 1e-14));
  CHECK(near(other.geometric(3.0), product(product(units, metre.geometric(3.0)), units), 1e-14));
}

TEST_CASE("forces of the ends are stiffness times displacements, and motions of a rigid body make none") {
  const auto beam = space_beam({2, 3, 6});
  Random random(3);
  const Vector u = random_vector(random, 12);
  const auto at = [](const Vector& x) { return [&x](int i) { return taut::DoubleWord<double>{x[i], 0}; }; };
  const auto forces = beam.end_forces(at(u));
  const Vector expected = product(beam.stiffness(), u);
  for (int i = 0; i < 12; ++i)
    CHECK(std::fabs(forces[static_cast<std::size_t>(i)] - expected[i]) <= 1e-14 * largest(expected));
  const Eigen::Vector3d x = Eigen::Vector3d(2, 3, 6) / 7;
  const double N = E * 0.02 / 7 * (u.segment(6, 3) - u.head(3)).dot(x);
  CHECK(beam.axial_force(u.head<3>(), u.segment<3>(6)) == doctest::Approx(N).epsilon(1e-14));

  // What a translation adds to both ends cancels to nothing; a rotation leaves the rounding of the axes.
  Vector moved = Vector::Zero(12);
  moved.head(3) << 1e3, -2e3, 3e3;
  moved.segment(6, 3) = moved.head(3);
  for (const double force : beam.end_forces(at(moved))) CHECK(force == 0);
  moved.setZero();
  const Eigen::Vector3d spin(0.1, -0.2, 0.3);
  moved.segment(3, 3) = moved.segment(9, 3) = spin;
  moved.segment(6, 3) = spin.cross(Eigen::Vector3d(2, 3, 6));
  for (const double force : beam.end_forces(at(moved))) CHECK(std::fabs(force) <= 1e-14 * beam.stiffest);
}

TEST_CASE("forces keep the digits that cancel in the displacements of a beam that is carried along") {
  const auto beam = plane_beam({4, 0});
  // Stretched by 2^-70 m, turned at one end by 2^-72: lost in a double that holds the 1 m it is carried.
  const double stretch = std::ldexp(1.0, -70), turn = std::ldexp(1.0, -72);
  const auto forces = beam.end_forces([&](int i) -> taut::DoubleWord<double> {
    if (i == 0) return {1, 0};
    if (i == 3) return {1, stretch};
    return {0, i == 5 ? turn : 0};
  });
  CHECK(forces[3] == doctest::Approx(E * 0.02 / 4 * stretch).epsilon(1e-14));
  CHECK(forces[5] == doctest::Approx(4 * E * 4e-4 / 4 * turn).epsilon(1e-14));
  CHECK(forces[2] == doctest::Approx(2 * E * 4e-4 / 4 * turn).epsilon(1e-14));
}

TEST_CASE("columns of eight members buckle at Euler's loads") {
  const double L = 6, euler = pi * pi * E * 4e-4 / (L * L);
  const Column<2> column(8, {0, L}, plane_section);
  CHECK(column.buckles_at({0, 1}, {0}) == doctest::Approx(euler).epsilon(1e-3));
  CHECK(column.buckles_at({0, 1, 2}, {}) == doctest::Approx(euler / 4).epsilon(1e-3));
  CHECK(column.buckles_at({0, 1, 2}, {0, 2}) == doctest::Approx(4 * euler).epsilon(1e-3));
  // tan(x) = x at 4.4934095.
  const double propped = 4.493409457909064 * 4.493409457909064 * E * 4e-4 / (L * L);
  CHECK(column.buckles_at({0, 1, 2}, {0}) == doctest::Approx(propped).epsilon(1e-3));
  CHECK(column.buckles_at({0, 1}, {0, 2}) == doctest::Approx(propped).epsilon(1e-3));

  // A hinge in the element is a foot that may turn.
  const Column<2> hinged(8, {0, L}, plane_section, true);
  CHECK(hinged.buckles_at({0, 1, 2}, {0}) == doctest::Approx(euler).epsilon(1e-3));
  CHECK(hinged.buckles_at({0, 1, 2}, {0, 2}) == doctest::Approx(propped).epsilon(1e-3));
}

TEST_CASE("a column in space buckles about its weaker axis, and leans to the side that holds it less") {
  const double L = 6, about_z = pi * pi * E * 7e-5 / (L * L), about_y = pi * pi * E * 4e-4 / (L * L);
  // Along x, up is z: Iz = 7e-5 is for deflections along y.
  const Column<3> column(8, {L, 0, 0}, space_section);
  CHECK(column.buckles_at({0, 1, 2, 3}, {1, 2}) == doctest::Approx(about_z).epsilon(1e-3));
  CHECK(column.buckles_at({0, 1, 2, 3, 4, 5}, {}) == doctest::Approx(about_z / 4).epsilon(1e-3));
  // Free along z alone: 4 about_z is 2.8e-4 against 4e-4 / 4 about y.
  CHECK(column.buckles_at({0, 1, 2, 3, 4, 5}, {1, 5}) == doctest::Approx(about_y / 4).epsilon(1e-3));
  // Askew the same.
  taut::BeamSection<double, 3> section = space_section;
  section.up = {3, -6, 2};
  const double l = L / 7;
  const Column<3> askew(8, {2 * l, 3 * l, 6 * l}, section);
  CHECK(askew.buckles_at({0, 1, 2, 3, 4, 5}, {}) == doctest::Approx(about_z / 4).epsilon(1e-3));
}

}  // namespace beam_test
