// Scenes that are checked while compiling, against what the same check says at run time.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "support/status_check.hpp"
#include "taut/scene/validation.hpp"

namespace constant_validation_test {
using taut::Code;
using taut::Place;
using taut::Status;

namespace {

struct Little : taut::Capacity {
  static constexpr int nodes = 6, struts = 2, cables = 1, segments = 2, joints = 1, loads = 1, forces = 1;
  static constexpr int substructures = 1, substructure_nodes = 1, substructure_entries = 9, beams = 1;
};
template <class Scalar, int Dimension>
using Scene = taut::Scene<Scalar, Dimension, Little>;

enum Wrong { nothing, free_to_turn, no_stiffness, folded, no_such_node, not_a_number, along_up, indefinite };

/// A cable from a hinge over a saddle to a foot, a strut under the saddle, and in space a beam to a post.
template <class Scalar, int Dimension>
constexpr Scene<Scalar, Dimension> roof(Wrong wrong) {
  const bool plane = Dimension == 2;
  const auto at = [](int x, int y) {
    typename Scene<Scalar, Dimension>::Point point{};
    point[0] = static_cast<Scalar>(x);
    point[1] = static_cast<Scalar>(y);
    return point;
  };
  const auto all = static_cast<std::uint8_t>(plane ? taut::held_xy : taut::held_xyz);
  const auto none = static_cast<std::uint8_t>(taut::held_none);
  // In the plane a spring at the foot is left, in space a hinge along the line from hinge to saddle.
  const std::uint8_t above = wrong == free_to_turn && plane ? none : all;
  const std::uint8_t foot = wrong == free_to_turn ? none : all;
  Scene<Scalar, Dimension> scene;
  scene.add_node(at(1, 1), above);
  scene.add_node(wrong == folded ? at(2, 1) : at(0, 0), above);
  scene.add_node(wrong == folded ? at(0, 1) : at(0, -1), foot);
  scene.add_strut(1, wrong == no_such_node ? 6 : 2, wrong == no_stiffness ? 0 : Scalar(2e11), Scalar(1e-4));
  taut::Cable<Scalar> cable;
  cable.E = Scalar(2e11);
  cable.A = Scalar(1e-4);
  cable.mu = wrong == not_a_number ? std::numeric_limits<Scalar>::quiet_NaN() : Scalar(0.1);
  scene.add_cable(cable, {0, 1, 2});
  scene.add_force(scene.add_load(), 2, at(0, -1000));
  if constexpr (Dimension == 3) {
    taut::BeamSection<Scalar, 3> section;
    section.E = section.G = Scalar(2e11);
    section.A = section.Iy = section.Iz = section.J = Scalar(1e-4);
    if (wrong == along_up) section.up = {1, 1, 0};
    scene.add_beam(1, 0, section);
  }
  const int on = 2;
  if constexpr (Dimension == 2) {
    const Scalar spring[] = {wrong == indefinite ? Scalar(-1e6) : Scalar(1e6), 0, 0, Scalar(2e6)};
    scene.add_substructure(&on, 1, spring);
  }
  return scene;
}

/// The status at run time and that of the constant expression.
template <class Scalar, int Dimension, Wrong wrong>
void check_both(Code code) {
  constexpr Status while_compiling = validate(roof<Scalar, Dimension>(wrong));
  const auto scene = roof<Scalar, Dimension>(wrong);
  Status at_run_time;
  at_run_time = validate(scene);
  CAPTURE(int(wrong));
  CHECK(at_run_time.code == code);
  CHECK(while_compiling == at_run_time);
}

template <class Scalar>
void check_all() {
  check_both<Scalar, 2, nothing>(Code::ok);
  check_both<Scalar, 2, free_to_turn>(Code::unsupported);
  check_both<Scalar, 2, no_stiffness>(Code::not_positive);
  check_both<Scalar, 2, folded>(Code::folded_cable);
  check_both<Scalar, 2, no_such_node>(Code::unknown_node);
  check_both<Scalar, 2, not_a_number>(Code::not_finite);
  check_both<Scalar, 2, indefinite>(Code::not_semidefinite);
  check_both<Scalar, 3, nothing>(Code::ok);
  check_both<Scalar, 3, free_to_turn>(Code::unsupported);
  check_both<Scalar, 3, folded>(Code::folded_cable);
  check_both<Scalar, 3, along_up>(Code::out_of_range);
}

/// The nodes that move in some rigid motion that no support resists, by elimination in what supports hold, in
/// coordinates as they are.
template <int Dimension>
std::vector<int> nodes_that_move(const Scene<double, Dimension>& scene) {
  constexpr int motions = Dimension == 2 ? 3 : 6;
  const auto rigid_motions = [&](int node) {
    const auto& x = scene.nodes[node].at;
    Eigen::Matrix<double, Dimension, motions> R = Eigen::Matrix<double, Dimension, motions>::Zero();
    R.template leftCols<Dimension>().setIdentity();
    if constexpr (Dimension == 2)
      R.col(2) << -x[1], x[0];
    else
      R.template rightCols<3>() << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0;
    return R;
  };
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(Dimension * scene.nodes.size(), motions);
  for (int i = 0; i < scene.nodes.size(); ++i)
    for (int axis = 0; axis < Dimension; ++axis)
      if (scene.nodes[i].is_held(axis)) held.row(Dimension * i + axis) = rigid_motions(i).row(axis);
  // Of zeros alone if nothing is free.
  const Eigen::MatrixXd free = Eigen::FullPivLU<Eigen::MatrixXd>(held).kernel();
  std::vector<int> moved;
  for (int i = 0; i < scene.nodes.size(); ++i)
    if ((rigid_motions(i) * free).norm() > 1e-6) moved.push_back(i);
  return moved;
}

/// Nodes at random, some held along some axes, many of them on a line or in few directions.
template <int Dimension>
void check_random_supports(unsigned seed) {
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> count(1, 6), coordinate(-2, 2), held(0, (1 << Dimension) - 1),
      one_in(0, 2);
  int unsupported = 0;
  constexpr int scenes = 2000;
  for (int i = 0; i < scenes; ++i) {
    CAPTURE(i);
    Scene<double, Dimension> scene;
    for (int n = count(random); n > 0; --n) {
      typename Scene<double, Dimension>::Point at{};
      for (double& x : at) x = coordinate(random);
      scene.add_node(at, static_cast<std::uint8_t>(one_in(random) == 0 ? 0 : held(random)));
    }
    const Status found = validate(scene);
    const auto moves = nodes_that_move(scene);
    unsupported += moves.empty() ? 0 : 1;
    CHECK(found.code == (moves.empty() ? Code::ok : Code::unsupported));
    if (!found.ok()) CHECK(std::count(moves.begin(), moves.end(), found.index) == 1);
  }
  CHECK(unsupported > scenes / 10);
  CHECK(unsupported < scenes * 9 / 10);
}

}  // namespace

TEST_CASE("a constant expression says of a scene what is said at run time, in double") {
  check_all<double>();
}
TEST_CASE("and in float") { check_all<float>(); }

TEST_CASE(
    "supports are judged as by elimination, and a node that is named moves, in the plane and in space") {
  check_random_supports<2>(20261);
  check_random_supports<3>(20262);
}

TEST_CASE("square roots in constant expressions are those of the C library but for the last digit") {
  for (const double x : {0.0, 1e-300, 0.25, 1.0, 2.0, 3.0, 1e10, 1e300})
    CHECK(std::abs(taut::constant_square_root(x) - std::sqrt(x)) <= 2e-16 * std::sqrt(x));
  static_assert(taut::constant_square_root(9.0F) == 3.0F);
  static_assert(taut::constant_norm(std::array<float, 2>{3e30F, 4e30F}) > 4.99e30F);
}

TEST_CASE("eigenvalues in constant expressions are those known by hand") {
  // 2 on the diagonal, -1 beside it: 2 - sqrt 2, 2, 2 + sqrt 2.
  constexpr auto found = taut::ConstantEigen<double, 3>::of({{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}}});
  double least = 9, most = 0, sum = 0;
  for (const double value : found.values) {
    least = std::min(least, value);
    most = std::max(most, value);
    sum += value;
  }
  CHECK(least == doctest::Approx(2 - std::sqrt(2.0)).epsilon(1e-15));
  CHECK(most == doctest::Approx(2 + std::sqrt(2.0)).epsilon(1e-15));
  CHECK(sum == doctest::Approx(6).epsilon(1e-15));
}

}  // namespace constant_validation_test
