// A second opinion: a scene in load steps, each one complementarity problem in long double.
#pragma once

#include <memory>
#include <vector>

#include "reference/structure.hpp"

namespace campaign {

using Exact = reference::Exact;

/// Follows the straight paths between samples in load steps. In a step the slips of all joints, either way,
/// and the excess lengths of slack stretches solve one linear complementarity problem. Tried are Lemke's
/// method with many random covering vectors, changing in turn what disagrees, and all combinations where they
/// are few; of several answers the one with the smaller change of forces is taken. Shares no code with the
/// solvers of the library.
///
/// With few steps the answer is only near to the right one, but every state is one: its forces balance and
/// are within friction.
class LoadSteps {
 public:
  /// Loads, prestrain and jacks at one point of the path.
  struct End {
    bool jacked = false, locked = false;
    Exact force = 0;      ///< of a jack at work [N]
    Exact extension = 0;  ///< of a locked end [m]
  };
  struct Drive {
    std::vector<Exact> factors;
    Exact prestrain = 0;
    std::vector<End> ends;  ///< 2 x cable + end
  };
  /// What has moved [m]: over every joint, out of every cable end, and the excess length of a slack stretch
  /// at its first segment.
  struct Moves {
    std::vector<Exact> slip, extension, excess;
  };

  template <int Dimension, class Cap>
  explicit LoadSteps(const taut::Scene<double, Dimension, Cap>& scene)
      : LoadSteps(reference::write_out(scene)) {}
  explicit LoadSteps(reference::Structure structure);
  ~LoadSteps();
  LoadSteps(const LoadSteps&) = delete;
  LoadSteps& operator=(const LoadSteps&) = delete;

  /// Brings the prestrain on.
  bool start(int steps);
  /// Follows the straight path to the row; false if a step has no answer that is found.
  bool advance(const reference::Row& row, int steps);

  Exact tension(int segment) const;
  /// Of a cable end, 2 x cable + end [m].
  Exact extension(int end) const;
  /// The worst violation of balance, T >= 0 and friction in any step, as a part of the largest force.
  Exact violation() const;
  /// The largest change of a tension in one step of the last path, as a part of the largest force.
  Exact largest_change() const;

  enum class Way {
    goes_on,  ///< forces change with the load
    jumps,    ///< there is an answer, but far away however small the step
    none,     ///< no answer was found
  };
  /// How a state that somebody else has reached can go on towards `goal`. The state is put in place of the
  /// present one.
  Way probe(const Drive& now, const Drive& goal, const Moves& moves, Exact peak);
  /// After probe(): of the joints at their limits, what is left of the smallest pivot of the matrix that
  /// takes their slips to their friction, as a part of the largest. Of the order of rounding: a mechanism.
  Exact pivot() const;
  /// After probe(): whether all combinations of joints that stick or slide were tried.
  bool exhausted() const;

 private:
  class Stepper;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace campaign
