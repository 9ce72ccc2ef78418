// What the forces of a cable would be had a wedge been drawn in further, where a derivative does not tell.
#pragma once

#include "taut/estimation/estimator_unknowns.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// After the wedge of an end was drawn in, by how much is not known: how far joints slide back is not in
/// proportion to that. Draws it in two standard deviations further, and comes back; with as much less, forces
/// are at most where they turned. Cost: that of a path, and of Tracker::save() and restore().
template <class Parts>
void try_other_seating(Parts& parts, int k) {
  using Scalar = typename Parts::Scalar;
  const auto& at = parts.jacks.end(k);
  const auto& cable = parts.model().cables[at.cable()];
  const int p = parts.jacks[k].seating, end = cable.first_segment + cable.segments();
  const Scalar sd = parts.filter.prior().seating_sd[at.cable()], far = Scalar(parts.turned.far) * sd,
               seating = static_cast<Scalar>(cable.seating);
  if (p < 0 || !(sd > 0)) return;
  // Where the tracker was before is known no longer.
  auto& here = parts.confirmed.tracker = parts.tracker.save();
  const auto progress = parts.tracker.draw_in_more(at.cable(), at.end, far);
  const bool is_there = progress.status.ok() && !(progress.fraction < 1);
  FixedArray<Scalar, Parts::Cap::segments> further;
  for (int i = cable.first_segment; i < end; ++i) further[i] = parts.tracker.tension(i);
  static_cast<void>(put_back(parts, here).ok());
  for (int i = cable.first_segment; i < end; ++i) {
    const Scalar force = parts.tracker.tension(i), less = larger(far, seating),
                 back = parts.turned.leader_of(i) < 0 ? Scalar(0) : (parts.turned.force(i) - force) / less,
                 on = is_there ? (force - further[i]) / far : Scalar(0);
    parts.turned.draw(i, force, parts.turned.farther(on, back), p);
  }
}

}  // namespace taut
