// What the forces can be when the past is not known.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "taut/estimation/friction_prior.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/tracking/slip_variables.hpp"

namespace taut {

/// The smallest and the largest force that a segment can have [N].
template <class Scalar>
struct ForceRange {
  Scalar least = 0;
  Scalar most = std::numeric_limits<Scalar>::infinity();

  /// No force agrees with everything that is given.
  bool is_empty() const { return !(least <= most); }
};

/// How sure the bounds are to be.
template <class Scalar>
struct BoundWidths {
  /// The mu of a joint is at most its nominal value and so many of its standard deviations, those of what is
  /// known of its cable and of its scatter together.
  Scalar mu = 2;
  Scalar sensor = 2;  ///< a load cell is off by at most so many of its own, of each kind of its errors
};

/// Bounds on every segment of a cable whose past is not known: a controller switched on beside a stressed
/// cable.
///
/// Whatever the history, every joint keeps rho T_big <= T_small with rho at the largest mu of its band. So a
/// load cell bounds its segment, and a bound carries over a joint as T rho <= T' <= T / rho, Eq. (25); bounds
/// from all load cells of the cable hold at once. They are as narrow as friction alone allows: some history
/// leads to every force within them, on rigid saddles. A joint that is self-locking, or may be, carries
/// nothing over.
///
/// `ranges` are those of all segments of the scene; the segments of cable `c` are filled. Returns whether any
/// load cell was read: a reading that is not finite, or more than the cable can carry, is none. A range that
/// is empty says that the readings contradict the band of mu. Cost: two passes over the cable.
template <class CondensedType>
bool find_bounds(
    const CondensedType& model,
    const FrictionPrior<typename CondensedType::Scalar, typename CondensedType::Capacity>& prior,
    const std::array<EndReading<typename CondensedType::Scalar>, 2>& ends, int c,
    FixedArray<ForceRange<typename CondensedType::Scalar>, CondensedType::Capacity::segments>& ranges,
    const BoundWidths<typename CondensedType::Scalar>& widths = {}) {
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  const auto& cable = model.cables[c];
  for (int i = 0; i < cable.segments(); ++i) ranges[cable.first_segment + i] = {};
  if (cable.closed) return false;

  const auto free = FreeJoints<Real>::of(model, prior, cable);
  const auto least_rho = [&](int joint) {
    if (model.is_self_locking(joint)) return Scalar(0);
    const auto nominal = static_cast<Scalar>(prior.mu[joint]);
    const Scalar weight = prior.shared[c] ? static_cast<Scalar>(free.weight(prior.mu[joint])) : Scalar(1);
    const Scalar known = weight * prior.mu_sd[c], own = prior.scatter[c] * nominal;
    const Scalar mu = nominal + widths.mu * std::sqrt(known * known + own * own);
    return static_cast<Scalar>(larger(Real(0), prior.limit(c, joint, static_cast<Real>(mu)).rho));
  };
  const auto narrow = [&](int segment, Scalar least, Scalar most) {
    ForceRange<Scalar>& range = ranges[segment];
    range.least = larger(range.least, least);
    range.most = -larger(-range.most, -most);
  };
  bool any = false;
  for (std::size_t end = 0; end < 2; ++end) {
    if (!ends[end].has_force || !(std::fabs(ends[end].force) <= model.most_force[c])) continue;
    any = true;
    const LoadCell<Scalar>& cell = prior.cell[c][end];
    const Scalar force = ends[end].force;
    const Scalar off = widths.sensor * (cell.sd + cell.zero_sd + (cell.gain_sd + cell.hysteresis_sd) * force);
    Scalar least = larger(Scalar(0), force / larger(cell.up, cell.down) - off),
           most = larger(Scalar(0), -force / larger(-cell.up, -cell.down) + off);
    const int n = cable.segments();
    for (int i = 0; i < n; ++i) {
      const int at = end == 0 ? i : n - 1 - i;
      if (i > 0) {
        const Scalar rho = least_rho(cable.first_joint + (end == 0 ? at - 1 : at));
        least *= rho;
        most = rho > 0 ? most / rho : std::numeric_limits<Scalar>::infinity();
      }
      narrow(cable.first_segment + at, least, most);
    }
  }
  return any;
}

}  // namespace taut
