// A wedge that holds yet though the log has its end unlocked: its jack has not come to pull what it holds.
#pragma once

#include <cmath>

#include "taut/estimation/jack_load.hpp"
#include "taut/estimation/jump_guard.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Whether the wedge of an end that was locked until a row, which has it unlocked, holds yet. Nobody can take
/// a wedge out before the jack pulls what it `held`: a jack that was read to pull less while the end was
/// locked, and surely pulls less now, is on its way there. One that has come farther in a row than a quarter
/// of that, or in load stages to three quarters, may have been there in between, and have been let out again;
/// so it has if the far end has half of its force at most. From then on the wedge holds until the jack pulls
/// as much, or may have done so and goes down by a twentieth; a reading of more that jumps there is believed
/// in the next row. Of a wedge that held in the first row of all nothing is known. Cost: a few operations.
template <class Load, class Scalar>
[[nodiscard]] bool wedge_holds_yet(Load& jack, const EndReading<Scalar>& given,
                                   const HeldByWedge<Scalar>& held, const LoadCell<Scalar>& cell, Scalar dt,
                                   Scalar far_end) {
  constexpr Scalar surely = 4;
  const bool is_read = given.has_force && std::isfinite(given.force),
             is_stage = JumpGuard<Scalar>::is_stage(dt);
  if (!is_read) return jack.unlocked_early;
  if (jack.found_locked || 2 * far_end < jack.beside) return false;
  const Scalar noise = surely * cell.noise(), load = cell.up * held.load,
               least = load - cell.up * surely * held.deviation - noise,
               before = jack.pulls_surely ? larger(jack.raw, Scalar(0)) : load, come = before + load / 4;
  if (!jack.unlocked_early) {
    jack.most_pulled = given.force;
    jack.unlocked_early =
        before < least && given.force < least && given.force < (is_stage ? Scalar(0.75) * load : come);
    return jack.unlocked_early;
  }
  if (!is_stage && given.force > come) return true;
  const bool goes_down = given.force < Load::let_out * jack.most_pulled;
  jack.most_pulled = larger(jack.most_pulled, given.force);
  return given.force < load && !(goes_down && (is_stage || jack.most_pulled > least));
}

}  // namespace taut
