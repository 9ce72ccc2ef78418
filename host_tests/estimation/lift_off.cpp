// A jack that is put back on a locked end: when does it pull what the wedge holds?
#include <doctest/doctest.h>

#include "estimation/site.hpp"

namespace lift_off_test {
using namespace estimation;

namespace {

constexpr double full = 2e5;

void make_ground(Ground& ground, double seating) {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.05;
  cable.shared_mu = true;
  cable.seating = seating;
  support::rigid_saddles(ground.known, cable, support::chain_points(7));
  ground.set_true_mu(std::vector<double>(16, 0.24));
}

/// A jack at the end of a cable; its forces are parts of the full one.
template <class Scalar>
class Jack {
 public:
  Jack(const Ground& ground, const Instruments& instruments, std::uint64_t seed, bool restarts = false)
      : site(std::make_unique<Site<Scalar>>(ground, instruments, full, seed)), restarts_(restarts) {}

  /// Whether the wedge is said to be free.
  bool pull(double force, bool locked) {
    at_ = force;
    site->advance(full * force, locked);
    bool found = false;
    for (const taut::Alarm& alarm : site->estimator().alarms()) {
      if (alarm.kind != taut::Alarm::Kind::lift_off) continue;
      CHECK(alarm.cable == 0);
      CHECK(alarm.place == 1);
      found = true;
    }
    if (restarts_) site->restart();
    REQUIRE(site->good());
    return found;
  }
  /// Goes to a force; returns how often the wedge was said to be free.
  int go(double to, int samples, bool locked) {
    int found = 0;
    const double from = at_;
    for (int i = 1; i <= samples; ++i) found += pull(from + (to - from) * i / samples, locked) ? 1 : 0;
    return found;
  }
  void tension_and_lock() {
    REQUIRE(go(1, 200, false) == 0);
    REQUIRE(go(1, 50, false) == 0);
  }
  /// What the wedge holds.
  double held() const { return site->true_force(site->segments() - 1) / full; }

  std::unique_ptr<Site<Scalar>> site;

 private:
  double at_ = 0;
  bool restarts_;
};

TEST_CASE_TEMPLATE("a jack that comes back is told within a percent of the force that the wedge holds",
                   Scalar, double, float) {
  static Ground ground;
  int late = 0;
  for (const double seating : {0.0, 0.004}) {
    make_ground(ground, seating);
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      CAPTURE(seating);
      CAPTURE(seed);
      Random random(seed);
      Instruments instruments;
      instruments.outliers = random.coin() ? 0.002 : 0;
      Jack<Scalar> jack(ground, instruments, seed);
      jack.tension_and_lock();
      // The cell keeps its value until the jack is released.
      int early = jack.go(1, 30, true);
      early += jack.go(0, random.coin() ? 1 : 20, true);
      early += jack.go(0, 300, true);
      early += jack.go(0.5, 50, true);
      early += jack.go(0.5, 300, true);
      CHECK(early == 0);
      const double rate = 0.001 * std::exp2(random.between(0, 4)), held = jack.held();
      double force = 0.5;
      while (force < 1.1 && !jack.pull(force += rate, true)) {
      }
      // A sample may pass before it can be said.
      CHECK(force > held - 0.01);
      CHECK(force < held + 0.01 + rate);
      late += force > held ? 1 : 0;
      // Once is enough.
      CHECK(jack.go(force + 0.2, 20, true) == 0);
    }
  }
  // It is no more often early than late by much.
  CHECK(late > 400 / 4);
}

TEST_CASE("a cell that keeps its value after lock-off never tells that the wedge is free") {
  static Ground ground;
  for (const double seating : {0.0, 0.004}) {
    make_ground(ground, seating);
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      CAPTURE(seating);
      CAPTURE(seed);
      Instruments instruments;
      instruments.outliers = seed % 2 == 0 ? 0.002 : 0;
      Jack<float> jack(ground, instruments, seed);
      jack.tension_and_lock();
      CHECK(jack.go(1, 3000, true) == 0);
    }
  }
}

TEST_CASE("a jack at rest, and one that waits at nine tenths of what the wedge holds, do not free it") {
  static Ground ground;
  make_ground(ground, 0.004);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Jack<float> jack(ground, Instruments{}, seed);
    jack.tension_and_lock();
    CHECK(jack.go(0, 50, true) == 0);
    CHECK(jack.go(0, 100000, true) == 0);
    CHECK(jack.go(0.9 * jack.held(), 50, true) == 0);
    CHECK(jack.go(0.9 * jack.held(), 100000, true) == 0);
  }
}

TEST_CASE_TEMPLATE("with an exact cell it is the first row that reaches the estimated force", Scalar, double,
                   float) {
  static Ground ground;
  make_ground(ground, 0.004);
  Jack<Scalar> jack(ground, Instruments{0, 0, 0, 0, false}, 1);
  jack.tension_and_lock();
  CHECK(jack.go(1, 10, true) == 0);
  CHECK(jack.go(0, 10, true) == 0);
  const double held = static_cast<double>(jack.site->estimator().force(jack.site->segments() - 1)) / full;
  CHECK(held < 0.95);
  for (int i = 1; i <= 100; ++i) CHECK(jack.pull(0.01 * i, true) == (i == static_cast<int>(100 * held) + 1));
}

TEST_CASE("readings at a locked end change no force, no deviation and no mu") {
  static Ground ground;
  make_ground(ground, 0.004);
  const auto site = std::make_unique<Site<float>>(ground, Instruments{}, full, 1);
  for (int i = 1; i <= 100; ++i) site->advance(full * i / 100);
  auto heard = std::make_unique<Site<float>::Estimator>(site->estimator()),
       deaf = std::make_unique<Site<float>::Estimator>(site->estimator());
  Random random(5);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    // Locked; a jack that goes away and comes back; and pulls on once the wedge is free.
    const double force = i < 20 ? 0 : i < 200 ? full * (i - 20) / 180 : full * (1 + (i - 200) / 500.0);
    taut::Readings<float, PlaneCapacity> readings;
    readings.dt = 0.5F;
    readings.sample.jack[0][1].locked = i < 200;
    readings.ends[0][1].force = static_cast<float>(force + 0.005 * full * gaussian(random));
    readings.ends[0][1].has_force = true;
    REQUIRE(heard->advance(readings).status.ok());
    found += heard->alarms().empty() ? 0 : 1;
    readings.ends[0][1].has_force = i >= 200;
    REQUIRE(deaf->advance(readings).status.ok());
    for (int k = 0; k < site->segments(); ++k) {
      REQUIRE(heard->force(k) == deaf->force(k));
      REQUIRE(heard->deviation(k) == deaf->deviation(k));
    }
    REQUIRE(heard->mu(0) == deaf->mu(0));
  }
  CHECK(found == 1);
}

TEST_CASE("restored after every row, an estimator tells of the free wedge in the same row") {
  static Ground ground;
  make_ground(ground, 0.004);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Jack<float> steady(ground, Instruments{}, seed), restarted(ground, Instruments{}, seed, true);
    int found = 0;
    const auto both = [&](double force, bool locked) {
      const bool is_free = steady.pull(force, locked);
      REQUIRE(restarted.pull(force, locked) == is_free);
      found += is_free ? 1 : 0;
    };
    for (int i = 1; i <= 50; ++i) both(0.02 * i, false);
    for (int i = 0; i < 30; ++i) both(0, true);
    for (int i = 1; i <= 100; ++i) both(0.01 * i, true);
    CHECK(found == 1);
  }
}

}  // namespace

}  // namespace lift_off_test
