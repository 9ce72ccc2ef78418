// In which stage of a plan the jacks stand.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/plan/course.hpp"
#include "lib/plan/jacking.hpp"

namespace taut::host {

/// Follows the jacks row by row along the stages of a plan.
///
/// A move is reached when all its jacks have come to their forces, but for a tolerance, or beyond: then they
/// are to stop. It is passed when they have stopped: when none has gone on for `hold`, or one has turned. A
/// lock is passed when all its ends are locked. A stage is skipped when what only a later one does is seen:
/// its wedges hold, a jack that moves for the first time there has come half of its way, or the jack has
/// turned before its force and come to that of the next move, from at least a quarter of the way between the
/// two.
class StageFinder {
 public:
  static constexpr double hold = 2;  ///< [s]

  /// Where the jacks are, to go on from after a break.
  struct Memory {
    std::size_t stage = 0;
    PlanStage begin;              ///< where the jacks stood when the stage began
    std::vector<double> extreme;  ///< how far they have come since, in the direction of the stage
    std::vector<char> reached;
    std::vector<double> still_at, still_since;  ///< where and since when [s] each has stood
    std::vector<char> skipped;                  ///< of every stage
  };

  /// Of jacks that stand at `first`; `tolerance` of every jack [N].
  StageFinder(CourseShape shape, std::vector<PlanStage> stages, PlanStage first,
              std::vector<double> tolerance);

  void take(double time, const PlanStage& now);

  /// The stage that is jacked; that behind the last one when all are passed.
  std::size_t present() const { return memory_.stage; }
  bool is_over() const { return memory_.stage >= stages_.size(); }
  /// Whether a jack of the present stage has come to its force.
  bool is_reached(std::size_t jack) const { return memory_.reached[jack] != 0; }
  /// Whether all have.
  bool is_reached() const;
  /// 1: a jack of the present stage is to pull, -1: to be let out, 0: it is there.
  int direction(std::size_t jack) const;
  bool is_skipped(std::size_t stage) const { return memory_.skipped[stage] != 0; }
  const CourseShape& shape() const { return shape_; }
  const std::vector<PlanStage>& stages() const { return stages_; }

  const Memory& memory() const { return memory_; }
  void go_on(Memory memory) { memory_ = std::move(memory); }

 private:
  void look(double time, const PlanStage& now);
  bool is_passed(double time, const PlanStage& now) const;
  std::size_t skipped_to(const PlanStage& now) const;
  void go_to(std::size_t stage, double time, const PlanStage& now);

  CourseShape shape_;
  std::vector<PlanStage> stages_;
  std::vector<double> tolerance_;
  Memory memory_;
};

}  // namespace taut::host
