// A ram with friction at the end of a cable over rigid saddles whose far end is read: what that says of mu
// and of the ram together. The truth is clamped joint by joint.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace ram_saddles_test {
using namespace estimation;

namespace {

constexpr double part = 0.02;  // of the force: half the width between the branches, as it is said

/// Cells whose noise is known, the jack's behind a ram whose friction is known to `part_sd`.
class Pressed {
 public:
  using Estimator = taut::Estimator<SaddleSite::Model, most_unknowns>;

  Pressed(double noise, double far_noise, double part_sd, std::uint64_t seed)
      : noise_(noise * full), far_noise_(far_noise * full), random_(seed) {
    site.joints = 6;
    site.noise = noise_;
    site.begin(random_);
    site.prior.cell[0][0].sd = far_noise_;
    auto& cell = site.prior.cell[0][1];
    cell.up = 1 + part;
    cell.down = 1 - part;
    cell.hysteresis_sd = part_sd;
    part_ = std::max(0.0, part + part_sd * gaussian(random_));
    REQUIRE(estimator.start(site.model, site.prior).status.ok());
  }
  Pressed(const Pressed&) = delete;
  Pressed& operator=(const Pressed&) = delete;
  ~Pressed() = default;

  /// The pressure goes to `pressure`, in parts of the full force, in so many rows; each is added to the score
  /// of the far end.
  void press(double pressure, int rows) {
    const double from = pressure_;
    for (int i = 1; i <= rows; ++i) {
      pressure_ = from + (pressure - from) * i / rows;
      load_ = std::clamp(load_, pressure_ / (1 + part_), pressure_ / (1 - part_));
      site.pull(load_ * full);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 1;
      readings.ends[0][1] = {true, false, pressure_ * full + noise_ * gaussian(random_), 0};
      readings.ends[0][0] = {true, false, site.force.front() + far_noise_ * gaussian(random_), 0};
      REQUIRE(estimator.advance(readings).status.ok());
      alarms += of_far_end(estimator.alarms());
      far.add((estimator.force(0) - site.force.front()) / estimator.deviation(0));
    }
  }
  SaddleSite site;
  Estimator estimator;
  Score far;
  int alarms = 0;  ///< of the far end

 private:
  double noise_, far_noise_, part_ = 0, pressure_ = 0, load_ = 0;
  Random random_;
};

}  // namespace

TEST_CASE("what a far end has taught of mu and of a ram together holds on as the ram turns") {
  Score far;
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto pressed = std::make_unique<Pressed>(1e-4, 3e-5, 0.01, seed);
    pressed->press(0.5, 60);
    pressed->press(0.5, 10);
    pressed->far = {};
    const double held = pressed->site.force.front();
    // Between the branches of most rams; nothing slides back at the far end.
    pressed->press(0.5 * (1 - part), 20);
    REQUIRE(pressed->site.force.front() == held);
    far.add(pressed->far);
    alarms += pressed->alarms;
  }
  MESSAGE("seeds 1 to 60: ", 100 * far.share(), " % are held, errors ", far.rms(),
          " deviations, rms, the worst ", far.worst);
  CHECK(far.share() > 0.95);
  CHECK(far.rms() < 0.8);
  CHECK(far.worst < 5);
  CHECK(alarms == 0);
}

}  // namespace ram_saddles_test
