// Static condensation: from a scene to the arrays of Condensed, once.
#pragma once

#include <cmath>

#include "taut/condensation/condensed.hpp"
#include "taut/condensation/structure.hpp"
#include "taut/scene/validation.hpp"

namespace taut {

/// Condenses scenes of one type; the object holds the structure's factor and can be thrown away afterwards.
///
/// One factorization, then one solve of Eq. (7) for each load pattern, the prestrain, and each segment.
template <class Scalar, class SceneType>
class Condensation {
 public:
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;

  /// Condenses a scene. Fails as validate() does, or with `mechanism` or `ill_conditioned`.
  ///
  /// `struts`, if given, receives the rows for strut forces, `displacements` those for the displacements that
  /// were chosen in it. Fails with `capacity_exceeded` if too many were, and with `out_of_range` at a node
  /// that is not in the scene or has no such axis.
  Status run(const SceneType& scene, Condensed<Scalar, Cap>& condensed,
             CondensedStruts<Scalar, Cap>* struts = nullptr,
             CondensedDisplacements<Scalar, Cap>* displacements = nullptr) {
    Status status = validate(scene);
    if (!status) return status;
    scene_ = &scene;
    if (displacements != nullptr) status = check(displacements->of);
    if (!status) return status;
    condensed = {};
    condensed.segments = scene.prestrain.size();
    condensed.joints = scene.mu.size();
    condensed.loads = scene.loads;
    for (const auto& cable : scene.cables)
      condensed.cables.add({cable.closed, cable.ends, static_cast<Scalar>(cable.seating), cable.nodes,
                            cable.first_segment, cable.first_joint});
    if constexpr (has_rigid_saddles<Cap>) {
      static_cast<void>(struts);
      status = rigid(condensed);
    } else {
      status = elastic(condensed, struts, displacements);
    }
    if (status) limit(condensed);
    return status;
  }

  /// See Structure::condition(); 1 between rigid saddles.
  Wide<Scalar> condition() const {
    if constexpr (has_rigid_saddles<Cap>)
      return 1;
    else
      return structure_.condition();
  }

 private:
  struct Nothing {};
  using Solver = std::conditional_t<has_rigid_saddles<Cap>, Nothing, Structure<Wide<Scalar>, SceneType>>;

  using Real = Wide<Scalar>;
  using Given = typename SceneType::Scalar;
  /// Of a load that no cable feels.
  static constexpr Scalar farthest_factor = Scalar(1e15);
  static constexpr auto no_force = [](int, int) { return Real(0); };

  void set_joint(Condensed<Scalar, Cap>& condensed, int j, const FrictionElement<Real, dimension>& element) {
    condensed.rho[j] = element.grip.rho();
    condensed.cos_alpha[j] = static_cast<Scalar>(element.frame.cos_alpha);
    condensed.sin_alpha[j] = static_cast<Scalar>(element.frame.sin_alpha);
  }

  /// What samples may ask for.
  void limit(Condensed<Scalar, Cap>& condensed) const {
    condensed.most_factor.fill(farthest_factor);
    for (int c = 0; c < scene_->cables.size(); ++c) {
      const auto& cable = scene_->cables[c];
      const Real carried = Real(0.1) * static_cast<Real>(cable.E) * static_cast<Real>(cable.A);
      condensed.most_force[c] = static_cast<Scalar>(carried);
      // Loads may well cancel one another.
      const Real absurd = 100 * carried;
      for (int load = 0; load < condensed.loads; ++load)
        for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
          const auto tension = std::fabs(condensed.load[load][i]);
          Scalar& most = condensed.most_factor[load];
          if (tension * static_cast<Real>(most) > absurd) most = static_cast<Scalar>(absurd / tension);
        }
    }
  }

  /// Kelvin that a unit of a load pattern warms a cable by.
  Real warming(int load, int cable) const {
    Real kelvin = 0;
    for (const auto& change : scene_->temperatures)
      if (change.load == load && change.cable == cable) kelvin += static_cast<Real>(change.kelvin);
    return kelvin;
  }

  Status check(const FixedList<NodeAxis, Cap::displacements>& wanted) const {
    if (wanted.excess() > 0)
      return Status::at(Code::capacity_exceeded, Place::none, wanted.capacity(), wanted.excess());
    for (const NodeAxis& each : wanted)
      if (each.node < 0 || each.node >= scene_->nodes.size() || each.axis < 0 || each.axis >= dimension)
        return Status::at(Code::out_of_range, Place::node, each.node);
    return Status::success();
  }

  /// Rigid saddles: no structure, every segment for itself.
  Status rigid(Condensed<Scalar, Cap>& condensed) {
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < dimension; ++axis)
        if (!scene_->nodes[node].is_held(axis)) return Status::at(Code::mechanism, Place::node, node);
    for (int c = 0; c < scene_->cables.size(); ++c) {
      const auto& cable = scene_->cables[c];
      for (int i = 0; i < cable.segments(); ++i) {
        const auto element = CableElement<Real, dimension>::of(*scene_, c, i);
        const int segment = cable.first_segment + i;
        condensed.coupling.set(segment, segment, element.axial);
        condensed.prestrain[segment] = element.initial;
        for (int load = 0; load < scene_->loads; ++load)
          condensed.load[load][segment] = -element.thermal * warming(load, c);
      }
      for (int j = 0; j < cable.joints(); ++j)
        set_joint(condensed, cable.first_joint + j, FrictionElement<Real, dimension>::of(*scene_, c, j));
    }
    return Status::success();
  }

  Status elastic(Condensed<Scalar, Cap>& condensed, CondensedStruts<Scalar, Cap>* struts,
                 CondensedDisplacements<Scalar, Cap>* displacements) {
    Status status = structure_.make(*scene_);
    if (!status) return status;
    const auto& elements = structure_.elements();
    for (int j = 0; j < condensed.joints; ++j) set_joint(condensed, j, elements.joints[j]);
    // Keeps the last solution as tensions, and in the row of requested rows that `row` points at.
    const auto store = [&](auto imposed, FixedArray<Real, Cap::segments>& tensions, auto row) {
      for (int i = 0; i < condensed.segments; ++i) tensions[i] = structure_.tension(i, imposed(i));
      for (int i = 0; struts != nullptr && i < scene_->struts.size(); ++i)
        (*row(*struts))[i] = structure_.strut_force(i);
      for (int i = 0; displacements != nullptr && i < displacements->of.size(); ++i) {
        const NodeAxis& wanted = displacements->of[i];
        (*row(displacements->rows))[i] = structure_.node_displacement(wanted.node, wanted.axis);
      }
    };

    const auto prestrained = [&](int i) { return elements.segments[i].initial / elements.segments[i].axial; };
    status = structure_.solve(no_force, prestrained);
    if (!status) return status;
    store(prestrained, condensed.prestrain, [](auto& rows) { return &rows.prestrain; });

    for (int load = 0; load < scene_->loads; ++load) {
      const auto force = [&](int node, int axis) { return nodal_force(load, node, axis); };
      const auto warmed = [&](int i) {
        const auto& segment = elements.segments[i];
        return -segment.thermal * warming(load, segment.cable) / segment.axial;
      };
      status = structure_.solve(force, warmed);
      if (!status) return status;
      store(warmed, condensed.load[load], [load](auto& rows) { return &rows.load[load]; });
    }

    FixedArray<Real, Cap::segments> column;
    for (int k = 0; k < condensed.segments; ++k) {
      const auto unit = [k](int i) { return i == k ? Real(1) : Real(0); };
      status = structure_.solve(no_force, unit);
      if (!status) return status;
      store(unit, column, [k](auto& rows) { return &rows.elongation[k]; });
      for (int i = 0; i < condensed.segments; ++i) condensed.coupling.set(i, k, column[i]);
    }
    return Status::success();
  }

  Real nodal_force(int load, int node, int axis) const {
    Given sum = 0;
    for (const auto& given : scene_->forces)
      if (given.load == load && given.node == node) sum += given.force[static_cast<std::size_t>(axis)];
    return static_cast<Real>(sum);
  }

  const SceneType* scene_ = nullptr;
  Solver structure_;
};

}  // namespace taut
