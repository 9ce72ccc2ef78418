// From a plan to the best one near it, by linear programs on the linear pieces around.
#pragma once

#include <vector>

#include "lib/plan/course.hpp"

namespace taut::host {

/// A plan and what comes of it.
struct CoursePlan {
  std::vector<double> force;  ///< what the shape leaves open [N]
  CourseOutcome outcome;
};

/// The best plan that is found going downhill from `force`. `width` is how far apart plans are that are
/// looked at first [N].
///
/// The forces at the end are piecewise linear in the forces of all moves. On the piece of a plan the best one
/// within a box is a linear program, with the limits at the ends of moves as rows. It is solved for the piece
/// of the plan, for those of its neighbours at the sides of the box, and then for that of the best plan
/// found, as long as this is another one; without a better plan the box is made smaller, down to 1e-9 of
/// `width`. Ends in a plan from which no piece that was seen leads downhill: a local optimum, of which
/// nothing is proved. Cost: at most `most_legs` moves.
CoursePlan descend(Course& course, const PlanGoal& goal, const std::vector<double>& force, double width,
                   std::size_t most_legs);

}  // namespace taut::host
