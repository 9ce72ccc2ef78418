// What an Estimator of the program has learned of friction, by columns of the log.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "lib/files/learned_friction.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/friction_account.hpp"

namespace taut::host {

/// The mu of every joint, and its standard deviation, where an estimate begins.
struct FrictionBefore {
  std::vector<double> mu, sd;

  template <class EstimatorType>
  static FrictionBefore of(const EstimatorType& estimator, int joints) {
    FrictionBefore before;
    for (int j = 0; j < joints; ++j) {
      before.mu.push_back(static_cast<double>(estimator.mu(j)));
      before.sd.push_back(static_cast<double>(estimator.mu_deviation(j)));
    }
    return before;
  }
};

/// The column of the log whose readings raise an alarm where they contradict.
inline std::string column_of(const FrictionAccount::Source& source, const SceneDescription& scene) {
  const auto [kind, cable, place] = source;
  const std::string number = std::to_string(place + 1);
  if (cable < 0) return "strut" + number;
  const std::string& name = scene.cables[static_cast<std::size_t>(cable)].name;
  if (kind == Alarm::Kind::segment) return name + ".T" + number;
  const std::string end = name + "." + end_name(static_cast<std::size_t>(place));
  return kind == Alarm::Kind::elongation ? end + ".stroke" : end;
}

/// What brought information on unknown `p` of friction, the most first.
inline std::vector<FrictionSource> sources_of(int p, const FrictionAccount& account,
                                              const SceneDescription& scene) {
  std::vector<FrictionSource> sources;
  double sum = 0;
  for (const auto& [of, entry] : account.entries()) {
    if (of.first != p) continue;
    sources.push_back({column_of(of.second, scene), entry.readings, entry.information});
    sum += entry.information;
  }
  for (FrictionSource& source : sources) source.share /= sum;
  std::stable_sort(sources.begin(), sources.end(),
                   [](const FrictionSource& a, const FrictionSource& b) { return a.share > b.share; });
  return sources;
}

/// Every mu that was not known where the estimate began: one of a cable with a common one, that of its first
/// joint that can slide, or one of every joint.
template <class EstimatorType, class CondensedType, class PriorType>
std::vector<LearnedFriction> learned_mu(const EstimatorType& estimator, const CondensedType& condensed,
                                        const PriorType& prior, const FrictionBefore& before,
                                        const SceneDescription& scene) {
  std::vector<LearnedFriction> all;
  for (int c = 0; c < condensed.cables.size(); ++c) {
    const auto& cable = condensed.cables[c];
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k, p = estimator.friction_unknown(j);
      const auto at = static_cast<std::size_t>(j);
      if (p < 0 || !(before.sd[at] > 0)) continue;
      const bool is_common = prior.shared[c];
      const std::string& name = scene.cables[static_cast<std::size_t>(c)].name;
      // Of a prior what the scene says, without what scatters from joint to joint.
      const double prior_sd = static_cast<double>(prior.mu_sd[c]),
                   said = scene.cables[static_cast<std::size_t>(c)].mu_sd;
      const bool is_prior = is_common && said > 0 && std::fabs(before.sd[at] - prior_sd) < 1e-5 * prior_sd;
      all.push_back({is_common ? name : name + "." + std::to_string(k + 1), before.mu[at],
                     is_prior ? said : before.sd[at], static_cast<double>(estimator.mu(j)),
                     static_cast<double>(estimator.mu_deviation(j)),
                     sources_of(p, estimator.account(), scene)});
      if (is_common) break;
    }
  }
  return all;
}

}  // namespace taut::host
