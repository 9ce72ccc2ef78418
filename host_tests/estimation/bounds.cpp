// Bounds without history: every history that there can be stays within them, and some history reaches them.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "estimation/site.hpp"

namespace bounds_test {
using namespace estimation;

namespace {

constexpr double full = 2e5, least_known = 1e-9;
using Model = taut::Condensed<double, PlaneCapacity>;
using Known = taut::FrictionPrior<double, PlaneCapacity>;
using Ranges = taut::FixedArray<taut::ForceRange<double>, PlaneCapacity::segments>;

struct Bounded {
  Plane scene;
  Model model;
  Known known;

  void make(bool elastic, double mu, double mu_sd, bool shared = false, double scatter = 0) {
    taut::Cable<double> cable = support::steel_cable(mu);
    cable.mu_sd = mu_sd;
    cable.shared_mu = shared;
    cable.scatter = scatter;
    cable.cell[0].sd = cable.cell[1].sd = 100;
    if (elastic)
      support::truss_string(scene, cable, 6);
    else
      support::rigid_saddles(scene, cable, support::chain_points(7));
    REQUIRE(support::condense(scene, model).ok());
    taut::find_friction_prior(scene, known);
  }
  /// That the forces of a tracker are within the bounds that these readings give.
  void check_holds(const taut::Tracker<Model>& truth,
                   const std::array<taut::EndReading<double>, 2>& ends) const {
    Ranges ranges;
    REQUIRE(taut::find_bounds(model, known, ends, 0, ranges));
    for (int i = 0; i < model.segments; ++i) {
      CHECK(truth.tension(i) >= ranges[i].least * (1 - least_known));
      CHECK(truth.tension(i) <= ranges[i].most * (1 + least_known));
    }
  }
};

TEST_CASE("no history leads outside of the bounds that its last readings give") {
  static Bounded given;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    given.make(random.coin(), 0.2, 0.04);
    Plane actual = given.scene;
    for (int j = 0; j < actual.mu.size(); ++j) actual.mu[j] = random.between(0.12, 0.28);
    Model truth;
    REQUIRE(support::condense(actual, truth).ok());
    const auto tracker = std::make_unique<taut::Tracker<Model>>();
    REQUIRE(tracker->start(truth).status.ok());
    for (int turn = 0; turn < 6; ++turn) {
      taut::Sample<double, PlaneCapacity> sample;
      sample.jack[0][1].force = random.between(0.1, 1) * full;
      REQUIRE(tracker->advance(sample).status.ok());
      const int n = truth.segments;
      const std::array<taut::EndReading<double>, 2> ends{
          {{random.coin(), false, tracker->tension(0) + random.between(-200, 200), 0},
           {true, false, tracker->tension(n - 1) + random.between(-200, 200), 0}}};
      given.check_holds(*tracker, ends);
    }
  }
}

TEST_CASE("a shared mu that differs from joint to joint, and scatters, leaves the bounds no more often") {
  static Bounded given;
  constexpr double sd = 0.04, scatter = 0.1, widest = 2;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    given.make(random.coin(), 0.2, sd, true, scatter);
    double mean = 0;
    const int joints = given.scene.mu.size();
    for (int j = 0; j < joints; ++j) {
      given.scene.mu[j] = j % 2 == 0 ? 0.1 : 0.3;
      mean += given.scene.mu[j] / joints;
    }
    REQUIRE(support::condense(given.scene, given.model).ok());
    taut::find_friction_prior(given.scene, given.known);
    // As far as the band goes: by what is shared, by what is a joint's own, or both at once.
    Plane actual = given.scene;
    const double angle = random.between(0, 1.5), way = random.coin() ? 1 : -1;
    for (int j = 0; j < joints; ++j) {
      const double nominal = given.scene.mu[j], of_all = std::cos(angle) * sd * nominal / mean,
                   own = std::sin(angle) * scatter * nominal * random.between(-1, 1);
      actual.mu[j] = nominal + widest * way * (of_all + own);
    }
    Model truth;
    REQUIRE(support::condense(actual, truth).ok());
    const auto tracker = std::make_unique<taut::Tracker<Model>>();
    REQUIRE(tracker->start(truth).status.ok());
    for (const double force : {1.0, random.between(0.1, 1), random.between(0.1, 1)}) {
      taut::Sample<double, PlaneCapacity> sample;
      sample.jack[0][1].force = force * full;
      REQUIRE(tracker->advance(sample).status.ok());
      const int n = truth.segments;
      const std::array<taut::EndReading<double>, 2> ends{{{}, {true, false, tracker->tension(n - 1), 0}}};
      given.check_holds(*tracker, ends);
    }
  }
}

TEST_CASE("a reading that cannot be a force tells nothing") {
  static Bounded given;
  given.make(false, 0.2, 0.02);
  Ranges one, both;
  std::array<taut::EndReading<double>, 2> ends{{{}, {true, false, full, 0}}};
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, one));
  for (const double absurd :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), 1.001 * given.model.most_force[0]}) {
    CAPTURE(absurd);
    CHECK_FALSE(taut::find_bounds(given.model, given.known, {{{true, false, absurd, 0}, {}}}, 0, both));
    CHECK(both[0].least == 0);
    CHECK(both[0].most == std::numeric_limits<double>::infinity());
    ends[0] = {true, false, absurd, 0};
    CHECK(taut::find_bounds(given.model, given.known, ends, 0, both));
    for (int i = 0; i < given.model.segments; ++i) {
      CHECK(both[i].least == one[i].least);
      CHECK(both[i].most == one[i].most);
    }
  }
}

TEST_CASE("pulling and releasing reach both bounds") {
  static Bounded given;
  given.make(false, 0.2, 0);
  given.known.cell[0] = {};
  const auto tracker = std::make_unique<taut::Tracker<Model>>();
  REQUIRE(tracker->start(given.model).status.ok());
  const auto pull = [&](double force) {
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1].force = force;
    REQUIRE(tracker->advance(sample).status.ok());
  };
  Ranges ranges;
  const std::array<taut::EndReading<double>, 2> ends{{{}, {true, false, full, 0}}};
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, ranges));
  pull(full);
  for (int i = 0; i < given.model.segments; ++i)
    CHECK(std::fabs(tracker->tension(i) - ranges[i].least) < 1e-9 * full);
  pull(10 * full);
  pull(full);
  for (int i = 0; i < given.model.segments; ++i)
    CHECK(std::fabs(tracker->tension(i) - ranges[i].most) < 1e-9 * full);
}

TEST_CASE("a cell at each end narrows the bounds, and cells that contradict friction make them empty") {
  static Bounded given;
  given.make(false, 0.2, 0.02);
  Ranges one, both;
  std::array<taut::EndReading<double>, 2> ends{{{}, {true, false, full, 0}}};
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, one));
  ends[0] = {true, false, 0.8 * full, 0};
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, both));
  for (int i = 0; i < given.model.segments; ++i) {
    CHECK(both[i].most <= one[i].most);
    CHECK(both[i].least >= one[i].least);
    CHECK(!both[i].is_empty());
  }
  ends[0].force = 0.01 * full;
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, both));
  bool empty = false;
  for (int i = 0; i < given.model.segments; ++i) empty = empty || both[i].is_empty();
  CHECK(empty);
}

TEST_CASE("without a reading there are no bounds, and nothing is carried over a self-locking joint") {
  static Bounded given;
  given.make(false, 0.2, 0);
  Ranges ranges;
  CHECK(!taut::find_bounds(given.model, given.known, {}, 0, ranges));
  given.scene.mu[2] = 50;
  REQUIRE(support::condense(given.scene, given.model).ok());
  taut::find_friction_prior(given.scene, given.known);
  const std::array<taut::EndReading<double>, 2> ends{{{}, {true, false, full, 0}}};
  REQUIRE(taut::find_bounds(given.model, given.known, ends, 0, ranges));
  CHECK(std::isfinite(ranges[3].most));
  CHECK(!std::isfinite(ranges[2].most));
  CHECK(ranges[2].least == 0);
}

}  // namespace

}  // namespace bounds_test
