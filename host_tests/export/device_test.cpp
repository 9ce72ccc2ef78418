// Calls in the wrong order, on what a device holds.
#include "taut/device.hpp"

#include <doctest/doctest.h>

#include "arch.hpp"
#include "beam_string.hpp"

namespace arch = scene_2_arches_ber;
using taut::Code;

namespace {

template <class Model, int Unknowns, int Further>
void check_order(const Model& condensed, const typename Model::Struts& struts) {
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
  CHECK(estimator.force(0) == 0);
  CHECK(tracker.tension(0) == 0);
  REQUIRE(tracker.start(condensed).status.ok());
  readings.sample.jack[0] = {{{1e4F, false}, {1e4F, false}}};
  CHECK(tracker.advance(readings.sample).status.ok());
}

}  // namespace

TEST_CASE("a row before start() is refused, and nothing has happened") {
  check_order<taut::Condensed<float, arch::Capacity>, arch::unknowns, arch::reading_unknowns>(
      arch::condensed<float>, arch::struts<float>);
  check_order<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
              beam_string::reading_unknowns>(beam_string::condensed<float>, beam_string::struts<float>);
}
