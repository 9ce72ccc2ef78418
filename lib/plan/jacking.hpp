// Moves of jacks on a model: from stage to stage, event by event, and back to any state that was kept.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/kinds/leg_model.hpp"
#include "lib/plan/goal.hpp"

namespace taut::host {

/// A jacked end, and how far it may go. Units: N, m.
struct PlanJack {
  std::size_t cable = 0, end = 0;
  double most_force = 0;   ///< by the goal, by the cable and by what a log may hold
  double most_stroke = 0;  ///< by the goal
  std::string name;        ///< of its column
};

/// The jacked ends of a scene, in its order. `most_possible` are the largest forces that the condensed cables
/// take.
std::vector<PlanJack> plan_jacks(const SceneDescription& scene, const PlanGoal& goal,
                                 const std::vector<double>& most_possible);

/// Where all jacks stand after a move.
struct PlanStage {
  std::vector<double> force;  ///< of every jack [N]
  std::vector<char> locked;
};

/// A move that has been made, with the load factors that came with it.
struct PastMove {
  PlanStage stage;
  std::vector<double> factor;  ///< of every load pattern
};

/// Asked before every move whether nobody needs the plan any more.
using GiveUp = std::function<bool()>;
/// Thrown where the answer is yes.
struct GivenUp : std::exception {
  const char* what() const noexcept override { return "the plan is not needed any more"; }
};

/// Forces and extensions somewhere on the path of a move.
struct LegPoint {
  double part = 0;                ///< of the whole move
  std::vector<double> tension;    ///< of every segment [N]
  std::vector<double> stroke;     ///< of every jack [m]
  std::vector<JointState> state;  ///< of every joint on the way here
};

/// The path of a move. Between two points that follow each other all is linear.
struct Leg {
  bool whole = false;            ///< else the model has no answer behind the last point
  std::vector<LegPoint> points;  ///< where it begins, the events, and where it ends
  const LegPoint& end() const { return points.back(); }
};

/// A move that the model had no answer to.
struct FailedMove {
  Status status = Status::success();  ///< success: there is none
  PlanStage to;
  double part = 0;  ///< of the move until there
};

/// A model that is jacked.
class Jacking {
 public:
  /// Throws InputError if the scene cannot be used. The description and the goal must outlive it.
  Jacking(const SceneDescription& scene, const PlanGoal& goal, std::vector<PlanJack> jacks,
          GiveUp give_up = {});

  /// Brings prestrain and loads on, with all jacks at zero. If the structure does not stand under its loads
  /// without its cables, or in second-order theory leaves a cable slack by a hundredth of its length, the
  /// loads come with the first move. False if there is no answer even without loads; why() says the reason.
  [[nodiscard]] bool begin();
  /// In place of begin(): brings prestrain on and goes through all that has been jacked; plans go on from
  /// there, with the loads of the goal. A move that has no answer, as between noisy readings of two jacks
  /// near zero, is left out. False if the last one has none; why() says the reason.
  [[nodiscard]] bool begin_after(const std::vector<PastMove>& past);
  const Status& why() const { return why_; }
  bool loads_come_first() const { return loads_come_first_; }
  /// Whether all loads are on where plans begin; else they grow with the first move.
  bool loads_are_on() const { return loads_are_on_; }

  const std::vector<PlanJack>& jacks() const { return jacks_; }
  PlanStage at_rest() const {
    return {std::vector<double>(jacks_.size(), 0), std::vector<char>(jacks_.size(), 0)};
  }
  /// Where the jacks stand before the first stage of a plan: at rest, or where the past has left them.
  const PlanStage& beginning() const { return beginning_; }
  /// The state reached, to come back to.
  std::string state() const { return model_->save(); }
  void go_to(const std::string& state) { static_cast<void>(model_->go_to(state)); }
  /// Moves the jacks to a stage, event by event; `seen`, if given, gets the state at every point of the leg.
  Leg follow(const PlanStage& stage, std::vector<std::string>* seen = nullptr);
  /// The same in one go; no points but the last.
  Leg jump(const PlanStage& stage);
  /// Moves until now, parts of moves counted as moves.
  std::size_t legs() const { return legs_; }
  LegPoint here() const;
  /// Whether follow() has brought any jack to where it did not stand before the first stage.
  bool has_moved() const { return has_moved_; }
  /// Of the moves of follow(), the first one that failed.
  const FailedMove& first_failure() const { return failure_; }

 private:
  bool hangs_too_low() const;
  LogRow row_of(const PlanStage& stage, const std::vector<double>& factor) const;
  void count();

  const SceneDescription& scene_;
  const PlanGoal& goal_;
  std::vector<PlanJack> jacks_;
  GiveUp give_up_;
  std::unique_ptr<LegModel> model_;
  PlanStage beginning_;
  bool loads_come_first_ = true, loads_are_on_ = true;
  Status why_ = Status::success();
  std::size_t legs_ = 0;
  bool has_moved_ = false;
  FailedMove failure_;
};

}  // namespace taut::host
