// From a scene to its second-order condensation: the forces at the target, and what they make of stiffness.
#pragma once

#include "taut/condensation/condense.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Condenses scenes of one type in second-order theory; as Condensation, it can be thrown away afterwards.
///
/// Geometric stiffness is that of the target's forces, over the lengths that segments have there, Eq. (42).
/// They are found by a fixed point: at first the jack's force in all segments and no thrust in the struts,
/// then all forces and lengths of the round before.
template <class Scalar, class SceneType>
class SecondOrderCondensation {
 public:
  using Cap = typename SceneType::Capacity;
  using Model = SecondOrder<Scalar, Cap>;
  using Real = typename Model::Real;
  using Geometry = GeometricStiffness<Real, Cap>;

  /// Condenses a scene. Fails as Condensation does, there also with `mechanism` where a node is held by
  /// forces at the target that are too small or push it away; with `out_of_range` where no cable has tension
  /// at the target. Where a strut runs away before the target, the forces there are taken in proportion.
  ///
  /// `target` are the loads and jack forces of the state whose geometric stiffness is taken. `displacements`,
  /// if given, receives the rows for the displacements that were chosen in it. Costs eight
  /// condensations, each with a solve more for every strut and beam, and three ways to the target.
  Status run(const SceneType& scene, const Sample<Scalar, Cap>& target, Model& condensed,
             typename Model::Struts* struts = nullptr, const Real* substructure_geometry = nullptr,
             LevelDisplacements<Scalar, Cap>* displacements = nullptr) {
    geometry_ = {};
    lengthened_.fill(Real(0));
    geometry_.substructure_entries = substructure_geometry;
    find_guess(scene, target);
    for (int round = 0;; ++round) {
      const bool is_last = round == rounds;
      const Status status = condense(scene, condensed, !is_last || struts == nullptr ? struts_ : *struts,
                                     is_last ? displacements : nullptr);
      if (!status || is_last) return status;
      if (!take_forces(scene, condensed, target)) round = rounds - 1;
    }
  }
  Real condition() const { return condensation_.condition(); }
  const Geometry& geometry() const { return geometry_; }

 private:
  static constexpr int rounds = 3;
  /// Where the curve between the levels is found.
  static constexpr Real middle_level = Real(0.3);

  /// The largest force of a jack in all segments, or what prestrain gives them.
  void find_guess(const SceneType& scene, const Sample<Scalar, Cap>& target) {
    Real most = 0;
    for (int c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (!scene.cables[c].closed && scene.cables[c].ends[end] == End::jacked)
          most = larger(most, static_cast<Real>(target.jack[c][end].force));
    for (const auto& cable : scene.cables)
      for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
        geometry_.segment_force[i] =
            most > 0 ? most : static_cast<Real>(cable.E * cable.A) * static_cast<Real>(scene.prestrain[i]);
  }
  /// At both levels, with the forces known so far.
  Status condense(const SceneType& scene, Model& condensed, typename Model::Struts& struts,
                  LevelDisplacements<Scalar, Cap>* displacements) {
    condensed.target_force = 0;
    for (int i = 0; i < scene.prestrain.size(); ++i)
      condensed.target_force += geometry_.segment_force[i] * (1 + lengthened_[i]);
    if (!(condensed.target_force > 0)) return Status::at(Code::out_of_range, Place::none, 0);
    struts.count = scene.struts.size();
    for (int i = 0; i < scene.struts.size(); ++i)
      struts.by_own_lean[i] = 1 / StrutElement<Real, SceneType::dimension>::of(scene, i).line.length;
    CondensationRequest<Scalar, Cap> request;
    request.struts = &struts.low;
    if (displacements != nullptr) {
      displacements->rows.count = displacements->of.size();
      request.displaced = &displacements->of;
      request.displacements = &displacements->rows.low;
      request.displacement_by_bar = &displacements->rows.low_by_bar;
    }
    request.tension_by_bar = &condensed.lean.low_tension_by_bar;
    request.strut_by_bar = &struts.low_by_bar;
    geometry_.level = Model::low_level;
    const Status status = condensation_.run(scene, geometry_, condensed.low, request);
    if (!status) return status;
    request.struts = &struts.high;
    request.beams = &beams_;
    request.lean = &condensed.lean;
    request.tension_by_bar = &condensed.lean.tension_by_bar;
    request.strut_by_bar = &struts.by_bar;
    if (displacements != nullptr) {
      request.displacements = &displacements->rows.high;
      request.displacement_by_bar = &displacements->rows.by_bar;
    }
    geometry_.level = Model::high_level;
    const Status stands = condensation_.run(scene, geometry_, condensed.high, request);
    return stands ? find_curve(scene, condensed) : stands;
  }
  /// k of Eq. (47), by least squares of what lies between the two levels.
  Status find_curve(const SceneType& scene, Model& condensed) {
    geometry_.level = middle_level;
    const Status status = condensation_.run(scene, geometry_, middle_, CondensationRequest<Scalar, Cap>());
    const auto &low = condensed.low, &high = condensed.high;
    Real along = 0, all = 0;
    for (int k = 0; k < low.segments; ++k)
      for (int i = 0; i < low.segments; ++i) {
        const Real way = high.coupling(i, k) - low.coupling(i, k);
        along += way * (middle_.coupling(i, k) - low.coupling(i, k));
        all += way * way;
      }
    condensed.curve = all > 0 ? Model::curve_through(middle_level, along / all) : Real(0);
    return status;
  }
  /// What comes of the target with the present geometry; where it is not reached, of where the path ends, in
  /// proportion. False if that is nowhere: then what was stays.
  bool take_forces(const SceneType& scene, const Model& condensed, const Sample<Scalar, Cap>& target) {
    if (!tracker_.start(condensed).status) return false;
    const auto progress = tracker_.advance(target);
    if (!(progress.fraction > Scalar(0.05))) return false;
    const Real by = 1 / static_cast<Real>(progress.fraction);
    const auto e = tracker_.elongations();
    for (int c = 0; c < scene.cables.size(); ++c)
      for (int k = 0; k < scene.cables[c].segments(); ++k) {
        const auto element = CableElement<Real, SceneType::dimension>::of(scene, c, k);
        const int i = scene.cables[c].first_segment + k;
        const Real T = static_cast<Real>(tracker_.tension(i));
        lengthened_[i] = ((T - element.initial) / element.axial - e[i]) / element.line.length;
        geometry_.segment_force[i] = by * T / (1 + lengthened_[i]);
      }
    struts_.evaluate(tracker_.model(), tracker_.loads(), e, geometry_.strut_force);
    beams_.evaluate(tracker_.model(), tracker_.loads(), e, geometry_.beam_force);
    for (int i = 0; i < Cap::struts; ++i) geometry_.strut_force[i] *= by;
    for (int i = 0; i < Cap::beams; ++i) geometry_.beam_force[i] *= by;
    return true;
  }

  Condensation<Scalar, SceneType, Geometry> condensation_;
  typename Model::Linear middle_;
  typename Model::Struts struts_;
  CondensedBeams<Scalar, Cap> beams_;
  Tracker<Model> tracker_;
  Geometry geometry_;
  FixedArray<Real, Cap::segments> lengthened_;  // between their nodes, as a part of the length in the scene
};

}  // namespace taut
