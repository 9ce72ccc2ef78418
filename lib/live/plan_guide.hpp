// A plan beside the rows: where the jacks stand in it, what they are to do, and when it is found anew.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/live/jack_path.hpp"
#include "lib/live/mu_news.hpp"
#include "lib/live/plan_now.hpp"
#include "lib/live/planner.hpp"
#include "lib/live/stage_finder.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal.hpp"
#include "lib/plan/prior.hpp"

namespace taut::host {

/// Not for several threads at once.
class PlanGuide {
 public:
  /// `goal_text` is what the goal was read from. Scene and goal must outlive it.
  PlanGuide(const SceneDescription& scene, const PlanGoal& goal, const std::string& goal_text,
            const Plan& plan, const std::optional<PriorOutcome>& prior);

  /// What was taken for mu before the first row, with the standard deviations that the scene does not say.
  void begin(const KnownMu& mu);
  /// A row with its answer; `factor` are those of the loads that the structure has. Returns what a new plan
  /// is to be found from, if it is worth one and `may_ask`.
  std::optional<PlanRequest> take(const LogRow& row, const Answer& answer, const std::vector<double>& factor,
                                  bool may_ask);
  /// What was found for the request. Returns whether anything is to be shown anew.
  void take(const PlanFound& found);

  PlanNow now() const;

  /// All that a new start needs, as one line.
  std::string state() const;
  /// Goes on from what state() gave; false if that was for another goal, or is nothing that it has written.
  bool go_on(const std::string& state);
  /// Whether the plan, or a stage of it, has changed since this was asked last.
  bool take_change();

 private:
  // How far a jack is surely ahead of what the estimator believes.
  struct Ahead {
    std::optional<double> read;  // where it stands
    double by = 0;
  };

  PlanStage stand(const LogRow& row, const Answer& answer) const;
  void look_ahead(const LogRow& row, const PlanStage& now);
  void pass_stages(std::size_t before);
  void watch_limits(const Answer& answer);
  bool has_moved() const;
  std::optional<MuNews> news(const KnownMu& mu) const;
  PlanRequest request(double time, const MuNews& news, const KnownMu& mu);
  void adopt(const PlanFound& found);
  void take_outcome(const Plan& plan, const std::optional<PriorOutcome>& prior);
  PlanOrder order_of(std::size_t jack) const;
  std::string say(const std::vector<PlanOrder>& orders, const ForceUnit& unit) const;
  PlanStageNow stage_now(std::size_t stage) const;

  const SceneDescription& scene_;
  const PlanGoal& goal_;
  std::string goal_print_;
  std::vector<PlanJack> jacks_;
  std::vector<double> tolerance_;            // of every jack [N]
  std::vector<PlanStageNow> passed_;         // before the stages of the finder
  StageFinder finder_;                       // of the plan, or of what was planned anew
  std::vector<std::vector<double>> stroke_;  // after each of its stages
  JackPath path_;
  PlanStage now_;    // where the jacks stand
  double time_ = 0;  // of that
  bool has_row_ = false;
  std::size_t moves_left_;
  double error_ = 0;
  std::optional<double> expected_, at_95_;
  KnownMu planned_;  // what the plan was made with
  std::vector<PlanAnew> anew_;
  std::string off_plan_;          // a jack was stopped elsewhere: how
  std::vector<Ahead> ahead_;      // of every jack
  std::vector<double> asked_at_;  // where the jacks stood when a plan was asked for
  bool is_planning_ = false, has_changed_ = false;
  std::set<std::string> raised_;  // limits
};

}  // namespace taut::host
