// Scenes that break solvers: the answer must be that of the reference.
#include "hard_cases/hard_case.hpp"
#include "support/equilibrium.hpp"
#include "support/transform.hpp"

using namespace hard;
using namespace support;

namespace {

constexpr double F = 2e5;  // [N]
Saddles chain;
Plane plane, other;
Space space;

taut::Cable<double> prestrained(double mu, double prestrain) {
  taut::Cable<double> cable = steel_cable(mu, anchored);
  cable.prestrain = prestrain;
  return cable;
}

/// One load pattern from factor to factor, without jacks.
Samples<Plane> load_factors(int load, const std::vector<double>& factors) {
  Samples<Plane> samples;
  for (const double factor : factors) {
    samples.push_back({});
    samples.back().factor[load] = factor;
  }
  return samples;
}

/// Loads and a jack force at the end, row by row.
Samples<Plane> loads_and_jack(const std::vector<std::array<double, 3>>& rows) {
  Samples<Plane> samples;
  for (const auto& row : rows) {
    samples.push_back({});
    samples.back().factor[0] = row[0];
    samples.back().factor[1] = row[1];
    samples.back().jack[0][1].force = row[2];
  }
  return samples;
}
const std::vector<std::array<double, 3>> usual_history = {
    {0, 0, F}, {2, 0, F}, {2, 0, F / 3}, {2, 1, 1.3 * F}, {-1, 1, F}, {1, 0, 0.1 * F}, {1, 0, F}};

template <class SceneType>
Samples<SceneType> with_jack(const Samples<SceneType>& samples, double times) {
  Samples<SceneType> changed = samples;
  for (auto& sample : changed)
    for (auto& jack : sample.jack[0]) jack.force *= times;
  return changed;
}

}  // namespace

HARD_CASE(from_zero, "all joints at both limits at once",
          "every path starts at zero tension, where each joint could slide either way") {
  saddles(chain, steel_cable(0.3), chain_points(8));
  Measured all = follow(chain, jack_forces<Saddles>({F}));
  truss_string(plane, steel_cable(0.3), 8);
  return all |= follow(plane, loads_and_jack({{0, 0, F}, {1, 0, F}}));
}

HARD_CASE(equal_jacks, "two equal jacks",
          "the cable has no place of its own, and the middle joint no direction") {
  saddles(chain, steel_cable(0.3, two_jacks), chain_points(8));
  Measured all = follow(chain, two_jack_forces<Saddles>({{F, F}, {F / 4, F / 4}, {F, F}, {0, 0}, {F, F}}));
  truss_string(plane, steel_cable(0.3, two_jacks), 8);
  return all |= follow(plane, two_jack_forces<Plane>({{F, F}, {F / 4, F / 4}, {F, F}, {0, 0}, {F, F}}));
}

HARD_CASE(unequal_jacks, "two unequal jacks",
          "flipping one state after the other cycles; the turning joint wanders along the cable") {
  const std::vector<std::array<double, 2>> forces = {{F, 0.9 * F},       {0.8 * F, F},       {F, F},
                                                     {0.5 * F, 0.5 * F}, {0.5 * F, 0.6 * F}, {0.9 * F, F}};
  saddles(chain, steel_cable(0.4, two_jacks), chain_points(8));
  Measured all = follow(chain, two_jack_forces<Saddles>(forces));
  truss_string(plane, steel_cable(0.4, two_jacks), 8);
  return all |= follow(plane, two_jack_forces<Plane>(forces));
}

HARD_CASE(one_jack_released, "one of two jacks released as far as friction allows, and the other one locked",
          "all joints slide at the same moment when the friction is nearly used up") {
  saddles(chain, steel_cable(0.3, two_jacks), chain_points(6));
  double carried = 1;
  for (int j = 0; j < 5; ++j) carried *= static_cast<double>(Anatomy<Saddles>(chain).ratio(0, j));
  auto samples =
      two_jack_forces<Saddles>({{F, F}, {F * carried * 1.0001, F}, {F, F}, {F, 0}, {F / 5, 0}, {0, 0}});
  for (std::size_t row = 3; row < samples.size(); ++row) samples[row].jack[0][1].locked = true;
  return follow(chain, samples);
}

HARD_CASE(rejacking, "full release and jacking again",
          "on the way to zero all joints slide back and meet both limits together at its end") {
  saddles(chain, steel_cable(0.3), chain_points(8));
  const std::vector<double> forces = {F, 0, F, 0, 1e-9 * F, F, 1e-13 * F, F};
  Measured all = follow(chain, jack_forces<Saddles>(forces));
  truss_string(plane, steel_cable(0.3), 8);
  return all |= follow(plane, jack_forces<Plane>(forces));
}

HARD_CASE(lock_off, "lock-off with draw-in, slack behind the wedge, jacking again",
          "an extension becomes prescribed and free again, once with the cable slack") {
  taut::Cable<double> cable = steel_cable(0.3);
  Measured all;
  for (const double seating : {3e-3, 0.1}) {
    cable.seating = seating;
    saddles(chain, cable, chain_points(6));
    auto samples = jack_forces<Saddles>({F, 0, F / 2, 1.2 * F, 0, F});
    samples[1].jack[0][1].locked = samples[4].jack[0][1].locked = true;
    all |= follow(chain, samples);
  }
  cable.seating = 3e-3;
  truss_string(plane, cable, 7);
  auto rows = loads_and_jack({{0, 0, F}, {0, 0, 0}, {2, 0, 0}, {-1, 1, 0}, {0, 0, 1.2 * F}});
  for (std::size_t row = 1; row < 4; ++row) rows[row].jack[0][1].locked = true;
  return all |= follow(plane, rows);
}

HARD_CASE(symmetric, "symmetric scenes", "many joints begin to slide at the same moment") {
  truss_string(plane, prestrained(0.2, 1e-3), 8);
  Measured all = follow(plane, load_factors(0, {1, 3, 0, 5, -2, 3}));
  taut::Cable<double> hoop = steel_cable(0.1, anchored);
  hoop.prestrain = 1e-3;
  dome_ring(space, hoop, 8);
  Samples<Space> rows(4);
  rows[0].factor[0] = 1;
  rows[1].factor[0] = rows[1].factor[1] = 1;
  rows[3].factor[1] = 2;
  return all |= follow(space, rows);
}

HARD_CASE(almost_locked, "mu within 1e-6 of locking",
          "the ratio that friction holds is a small difference of large numbers") {
  const auto points = path_points({3, 4, 5}, {0.8, 0.5});
  Measured all;
  for (const double off : {1e-6, -1e-6, 1e-12, 0.0}) {
    saddles(chain, steel_cable(1), points);
    chain.mu[0] = (1 - off) / std::tan(0.4);
    chain.mu[1] = 0.3;
    // Released but for a rest: behaviour.cpp has the full release.
    all |= follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 1e-3 * F, F}));
  }
  return all;
}

HARD_CASE(almost_frictionless, "mu within 1e-6 of zero, and zero",
          "the cone is so thin that a joint is always next to both limits") {
  Measured all;
  for (const double mu : {0.0, 1e-6, 1e-9}) {
    saddles(chain, steel_cable(mu), chain_points(8));
    all |= follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 0, F}));
    truss_string(plane, steel_cable(mu), 6);
    all |= follow(plane, loads_and_jack(usual_history));
  }
  return all;
}

HARD_CASE(straight, "turning angles of 1e-6 and none",
          "contact hardly presses, and the cosine of the half angle is lost in rounding") {
  saddles(chain, steel_cable(0.3), path_points({3, 4, 5, 3, 4}, {1e-6, 0.4, 0, -1e-6}));
  return follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 0, F}));
}

HARD_CASE(sharp, "half angles of one degree", "cot(alpha) is 57: hardly any mu does not lock") {
  const double turn = pi * (1 - 2.0 / 180);
  Measured all;
  for (const double mu : {0.001, 0.015, 0.3}) {
    saddles(chain, steel_cable(mu), path_points({3, 4, 5}, {turn, -turn}));
    all |= follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 0, F}));
  }
  return all;
}

static Measured stiffness_ratio(double ratio) {
  truss_string(plane, steel_cable(0.3), 6);
  for (auto& strut : plane.struts) strut.E *= ratio;
  return follow(plane, loads_and_jack(usual_history));
}

HARD_CASE(soft_structure, "a structure 1e-3 times as stiff as its cable",
          "elongations of the cable are small differences of displacements") {
  return stiffness_ratio(1e-3);
}

HARD_CASE(softest_structure, "a structure 1e-6 times as stiff as its cable",
          "the condensation loses six digits more than usual") {
  return stiffness_ratio(1e-6);
}

HARD_CASE(stiff_structure, "a structure 1e3 and 1e6 times as stiff as its cable",
          "the cable is lost in the stiffness of its nodes") {
  Measured all = stiffness_ratio(1e3);
  return all |= stiffness_ratio(1e6);
}

HARD_CASE(long_and_short, "segments of 1 mm beside 100 m", "EA/L differs by 1e5 from segment to segment") {
  saddles(chain, steel_cable(0.3), path_points({1e-3, 100, 1e-3, 1e-3, 50, 1e-3}, {0.3, 0.2, 0.4, 0.1, 0.3}));
  Measured all = follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 0, F}));
  taut::Cable<double> cable = steel_cable(0.3, two_jacks);
  saddles(chain, cable, path_points({1e-3, 100, 1e-3, 1e-3, 50, 1e-3}, {0.3, 0.2, 0.4, 0.1, 0.3}));
  return all |= follow(chain, two_jack_forces<Saddles>({{F, F}, {0.9 * F, F}, {F / 3, F / 3}}));
}

HARD_CASE(tiny_and_huge, "forces of 1e-3 N and 1e9 N",
          "a tolerance in newtons would be wrong for one of them") {
  Measured all;
  for (const double force : {1e-3, 1e9}) {
    taut::Cable<double> cable = steel_cable(0.3);
    // No cable carries more than a tenth of its E A.
    if (force > F) cable.A *= force / F;
    truss_string(plane, cable, 8);
    for (auto& given : plane.forces)
      for (double& x : given.force) x *= force / F;
    all |= follow(plane, with_jack<Plane>(loads_and_jack(usual_history), force / F));
  }
  return all;
}

HARD_CASE(units, "newton and millimetre, kilonewton and metre",
          "stiffnesses and forces are other numbers; a tolerance in SI units would be wrong") {
  truss_string(plane, steel_cable(0.3), 8);
  change_units(plane, other, 1000, 1);
  Measured all = follow(other, loads_and_jack(usual_history));
  change_units(plane, other, 1, 1e-3);
  return all |= follow(other, with_jack<Plane>(loads_and_jack(usual_history), 1e-3));
}

HARD_CASE(
    slack_beside_taut, "slack spans beside taut ones",
    "a self-locking joint divides the cable: one part goes slack and comes back while the other one works") {
  truss_string(plane, prestrained(0.2, 4e-4), 8);
  plane.mu[3] = 50;
  Measured all = follow(plane, load_factors(1, {2, 6, 12, 3, 8, -2, 10, 0}));
  saddles(chain, prestrained(0.2, 1e-3), chain_points(8));
  chain.cables[0].alpha = 1e-5;
  chain.mu[3] = 50;
  for (int i = 0; i < 4; ++i) chain.prestrain[i] = 3e-4 + 1e-4 * i;
  chain.add_temperature(chain.add_load(), 0, 1);
  Samples<Saddles> rows(6);
  const double kelvin[] = {30, 80, 120, 60, -10, 90};
  for (std::size_t i = 0; i < 6; ++i) rows[i].factor[0] = kelvin[i];
  return all |= follow(chain, rows);
}

HARD_CASE(capstan, "ducts with wobble and no turning angle",
          "the ratio comes from the length alone; alpha is a right angle") {
  taut::Cable<double> cable = steel_cable(0.2);
  cable.law = taut::FrictionLaw::capstan;
  cable.wobble = 0.005;
  saddles(chain, cable, path_points({5, 6, 7, 8, 5, 6}, {0, 0.3, 0, 0, -0.3}));
  return follow(chain, jack_forces<Saddles>({F, F / 3, 1.5 * F, 0, F}));
}

HARD_CASE(creeping, "a sample path a thousand times longer than what it changes",
          "loads that cancel leave a small change between large numbers") {
  truss_string(plane, steel_cable(0.3), 6);
  // Load 1 acts upwards on the left half: against load 0 it relieves it.
  return follow(plane, loads_and_jack({{0, 0, F}, {300, 300, F}, {300, 301, F}, {301, 300, F}, {0, 0, F}}));
}
