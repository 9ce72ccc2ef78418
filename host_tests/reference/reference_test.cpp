// The reference against what can be worked out by hand.
#include "reference/reference.hpp"

#include <doctest/doctest.h>

#include "support/scenes.hpp"

using namespace support;
using reference::Exact;
using reference::Reference;

namespace {

using Sample = taut::Sample<double, PlaneCapacity>;
constexpr Exact rounding = 1e-15L;  // a few thousand operations in long double
constexpr Exact EA = Exact(cable_E) * Exact(cable_A);
Plane scene;

Sample jack_force(double force) {
  Sample sample;
  sample.jack[0][1].force = force;
  return sample;
}
bool close_to(Exact value, Exact expected, Exact scale) {
  return std::fabs(value - expected) <= rounding * scale;
}
Exact chain_ratio(double mu, int joint) {
  const Exact kappa = Exact(mu) * std::tan(Exact(chain_turn[joint]) / 2);
  return (1 - kappa) / (1 + kappa);
}

}  // namespace

TEST_CASE("over rigid saddles the jack's force falls by the ratio of every joint") {
  const double mu = 0.3;
  rigid_saddles(scene, steel_cable(mu), chain_points(8));
  Reference found(scene);
  REQUIRE(found.start());
  REQUIRE(found.advance(jack_force(2e5)));
  Exact T = 2e5L;
  for (int i = 7; i >= 0; --i) {
    CAPTURE(i);
    // The points are rounded to double, and with them the turning angles.
    CHECK(std::fabs(found.tension(i) - T) <= 1e-14L * 2e5L);
    if (i > 0) T *= chain_ratio(mu, i - 1);
  }
}

TEST_CASE("the loaded cable over a roller shares its load as friction allows") {
  // Strut and loaded segment are equal bars side by side: loaded + far / sqrt(2) = 500 N; far = rho loaded.
  for (const double mu : {0.0, 0.1, 0.2, 0.5}) {
    CAPTURE(mu);
    taut::Cable<double> cable;
    cable.E = steel;
    cable.A = 1e-4;
    cable.mu = mu;
    cable_roller(scene, cable);
    Reference found(scene);
    REQUIRE(found.start());
    Sample sample;
    sample.factor[0] = 1;
    REQUIRE(found.advance(sample));
    const Exact kappa = Exact(mu) * (std::sqrt(Exact(2)) - 1);  // cot(67.5 degrees)
    const Exact rho = (1 - kappa) / (1 + kappa);
    const Exact loaded = found.tension(1), far = found.tension(0);
    CHECK(close_to(loaded + far / std::sqrt(Exact(2)), 500, 1000));
    CHECK(close_to(far, rho * loaded, 1000));
    CHECK(close_to(found.strut(0) + loaded, 1000, 1000));
  }
}

TEST_CASE("a released joint sticks until its friction has turned round") {
  rigid_saddles(scene, steel_cable(0.4), chain_points(2));
  const Exact rho = chain_ratio(0.4, 0), F = 1e5L;
  Reference found(scene);
  REQUIRE(found.start());
  REQUIRE(found.advance(jack_force(1e5)));
  CHECK(std::fabs(found.tension(0) - rho * F) <= 1e-14L * F);
  const Exact slip = found.slip(0);
  CHECK(std::fabs(slip - rho * F * Exact(chain_length(0)) / EA) <= 1e-14L * slip);
  const double held = double(F * rho * rho) * 1.001;
  REQUIRE(found.advance(jack_force(held)));
  CHECK(std::fabs(found.tension(0) - rho * F) <= 1e-14L * F);
  CHECK(found.slip(0) == slip);
  REQUIRE(found.advance(jack_force(3e4)));
  CHECK(std::fabs(found.tension(0) - 3e4L / rho) <= 1e-14L * F);
  REQUIRE(found.advance(jack_force(3e4 * 1.01)));
  CHECK(std::fabs(found.tension(0) - 3e4L / rho) <= 1e-14L * F);
  REQUIRE(found.advance(jack_force(0)));
  CHECK(std::fabs(found.tension(0)) <= 1e-15L * F);
  REQUIRE(found.advance(jack_force(1e5)));
  CHECK(std::fabs(found.tension(0) - rho * F) <= 1e-14L * F);
}

TEST_CASE("two jacks meet where the friction from both sides holds the same force") {
  rigid_saddles(scene, steel_cable(0.3, two_jacks), chain_points(6));
  Reference found(scene);
  REQUIRE(found.start());
  Sample sample = jack_force(2e5);
  sample.jack[0][0].force = 1.9e5;
  REQUIRE(found.advance(sample));
  for (int i = 0; i < 6; ++i) {
    Exact from_start = 1.9e5L, from_end = 2e5L;
    for (int j = 0; j < i; ++j) from_start *= chain_ratio(0.3, j);
    for (int j = 4; j >= i; --j) from_end *= chain_ratio(0.3, j);
    CHECK(found.tension(i) >= std::max(from_start, from_end) * (1 - 1e-14L));
    if (i == 0) CHECK(close_to(found.tension(0), 1.9e5L, 2e5L));
    if (i == 5) CHECK(close_to(found.tension(5), 2e5L, 2e5L));
  }
}

TEST_CASE("a draw-in without friction costs EA / L x seating everywhere, and more than all makes it slack") {
  Exact length = 0;
  for (int i = 0; i < 4; ++i) length += Exact(chain_length(i));
  for (const double seating : {1e-3, 0.1}) {
    taut::Cable<double> cable = steel_cable(0);
    cable.seating = seating;
    rigid_saddles(scene, cable, chain_points(4));
    Reference found(scene);
    REQUIRE(found.start());
    REQUIRE(found.advance(jack_force(2e5)));
    Sample locked = jack_force(2e5);
    locked.jack[0][1].locked = true;
    REQUIRE(found.advance(locked));
    const Exact expected = std::max(Exact(0), 2e5L - EA / length * Exact(seating));
    for (int i = 0; i < 4; ++i) CHECK(std::fabs(found.tension(i) - expected) <= 1e-13L * 2e5L);
    REQUIRE(found.advance(jack_force(1e5)));
    for (int i = 0; i < 4; ++i) CHECK(std::fabs(found.tension(i) - 1e5L) <= 1e-13L * 2e5L);
  }
}

TEST_CASE("jacks that differ by more than all friction are refused where they begin to") {
  rigid_saddles(scene, steel_cable(0.3, two_jacks), chain_points(4));
  Reference found(scene);
  REQUIRE(found.start());
  Sample even = jack_force(1e5);
  even.jack[0][0].force = 1e5;
  REQUIRE(found.advance(even));
  Sample uneven = jack_force(2e5);
  uneven.jack[0][0].force = 1e5;
  CHECK(!found.advance(uneven));
  Exact carried = 1;
  for (int j = 0; j < 3; ++j) carried *= chain_ratio(0.3, j);
  CHECK(std::fabs(found.fraction() - (1 / carried - 1)) <= 1e-13L);
}

TEST_CASE("of a refusal it is known by how much there is no answer") {
  // Sticking would lose rho T_big at the limit; sliding between two jacks nothing resists.
  rigid_saddles(scene, steel_cable(0.3, two_jacks), chain_points(2));
  Reference found(scene);
  REQUIRE(found.start());
  Sample even = jack_force(1e5);
  even.jack[0][0].force = 1e5;
  REQUIRE(found.advance(even));
  Sample uneven = jack_force(2e5);
  uneven.jack[0][0].force = 1e5;
  CHECK(!found.advance(uneven));
  CHECK(std::fabs(found.clearance() - chain_ratio(0.3, 0)) <= 1e-13L);
}

TEST_CASE("two jacks on a cable without a joint must pull alike") {
  rigid_saddles(scene, steel_cable(0.3, two_jacks), chain_points(1));
  Reference found(scene);
  REQUIRE(found.start());
  Sample sample = jack_force(2e5);
  sample.jack[0][0].force = 1e5;
  CHECK(!found.advance(sample));
  CHECK(found.fraction() == 0);
  CHECK(found.clearance() == 0.5L);
  sample.jack[0][0].locked = true;
  REQUIRE(found.advance(sample));
  CHECK(found.tension(0) == 2e5L);
}

TEST_CASE("nothing is left behind a joint that all but locks when the jack is released to zero") {
  taut::Cable<double> cable = steel_cable(50);
  cable.law = taut::FrictionLaw::capstan;
  rigid_saddles(scene, cable, chain_points(3));
  Reference found(scene);
  REQUIRE(found.start());
  for (int round = 0; round < 3; ++round) {
    REQUIRE(found.advance(jack_force(1e5)));
    const Exact rho = std::exp(-50 * Exact(chain_turn[1]));
    CHECK(std::fabs(found.tension(1) - rho * 1e5L) <= 1e-12L * rho * 1e5L);
    REQUIRE(found.advance(jack_force(0)));
    for (int i = 0; i < 3; ++i) CHECK(found.tension(i) == 0);
  }
}
