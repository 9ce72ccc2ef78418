// Friction laws: from the geometry of a joint and its mu to the tension ratio at which the cable slides.
#pragma once

#include <cmath>

#include "taut/scene/scene.hpp"

namespace taut {

/// How much of the tension a joint can hold back by friction: Eqs. (2) and (3).
///
/// Coulomb's |f| <= mu N over a joint with f = (T2 - T1) sin(alpha), N = (T1 + T2) cos(alpha) is the same as
/// |T2 - T1| <= kappa (T1 + T2), and as rho T2 <= T1 <= T2 / rho with rho = (1 - kappa) / (1 + kappa).
/// kappa >= 1: the joint is self-locking, the cable never slides over it.
template <class Scalar>
struct FrictionLimit {
  Scalar kappa = 0;

  constexpr bool is_self_locking() const { return kappa >= Scalar(1); }
  /// The smallest possible T_small / T_big; 0 if the joint is self-locking.
  constexpr Scalar rho() const {
    return is_self_locking() ? Scalar(0) : (Scalar(1) - kappa) / (Scalar(1) + kappa);
  }
};

/// Point contact, half the angle between the segments being alpha: kappa = mu cot(alpha), Eq. (4). No
/// trigonometry.
template <class Scalar>
constexpr FrictionLimit<Scalar> point_contact_limit(Scalar mu, Scalar cos_alpha, Scalar sin_alpha) {
  return {mu * cos_alpha / sin_alpha};
}

/// beta + k s of a saddle or duct with turning angle beta = pi - 2 alpha [rad]. `wobble` is k [rad/m],
/// `length` is s [m]: half of each adjacent segment.
template <class Scalar>
Scalar capstan_angle(Scalar cos_alpha, Scalar sin_alpha, Scalar wobble, Scalar length) {
  return Scalar(2) * std::atan2(cos_alpha, sin_alpha) + wobble * length;
}

/// Saddle or duct: rho = exp(-mu (beta + k s)), so kappa = tanh(mu (beta + k s) / 2), Eq. (5), with the
/// lengths of capstan_angle(). The law is that of EN 1992-1-1 (5.45).
template <class Scalar>
FrictionLimit<Scalar> capstan_limit(Scalar mu, Scalar cos_alpha, Scalar sin_alpha, Scalar wobble,
                                    Scalar length) {
  return {std::tanh(mu * capstan_angle(cos_alpha, sin_alpha, wobble, length) / Scalar(2))};
}

/// The friction limit of a joint under the law of its cable.
template <class Scalar>
FrictionLimit<Scalar> friction_limit(const Cable<Scalar>& cable, Scalar mu, Scalar cos_alpha,
                                     Scalar sin_alpha, Scalar half_lengths) {
  if (cable.law == FrictionLaw::point) return point_contact_limit(mu, cos_alpha, sin_alpha);
  return capstan_limit(mu, cos_alpha, sin_alpha, cable.wobble, half_lengths);
}

}  // namespace taut
