// Friction that scatters from joint to joint about the mu that a cable's joints share.
#pragma once

#include <cstdint>

#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// What the scatter of mu from joint to joint adds to the variance of a force, without an unknown a joint.
///
/// The shared unknown stands for the friction of all joints together, which a far end tells. On the way there
/// the sum of the joints' friction strays from its share like a bridge: where the joints from the jack to a
/// segment have the contributions w_j to the derivative of its force, each with the variance a_j, with sums W
/// and A up to there and A_n over all, the variance relative to the square of the derivative is (A - A^2 /
/// A_n) / W^2.
template <class Scalar, class Cap>
class FrictionScatter {
 public:
  /// Fills in the segments of a cable whose shared unknown is `parameter`; weight(j) is what mu of joint j
  /// varies by with the unknown, times its contact factor, and deviation(j) the standard deviation of its mu
  /// about the shared one, times its contact factor, both where the unknown is zero and friction `nominal`.
  /// Joints that cannot slide have zero. Cost: four passes over the joints.
  template <class CableLayout, class Weight, class Deviation>
  void find(const CableLayout& cable, int parameter, Scalar nominal, const Weight& weight,
            const Deviation& deviation) {
    Scalar all = 0, whole = 0;
    for (int j = 0; j < cable.joints(); ++j) {
      const Scalar d = deviation(cable.first_joint + j);
      all += d * d;
      whole += weight(cable.first_joint + j);
    }
    const auto is_jacked = [&](std::size_t end) { return !cable.closed && cable.ends[end] == End::jacked; };
    Scalar A = 0, W = 0;
    for (int i = 0; i < cable.segments(); ++i) {
      // From the jack; of two, from the one that less friction lies before.
      const Scalar from_start = W, from_end = whole - W,
                   way = is_jacked(0) == is_jacked(1) ? -larger(-from_start, -from_end)
                         : is_jacked(0)               ? from_start
                                                      : from_end;
      const bool is_between = way > 0 && all > 0;
      variance_[cable.first_segment + i] =
          is_between ? larger(A * (all - A) / all, Scalar(0)) / (way * way) : Scalar(0);
      parameter_[cable.first_segment + i] = static_cast<std::int16_t>(parameter);
      nominal_[cable.first_segment + i] = nominal;
      if (i == cable.joints()) break;
      const Scalar d = deviation(cable.first_joint + i);
      A += d * d;
      W += weight(cable.first_joint + i);
    }
  }
  void clear() { parameter_.fill(-1); }
  /// The shared unknown of a segment's cable, or -1.
  int parameter(int segment) const { return parameter_[segment]; }
  /// Variance of the force of a segment relative to the square of its derivative by that unknown, whose mean
  /// this is: what scatters is a part of the friction that there is, Eq. (29).
  Scalar variance(int segment, Scalar mean) const {
    const Scalar nominal = nominal_[segment], part = nominal > 0 ? 1 + mean / nominal : Scalar(1);
    return part * part * variance_[segment];
  }
  /// The same of the mean of friction on the ways from an end of the cable to each segment as far as this
  /// one, with so many joints between, of which mu is off the shared one by this `part`, Eq. (56).
  Scalar variance_of_mean(int segment, int joints, Scalar part, Scalar mean) const {
    const Scalar one = part * (nominal_[segment] + mean), m = static_cast<Scalar>(joints);
    return variance(segment, mean) + one * one * (m - 1) / (3 * m * (m + 1));
  }
  /// The largest of all forces that depend on unknown `p`. Cost: a pass over the segments.
  Scalar most(int p, Scalar mean) const {
    Scalar most = 0;
    for (int i = 0; i < Cap::segments; ++i)
      if (parameter_[i] == p) most = larger(most, variance(i, mean));
    return most;
  }

 private:
  FixedArray<std::int16_t, Cap::segments> parameter_;  // the shared unknown, or -1
  FixedArray<Scalar, Cap::segments> variance_;  // relative to the square of the derivative, where it is zero
  FixedArray<Scalar, Cap::segments> nominal_;   // what the unknown is added to
};

}  // namespace taut
