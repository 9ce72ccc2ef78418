// What device.cmake compiles: everything there is for a device, under macros of others.
#define abs(x) ((x) > 0 ? (x) : -(x))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define min(a, b) ((a) < (b) ? (a) : (b))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))

#include "taut/device.hpp"

#include "arch.hpp"
#include "beam_string.hpp"

static_assert(max(1, min(2, 3)) == 2 && round(1.6) == 2 && abs(-1) == 1, "the macros are those of before");

namespace arch = scene_2_arches_ber;

namespace linear {

using Model = taut::Condensed<float, arch::Capacity>;
taut::Tracker<Model> tracker;
taut::Estimator<Model, arch::unknowns, arch::reading_unknowns> estimator;
taut::JackPlanner<decltype(estimator)::TrackerType> planner;

bool follow(const decltype(estimator)::ReadingsType& readings) {
  if (!estimator.start(arch::condensed<float>, arch::prior<float>, {}, arch::strokes<float>).status)
    return false;
  const auto saved = estimator.save();
  if (!estimator.restore(arch::condensed<float>, arch::prior<float>, saved, {}, arch::strokes<float>))
    return false;
  return tracker.start(arch::condensed<float>).status && tracker.advance(readings.sample).status &&
         estimator.advance(readings).status && estimator.estimate(0).deviation > 0 &&
         taut::verify(tracker).worst() < 1;
}

bool plan(const decltype(planner)::Goal& goal) {
  return planner.begin(estimator, goal, 0, 1) && planner.find().count > 0;
}

}  // namespace linear

namespace second_order {

using Model = taut::SecondOrder<float, beam_string::Capacity>;
taut::Tracker<Model> tracker;
taut::Estimator<Model, beam_string::unknowns, beam_string::reading_unknowns> estimator;
taut::JackPlanner<decltype(estimator)::TrackerType> planner;

bool follow(const decltype(estimator)::ReadingsType& readings, taut::Response<float, Model::Capacity>& all) {
  if (!estimator.start(beam_string::condensed<float>, beam_string::prior<float>).status) return false;
  estimator.respond(all, &beam_string::struts<float>);
  return tracker.start(beam_string::condensed<float>).status && tracker.advance(readings.sample).status &&
         estimator.advance(readings).status && taut::verify(tracker).worst() < 1;
}

bool plan(const decltype(planner)::Goal& goal) {
  return planner.begin(estimator, goal, 0, 1) && planner.step(10) && planner.best().error < 1;
}

}  // namespace second_order
