// What an instrument should read where the tracker is, and the derivatives of that number.
#pragma once

#include "taut/estimation/cable_end.hpp"
#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// A number that can be measured, linearized where the tracker is:
///     y = value + H (x - x_0) + by_jack (F - F_0)
/// with x the unknowns and F the forces of the jacks; x_0 and F_0 are those of the tracker.
template <class Scalar, int Parameters, int Jacks>
struct Prediction {
  Scalar value = 0;                   ///< [unit of y]
  FixedArray<Scalar, Parameters> H;   ///< by every unknown in use [unit of y / unit of the unknown]
  FixedArray<Scalar, Jacks> by_jack;  ///< by the force of every unlocked jack [unit of y / N]
  /// What mu that differs from joint to joint adds to the variance of y, the same in all readings of it.
  Scalar scatter = 0;
  bool has_zero = false;  ///< the instrument has an unknown zero of its own
  int zero = 0;           ///< its number
};

/// No unknown of another instrument matters to the reading of this one.
template <class BeliefType, class PredictionType>
void clear_further(const BeliefType& unknowns, PredictionType& prediction) {
  prediction.has_zero = false;
  for (int p = unknowns.carried(); p < unknowns.in_use(); ++p) prediction.H[p] = 0;
}

/// The reading is that much higher by the instrument's own zero, the unknown `p`, or -1 if it has none.
template <class PredictionType>
void depend_on_zero(int p, PredictionType& prediction) {
  if (p < 0) return;
  prediction.H[p] = 1;
  prediction.has_zero = true;
  prediction.zero = p;
}

/// The tension of a segment [N]. `unknowns` is a Belief, `jacks` are JackLoads. Always possible.
/// Cost: two multiplications an unknown and input.
template <class TrackerType, class BeliefType, class Jacks, class PredictionType>
void predict_tension(const TrackerType& tracker, int segment, const BeliefType& unknowns, const Jacks& jacks,
                     PredictionType& prediction) {
  prediction.value = tracker.tension(segment);
  clear_further(unknowns, prediction);
  for (int p = 0; p < unknowns.carried(); ++p) prediction.H[p] = tracker.sensitivity(p, segment);
  for (int k = 0; k < jacks.size(); ++k) prediction.by_jack[k] = tracker.slope(k, segment);
  jacks.count_once(prediction.by_jack, prediction.H);
}

/// What the strokes of all jacks of cable `c` that are not locked amount to together [m]: by how much it has
/// grown since the start. How two of them share that is left open where their forces differ by all friction
/// between them. The other arguments are the same. Cost: all that moves along the cables once an unknown and
/// jack.
template <class TrackerType, class BeliefType, class Jacks, class PredictionType>
void predict_strokes(const TrackerType& tracker, int c, const BeliefType& unknowns, const Jacks& jacks,
                     PredictionType& prediction) {
  using Scalar = typename TrackerType::Scalar;
  const auto pulls = jacks.pulls(c);
  const auto of = [&](const auto& moving) {
    const auto& extension = moving.extension[c];
    return static_cast<Scalar>(pulls[0] && pulls[1] ? extension[0] + extension[1]
                                                    : extension[pulls[0] ? 0 : 1]);
  };
  prediction.value = of(tracker.slip_state());
  clear_further(unknowns, prediction);
  for (int p = 0; p < unknowns.carried(); ++p) prediction.H[p] = of(tracker.slip_sensitivity(p));
  for (int k = 0; k < jacks.size(); ++k)
    prediction.by_jack[k] = of(tracker.slip_slope(jacks.end(k).cable(), jacks.end(k).end));
  jacks.count_once(prediction.by_jack, prediction.H);
}

/// The axial force of a strut [N], tension positive. `rows` are the CondensedStruts of the scene, `strut` has
/// the number of the scene; the other arguments as for strokes. Cost: all that moves along the cables and a
/// sum over the segments once an unknown and jack.
template <class TrackerType, class StrutRows, class BeliefType, class Jacks, class PredictionType>
void predict_strut(const TrackerType& tracker, const StrutRows& rows, int strut, const BeliefType& unknowns,
                   const Jacks& jacks, PredictionType& prediction) {
  using Scalar = typename TrackerType::Scalar;
  const auto& model = tracker.model();
  const auto carried = [&](const auto& elongations) { return change_of(rows, strut, model, elongations); };
  prediction.value =
      static_cast<Scalar>(number_of(rows, strut, model, tracker.loads(), tracker.elongations()));
  clear_further(unknowns, prediction);
  for (int p = 0; p < unknowns.carried(); ++p)
    prediction.H[p] = static_cast<Scalar>(carried(tracker.elongations_by(tracker.slip_sensitivity(p))));
  for (int k = 0; k < jacks.size(); ++k)
    prediction.by_jack[k] = static_cast<Scalar>(
        carried(tracker.elongations_by(tracker.slip_slope(jacks.end(k).cable(), jacks.end(k).end))));
  jacks.count_once(prediction.by_jack, prediction.H);
}

}  // namespace taut
