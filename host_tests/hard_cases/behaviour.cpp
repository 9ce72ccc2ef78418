// Where the answer is a refusal, one of several, or the same as that of another question.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numeric>

#include "hard_cases/follow.hpp"
#include "hard_cases/long_run.hpp"
#include "support/equilibrium.hpp"
#include "support/status_check.hpp"
#include "support/transform.hpp"

using namespace hard;
using namespace support;
using taut::Code;
using taut::Place;

namespace {

constexpr double F = 2e5;  // [N]
Saddles chain;
Plane plane, other_plane;
Space space, other_space;

/// Parts of the largest force so far.
double difference(const std::vector<double>& a, const std::vector<double>& b, double peak) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most / peak;
}
template <class Scalar, class SceneType>
double difference(Run<Scalar, SceneType>& a, Run<Scalar, SceneType>& b) {
  return difference(a.tensions(), b.tensions(), a.peak());
}

double ratio(const Saddles& scene, int joint) {
  return static_cast<double>(Anatomy<Saddles>(scene).ratio(0, joint));
}

/// Up, back, over and down: every joint slides both ways.
const std::vector<std::array<double, 3>> history = {{0, 0, F},       {2, 0, F},  {2, 0, F / 3},
                                                    {1, 1, 1.3 * F}, {-1, 1, F}, {1, 0, 0.2 * F}};

template <class SceneType>
Samples<SceneType> loads_and_jack(std::size_t jacked_end = 1) {
  Samples<SceneType> samples;
  for (const auto& row : history) {
    samples.push_back({});
    samples.back().factor[0] = row[0];
    samples.back().factor[1] = row[1];
    samples.back().jack[0][jacked_end].force = row[2];
  }
  return samples;
}

template <class Scalar, class SceneType>
void advance_all(Run<Scalar, SceneType>& run, const Samples<SceneType>& samples) {
  REQUIRE(run.status().ok());
  for (const auto& sample : samples) REQUIRE(run.advance(sample).status.code == Code::ok);
}

/// Rounding of the condensation of a structure that is written down in another way, and of some events.
constexpr double rounding = 1e-11;

/// xorshift64: the noise of a jack's load cell.
class Noise {
 public:
  /// In [-1, 1).
  double operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
  }

 private:
  std::uint64_t state_ = 88172645463325252u;
};

}  // namespace

TEST_CASE("a long noisy cycling jack does not drift: hard because friction keeps what every sample did") {
  // At the end the jack has been released and pulls again: nothing of before can be left.
  truss_string(plane, steel_cable(0.2), 6);
  saddles(chain, steel_cable(0.2), chain_points(8));
  Run<double, Plane> plane_run(plane), fresh_plane(plane);
  Run<double, Saddles> chain_run(chain), fresh_chain(chain);
  Noise noise;
  auto plane_sample = Samples<Plane>(1)[0];
  auto chain_sample = Samples<Saddles>(1)[0];
  const auto pull = [&](auto& on_plane, auto& on_chain, double force, double load) {
    plane_sample.jack[0][1].force = chain_sample.jack[0][1].force = force;
    plane_sample.factor[0] = load;
    return on_plane.advance(plane_sample).status.ok() && on_chain.advance(chain_sample).status.ok();
  };
  bool good = true;
  for (long i = 0; i < long_run_samples; ++i) {
    const double cycle = 0.5 + 0.45 * std::sin(static_cast<double>(i) * 0.01);
    good = good && pull(plane_run, chain_run, F * (cycle + 0.04 * noise()), 0.3 * noise());
  }
  CHECK(good);
  for (const double force : {1.2 * F, 0.0, 0.9 * F, 0.3 * F, 0.7 * F})
    REQUIRE(pull(plane_run, chain_run, force, 0));
  for (const double force : {1.2 * F, 0.0, 0.9 * F, 0.3 * F, 0.7 * F})
    REQUIRE(pull(fresh_plane, fresh_chain, force, 0));
  CHECK(difference(plane_run, fresh_plane) <= 1e-12);
  CHECK(difference(chain_run, fresh_chain) <= 1e-12);
  CHECK(plane_run.verified() <= 1e-12);
}

TEST_CASE("of a long noisy log only the nested turning points matter: hard because every one is remembered") {
  saddles(chain, steel_cable(0.2), chain_points(8));
  Run<double, Saddles> run(chain), fresh(chain);
  Noise noise;
  std::vector<double> forces;
  for (int i = 0; i < 20000; ++i) forces.push_back(F * (1 + 0.6 * noise()));
  advance_all(run, jack_forces<Saddles>(forces));
  // The highest force, the lowest one after it, the highest one after that, and so on.
  std::vector<double> turning;
  for (auto at = forces.begin(); at != forces.end(); ++at) {
    at = turning.size() % 2 == 0 ? std::max_element(at, forces.end()) : std::min_element(at, forces.end());
    turning.push_back(*at);
  }
  advance_all(fresh, jack_forces<Saddles>(turning));
  CHECK(difference(run, fresh) <= 1e-12);
}

TEST_CASE_TEMPLATE(
    "a joint whose sliding sets its node free is named: hard because all is well while it sticks", Scalar,
    double, float) {
  // A vertical pin-ended strut: T cos is equal on both sides whatever the friction.
  plane = {};
  const int left = plane.add_node({-6, 0}, taut::held_xy), top = plane.add_node({0, 0}, taut::held_xy);
  const int right = plane.add_node({2, 0}, taut::held_xy), foot = plane.add_node({0, -2});
  plane.add_strut(top, foot, steel, 1e-3);
  plane.add_cable(steel_cable(0.05), {left, foot, right});
  Run<Scalar, Plane> run(plane);
  REQUIRE(run.status().ok());
  const auto progress = run.advance(jack_forces<Plane>({F})[0]);
  CHECK_STATUS(progress.status, Code::mechanism, Place::joint, 0, 0);
  CHECK(progress.fraction < 1);
}

TEST_CASE_TEMPLATE(
    "two jacks are refused where the friction is used up: hard because just before all is well", Scalar,
    double, float) {
  saddles(chain, steel_cable(0.3, two_jacks), chain_points(6));
  double carried = 1;
  for (int j = 0; j < 5; ++j) carried *= ratio(chain, j);
  for (const bool start_is_stronger : {false, true}) {
    CAPTURE(start_is_stronger);
    Run<Scalar, Saddles> run(chain);
    REQUIRE(run.status().ok());
    const auto samples =
        two_jack_forces<Saddles>({{F, F}, {start_is_stronger ? 3 * F : F, start_is_stronger ? F : 3 * F}});
    REQUIRE(run.advance(samples[0]).status.ok());
    const auto progress = run.advance(samples[1]);
    CHECK_STATUS(progress.status, Code::pulled_through, Place::cable, 0);
    // (1 + 2 fraction) carried = 1
    const double tolerance = sizeof(Scalar) == sizeof(float) ? 1e-4 : 1e-10;
    CHECK(std::fabs(static_cast<double>(progress.fraction) - (1 / carried - 1) / 2) <= tolerance);
    CHECK(run.verified() <= (sizeof(Scalar) == sizeof(float) ? 1e-5 : 1e-9));
  }
}

TEST_CASE(
    "of several possible answers one is reported: hard because uniqueness holds for small friction only") {
  // Klarbring 1990 and Hassani, Ionescu and Hild show frictional contact problems with several solutions;
  // only below a friction that depends on the structure is there but one. Here a foot is free to swing:
  // sliding forwards lets the foot follow, which loads the joint more than the slip relieves it.
  plane = {};
  const int left = plane.add_node({-6, 0}, taut::held_xy), top = plane.add_node({0, 0}, taut::held_xy);
  const int right = plane.add_node({2, 0}, taut::held_xy), foot = plane.add_node({0, -2});
  const double sideways[] = {1e5, 0, 0, 0};
  plane.add_strut(top, foot, steel, 1e-3);
  plane.add_substructure(&foot, 1, sideways);
  taut::Cable<double> cable = steel_cable(0.5, anchored);
  cable.prestrain = 1e-3;
  plane.add_cable(cable, {left, foot, right});
  plane.add_force(plane.add_load(), foot, {-1e5, 0});
  Run<double, Plane> run(plane);
  REQUIRE(run.status().ok());
  reference::Reference reference(plane);
  REQUIRE(reference.start());

  // Beyond the limit there is no answer at all: the foot would swing away.
  auto beyond = Samples<Plane>(1)[0];
  beyond.factor[0] = 10;
  const auto progress = run.advance(beyond);
  CHECK(!progress.status.ok());
  CHECK(progress.status.place == Place::joint);
  CHECK(!reference.advance(beyond));
  CHECK(std::fabs(progress.fraction - static_cast<double>(reference.fraction())) <= 1e-9);
  CHECK(run.verified() <= 1e-9);

  // Back from the limit the joint may stick, or slide on.
  auto back = beyond;
  back.factor[0] = 10 * progress.fraction * 0.999;
  const auto possible = reference.possible_rates(back);
  CHECK(possible.size() == 2);
  const auto before = run.tensions();
  REQUIRE(run.advance(back).status.ok());
  CHECK(run.verified() <= 1e-9);
  double nearest = 1;
  for (const auto& rates : possible) {
    std::vector<double> expected = before;
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] += static_cast<double>(rates[i]);
    nearest = std::min(nearest, difference(expected, run.tensions(), run.peak()));
  }
  CHECK(nearest <= 1e-9);
}

TEST_CASE(
    "full release past an nearly self-locking joint leaves no more than the force tolerance over its ratio") {
  // Hard because whether the joint is at its limit is asked in T_small - rho T_big: with T_small = 0 the
  // tension behind it is known to the force tolerance (1e-12 of the largest force) over rho only.
  saddles(chain, steel_cable(0.3), path_points({3, 4, 5}, {0.8, 0.5}));
  for (const double off : {1e-6, 1e-4, 1e-2}) {
    CAPTURE(off);
    chain.mu[0] = (1 - off) / std::tan(0.4);
    Run<double, Saddles> run(chain);
    advance_all(run, jack_forces<Saddles>({F, 0}));
    CHECK(run.tension(0) <= 1e-12 * F / ratio(chain, 0));
    CHECK(run.verified() <= 1e-12);
  }
}

TEST_CASE("an event budget of one ends in the same state: hard because a call stops between two samples") {
  truss_string(plane, steel_cable(0.3), 8);
  Run<double, Plane> run(plane), in_calls(plane);
  advance_all(run, loads_and_jack<Plane>());
  int longest = 0;
  for (const auto& sample : loads_and_jack<Plane>()) {
    int calls = 0;
    for (bool there = false; !there; ++calls) {
      REQUIRE(calls < 1000);
      const auto progress = in_calls.advance(sample, 1);
      REQUIRE(progress.status.ok());
      REQUIRE(progress.events <= 1);
      there = progress.fraction >= 1;
      CHECK(in_calls.verified() <= 1e-12);
    }
    longest = std::max(longest, calls);
  }
  CHECK(longest > 3);
  CHECK(difference(run, in_calls) <= 1e-12);
}

TEST_CASE_TEMPLATE(
    "more than a cable can carry is refused by name: hard because one such number sets what counts as equal",
    Scalar, double, float) {
  truss_string(plane, steel_cable(0.3), 6);
  Run<Scalar, Plane> run(plane), without(plane);
  REQUIRE(run.status().ok());
  REQUIRE(without.status().ok());
  auto good = Samples<Plane>(1)[0];
  good.factor[0] = 1;
  const double most = 0.1 * cable_E * cable_A;
  // By small steps too, which need no events.
  for (const double force : {0.01 * most, 0.02 * most, 0.1 * most, 0.9 * most, 0.5 * most, 0.1 * most}) {
    CAPTURE(force);
    good.jack[0][1].force = force;
    REQUIRE(run.advance(good).status.ok());
    REQUIRE(without.advance(good).status.ok());
    const auto before = run.tensions();
    CHECK(before == without.tensions());
    for (const double wrong : {1.001 * most, 10 * most, 9.9e37}) {
      CAPTURE(wrong);
      auto sample = good;
      sample.jack[0][1].force = wrong;
      CHECK_STATUS(run.advance(sample).status, Code::bad_sample, Place::cable_end, 1, 0);
      CHECK(run.tensions() == before);
    }
    for (const double wrong : {1e9, -1e9, 9.9e37}) {
      CAPTURE(wrong);
      auto sample = good;
      sample.factor[1] = wrong;
      CHECK_STATUS(run.advance(sample).status, Code::bad_sample, Place::load, 1);
      CHECK(run.tensions() == before);
    }
  }
}

TEST_CASE_TEMPLATE("samples that cannot be used change nothing: hard because half of a sample may be good",
                   Scalar, double, float) {
  truss_string(plane, steel_cable(0.3), 6);
  Run<Scalar, Plane> run(plane);
  REQUIRE(run.status().ok());
  auto good = Samples<Plane>(1)[0];
  good.factor[0] = 1;
  good.jack[0][1].force = F;
  REQUIRE(run.advance(good).status.ok());
  const auto before = run.tensions();
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, huge, -huge, -1.0, -1e-30}) {
    CAPTURE(wrong);
    auto sample = good;
    sample.factor[0] = 3;
    sample.jack[0][1].force = wrong;
    CHECK_STATUS(run.advance(sample).status, Code::bad_sample, Place::cable_end, 1, 0);
    CHECK(run.tensions() == before);
  }
  for (const double wrong : {nan, huge, -huge}) {
    auto sample = good;
    sample.factor[1] = wrong;
    sample.jack[0][1].force = F / 2;
    CHECK_STATUS(run.advance(sample).status, Code::bad_sample, Place::load, 1);
    CHECK(run.tensions() == before);
  }
  // What does not move the model is not looked at.
  auto ignored = good;
  ignored.jack[0][0].force = nan;
  CHECK(run.advance(ignored).status.ok());
  CHECK(run.advance(good).status.ok());
  CHECK(run.tensions() == before);
}

TEST_CASE(
    "repeated samples change nothing, zero samples are ordinary: hard because the path has no direction") {
  truss_string(plane, steel_cable(0.3), 6);
  Run<double, Plane> run(plane);
  for (const auto& sample : loads_and_jack<Plane>()) {
    REQUIRE(run.advance(sample).status.ok());
    const auto before = run.tensions();
    for (int i = 0; i < 3; ++i) REQUIRE(run.advance(sample).status.ok());
    CHECK(difference(before, run.tensions(), F) <= 1e-14);
  }
  for (int i = 0; i < 3; ++i) {
    const auto progress = run.advance({});
    CHECK(progress.status.ok());
    CHECK(progress.fraction == 1);
    for (const double T : run.tensions()) CHECK(T <= 1e-12 * F);
  }
}

TEST_CASE(
    "a path run through from its end gives the mirrored answer: hard because ties are broken by number") {
  truss_string(plane, steel_cable(0.3), 7);
  reverse_paths(plane, other_plane);
  Run<double, Plane> run(plane), mirrored(other_plane);
  advance_all(run, loads_and_jack<Plane>(1));
  advance_all(mirrored, loads_and_jack<Plane>(0));
  auto tensions = mirrored.tensions();
  std::reverse(tensions.begin(), tensions.end());
  CHECK(difference(run.tensions(), tensions, run.peak()) <= rounding);
}

TEST_CASE("a scene turned in space gives the same answer: hard because no axis is special any more") {
  space_truss_string(space, steel_cable(0.3), 5);
  rotate(space, other_space,
         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix());
  Run<double, Space> run(space), turned(other_space);
  advance_all(run, loads_and_jack<Space>());
  advance_all(turned, loads_and_jack<Space>());
  CHECK(difference(run, turned) <= rounding);
}

TEST_CASE("nodes in another order give the same answer: hard because the elimination takes another order") {
  truss_string(plane, steel_cable(0.3), 8);
  std::vector<int> order(static_cast<std::size_t>(plane.nodes.size()));
  std::iota(order.begin(), order.end(), 0);
  Random random(7);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  permute_nodes(plane, other_plane, order);
  Run<double, Plane> run(plane), permuted(other_plane);
  advance_all(run, loads_and_jack<Plane>());
  advance_all(permuted, loads_and_jack<Plane>());
  CHECK(difference(run, permuted) <= rounding);
}
