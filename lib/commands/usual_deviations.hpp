// What `estimate` takes for what a scene does not say of how well things are known.
#pragma once

#include <string>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"

namespace taut::host {

/// Standard deviation of the zero of a cell of which the scene says nothing, as a part of its largest
/// reading.
constexpr double usual_zero_sd = 0.002;

/// Standard deviation of the noise of a load cell of this cable of which neither scene nor readings tell
/// [N]: 1e-3 of the force of a strain of 0.5 %.
double usual_noise(const CableDescription& cable);

/// Gives every cable without one a standard deviation of mu: half of it. Returns a remark on each.
std::vector<Sentence> fill_in_mu_deviations(SceneDescription& scene);

/// Gives every jack's load cell that is not exact what the scene does not say of it, without a log: the
/// largest reading is taken for that of a strain of 0.5 %. Returns a remark on each.
std::vector<Sentence> fill_in_jacks(SceneDescription& scene);

/// Gives the scene standard deviations where it has none: half of mu; of a load cell, and of a measured force
/// of a segment or strut, its scatter in the log, 1 % of gain and 0.2 % of the largest reading for the zero;
/// 1 % of the force for the ram of a jack of which the scene says nothing; of a stroke 1 mm and a free zero.
/// Returns a remark on each.
std::vector<Sentence> fill_in_deviations(const std::string& path, const LogRules& rules,
                                         SceneDescription& scene);

/// The same for a log of which only the header is known: the largest reading of what it has is taken for that
/// of a strain of 0.5 %, of a strut 0.1 %, and its scatter for 1e-3 of it. The estimator finds out if
/// readings scatter more, not if they scatter less: forces are then as uncertain as this says.
std::vector<Sentence> fill_in_deviations(const LogReader& log, SceneDescription& scene);

}  // namespace taut::host
