// A source that uses them: it starts, follows, saves, goes on and asks.
#include "apart.hpp"

static Linear linear;
static Leaning leaning;

template <class Estimator, class Model, class Prior>
static bool follow(Estimator& estimator, const Model& model, const Prior& prior, std::size_t cable) {
  if (!estimator.start(model, prior).status) return false;
  typename Estimator::ReadingsType readings;
  readings.ends[static_cast<int>(cable)][1] = {true, false, 3000, 0};
  if (!estimator.advance(readings).status) return false;
  const auto [force, deviation] = estimator.estimate(0);
  if (!(force > 0 && deviation > 0)) return false;
  const auto saved = estimator.save();
  return estimator.restore(model, prior, saved).ok() && estimator.estimate(0).force == force;
}

int main() {
  return follow(linear, saddles::condensed<float>, saddles::prior<float>, 0) &&
                 follow(leaning, beam_string::condensed<float>, beam_string::prior<float>, 0)
             ? 0
             : 1;
}
