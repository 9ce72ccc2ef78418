// What the estimator makes of jackings whose truth is known, and of the one in the paper.
#include <doctest/doctest.h>

#include "estimation/ramp.hpp"

namespace truth_test {
using namespace estimation;

namespace {

/// A chain over rigid saddles, or a truss string.
void make_ground(Ground& ground, bool elastic, double known_mu, double mu_sd, double actual_mu,
                 bool shared = true) {
  taut::Cable<double> cable = support::steel_cable(known_mu);
  cable.mu_sd = mu_sd;
  cable.shared_mu = shared;
  if (elastic)
    support::truss_string(ground.known, cable, 6);
  else
    support::rigid_saddles(ground.known, cable, support::chain_points(7));
  ground.set_true_mu(std::vector<double>(16, actual_mu));
}
/// The far end is measured.
template <class Scalar>
Errors after_one_ramp_of(bool elastic, double off) {
  static Ground ground;
  make_ground(ground, elastic, 0.2 * (1 + off), 0.5 * 0.2 * (1 + off), 0.2);
  return after_one_ramp<Scalar>(ground, {}, 40, 1);
}

TEST_CASE("a prior half off comes within half a percent after one ramp, and ten times closer than it was") {
  for (const bool elastic : {false, true})
    for (const double off : {-0.5, 0.5}) {
      CAPTURE(elastic);
      CAPTURE(off);
      for (const Errors& errors :
           {after_one_ramp_of<double>(elastic, off), after_one_ramp_of<float>(elastic, off)}) {
        CHECK(errors.estimated < 0.005);
        CHECK(errors.nominal > 10 * errors.estimated);
      }
    }
}

TEST_CASE("joints without friction have answers to their wedge, where zero is rounded below it") {
  // As a float 0.1 is larger than as a double: what takes mu away takes away more than there is.
  static Ground ground;
  for (const bool elastic : {false, true}) {
    make_ground(ground, elastic, 0.1, 0.1, 0, false);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(elastic);
      CAPTURE(seed);
      const auto site = std::make_unique<Site<float>>(ground, Instruments(), full, seed);
      for (const double to : {0.9, 0.5, 1.0, 0.7}) {
        const double from = site->true_force(site->segments() - 1) / full;
        ramp(*site, from, to, 60);
        for (int i = 0; i < 20; ++i) site->advance(to * full);
        for (int i = 0; i < 5; ++i) site->advance(to * full, true);
        REQUIRE(site->good());
      }
    }
  }
}

TEST_CASE("a hold of a million noisy samples drags no force along") {
  static Ground ground;
  make_ground(ground, true, 0.2, 0, 0.2);
  Instruments instruments;
  instruments.jack = 0.01;
  instruments.has_cell = false;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    CAPTURE(seed);
    const auto site = std::make_unique<Site<float>>(ground, instruments, full, seed);
    ramp(*site, 0, 1, 300);
    for (int i = 0; i < 2000; ++i) site->advance(full);  // until the mean is better than the noise
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
      site->advance(full);
      for (int k = 0; k < site->segments(); ++k)
        worst = std::fmax(worst, std::fabs(site->error(k)) / site->true_force(k));
    }
    REQUIRE(site->good());
    CHECK(worst < 0.002);
  }
}

TEST_CASE("without noise, and with mu known, the estimate is what the tracker finds") {
  static Ground ground;
  make_ground(ground, true, 0.2, 0, 0.2);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{0, 0, 0, 0, false}, full, 1);
  for (const double to : {1.0, 0.3, 0.8}) {
    ramp(*site, site->jack_reading() / full, to, 50);
    REQUIRE(site->good());
    for (int i = 0; i < site->segments(); ++i) {
      CHECK(std::fabs(site->error(i)) < 1e-9 * full);
      CHECK(site->estimator().deviation(i) == 0);
    }
  }
}

TEST_CASE_TEMPLATE("a force and its deviation are the same asked for together and apart", Scalar, float,
                   double) {
  static Ground ground;
  make_ground(ground, true, 0.2, 0.1, 0.25);
  const auto site = std::make_unique<Site<Scalar>>(ground, Instruments{}, full, 1);
  for (const double to : {1.0, 0.4, 0.8}) {
    ramp(*site, site->jack_reading() / full, to, 50);
    REQUIRE(site->good());
    for (int i = 0; i < site->segments(); ++i) {
      const auto both = site->estimator().estimate(i);
      CHECK(both.force == site->estimator().force(i));
      CHECK(both.deviation == site->estimator().deviation(i));
    }
  }
}

TEST_CASE("without a measurement mu stays what it was, and the forces are as uncertain as it makes them") {
  static Ground ground;
  make_ground(ground, false, 0.2, 0.05, 0.2);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{0, 0, 0, 0, false}, full, 1);
  ramp(*site, 0, 1, 100);
  const auto& estimator = site->estimator();
  for (int j = 0; j < ground.known.mu.size(); ++j) {
    CHECK(estimator.mu(j) == 0.2);
    CHECK(std::fabs(estimator.mu_deviation(j) - 0.05) < 1e-15);
  }
  // Closed form: T = F times the product of (1 - mu c) / (1 + mu c), c = cot(alpha), over the joints up to
  // the jack. That is about exponential in mu, so T is about lognormal: its root mean square distance from
  // the median is T sqrt(exp(2 s^2) - 2 exp(s^2 / 2) + 1), s the relative deviation of first order.
  double force = full, change = 0;
  for (int i = site->segments() - 2; i >= 0; --i) {
    const double c = std::tan(support::chain_turn[i] / 2);
    force *= (1 - 0.2 * c) / (1 + 0.2 * c);
    change += 2 * c / (1 - 0.04 * c * c);
    CHECK(std::fabs(static_cast<double>(estimator.force(i)) - force) < 1e-9 * full);
    const double s = 0.05 * change, square = s * s,
                 spread = std::sqrt(std::exp(2 * square) - 2 * std::exp(square / 2) + 1);
    CHECK(std::fabs(static_cast<double>(estimator.deviation(i)) - force * spread) <
          force * s * square / 5 + 1e-7 * full);
  }
}

TEST_CASE("while joints stick, a load cell at the far end teaches nothing, and a notice says so once") {
  static Ground ground;
  make_ground(ground, false, 0.2, 0.1, 0.3);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{}, full, 3);
  ramp(*site, 0, 1, 100);
  for (int i = 0; i < 100; ++i) site->advance(full);
  int told = 0;
  const auto count = [&] { told += raised(site->estimator().alarms(), taut::Alarm::Kind::no_information); };
  ramp(*site, 1, 0.95, 20, count);
  const double mu = static_cast<double>(site->estimator().mu(0)),
               deviation = static_cast<double>(site->estimator().mu_deviation(0));
  ramp(*site, 0.95, 0.9, 20, count);
  CHECK(static_cast<double>(site->estimator().mu(0)) == mu);
  CHECK(static_cast<double>(site->estimator().mu_deviation(0)) == deviation);
  CHECK(told == 1);
}

TEST_CASE("outliers of the jack's load cell leave no trace, and the next good reading tells them") {
  static Ground ground;
  make_ground(ground, true, 0.2, 0, 0.2);
  Instruments instruments;
  instruments.has_cell = false;
  const auto site = std::make_unique<Site<double>>(ground, instruments, full, 5);
  ramp(*site, 0, 1, 200);
  for (int i = 0; i < 100; ++i) site->advance(full);
  for (int i = 0; i < 20; ++i) {
    Site<double>::Estimator estimator = site->estimator();
    taut::Readings<double, PlaneCapacity> wrong;
    wrong.ends[0][1].has_force = true;
    wrong.ends[0][1].force = i % 2 == 0 ? 0 : 1.5 * full;
    REQUIRE(estimator.advance(wrong).status.ok());
    CHECK(raised(estimator.alarms(), taut::Alarm::Kind::outlier) == 0);
    for (int k = 0; k < site->segments(); ++k)
      CHECK(std::fabs(estimator.force(k) - site->true_force(k)) < 0.01 * full);
    wrong.ends[0][1].force = full;
    REQUIRE(estimator.advance(wrong).status.ok());
    CHECK(raised(estimator.alarms(), taut::Alarm::Kind::outlier) == 1);
    site->advance(full);
  }
}

TEST_CASE("a far-end cell that contradicts everything known is told, not believed") {
  static Ground ground;
  make_ground(ground, false, 0.2, 0.02, 0.2);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{}, full, 7);
  ramp(*site, 0, 1, 100);
  Site<double>::Estimator estimator = site->estimator();
  const double mu = estimator.mu(0);
  taut::Readings<double, PlaneCapacity> wrong;
  wrong.ends[0][1] = {true, false, full, 0};
  wrong.ends[0][0] = {true, false, 0.1 * full, 0};
  REQUIRE(estimator.advance(wrong).status.ok());
  CHECK(raised(estimator.alarms(), taut::Alarm::Kind::sensor));
  CHECK(estimator.mu(0) == mu);
}

TEST_CASE("mu far outside of its band is told") {
  static Ground ground;
  make_ground(ground, false, 0.2, 0.02, 0.28);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{}, full, 9);
  ramp(*site, 0, 1, 200);
  CHECK(raised(site->estimator().alarms(), taut::Alarm::Kind::mu_band));
  CHECK(std::fabs(static_cast<double>(site->estimator().mu(0)) - 0.28) < 0.01);
}

TEST_CASE("an extension that grows outside of the tolerance on the elongation is told, one inside is not") {
  static Ground ground;
  make_ground(ground, true, 0.2, 0, 0.2);
  const auto site = std::make_unique<Site<double>>(ground, Instruments{0, 0, 0, 0, false}, full, 1);
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::find_friction_prior(ground.known, prior);
  taut::AlarmLimits<double> limits;
  limits.stroke_sd = 1e-6;
  const auto read = [](Site<double>::Estimator& estimator, double force, double stroke) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.ends[0][1] = {true, true, force, stroke};
    REQUIRE(estimator.advance(readings).status.ok());
    return raised(estimator.alarms(), taut::Alarm::Kind::elongation) > 0;
  };
  // Half of the force strains the cable enough for strokes to count.
  ramp(*site, 0, 0.5, 20);
  const auto half = site->estimator().save();
  const double before = site->true_extension();
  ramp(*site, 0.5, 1, 20);
  const double growth = site->true_extension() - before;
  for (const double zero : {0.0, 0.3})
    for (const double part : {1.0, 1.04, 1.06, 0.96, 0.94}) {
      CAPTURE(part);
      Site<double>::Estimator estimator;
      REQUIRE(estimator.restore(site->model(), prior, half, limits).ok());
      CHECK_FALSE(read(estimator, 0.5 * full, zero + before));
      CHECK(read(estimator, full, zero + before + part * growth) == (std::fabs(part - 1) > 0.05));
    }
}

template <class Scalar>
void compare_restarted() {
  static Ground ground;
  for (const bool shared : {true, false}) {
    make_ground(ground, true, 0.2, 0.05, 0.25, shared);
    ground.known.cables[0].seating = 0.004;
    const auto plain = std::make_unique<Site<Scalar>>(ground, Instruments{}, full, 11),
               restarted = std::make_unique<Site<Scalar>>(ground, Instruments{}, full, 11);
    int row = 0;
    for (const double force : {0.5, 1.0, 1.0, 0.4, 0.4, 0.9})
      for (int i = 0; i < 30; ++i, ++row) {
        CAPTURE(row);
        const bool locked = row >= 130 && row < 150;
        for (Site<Scalar>* site : {plain.get(), restarted.get()})
          site->advance(full * (force - 0.01 * (30 - i)), locked);
        restarted->restart();
        REQUIRE(plain->good());
        REQUIRE(restarted->good());
        for (int k = 0; k < plain->segments(); ++k) {
          REQUIRE(plain->estimator().force(k) == restarted->estimator().force(k));
          REQUIRE(plain->estimator().deviation(k) == restarted->estimator().deviation(k));
        }
      }
  }
}
TEST_CASE("restored after every row, an estimator gives the same bits") {
  compare_restarted<double>();
  compare_restarted<float>();
}

TEST_CASE("more unknowns than there is room for are refused with how many are missing") {
  static Ground ground;
  make_ground(ground, false, 0.2, 0.02, 0.2, false);
  ground.known.cables[0].cell = {};
  taut::Condensed<double, PlaneCapacity> model;
  REQUIRE(support::condense(ground.known, model).ok());
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::find_friction_prior(ground.known, prior);
  taut::Estimator<taut::Condensed<double, PlaneCapacity>, 4> estimator;
  const auto progress = estimator.start(model, prior);
  CHECK(progress.status.code == taut::Code::capacity_exceeded);
  CHECK(progress.status.amount == ground.known.mu.size() - 4);
}

/// Two jacks, or one.
struct Pulled {
  Plane scene;
  taut::Condensed<double, PlaneCapacity> model;
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::Estimator<taut::Condensed<double, PlaneCapacity>, most_unknowns> estimator;

  void make(const std::array<taut::End, 2>& ends, const std::array<double, 2>& sensor_sd) {
    taut::Cable<double> cable = support::steel_cable(0.2, ends);
    for (std::size_t end = 0; end < 2; ++end) cable.cell[end].sd = sensor_sd[end];
    support::rigid_saddles(scene, cable, support::chain_points(7));
    REQUIRE(support::condense(scene, model).ok());
    taut::find_friction_prior(scene, prior);
    REQUIRE(estimator.start(model, prior).status.ok());
  }
};

TEST_CASE("two jacks that pull alike in coarse steps are followed, whichever cell is noisy") {
  static Pulled pulled;
  for (const std::array<double, 2>& sd : {std::array<double, 2>{0, 400}, {400, 0}, {400, 400}, {0, 0}}) {
    pulled.make(support::two_jacks, sd);
    for (const double force : {5e4, 1e5, 1e5, 1e5, 3e4, 8e4}) {
      taut::Readings<double, PlaneCapacity> readings;
      readings.ends[0][0] = readings.ends[0][1] = {true, false, force, 0};
      REQUIRE(pulled.estimator.advance(readings).status.ok());
      CHECK(std::fabs(pulled.estimator.force(0) - force) < 2000);
      CHECK(std::fabs(pulled.estimator.force(pulled.model.segments - 1) - force) < 2000);
    }
  }
}

TEST_CASE("a released end keeps its wedge until its load cell is read") {
  static Pulled pulled;
  pulled.make(support::jacked_end, {0, 0});
  taut::Readings<double, PlaneCapacity> readings;
  readings.ends[0][1] = {true, false, full, 0};
  REQUIRE(pulled.estimator.advance(readings).status.ok());
  readings.sample.jack[0][1].locked = true;
  REQUIRE(pulled.estimator.advance(readings).status.ok());
  const int last = pulled.model.segments - 1;
  const double held = pulled.estimator.force(last);
  CHECK(std::fabs(held - full) < 1e-9 * full);
  readings.sample.jack[0][1].locked = false;
  readings.ends[0][1].has_force = false;
  REQUIRE(pulled.estimator.advance(readings).status.ok());
  CHECK(pulled.estimator.force(last) == held);
  readings.ends[0][1] = {true, false, 1.1 * full, 0};
  REQUIRE(pulled.estimator.advance(readings).status.ok());
  CHECK(std::fabs(pulled.estimator.force(last) - 1.1 * full) < 1e-9 * full);
}

}  // namespace

}  // namespace truth_test
