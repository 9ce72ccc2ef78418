// Instruments that are read one by one beside a row: gauges on struts, strokes, measured forces of segments.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/learning.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/prediction.hpp"

namespace taut {

/// What is predicted of the reading of a strut's gauge, a stroke, or a segment: for take_measurement() and
/// take_gauge(), a function of the prediction that is made anew after every relinearization.
template <class Parts>
auto foretell_strut(const Parts& parts, const typename Parts::Condensed::Struts& rows, int strut) {
  return [&parts, &rows, strut](auto& prediction) {
    predict_strut(parts.tracker, rows, strut, parts.filter.belief(), parts.jacks.ends(), prediction);
  };
}
template <class Parts>
auto foretell_stroke(const Parts& parts, int k) {
  return [&parts, k](auto& prediction) {
    predict_stroke(parts.tracker, parts.jacks.end(k), parts.filter.belief(), parts.jacks.ends(), prediction);
  };
}
template <class Parts>
auto foretell_segment(const Parts& parts, int segment) {
  return [&parts, segment](auto& prediction) {
    predict_tension(parts.tracker, segment, parts.filter.belief(), parts.jacks.ends(), prediction);
  };
}

/// A reading with the standard deviation `sd` > 0 of an instrument without unknowns of its own. Cost: an
/// update, with at most four calls of Tracker::adjust().
template <class Parts, class Predict>
void take_measurement(Parts& parts, const Predict& predict, typename Parts::Scalar reading,
                      typename Parts::Scalar sd, const Alarm& contradiction) {
  using Scalar = typename Parts::Scalar;
  if (!(sd > 0) || !parts.can_learn()) return;
  auto& filter = parts.filter;
  wait_for_none(parts);
  predict(filter.prediction());
  if (filter.is_informative(parts.tracker, contradiction.cable, sd))
    note(
        parts,
        filter.update(parts.tracker, predict, parts.jacks.readings(filter.prior()), {reading, sd, Scalar(0)}),
        contradiction);
  look_ahead(parts);
}

/// Gauges learn from a row how far the jacks have gone, and which cables slide. Cost: a pass over the joints.
template <class Parts>
void follow_gauges(Parts& parts, const Corners<typename Parts::Scalar>& corners, typename Parts::Scalar dt) {
  typename Parts::Scalar load = 0, best = 0;
  for (int k = 0; k < parts.jacks.size(); ++k) {
    load += parts.jacks[k].driven.force;
    best += parts.jacks[k].locked ? parts.jacks[k].driven.force : parts.jacks[k].at.load;
  }
  if (corners.locks) parts.gauges.forget_marks();
  parts.gauges.begin_row(load, best, dt);
  for (int c = 0; c < parts.model().cables.size(); ++c)
    parts.gauges.follow_sliding(c, parts.filter.slides_throughout(parts.tracker, c));
}

/// Whether all cables that prediction() depends on, read with `sd` at `cable`, surely slide throughout. Cost:
/// a pass over the joints.
template <class Parts>
bool is_sure(const Parts& parts, int cable, typename Parts::Scalar sd) {
  for (int c = 0; c < parts.model().cables.size(); ++c)
    if (parts.filter.matters(parts.tracker, c, cable, sd) &&
        !parts.gauges.surely_slides(c, parts.filter.relative_deviation(parts.tracker, c)))
      return false;
  return true;
}

/// A reading of an instrument with unknowns of its own. `needs_sliding`: it counts only while cables surely
/// slide, for what lies behind joints that stick has no derivative to go by. The extension of a jack has one
/// all the way back from a turn, as joint after joint begins to slide. Cost: that of take_measurement().
template <class Parts, class Predict>
void take_gauge(Parts& parts, const Predict& predict, typename Parts::Scalar reading, Gauge gauge,
                const Alarm& contradiction, bool needs_sliding = true) {
  using Scalar = typename Parts::Scalar;
  auto& gauges = parts.gauges;
  auto& filter = parts.filter;
  if (!gauges.has(gauge) || !std::isfinite(reading)) return;
  gauges.follow_noise(gauge, reading);
  if (!parts.can_learn() || !gauges.is_due(gauge)) return;
  const auto predict_reading = [&](auto& prediction) {
    predict(prediction);
    gauges.depend(gauge, prediction);
  };
  const Scalar sd = gauges.sd(gauge);
  wait_for_none(parts);
  predict_reading(filter.prediction());
  if (needs_sliding && !is_sure(parts, contradiction.cable, sd)) return look_ahead(parts);
  const auto jacks = parts.jacks.readings(filter.prior());
  if (gauges.lacks_mark(gauge)) {
    const Expected<Scalar> expected = filter.belief().expect(filter.prediction(), jacks, sd);
    gauges.set_mark(gauge, reading - expected.value);
    filter.renew(gauges.unknowns(gauge).zero, Parts::GaugesType::very_unknown * std::sqrt(expected.variance));
  }
  gauges.count(gauge);
  note(parts,
       filter.update(parts.tracker, predict_reading, jacks, {reading - gauges.mark(gauge), sd, Scalar(0)}),
       contradiction);
  look_ahead(parts);
}

}  // namespace taut
