#include "lib/live/planner.hpp"

#include <sys/resource.h>

#include <exception>
#include <utility>

#include "lib/files/status_text.hpp"
#include "lib/kinds/own_stack.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {
namespace {

// Rows come first.
void give_way() {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, 10);  // there, of this thread alone
#endif
}

}  // namespace

Planner::Planner(const PlanGoal& goal, std::function<void(PlanFound)> found)
    : goal_(goal), found_(std::move(found)) {
  const SignalsHeldBack held;
  thread_ = std::thread([this] { work(); });
}

Planner::~Planner() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  asked_.notify_all();
  thread_.join();
}

void Planner::ask(PlanRequest request) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (request_) return;
    request_ = std::move(request);
  }
  asked_.notify_all();
}

void Planner::work() {
  while (true) {
    PlanRequest request;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      asked_.wait(lock, [this] { return is_over_ || request_; });
      if (is_over_) return;
      request = std::move(*request_);
      request_.reset();
    }
    PlanFound found;
    call_with_own_stack([&] {
      give_way();
      found = find(std::move(request));
      return 0;
    });
    if (is_over_) return;
    // Not with that priority: rows wait while it is taken.
    found_(std::move(found));
  }
}

PlanFound Planner::find(PlanRequest request) const {
  PlanFound found;
  found.request = std::move(request);
  const SceneDescription& scene = found.request.scene;
  const PlanPast& past = found.request.past;
  const GiveUp give_up = [this] { return is_over_.load(); };
  try {
    found.plan = find_rest_of_plan(scene, goal_, past, give_up);
    if (!found.plan.status())
      found.failure = failure_text(found.plan.status(), scene).english();
    else if (!found.plan.outcome.whole)
      found.failure = "the structure has no answer on the way";
    else if (has_prior(scene))
      found.prior =
          outcome_over_prior(scene, goal_, found.plan.jacks, found.plan.stages, past.moves, give_up);
  } catch (const std::exception& error) {
    found.failure = error.what();
  }
  return found;
}

}  // namespace taut::host
