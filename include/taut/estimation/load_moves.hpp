// Whether a load goes somewhere, beside its noise.
#pragma once

#include <cmath>
#include <cstdint>

namespace taut {

/// Follows the best estimate of a load and tells when it has gone on by more than noise does, and whether it
/// does so again and again. All zeros: a load at rest at zero.
template <class Scalar>
class LoadMoves {
 public:
  /// The best estimate in a row with a reading, of a cell with this noise [N]. After a pause, as between load
  /// stages, one row is as good as a few. Cost: a few operations.
  void follow(Scalar load, Scalar noise, bool after_pause) {
    constexpr int surely = 3;
    const Scalar gone = std::fabs(load - from_);
    has_gone_ = gone > surely * noise;
    if (has_gone_) {
      is_fast_ = after_pause || rows_ < few || gone > 2 * surely * noise;
      from_ = load;
      rows_ = 0;
    } else if (after_pause || rows_ == few) {
      is_fast_ = false;
    } else {
      ++rows_;
    }
  }
  /// Whether it has gone on in this row, by three deviations of the noise since it did last.
  bool has_gone() const { return has_gone_; }
  /// Whether it does so every few rows.
  bool is_fast() const { return is_fast_; }
  /// No reading in this row.
  void rest() { has_gone_ = false; }

 private:
  static constexpr std::uint8_t few = 8;

  Scalar from_ = 0;  // where it had gone last [N]
  std::uint8_t rows_ = 0;
  bool has_gone_ = false, is_fast_ = false;
};

}  // namespace taut
