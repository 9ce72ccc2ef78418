#include "lib/commands/balancing_jacks.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

struct JackedSegment {
  std::string end;
  std::size_t segment;
};

// Two jacks on one segment give one force; where statics give it, no length does.
std::vector<JackedSegment> jacked_segments(const SceneDescription& scene, const CondensedArrays& condensed) {
  std::vector<JackedSegment> found;
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const CableDescription& cable = scene.cables[c];
      const std::size_t segment = scene.first_segment(c) + (end == 0 ? 0 : cable.segments() - 1);
      const bool is_taken = !found.empty() && found.back().segment == segment;
      if (cable.is_jacked(end) && !is_taken && condensed.coupling[segment][segment] > 0)
        found.push_back({cable.name + "." + end_name(end), segment});
    }
  return found;
}

// What these segments resist together is singular along what moves between them.
std::vector<std::string> ends_that_balance(const SceneDescription& scene, const CondensedArrays& condensed) {
  const std::vector<JackedSegment> jacked = jacked_segments(scene, condensed);
  if (jacked.size() < 2) return {};
  const auto n = static_cast<Eigen::Index>(jacked.size());
  Eigen::MatrixXd resists(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::size_t a = jacked[static_cast<std::size_t>(i)].segment,
                        b = jacked[static_cast<std::size_t>(j)].segment;
      resists(i, j) =
          condensed.coupling[a][b] / std::sqrt(condensed.coupling[a][a] * condensed.coupling[b][b]);
    }
  // Of a unit diagonal: less is rounding.
  constexpr double least_pivot = 1e-9, least_part = 1e-6;
  Eigen::FullPivLU<Eigen::MatrixXd> pivots(resists);
  pivots.setThreshold(least_pivot);
  const Eigen::MatrixXd moves = pivots.kernel();
  std::vector<std::string> found;
  for (Eigen::Index i = 0; i < n; ++i)
    if (moves.row(i).lpNorm<Eigen::Infinity>() > least_part)
      found.push_back(jacked[static_cast<std::size_t>(i)].end);
  return found;
}

}  // namespace

std::string balance_warning(const SceneDescription& scene, const CondensedArrays& condensed) {
  if (scene.second_order) return {};
  const std::vector<std::string> ends = ends_that_balance(scene, condensed);
  if (ends.size() < 2) return {};
  std::string names;
  for (std::size_t i = 0; i < ends.size(); ++i)
    names += (i == 0 ? "" : i + 1 == ends.size() ? " and " : ", ") + ends[i];
  return "while the forces of " + names +
         " are given, nothing holds what they pull at, and there is an answer only where they balance; "
         "lock or anchor all but one of them, or hold it: add a strut, a support or a substructure";
}

}  // namespace taut::host
