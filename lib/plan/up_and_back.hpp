// The best pull with one jack, and the best pull and release: the whole of both, not a sample.
#pragma once

#include <string>
#include <vector>

#include "lib/plan/goal.hpp"
#include "lib/plan/jacking.hpp"

namespace taut::host {

/// A pull to `up`, and for two moves a release to `back`. Units: N.
struct UpAndBack {
  bool found = false;  ///< anything that has an answer within the limits
  double up = 0, back = 0;
  double error = 0;  ///< off_target() after them, and after lock-off where the goal asks for it
  double bound = 0;  ///< nothing that was not looked at is below this
  bool is_closed() const { return found && bound >= error - 1e-9; }
};

/// The best pull of the only jack of a cable from where it stands, without a lock-off to come. The forces on
/// the way up are lines between events, so this is exact.
UpAndBack best_pull(Jacking& jacking, const PlanGoal& goal, std::size_t jack, const std::string& start);

/// The best release from where the jack stands, as exact; `up` is where it stands.
UpAndBack best_release(Jacking& jacking, const PlanGoal& goal, std::size_t jack, double seating,
                       const std::string& start);

/// The best pull, from where the jack stands, and release.
///
/// Friction remembers turning points alone, so the state is a function of two forces, and one release shows
/// all that can follow a pull. Between two pulls whose releases meet the same events in the same order,
/// forces are linear in both on every cell between two events: the best of a cell is a linear program.
/// Intervals of pulls are divided, the most promising first, until none can hold better than the best: by how
/// fast forces change on the way up (`steepness` times that) an interval has a lower bound. With rigid
/// saddles the bound is proved for a steepness of 1: a release leaves min(T of the pull, what slides back).
/// On elastic structures it is not; 2 is taken there.
///
/// A lock-off draws in cable as a release does, so the states after it are those of the same releases, as far
/// behind the pull as the seating. Cost: at most `most_legs` moves.
UpAndBack best_up_and_back(Jacking& jacking, const PlanGoal& goal, std::size_t jack, double seating,
                           double steepness, const std::string& start, std::size_t most_legs);

}  // namespace taut::host
