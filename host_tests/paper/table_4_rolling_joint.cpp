// Section 4.1.2, Table 4: the experiment with a rolling cable-strut joint.
//
// mu and T2 of a row come from one and the same pair of readings: what agrees here is the formula, the solver
// and the printed figures, not a prediction with a measurement.
#include "checks.hpp"

namespace table_4_rolling_joint_test {
namespace {

using namespace paper;

TEST_CASE("the note under Table 4 gives 0.2189, 0.1385 and 0.2931 for mu") {
  constexpr std::array<double, 3> expected{0.2189, 0.1385, 0.2931};
  for (std::size_t i = 0; i < table_4.size(); ++i) {
    const RollingJointRow& row = table_4[i];
    CAPTURE(row.name);
    CHECK(std::fabs(identified_mu(row.T1, row.T2, roller_alpha) - expected[i]) < 0.5e-4);
  }
}

/// From the force at the loading end and mu alone.
template <class Scalar>
double fixed_end_force(double mu, double T1) {
  const auto found = checked_answer<Scalar>(rolling_joint(mu), {0, T1});
  CHECK(found.state[0] == taut::JointState::forward);
  return static_cast<double>(found.tension[0]);
}

TEST_CASE(
    "with mu from the note the measured force at the fixed end comes back from the one at the loading end") {
  for (const RollingJointRow& row : table_4) {
    CAPTURE(row.name);
    const double mu = identified_mu(row.T1, row.T2, roller_alpha);
    CHECK(close(fixed_end_force<double>(mu, row.T1), row.T2, 1e-12));
    CHECK(close(fixed_end_force<float>(mu, row.T1), row.T2, 1e-6));
  }
}

TEST_CASE("with mu from the note the printed numerical values come out to their last digit") {
  constexpr double half_a_digit = 51;  // 0.05 kN; 35.66 and 33.35 lie close to the edge of their rounding
  for (const RollingJointRow& row : table_4) {
    CAPTURE(row.name);
    const double mu = identified_mu(row.T1, row.T2, roller_alpha);
    CHECK(std::fabs(fixed_end_force<double>(mu, row.T1) - row.T2_numerical) < half_a_digit);
  }
}

TEST_CASE("one joint conserves the cable: the jack draws out what both segments stretch") {
  const RollingJointRow& row = table_4[0];
  const double mu = identified_mu(row.T1, row.T2, roller_alpha);
  const auto found = checked_answer<double>(rolling_joint(mu), {0, row.T1});
  const double EA = E_steel * A_members;
  CHECK(close(found.slip[0], row.T2 / EA, 1e-12));
  CHECK(close(found.extension[0][1], (row.T2 + row.T1 * std::sqrt(2.0)) / EA, 1e-12));
}

}  // namespace

}  // namespace table_4_rolling_joint_test
