// The model runs away where the structure stands: there is more friction than it was taken to have.
#pragma once

#include <array>
#include <cmath>

#include "taut/estimation/drive.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// How often find_where_it_stands() is to raise friction at most, at first and where no load has helped.
/// Nothing is raised in linear theory.
template <class TrackerType>
constexpr auto bounds_of_friction = [] {
  if constexpr (TrackerType::Model::has_level)
    return std::array<int, 2>{2, 4};
  else
    return std::array<int, 1>{0};
}();

/// The unknown of the friction that does not hold what the cable alone has to hold, where the path has ended
/// for that; -1 if it has not, or that friction is known.
template <class Parts>
int lets_run_away(const Parts& parts, const Status& status) {
  if ((status.code != Code::gives_way && status.code != Code::mechanism) || status.place != Place::joint)
    return -1;
  return parts.filter.unknown_of(parts.model().cables[status.cable].first_joint + status.index);
}

/// The structure stands where the model of it runs away, with unknown `p` of friction as it is linearized: it
/// is larger, Eq. (76), and the tracker is brought to it. Returns false if it would have to be off by more
/// than five sigma. Cost: three times the square of the unknowns, and that of Tracker::adjust().
template <class Parts>
[[nodiscard]] bool raise_friction_of(Parts& parts, int p) {
  using Scalar = typename Parts::Scalar;
  auto& filter = parts.filter;
  typename Parts::Values H;
  H[p] = -1;
  const Scalar sd = std::sqrt(larger(filter.belief().variance(p), Scalar(0)));
  if (!filter.bring_below_zero(filter.lower_bound_of(p), sd / 8, H, Scalar(0))) return false;
  parts.is_belief_fine = false;
  return filter.relinearize(parts.tracker, filter.belief().mean());
}

/// Where `progress` has ended with a strut that runs away, friction is raised until the path that go_on()
/// follows has an answer, of one unknown after the other. Of one with which there is none all is known that
/// was known before. Nothing is done in linear theory, or while a load of the cable is in doubt. Cost: that
/// of raise_friction_of() and of a path, at most `most` times.
template <class Parts, class GoOn>
[[nodiscard]] Progress<typename Parts::Scalar> find_where_it_stands(Parts& parts,
                                                                    Progress<typename Parts::Scalar> progress,
                                                                    const GoOn& go_on, int most) {
  if constexpr (Parts::TrackerType::Model::has_level) {
    int left = most;
    for (int p = lets_run_away(parts, progress.status); p >= 0 && parts.can_teach(progress.status.cable);) {
      const auto before = parts.filter.belief().bound_at(parts.filter.lower_bound_of(p));
      int next = p;
      for (; next == p && left > 0 && raise_friction_of(parts, p); --left) {
        progress = join(progress, go_on());
        next = lets_run_away(parts, progress.status);
      }
      if (next == p || (next < 0 && !progress.status))
        parts.filter.put_back_lower_bound(parts.tracker, p, before);
      if (next == p) break;
      p = next;
    }
  }
  return progress;
}

}  // namespace taut
