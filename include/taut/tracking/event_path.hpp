// Follows a straight path of loads and jack forces from event to event.
#pragma once

#include <limits>

#include "taut/status.hpp"
#include "taut/tracking/level_friction.hpp"
#include "taut/tracking/mode_decision.hpp"

namespace taut {

/// How far a call to Tracker came.
template <class Scalar>
struct [[nodiscard]] Progress {
  Status status;
  Scalar fraction = 1;  ///< of the path that was followed; below 1 the state is the equilibrium there
  int events = 0;       ///< places where the state of a joint or a span was decided anew

  /// Whether the path has come to its end.
  bool is_complete() const { return status.ok() && !(fraction < 1); }
};

/// From the present state to the goal that the state has: decides, goes along the affine piece to its end,
/// and decides again. In second-order theory the model follows wherever a level ends.
template <class Cables, class LevelType>
class EventPath {
 public:
  using Scalar = typename Cables::Scalar;
  using Real = typename Cables::Real;

  EventPath(Cables& cables, LevelType& level) : cables_(cables), level_(level) {}

  /// Follows the path for at most so many events. Fails as Tracker::advance() does, the state then being the
  /// last that was tested. Cost: `events` times a decision, a map and a test of the forces.
  Progress<Scalar> follow(int event_budget) {
    Progress<Scalar> progress;
    cables_.find_forces();
    Real rest = 1;  // of the path
    Ending ending;
    int stalled = 0;
    const bool prestrains = cables_.state.now.prestrain != cables_.state.goal.prestrain;
    ModeDecision<Cables> modes(cables_);
    for (;;) {
      cables_.measure_path();
      progress.status = modes.decide(ending);
      if constexpr (Cables::is_adjustable) cables_.derivatives.pass();
      if (!progress.status) break;
      bool done = false;
      if (modes.further() == 0) {
        cables_.find_forces();
        const Status broken = follow_piece(ending, rest, done);
        if constexpr (Cables::Model::has_level)
          if (broken.ok() && (ending.ends_level || (done && prestrains))) {
            progress.status = come_to_level(modes);
            if (!progress.status) break;
            ending = {};
          }
        stalled = ending.step > 0 ? 0 : stalled + 1;
        if (!broken || stalled > 8 + 4 * cables_.joints()) {
          const int joint = ending.next.joint;
          progress.status =
              modes.find_further_on(broken ? cables_.at_joint(Code::state_iterations, joint) : broken);
          if (!progress.status) break;
        }
      }
      if (modes.further() > 0) {
        rest *= Real(1) - modes.further();
        ending = {};
        stalled = 0;
      }
      if (done || ++progress.events >= event_budget) break;
    }
    progress.fraction = static_cast<Scalar>(Real(1) - rest);
    // Rounding must not say that a path came to its end which did not.
    if (rest > 0 && progress.fraction >= Scalar(1))
      progress.fraction = Scalar(1) - std::numeric_limits<Scalar>::epsilon();
    cables_.state.arrived = progress.status.ok() && rest == 0;
    cables_.differentiate();
    return progress;
  }

  /// Goes toward the goal as far as the present piece reaches, and decides nothing; the state must have a
  /// map. Cost: that of EventSearch::next().
  void come_along_piece() {
    Inputs dx;
    cables_.directions(dx);
    Ending ending;
    const Real step = EventSearch<Cables>(cables_).next(dx, ending);
    cables_.state.now = Loads::between(cables_.state.now, cables_.state.goal, step);
    cables_.find_forces();
  }

 private:
  using Loads = typename Cables::Loads;
  using Inputs = typename Cables::Inputs;
  using Ending = taut::Ending<Real>;

  /// Goes along the present piece to its end. If the forces there break a law, the state is the one before.
  /// Not in one frame with the decisions, which need the most stack.
  [[gnu::noinline]] Status follow_piece(Ending& ending, Real& rest, bool& done) {
    EventSearch<Cables> events(cables_);
    Inputs dx, x;
    cables_.directions(dx);
    const Real step = events.next(dx, ending);  // of what is left of the path
    done = Real(1) - step <= Real(4) * Cables::epsilon ||
           (Real(1) - step) * events.change(dx) <= cables_.held(ending.next) * cables_.force_tolerance();
    const Loads before = cables_.state.now;
    cables_.state.now = Loads::between(cables_.state.now, cables_.state.goal, done ? Real(1) : step);
    cables_.find_forces();
    const Status status = events.check_forces();
    if (!status) {
      cables_.state.now = before;
      cables_.find_forces();
      done = false;
      return status;
    }
    ending.has_total = true;
    rest = done ? Real(0) : rest * (Real(1) - step);
    cables_.state.peak = largest(cables_.model->segments, &cables_.force[0], cables_.state.peak);
    cables_.state.last = dx;
    cables_.values(cables_.state.now, x);
    if constexpr (Cables::is_adjustable)
      if (!done) events.find_saltation(ending, x);
    return status;
  }
  /// The forces have come to where another level begins: the model follows, and all forces are found anew
  /// from totals. Where there are none, all is as before.
  Status come_to_level(ModeDecision<Cables>& modes) {
    cables_.freeze();
    Real sum = 0;
    for (int i = 0; i < cables_.model->segments; ++i) sum += cables_.force[i];
    level_.come_to(sum, cables_.state.now, cables_.elongations_by(cables_.state.moved));
    take_level(cables_, level_);
    const Status status = modes.find_again();
    if (!status) {
      level_.go_back();
      take_level(cables_, level_);
    }
    return status;
  }

  Cables& cables_;
  LevelType& level_;
};

}  // namespace taut
