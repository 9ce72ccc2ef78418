// A load cell that stands still: whether it lives.
#pragma once

#include <cstdint>

namespace taut {

/// Readings of a jack's load cell that are the very same, one after the other. Nothing tells how its load
/// should have gone; but where readings went to and fro while it rested, eight times and at least four times
/// as often as one was followed by the same, twelve in a row that are the same are no chance: the cell does
/// not live. One whose display hardly changes at rest says nothing. A plain value. Cost: a few
/// operations a reading.
template <class Scalar>
class StandingCell {
 public:
  /// Another reading [N], `dt` [s] after the one before; `rests`: its load does, or hardly moves. Returns
  /// whether it does not live.
  [[nodiscard]] bool take(Scalar reading, Scalar dt, bool rests) {
    if (reading == last_ && same_ > 0) {
      if (same_ < most) ++same_;
      stood_ += dt;
      return is_frozen();
    }
    const bool goes_up = reading > last_;
    if (!is_frozen() && same_ > 0) count(repeats_, same_ - 1);
    if (changes_ < few) ++changes_;
    if (rests && rested_ && goes_up != goes_up_) count(turns_, 1);
    goes_up_ = goes_up;
    rested_ = rests;
    last_ = reading;
    same_ = 1;
    stood_ = 0;
    return false;
  }
  /// For how long the reading has been the same [s].
  Scalar stood() const { return stood_; }
  /// Whether no reading was the one before until the present one: its value is read anew in every row.
  bool has_always_changed() const { return changes_ == few && repeats_ == 0; }
  bool is_frozen() const { return same_ >= many && turns_ >= few && turns_ >= 4 * repeats_; }

 private:
  static constexpr std::uint8_t many = 12, few = 8, most = 200;

  /// Of both alike, so that what was long ago counts less.
  void count(std::uint8_t& events, int more) {
    if (events + more > most) {
      turns_ = static_cast<std::uint8_t>(turns_ / 2);
      repeats_ = static_cast<std::uint8_t>(repeats_ / 2);
    }
    events = static_cast<std::uint8_t>(events + more < most ? events + more : most);
  }

  Scalar last_ = 0;  // reading [N]
  Scalar stood_ = 0;
  std::uint8_t same_ = 0;   // in a row
  std::uint8_t turns_ = 0;  // at rest: readings that went the other way than the one before
  std::uint8_t repeats_ = 0, changes_ = 0;
  bool goes_up_ = false, rested_ = false;
};

}  // namespace taut
