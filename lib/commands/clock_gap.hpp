// How much later a log shows what happens at one end of a cable than at the other.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "lib/commands/every_so_many.hpp"

namespace taut::host {

/// Compares the readings of a jack with those of the load cell at the far end of its cable. As long as the
/// jack goes up for the first time the force there follows at once, whatever friction is: it is that of the
/// highest load so far. Where that holds only between readings at different times, the clocks of two loggers
/// differ, or an amplifier averages. Memory: up to half a megabyte.
class ClockGap {
 public:
  /// The next row, at a time [s]; a reading is not a number if there is none. `is_over` is whether the jack
  /// no longer pulls by itself, since its end is locked.
  void take(double time, double jack, double far_end, bool is_over);
  /// How much later the far end is shown [s], below zero if the jack is; zero if that is not sure: unless
  /// readings then are on one rising path of the load within 0.7 % of the largest, the gap takes two thirds
  /// of their variance about it and 0.2 % of the largest, and is half a second or more, and less than two
  /// minutes and half of the way up, and so it is without any quarter of the way, but for one corner. Where
  /// many are as good, as on a way that is straight, the shortest. Load stages tell nothing. Cost: a pass of
  /// up to 8192 readings of either end for each of 996 gaps.
  double found() const;

 private:
  struct Reading {
    double time, force;
  };
  struct Step : Reading {
    bool is_known;  ///< how the load has come there from the one before
  };
  struct Path {
    double variance = std::numeric_limits<double>::infinity();  ///< of readings about it [N^2]
    bool rises = false;  ///< from a tenth of the load on by half of its force and more
  };
  /// Every so many of what a cell reads, each the middle one of three, for one may be wrong.
  class Series {
   public:
    void add(const Reading& reading);
    bool is_last(double force) const { return force == last_.force; }
    double read_at() const { return last_.time; }
    const std::vector<Reading>& kept() const { return kept_.kept(); }
    std::size_t every() const { return kept_.every(); }

   private:
    EverySoMany<Reading, 8192> kept_;
    Reading before_{0, std::numeric_limits<double>::quiet_NaN()}, last_ = before_;
  };

  /// The load of the jack until it goes down for good, without its noise, and without what leaks in holds.
  std::vector<Step> way_up() const;
  /// That of the readings of the far end over what the jack had reached `gap` [s] before, of those at a time
  /// that is_used(time) [s].
  template <class IsUsed>
  Path path(const std::vector<Step>& way, double gap, const IsUsed& is_used) const;
  /// Whether it is known what the jack had reached at a time [s].
  static bool is_on(const std::vector<Step>& way, double time);
  /// Whether a gap [s] mends `least_mended` [N] at least wherever one looks.
  bool is_everywhere(const std::vector<Step>& way, double gap, double least_mended) const;

  Series jack_, far_end_;
  bool is_over_ = false;
};

}  // namespace taut::host
