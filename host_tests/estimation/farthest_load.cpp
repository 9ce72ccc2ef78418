// How far a load has come: a ramp and a hold that rests, creeps on or comes back, less than is seen to turn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "estimation/score.hpp"
#include "support/random.hpp"
#include "taut/estimation/load_filter.hpp"

namespace farthest_load_test {
using estimation::Score;

namespace {

constexpr double noise = 500;

/// Straight up by `rate` deviations of the noise a row, or down, then so many rows in which the load goes by
/// `gone` more in all, back if that is negative.
template <class Scalar>
struct Watched {
  Score come, load;

  void jack(double rate, double gone, int hold, bool rises) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      support::Random random(seed);
      taut::LoadFilter<Scalar> filter;
      filter.start(Scalar(noise));
      const double from = rises ? 0 : 3000 * noise, way = rises ? noise : -noise;
      if (!rises) filter.start_at(Scalar(noise), Scalar(from), Scalar(noise), false);
      const double ramp = 40 + random.below(60);
      for (int i = 1; i <= ramp + hold; ++i) {
        const double beyond = std::max(0.0, i - ramp), at = rate * std::min<double>(i, ramp),
                     now = at + gone * beyond / hold, far = std::max(at, now);
        const double reading = from + way * now + noise * support::gaussian(random);
        const auto found = filter.take(Scalar(reading), 1);
        // From where it is found to have turned on it goes the other way.
        if (found.reversed) break;
        if (beyond < 12 || found.refused) continue;
        come.add((static_cast<double>(found.come) - (from + way * far)) / static_cast<double>(found.come_sd));
        load.add((static_cast<double>(found.load) - (from + way * far)) / static_cast<double>(found.sd));
      }
    }
  }
};

}  // namespace

TEST_CASE_TEMPLATE("how far a load has come is known where it rests, creeps on or comes back", Scalar, double,
                   float) {
  for (const bool rises : {true, false})
    for (const double gone : {0.0, 1.0, 4.0, -0.5, -1.0, -2.0, -3.0})
      for (const int hold : {40, 120, 400}) {
        CAPTURE(rises);
        CAPTURE(gone);
        CAPTURE(hold);
        Watched<Scalar> watched;
        for (const double rate : {1.0, 5.0, 20.0}) watched.jack(rate, gone, hold, rises);
        MESSAGE("straight on, then by ", gone, " in ", hold, " rows: ", 100 * watched.come.share(),
                " % held, rms ", watched.come.rms(), "; of the load itself ", 100 * watched.load.share(),
                " %, rms ", watched.load.rms());
        CHECK(watched.come.share() > 0.85);
        CHECK(watched.come.rms() < 1.4);
      }
}

}  // namespace farthest_load_test
