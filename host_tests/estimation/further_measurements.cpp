// Strain gauges on struts and strokes as measurements, on jackings whose truth is known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "estimation/ramp.hpp"

namespace further_measurements_test {
using namespace estimation;

namespace {

constexpr int chord = 0;  // the lower chord beside the anchored end

void make_ground(Ground& ground, double known_mu, double mu_sd, double actual_mu) {
  taut::Cable<double> cable = support::steel_cable(known_mu);
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  support::truss_string(ground.known, cable, 6);
  ground.set_true_mu(std::vector<double>(16, actual_mu));
}
Instruments gauge_alone() {
  Instruments instruments;
  instruments.has_cell = false;
  instruments.strut = chord;
  return instruments;
}
Instruments stroke_alone() {
  Instruments instruments;
  instruments.has_cell = false;
  instruments.stroke = 2e-4;
  return instruments;
}

TEST_CASE_TEMPLATE(
    "without a load cell at the far end, a gauge or the stroke brings a prior half off within a percent",
    Scalar, double, float) {
  static Ground ground;
  for (const double off : {-0.5, 0.5})
    for (const Instruments& instruments : {gauge_alone(), stroke_alone()}) {
      CAPTURE(off);
      CAPTURE(instruments.strut);
      make_ground(ground, 0.2 * (1 + off), 0.5 * 0.2 * (1 + off), 0.2);
      const Errors errors = after_one_ramp<Scalar>(ground, instruments, 40, 0);
      CHECK(errors.estimated < 0.01);
      CHECK(errors.nominal > 5 * errors.estimated);
    }
}

struct MuErrors {
  double rms = 0;     // of mu
  double scaled = 0;  // in its standard deviations
};
MuErrors mu_errors(const Ground& ground, const Instruments& instruments) {
  // The root mean square of 1500 errors is known to 1.8 %.
  constexpr int seeds = 1500;
  MuErrors errors;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
    ramp(*site, 0, 1, 200);
    REQUIRE(site->good());
    const double error = site->estimator().mu(0) - 0.2, scaled = error / site->estimator().mu_deviation(0);
    errors.rms += error * error / seeds;
    errors.scaled += scaled * scaled / seeds;
  }
  return {std::sqrt(errors.rms), std::sqrt(errors.scaled)};
}

TEST_CASE(
    "a gauge and a far-end cell find mu better than either, with the stroke better still, and know how "
    "well") {
  static Ground ground;
  make_ground(ground, 0.3, 0.15, 0.2);
  Instruments cell, two = gauge_alone();
  cell.has_cell = two.has_cell = true;
  Instruments all = two;
  all.stroke = stroke_alone().stroke;
  const MuErrors of_cell = mu_errors(ground, cell), of_gauge = mu_errors(ground, gauge_alone()),
                 of_stroke = mu_errors(ground, stroke_alone()), of_two = mu_errors(ground, two),
                 of_all = mu_errors(ground, all);
  CHECK(of_two.rms < std::min(of_cell.rms, of_gauge.rms));
  CHECK(of_all.rms < std::min(of_two.rms, of_stroke.rms));
  // Readings of one row share the jack's error: without regard to that two would be off by 1.2, three by 1.5.
  for (const MuErrors& errors : {of_cell, of_gauge, of_stroke, of_two, of_all}) {
    CHECK(errors.scaled > 0.93);
    CHECK(errors.scaled < 1.07);
  }
}

TEST_CASE("a gauge that contradicts everything known is told, not believed; so is a stroke") {
  static Ground ground;
  make_ground(ground, 0.2, 0.02, 0.2);
  for (const Instruments& instruments : {gauge_alone(), stroke_alone()}) {
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, 7);
    ramp(*site, 0, 1, 100);
    Site<double>::Estimator estimator = site->estimator();
    const double mu = estimator.mu(0), deviation = estimator.mu_deviation(0), force = estimator.force(0);
    CHECK(estimator.alarms().empty());
    // Ten standard deviations of gauge and jack; mu is known better by then.
    const double sd = 0.005 * full;
    if (instruments.strut >= 0) {
      estimator.take_strut(site->rows(), chord, site->true_strut(chord) + 10 * std::sqrt(2.0) * sd, sd);
      REQUIRE(estimator.alarms().size() == 1);
      CHECK(estimator.alarms()[0].kind == taut::Alarm::Kind::strut);
      CHECK(estimator.alarms()[0].cable == -1);
      CHECK(estimator.alarms()[0].place == chord);
    } else {
      estimator.take_stroke(0, 1, 1.2 * site->true_extension(), instruments.stroke);
      REQUIRE(estimator.alarms().size() == 1);
      CHECK(estimator.alarms()[0].kind == taut::Alarm::Kind::elongation);
      CHECK(estimator.alarms()[0].cable == 0);
      CHECK(estimator.alarms()[0].place == 1);
    }
    CHECK(estimator.mu(0) == mu);
    CHECK(estimator.mu_deviation(0) == deviation);
    CHECK(estimator.force(0) == force);
  }
}

TEST_CASE("a measurement that was not believed leaves no trace in the next ones of its row") {
  static Ground ground;
  make_ground(ground, 0.2, 0.05, 0.25);
  const auto site = std::make_unique<Site<double>>(ground, gauge_alone(), full, 11);
  ramp(*site, 0, 1, 50);
  const auto plain = std::make_unique<Site<double>::Estimator>(site->estimator()),
             misled = std::make_unique<Site<double>::Estimator>(site->estimator());
  const double force = site->true_strut(chord), sd = 0.005 * full;
  misled->take_strut(site->rows(), chord, force + full, sd);
  REQUIRE(raised(misled->alarms(), taut::Alarm::Kind::strut) == 1);
  for (auto* estimator : {plain.get(), misled.get()}) {
    estimator->take_strut(site->rows(), chord + 6, site->true_strut(chord + 6), sd);
    estimator->take_stroke(0, 1, site->true_extension(), 1e-3);
  }
  CHECK(misled->mu(0) == plain->mu(0));
  CHECK(misled->mu_deviation(0) == plain->mu_deviation(0));
  CHECK(plain->mu_deviation(0) < site->estimator().mu_deviation(0));
}

TEST_CASE("the force of a strut that nobody measures is estimated with the error that it has") {
  static Ground ground;
  // The root mean square of 600 errors is known to 3 %.
  constexpr int draws = 600;
  double pulled = 0, let_out = 0, largest = 0;
  constexpr double mu_sd = 0.03;
  constexpr std::uint64_t seed = 20261124;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> prior(0.2, mu_sd);
  Instruments jack_alone;
  jack_alone.has_cell = false;
  for (std::uint64_t i = 0; i < draws; ++i) {
    make_ground(ground, 0.2, mu_sd, prior(random));
    const auto site = std::make_unique<Site<double>>(ground, jack_alone, full, i);
    const auto error = [&] {
      const auto [force, deviation] = site->estimator().estimate_strut(site->rows(), chord);
      largest = std::max(largest, std::fabs(force));
      const double scaled = (force - site->true_strut(chord)) / deviation;
      return scaled * scaled / draws;
    };
    ramp(*site, 0, 1, 50);
    pulled += error();
    ramp(*site, 1, 0.5, 50);
    let_out += error();
    REQUIRE(site->good());
  }
  CHECK(largest > 0.1 * full);
  for (const double square : {pulled, let_out}) {
    CHECK(std::sqrt(square) > 0.9);
    CHECK(std::sqrt(square) < 1.1);
  }
}

TEST_CASE("while joints stick, gauges and strokes teach nothing, and nothing is said of it") {
  static Ground ground;
  make_ground(ground, 0.2, 0.1, 0.3);
  for (const Instruments& instruments : {gauge_alone(), stroke_alone()}) {
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, 3);
    ramp(*site, 0, 1, 100);
    for (int i = 0; i < 100; ++i) site->advance(full);
    ramp(*site, 1, 0.95, 20);
    const double mu = site->estimator().mu(0), deviation = site->estimator().mu_deviation(0);
    CHECK(deviation < 0.02);
    ramp(*site, 0.95, 0.9, 20, [&] { CHECK(site->estimator().alarms().empty()); });
    CHECK(site->estimator().mu(0) == mu);
    CHECK(site->estimator().mu_deviation(0) == deviation);
  }
}

TEST_CASE("the stroke of a locked end tells nothing") {
  static Ground ground;
  make_ground(ground, 0.2, 0.1, 0.3);
  const auto site = std::make_unique<Site<double>>(ground, stroke_alone(), full, 3);
  ramp(*site, 0, 1, 100);
  const double mu = site->estimator().mu(0), deviation = site->estimator().mu_deviation(0);
  for (int i = 0; i < 10; ++i) site->advance(full, true);
  CHECK(site->estimator().mu(0) == mu);
  CHECK(site->estimator().mu_deviation(0) == deviation);
  CHECK(site->estimator().alarms().empty());
}

// How a measured number changes with mu shows in how well mu is known afterwards: with R the variance of the
// measurement and V = sum of H^2 C, each variance C falls by C^2 H^2 / (V + R).

using Model = taut::Condensed<double, PlaneCapacity>;
using Row = taut::Sample<double, PlaneCapacity>;
using Estimator = taut::Estimator<Model, most_unknowns>;

/// A truss string with any dimensions and an exact jack, followed along a log.
struct Followed {
  Model model;
  taut::CondensedStruts<double, PlaneCapacity> rows;
  taut::FrictionPrior<double, PlaneCapacity> known;
  Estimator estimator;

  Followed(const Plane& original, int joint, double by, const std::vector<double>& log) {
    static Plane scene;
    scene = original;
    for (int j = 0; j < scene.mu.size(); ++j)
      if (joint < 0 || j == joint) scene.mu[j] += by;
    REQUIRE(support::condense(scene, model, &rows).ok());
    taut::find_friction_prior(scene, known);
    REQUIRE(estimator.start(model, known).status.ok());
    for (const double force : log) advance(force);
  }
  ~Followed() = default;
  Followed(const Followed&) = delete;
  Followed& operator=(const Followed&) = delete;
  void advance(double force) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, false, force, 0};
    REQUIRE(estimator.advance(readings).status.ok());
  }
  taut::Response<double, PlaneCapacity> response() const {
    taut::Response<double, PlaneCapacity> found;
    estimator.respond(found, &rows);
    return found;
  }
};
/// A strut's force, or the extension.
double number_of(const Followed& followed, int strut) {
  const auto response = followed.response();
  return strut < 0 ? response.extension[0][1] : response.strut[strut];
}
void take(Estimator& estimator, const Followed& followed, int strut, double sd) {
  const double reading = number_of(followed, strut);
  if (strut < 0)
    estimator.take_stroke(0, 1, reading, sd);
  else
    estimator.take_strut(followed.rows, strut, reading, sd);
}

TEST_CASE("what a gauge and a stroke tell of mu is what other trackers with other mu say") {
  constexpr double mu_sd = 0.02, by = 1e-6;
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const support::Variation vary(random);
    taut::Cable<double> cable = support::steel_cable(random.between(0.1, 0.3));
    cable.mu_sd = mu_sd;
    cable.shared_mu = random.coin();
    static Plane scene;
    support::truss_string(scene, cable, 5, vary);
    // Up; or up, and down until all slides back.
    std::vector<double> log{full};
    if (random.coin()) log.push_back(0.2 * full);
    const auto plain = std::make_unique<Followed>(scene, -1, 0, log);
    const int unknowns = cable.shared_mu ? 1 : scene.mu.size();
    for (const int strut : {-1, 0, 6, 14, 20}) {
      CAPTURE(strut);
      std::vector<double> slope;
      double V = 0;
      for (int p = 0; p < unknowns; ++p) {
        const int joint = cable.shared_mu ? -1 : p;
        // With one unknown its weight is each joint's mu over their mean.
        std::vector<double> change(static_cast<std::size_t>(scene.mu.size()), 0.0);
        double mean = 0;
        for (int j = 0; j < scene.mu.size(); ++j) mean += scene.mu[j] / scene.mu.size();
        static Plane more_scene, less_scene;
        more_scene = less_scene = scene;
        for (int j = 0; j < scene.mu.size(); ++j) {
          const double step = joint < 0 ? by * scene.mu[j] / mean : j == joint ? by : 0;
          more_scene.mu[j] += step;
          less_scene.mu[j] -= step;
        }
        const auto more = std::make_unique<Followed>(more_scene, -1, 0, log),
                   less = std::make_unique<Followed>(less_scene, -1, 0, log);
        slope.push_back((number_of(*more, strut) - number_of(*less, strut)) / (2 * by));
        V += slope.back() * slope.back() * mu_sd * mu_sd;
      }
      const double sd = std::sqrt(V);
      const auto estimator = std::make_unique<Estimator>(plain->estimator);
      take(*estimator, *plain, strut, sd);
      REQUIRE(estimator->alarms().empty());
      for (int j = 0; j < scene.mu.size(); ++j) {
        const double before = plain->estimator.mu_deviation(j), after = estimator->mu_deviation(j);
        const double H = slope[cable.shared_mu ? 0 : static_cast<std::size_t>(j)];
        const double expected = H * H * mu_sd * mu_sd / (V + sd * sd);
        CHECK(std::fabs(1 - after * after / (before * before) - expected) < 1e-5);
        ++compared;
      }
    }
  }
  CHECK(compared == 25 * 5 * 4);
}

TEST_CASE(
    "the noise of the jack's reading counts as often as the number follows the jack, once for all gauges") {
  static Ground ground;
  make_ground(ground, 0.2, 0.02, 0.2);
  Instruments instruments;
  instruments.has_cell = false;
  const auto site = std::make_unique<Site<double>>(ground, instruments, full, 3);
  ramp(*site, 0, 1, 100);
  const auto noisy = std::make_unique<Site<double>::Estimator>(site->estimator());
  const double before = noisy->mu_deviation(0), sd = 1;
  // The same reading twice, so well known that the jack's noise is all there is, is worth no more than once.
  noisy->take_strut(site->rows(), chord, site->true_strut(chord), sd);
  const double once = noisy->mu_deviation(0);
  noisy->take_strut(site->rows(), chord, site->true_strut(chord), sd);
  const double twice = noisy->mu_deviation(0);
  REQUIRE(noisy->alarms().empty());
  CHECK(once < 0.95 * before);
  CHECK(twice <= once);
  CHECK(twice > 0.999 * once);
}

TEST_CASE("a gauge between two cables tells something only while both slide or one has no friction to show") {
  static Plane scene;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.05;
  cable.shared_mu = true;
  support::truss_string(scene, cable, 6);
  // Beside the first one, over the same nodes.
  const int path[] = {0, 14, 15, 16, 17, 18, 12};
  REQUIRE(scene.add_cable(cable, path, 7) == 1);
  static Model model;
  static taut::CondensedStruts<double, PlaneCapacity> rows;
  static taut::FrictionPrior<double, PlaneCapacity> known;
  REQUIRE(support::condense(scene, model, &rows).ok());
  taut::find_friction_prior(scene, known);
  const auto estimator = std::make_unique<Estimator>();
  REQUIRE(estimator->start(model, known).status.ok());
  const auto pull = [&](double first, double second) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, false, first * full, 0};
    readings.ends[1][1] = {true, false, second * full, 0};
    REQUIRE(estimator->advance(readings).status.ok());
  };
  const auto read = [&] {
    taut::Response<double, PlaneCapacity> response;
    estimator->respond(response, &rows);
    const auto told = std::make_unique<Estimator>(*estimator);
    told->take_strut(rows, chord, response.strut[chord], 100);
    CHECK(told->alarms().empty());
    struct Found {
      bool first, second;
    };
    return Found{told->mu_deviation(0) < estimator->mu_deviation(0),
                 told->mu_deviation(5) < estimator->mu_deviation(5)};
  };
  pull(1, 0);
  const auto alone = read();
  CHECK(alone.first);
  CHECK_FALSE(alone.second);
  pull(1, 1);
  pull(1.4, 1.4);
  const auto together = read();
  CHECK(together.first);
  CHECK(together.second);
  // The first one slides again, the second one sticks with what friction made of it.
  pull(1.4, 1.3);
  pull(1.45, 1.3);
  for (int j = 0; j < 10; ++j) REQUIRE(estimator->tracker().is_at_limit(j) == (j < 5));
  const auto beside = read();
  CHECK_FALSE(beside.first);
  CHECK_FALSE(beside.second);
}

}  // namespace

}  // namespace further_measurements_test
