// Strokes on the way back of a jack, where row by row another joint begins to slide: what they teach of
// friction is what they hold, and the way is gone anew with it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"

namespace stroke_leg_test {
using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Estimator = CellEstimator;

taut::Cable<double> cable_of(double mu, double jack_sd) {
  taut::Cable<double> cable = support::steel_cable(mu);
  cable.law = taut::FrictionLaw::capstan;
  cable.mu_sd = 0.3 * mu;
  cable.shared_mu = true;
  cable.cell[1].sd = jack_sd;
  return cable;
}

/// An estimator with the stroke of its jack, which may be read from any mark, and the truth.
class Jacked {
 public:
  static constexpr double stroke_sd = 5e-4;

  Jacked(Ground& ground, double true_mu, std::uint64_t seed) : random_(seed) {
    ground.set_true_mu(std::vector<double>(16, true_mu));
    sd_ = ground.known.cables[0].cell[1].sd;
    taut::find_friction_prior(ground.known, prior_);
    taut::LoadCell<double> gauge;
    gauge.sd = stroke_sd;
    gauge.zero_sd = taut::free_zero<double>;
    gauges_ = {gauge};
    REQUIRE(support::condense(ground.known, known_).ok());
    REQUIRE(support::condense(ground.actual, actual_).ok());
    REQUIRE(truth_.start(actual_).status.ok());
    REQUIRE(estimator_.start(known_, prior_, {}, gauges_).status.ok());
  }
  /// In parts of the full force.
  void go(double from, double to, int rows, bool locked = false) {
    for (int i = 1; i <= rows; ++i) {
      const double force = full * (from + (to - from) * i / rows);
      taut::Sample<double, PlaneCapacity> sample;
      sample.jack[0][1] = {force, locked};
      taut::Readings<double, PlaneCapacity> readings;
      readings.sample.jack[0][1].locked = locked;
      readings.ends[0][1].has_force = !locked;
      readings.ends[0][1].force = force + sd_ * support::gaussian(random_);
      REQUIRE(truth_.advance(sample).status.ok());
      REQUIRE(estimator_.advance(readings).status.ok());
      was_ahead_ += estimator_.save().is_ahead ? 1 : 0;
      taut::Response<double, PlaneCapacity> response;
      truth_.respond(response);
      const double stroke = 0.3 + response.extension[0][1] + stroke_sd * support::gaussian(random_);
      estimator_.take_stroke(0, 1, stroke, taut::Gauge{0});
      if (restarts_) REQUIRE(estimator_.restore(known_, prior_, estimator_.save(), {}, gauges_).ok());
    }
  }
  void restart_in_every_row() { restarts_ = true; }
  const Estimator& estimator() const { return estimator_; }
  const Model& known() const { return known_; }
  int was_ahead() const { return was_ahead_; }

 private:
  support::Random random_;
  double sd_ = 0;
  Model known_, actual_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  std::vector<taut::LoadCell<double>> gauges_;
  taut::Tracker<Model> truth_;
  Estimator estimator_;
  int was_ahead_ = 0;
  bool restarts_ = false;
};

/// Eight joints between rigid saddles, or a truss string.
void make_ground(Ground& ground, bool elastic, double mu, double jack_sd) {
  if (elastic)
    support::truss_string(ground.known, cable_of(mu, jack_sd), 6);
  else
    support::rigid_saddles(ground.known, cable_of(mu, jack_sd), support::chain_points(8));
}

/// How far the largest force of a tracker is from one that was driven here with the friction at which the
/// estimator is linearized.
double off_driven(const Jacked& jacked, const Ground& ground, const std::vector<double>& way) {
  const auto saved = jacked.estimator().save();
  const auto scene = std::make_unique<Plane>(ground.known);
  for (double& mu : scene->mu) mu += saved.friction.belief.linearized_at[0];
  const auto model = std::make_unique<Model>();
  const auto tracker = std::make_unique<taut::Tracker<Model>>();
  REQUIRE(support::condense(*scene, *model).ok());
  REQUIRE(tracker->start(*model).status.ok());
  for (const double force : way) {
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1].force = force;
    REQUIRE(tracker->advance(sample).status.ok());
  }
  double worst = 0;
  for (int s = 0; s < model->segments; ++s)
    worst = std::fmax(worst, std::fabs(tracker->tension(s) - jacked.estimator().tracker().tension(s)) / full);
  return worst;
}

}  // namespace

TEST_CASE("a release teaches friction as well as it is said to, where each row lets another joint slide") {
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    static Ground ground;
    constexpr double mu = 0.25;
    make_ground(ground, elastic, mu, 2e-3 * full);
    double squares = 0, variances = 0, scaled = 0;
    int ahead = 0;
    constexpr int draws = 100;
    for (std::uint64_t seed = 1; seed <= draws; ++seed) {
      support::Random random(seed);
      const double true_mu = mu * std::fmax(0.2, 1 + 0.3 * support::gaussian(random));
      const auto jacked = std::make_unique<Jacked>(ground, true_mu, seed);
      jacked->go(0, 1, 80);
      jacked->go(1, 1, 20);
      const int before = jacked->was_ahead();
      jacked->go(1, 0.45, 16);
      ahead += jacked->was_ahead() - before;
      jacked->go(0.45, 0.45, 20);
      const double off = jacked->estimator().mu(0) - true_mu, sd = jacked->estimator().mu_deviation(0);
      squares += off * off / draws;
      variances += sd * sd / draws;
      scaled += off * off / (sd * sd) / draws;
    }
    // In most of these rows the best estimate lies beyond the next event.
    if (!elastic) CHECK(ahead > 8 * draws);
    CHECK(std::sqrt(squares) < 0.05 * mu);
    CHECK(std::sqrt(variances) < 0.05 * mu);
    // The root mean square of 100 errors is known to 7 %.
    CHECK(std::sqrt(scaled) < 1.2);
  }
}

TEST_CASE("what strokes of a release have moved is where that friction would have led to") {
  for (const bool elastic : {false, true})
    for (const double part : {0.5, 1.5}) {
      CAPTURE(elastic);
      CAPTURE(part);
      static Ground ground;
      make_ground(ground, elastic, 0.2, 0);
      const auto jacked = std::make_unique<Jacked>(ground, part * 0.2, 7);
      // The mark is free, so a ramp of this stroke tells next to nothing of a friction that is a half off.
      jacked->go(0, 1, 3);
      const double before = jacked->estimator().save().friction.belief.linearized_at[0];
      jacked->go(1, 0.5, 12);
      CHECK(std::fabs(jacked->estimator().save().friction.belief.linearized_at[0] - before) > 0.005);
      CHECK(off_driven(*jacked, ground, {full, full * 0.5}) < 1e-12);
    }
}

TEST_CASE("restored in every row on that way, it finds the same bits") {
  static Ground ground;
  make_ground(ground, true, 0.25, 2e-3 * full);
  const auto plain = std::make_unique<Jacked>(ground, 0.33, 5),
             restored = std::make_unique<Jacked>(ground, 0.33, 5);
  restored->restart_in_every_row();
  for (Jacked* jacked : {plain.get(), restored.get()}) {
    jacked->go(0, 1, 60);
    jacked->go(1, 0.45, 16);
    jacked->go(0.45, 0.8, 16);
  }
  for (int s = 0; s < plain->known().segments; ++s) {
    CHECK(plain->estimator().force(s) == restored->estimator().force(s));
    CHECK(plain->estimator().deviation(s) == restored->estimator().deviation(s));
  }
  CHECK(plain->estimator().mu(0) == restored->estimator().mu(0));
}

TEST_CASE("a lock-off ends the way: strokes after it are compared with what the wedge left") {
  static Ground ground;
  make_ground(ground, true, 0.25, 2e-3 * full);
  const auto jacked = std::make_unique<Jacked>(ground, 0.33, 9);
  jacked->go(0, 1, 60);
  jacked->go(1, 0.6, 12);
  CHECK(jacked->estimator().save().leg[0].is_known);
  jacked->go(0.6, 0.6, 3, true);
  CHECK_FALSE(jacked->estimator().save().leg[0].is_known);
  jacked->go(0.6, 0.9, 12);
  CHECK(std::fabs(jacked->estimator().mu(0) - 0.33) < 4 * jacked->estimator().mu_deviation(0));
}

}  // namespace stroke_leg_test
