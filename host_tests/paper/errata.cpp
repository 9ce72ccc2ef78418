// What is wrong or open in the printed paper, each shown by its consequences.
#include <Eigen/Dense>

#include "checks.hpp"
#include "printed_matrices.hpp"

namespace errata_test {
namespace {

using namespace paper;

// Eqs. (29), (34), (35): row 4.

TEST_CASE("K1 with the printed row 4 is not symmetric, with sin, cos it is") {
  for (const double theta : {-22.5 * degree, 30 * degree, 90 * degree}) {
    CAPTURE(theta);
    const Matrix6 printed = printed_K1(theta), corrected = corrected_K1(theta);
    CHECK((printed - printed.transpose()).cwiseAbs().maxCoeff() > 0.1);
    CHECK((corrected - corrected.transpose()).cwiseAbs().maxCoeff() == 0);
  }
}

TEST_CASE("the printed row 4 breaks Eqs. (4) and (5): what node 3 gets is not what node 4 gives") {
  const double theta = -22.5 * degree;  // of the cable-roller model
  const Eigen::Vector2d sigma(-191.3, 461.9);
  const auto left_over = [&sigma](const Matrix6& K) {
    const Eigen::Vector4d forces = K.topRightCorner<4, 2>() * sigma;
    return (forces.head<2>() + forces.tail<2>()).norm();
  };
  CHECK(left_over(printed_K1(theta)) > 500);
  CHECK(left_over(corrected_K1(theta)) < 1e-12);
  const Eigen::Vector4d by_equilibrium = printed_equilibrium(theta) * sigma;
  CHECK((corrected_K1(theta).topRightCorner<4, 2>() * sigma - by_equilibrium).norm() < 1e-12);
}

TEST_CASE("at theta = 45 degrees the misprint in row 4 cannot be seen") {
  CHECK((printed_K1(45 * degree) - corrected_K1(45 * degree)).cwiseAbs().maxCoeff() < 1e-15);
}

// Table 2.

/// The condition printed for Fixed/Fixed and for Fixed/Sliding.
bool printed_condition(double sigma_n, double sigma_s, double f) { return sigma_n < 0 && sigma_s < f; }

taut::Contact checked(double sigma_n, double sigma_s, double mu) {
  taut::ContactTrial<double> trial;
  trial.sigma_n = sigma_n;
  trial.sigma_s = sigma_s;
  trial.f = taut::limit_friction(mu, sigma_n, sigma_s);
  return taut::check_contact(taut::Contact::fixed, trial);
}

TEST_CASE("the condition that Table 2 prints for both fixed and sliding cannot tell them apart") {
  constexpr double mu = 0.5, sigma_n = -100;
  const auto printed = [](double sigma_s) {
    return printed_condition(sigma_n, sigma_s, taut::limit_friction(mu, sigma_n, sigma_s));
  };
  // Below the limit it asks for both states at once, beyond it for neither.
  CHECK(printed(49));
  CHECK_FALSE(printed(51));
  // With the other sign, friction at the limit being -50, it is the wrong way round.
  CHECK_FALSE(printed(-49));
  CHECK(printed(-51));
}

TEST_CASE("sliding begins where the tangential force exceeds mu times the normal force, in both directions") {
  using taut::Contact;
  CHECK(checked(-100, 49, 0.5) == Contact::fixed);
  CHECK(checked(-100, -49, 0.5) == Contact::fixed);
  CHECK(checked(-100, 51, 0.5) == Contact::sliding);
  CHECK(checked(-100, -51, 0.5) == Contact::sliding);
  CHECK(checked(1, 0, 0.5) == Contact::separated);
}

// Table 1, separated to fixed.

TEST_CASE("Table 1 brings a closing joint to rest where the gap closed, the text where it touched before") {
  taut::ContactMemory<double> last;
  last.state = taut::Contact::separated;
  last.u_n = 0.002;
  last.v_s = 0.005;
  const double step_u = -0.004, step_v = 0.003;
  // The trial moves along a straight line: the gap is closed after half of the step.
  const double closed_at = last.v_s + 0.5 * step_v;

  const auto values = taut::constraint_values(last, taut::Contact::fixed, 0.0, step_u, step_v);
  CHECK(last.u_n + values.a == 0);
  CHECK(std::fabs(last.v_s + values.b - closed_at) < 1e-17);

  const double b_of_the_text = -last.v_s;
  CHECK(std::fabs(last.v_s + b_of_the_text - closed_at) > 0.006);
}

struct ClosingCapacity : taut::Capacity {
  static constexpr int nodes = 5, struts = 2, segments = 2, joints = 1, loads = 2, forces = 2;
};
using ClosingScene = taut::Scene<double, 2, ClosingCapacity>;
constexpr double end_stiffness = 3e7, cable_stiffness = 2e7;  ///< EA/L [N/m]

/// A cable bent by a right angle over a rigid saddle. Each end hangs on a spring along its segment and is
/// drawn outwards by a load pattern of its own. mu is large enough to hold nearly every difference of forces.
ClosingScene closing_cable() {
  ClosingScene scene;
  const int before = scene.add_node({-1, 0}, taut::held_y);
  const int joint = scene.add_node({0, 0}, taut::held_xy);
  const int after = scene.add_node({0, 1}, taut::held_x);
  scene.add_strut(before, scene.add_node({-2, 0}, taut::held_xy), end_stiffness, 1);
  scene.add_strut(after, scene.add_node({0, 2}, taut::held_xy), end_stiffness, 1);
  taut::Cable<double> cable;
  cable.E = cable_stiffness;
  cable.A = 1;
  cable.mu = 0.9;
  scene.add_cable(cable, {before, joint, after});
  scene.add_force(scene.add_load(), before, {-1, 0});
  scene.add_force(scene.add_load(), after, {0, 1});
  return scene;
}

TEST_CASE("a slack cable that is drawn taut evenly from both ends carries the same force on both sides") {
  using Cap = ClosingCapacity;
  static const ClosingScene scene = closing_cable();
  for (const int substeps : {1, 64}) {
    CAPTURE(substeps);
    static taut::Stepwise<double, ClosingScene> solver;
    REQUIRE(solver.start(scene).ok());
    taut::Sample<double, Cap> sample;
    sample.factor[0] = -1000;  // the end before the joint is pushed inwards
    REQUIRE(solver.advance(sample, substeps).ok());
    CHECK(solver.response().state[0] == taut::JointState::open);
    sample.factor[0] = 1000;
    sample.factor[1] = 2000;
    REQUIRE(solver.advance(sample, substeps).ok());

    // The outward forces sum up to zero at a quarter of the way: -500 N and 500 N. There both segments have
    // their unstressed length; what the end before gave, the one after took.
    const double closed_slip = 500 / end_stiffness;
    // From there on springs and cable share the loads evenly: end_stiffness u = F - T, sum of u = 2 T /
    // cable_stiffness.
    const double T = 3000. / 2 * cable_stiffness / (cable_stiffness + end_stiffness);
    CHECK(close(solver.response().slip[0], closed_slip, 1e-12));
    CHECK(close(solver.response().tension[0], T, 1e-12));
    CHECK(close(solver.response().tension[1], T, 1e-12));
  }
}

// Table 3 and Table 4.

TEST_CASE(
    "Table 3 contradicts itself at mu = 0.5: mu times the printed normal pressure is 108.2, not 108.7") {
  for (const RollerColumn& printed : table_3) {
    CAPTURE(printed.mu);
    if (printed.mu > std::tan(roller_alpha)) continue;  // holds: friction is below its limit
    const double rounding = 0.05 * (1 + printed.mu);    // of both printed figures
    const double difference = std::fabs(printed.friction - printed.mu * printed.contact);
    CHECK((difference < rounding) == (printed.mu != misprinted_mu));
  }
  const RollerForces by_hand = roller_by_hand(misprinted_mu);
  CHECK(std::fabs(by_hand.contact - 216.48) < 0.005);
  CHECK(std::fabs(by_hand.friction - 108.24) < 0.005);
  const auto found = checked_answer<double>(cable_roller(misprinted_mu), roller_drive);
  CHECK(std::fabs(found.friction[0] - 108.24) < 0.005);
}

TEST_CASE("the printed mu of Table 4 follow from twice the sine, not from the tangent of the note") {
  for (const RollingJointRow& row : table_4) {
    CAPTURE(row.name);
    CHECK(std::fabs(printed_mu(row) - row.mu) < 0.5e-4);
    CHECK(std::fabs(identified_mu(row.T1, row.T2, roller_alpha) - row.mu) > 0.03);
  }
}

TEST_CASE("only mu from the note of Table 4 gives back the measured force with Eq. (43)") {
  for (const RollingJointRow& row : table_4) {
    CAPTURE(row.name);
    const double from_note = identified_mu(row.T1, row.T2, roller_alpha);
    CHECK(close(row.T1 * slid_ratio(from_note, roller_alpha), row.T2, 1e-14));
    CHECK(row.T1 * slid_ratio(row.mu, roller_alpha) > row.T2 + 900);
  }
}

// Section 4.3.

TEST_CASE("mu = 12.7 is not below tan(alpha), as the text has it, but above: that is what holds the cable") {
  const TrussScene scene = table_5[1].scene();
  for (int j = 0; j < lower_nodes; ++j) {
    CAPTURE(j);
    CHECK(std::tan(truss_alpha(j)) < table_5[1].mu);
    CHECK(taut::FrictionElement<double, 2>::of(scene, 0, j).limit.is_self_locking());
  }
}

}  // namespace

}  // namespace errata_test
