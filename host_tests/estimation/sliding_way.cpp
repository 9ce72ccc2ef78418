// When a cable surely slides throughout, though friction is not known.
#include "taut/estimation/sliding_way.hpp"

#include <doctest/doctest.h>

namespace sliding_way_test {

TEST_CASE(
    "a cable surely slides once the jacks have gone as far as with a friction higher by two deviations") {
  // It ceases to slide at a way of 100, begins again between 170 and 180: with a friction higher by a part,
  // at 100 + 75 (1 + 2 part). All of these come exactly in doubles.
  for (const double mu_sd : {0.0, 0.125, 0.25}) {
    CAPTURE(mu_sd);
    taut::SlidingWay<double, 2> way;
    double load = 0;
    const auto row = [&](double change, bool slides) {
      load += change;
      way.go(load);
      way.follow(0, slides);
      way.follow(1, false);
    };
    // From the first load on.
    row(0, false);
    CHECK_FALSE(way.surely_slides(0, mu_sd));
    row(0.5, true);
    CHECK(way.surely_slides(0, mu_sd));
    CHECK_FALSE(way.surely_slides(1, mu_sd));
    row(99.5, true);
    row(0, false);
    CHECK_FALSE(way.surely_slides(0, mu_sd));
    // Let out.
    for (int i = 0; i < 8; ++i) {
      CHECK_FALSE(way.surely_slides(0, mu_sd));
      row(-10, i == 7);
    }
    for (int gone = 80; gone < 130; ++gone) {
      CAPTURE(gone);
      CHECK(way.surely_slides(0, mu_sd) == (gone >= 75 * (1 + 2 * mu_sd)));
      row(-1, true);
    }
    CHECK_FALSE(way.surely_slides(1, mu_sd));
    // Whenever it ceases, the next way counts from there: half as long this time.
    row(0, false);
    row(32, false);
    row(16, true);
    for (int gone = 48; gone < 65; ++gone) {
      CAPTURE(gone);
      CHECK(way.surely_slides(0, mu_sd) == (gone >= 40 * (1 + 2 * mu_sd)));
      row(1, true);
    }
    row(5, false);
    CHECK_FALSE(way.surely_slides(0, mu_sd));
  }
}

}  // namespace sliding_way_test
