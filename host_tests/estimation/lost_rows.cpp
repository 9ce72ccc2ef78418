// What a load may have done while its cell was not read, and who else has seen it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace lost_rows_test {
using namespace estimation;

namespace {

/// What is read in a row.
struct Read {
  bool jack = true, far = true;
};

/// A cable that is pulled, held and locked, in rows a second apart; bars are judged in all of them.
class LossyVisit {
 public:
  explicit LossyVisit(std::uint64_t seed, const SaddleSite& given = SaddleSite())
      : site(given), random(seed) {
    site.begin(random);
    REQUIRE(estimator_.start(site.model, site.prior).status.ok());
  }
  void row(Read read, bool locked = false) {
    if (!locked) site.pull(load);
    taut::Readings<double, PlaneCapacity> readings;
    readings.sample.jack[0][1].locked = locked;
    const double jack = load + site.noise * gaussian(random),
                 far = site.force.front() + site.noise * gaussian(random);
    if (read.jack && !locked) readings.ends[0][1] = {true, false, jack, 0};
    if (read.far && site.has_far) readings.ends[0][0] = {true, false, far, 0};
    REQUIRE(estimator_.advance(readings).status.ok());
    alarms += of_far_end(estimator_.alarms());
  }
  void go(double to, double step, Read read = {}) {
    while (std::fabs(to - load) > 1) {
      load += std::fmax(-step, std::fmin(step, to - load));
      row(read);
    }
  }
  void hold(int rows, Read read = {}) {
    for (int i = 0; i < rows; ++i) row(read);
  }
  void lock(int rows) {
    for (int i = 0; i < rows; ++i) row({}, true);
  }
  void add_to(Score& score) const { site.add_to(score, estimator_); }
  taut::ForceEstimate<double> estimate(int segment) const { return estimator_.estimate(segment); }
  double load_deviation() const { return estimator_.load(0, 1).sd; }

  SaddleSite site;
  Random random;
  double load = 0;
  int alarms = 0;  ///< of the far end

 private:
  ReadSite::Estimator estimator_;
};

}  // namespace

TEST_CASE("in a hold a row that is not read has what a pump goes that may have begun in it, Eq. (79)") {
  constexpr double step = 0.02 * full;
  for (const int rested : {10, 30, 100}) {
    CAPTURE(rested);
    const auto visit = std::make_unique<LossyVisit>(1);
    visit->go(full, step);
    visit->hold(rested);
    const double before = visit->load_deviation();
    visit->row({false, true});
    const double grown = std::sqrt(std::pow(visit->load_deviation(), 2) - before * before),
                 expected = step * std::sqrt(1 / (3.0 * (rested + 1)));
    // The line of the hold begins a few rows early or late, and the pace is the fastest that was seen.
    CHECK(grown > 0.7 * expected);
    CHECK(grown < 1.5 * expected);
  }
}

TEST_CASE("where fields are lost and pumps begin at any moment, errors are as large as bars say") {
  Score score;
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto visit = std::make_unique<LossyVisit>(seed);
    visit->go(0.2 * full, 0.01 * full);
    for (int leg = 1; leg <= 6; ++leg) {
      // As likely to end in any row.
      const int rows = 3 + static_cast<int>(-20 * std::log(visit->random.between(0.01, 1)));
      const double to = (0.2 + 0.15 * leg) * full;
      for (int i = 0; i < rows + 100 && visit->load < to; ++i) {
        if (i >= rows) visit->load = std::fmin(to, visit->load + 0.01 * full);
        visit->row({!(visit->random.between(0, 1) < 0.3), !(visit->random.between(0, 1) < 0.3)});
        visit->add_to(score);
      }
    }
    alarms += visit->alarms;
  }
  MESSAGE("seeds 1 to 60: ", 100 * score.share(), " % held, rms of error / sd ", score.rms(), ", worst ",
          score.worst);
  CHECK(score.share() > 0.93);
  CHECK(score.rms() < 1.03);
  CHECK(alarms <= 3);
}

TEST_CASE("a load that a far end has seen go on still does when that is not read any more either") {
  Score score;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto visit = std::make_unique<LossyVisit>(seed);
    visit->go(0.5 * full, 0.01 * full);
    visit->hold(30);
    visit->hold(2, {false, true});
    visit->go(0.56 * full, 0.01 * full, {false, true});
    for (int i = 0; i < 6; ++i) {
      visit->load += 0.01 * full;
      visit->row({false, false});
      visit->add_to(score);
    }
    CHECK(visit->alarms == 0);
  }
  MESSAGE("seeds 1 to 60: ", 100 * score.share(), " % held, worst ", score.worst);
  CHECK(score.share() > 0.93);
}

TEST_CASE("a jack that takes over from a wedge and is not read may have gone on since") {
  for (const bool has_far : {true, false}) {
    CAPTURE(has_far);
    SaddleSite given;
    given.has_far = has_far;
    Score score;
    int alarms = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const auto visit = std::make_unique<LossyVisit>(seed, given);
      visit->go(full, 0.02 * full);
      visit->hold(20);
      visit->go(0.8 * full, 0.02 * full);
      visit->hold(10);
      visit->lock(20);
      for (int i = 0; i < 15; ++i) {
        visit->load += 0.015 * full;
        visit->row({false, true});
        visit->add_to(score);
      }
      for (int i = 0; i < 15; ++i) {
        visit->load += 0.015 * full;
        visit->row({});
        visit->add_to(score);
      }
      alarms += visit->alarms;
    }
    MESSAGE("seeds 1 to 60: ", 100 * score.share(), " % held, worst ", score.worst);
    CHECK(score.share() > 0.93);
    CHECK(alarms <= 3);
  }
}

TEST_CASE("a far end that has not gone along says that a load did not go farther while it was not read") {
  Score score;
  double middle = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const auto visit = std::make_unique<LossyVisit>(seed);
    visit->go(0.8 * full, 0.01 * full);
    visit->hold(8, {false, true});
    visit->hold(20);
    middle += visit->estimate(2).deviation / 60;
    visit->go(0.6 * full, 0.01 * full);
    for (int i = 0; i < 10; ++i) {
      visit->row({});
      visit->add_to(score);
    }
    CHECK(visit->alarms == 0);
  }
  MESSAGE("seeds 1 to 60: ", 100 * score.share(), " % held, worst ", score.worst, ", sd in the middle ",
          100 * middle / full, " %");
  CHECK(score.share() > 0.93);
  CHECK(middle < 0.014 * full);
}

TEST_CASE("where it has gone along, and come back, bars hold") {
  Score score;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const auto visit = std::make_unique<LossyVisit>(seed);
    visit->go(0.8 * full, 0.01 * full);
    visit->hold(2, {false, true});
    visit->go(0.82 * full, 0.01 * full, {false, true});
    visit->go(0.8 * full, 0.01 * full, {false, true});
    visit->hold(20);
    for (int i = 0; i < 10; ++i) {
      visit->row({});
      visit->add_to(score);
    }
  }
  MESSAGE("seeds 1 to 60: ", 100 * score.share(), " % held, worst ", score.worst);
  CHECK(score.share() > 0.93);
}

TEST_CASE("a load stage that is not read is one, however soon it comes") {
  ReadSite jacking({}, 1);
  const auto stage = [&](double load, bool is_read, double dt) { jacking.row(load, is_read, false, dt); };
  stage(0.1 * full, true, 60);
  stage(0.2 * full, true, 500);
  stage(0.3 * full, true, 500);
  stage(0.4 * full, false, 20);
  CHECK(jacking.estimator().load(0, 1).sd > 0.05 * full);
  CHECK(jacking.estimator().load(0, 1).sd < 0.15 * full);
}

}  // namespace lost_rows_test
