// Whether what has been learned of friction is worth a new plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/files/scene_description.hpp"

namespace taut::host {

/// What is known of mu at every joint of a scene.
struct KnownMu {
  std::vector<double> mu, sd;
};

/// What a scene says of mu.
KnownMu known_mu(const SceneDescription& scene);

/// Why a plan that was made for `planned` should be made anew, as `mu of C is 0.26 and not 0.20`; nothing if
/// it need not be. It should where mu of a joint is off what was planned with by more than twice the present
/// standard deviation and by more than a fiftieth; or where the standard deviations of a cable, in the mean,
/// have become half of what they were, by at least a hundredth of mu. Both begin anew with every plan, so mu
/// that wanders about within its spread asks for nothing, and what is learned once asks for a few plans: the
/// spread cannot become half of what it was more often than that.
std::optional<std::string> mu_news(const SceneDescription& scene, const KnownMu& planned, const KnownMu& now);

}  // namespace taut::host
