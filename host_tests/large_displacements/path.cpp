#include "large_displacements/path.hpp"

#include <algorithm>

namespace large_displacements {
namespace {

constexpr double smallest_step = 1e-8;  // of a row
constexpr int most_tries = 600;

Inputs between(const Inputs& from, const Inputs& to, double part) {
  Inputs found = to;
  const auto mix = [&](double a, double b) { return part < 1 ? a + part * (b - a) : b; };
  for (std::size_t i = 0; i < to.factors.size(); ++i) found.factors[i] = mix(from.factors[i], to.factors[i]);
  found.prestrain = mix(from.prestrain, to.prestrain);
  for (std::size_t c = 0; c < to.ends.size(); ++c)
    for (int end : {0, 1}) found.ends[c][end].value = mix(from.ends[c][end].value, to.ends[c][end].value);
  return found;
}

}  // namespace

Path::Path(const Model& model, int steps_a_row) : equilibrium(model), steps(steps_a_row) {
  state = equilibrium.rest();
  inputs = equilibrium.no_inputs();
  Inputs grown = inputs;
  grown.prestrain = 1;
  started.whole = true;
  for (const Cable& cable : model.cables)
    for (const double prestrain : cable.prestrain)
      if (prestrain != 0) {
        started = go(grown);
        return;
      }
}

Reached Path::go(const Inputs& target) {
  const State before = state;
  const Inputs from = inputs;
  const Reached reached = go_in_steps(target);
  if (!reached || stability() > -1e-12) return reached;
  // Two eigenvalues have become negative at once.
  state = before;
  inputs = from;
  equilibrium.always_check_stability = true;
  const Reached checked = go_in_steps(target);
  equilibrium.always_check_stability = false;
  return checked;
}

Reached Path::go_in_steps(const Inputs& target) {
  const Inputs from = inputs;
  Reached reached;
  double step = 1.0 / steps;
  int good = 0;
  for (int tries = 0; tries < most_tries && reached.part < 1; ++tries) {
    double next = reached.part + step;
    if (next > 1 - 1e-9) next = 1;
    const Inputs there = between(from, target, next);
    if (equilibrium.step(state, there)) {
      reached.part = next;
      inputs = there;
      if (++good >= 3) step = std::min(1.0 / steps, 2 * step);
    } else {
      reached.refused = next;
      good = 0;
      step /= 2;
      if (step < smallest_step) break;
    }
  }
  reached.whole = reached.part >= 1;
  return reached;
}

Reached Path::advance(const Row& row) {
  Inputs target = inputs;
  target.factors = row.factors;
  const auto& cables = equilibrium.model().cables;
  for (int c = 0; c < static_cast<int>(cables.size()); ++c)
    for (int end : {0, 1}) {
      if (!cables[c].jacked[end]) continue;
      Inputs::End &now = inputs.ends[c][end], &then = target.ends[c][end];
      const Row::End& given = row.jacks[c][end];
      if (given.locked) {
        if (now.jacked) {
          now.value = extension(c, end);
          then.value = now.value - cables[c].seating;
        }
        now.jacked = then.jacked = false;
      } else {
        if (!now.jacked) now.value = T(c, end == 0 ? 0 : cables[c].segments() - 1);
        now.jacked = then.jacked = true;
        then.value = given.force;
      }
    }
  return go(target);
}

}  // namespace large_displacements
