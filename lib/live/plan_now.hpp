// How the jacks stand in a plan at one moment, for all who look on.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/report/number_text.hpp"

namespace taut::host {

/// A stage of a plan. Units: N, m.
struct PlanStageNow {
  std::string name;                   ///< the number of the move, or `lock`
  bool locks = false;                 ///< else it is a move
  std::vector<std::size_t> jacks;     ///< that do something
  std::vector<double> force, stroke;  ///< of every jack at its end; of one that was passed, where it stopped
  bool passed = false, skipped = false;
};

/// What a jack is to do.
enum class JackOrder { pull, let_out, stop, lock };

/// `pull`, `let out`, `stop`, `lock`.
const char* order_word(JackOrder order);

/// An order for one jack. Units: N, and what its gauge shows.
struct PlanOrder {
  std::size_t jack = 0;
  JackOrder order = JackOrder::stop;
  double to = 0, to_go = 0;                     ///< to the force of the stage; less than zero: beyond it
  std::optional<double> gauge_to, gauge_to_go;  ///< where the scene has a calibration
};

/// A plan that was found on the way.
struct PlanAnew {
  double time = 0;  ///< of the row that asked for it [s]
  std::string why;
};

/// What is shown of a plan.
struct PlanNow {
  std::vector<std::string> jacks;
  std::vector<PlanStageNow> stages;
  std::size_t present = 0;                ///< the stage that is jacked; as many as there are: all are passed
  std::vector<PlanOrder> orders;          ///< of the jacks of the present stage
  std::string say;                        ///< all of these in one sentence
  double error = 0;                       ///< off target at the end by what is known now, relative
  std::optional<double> expected, at_95;  ///< over what is known of mu now
  bool is_planning = false;               ///< a new plan is being looked for
  std::vector<PlanAnew> anew;
  std::vector<std::string> alarms;  ///< `plan-limit:C.end`, `plan-limit:C.T3`, `plan-limit:C.end.stroke`
  ForceUnit unit;

  bool is_over() const { return present >= stages.size(); }
  /// `pull`, `let out`, `lock`, `stop` if that is all there is to do, `done` at the end.
  std::string order() const;
  /// The force that a jack is to go to in the present stage; nothing if it has none.
  std::optional<double> mark(std::size_t jack) const;
};

/// `planned anew at 12 s: because ...`.
std::string anew_text(const PlanAnew& anew);
/// How near it will come: `at the end 1.27 % off target, expected 2.13 %, at 95 % 3.97 %`.
std::string error_text(const PlanNow& now);
/// The stage on one line: `1 pull C.end to 481.2 kN, 95.7 mm`.
std::string stage_text(const PlanNow& now, std::size_t stage);

}  // namespace taut::host
