// Second-order theory along the path: the model of the level that the forces have reached.
#pragma once

#include <cmath>

#include "taut/condensation/second_order.hpp"

namespace taut {

/// The friction of a joint as a tracker is to use it: rho, the unknown that it depends on (-1: none) and the
/// derivative of rho with respect to that.
template <class Real>
struct JointFriction {
  Real rho = 1;
  int parameter = -1;
  Real slope = 0;
};

/// The model that a tracker computes with. In linear theory the condensed scene itself, and nothing is
/// stored.
template <class CondensedType>
class Level {
 public:
  struct Reached {};

  void begin(const CondensedType& condensed) { condensed_ = &condensed; }
  const CondensedType& model() const { return *condensed_; }
  const CondensedType& source() const { return *condensed_; }
  static void save(Reached&) {}
  bool restore(const CondensedType& condensed, const Reached&) {
    begin(condensed);
    return true;
  }
  template <class Real>
  static JointFriction<Real> leant(int, const JointFriction<Real>& given) {
    return given;
  }

 private:
  const CondensedType* condensed_ = nullptr;
};

/// In second-order theory: made anew whenever the forces have grown or fallen by a step, Eq. (43).
template <class Scalar, class Cap>
class Level<SecondOrder<Scalar, Cap>> {
 public:
  using Model = LevelModel<Scalar, Cap>;
  using Real = typename Model::Real;
  using Source = SecondOrder<Scalar, Cap>;

  /// What is saved.
  struct Reached {
    typename Model::Anchor anchor;
  };

  void begin(const Source& source) {
    source_ = &source;
    model_.begin(source);
  }
  const Model& model() const { return model_; }
  const Source& source() const { return *source_; }
  /// Begins the next step at these loads and elongations [m], of which all tensions together are `sum` [N].
  template <class Loads>
  void come_to(Real sum, const Loads& drive, const typename Model::Tensions& e) {
    before_ = model_.anchor;
    const auto before = model_.kappa_ratio;
    model_.come_to(sum, drive, e);
    grow_from(before);
  }
  /// To the step before the last come_to().
  void go_back() {
    const auto before = model_.kappa_ratio;
    model_.anchor = before_;
    model_.make();
    grow_from(before);
  }
  /// By what factor kappa changed then.
  Real growth(int joint) const { return growth_[joint]; }
  /// Friction of the scene's geometry in the displaced one.
  JointFriction<Real> leant(int joint, JointFriction<Real> given) const {
    const Real kappa = kappa_of(given.rho);
    given.rho = Model::scaled(given.rho, model_.kappa_ratio[joint]);
    const Real ratio = (1 + kappa) / (1 + kappa_of(given.rho));
    given.slope *= model_.kappa_ratio[joint] * ratio * ratio;
    return given;
  }
  void save(Reached& reached) const { reached.anchor = model_.anchor; }
  /// False if the state is none of such a scene.
  bool restore(const Source& source, const Reached& reached) {
    begin(source);
    const auto& anchor = reached.anchor;
    bool is_sound = anchor.level > 0 && std::isfinite(anchor.prestrain);
    for (int k = 0; k < model_.loads; ++k) is_sound = is_sound && std::isfinite(anchor.factor[k]);
    for (int i = 0; i < model_.segments; ++i) is_sound = is_sound && std::isfinite(anchor.e[i]);
    if (!is_sound) return false;
    model_.anchor = anchor;
    model_.make();
    return true;
  }

 private:
  void grow_from(const typename Model::Kappas& before) {
    for (int j = 0; j < model_.joints; ++j)
      growth_[j] = before[j] > 0 ? model_.kappa_ratio[j] / before[j] : Real(1);
  }

  const Source* source_ = nullptr;
  Model model_;
  typename Model::Anchor before_;
  FixedArray<Real, Cap::joints> growth_;
};

}  // namespace taut
