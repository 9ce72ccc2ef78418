// What the cell at the far end reads before anything pulls: its zero, however far off that is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/jacked_chain.hpp"

namespace zero_at_rest_test {
using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Estimator = CellEstimator;

constexpr double noise = 1e-3 * full, zero_sd = 5e-3 * full;  // of the far end

/// A chain whose far end has a cell with an unknown zero: at rest for a while, then pulled to the full force.
class Jacking {
 public:
  Jacking(double zero, std::uint64_t seed, double said = zero_sd, double zero_of_jack_sd = 0)
      : zero_(zero), random_(seed) {
    auto cable = support::steel_cable(mu, support::jacked_end);
    cable.law = taut::FrictionLaw::capstan;
    cable.mu_sd = likely;
    cable.shared_mu = true;
    cable.cell[0].sd = noise;
    cable.cell[1].sd = jack_sd;
    cable.cell[1].zero_sd = zero_of_jack_sd;
    cable.cell[0].zero_sd = said;
    const auto scene = std::make_unique<Plane>();
    support::rigid_saddles(*scene, cable, support::chain_points(segments));
    taut::find_friction_prior(*scene, prior_);
    REQUIRE(support::condense(*scene, model_).ok());
    REQUIRE(estimator_.start(model_, prior_).status.ok());
    chain_ = Chain(std::max(0.02, mu + likely * support::gaussian(random_)));
    if (zero_of_jack_sd > 0) zero_of_jack_ = zero_of_jack_sd * support::gaussian(random_);
  }
  void rest(int rows) { go(0, 0, rows, 0); }
  /// `wrong` is added to the reading of the far end.
  void go(double from, double to, int rows, double wrong) {
    for (int i = 1; i <= rows; ++i) {
      const double force = from + (to - from) * i / rows;
      chain_.pull(force);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 1;
      readings.ends[0][1].has_force = readings.ends[0][0].has_force = true;
      readings.ends[0][1].force = force + zero_of_jack_ + jack_sd * support::gaussian(random_);
      readings.ends[0][0].force = chain_[0] + zero_ + wrong + noise * support::gaussian(random_);
      REQUIRE(estimator_.advance(readings).status.ok());
      misfits_ += raised(estimator_.alarms(), taut::Alarm::Kind::misfit);
      contradicts_ += raised(estimator_.alarms(), taut::Alarm::Kind::sensor);
    }
  }
  void add_to(Score& score) const {
    for (int i = 0; i < segments; ++i) {
      const auto found = estimator_.estimate(i);
      score.add((found.force - chain_[i]) / found.deviation);
    }
  }
  double deviation() const { return estimator_.estimate(segments / 2).deviation; }
  /// Rows with these alarms.
  int misfits() const { return misfits_; }
  int contradicts() const { return contradicts_; }

 private:
  double zero_, zero_of_jack_ = 0;
  support::Random random_;
  Model model_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  Estimator estimator_;
  Chain chain_{mu};
  int misfits_ = 0, contradicts_ = 0;
};

/// As likely as is said.
double likely_zero(std::uint64_t seed) {
  support::Random random(seed + 1000);
  return zero_sd * support::gaussian(random);
}

constexpr std::uint64_t jackings = 200;
constexpr int rested = 30;

}  // namespace

TEST_CASE("a far end that was long read at rest teaches as much as one whose zero is known") {
  Score score;
  double known = 0, after_rest = 0;
  for (std::uint64_t seed = 1; seed <= jackings; ++seed) {
    const auto one = std::make_unique<Jacking>(likely_zero(seed), seed, zero_sd),
               other = std::make_unique<Jacking>(0, seed, 0);
    for (const auto& jacking : {one.get(), other.get()}) {
      jacking->rest(10 * rested);
      jacking->go(0, 0.3 * full, 40, 0);
    }
    one->add_to(score);
    after_rest += one->deviation() / double(jackings);
    known += other->deviation() / double(jackings);
  }
  MESSAGE("seeds from 1: ", 100 * score.share(), " % are held, rms ", score.rms(), "; deviation ", after_rest,
          " N, and ", known, " N where the zero is known");
  CHECK(score.share() > 0.93);
  CHECK(score.rms() > 0.8);
  CHECK(score.rms() < 1.1);
  CHECK(after_rest < 1.1 * known);
}

TEST_CASE(
    "a far end whose zero is ten deviations off is believed after rest, and odd in its first rows alone") {
  for (const double side : {-1.0, 1.0}) {
    CAPTURE(side);
    Score score;
    for (std::uint64_t seed = 1; seed <= jackings; ++seed) {
      CAPTURE(seed);
      const auto jacking = std::make_unique<Jacking>(side * 10 * zero_sd, seed);
      // Where friction is what nobody would have thought, readings are odd in any case.
      const auto other = std::make_unique<Jacking>(0, seed);
      for (const auto& each : {jacking.get(), other.get()}) {
        each->rest(rested);
        CHECK(each->contradicts() <= 2);
        each->go(0, full, 100, 0);
      }
      CHECK(jacking->misfits() <= other->misfits());
      CHECK(jacking->contradicts() <= other->contradicts() + 2);
      jacking->add_to(score);
    }
    MESSAGE("seeds from 1: ", 100 * score.share(), " % are held, rms ", score.rms());
    CHECK(score.share() > 0.93);
    CHECK(score.rms() < 1.1);
  }
}

TEST_CASE("a single wrong reading at rest is not taken for the zero, be it the last before the pump begins") {
  for (const int after : {0, 1, 10}) {
    CAPTURE(after);
    Score score;
    for (std::uint64_t seed = 1; seed <= jackings; ++seed) {
      const double zero = likely_zero(seed);
      const auto jacking = std::make_unique<Jacking>(zero, seed);
      jacking->rest(rested);
      jacking->go(0, 0, 1, 0.2 * full);
      jacking->rest(after);
      jacking->go(0, full, 100, 0);
      jacking->add_to(score);
    }
    MESSAGE("seeds from 1: ", 100 * score.share(), " % are held, rms ", score.rms());
    CHECK(score.share() > 0.93);
    CHECK(score.rms() < 1.1);
  }
}

TEST_CASE(
    "a log that begins with the pump says no more of a far end's zero than the jack's own leaves open") {
  for (const int rows : {0, 1, rested}) {
    CAPTURE(rows);
    Score early, score;
    for (std::uint64_t seed = 1; seed <= jackings; ++seed) {
      const auto jacking = std::make_unique<Jacking>(likely_zero(seed), seed, zero_sd, zero_sd);
      jacking->rest(rows);
      jacking->go(0, 0.1 * full, 10, 0);
      jacking->add_to(early);
      jacking->go(0.1 * full, full, 90, 0);
      jacking->add_to(score);
    }
    MESSAGE("seeds from 1: ", 100 * early.share(), " % are held early in the ramp, rms ", early.rms(), "; ",
            100 * score.share(), " % at its end, rms ", score.rms());
    CHECK(early.share() > 0.93);
    CHECK(early.rms() < 1.1);
    CHECK(score.share() > 0.93);
    CHECK(score.rms() < 1.1);
  }
}

}  // namespace zero_at_rest_test
