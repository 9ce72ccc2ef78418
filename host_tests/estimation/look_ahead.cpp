// The estimator goes ahead of the loads that are confirmed: it comes back to the same bits, and to the forces
// of a tracker that is driven straight to the loads.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "support/routes_taken.hpp"

namespace look_ahead_test {
using namespace estimation;

namespace {

/// A truss string under three load patterns, the last of which the site changes. Unknown is what can be.
void make_ground(Ground& ground, double mu_sd, double actual_mu, bool shared) {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = mu_sd;
  cable.shared_mu = shared;
  cable.seating = 0.004;
  support::truss_string(ground.known, cable, 6);
  ground.set_true_mu(std::vector<double>(16, actual_mu));
}

/// A log of two visits: ramps, holds, a release, a lock-off, and a load factor that changes meanwhile and
/// with the jack at work.
std::vector<Deed> two_visits() {
  std::vector<Deed> rows;
  Deed at;
  const auto go = [&](double force, double factor, bool locked, int samples) {
    at.locked[1] = locked;
    go_on(at, force, factor, samples, [&] { rows.push_back(at); });
  };
  go(0.7, 0, false, 40);
  go(0.7, 0, false, 10);
  go(0.7, 0.6, false, 10);
  go(0.35, 0.6, false, 25);
  go(0.35, 0.6, false, 10);
  go(0.85, 0.6, false, 40);
  go(0.85, 0.6, true, 5);
  go(0.85, 1, true, 10);
  go(0, 1, true, 5);
  go(0.85, 1, false, 5);
  go(1, 0.3, false, 30);
  go(0.5, 0.3, false, 20);
  go(0.9, 0.3, false, 20);
  for (int i = 0; i < 5; ++i) {
    go(0.4, 0.3, false, 60);
    go(0.95, 0.3, false, 60);
  }
  return rows;
}

/// All that is answered after a row, number by number.
template <class Scalar>
std::vector<Scalar> answers(const Site<Scalar>& site) {
  const auto& estimator = site.estimator();
  std::vector<Scalar> all;
  for (int i = 0; i < site.segments(); ++i) {
    all.push_back(estimator.force(i));
    all.push_back(estimator.deviation(i));
  }
  taut::Response<Scalar, PlaneCapacity> response;
  estimator.respond(response, &site.rows());
  for (int j = 0; j < site.model().joints; ++j) {
    all.push_back(estimator.mu(j));
    all.push_back(estimator.mu_deviation(j));
    all.push_back(response.slip[j]);
    all.push_back(response.friction[j]);
    all.push_back(static_cast<Scalar>(response.state[j]));
  }
  for (const Scalar extension : response.extension[0]) all.push_back(extension);
  for (int i = 0; i < PlaneCapacity::struts; ++i) all.push_back(response.strut[i]);
  return all;
}
template <class Scalar>
std::vector<int> alarms(const Site<Scalar>& site) {
  std::vector<int> all;
  for (const auto& alarm : site.estimator().alarms()) {
    all.push_back(static_cast<int>(alarm.kind));
    all.push_back(alarm.place);
  }
  return all;
}

/// How often it was ahead, and stayed there from one row to the next.
struct Ahead {
  int rows = 0, stayed = 0;
};
template <class Scalar>
Ahead compare_restarted(const Ground& ground, const Instruments& instruments, std::uint64_t seed) {
  const auto plain = std::make_unique<Site<Scalar>>(ground, instruments, full, seed),
             restarted = std::make_unique<Site<Scalar>>(ground, instruments, full, seed);
  Ahead ahead;
  int row = 0;
  bool was_ahead = false;
  for (const Deed& deed : two_visits()) {
    CAPTURE(row);
    for (Site<Scalar>* site : {plain.get(), restarted.get()}) site->advance(deed);
    REQUIRE(plain->good());
    REQUIRE(restarted->good());
    const auto expected = answers(*plain);
    REQUIRE(answers(*restarted) == expected);
    REQUIRE(alarms(*restarted) == alarms(*plain));
    restarted->restart();
    REQUIRE(restarted->good());
    REQUIRE(answers(*restarted) == expected);
    const bool is_ahead = plain->estimator().save().is_ahead;
    REQUIRE(is_ahead == restarted->estimator().save().is_ahead);
    ahead.rows += is_ahead ? 1 : 0;
    ahead.stayed += is_ahead && was_ahead ? 1 : 0;
    was_ahead = is_ahead;
    ++row;
  }
  return ahead;
}

}  // namespace

TEST_CASE_TEMPLATE("put back from its saved state after every row, ahead or not, it gives the same bits",
                   Scalar, double, float) {
  static Ground ground;
  for (const bool shared : {true, false})
    for (const bool has_cell : {true, false}) {
      int stayed = 0;
      for (const double jack : {0.0005, 0.005}) {
        CAPTURE(shared);
        CAPTURE(jack);
        CAPTURE(has_cell);
        make_ground(ground, 0.05, 0.25, shared);
        Instruments instruments;
        instruments.jack = jack;
        instruments.has_cell = has_cell;
        instruments.strut = 0;
        const Ahead ahead = compare_restarted<Scalar>(ground, instruments, 11);
        // Else nothing was tested.
        CHECK(ahead.rows > 20);
        stayed += ahead.stayed;
      }
      CHECK(stayed > 0);
    }
}

namespace {

using Model = Site<double>::Model;
using Row = taut::Sample<double, PlaneCapacity>;

/// A tracker that goes where the loads are confirmed to have come, and from there straight to their best
/// estimate.
class Straight {
 public:
  explicit Straight(const Model& model) { REQUIRE(tracker_.start(model).status.ok()); }
  /// A load that turned before it had come as far as was confirmed has been no farther.
  void turn(double force, bool was_highest) {
    const double from = tracker_.loads().jack[0][1].force;
    if (was_highest ? force < from : force > from) tracker_.correct_load(0, force);
    go(tracker_, force, factor_);
  }
  void confirm(double force, double factor) {
    // Where the other load begins to change the jack comes first.
    const bool changes = factor != factor_;
    if (changes && !changed_) go(tracker_, force, factor_);
    go(tracker_, force, factor);
    changed_ = changes;
    factor_ = factor;
  }
  taut::Tracker<Model> at(double force, double factor) const {
    taut::Tracker<Model> there = tracker_;
    go(there, force, factor);
    return there;
  }

 private:
  static void go(taut::Tracker<Model>& tracker, double force, double factor) {
    Row row;
    row.factor[1] = factor;
    row.jack[0][1].force = force;
    REQUIRE(tracker.advance(row).status.ok());
  }

  taut::Tracker<Model> tracker_;
  double factor_ = 0;
  bool changed_ = false;
};

/// Ramps and releases of so many rows each, one of them with another load factor.
std::vector<Deed> ramps(int samples) {
  std::vector<Deed> rows;
  Deed at;
  for (const Deed& to : {Deed{{0, 0.7}, {}, 0}, Deed{{0, 0.7}, {}, 0.6}, Deed{{0, 0.3}, {}, 0.6},
                         Deed{{0, 0.9}, {}, 0.6}, Deed{{0, 0.5}, {}, 0.6}, Deed{{0, 1}, {}, 0.6}}) {
    const Deed from = at;
    for (int i = 1; i <= samples; ++i) {
      at.force[1] = from.force[1] + (to.force[1] * full - from.force[1]) * i / samples;
      at.factor = from.factor + (to.factor - from.factor) * i / samples;
      rows.push_back(at);
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("beside a cable that nobody has pulled yet it learns as beside none") {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.06;
  cable.shared_mu = true;
  cable.cell[0].sd = cable.cell[1].sd = 0.002 * full;
  const auto learned = [&](bool elastic, bool has_second) {
    static Plane scene;
    static Model model;
    static taut::FrictionPrior<double, PlaneCapacity> known;
    if (elastic)
      support::truss_string(scene, cable, 6);
    else
      support::rigid_saddles(scene, cable, support::chain_points(6));
    const int below[] = {0, 14, 15, 16, 17, 18, 12}, over[] = {0, 1, 2, 3, 4, 5, 6};
    if (has_second) REQUIRE(scene.add_cable(cable, elastic ? below : over, 7) == 1);
    REQUIRE(support::condense(scene, model).ok());
    taut::find_friction_prior(scene, known);
    taut::Tracker<Model> truth;
    REQUIRE(truth.start(model).status.ok());
    const auto estimator = std::make_unique<taut::Estimator<Model, most_unknowns>>();
    REQUIRE(estimator->start(model, known).status.ok());
    Random random(1);
    for (int i = 1; i <= 100; ++i) {
      Row row;
      row.jack[0][1].force = full * i / 100;
      REQUIRE(truth.advance(row).status.ok());
      taut::Readings<double, PlaneCapacity> readings;
      readings.ends[0][1] = {true, false, full * i / 100 + 0.002 * full * gaussian(random), 0};
      readings.ends[0][0] = {true, false, truth.tension(0) + 0.002 * full * gaussian(random), 0};
      REQUIRE(estimator->advance(readings).status.ok());
    }
    return estimator->mu_deviation(0);
  };
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    const double alone = learned(elastic, false), beside = learned(elastic, true);
    CHECK(alone < 0.005);
    CHECK(beside < 1.2 * alone);
  }
}

TEST_CASE(
    "with mu known its forces are those of a tracker driven straight to the best estimate of the load") {
  static Ground ground;
  make_ground(ground, 0, 0.2, true);
  Instruments instruments;
  instruments.has_cell = false;
  int ahead = 0, compared = 0;
  for (const double jack : {1e-6, 1e-4, 0.001, 0.003})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(jack);
      CAPTURE(seed);
      instruments.jack = jack;
      const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
      const auto straight = std::make_unique<Straight>(site->model());
      int row = 0;
      for (const Deed& deed : ramps(60)) {
        CAPTURE(row);
        ++row;
        site->advance(deed);
        REQUIRE(site->good());
        const auto& estimator = site->estimator();
        const auto load = estimator.load(0, 1);
        if (load.reversed) straight->turn(load.reversal, load.confirmed < load.reversal);
        straight->confirm(std::max(load.confirmed, 1e-3 * jack * full), deed.factor);
        // Where it may have turned nobody knows what slides.
        if (load.behind) continue;
        const auto there = straight->at(load.load, deed.factor);
        // Beyond a joint friction has what the load has come to, on the piece that it is on there.
        for (int i = 0; i < site->segments(); ++i) {
          const double further = i + 1 < site->segments() ? load.come - load.load : 0;
          REQUIRE(std::fabs(estimator.force(i) - there.tension(i) - there.slope(0, i) * further) <
                  1e-9 * full);
        }
        ahead += estimator.save().is_ahead ? 1 : 0;
        ++compared;
      }
    }
  // Else nothing was tested.
  CHECK(compared > 6000);
  CHECK(ahead > 200);
}

TEST_CASE("where a load lags its best estimate by many events, none is decided anew in each row") {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.cell[1].sd = 0.005 * full;
  static Plane scene;
  static Model model;
  static taut::FrictionPrior<double, PlaneCapacity> known;
  support::rigid_saddles(scene, cable, support::chain_points(10));
  REQUIRE(support::condense(scene, model).ok());
  taut::find_friction_prior(scene, known);
  const auto decisions = [](const auto& follow) {
    support::RoutesTaken::counts() = {};
    follow();
    return support::total(support::RoutesTaken::counts());
  };
  // Up, and down again in strides of three rows, which no line foretells.
  std::vector<double> loads;
  for (int i = 1; i <= 200; ++i) loads.push_back(full * i / 200);
  for (int i = 0; i < 120; ++i) loads.push_back(loads.back() - (i % 3 == 2 ? 0 : 0.01 * full));
  taut::Tracker<Model> truth;
  REQUIRE(truth.start(model).status.ok());
  const long needed = decisions([&] {
    for (const double load : loads) {
      Row row;
      row.jack[0][1].force = load;
      REQUIRE(truth.advance(row).status.ok());
    }
  });
  REQUIRE(needed > 10);
  int ahead = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const auto estimator = std::make_unique<taut::Estimator<Model, most_unknowns>>();
    REQUIRE(estimator->start(model, known).status.ok());
    Random random(seed);
    const long taken = decisions([&] {
      for (const double load : loads) {
        taut::Readings<double, PlaneCapacity> readings;
        readings.ends[0][1] = {true, false, load + 0.005 * full * gaussian(random), 0};
        REQUIRE(estimator->advance(readings).status.ok());
        ahead += estimator->save().is_ahead ? 1 : 0;
      }
    });
    CHECK(taken <= 2 * needed);
  }
  // Else nothing was tested.
  CHECK(ahead > 20);
}

}  // namespace look_ahead_test
