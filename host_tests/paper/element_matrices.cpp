// Section 2.5: the matrices and load vectors of the friction element, entry by entry, and what the lagged
// iteration on the friction that they imply converges to.
#include <Eigen/Dense>

#include "checks.hpp"
#include "printed_matrices.hpp"

namespace element_matrices_test {
namespace {

using namespace paper;
using Element2 = taut::FrictionElement<double, 2>;
using Element3 = taut::FrictionElement<double, 3>;

constexpr double alpha = 70 * degree;

/// Neighbours of a joint at the origin whose bisector has the angle theta to the x-axis.
struct Corner {
  std::array<double, 2> before, after;

  Corner(double theta, bool other_way)
      : before{std::cos(theta + alpha), std::sin(theta + alpha)},
        after{2 * std::cos(theta - alpha), 2 * std::sin(theta - alpha)} {
    if (other_way) std::swap(before, after);
  }
};

Element2 plane_element(const Corner& corner) {
  Element2 element;
  element.frame = taut::JointFrame<double, 2>::of(taut::Node<double, 2>{corner.before}, {{0, 0}},
                                                  taut::Node<double, 2>{corner.after});
  return element;
}

/// Where the plane lies in space: its x- and y-axis.
using Plane = Eigen::Matrix<double, 3, 2>;

Element3 spatial_element(const Corner& corner, const Plane& plane) {
  const auto in_space = [&plane](const std::array<double, 2>& at) {
    const Eigen::Vector3d x = plane * Eigen::Vector2d(at[0], at[1]);
    return taut::Node<double, 3>{{x[0], x[1], x[2]}};
  };
  Element3 element;
  element.frame =
      taut::JointFrame<double, 3>::of(in_space(corner.before), {{0, 0, 0}}, in_space(corner.after));
  return element;
}

/// Calls `visit(theta, other_way)` for bisectors all around and both directions of the cable.
template <class Visit>
void for_every_direction(Visit visit) {
  for (const double theta : {0.0, 22.5, 45.0, 90.0, 117.0, 180.0, -22.5, -71.0, -135.0})
    for (const bool other_way : {false, true}) {
      CAPTURE(theta);
      CAPTURE(other_way);
      visit(theta * degree, other_way);
    }
}

template <class A, class B>
double distance(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

constexpr double rounding = 1e-14;
constexpr double N = -1.25, T = 0.75;

TEST_CASE("K1, K2 and K3 have the printed entries, with row 4 of K1 as equilibrium asks") {
  for_every_direction([](double theta, bool other_way) {
    const Element2 element = plane_element({theta, other_way});
    CHECK(distance(element.fixed_stiffness(), corrected_K1(theta)) < rounding);
    CHECK(distance(element.sliding_stiffness(), printed_K2(theta)) < rounding);
    CHECK(distance(Element2::separated_stiffness(), printed_K3()) < rounding);
  });
}

TEST_CASE("f1, f2 and f3 have the printed entries") {
  for_every_direction([](double theta, bool other_way) {
    const Element2 element = plane_element({theta, other_way});
    CHECK(distance(Element2::fixed_load(), Vector6::Zero()) == 0);
    CHECK(distance(element.sliding_load(T), printed_f2(theta, T)) < rounding);
    CHECK(distance(element.separated_load(N, T), printed_f3(theta, N, T)) < rounding);
  });
}

TEST_CASE("L of Eq. (14) has the printed entries") {
  for_every_direction([](double theta, bool other_way) {
    CHECK(distance(plane_element({theta, other_way}).differences(), printed_L(theta)) < rounding);
  });
}

TEST_CASE("the values of Table 1 stand in the constraint rows of f1") {
  const Vector6 load = Element2::fixed_load({-0.002, 0.0015});
  CHECK(distance(load, (Vector6() << 0, 0, 0, 0, -0.002, 0.0015).finished()) == 0);
}

TEST_CASE("at the limit, K2 with the friction in its matrix is K2 with the friction as a load") {
  for_every_direction([](double theta, bool other_way) {
    Element2 element = plane_element({theta, other_way});
    element.mu = 0.3;
    const double sigma_n = -4, sigma_s = element.mu * 4;
    Vector6 x;
    x << 0.1, -0.2, 0.3, 0.4, sigma_n, sigma_s;
    const Vector6 forces = element.sliding_stiffness_at_limit(1) * x;
    const Vector6 lagged = element.sliding_stiffness() * x - element.sliding_load(sigma_s);
    CHECK(distance(forces, lagged) < rounding);
  });
}

/// From the unknowns of the plane element to those of the spatial one; s may point the other way.
Eigen::Matrix<double, 9, 6> embedding(const Plane& plane, double along) {
  Eigen::Matrix<double, 9, 6> to_space = Eigen::Matrix<double, 9, 6>::Zero();
  to_space.block<3, 2>(0, 0) = plane;
  to_space.block<3, 2>(3, 2) = plane;
  to_space(6, 4) = 1;
  to_space(7, 5) = along;
  return to_space;
}

void check_reduction(const Corner& corner, const Plane& plane) {
  const Element2 flat = plane_element(corner);
  const Element3 spatial = spatial_element(corner, plane);
  const double along = flat.frame.towards_2;
  const auto to_space = embedding(plane, along);
  const auto reduced = [&to_space](const Element3::Matrix& K) -> Matrix6 {
    return to_space.transpose() * K * to_space;
  };
  CHECK(distance(reduced(spatial.fixed_stiffness()), flat.fixed_stiffness()) < rounding);
  CHECK(distance(reduced(spatial.sliding_stiffness()), flat.sliding_stiffness()) < rounding);
  CHECK(distance(reduced(Element3::separated_stiffness()), Element2::separated_stiffness()) < rounding);
  CHECK(distance(to_space.transpose() * spatial.sliding_load(along * T), flat.sliding_load(T)) < rounding);
  CHECK(distance(to_space.transpose() * spatial.separated_load(N, along * T), flat.separated_load(N, T)) <
        rounding);
}

TEST_CASE("in a plane, the spatial element is the plane one") {
  Plane level;
  level << 1, 0, 0, 1, 0, 0;
  Plane tilted;
  tilted << 2. / 3, -1. / 3, 2. / 3, 2. / 3, 1. / 3, -2. / 3;
  for_every_direction([&](double theta, bool other_way) {
    check_reduction({theta, other_way}, level);
    check_reduction({theta, other_way}, tilted);
  });
}

TEST_CASE("across its plane, the spatial element ties the cable to the node and carries nothing else") {
  Plane level;
  level << 1, 0, 0, 1, 0, 0;
  const auto K = spatial_element({30 * degree, false}, level).fixed_stiffness();
  Eigen::Matrix<double, 9, 1> across = Eigen::Matrix<double, 9, 1>::Zero();
  across[2] = 1;  // the cable's point leaves the plane
  Eigen::Matrix<double, 9, 1> gap = K * across;
  CHECK(std::fabs(std::fabs(gap[8]) - 1) < rounding);
  gap[8] = 0;
  CHECK(gap.cwiseAbs().maxCoeff() < rounding);
}

/// The cable-roller model assembled by hand. Unknowns: node 3 along x and y, the loaded node along y,
/// sigma_n, sigma_s. The roller, node 4, is held.
class HandMadeRoller {
 public:
  struct Solution {
    double upper, lower, sigma_n, sigma_s;
  };

  HandMadeRoller() {
    element_.frame = taut::JointFrame<double, 2>::of(taut::Node<double, 2>{{1, 1}}, {{0, 0}},
                                                     taut::Node<double, 2>{{0, -1}});
    const double r = 1 / std::sqrt(2.0);
    bars_.setZero();
    // Elongations: the upper segment from node 3 up to the hinge, the lower one and the strut downwards.
    upper_ << -r, -r, 0, 0, 0;
    lower_ << 0, 1, -1, 0, 0;
    const Row strut = (Row() << 0, 0, -1, 0, 0).finished();
    bars_ += k / std::sqrt(2.0) * upper_.transpose() * upper_;
    bars_ += k * lower_.transpose() * lower_;
    bars_ += k * strut.transpose() * strut;
  }

  Solution fixed() const { return solve(element_.fixed_stiffness(), Element2::fixed_load()); }
  Solution sliding(double f) const { return solve(element_.sliding_stiffness(), element_.sliding_load(f)); }

 private:
  using Row = Eigen::Matrix<double, 1, 5>;
  using Matrix5 = Eigen::Matrix<double, 5, 5>;
  static constexpr double k = E_steel * A_members;

  Solution solve(const Matrix6& K, const Vector6& f) const {
    constexpr std::array<int, 4> kept{0, 1, 4, 5};   // of the element, without node 4
    constexpr std::array<int, 4> place{0, 1, 3, 4};  // among the unknowns
    Matrix5 A = bars_;
    Eigen::Matrix<double, 5, 1> b;
    b << 0, 0, -1000, 0, 0;
    for (std::size_t i = 0; i < 4; ++i) {
      b[place[i]] += f[kept[i]];
      for (std::size_t j = 0; j < 4; ++j) A(place[i], place[j]) += K(kept[i], kept[j]);
    }
    const Eigen::Matrix<double, 5, 1> x = A.fullPivLu().solve(b);
    return {k / std::sqrt(2.0) * upper_.dot(x.transpose()), k * lower_.dot(x.transpose()), x[3], x[4]};
  }

  Element2 element_;
  Matrix5 bars_;
  Row upper_, lower_;
};

TEST_CASE("iterating K2 and f2 on a lagged friction leads to the answer of the solver") {
  const HandMadeRoller model;
  for (const double mu : {0.0, 0.1, 0.5, 1.0}) {
    CAPTURE(mu);
    HandMadeRoller::Solution found = model.fixed();
    const double sign = std::copysign(1.0, found.sigma_s);
    REQUIRE(std::fabs(found.sigma_s) > mu * std::fabs(found.sigma_n));  // Table 2: it slides
    for (int iteration = 0; iteration < 60; ++iteration)
      found = model.sliding(sign * mu * std::fabs(found.sigma_n));
    const auto consistent = checked_answer<double>(cable_roller(mu), roller_drive);
    CHECK(close(found.upper, consistent.tension[0], 1e-12, 1000));
    CHECK(close(found.lower, consistent.tension[1], 1e-12, 1000));
    CHECK(close(-found.sigma_n, consistent.contact[0], 1e-12, 1000));
    CHECK(close(std::fabs(found.sigma_s), consistent.friction[0], 1e-12, 1000));
  }
}

TEST_CASE("one pass with the friction of the fixed trial is not yet the answer") {
  const HandMadeRoller model;
  const HandMadeRoller::Solution trial = model.fixed();
  const double f = std::copysign(0.5 * std::fabs(trial.sigma_n), trial.sigma_s);
  CHECK(std::fabs(model.sliding(f).lower - roller_by_hand(0.5).lower) > 1);
}

TEST_CASE("K1 assembled by hand gives the forces of the fixed joint") {
  const HandMadeRoller::Solution found = HandMadeRoller().fixed();
  CHECK(close(found.lower, 500, 1e-12));
  CHECK(std::fabs(found.upper) < 1e-9);
  CHECK(close(-found.sigma_n, 500 * std::cos(roller_alpha), 1e-12));
  CHECK(close(std::fabs(found.sigma_s), 500 * std::sin(roller_alpha), 1e-12));
}

}  // namespace

}  // namespace element_matrices_test
