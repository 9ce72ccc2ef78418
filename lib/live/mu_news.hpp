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

/// What is new of mu since a plan was made.
struct MuNews {
  std::string why;        ///< `mu of C is 0.260 and not 0.200`
  bool is_other = false;  ///< mu is another one than that of the plan; else it is only known better
};

/// What is new since a plan was made for `planned.mu`, and what comes of it was found for `planned.sd`;
/// nothing if that is not worth mentioning. Mu is another one where that of a joint is off by more than a
/// fiftieth and by more than twice its present standard deviation, or by more than once where, in the mean of
/// its cable, these have become half of `planned.sd`; that alone, by at least a hundredth of mu, is to be
/// known better. So mu that wanders about within its spread asks for nothing, and what is learned once asks a
/// few times: the spread cannot halve more often than that.
std::optional<MuNews> mu_news(const SceneDescription& scene, const KnownMu& planned, const KnownMu& now);

}  // namespace taut::host
