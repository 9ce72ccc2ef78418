// A jack that takes over from a wedge: what the wedge held was known only so well, and that it has let go
// teaches nothing of it.
#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"

using namespace estimation;

TEST_CASE("forces that friction keeps stay as uncertain as they were when a jack takes over from a wedge") {
  Ground ground;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.law = taut::FrictionLaw::capstan;
  cable.seating = 0.004;
  support::rigid_saddles(ground.known, cable, support::chain_points(9));
  ground.set_true_mu(std::vector<double>(16, 0.2));
  Instruments instruments;
  instruments.has_cell = false;
  int held = 0, all = 0, narrower = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto site = std::make_unique<Site<double>>(ground, instruments, full, seed);
    // A peak that few readings show, and a wedge that lets the cable slide back.
    ramp(*site, 0, 1.05, 30);
    ramp(*site, 1.05, 0.97, 6);
    for (int i = 0; i < 3; ++i) site->advance(0.97 * full, true);
    const int jack = site->segments() - 1;
    const double by_wedge = site->true_force(jack);
    std::vector<double> deviation;
    for (int s = 0; s < jack; ++s) deviation.push_back(site->estimator().deviation(s));
    for (int i = 1; i <= 10; ++i) site->advance(by_wedge * 0.099 * i, true);
    // Only next to the jack anything slides.
    for (int i = 0; i < 12; ++i) {
      site->advance(by_wedge * (1.002 + 0.0002 * i));
      for (int s = 0; s + 2 < jack; ++s, ++all) {
        held += site->holds_truth(s) ? 1 : 0;
        narrower += site->estimator().deviation(s) < 0.9 * deviation[static_cast<std::size_t>(s)] ? 1 : 0;
      }
    }
    REQUIRE(site->good());
  }
  CHECK(held > 0.9 * all);
  CHECK(narrower < 0.02 * all);
}
