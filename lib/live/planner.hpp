// A plan that is found while rows go on.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "lib/files/scene_description.hpp"
#include "lib/live/mu_news.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/prior.hpp"

namespace taut::host {

/// What a new plan is to begin from: copies, which nobody else touches.
struct PlanRequest {
  double time = 0;  ///< of the row that asked for it [s]
  std::string why;
  SceneDescription scene;  ///< with mu as it is known now
  KnownMu mu;
  PlanPast past;
};

struct PlanFound {
  PlanRequest request;
  Plan plan;
  std::optional<PriorOutcome> prior;
  std::string failure;  ///< why there is none; empty: there is
};

/// One request at a time, in a thread with the stack that solvers need and, on a Linux system, a lower
/// priority.
class Planner {
 public:
  /// `found` is called in another thread, of the usual priority. The goal must outlive it.
  Planner(const PlanGoal& goal, std::function<void(PlanFound)> found);
  /// Gives up what is being looked for.
  ~Planner();
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// Looks for a plan, unless it does so already. Never waits.
  void ask(PlanRequest request);

 private:
  void work();
  PlanFound find(PlanRequest request) const;

  const PlanGoal& goal_;
  std::function<void(PlanFound)> found_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::optional<PlanRequest> request_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace taut::host
