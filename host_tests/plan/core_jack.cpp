#include "plan/core_jack.hpp"

#include <limits>

#include "lib/kinds/condense_scene.hpp"
#include "taut/planning/jack_planner.hpp"

namespace plan_test {
namespace {

using namespace taut::host;

template <class Cap>
class CoreJackOf : public CoreJack {
 public:
  explicit CoreJackOf(const SceneDescription& scene)
      : condensed_(new Condensed), tracker_(new Tracker), planner_(new Planner) {
    auto struts = std::make_unique<StrutsOf<double, Cap>>();
    static_cast<void>(condense_scene<double, 2, Cap>(scene, *condensed_, *struts));
    static_cast<void>(tracker_->start(*condensed_).status.ok());
  }
  bool go(const std::vector<double>& factor, double force, bool locked) override {
    taut::Sample<double, Cap> sample;
    for (std::size_t i = 0; i < factor.size(); ++i) sample.factor[static_cast<int>(i)] = factor[i];
    sample.jack[0][1] = {force, locked};
    const auto progress = tracker_->advance(sample);
    return progress.status.ok() && progress.fraction >= 1;
  }
  std::vector<double> tension() const override {
    std::vector<double> tension;
    for (int i = 0; i < tracker_->model().segments; ++i) tension.push_back(tracker_->tension(i));
    return tension;
  }
  double stroke() const override { return tracker_->slip_state().extension[0][1]; }
  CoreMoves plan(const PlanGoal& given, const CoreQuestion& question) override {
    typename Planner::Goal goal;
    const auto limit = [](double value) { return value < no_limit ? value : 0; };
    for (std::size_t i = 0; i < given.target.size(); ++i) goal.target[static_cast<int>(i)] = given.target[i];
    goal.most_force = limit(given.most_force[0][1]);
    goal.most_tension = limit(given.most_segment[0]);
    goal.most_stroke = limit(given.most_stroke[0][1]);
    goal.lock = given.lock;
    goal.worth_a_move = question.worth_a_move;
    CoreMoves found;
    const auto known = [](int) { return taut::JointFriction<double>(); };
    found.status = planner_->begin(*condensed_, known, tracker_->save(), goal, 0, 1, question.most_events);
    if (!found.status) return found;
    while (!planner_->step(question.slice)) {
    }
    const auto& best = planner_->best();
    found.count = best.count;
    found.force = best.force;
    found.error = best.error;
    found.error_now = planner_->error_now();
    for (std::size_t i = 0; i < given.target.size(); ++i)
      found.tension.push_back(best.tension[static_cast<int>(i)]);
    found.events = planner_->events();
    return found;
  }

 private:
  using Condensed = CondensedOf<double, Cap>;
  using Tracker = taut::Tracker<Condensed>;
  using Planner = taut::JackPlanner<Tracker>;

  std::unique_ptr<Condensed> condensed_;
  std::unique_ptr<Tracker> tracker_;
  std::unique_ptr<Planner> planner_;
};

}  // namespace

std::unique_ptr<CoreJack> make_core_jack(const SceneDescription& scene) {
  if (is_rigid(scene)) return std::make_unique<CoreJackOf<Rigid<Large>>>(scene);
  if (leans(scene)) return std::make_unique<CoreJackOf<Leaning<Large>>>(scene);
  return std::make_unique<CoreJackOf<Large>>(scene);
}

}  // namespace plan_test
