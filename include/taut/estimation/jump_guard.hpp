// A load cell that shows something else for a while: a plug that comes loose, a display that is switched.
#pragma once

#include <cmath>
#include <cstdint>

namespace taut {

/// Tells a jump of the readings from a load that moves: a reading four times as far away as any has gone from
/// one row to the next is held back, and those after it until they come back to where the load can have gone
/// meanwhile, or at least jump back towards it from where they had stayed; what lasts for more than
/// `most_held` readings is believed. Readings more than 5 s apart, a row a load stage, and those after a
/// pause are not held back: what happened before them is not known. A plain value. Cost: a few operations a
/// reading.
template <class Scalar>
class JumpGuard {
 public:
  static constexpr std::uint8_t most_held = 15;
  /// Rows are load stages, or pauses lie between them [s].
  static constexpr Scalar far_apart = 5;

  /// Begins at a load that is known [N].
  void start(Scalar load) {
    last_ = load;
    held_ = stayed_ = 0;
  }
  /// Whether this reading [N] of a cell with noise `sd`, `dt` [s] after the one before, is held back.
  [[nodiscard]] bool holds(Scalar reading, Scalar dt, Scalar sd) {
    const bool is_pause = dt > far_apart || dt > pause * step_;
    step_ = dt;
    const Scalar scatter = at_most * sd, change = std::fabs(reading - last_) - scatter,
                 possible = held_ == 0 ? far * (farthest_ + scatter)
                                       : scatter + static_cast<Scalar>(held_ + 1) * farthest_;
    if (seen_ == enough && !is_pause && held_ < most_held && change > possible &&
        !comes_back(reading, scatter)) {
      ++held_;
      shown_ = reading;
      return true;
    }
    // Only what went on from one row to the next says how far loads go.
    if (held_ == 0 && seen_ > 0 && change > farthest_ && !is_pause) farthest_ = change;
    if (seen_ < enough) ++seen_;
    start(reading);
    return false;
  }
  /// How far the load can have gone since the last reading that was believed [N].
  Scalar reach() const { return static_cast<Scalar>(held_) * farthest_; }

 private:
  /// Whether the readings that were held back had stayed where they were, and this one jumps from there to
  /// the other side: it is right again, though the load has gone farther than any did before.
  bool comes_back(Scalar reading, Scalar scatter) {
    if (held_ == 0) return false;
    const bool jumps = std::fabs(reading - shown_) > far * (farthest_ + scatter);
    const bool is_nearer = std::fabs(reading - last_) < std::fabs(shown_ - last_);
    if (jumps && is_nearer && stayed_ >= steady) return true;
    stayed_ = jumps ? std::uint8_t(0) : static_cast<std::uint8_t>(stayed_ + 1);
    return false;
  }

  static constexpr std::uint8_t enough = 8, steady = 3;
  static constexpr Scalar far = 4, at_most = 3, pause = 4;

  Scalar last_ = 0, step_ = 0;  // the last reading that was believed; time between the last two [s]
  Scalar farthest_ = 0;         // that readings have gone in a row [N], less their scatter
  Scalar shown_ = 0;            // the last one that was held back
  std::uint8_t seen_ = 0, held_ = 0;
  std::uint8_t stayed_ = 0;  // of those held back, so many in a row were where the one before was
};

}  // namespace taut
