// A load cell that shows something else for a while: a plug that comes loose, a display that is switched.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/numerics/larger.hpp"

namespace taut {

/// Tells a jump of the readings from a load that moves: a reading four times as far away as any has gone from
/// one row to the next, and farther than a load goes in that time which is a quarter as fast again as any has
/// been, peaks aside, is held back, and those after it until they come back to where the load can have gone
/// meanwhile, or at least jump back towards it from where they had stayed. Where they go on for two rows
/// more, by a third of the step before at least, the load does: it has begun to move, or moves faster. What
/// lasts for more than `most_held` readings is believed. Readings more than 5 s apart, a row a load stage,
/// and those after a pause are not held back: what happened before them is not known. Only where rows merely
/// come more slowly, as in a hold after a ramp, one that still shows what was held back is, or that would be
/// four times as fast as a load has ever been and faster than one can be. The first eight tell how loads go:
/// of them only what no load can have done is held back, after three that hang together. A plain value. Cost:
/// a few operations a reading.
template <class Scalar>
class JumpGuard {
 public:
  static constexpr std::uint8_t most_held = 15;
  /// Rows are load stages, or pauses lie between them [s].
  static constexpr Scalar far_apart = 5;
  /// Whether a row so long after another one [s] is a load stage, or comes after a pause.
  static constexpr bool is_stage(Scalar dt) { return dt > far_apart; }

  /// Begins at a load that is known [N].
  void start(Scalar load) {
    come_to(load);
    age_ = gone_ = went_ = 0;
  }
  /// The same of a jack that takes over from a wedge in a row `dt` [s] after the one before: it begins there.
  /// Readings of a jack that has only rested do not tell how its load goes.
  void start(Scalar load, Scalar dt) {
    start(load);
    if (!(fastest_ > 0)) seen_ = 0;
    step_ = dt;
    age_ = -dt;
  }
  /// Whether this reading [N] of a cell with noise `sd`, `dt` [s] after the one before, is held back; it has
  /// been shown for the time `stood` [s]. No load goes faster than `most` [N/s].
  [[nodiscard]] bool holds(Scalar reading, Scalar dt, Scalar stood, Scalar sd, Scalar most) {
    age_ += dt;
    const Scalar off = std::fabs(reading - last_), from_shown = std::fabs(reading - shown_),
                 scatter = at_most * sd, change = off - scatter,
                 jump = far * (larger(farthest_, gone_) + scatter),
                 steps = step_ > 0 && dt > step_ ? dt / step_ : Scalar(1),
                 possible = held_ == 0 ? jump : scatter + (passed_ + steps) * farthest_;
    const bool stays = held_ > 0 && from_shown < jump && from_shown < off;
    const bool is_pause = is_stage(dt) || (dt > pause * step_ && !stays &&
                                           !(change > larger(far * fastest_, most) * dt + far * scatter));
    const Scalar pace = held_ == 0 ? off / steps : on_by(reading, steps);
    const bool is_line = held_ == 0 || (is_line_ && pace_ <= slower * pace + 2 * scatter),
               goes_on = held_ >= line && is_line;
    const bool lasts = held_ == most_held;
    const bool is_young = seen_ < enough, is_impossible = is_young && change > possible && change > most * dt;
    if ((!is_young || (is_impossible && seen_ >= few)) && !is_pause && !lasts && !goes_on &&
        (stays || change > possible) && !(held_ == 0 && goes_as_before(reading, change, stood)) &&
        !comes_back(reading, stays)) {
      pace_ = pace;
      is_line_ = is_line;
      has_moved_ = false;
      may_move_ = (held_ == 0 || may_move_) && (held_ == 0 ? off <= most * time_to_go(stood) + scatter
                                                           : from_shown <= most * dt + scatter);
      ++held_;
      passed_ += steps;
      shown_ = reading;
      return true;
    }
    has_moved_ = held_ > 0 && (goes_on || lasts);
    step_ = dt;
    // Only what went on from one row to the next says how far loads go.
    if (goes_on && pace > farthest_) farthest_ = pace;
    // One of the first may be the wrong one.
    if (is_impossible && seen_ < few) seen_ = 0;
    if (reading != last_) {
      if (change > 0 || gone_ > 0 || went_ > 0) learn(reading, change, stood, is_pause);
      age_ = stood;
    }
    if (seen_ < enough) ++seen_;
    come_to(reading);
    return false;
  }
  /// A reading that was held back is believed after all: the load has gone there [N].
  void believe(Scalar reading) {
    const Scalar pace = std::fabs(reading - last_) / passed_;
    if (pace > farthest_) farthest_ = pace;
    has_moved_ = true;
    start(reading);
  }
  /// How fast loads go [N/s], peaks aside; zero as long as none has.
  Scalar fastest() const { return fastest_; }
  /// Whether the last reading is believed because the load has gone where others were held back.
  bool has_moved() const { return has_moved_; }
  /// Whether those that are held back go on as those of a load that moves: one more tells.
  bool may_go_on() const { return held_ == line && is_line_; }
  /// Whether the last reading is the first that is held back, and a load can have gone there.
  bool may_begin_to_move() const { return held_ == 1 && may_move_; }
  /// How far the load can have gone since the last reading that was believed: as far as ever, at most twice
  /// as far as where it was read; at least as far where it can have gone as fast [N].
  Scalar reach() const {
    const Scalar gone = passed_ * farthest_, read = std::fabs(shown_ - last_), least = Scalar(1.1) * read;
    if (may_move_ && gone < least) return least;
    return gone < 2 * read ? gone : 2 * read;
  }

 private:
  void come_to(Scalar load) {
    last_ = load;
    held_ = stayed_ = 0;
    passed_ = 0;
  }
  /// Whether this reading shows that the last one was a peak, which does not tell how loads go.
  bool was_peak(Scalar reading) const { return std::fabs(reading - left_) < std::fabs(last_ - left_) / 2; }
  /// How far, and how fast, loads go, from a change that is believed.
  [[gnu::noinline]] void learn(Scalar reading, Scalar change, Scalar stood, bool is_pause) {
    const bool is_peak = (gone_ > 0 || went_ > 0) && was_peak(reading);
    if (!is_peak && seen_ >= few) {
      farthest_ = larger(farthest_, gone_);
      fastest_ = larger(fastest_, went_);
    }
    gone_ = went_ = 0;
    if (is_peak || seen_ == 0) return;
    const Scalar took = age_ - stood;
    if (held_ == 0 && !is_pause && change > farthest_) gone_ = change;
    if (took > 0 && change > fastest_ * took) went_ = change / took;
    left_ = last_;
  }
  /// The time in which the load can have gone to what has been shown for the time `stood` [s].
  Scalar time_to_go(Scalar stood) const { return -larger(stood - age_, -far_apart); }
  /// Whether a change to this reading is that of a load which is hardly faster than it has been.
  [[gnu::noinline]] bool goes_as_before(Scalar reading, Scalar change, Scalar stood) const {
    const Scalar fastest = went_ > fastest_ && !was_peak(reading) ? went_ : fastest_;
    return change <= faster * fastest * time_to_go(stood);
  }
  /// How far a reading has gone on a step from the one before, away from where the load was [N].
  Scalar on_by(Scalar reading, Scalar steps) const {
    return (shown_ > last_ ? reading - shown_ : shown_ - reading) / steps;
  }
  /// Whether the readings that were held back had stayed where they were, and this one jumps from there to
  /// the other side: it is right again, though the load has gone farther than any did before.
  bool comes_back(Scalar reading, bool stays) {
    if (held_ == 0) return false;
    const bool is_nearer = std::fabs(reading - last_) < std::fabs(shown_ - last_);
    if (!stays && is_nearer && stayed_ >= steady) return true;
    stayed_ = stays ? static_cast<std::uint8_t>(stayed_ + 1) : std::uint8_t(0);
    return false;
  }

  static constexpr std::uint8_t enough = 8, few = 3, steady = 3, line = 2;
  /// A load that slows down, as where a valve is opened, goes on by no less than one in so many of the step
  /// before.
  static constexpr Scalar slower = 3;
  static constexpr Scalar far = 4, faster = Scalar(1.25), at_most = 3, pause = 4;

  Scalar last_ = 0, step_ = 0;  // the last reading that was believed; its time after the one before [s]
  Scalar passed_ = 0;           // since then, in such steps
  Scalar farthest_ = 0;         // that readings have gone in a row [N], less their scatter
  Scalar fastest_ = 0;          // that they have gone from one that was another, less their scatter [N/s]
  // How much farther the last one went, and faster, if it is no peak [N], [N/s], and from where.
  Scalar gone_ = 0, went_ = 0, left_ = 0;
  Scalar age_ = 0;    // since the last reading that was believed was first shown [s]
  Scalar shown_ = 0;  // the last one that was held back
  Scalar pace_ = 0;   // how far it had gone on a step, from the one before or as they jumped [N]
  std::uint8_t seen_ = 0, held_ = 0;
  bool may_move_ = false, has_moved_ = false;
  bool is_line_ = false;     // as they jumped they have gone on, by a third of the step before, at least
  std::uint8_t stayed_ = 0;  // of those held back, so many in a row were where the one before was
};

}  // namespace taut
