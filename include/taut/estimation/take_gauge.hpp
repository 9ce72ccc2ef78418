// Instruments that are read one by one beside a row: gauges on struts, strokes, measured forces of segments.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/learning.hpp"
#include "taut/estimation/leg.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/prediction.hpp"

namespace taut {

/// What is predicted of the reading of a strut's gauge, a stroke, or a segment: for take_measurement() and
/// take_gauge(), a function of the prediction that is made anew after every relinearization.
template <class Parts>
auto foretell_strut(const Parts& parts, const typename Parts::Condensed::Struts& rows, int strut) {
  return [&parts, &rows, strut](auto& prediction) {
    predict_strut(parts.tracker, rows, strut, parts.filter.belief(), parts.jacks, prediction);
    prediction.scatter = parts.filter.most_scatter(prediction.H);
  };
}
template <class Parts>
auto foretell_stroke(const Parts& parts, int k) {
  return [&parts, k](auto& prediction) {
    const auto& end = parts.jacks.end(k);
    predict_stroke(parts.tracker, end, parts.filter.belief(), parts.jacks, prediction);
    // A stroke has friction on the ways to all segments.
    const auto& cable = parts.model().cables[end.cable()];
    const int far = cable.end_segment(1 - end.end);
    prediction.scatter = parts.filter.scatter_by(prediction.H, far,
                                                 parts.filter.mean_scatter(end.cable(), far, cable.joints()));
  };
}
template <class Parts>
auto foretell_segment(const Parts& parts, int segment) {
  return [&parts, segment](auto& prediction) {
    predict_tension(parts.tracker, segment, parts.filter.belief(), parts.jacks, prediction);
    prediction.scatter = parts.filter.scatter_by(prediction.H, segment, parts.filter.scatter(segment));
  };
}

/// A reading with the standard deviation `sd` > 0 of an instrument without unknowns of its own. Cost: an
/// update, with at most four calls of Tracker::adjust().
template <class Parts, class Predict>
void take_measurement(Parts& parts, const Predict& predict, typename Parts::Scalar reading,
                      typename Parts::Scalar sd, const Alarm& contradiction) {
  using Scalar = typename Parts::Scalar;
  if (!(sd > 0) || !parts.can_learn(contradiction.cable)) return;
  auto& filter = parts.filter;
  go_back(parts);
  wait_for_none(parts);
  predict(filter.prediction());
  const auto jacks = parts.jacks.readings(filter.prior());
  const Scalar counted = filter.counted_deviation(sd, filter.prediction().scatter, jacks);
  const auto slides = [&](int c) {
    return !parts.is_beyond[c] && filter.slides_throughout(parts.tracker, c);
  };
  if (counted > 0 && filter.is_informative(parts.tracker, contradiction.cable, sd, slides))
    note(parts, filter.update(parts.tracker, predict, jacks, {reading, counted, Scalar(0)}), contradiction);
  look_ahead(parts);
}

/// Gauges learn from a row how far the jacks have gone. Cost: a few operations a jack and gauge.
template <class Parts>
void follow_gauges(Parts& parts, const Corners<typename Parts::Scalar>& corners, typename Parts::Scalar dt) {
  typename Parts::Scalar best = 0;
  for (int k = 0; k < parts.jacks.size(); ++k)
    best += parts.jacks[k].locked ? parts.jacks[k].driven.force : parts.jacks[k].at.load;
  if (corners.locks) parts.gauges.forget_marks();
  parts.gauges.begin_row(parts.sum_of_loads(), best, dt);
}

/// Readings of forces count only while cables surely slide, and where the loads are confirmed to have come:
/// what lies behind joints that stick has no derivative to go by.
template <class Parts>
struct WhileSliding {
  Parts& parts;
  bool can_learn(int cable) const { return parts.can_learn(cable); }
  /// Before it is predicted: to where it counts.
  void begin() const { go_back(parts); }
  bool is_sure(int cable, typename Parts::Scalar sd) const {
    return parts.filter.is_informative(parts.tracker, cable, sd, [this](int c) { return parts.teaches(c); });
  }
  template <class Predict>
  Update update(const Predict& predict, const typename Parts::JacksType::Readings& jacks,
                const Measured<typename Parts::Scalar>& measured) const {
    return parts.filter.update(parts.tracker, predict, jacks, measured);
  }
};

/// Strokes count all the way back from a turn, as joint after joint begins to slide: there the extension has
/// a derivative, which each of them changes.
template <class Parts>
struct AlongLeg {
  Parts& parts;
  bool can_learn(int cable) const { return parts.can_teach(cable); }
  void begin() const {}
  bool is_sure(int, typename Parts::Scalar) const { return true; }
  template <class Predict>
  Update update(const Predict& predict, const typename Parts::JacksType::Readings& jacks,
                const Measured<typename Parts::Scalar>& measured) const {
    const auto& belief = parts.filter.belief();
    const auto comes_closer = [&] {
      return (belief.is_nonlinear() || belief.moves_friction()) && relinearize(parts, belief.updated_mean());
    };
    return parts.filter.update_by(comes_closer, predict, jacks, measured);
  }
};

/// A reading of an instrument with unknowns of its own, which counts by `Rule`. Cost: that of
/// take_measurement(), or AlongLeg, four times that of relinearize().
template <template <class> class Rule, class Parts, class Predict>
void take_gauge(Parts& parts, const Predict& predict, typename Parts::Scalar reading, Gauge gauge,
                const Alarm& contradiction) {
  using Scalar = typename Parts::Scalar;
  auto& gauges = parts.gauges;
  auto& filter = parts.filter;
  const Rule<Parts> rule{parts};
  if (!gauges.has(gauge) || !std::isfinite(reading)) return;
  gauges.follow_noise(gauge, reading);
  if (!rule.can_learn(contradiction.cable) || !gauges.is_due(gauge)) return;
  typename Parts::JacksType::Readings jacks;
  const auto predict_reading = [&](auto& prediction) {
    predict(prediction);
    gauges.depend(gauge, prediction);
    // Where the tracker was driven to may have changed.
    jacks = parts.jacks.readings(filter.prior());
  };
  const Scalar sd = gauges.sd(gauge);
  rule.begin();
  wait_for_none(parts);
  predict_reading(filter.prediction());
  if (!rule.is_sure(contradiction.cable, sd)) return look_ahead(parts);
  if (gauges.lacks_mark(gauge)) {
    const Expected<Scalar> expected = filter.belief().expect(filter.prediction(), jacks, sd);
    gauges.set_mark(gauge, reading - expected.value);
    filter.renew(gauges.unknowns(gauge).zero, Parts::GaugesType::very_unknown * std::sqrt(expected.variance));
  }
  gauges.count(gauge);
  const Scalar counted = filter.counted_deviation(sd, filter.prediction().scatter, jacks);
  if (counted > 0)
    note(parts, rule.update(predict_reading, jacks, {reading - gauges.mark(gauge), counted, Scalar(0)}),
         contradiction);
  look_ahead(parts);
}

}  // namespace taut
