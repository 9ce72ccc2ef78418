// Instruments that are read one by one beside a row: gauges on struts, strokes, measured forces of segments.
#pragma once

#include <cmath>
#include <cstddef>

#include "taut/estimation/learning.hpp"
#include "taut/estimation/leg.hpp"
#include "taut/estimation/look_ahead.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/estimation/row_strokes.hpp"

namespace taut {

/// What is predicted of the reading of a strut's gauge, of strokes, or of a segment: for take_measurement()
/// and take_gauge(), a function of the prediction that is made anew after every relinearization.
template <class Parts>
auto foretell_strut(const Parts& parts, const typename Parts::Condensed::Struts& rows, int strut) {
  return [&parts, &rows, strut](auto& prediction) {
    predict_strut(parts.tracker, rows, strut, parts.filter.belief(), parts.jacks, prediction);
    prediction.scatter = parts.filter.most_scatter(prediction.H);
  };
}
template <class Parts>
auto foretell_strokes(const Parts& parts, int c) {
  return [&parts, c](auto& prediction) {
    predict_strokes(parts.tracker, c, parts.filter.belief(), parts.jacks, prediction);
    // A stroke has friction on the ways to all segments.
    const auto& cable = parts.model().cables[c];
    const int far = cable.end_segment(parts.jacks.pulls(c)[0] ? 1 : 0);
    prediction.scatter =
        parts.filter.scatter_by(prediction.H, far, parts.filter.mean_scatter(c, far, cable.joints()));
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
Update take_measurement(Parts& parts, const Predict& predict, typename Parts::Scalar reading,
                        typename Parts::Scalar sd, const Alarm& contradiction) {
  using Scalar = typename Parts::Scalar;
  if (!(sd > 0) || !parts.can_learn(contradiction.cable)) return Update::waits;
  auto& filter = parts.filter;
  go_back(parts);
  wait_for_none(parts);
  predict(filter.prediction());
  const auto jacks = parts.jacks.readings(filter.prior());
  const Scalar counted = filter.counted_deviation(sd, filter.prediction().scatter, jacks);
  const auto slides = [&](int c) {
    return !parts.is_beyond[c] && filter.slides_throughout(parts.tracker, c);
  };
  Update update = Update::waits;
  if (counted > 0 && filter.is_informative(parts.tracker, contradiction.cable, sd, slides)) {
    update = filter.update(parts.tracker, predict, jacks, {reading, counted, Scalar(0)});
    note(parts, update, contradiction);
  }
  look_ahead(parts);
  return update;
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
    return parts.filter.update_by(parts.tracker, comes_closer, predict, jacks, measured);
  }
};

/// What was read of an instrument with unknowns of its own.
template <class Scalar>
struct GaugeReading {
  Gauge gauge;
  Scalar reading = 0;
};

/// Readings of instruments with unknowns of their own whose sum is predicted, which count by `Rule`. What
/// scales them is common to all: the gain of the first. Cost: that of take_measurement(), or AlongLeg, four
/// times that of relinearize().
template <template <class> class Rule, class Parts, class Predict, int N>
Update take_gauges(Parts& parts, const Predict& predict,
                   const FixedList<GaugeReading<typename Parts::Scalar>, N>& readings,
                   const Alarm& contradiction) {
  using Scalar = typename Parts::Scalar;
  auto& gauges = parts.gauges;
  // So that the compiler knows where there can be none.
  if (gauges.size() == 0) return Update::waits;
  auto& filter = parts.filter;
  const Rule<Parts> rule{parts};
  const Gauge first = readings[0].gauge;
  for (const auto& [gauge, reading] : readings)
    if (!gauges.has(gauge) || !std::isfinite(reading)) return Update::waits;
  Scalar variance = 0;
  bool lacks_mark = false;
  for (const auto& [gauge, reading] : readings) {
    gauges.follow_noise(gauge, reading);
    variance += gauges.sd(gauge) * gauges.sd(gauge);
    lacks_mark |= gauges.lacks_mark(gauge);
  }
  if (!rule.can_learn(contradiction.cable) || !(lacks_mark || gauges.is_due(first))) return Update::waits;
  typename Parts::JacksType::Readings jacks;
  const auto predict_readings = [&](auto& prediction) {
    predict(prediction);
    gauges.depend_on_gain(first, prediction);
    for (const auto& [gauge, reading] : readings) gauges.depend_on_zero(gauge, prediction);
    // Where the tracker was driven to may have changed.
    jacks = parts.jacks.readings(filter.prior());
  };
  // Beyond all marks.
  const auto read = [&] {
    Scalar sum = 0;
    for (const auto& [gauge, reading] : readings) sum += reading - gauges.mark(gauge);
    return sum;
  };
  const Scalar sd = std::sqrt(variance);
  rule.begin();
  wait_for_none(parts);
  predict_readings(filter.prediction());
  if (!rule.is_sure(contradiction.cable, sd)) {
    look_ahead(parts);
    return Update::waits;
  }
  if (lacks_mark) {
    const Expected<Scalar> expected = filter.belief().expect(filter.prediction(), jacks, sd);
    Gauge marked;
    for (const auto& [gauge, reading] : readings) {
      if (!gauges.lacks_mark(gauge)) continue;
      gauges.set_mark(gauge, 0);
      filter.renew(gauges.unknowns(gauge).zero, 0);
      marked = gauge;
    }
    // One of them has all that is off.
    gauges.set_mark(marked, read() - expected.value);
    filter.renew(gauges.unknowns(marked).zero,
                 Parts::GaugesType::very_unknown * std::sqrt(expected.variance));
  }
  for (const auto& [gauge, reading] : readings) gauges.count(gauge);
  const Scalar counted = filter.counted_deviation(sd, filter.prediction().scatter, jacks);
  Update update = Update::waits;
  if (counted > 0) {
    update = rule.update(predict_readings, jacks, {read(), counted, Scalar(0)});
    note(parts, update, contradiction);
  }
  look_ahead(parts);
  return update;
}
template <template <class> class Rule, class Parts, class Predict>
void take_gauge(Parts& parts, const Predict& predict, typename Parts::Scalar reading, Gauge gauge,
                const Alarm& contradiction) {
  if (parts.gauges.has(gauge) && std::isfinite(reading) && !parts.gauges.undo_lag(gauge, reading)) return;
  FixedList<GaugeReading<typename Parts::Scalar>, 1> readings;
  readings.add({gauge, reading});
  static_cast<void>(take_gauges<Rule>(parts, predict, readings, contradiction));
}

/// The stroke of the jack at an end counts as soon as that of the other jack of its cable was read too, if
/// both pull: take(strokes, alarm) takes them into account. Cost: that of take().
template <class Parts, class Take>
void take_with_other(Parts& parts, int c, std::size_t end, const StrokeReading<typename Parts::Scalar>& read,
                     const Take& take) {
  const auto pulls = parts.jacks.pulls(c);
  if (end > 1 || !pulls[end]) return;
  const auto strokes = parts.strokes.take(c, end, read, pulls);
  if (strokes.empty()) return;
  const auto alarm_at = [&](std::size_t place) {
    return Parts::alarm_at(Alarm::Kind::elongation, Parts::EndType::of(c, place));
  };
  if (take(strokes, alarm_at(end)) == Update::contradiction && strokes.size() > 1)
    parts.alarms.add(alarm_at(1 - end));
}

/// The stroke of a jack, read with the standard deviation `sd` > 0, in which that of E A is. Cost: that of
/// take_measurement().
template <class Parts>
void take_stroke(Parts& parts, int c, std::size_t end, typename Parts::Scalar reading,
                 typename Parts::Scalar sd) {
  take_with_other(parts, c, end, {reading, sd, {}, false}, [&](const auto& strokes, const Alarm& alarm) {
    typename Parts::Scalar sum = 0, sd_of_sum = 0;
    for (const auto& stroke : strokes) {
      sum += stroke.reading;
      // They have the same E A.
      sd_of_sum += stroke.sd;
    }
    return take_measurement(parts, foretell_strokes(parts, c), sum, sd_of_sum, alarm);
  });
}

/// The stroke of a jack, read by an instrument with unknowns of its own. Cost: that of take_gauges().
template <class Parts>
void take_stroke(Parts& parts, int c, std::size_t end, typename Parts::Scalar reading, Gauge gauge) {
  take_with_other(parts, c, end, {reading, 0, gauge, true}, [&](const auto& strokes, const Alarm& alarm) {
    FixedList<GaugeReading<typename Parts::Scalar>, Parts::Strokes::All::capacity()> readings;
    for (const auto& stroke : strokes) {
      // A mark is made once slack has been taken out.
      if (parts.gauges.has(stroke.gauge) && parts.gauges.lacks_mark(stroke.gauge) &&
          !parts.is_cable_bedded(c))
        return Update::waits;
      readings.add({stroke.gauge, stroke.reading});
    }
    return take_gauges<AlongLeg>(parts, foretell_strokes(parts, c), readings, alarm);
  });
}

}  // namespace taut
