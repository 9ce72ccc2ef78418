// Section 4.1.1, Table 3: friction and normal pressure of the cable-roller model.
#include "checks.hpp"

namespace table_3_cable_roller_test {
namespace {

using namespace paper;

/// Table 3 gives one decimal.
constexpr double printed_to = 0.1;

/// The four columns, in the scalar type of the calculation; the misprint is left to errata.cpp.
template <class Scalar>
void check_printed_columns() {
  for (const RollerColumn& printed : table_3) {
    CAPTURE(printed.mu);
    const auto found = checked_answer<Scalar>(cable_roller(printed.mu), roller_drive);
    CHECK(std::fabs(static_cast<double>(found.contact[0]) - printed.contact) < printed_to);
    if (printed.mu == misprinted_mu) continue;
    CHECK(std::fabs(static_cast<double>(found.friction[0]) - printed.friction) < printed_to);
  }
}

template <class Scalar>
void check_closed_form(double tolerance) {
  for (const double mu : {0.0, 0.1, 0.26, 0.5, 1.0, 2.0, 2.4, 2.42, 12.7}) {
    CAPTURE(mu);
    const RollerForces expected = roller_by_hand(mu);
    const auto found = checked_answer<Scalar>(cable_roller(mu), roller_drive);
    constexpr double size = 1000;
    CHECK(close(static_cast<double>(found.tension[0]), expected.upper, tolerance, size));
    CHECK(close(static_cast<double>(found.tension[1]), expected.lower, tolerance, size));
    CHECK(close(static_cast<double>(found.strut[0]), expected.strut, tolerance, size));
    CHECK(close(static_cast<double>(found.contact[0]), expected.contact, tolerance, size));
    CHECK(close(static_cast<double>(found.friction[0]), expected.friction, tolerance, size));
  }
}

TEST_CASE("Table 3 comes out to its last digit in double precision") { check_printed_columns<double>(); }
TEST_CASE("Table 3 comes out to its last digit in single precision") { check_printed_columns<float>(); }

TEST_CASE("the forces of the cable-roller model are those of its closed form") {
  check_closed_form<double>(1e-12);
  check_closed_form<float>(1e-6);
}

TEST_CASE("without friction both segments of the cable-roller model carry the same force") {
  const auto found = checked_answer<double>(cable_roller(0), roller_drive);
  CHECK(close(found.tension[0], found.tension[1], 1e-12));
  CHECK(found.state[0] == taut::JointState::forward);
}

TEST_CASE(
    "from mu = tan(67.5 degrees) on the cable holds and nothing reaches the segment behind the roller") {
  const auto found = checked_answer<double>(cable_roller(2.42), roller_drive);
  CHECK(std::fabs(found.tension[0]) < 1e-9);
  CHECK(found.slip[0] == 0);
  CHECK(found.state[0] == taut::JointState::stick);
  const auto just_below = checked_answer<double>(cable_roller(2.41), roller_drive);
  CHECK(just_below.tension[0] > 0.1);
  CHECK(just_below.state[0] == taut::JointState::forward);
}

TEST_CASE("the cable drawn over the roller is what the upper segment stretches") {
  for (const double mu : {0.0, 0.1, 0.5}) {
    CAPTURE(mu);
    const double stretch = roller_by_hand(mu).upper * std::sqrt(2.0) / (E_steel * A_members);
    CHECK(close(checked_answer<double>(cable_roller(mu), roller_drive).slip[0], stretch, 1e-12));
  }
}

}  // namespace

}  // namespace table_3_cable_roller_test
