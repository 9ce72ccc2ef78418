// Whether cables surely slide throughout, though when they begin to depends on friction that is not known.
#pragma once

#include <cmath>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// The way that the jacks' loads go while joint after joint of a cable begins to slide, after a turn or a
/// lock. It is in proportion to friction: where the model has all of them slide, some may stick in truth. A
/// plain value.
template <class Scalar, int Cables>
class SlidingWay {
 public:
  /// Friction that is higher by so many standard deviations is tried.
  static constexpr Scalar deviations = 2;

  /// The sum of the loads [N] that the model is driven to.
  void go(Scalar load) {
    before_ = way_;
    way_ += std::fabs(load - last_);
    last_ = load;
  }
  /// Whether the model has cable `c` slide throughout by now: it began, or ceased to, half-way from where the
  /// loads were before.
  void follow(int c, bool slides) {
    if (slides == slides_[c]) return;
    slides_[c] = slides;
    const Scalar here = (before_ + way_) / 2;
    // From no load at all it slides at once, whatever friction there is.
    if (began_[c] == 0) ceased_[c] = here;
    (slides ? began_ : ceased_)[c] = here;
  }
  /// Whether it surely does, with friction that is known to the part `mu_sd`, Eq. (35), and the load where it
  /// turned to `turn_sd` [N].
  bool surely_slides(int c, Scalar mu_sd, Scalar turn_sd = 0) const {
    return slides_[c] &&
           way_ - ceased_[c] >= (1 + deviations * mu_sd) * (began_[c] - ceased_[c]) + deviations * turn_sd;
  }

 private:
  Scalar way_ = 0, before_ = 0, last_ = 0;  // that the sum has gone, by now and before; and the sum [N]
  /// `way_` where a cable last began and ceased to slide throughout.
  FixedArray<Scalar, Cables> began_, ceased_;
  FixedArray<bool, Cables> slides_;
};

}  // namespace taut
