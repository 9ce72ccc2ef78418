// Trackers of one scene side by side, for derivatives against differences.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <memory>

#include "estimation/site.hpp"

namespace estimation {

using Follower = taut::Tracker<taut::Condensed<double, PlaneCapacity>, most_unknowns>;

/// Three of them, begun with what is known of a scene of one cable: one mu, unknown 0.
inline std::unique_ptr<std::array<Follower, 3>> three_followers(
    const taut::Condensed<double, PlaneCapacity>& model,
    const taut::FrictionPrior<double, PlaneCapacity>& known) {
  auto trackers = std::make_unique<std::array<Follower, 3>>();
  const auto friction = [&](int j) {
    const auto limit = known.limit(0, j, known.mu[j]);
    return taut::JointFriction<double>{limit.rho, 0, limit.slope};
  };
  for (Follower& tracker : *trackers) REQUIRE(tracker.start(model, friction).status.ok());
  return trackers;
}

}  // namespace estimation
