// Loads that move faster than they ever did and slow down at once: a valve that is opened, a first stroke.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace slowing_loads_test {
using namespace estimation;

namespace {

/// By how much the force beside the jack is off, as a part of the full one.
double off_at_jack(const ReadSite& jacking) {
  return std::fabs(jacking.estimator().force(jacking.site.joints) - jacking.site.force.back()) / full;
}

}  // namespace

TEST_CASE("a valve that is opened lets the load down faster than it ever went, and is believed") {
  // At commit ba830d5 the load stayed where it had been for fifteen rows, with bars that did not hold.
  for (const double time : {1.5, 2.0, 3.0, 6.0})
    for (const double left : {0.0, 0.2, 0.5})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(time);
        CAPTURE(left);
        CAPTURE(seed);
        SaddleSite given;
        given.has_far = seed % 2 == 0;
        ReadSite jacking(given, seed);
        for (int i = 1; i <= 60; ++i) jacking.row(full * i / 60);
        for (int i = 0; i < 30; ++i) jacking.row(full);
        for (int i = 1; i <= 25; ++i) {
          jacking.row(full * (left + (1 - left) * std::exp(-i / time)));
          if (i >= 4) REQUIRE(off_at_jack(jacking) < 0.05);
        }
      }
}

TEST_CASE("a first stroke that is larger than the next ones is believed with them") {
  for (const double next : {0.03, 0.025, 0.02, 0.015})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(next);
      CAPTURE(seed);
      SaddleSite given;
      given.has_far = false;
      given.noise = 0.001 * full;
      ReadSite jacking(given, seed);
      for (int i = 0; i < 11; ++i) jacking.row(0);
      double load = 0;
      for (int i = 1; i <= 14; ++i) {
        load += (i == 1 ? 0.04 : next) * full;
        jacking.row(load);
        if (i >= 4) REQUIRE(off_at_jack(jacking) < 0.02);
        REQUIRE(raised(jacking.estimator().alarms(), taut::Alarm::Kind::outlier) == 0);
      }
    }
}

}  // namespace slowing_loads_test
