// A jack and its load cell: what is known of its load, and how far the tracker has been driven to it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "taut/estimation/belief.hpp"
#include "taut/estimation/load_filter.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/sample.hpp"

namespace taut {

/// Where the path to a row has corners: a jack is locked, or its load has reversed since the row before.
struct Corners {
  bool locks = false, reverses = false;
  bool any() const { return locks || reverses; }
};

/// A load cell's conditioned load, with the wedge of its end. A plain value: it can be saved and read back
/// byte by byte. `Reversals` is how many of its reversals are unknowns of a FrictionFilter.
template <class Scalar, int Reversals>
struct JackLoad {
  /// Readings in a row that show that the jack of a locked end pulls less than its wedge holds.
  static constexpr std::uint8_t confirmed_below = 3;

  LoadFilter<Scalar> filter;
  ConditionedLoad<Scalar> at{};
  Jack<Scalar> driven{};  ///< where the tracker was driven to
  Scalar since = 0;       ///< time since the last reading
  Scalar raw = 0;         ///< the last reading [N]
  Scalar first = 0;       ///< the least load once there is one [N]: which way things slide shows from then on
  Scalar sd_before = 0;   ///< standard deviation of the load a sample ago [N]
  bool is_new = false;    ///< `raw` is of this row, and was believed
  bool locks_now = false, locked = false;
  Scalar most_payout = 0;  ///< that it should have had so far [m]
  std::uint8_t below = 0;  ///< locked: readings in a row that were confirmed to be below what the wedge holds
  /// Unknown errors of its load where it last reversed or was locked, or -1; the oldest is forgotten next.
  std::array<std::int16_t, static_cast<std::size_t>(Reversals)> memory{};
  int oldest = 0;

  /// A reading, or none if it is more than the cable can carry, `most` [N].
  static Scalar possible(Scalar reading, Scalar most) {
    return std::fabs(reading) <= most ? reading : std::numeric_limits<Scalar>::quiet_NaN();
  }

  /// Takes what a row says of the jack: whether it is locked, a reading of its load cell, with the standard
  /// deviation `sd`, and the time since the row before. Returns true if and only if the reading was refused
  /// as an outlier. Cost: that of LoadFilter::take().
  [[nodiscard]] bool take(bool locks, const EndReading<Scalar>& given, Scalar dt, Scalar sd, Scalar most,
                          Corners& corners) {
    is_new = locks_now = false;
    at.reversed = false;
    since += dt;
    if (locks) {
      sd_before = at.sd;
      if (locked) return false;
      corners.locks = locks_now = locked = true;
      at.behind = false;
      filter.start(sd);
      below = 0;
      return false;
    }
    if (!given.has_force) return false;
    // A released end keeps its wedge until a load is read.
    if (locked) {
      filter.start(sd);
      at = {};
      locked = false;
    }
    sd_before = at.sd;
    // Placed there, not on the heap: a copy would read back at once what was just written in parts, and wait.
    new (&at) ConditionedLoad<Scalar>(filter.take(possible(given.force, most), since));
    if (first == 0 && at.load > 0) first = Scalar(1e-3) * sd;
    since = 0;
    raw = given.force;
    is_new = !at.refused;
    corners.reverses |= at.reversed;
    return at.refused;
  }
  bool has_reversed() const { return !locked && at.reversed; }
  /// Where the tracker is driven to for a row [N].
  Scalar target() const { return larger(at.confirmed, first); }
  /// From there to the best estimate of the load [N].
  Scalar beyond() const { return locked ? Scalar(0) : at.load - driven.force; }
  /// The load as a measurement of the row sees it: the raw reading if there is one, so that errors are
  /// independent from row to row.
  JackReading<Scalar> reading(Scalar cell_sd) const {
    if (locked) return {};
    const Scalar sd = is_new ? cell_sd : at.sd;
    return {(is_new ? raw : at.load) - driven.force, sd * sd};
  }

  /// While the end is locked, its load cell is that of a jack put back on it. Returns true if and only if the
  /// jack, confirmed to pull less for `confirmed_below` readings, comes to pull what the end segment has:
  /// the wedge is free. `held` is that force [N], deviation() its standard deviation. Cost: that of
  /// LoadFilter::take(), and at most one call of deviation().
  template <class Deviation>
  [[nodiscard]] bool lifts_off(Scalar reading, Scalar most, Scalar held, const Deviation& deviation) {
    const ConditionedLoad<Scalar> pull = filter.take(possible(reading, most), since);
    since = 0;
    if (pull.refused) return false;
    if (below == confirmed_below) {
      if (pull.load < held) return false;
      below = 0;
      return true;
    }
    const Scalar missing = held - pull.load;
    const bool is_below = missing > Scalar(0.01) * held && missing > 4 * (pull.sd + deviation());
    below = static_cast<std::uint8_t>(is_below ? below + 1 : 0);
    return false;
  }
};

}  // namespace taut
