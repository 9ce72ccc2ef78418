// Static condensation: from a scene to the arrays of Condensed, once.
#pragma once

#include <cmath>

#include "taut/condensation/condensed.hpp"
#include "taut/condensation/structure.hpp"
#include "taut/elements/joint_lean.hpp"
#include "taut/scene/validation.hpp"

namespace taut {

/// What Condensation is asked for beside the condensed scene; null: not asked for.
template <class Scalar, class Cap>
struct CondensationRequest {
  using Real = Wide<Scalar>;

  CondensedStruts<Scalar, Cap>* struts = nullptr;
  CondensedBeams<Scalar, Cap>* beams = nullptr;
  const FixedList<NodeAxis, Cap::displacements>* displaced = nullptr;  ///< what `displacements` are of
  CondensedRows<Real, max_displacements<Cap>, Cap>* displacements = nullptr;
  /// What displacements change, Eqs. (44) to (46).
  CondensedLean<Scalar, Cap>* lean = nullptr;
  /// What tensions, struts and displacements have of a unit elongation of every strut and beam.
  RowsByBar<Real, Cap::segments, Cap>* tension_by_bar = nullptr;
  RowsByBar<Real, Cap::struts, Cap>* strut_by_bar = nullptr;
  RowsByBar<Real, max_displacements<Cap>, Cap>* displacement_by_bar = nullptr;
  /// What struts and displacements have of a unit push of every strut; asked for with `lean`.
  RowsByPush<Real, Cap::struts, Cap>* strut_by_push = nullptr;
  RowsByPush<Real, max_displacements<Cap>, Cap>* displacement_by_push = nullptr;
};

/// Condenses scenes of one type; the object holds the structure's factor and can be thrown away afterwards.
///
/// One factorization, then one solve of Eq. (7) for each load pattern, the prestrain, and each segment.
/// `Geometry`: see Structure.
template <class Scalar, class SceneType, class Geometry = NoGeometry>
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
    CondensationRequest<Scalar, Cap> request;
    request.struts = struts;
    if (displacements != nullptr) {
      request.displaced = &displacements->of;
      request.displacements = &displacements->rows;
    }
    return run(scene, Geometry(), condensed, request);
  }
  /// The same with geometric stiffness, and with all that can be asked for.
  Status run(const SceneType& scene, const Geometry& geometry, Condensed<Scalar, Cap>& condensed,
             const CondensationRequest<Scalar, Cap>& request) {
    Status status = validate(scene);
    if (!status) return status;
    scene_ = &scene;
    geometry_ = &geometry;
    asked_ = request;
    if (asked_.displaced != nullptr) status = check(*asked_.displaced);
    if (!status) return status;
    condensed = {};
    condensed.segments = scene.prestrain.size();
    condensed.joints = scene.mu.size();
    condensed.loads = scene.loads;
    for (const auto& cable : scene.cables)
      condensed.cables.add({cable.closed, cable.ends, static_cast<Scalar>(cable.seating), cable.nodes,
                            cable.first_segment, cable.first_joint});
    if constexpr (has_rigid_saddles<Cap>)
      status = rigid(condensed);
    else
      status = elastic(condensed);
    if (status) limit(condensed);
    return status ? check_capacity(condensed) : status;
  }

  /// See Structure::condition(); 1 between rigid saddles.
  Wide<Scalar> condition() const {
    if constexpr (has_rigid_saddles<Cap>)
      return 1;
    else
      return structure_.condition();
  }

 private:
  static constexpr bool has_geometry = !std::is_same<Geometry, NoGeometry>::value;
  struct Nothing {};
  using Solver =
      std::conditional_t<has_rigid_saddles<Cap>, Nothing, Structure<Wide<Scalar>, SceneType, Geometry>>;

  using Real = Wide<Scalar>;
  using Given = typename SceneType::Scalar;
  /// Of a load that no cable feels.
  static constexpr Scalar farthest_factor = Scalar(1e15);
  static constexpr auto no_force = [](int, int) { return Real(0); };

  void set_joint(Condensed<Scalar, Cap>& condensed, int j, const FrictionElement<Real, dimension>& element) {
    condensed.rho[j] = element.limit.rho();
    condensed.cos_alpha[j] = static_cast<Scalar>(element.frame.cos_alpha);
    condensed.sin_alpha[j] = static_cast<Scalar>(element.frame.sin_alpha);
  }

  /// What samples may ask for.
  void limit(Condensed<Scalar, Cap>& condensed) const {
    condensed.most_factor.fill(farthest_factor);
    for (int c = 0; c < scene_->cables.size(); ++c) {
      const auto& cable = scene_->cables[c];
      const Real carried =
          static_cast<Real>(breaking_strain) * static_cast<Real>(cable.E) * static_cast<Real>(cable.A);
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

  Status elastic(Condensed<Scalar, Cap>& condensed) {
    Status status = structure_.make(*scene_, *geometry_);
    if (!status) return status;
    const auto& elements = structure_.elements();
    for (int j = 0; j < condensed.joints; ++j) set_joint(condensed, j, elements.joints[j]);
    // Keeps the last solution as tensions, and in the row of requested rows that `row` points at.
    const auto store = [&](auto imposed, FixedArray<Real, Cap::segments>& tensions, auto row) {
      for (int i = 0; i < condensed.segments; ++i) tensions[i] = structure_.tension(i, imposed(i));
      for (int i = 0; asked_.struts != nullptr && i < scene_->struts.size(); ++i)
        (*row(*asked_.struts))[i] = structure_.strut_force(i);
      for (int i = 0; asked_.displacements != nullptr && i < asked_.displaced->size(); ++i)
        (*row(*asked_.displacements))[i] = displacement(i);
      if constexpr (Cap::beams > 0)
        for (int i = 0; asked_.beams != nullptr && i < scene_->beams.size(); ++i)
          (*row(*asked_.beams))[i] = structure_.beam_force(i);
      if constexpr (has_geometry) {
        if (asked_.lean == nullptr) return;
        for (int i = 0; i < scene_->struts.size(); ++i)
          (*row(asked_.lean->thrust.rows))[i] = structure_.strut_force(i);
        store_bends(*row(asked_.lean->bends.rows));
        store_asides(*row(asked_.lean->aside));
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
    if constexpr (has_geometry)
      if (asked_.tension_by_bar != nullptr) {
        status = lengthen_bars(condensed);
        if (status && asked_.lean != nullptr) status = push_struts();
      }
    return status;
  }
  /// What a unit elongation of every strut and beam does, and how friction follows the bend of the cable.
  Status lengthen_bars(const Condensed<Scalar, Cap>& condensed) {
    const int struts = scene_->struts.size();
    int beams = 0;
    if constexpr (Cap::beams > 0) beams = scene_->beams.size();
    const auto none = [](int) { return Real(0); };
    if (asked_.lean != nullptr) {
      asked_.lean->struts = struts;
      asked_.lean->beams = beams;
      for_each_bar(
          [&](int bar, const auto&, const auto& line) { asked_.lean->by_own_lean[bar] = 1 / line.length; });
      for (int n = 0; n < condensed.segments * Cap::normals; ++n)
        asked_.lean->own_aside[n] = asked_.lean->aside.elongation[n / Cap::normals][n];
      for (int j = 0; j < condensed.joints; ++j)
        asked_.lean->kappa_by_bend[j] =
            JointLean<Real, dimension>::kappa_by_bend(structure_.elements().joints[j]);
    }
    for (int b = 0; b < struts + beams; ++b) {
      const auto unit = [b](int i) { return i == b ? Real(1) : Real(0); };
      const Status status = structure_.solve(no_force, none, unit);
      if (!status) return status;
      const int to = b < struts ? b : Cap::struts + b - struts;
      for (int i = 0; i < condensed.segments; ++i)
        (*asked_.tension_by_bar)[to][i] = structure_.tension(i, Real(0));
      for (int i = 0; asked_.strut_by_bar != nullptr && i < struts; ++i)
        (*asked_.strut_by_bar)[to][i] = structure_.strut_force(i, unit(i));
      if (asked_.lean != nullptr) {
        for (int i = 0; i < struts; ++i)
          asked_.lean->thrust.by_bar[to][i] = structure_.strut_force(i, unit(i));
        store_bends(asked_.lean->bends.by_bar[to]);
        if (b < struts) keep_own_aside(Cap::segments + to, structure_.elements().struts[b]);
        if constexpr (Cap::beams > 0)
          if (b >= struts) keep_own_aside(Cap::segments + to, structure_.elements().beams[b - struts]);
      }
      for (int i = 0; asked_.displacement_by_bar != nullptr && i < asked_.displaced->size(); ++i)
        (*asked_.displacement_by_bar)[to][i] = displacement(i);
    }
    return Status::success();
  }
  /// What a unit push of every strut along each of its normals does.
  Status push_struts() {
    const auto none = [](int) { return Real(0); };
    for (int b = 0; b < scene_->struts.size(); ++b)
      for (int n = 0; n < dimension - 1; ++n) {
        const auto& strut = structure_.elements().struts[b];
        const auto across = unit_aside(strut.line, n);
        // Against the side that it leans to, so that a push is energy by aside.
        const auto pushed = [&](int node, int axis) {
          return (node == strut.nodes[0] ? across[axis] : Real(0)) -
                 (node == strut.nodes[1] ? across[axis] : Real(0));
        };
        const Status status = structure_.solve(pushed, none);
        if (!status) return status;
        const int to = b * Cap::normals + n;
        for (int i = 0; asked_.strut_by_push != nullptr && i < scene_->struts.size(); ++i)
          (*asked_.strut_by_push)[to][i] = structure_.strut_force(i);
        for (int i = 0; asked_.displacement_by_push != nullptr && i < asked_.displaced->size(); ++i)
          (*asked_.displacement_by_push)[to][i] = displacement(i);
        store_bends(asked_.lean->bends_by_push[to]);
        store_asides(asked_.lean->aside_by_push[to]);
      }
    return Status::success();
  }
  /// By what part of itself the cable bends more at every joint in the last solution.
  void store_bends(FixedArray<Real, Cap::joints>& bends) const {
    for (int c = 0; c < scene_->cables.size(); ++c)
      for (int j = 0; j < scene_->cables[c].joints(); ++j)
        bends[scene_->cables[c].first_joint + j] = bend_change(c, j);
  }
  /// How bars lean in it.
  void store_asides(FixedArray<Real, max_bars<Cap> * Cap::normals>& asides) const {
    for_each_bar([&](int bar, const auto& nodes, const auto& line) {
      for (int n = 0; n < Cap::normals; ++n) asides[bar * Cap::normals + n] = aside(nodes, line, n);
    });
  }
  /// Of a bar that was lengthened in the last solution.
  template <class Element>
  void keep_own_aside(int bar, const Element& element) {
    for (int n = 0; n < Cap::normals; ++n)
      asked_.lean->own_aside[bar * Cap::normals + n] = aside(element.nodes, element.line, n);
  }
  /// One of those asked for, in the last solution [m].
  Real displacement(int i) const {
    const NodeAxis& wanted = (*asked_.displaced)[i];
    return structure_.node_displacement(wanted.node, wanted.axis);
  }
  /// Visits segments, struts and beams with their numbers among all bars.
  template <class Visit>
  void for_each_bar(Visit visit) const {
    const auto& elements = structure_.elements();
    for (int i = 0; i < scene_->prestrain.size(); ++i)
      visit(i, elements.segments[i].nodes, elements.segments[i].line);
    for (int i = 0; i < scene_->struts.size(); ++i)
      visit(Cap::segments + i, elements.struts[i].nodes, elements.struts[i].line);
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i)
        visit(Cap::segments + Cap::struts + i, elements.beams[i].nodes, elements.beams[i].line);
  }
  /// How far the ends of a bar move apart across it in the last solution, along its normal `n`, by the root
  /// of twice its length [m^1/2].
  Real aside(const std::array<int, 2>& nodes, const Line<Real, dimension>& line, int n) const {
    if (n >= dimension - 1) return 0;
    Eigen::Matrix<Real, dimension, 1> apart;
    for (int axis = 0; axis < dimension; ++axis)
      apart[axis] =
          structure_.node_displacement(nodes[1], axis) - structure_.node_displacement(nodes[0], axis);
    return unit_aside(line, n).dot(apart);
  }
  /// The normal `n` of a bar by the root of twice its length.
  static Eigen::Matrix<Real, dimension, 1> unit_aside(const Line<Real, dimension>& line,
                                                      [[maybe_unused]] int n) {
    Eigen::Matrix<Real, dimension, 1> normal;
    if constexpr (dimension == 2) {
      normal << -line.direction[1], line.direction[0];
    } else {
      int smallest = 0;
      line.direction.cwiseAbs().minCoeff(&smallest);
      normal = line.direction.cross(Eigen::Matrix<Real, 3, 1>::Unit(smallest)).normalized();
      if (n == 1) normal = line.direction.cross(normal).eval();
    }
    return normal / std::sqrt(2 * line.length);
  }

  /// Of the cable at a joint by the displacements of the last solution, to first order.
  Real bend_change(int c, int j) const {
    const auto& cable = scene_->cables[c];
    const auto at = scene_->joint_nodes(cable, j);
    JointLean<Real, dimension> lean;
    for (int axis = 0; axis < dimension; ++axis) {
      const Real here = structure_.node_displacement(at.at, axis);
      lean.before[axis] = structure_.node_displacement(at.before, axis) - here;
      lean.after[axis] = structure_.node_displacement(at.after, axis) - here;
    }
    return lean.bend_change(Line<Real, dimension>::between(scene_->nodes[at.at], scene_->nodes[at.before]),
                            Line<Real, dimension>::between(scene_->nodes[at.at], scene_->nodes[at.after]));
  }

  Real nodal_force(int load, int node, int axis) const {
    Given sum = 0;
    for (const auto& given : scene_->forces)
      if (given.load == load && given.node == node) sum += given.force[static_cast<std::size_t>(axis)];
    return static_cast<Real>(sum);
  }

  const SceneType* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  CondensationRequest<Scalar, Cap> asked_;
  Solver structure_;
};

}  // namespace taut
