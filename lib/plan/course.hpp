// A plan as numbers: which jacks move in which stage, and what comes of the forces that they are given.
#pragma once

#include <string>
#include <vector>

#include "lib/plan/goal.hpp"
#include "lib/plan/jacking.hpp"

namespace taut::host {

/// Jacks that move together, or that are locked together.
struct CourseStep {
  std::vector<std::size_t> jacks;  ///< by their number
  bool locks = false;
};

/// What happens in which order; the forces are open.
using CourseShape = std::vector<CourseStep>;

/// The number of forces that a shape leaves open.
std::size_t open_forces(const CourseShape& shape);
/// All stages of a shape with these forces, one a step, for jacks that stand at `first`.
std::vector<PlanStage> stages_of(const CourseShape& shape, const std::vector<double>& force, PlanStage first);
/// The reverse: the forces that such stages give to what the shape leaves open, from the step `first` on.
std::vector<double> forces_of(const CourseShape& shape, const std::vector<PlanStage>& stages,
                              std::size_t first = 0);

/// What comes of a plan.
struct CourseOutcome {
  bool whole = false;                        ///< the model has an answer all the way
  double error = 0;                          ///< off_target() at the end
  double excess = 0;                         ///< by how much of it a limit is passed on the way; 0: by none
  std::vector<std::vector<double>> tension;  ///< after every step [N]
  std::vector<std::vector<double>> stroke;   ///< after every step, of every jack [m]

  /// What is compared: any plan within the limits is better than any beyond them.
  double merit() const;
};

/// Plans of one shape, each followed event by event from the last step that it has in common with the one
/// before.
class Course {
 public:
  /// From the state that `start` names. `least_ratio` is that of the forces of two jacks, of every cable:
  /// with less the cable is pulled through. All but the strings and lists must outlive it.
  Course(Jacking& jacking, const PlanGoal& goal, CourseShape shape, std::string start,
         std::vector<double> least_ratio);

  const CourseShape& shape() const { return shape_; }
  /// The step in which an open force is given, and its jack.
  std::size_t step_of(std::size_t force) const { return step_of_[force]; }
  std::size_t jack_of(std::size_t force) const { return jack_of_[force]; }
  double most(std::size_t force) const { return jacking_.jacks()[jack_of_[force]].most_force; }
  const Jacking& jacking() const { return jacking_; }
  /// If this force and the next are those of two jacks of one cable in the same step: the least ratio of
  /// them; else 0.
  double least_ratio(std::size_t force) const;
  /// Lowers the larger of such forces as far as it has to be.
  void bring_together(std::vector<double>& force) const;

  /// Cost: that of the legs from the first force that differs on.
  CourseOutcome at(const std::vector<double>& force);

 private:
  double excess_of(const Leg& leg) const;

  Jacking& jacking_;
  const PlanGoal& goal_;
  CourseShape shape_;
  std::vector<std::size_t> step_of_, jack_of_;
  std::vector<double> least_ratio_;  // by cable
  std::vector<std::string> state_;   // before every step that is known
  std::vector<PlanStage> known_;     // the stages that led there
  std::vector<double> excess_;       // up to there
  CourseOutcome last_;
};

/// By how much of it a point passes a limit of the goal; 0: no limit.
double excess_at(const LegPoint& point, const PlanGoal& goal, const std::vector<PlanJack>& jacks);

}  // namespace taut::host
