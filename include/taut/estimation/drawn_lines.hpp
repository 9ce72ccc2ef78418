// Instruments with a zero of their own draw lines over the loads that jacks read: what keeps them in place.
#pragma once

#include <cstdint>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// As long as the same joints slide, what an instrument reads is a line over what the cell of a jack reads.
/// Where the line lies says one thing of two zeros that nobody knows: z' of the instrument and z of the cell
/// together, z' + H_z z with H_z the derivative by z, which is what friction leaves. When friction is found
/// to be another H_z changes, but the line that was read has stayed: so its sum is known as well as before,
/// and the zero becomes z' + (H_z before - H_z now) z, in mean and covariance, Eq. (74). Were that left out,
/// one line would be read as many, with another sum each, and they would tell both zeros apart, which nothing
/// that was read does.
template <class Scalar, int Zeros, int Jacks>
class DrawnLines {
 public:
  struct State {
    struct Line {
      FixedArray<Scalar, Jacks> slope;  ///< H_z of the zero of every cell
      std::uint32_t slides = 0;         ///< a number for which joints slide which way
      bool is_drawn = false;
    };
    FixedArray<Line, Zeros> line;
  };
  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }
  void clear() { state_ = {}; }
  /// Instrument `i` has another zero from here on.
  void forget(int i) { state_.line[i].is_drawn = false; }
  /// Before a reading of instrument `i` is compared with slope(k), H_z of the cell with number `k` of so
  /// many. Calls shear(k, by) for each of them if the line is there and `slides` is what it was: the zero
  /// becomes what it was and so much `by` that of the cell. Cost: a few operations a cell.
  template <class Slope, class Shear>
  void keep(int i, std::uint32_t slides, int cells, const Slope& slope, const Shear& shear) {
    auto& line = state_.line[i];
    const bool goes_on = line.is_drawn && line.slides == slides;
    for (int k = 0; k < cells; ++k) {
      const Scalar now = slope(k), by = line.slope[k] - now;
      line.slope[k] = now;
      if (goes_on && by != 0) shear(k, by);
    }
    line.slides = slides;
    line.is_drawn = true;
  }

 private:
  State state_;
};

}  // namespace taut
