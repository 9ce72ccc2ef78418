// The planner of the core on a scene of the files: type-erased, for who compares it with plans of the host.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "lib/plan/goal.hpp"
#include "taut/status.hpp"

namespace plan_test {

/// What taut::JackPlanner found.
struct CoreMoves {
  taut::Status status = taut::Status::success();
  int count = 0;
  std::array<double, 2> force{};
  double error = 0, error_now = 0;
  std::vector<double> tension;
  int events = 0;
};

/// How it is asked.
struct CoreQuestion {
  double worth_a_move = 0;
  int most_events = 4000;
  int slice = 4000;  ///< events a call
};

/// A tracker of the core, in double, whose one jack is that at the end of the first cable.
class CoreJack {
 public:
  virtual ~CoreJack() = default;
  /// False if there is no answer.
  virtual bool go(const std::vector<double>& factor, double force, bool locked = false) = 0;
  virtual std::vector<double> tension() const = 0;
  virtual double stroke() const = 0;
  /// From where the jack stands; the tracker itself stays there.
  virtual CoreMoves plan(const taut::host::PlanGoal& goal, const CoreQuestion& question) = 0;
};

/// Started, and without loads. The scene need not outlive it.
std::unique_ptr<CoreJack> make_core_jack(const taut::host::SceneDescription& scene);

}  // namespace plan_test
