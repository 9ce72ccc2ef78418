// What a tracker answers: forces, slips, joint states, and how they change with the jack's force.
#pragma once

#include <cmath>

#include "taut/tracking/cable_system.hpp"
#include "taut/tracking/sample_path.hpp"

namespace taut {

/// The state that a Tracker has reached. Nothing here changes it; every function may be called from an
/// interrupt that does not interrupt the tracker itself. Forces [N], slips [m].
template <class CondensedType, int Parameters>
class TrackedForces {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Model = typename CondensedType::AtLevel;
  using Cables = CableSystem<Model, Parameters>;
  using Loads = typename Cables::Loads;
  using SlipState = typename Cables::SlipState;
  using Tensions = typename Cables::Tensions;

  /// Which way the joint slides, or slid before the load came to rest.
  JointState limit(int joint) const { return cables_.state.slides[joint]; }
  bool is_at_limit(int joint) const { return limit(joint) != JointState::stick; }
  /// rho of a joint as it is used now.
  Real rho(int joint) const { return is_started() ? cables_.laws.rho(joint) : Real(0); }
  /// Its derivative with respect to the unknown that friction of the joint depends on; 0 if there is none.
  Real rho_slope(int joint) const { return is_started() ? cables_.derivatives.rho_slope(joint) : Real(0); }

  /// How much of what friction can hold at a joint is used, |T1 - T2| / (kappa (T1 + T2)) [-]: 1 where it
  /// slides. For a strut whose foot the cable alone holds that is tan(lambda) / mu, lambda being its angle to
  /// the bisector of the cable; 0 without tension.
  Scalar friction_used(int joint) const {
    const auto& sides = cables_.laws.sides(joint);
    const Real T1 = static_cast<Real>(tension(sides[0])), T2 = static_cast<Real>(tension(sides[1]));
    const Real held = kappa_of(rho(joint)) * (T1 + T2);
    return held > 0 ? static_cast<Scalar>(std::fabs(T1 - T2) / held) : Scalar(0);
  }
  /// By what part of itself displacements have changed the bend of the cable at a joint since the scene was
  /// drawn [-]; 0 in linear theory. Second-order theory is at home up to about 0.1.
  Scalar bend_change(int joint) const {
    if constexpr (Model::has_level)
      if (is_started()) return static_cast<Scalar>(cables_.model->bend[joint]);
    return 0;
  }
  /// Tension of a segment [N], >= 0.
  Scalar tension(int segment) const {
    return cables_.state.tension[segment] > 0 ? cables_.state.tension[segment] : Scalar(0);
  }

  /// Slips, extensions of the jacks and slack lengths [m]. O(segments x inputs).
  SlipState slip_state() const { return cables_.slip_state(); }
  /// Elongations that the slips impose on the segments [m], for CondensedRows.
  Tensions elongations() const { return cables_.elongations_by(slip_state()); }
  /// Elongations that derivatives of the slips impose.
  template <class Moved>
  Tensions elongations_by(const Moved& moved) const {
    return cables_.elongations_by(moved);
  }
  /// Derivative of a tension with respect to the force of an unlocked jack, on the present piece [-].
  Scalar slope(int jack, int segment) const {
    const int k = cables_.input_of(jack);
    return k < 0 ? Scalar(0) : cables_.map.rounded_column(k)[segment];
  }
  /// Derivative of a jack's extension with respect to its force, on the present piece [m/N].
  Scalar extension_slope(int cable, std::size_t end) const {
    const int k = cables_.input_of(cable, end);
    if (k < 0) return 0;
    for (int i = 0; i < cables_.map.active(); ++i)
      if (cables_.map.variable(i).kind == SlipVariable::Kind::extension &&
          cables_.map.variable(i).index == 2 * cable + static_cast<int>(end))
        return static_cast<Scalar>(cables_.map.column_value(k, i));
    return 0;
  }
  /// Derivatives of all slips with respect to the force of an unlocked jack, on the present piece [m/N].
  SlipState slip_slope(int cable, std::size_t end) const {
    SlipState moving;
    const int k = cables_.input_of(cable, end);
    for (int i = 0; k >= 0 && i < cables_.map.active(); ++i)
      moving.of(cables_.map.variable(i)) = cables_.map.column_value(k, i);
    return moving;
  }
  /// Derivative of a tension with respect to unknown `p` [N], at the loads reached.
  Scalar sensitivity(int p, int segment) const {
    if (!cables_.state.has_map) return 0;
    return cables_.derivatives.tension(cables_.map, p, segment, samples_.at(), samples_.anchor());
  }
  /// How that changes with the force of an unlocked jack, on the present piece [-]. Jacks are counted as
  /// for_each_jacked_end() does.
  Scalar sensitivity_slope(int p, int jack, int segment) const {
    const int k = cables_.input_of(jack);
    return k < 0 ? Scalar(0) : cables_.derivatives.tension_slope(p, k, segment);
  }
  /// Derivative of a jack's extension with respect to unknown `p`.
  Scalar extension_sensitivity(int p, int cable, std::size_t end) const {
    return slip_sensitivity(p).extension[cable][end];
  }
  /// Derivatives of slip_state() with respect to unknown `p`.
  taut::SlipState<Scalar, Cap> slip_sensitivity(int p) const {
    if (!cables_.state.has_map) return {};
    Inputs x;
    cables_.values(cables_.state.now, x);
    return cables_.derivatives.slip_state(cables_.map, p, x);
  }

  /// Whether there is a scene. Before start() or restore() there are no model(), condensed(), elongations()
  /// and unstrained(); what else is asked says zero.
  bool is_started() const { return cables_.model != nullptr; }
  /// The condensed scene; in second-order theory, at the level of the forces.
  const Model& model() const { return *cables_.model; }
  /// The loads and jack forces reached.
  const Loads& loads() const { return cables_.state.now; }
  const SlidingSpans<Cap>& spans() const { return cables_.spans; }
  bool is_slack(const typename Cables::Span& span) const { return cables_.is_slack(span.segment(0)); }
  /// What the joint did on the last piece of the path, apart from slack.
  JointState motion(int joint) const {
    for (int i = 0; cables_.state.has_map && i < cables_.map.active(); ++i) {
      if (cables_.map.variable(i).kind != SlipVariable::Kind::slip || cables_.map.variable(i).index != joint)
        continue;
      const Real rate = cables_.map.value_rate(i, cables_.state.last);
      if (rate == 0 || cables_.state.slides[joint] != JointState::stick)
        return rate == 0 ? JointState::stick : cables_.state.slides[joint];
      return rate > 0 ? JointState::forward : JointState::backward;
    }
    return JointState::stick;
  }
  /// The largest force so far, but for what came and went between two events [N].
  Scalar peak() const {
    Scalar most = static_cast<Scalar>(cables_.state.peak);
    for (int i = 0; is_started() && i < cables_.model->segments; ++i)
      most = larger(most, cables_.state.tension[i]);
    return most;
  }

  /// The state at the end of the path followed. Forces of struts only if their rows are given. Before start()
  /// nothing is written.
  void respond(Response<Scalar, Cap>& response,
               const typename CondensedType::Struts* struts = nullptr) const {
    if (!is_started()) return;
    const SlipState moved = cables_.slip_state();
    for (int i = 0; i < cables_.model->segments; ++i) response.tension[i] = tension(i);
    cables_.model->resolve_joints(response);
    for (int c = 0; c < cables_.model->cables.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end)
        response.extension[c][end] = static_cast<Scalar>(
            moved.extension[c][end] * unstrained(c, cables_.model->cables[c].end_segment(end)));
      const auto& cable = cables_.model->cables[c];
      for (int k = 0; k < cable.joints(); ++k) {
        const int j = cable.first_joint + k;
        const auto sides = cable.joint_segments(k);
        response.slip[j] = static_cast<Scalar>(moved.slip[j] * unstrained(c, sides[0]));
        response.state[j] =
            cables_.is_slack(sides[0]) && cables_.is_slack(sides[1]) ? JointState::open : motion(j);
      }
    }
    if (struts == nullptr) return;
    struts->evaluate(*cables_.model, cables_.state.now, cables_.elongations_by(moved), response.strut);
  }

  /// Second-order theory counts cable that moves by its length without tension [-]: a segment that takes up
  /// cable stretches that, too.
  Real unstrained(int c, int segment) const {
    if constexpr (Model::has_level) {
      const Real EA = static_cast<Real>(cables_.model->most_force[c]) * Real(1 / breaking_strain);
      return EA / (EA + static_cast<Real>(tension(segment)));
    }
    return 1;
  }

 protected:
  using Inputs = typename Cables::Inputs;

  Cables cables_;
  SamplePath<Cables> samples_;
};

}  // namespace taut
