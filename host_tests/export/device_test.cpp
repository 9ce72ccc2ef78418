// Calls in the wrong order, on what a device holds.
#include "taut/device.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "arch.hpp"
#include "beam_string.hpp"

namespace device_test {

namespace arch = scene_2_arches_ber;
using taut::Code;

namespace {

template <class Model, int Unknowns, int Further, class FrictionPrior, class Gauges>
void check_order(const Model& condensed, const typename Model::Struts& struts, const FrictionPrior& prior,
                 const Gauges& gauges) {
  using Cap = typename Model::Capacity;
  static taut::Estimator<Model, Unknowns, Further> estimator;
  static taut::Tracker<Model> tracker;
  taut::Readings<float, Cap> readings;
  readings.sample.factor.fill(1);
  readings.ends[0][1].has_force = true;
  readings.ends[0][1].force = 1e4F;
  for (const bool locked : {false, true}) {
    readings.sample.jack[0][1].locked = locked;
    CHECK(estimator.advance(readings).status.code == Code::not_started);
    CHECK(estimator.come_down(readings).status.code == Code::not_started);
    CHECK(tracker.advance(readings.sample).status.code == Code::not_started);
  }
  estimator.take_segment(0, 1e4F, taut::Gauge{0});
  estimator.take_stroke(0, 1, 0.1F, taut::Gauge{0});
  estimator.take_strut(struts, 0, 1e4F, taut::Gauge{0});
  estimator.take_strut(struts, 0, 1e4F, 100.0F);
  CHECK(estimator.unknowns() == 0);
  CHECK(estimator.alarms().empty());
  // What has no status says zero, and responses are left as they are.
  const auto force = estimator.estimate(0), strut = estimator.estimate_strut(struts, 0);
  CHECK(force.force + force.deviation + strut.force + strut.deviation == 0);
  CHECK(estimator.mu(0) + estimator.mu_deviation(0) + estimator.peak(0) + estimator.load(0, 1).load == 0);
  CHECK(tracker.tension(0) + tracker.peak() + tracker.friction_used(0) + tracker.bend_change(0) == 0);
  CHECK(tracker.slope(0, 0) + tracker.extension_slope(0, 1) == 0);
  CHECK(tracker.rho(0) == 0);
  CHECK(tracker.slip_state().slip[0] + tracker.slip_state().extension[0][1] == 0);
  CHECK(tracker.motion(0) == taut::JointState::stick);
  CHECK(taut::verify(tracker).worst() == 0);
  taut::Response<float, Cap> response;
  response.tension[0] = 7;
  tracker.respond(response);
  estimator.respond(response, &struts);
  CHECK(response.tension[0] == 7);
  CHECK_FALSE(tracker.is_started());
  // What is saved then is nothing to go on from.
  CHECK(tracker.restore(condensed, tracker.save()).code == Code::bad_sample);
  CHECK(estimator.restore(condensed, prior, estimator.save(), {}, gauges).code == Code::bad_sample);
  CHECK(tracker.advance(readings.sample).status.code == Code::not_started);
  CHECK(estimator.advance(readings).status.code == Code::not_started);
  // Nor is anything left of what was before, where start() finds no room.
  REQUIRE(estimator.start(condensed, prior, {}, gauges).status.ok());
  const auto crowded = std::vector<taut::LoadCell<float>>(Further + 1, taut::LoadCell<float>{});
  CHECK(estimator.start(condensed, prior, {}, crowded).status.code == Code::capacity_exceeded);
  CHECK(estimator.advance(readings).status.code == Code::not_started);
  CHECK(estimator.estimate(0).deviation == 0);
  REQUIRE(tracker.start(condensed).status.ok());
  CHECK(tracker.is_started());
  readings.sample.jack[0] = {{{1e4F, false}, {1e4F, false}}};
  CHECK(tracker.advance(readings.sample).status.ok());
}

}  // namespace

TEST_CASE("before start() rows and saved states are refused, and everything else says zero") {
  check_order<taut::Condensed<float, arch::Capacity>, arch::unknowns, arch::reading_unknowns>(
      arch::condensed<float>, arch::struts<float>, arch::prior<float>, arch::strokes<float>);
  check_order<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
              beam_string::reading_unknowns>(beam_string::condensed<float>, beam_string::struts<float>,
                                             beam_string::prior<float>,
                                             taut::FixedList<taut::LoadCell<float>, 0>());
}

}  // namespace device_test
