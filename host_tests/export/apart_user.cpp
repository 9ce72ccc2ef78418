// A source that uses them: it starts, follows, saves, goes on and asks. It prints all bits of what it is
// told.
#include <cstdio>

#include "apart.hpp"

static Linear linear;
static Leaning leaning;

template <class Estimator, class Model, class Prior>
static bool follow(Estimator& estimator, const Model& model, const Prior& prior, std::size_t cable) {
  if (!estimator.start(model, prior).status) return false;
  typename Estimator::ReadingsType readings;
  for (const float load : {3000.0F, 9000.0F, 6000.0F, 2000.0F, 7000.0F}) {
    readings.ends[static_cast<int>(cable)][1] = {true, false, load, 0};
    if (!estimator.advance(readings).status) return false;
    const auto [force, deviation] = estimator.estimate(0);
    if (!(force > 0 && deviation > 0)) return false;
    std::printf("%a %a %a\n", static_cast<double>(force), static_cast<double>(deviation),
                static_cast<double>(estimator.mu(0)));
  }
  const auto saved = estimator.save();
  return estimator.restore(model, prior, saved).ok() && estimator.estimate(0).force > 0;
}

static bool follow_alone() {
  static taut::Tracker<taut::Condensed<float, saddles::Capacity>> tracker;
  if (!tracker.start(saddles::condensed<float>).status) return false;
  taut::Sample<float, saddles::Capacity> sample;
  for (const float load : {9000.0F, 2000.0F, 7000.0F}) {
    sample.jack[0][1].force = load;
    if (!tracker.advance(sample).status) return false;
    std::printf("%a\n", static_cast<double>(tracker.tension(0)));
  }
  return true;
}

int main() {
  return follow_alone() && follow(linear, saddles::condensed<float>, saddles::prior<float>, 0) &&
                 follow(leaning, beam_string::condensed<float>, beam_string::prior<float>, 0)
             ? 0
             : 1;
}
