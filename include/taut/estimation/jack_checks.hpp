// What is odd about a jack: strokes beside the elongation that is expected, the lift-off of a locked end.
#pragma once

#include <cmath>

#include "taut/estimation/estimator_parts.hpp"
#include "taut/estimation/prediction.hpp"

namespace taut {

/// The extension of jack `k` at the best estimate of loads and unknowns, and what it is uncertain by. Cost:
/// that of predict_stroke(), and the square of the unknowns.
template <class Parts>
ExpectedExtension<typename Parts::Scalar> expected_extension(Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& jacks = parts.jacks;
  const auto& belief = parts.filter.belief();
  auto& prediction = parts.filter.prediction();
  predict_stroke(parts.tracker, jacks.end(k), belief, jacks, prediction);
  typename Parts::FilterType::JackReadings best;
  ExpectedExtension<Scalar> extension;
  for (int i = 0; i < jacks.size(); ++i) {
    best.add({jacks[i].beyond(), Scalar(0)});
    const Scalar part = jacks[i].locked ? Scalar(0) : prediction.by_jack[i] * jacks[i].at.sd;
    extension.of_loads += part * part;
  }
  const Expected<Scalar> expected = belief.expect(prediction, best, Scalar(0));
  extension.value = expected.value;
  extension.of_unknowns = expected.variance;
  for (int p = 0; p < belief.friction(); ++p) extension.by_friction += prediction.H[p];
  return extension;
}

template <class Parts>
void check_stroke(Parts& parts, int k, typename Parts::Scalar stroke) {
  auto& jack = parts.jacks[k];
  if (jack.locked) return;
  if (!parts.is_bedded(k)) return jack.elongation.begin_leg();
  // Where a load may have turned, or was not read, so is the extension.
  const bool is_known = !jack.is_in_doubt() && std::isfinite(stroke);
  if (is_known ? jack.elongation.take(stroke, expected_extension(parts, k), parts.limits)
               : jack.elongation.is_off())
    parts.alarms.add(Parts::alarm_at(Alarm::Kind::elongation, parts.jacks.end(k)));
}

template <class Parts>
void check_lift_off(Parts& parts, int k, typename Parts::Scalar reading) {
  const int segment = parts.end_segment(k);
  const auto up = parts.cell(k).up;
  if (parts.jacks[k].lifts_off(reading, parts.most_force(k), up * parts.force(segment),
                               [&] { return up * parts.estimate(segment).deviation; }))
    parts.alarms.add(Parts::alarm_at(Alarm::Kind::lift_off, parts.jacks.end(k)));
}

/// Strokes against the elongation that is expected, and the load cells of locked ends. Cost: that of
/// expected_extension() a stroke, of LoadFilter::take() a locked end.
template <class Parts>
void check_jacks(Parts& parts, const typename Parts::ReadingsType& readings) {
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& given = parts.jacks.in(readings.ends, k);
    if (given.has_stroke) check_stroke(parts, k, given.stroke);
    if (given.has_force && parts.jacks[k].locked) check_lift_off(parts, k, given.force);
  }
}

}  // namespace taut
