// Innovations without what a single wrong reading adds to them.
#pragma once

#include <cmath>

#include "taut/numerics/larger.hpp"

namespace taut {

/// Outliers come alone: an innovation beyond five of its deviations counts as far as the one before it was
/// off to the same side. A plain value. Cost: a few operations.
template <class Scalar>
class LoneOutliers {
 public:
  static constexpr Scalar outlier = 5;

  /// What counts of an innovation with that standard deviation.
  Scalar confirmed(Scalar innovation, Scalar deviation) {
    const Scalar before = (innovation < 0) == (off_ < 0) ? std::fabs(off_) : Scalar(0),
                 most = larger(outlier * deviation, before);
    off_ = innovation;
    return larger(-most, -larger(-most, -innovation));
  }

 private:
  Scalar off_ = 0;  // the last innovation
};

}  // namespace taut
