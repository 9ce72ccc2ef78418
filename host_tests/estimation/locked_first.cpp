// A log that begins while wedges hold a cable: nobody knows how it came under load.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"
#include "taut/estimation/unknown_past.hpp"

using namespace estimation;

namespace {

/// A second visit without what the first one knew.
class SecondVisit {
 public:
  using Estimator = ReadSite::Estimator;

  SecondVisit(const SaddleSite& given, std::uint64_t seed) : site(given), random_(seed) {
    site.begin(random_);
    REQUIRE(below_.start(site.model, site.prior).status.ok());
    past_.reset();
  }
  void row(double load, bool locked) {
    if (!locked) site.pull(load);
    taut::Readings<double, PlaneCapacity> readings;
    readings.sample.jack[0][1].locked = locked;
    if (!locked) readings.ends[0][1] = {true, false, load + site.noise * gaussian(random_), 0};
    if (site.has_far)
      readings.ends[0][0] = {true, false, site.force.front() + site.noise * gaussian(random_), 0};
    past_.look(site.model, site.prior, readings);
    past_.withhold(site.model, readings);
    REQUIRE(below_.advance(readings).is_complete());
    if (!past_.is_unknown()) return;
    REQUIRE(
        past_.advance(site.model, site.prior, taut::AlarmLimits<double>(), Estimator::NoGauges(), readings)
            .is_complete());
    past_.settle(below_);
  }
  bool is_unknown() const { return past_.is_unknown(); }
  double off(int segment) const {
    const auto found = past_.estimate(below_, segment);
    return (found.force - site.force[static_cast<std::size_t>(segment)]) / found.deviation;
  }

  SaddleSite site;

 private:
  Random random_;
  Estimator below_;
  taut::UnknownPast<Estimator> past_;
};

}  // namespace

TEST_CASE("a cable that wedges hold in the first row is under load, and its forces are those of any past") {
  // At commit ba830d5 it had none: 0 +- 0 N.
  Score score;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    SaddleSite given;
    const auto visit = std::make_unique<SecondVisit>(given, seed);
    // Pulled, drawn in; then far enough that all joints slide whatever had been.
    visit->site.pull(full);
    visit->site.pull(0.85 * full);
    for (int i = 0; i < 10; ++i) {
      visit->row(0, true);
      CHECK(visit->is_unknown());
      for (int s = 0; s <= given.joints; ++s) CHECK(std::fabs(visit->off(s)) < 1.96);
    }
    for (int i = 1; i <= 120; ++i) {
      visit->row((0.85 + 1.65 * i / 120) * full, false);
      for (int s = 0; s <= given.joints; ++s) score.add(visit->off(s));
    }
    for (int i = 0; i < 20; ++i) visit->row(2.5 * full, false);
    CHECK_FALSE(visit->is_unknown());
    for (int s = 0; s <= given.joints; ++s) CHECK(std::fabs(visit->off(s)) < 4);
  }
  MESSAGE("seeds 1 to 30: ", 100 * score.share(), " % held as it is jacked again");
  CHECK(score.share() > 0.92);
}

TEST_CASE("wedges are no load where the far end reads nothing, or is not read") {
  for (const bool has_far : {false, true}) {
    SaddleSite given;
    given.has_far = has_far;
    const auto visit = std::make_unique<SecondVisit>(given, 1);
    visit->row(0, true);
    CHECK_FALSE(visit->is_unknown());
  }
}
