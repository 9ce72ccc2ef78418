#include "campaign/many_cables_stepwise.hpp"

#include <limits>

#include "support/equilibrium.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace campaign {
namespace {

template <class SceneType>
double follow(const World<SceneType>& world, int substeps) {
  const auto solver = std::make_unique<taut::Stepwise<double, SceneType>>();
  constexpr double stopped = std::numeric_limits<double>::infinity();
  if (!solver->start(world.scene, substeps)) return stopped;
  support::Watch<SceneType, double> watch(world.scene);
  double worst = 0;
  for (const auto& sample : world.samples) {
    if (!solver->advance(sample, substeps)) return stopped;
    watch.forget_slips();
    worst = std::max(worst, double(watch.check(*solver, sample).worst()));
  }
  return worst;
}

}  // namespace

double stepwise_violation(const World<PlaneWeb>& world, int substeps) { return follow(world, substeps); }
double stepwise_violation(const World<SpaceWeb>& world, int substeps) { return follow(world, substeps); }

}  // namespace campaign
