#include "lib/live/mu_news.hpp"

#include <cmath>
#include <cstddef>

#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr double surely = 2, likely = 1, least_change = 0.02;
constexpr double half = 0.5, least_narrowing = 0.01;

// Of the joints of a cable.
struct Mean {
  double mu = 0, sd = 0;
};
Mean mean_of(const KnownMu& known, std::size_t first, std::size_t count) {
  Mean mean;
  for (std::size_t j = first; j < first + count; ++j) {
    mean.mu += known.mu[j] / static_cast<double>(count);
    mean.sd += known.sd[j] / static_cast<double>(count);
  }
  return mean;
}

std::string is_and_not(const std::string& what, double is, double was) {
  return "mu of " + what + " is " + fixed(is, 3) + " and not " + fixed(was, 3);
}

}  // namespace

KnownMu known_mu(const SceneDescription& scene) {
  KnownMu known;
  for (const CableDescription& cable : scene.cables) {
    double mean = 0;
    for (const double mu : cable.mu) mean += mu / static_cast<double>(cable.mu.size());
    for (const double mu : cable.mu) {
      known.mu.push_back(mu);
      // Where one unknown holds for all joints it is a factor.
      known.sd.push_back(cable.shared_mu && mean > 0 ? cable.mu_sd * mu / mean : cable.mu_sd);
    }
  }
  return known;
}

std::optional<MuNews> mu_news(const SceneDescription& scene, const KnownMu& planned, const KnownMu& now) {
  std::optional<MuNews> better;
  std::size_t first = 0;
  for (const CableDescription& cable : scene.cables) {
    const std::size_t count = cable.joints();
    if (count == 0) continue;
    const Mean is = mean_of(now, first, count), was = mean_of(planned, first, count);
    const bool is_narrow = is.sd <= half * was.sd && was.sd - is.sd >= least_narrowing * was.mu;
    for (std::size_t j = first; j < first + count; ++j) {
      const double change = std::fabs(now.mu[j] - planned.mu[j]);
      if (!(change > (is_narrow ? likely : surely) * now.sd[j] && change > least_change * planned.mu[j]))
        continue;
      if (cable.shared_mu || count == 1) return MuNews{is_and_not(cable.name, is.mu, was.mu), true};
      return MuNews{is_and_not("joint " + std::to_string(j - first + 1) + " of " + cable.name, now.mu[j],
                               planned.mu[j]),
                    true};
    }
    if (is_narrow && !better)
      better = MuNews{"mu of " + cable.name + " is known to " + significant(is.sd, 2) + " and not to " +
                          significant(was.sd, 2) + " any more",
                      false};
    first += count;
  }
  return better;
}

}  // namespace taut::host
