// Friction laws: from angle and mu to the tension ratio at which a cable slides.
#include "taut/scene/friction.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/scenes.hpp"
#include "taut/elements/friction_element.hpp"

namespace friction_test {
using namespace taut;

namespace {

constexpr double rounding = 1e-15;  // a few operations, results of order one

/// Angles that a cable makes at a joint: half of the opening angle alpha, and the turning angle beta.
double turning(double alpha) { return support::pi - 2 * alpha; }

}  // namespace

TEST_CASE("the tensions at the limit of a point contact satisfy Coulomb's law") {
  for (const double alpha : {0.2, 0.8, 1.2, 1.5})
    for (const double mu : {0.0, 0.05, 0.15}) {
      const double rho = point_contact_limit(mu, std::cos(alpha), std::sin(alpha)).rho();
      const double T1 = rho, T2 = 1;
      CHECK((T2 - T1) * std::sin(alpha) == doctest::Approx(mu * (T1 + T2) * std::cos(alpha)).epsilon(1e-14));
    }
}

TEST_CASE("the tensions at the limit of a saddle satisfy Euler's and Eytelwein's law with wobble") {
  for (const double alpha : {0.2, 0.8, 1.5})
    for (const double mu : {0.0, 0.2, 0.7}) {
      const double rho = capstan_limit(mu, std::cos(alpha), std::sin(alpha), 0.01, 6.0).rho();
      CHECK(rho == doctest::Approx(std::exp(-mu * (turning(alpha) + 0.06))).epsilon(1e-14));
    }
}

TEST_CASE("a saddle is a point contact of mu_eff = tan(alpha) tanh(mu beta / 2)") {
  for (const double alpha : {0.3, 0.9, 1.4})
    for (const double mu : {0.1, 0.4, 2.0}) {
      const double mu_eff = std::tan(alpha) * std::tanh(mu * turning(alpha) / 2);
      const auto saddle = capstan_limit(mu, std::cos(alpha), std::sin(alpha), 0.0, 0.0);
      const auto point = point_contact_limit(mu_eff, std::cos(alpha), std::sin(alpha));
      CHECK(saddle.rho() == doctest::Approx(point.rho()).epsilon(1e-13));
    }
}

TEST_CASE("a point contact is self-locking from mu cot(alpha) = 1 on, and not before") {
  const double cos_alpha = 0.6, sin_alpha = 0.8;  // cot = 3/4
  CHECK_FALSE(point_contact_limit(1.333, cos_alpha, sin_alpha).is_self_locking());
  CHECK(point_contact_limit(4.0 / 3 + 1e-12, cos_alpha, sin_alpha).is_self_locking());
  CHECK(point_contact_limit(5.0, cos_alpha, sin_alpha).rho() == 0);
  CHECK(point_contact_limit(1.333, cos_alpha, sin_alpha).rho() > 0);
}

TEST_CASE("a straight cable over a point slides freely and in a duct with wobble does not") {
  CHECK(point_contact_limit(0.9, 0.0, 1.0).rho() == 1);
  CHECK(capstan_limit(0.9, 0.0, 1.0, 0.0, 10.0).rho() == 1);
  CHECK(capstan_limit(0.2, 0.0, 1.0, 0.005, 10.0).rho() ==
        doctest::Approx(std::exp(-0.01)).epsilon(rounding));
}

TEST_CASE("without friction nothing is held back") {
  CHECK(point_contact_limit(0.0, 0.7, 0.7).rho() == 1);
  CHECK(capstan_limit(0.0, 0.7, 0.7, 0.01, 10.0).rho() == 1);
}

TEST_CASE("the wobble of a joint acts over half of each adjacent segment") {
  support::Plane scene;
  Cable<double> cable = support::steel_cable(0.3);
  cable.law = FrictionLaw::capstan;
  cable.wobble = 0.02;
  support::rigid_saddles(scene, cable, {{0, 0}, {2, 0}, {7, 0}});
  const auto joint = FrictionElement<double, 2>::of(scene, 0, 0);
  CHECK(joint.limit.rho() == doctest::Approx(std::exp(-0.3 * 0.02 * (1 + 2.5))).epsilon(1e-14));
}

TEST_CASE("a friction limit keeps its digits for turning angles down to a millionth") {
  for (const double beta : {1e-2, 1e-4, 1e-6}) {
    support::Plane scene;
    support::rigid_saddles(scene, support::steel_cable(0.5),
                           {{-1, 0}, {0, 0}, {std::cos(beta), std::sin(beta)}});
    // cot(alpha) = tan(beta / 2); the coordinates themselves hold beta to 1e-16.
    const double expected = 0.5 * std::tan(beta / 2);
    const auto joint = FrictionElement<double, 2>::of(scene, 0, 0);
    CHECK(joint.limit.kappa == doctest::Approx(expected).epsilon(1e-15 / beta));
  }
}

}  // namespace friction_test
