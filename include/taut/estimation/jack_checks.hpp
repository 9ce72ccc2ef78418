// What is odd about a jack: strokes beside the elongation that is expected, the lift-off of a locked end.
#pragma once

#include <cmath>

#include "taut/estimation/estimator_parts.hpp"
#include "taut/estimation/prediction.hpp"

namespace taut {

/// What all jacks of cable `c` that pull have come out together at the best estimate of loads and unknowns,
/// and what it is uncertain by. Cost: that of predict_strokes(), and the square of the unknowns.
template <class Parts>
ExpectedExtension<typename Parts::Scalar> expected_extension(Parts& parts, int c) {
  using Scalar = typename Parts::Scalar;
  const auto& jacks = parts.jacks;
  const auto& belief = parts.filter.belief();
  auto& prediction = parts.filter.prediction();
  predict_strokes(parts.tracker, c, belief, jacks, prediction);
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

/// The strokes of all jacks of cable `c` that pull, if all were read: what they amount to together. The first
/// of these jacks has the check.
template <class Parts>
void check_strokes(Parts& parts, int c, const typename Parts::ReadingsType& readings) {
  using Scalar = typename Parts::Scalar;
  const auto pulls = parts.jacks.pulls(c);
  Scalar sum = 0, ends = 0;
  bool is_known = true;
  for (std::size_t end = 0; end < 2; ++end) {
    if (!pulls[end]) continue;
    const auto& given = readings.ends[c][end];
    if (!given.has_stroke) return;
    sum += given.stroke;
    ends += 1;
    // Where a load may have turned, or was not read, so is the extension.
    is_known &= !parts.jacks[parts.jacks.find(c, end)].is_in_doubt();
  }
  if (ends == 0) return;
  auto& elongation = parts.jacks[parts.jacks.find(c, pulls[0] ? 0 : 1)].elongation;
  if (!parts.is_cable_bedded(c)) return elongation.begin_leg();
  is_known &= std::isfinite(sum);
  auto limits = parts.limits;
  if (ends > 1) limits.stroke_sd *= std::sqrt(ends);
  if (is_known ? !elongation.take(sum, expected_extension(parts, c), limits) : !elongation.is_off()) return;
  for (std::size_t end = 0; end < 2; ++end)
    if (pulls[end]) parts.alarms.add(Parts::alarm_at(Alarm::Kind::elongation, Parts::EndType::of(c, end)));
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
/// expected_extension() a cable, of LoadFilter::take() a locked end.
template <class Parts>
void check_jacks(Parts& parts, const typename Parts::ReadingsType& readings) {
  for (int c = 0; c < parts.model().cables.size(); ++c) check_strokes(parts, c, readings);
  for (int k = 0; k < parts.jacks.size(); ++k) {
    const auto& given = parts.jacks.in(readings.ends, k);
    if (given.has_force && parts.jacks[k].locked) check_lift_off(parts, k, given.force);
  }
}

}  // namespace taut
