// What is known of friction and of the load cells before anything is measured.
#pragma once

#include <array>

#include "taut/numerics/decay.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/wide.hpp"
#include "taut/scene/load_cell.hpp"

namespace taut {

/// Friction of every joint as a function of its mu, how well mu is known, and the load cells.
/// Beside Condensed, all that an Estimator needs of a scene; an aggregate, it can be a constant in flash.
template <class Scalar_, class Cap>
struct FrictionPrior {
  using Scalar = Scalar_;
  using Real = Wide<Scalar>;

  FixedArray<Real, Cap::joints> mu;  ///< nominal [-]
  /// What mu is multiplied by: cot(alpha) of a point contact, beta + k s of a capstan [-].
  FixedArray<Real, Cap::joints> contact_factor;
  FixedArray<bool, Cap::cables> capstan;
  /// Standard deviation of what is known of mu, of a shared one with what `scatter` leaves in the mean of the
  /// joints; 0: known exactly.
  FixedArray<Scalar, Cap::cables> mu_sd;
  FixedArray<bool, Cap::cables> shared;        ///< one unknown a cable: a common factor on the nominal values
  FixedArray<Scalar, Cap::cables> scatter;     ///< of mu from joint to joint about that, relative
  FixedArray<Scalar, Cap::cables> seating_sd;  ///< standard deviation of the wedges' draw-in [m]
  /// Standard deviation of the strain that a cable takes on by itself once it is locked: alpha times that of
  /// the temperature that nobody logs [-]; 0: none.
  FixedArray<Scalar, Cap::cables> drift_sd;
  FixedArray<Scalar, Cap::segments> length;                       ///< [m], of cables that drift; else zero
  FixedArray<std::array<LoadCell<Scalar>, 2>, Cap::cables> cell;  ///< at both ends

  /// rho = T_small / T_big at which a joint of cable `c` slides, and its derivative with respect to mu:
  /// (1 - kappa) / (1 + kappa) with kappa = mu cot(alpha), or exp(-mu (beta + k s)); Eqs. (4), (5), (17).
  struct Limit {
    Real rho, slope;
  };
  constexpr Limit limit(int c, int joint, Real at_mu) const {
    const Real g = contact_factor[joint];
    if (capstan[c]) {
      const Real rho = decay(at_mu * g);
      return {rho, -g * rho};
    }
    const Real kappa = at_mu * g;
    return {(Real(1) - kappa) / (Real(1) + kappa), Real(-2) * g / ((Real(1) + kappa) * (Real(1) + kappa))};
  }
};

/// The joints of a cable that can slide, at the mu of a FrictionPrior.
template <class Real>
struct FreeJoints {
  int count = 0;
  Real mu = 0;  ///< the sum of the nominal ones [-]

  template <class Model, class Prior, class Cable>
  static FreeJoints of(const Model& model, const Prior& prior, const Cable& cable) {
    FreeJoints free;
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
      if (model.is_self_locking(j)) continue;
      free.mu += prior.mu[j];
      ++free.count;
    }
    return free;
  }
  /// What the mu of a joint with this nominal one varies by when the shared one does by one [-]: what is
  /// shared is a factor on the nominal values, and the shared mu their mean.
  Real weight(Real nominal) const { return mu > 0 ? nominal * static_cast<Real>(count) / mu : Real(1); }
};

}  // namespace taut
