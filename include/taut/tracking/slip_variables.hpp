// What moves along the cables, and the laws that it obeys while it does.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "taut/condensation/condensed.hpp"
#include "taut/scene/sample.hpp"

namespace taut {

/// Something that slips along a cable and imposes an elongation: the slip of a joint lengthens the segment
/// before it and shortens the one after, an extension or a slack length lengthens one segment.
struct SlipVariable {
  enum class Kind : std::uint8_t { slip, extension, slack_length } kind = Kind::slip;
  std::int16_t index = 0;       ///< joint; 2 x cable + end; span
  std::int16_t lengthened = 0;  ///< segment
  std::int16_t shortened = 0;   ///< segment, slip only; else -1

  static SlipVariable of(Kind kind, int index, int lengthened, int shortened = -1) {
    return {kind, static_cast<std::int16_t>(index), static_cast<std::int16_t>(lengthened),
            static_cast<std::int16_t>(shortened)};
  }
  /// Adds the elongations that it imposes on the segments.
  template <class Real, class Elongations>
  void impose(Real by, Elongations& e) const {
    e[lengthened] += by;
    if (shortened >= 0) e[shortened] -= by;
  }
};

/// What an active variable obeys: a weighted sum of two tensions, T_first - weight T_second, is zero or
/// given.
template <class Real>
struct TensionConstraint {
  std::int16_t first = 0;
  std::int16_t second = -1;
  Real weight = 0;

  static TensionConstraint on(int segment) { return {static_cast<std::int16_t>(segment), -1, Real(0)}; }

  /// In the numbers of T.
  template <class Tensions>
  auto of(const Tensions& T) const {
    using Number = std::decay_t<decltype(T[0])>;
    return second < 0 ? T[first] : T[first] - static_cast<Number>(weight) * T[second];
  }
};

/// A slip variable that is not frozen. Its law: the tension of segment `on` is zero or given; or a joint
/// slides and keeps T_small = rho T_big.
struct ActiveConstraint {
  SlipVariable variable;
  std::int16_t on = 0;    ///< -1: a joint that slides
  std::int8_t sense = 0;  ///< of sliding: the sign that its rate must have; 0 if it has none
  std::int16_t pair = 0;  ///< of the complementarity problem in which it entered, or -1

  bool slides() const { return on < 0; }
  /// T_big of a joint that slides.
  int big() const { return sense > 0 ? variable.shortened : variable.lengthened; }
};

/// Everything that has moved along the cables; or derivatives of it.
template <class Real, class Cap>
struct SlipState {
  FixedArray<Real, Cap::joints> slip;                      ///< delta of every joint [m]
  FixedArray<std::array<Real, 2>, Cap::cables> extension;  ///< at start and end of every cable [m]
  FixedArray<Real, max_spans<Cap>> slack_length;  ///< length that every span has too much [m], zero if taut

  friend bool operator==(const SlipState& a, const SlipState& b) {
    return a.slip == b.slip && a.extension == b.extension && a.slack_length == b.slack_length;
  }
  /// What `variable` has come to.
  Real& of(const SlipVariable& variable) {
    if (variable.kind == SlipVariable::Kind::slack_length) return slack_length[variable.index];
    if (variable.kind == SlipVariable::Kind::extension)
      return extension[variable.index / 2][static_cast<std::size_t>(variable.index % 2)];
    return slip[variable.index];
  }
  /// All of it is so many times what it was.
  void scale(Real by) {
    for (int j = 0; j < Cap::joints; ++j) slip[j] *= by;
    for (int c = 0; c < Cap::cables; ++c)
      for (Real& each : extension[c]) each *= by;
    for (int r = 0; r < max_spans<Cap>; ++r) slack_length[r] *= by;
  }
};

/// As many as there can be: their laws are linear in the tensions, and no more of them are independent.
template <class Cap>
constexpr int max_active_constraints = Cap::segments;

/// Something outside that changes along a path.
struct Input {
  enum class Kind : std::uint8_t { load, jack_force, extension, prestrain } kind = Kind::load;
  std::int16_t index = 0;  ///< load pattern; 2 x cable + end
};

/// What the law of an active variable changes by when another slip variable grows by one: an entry of R W
/// [N/m].
template <class CondensedType>
typename CondensedType::Real resistance(const CondensedType& model,
                                        const TensionConstraint<typename CondensedType::Real>& law,
                                        const SlipVariable& variable) {
  const auto tension = [&](int segment) {
    const auto lengthened = model.coupling(segment, variable.lengthened);
    return variable.shortened < 0 ? lengthened : lengthened - model.coupling(segment, variable.shortened);
  };
  return law.second < 0 ? tension(law.first) : tension(law.first) - law.weight * tension(law.second);
}

/// A limit of a joint: sliding forward keeps T_before = rho T_after, backward T_after = rho T_before.
struct SlipMode {
  std::int16_t joint = -1;
  JointState way = JointState::stick;

  static SlipMode of(int joint, JointState way) { return {static_cast<std::int16_t>(joint), way}; }
};

/// Slips and laws of the joints of a condensed scene. If `Adjustable`, their rho can be changed.
template <class CondensedType, bool Adjustable = false>
class JointConstraints {
 public:
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;

  void find(const CondensedType& model) {
    model_ = &model;
    if constexpr (Adjustable) rho_ = model.rho;
    for (const auto& cable : model.cables)
      for (int j = 0; j < cable.joints(); ++j) {
        const auto sides = cable.joint_segments(j);
        sides_[cable.first_joint + j] = {static_cast<std::int16_t>(sides[0]),
                                         static_cast<std::int16_t>(sides[1])};
      }
  }
  /// Segments before and after a joint.
  const std::array<std::int16_t, 2>& sides(int joint) const { return sides_[joint]; }
  SlipVariable slip(int joint) const {
    if (Cap::joints == 0) return {};
    return {SlipVariable::Kind::slip, static_cast<std::int16_t>(joint), sides_[joint][0], sides_[joint][1]};
  }
  TensionConstraint<Real> limit(const SlipMode& mode) const {
    const auto& sides = sides_[mode.joint];
    const bool forward = mode.way == JointState::forward;
    return {sides[forward ? 0 : 1], sides[forward ? 1 : 0], rho(mode.joint)};
  }
  Real rho(int joint) const {
    if constexpr (Adjustable)
      return rho_[joint];
    else
      return model_->rho[joint];
  }
  void set_rho(int joint, Real rho) { rho_[joint] = rho; }
  ActiveConstraint sliding(const SlipMode& mode) const {
    return {slip(mode.joint), -1, static_cast<std::int8_t>(mode.way == JointState::forward ? 1 : -1), -1};
  }
  /// A joint without friction slides both ways.
  ActiveConstraint gliding(int joint) const { return {slip(joint), -1, 0, -1}; }
  TensionConstraint<Real> of(const ActiveConstraint& active) const {
    if (!active.slides()) return TensionConstraint<Real>::on(active.on);
    return limit({active.variable.index, active.sense > 0 ? JointState::forward : JointState::backward});
  }

 private:
  const CondensedType* model_ = nullptr;
  FixedArray<std::array<std::int16_t, 2>, Cap::joints> sides_;
  FixedArray<Real, Adjustable ? Cap::joints : 0> rho_;
};

}  // namespace taut
