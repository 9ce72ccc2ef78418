// From a scene to its second-order condensation: the forces at the target, and what they make of stiffness.
#pragma once

#include <array>

#include "taut/condensation/condense.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Condenses scenes of one type in second-order theory; as Condensation, it can be thrown away afterwards.
///
/// Geometric stiffness at each level is that of the forces on the straight way to the target, over the
/// lengths that segments have there, Eq. (42). They are found by a fixed point: at first the jack's force in
/// all segments (where none pulls what prestrain gives, and without either the largest load) and no
/// thrust in the struts, then all forces and lengths of the round before.
template <class Scalar, class SceneType>
class SecondOrderCondensation {
 public:
  using Cap = typename SceneType::Capacity;
  using Model = SecondOrder<Scalar, Cap>;
  using Real = typename Model::Real;
  using Geometry = GeometricStiffness<Real, Cap>;

  /// Condenses a scene. Fails as Condensation does, there also with `mechanism` where a node is held by
  /// forces at the target that are too small or push it away; with `gives_way` at the node that moves or
  /// turns most where members buckle under these forces; with `out_of_range` where no cable has tension
  /// at the target. Where a strut runs away before the target, the forces there are taken in proportion; the
  /// high level is then at twice of them, where that is less.
  ///
  /// `target` are the loads and jack forces of the state whose geometric stiffness is taken. `struts`
  /// receives the rows of strut forces, which the way there needs; they can be left out afterwards.
  /// `substructure_geometry` is null, or has the geometric stiffness of the substructures themselves [N/m] at
  /// the target, an entry for each of theirs in the scene.
  /// `displacements`, if given, receives the rows for the displacements that were chosen in it. Costs twelve
  /// condensations, each with a solve more for every strut and beam, and three ways to the target.
  Status run(const SceneType& scene, const Sample<Scalar, Cap>& target, Model& condensed,
             typename Model::Struts& struts, const Real* substructure_geometry = nullptr,
             LevelDisplacements<Scalar, Cap>* displacements = nullptr) {
    geometry_ = {};
    reach_ = 1;
    way_ = {};
    for (std::size_t l = 0; l < levels.size(); ++l) {
      geometry_[l].level = levels[l];
      geometry_[l].substructure_entries = substructure_geometry;
    }
    find_guess(scene, target);
    for (int round = 0;; ++round) {
      const bool is_last = round == rounds;
      const Status status = condense(scene, condensed, struts, is_last ? displacements : nullptr);
      if (!status || is_last) return status;
      if (take_forces(scene, condensed, target, struts)) {
        is_by_loads_ = false;
        continue;
      }
      if (is_by_loads_) return Status::at(Code::out_of_range, Place::none, 0);
      round = rounds - 1;
    }
  }
  Real condition() const { return condensation_.condition(); }
  /// Of the high level.
  const Geometry& geometry() const { return geometry_[2]; }

 private:
  static constexpr int rounds = 3, most_calls = 64;
  using Curve = LevelCurve<Real>;
  static constexpr std::array<Real, 3> levels = {Curve::low, Curve::middle, Curve::high};
  /// The least part of the target whose forces say something of those there.
  static constexpr Real least_part = Real(0.01);

  /// The largest force of a jack in all segments, or what prestrain gives them, or the largest load on a
  /// node or by temperature.
  void find_guess(const SceneType& scene, const Sample<Scalar, Cap>& target) {
    Real most = 0;
    for (int c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (!scene.cables[c].closed && scene.cables[c].ends[end] == End::jacked)
          most = larger(most, static_cast<Real>(target.jack[c][end].force));
    const auto give = [&](const auto& force) {
      target_force_ = 0;
      for (const auto& cable : scene.cables)
        for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i) {
          const Real T = force(cable, i);
          for (Geometry& geometry : geometry_) geometry.segment_force[i] = T;
          target_force_ += T;
        }
    };
    give([&](const auto& cable, int i) {
      return most > 0 ? most : static_cast<Real>(cable.E * cable.A) * static_cast<Real>(scene.prestrain[i]);
    });
    is_by_loads_ = !(target_force_ > 0);
    if (!is_by_loads_) return;
    for (const auto& given : scene.forces)
      for (const auto component : given.force)
        most = larger(most,
                      std::fabs(static_cast<Real>(target.factor[given.load]) * static_cast<Real>(component)));
    for (const auto& given : scene.temperatures) {
      const auto& cable = scene.cables[given.cable];
      most = larger(most, std::fabs(static_cast<Real>(target.factor[given.load]) *
                                    static_cast<Real>(given.kelvin) * static_cast<Real>(cable.alpha)) *
                              static_cast<Real>(cable.E * cable.A));
    }
    give([&](const auto&, int) { return most; });
  }
  /// At all levels, with the forces known so far.
  Status condense(const SceneType& scene, Model& condensed, typename Model::Struts& struts,
                  LevelDisplacements<Scalar, Cap>* displacements) {
    condensed.target_force = target_force_;
    if (!(target_force_ > 0)) return Status::at(Code::out_of_range, Place::none, 0);
    struts.count = scene.struts.size();
    if (displacements != nullptr) displacements->rows.count = displacements->of.size();

    const auto run = [&](std::size_t level, typename Model::Linear& linear,
                         RowsByBar<Real, Cap::segments, Cap>& by_bar, auto rows_at) {
      CondensationRequest<Scalar, Cap> request;
      request.struts = &rows_at(struts).rows;
      request.strut_by_bar = &rows_at(struts).by_bar;
      request.tension_by_bar = &by_bar;
      if (level == 2) {
        request.beams = &beams_;
        request.lean = &condensed.lean;
        request.strut_by_push = &struts.by_push;
        if (displacements != nullptr) request.displacement_by_push = &displacements->rows.by_push;
      }
      if (displacements != nullptr) {
        request.displaced = &displacements->of;
        request.displacements = &rows_at(displacements->rows).rows;
        request.displacement_by_bar = &rows_at(displacements->rows).by_bar;
      }
      return condensation_.run(scene, geometry_[level], linear, request);
    };
    Status status = run(
        0, condensed.low, condensed.low_by_bar, [](auto& rows) -> auto& { return rows.low; });
    if (status)
      status = run(
          1, middle_, condensed.bow.by_bar, [](auto& rows) -> auto& { return rows.bow; });
    if (status)
      status = run(
          2, high_, condensed.rise.by_bar, [](auto& rows) -> auto& { return rows.rise; });
    if (!status) return status;
    split(condensed);
    take_thrusts(condensed);
    struts.split(condensed);
    if (displacements != nullptr) displacements->rows.split(condensed);
    return status;
  }
  /// The forces of struts on the way to the target, by the rows that say how they differ from it: as long as
  /// it was not gone they differ by nothing.
  void take_thrusts(Model& condensed) const {
    auto& lean = condensed.lean;
    auto &low = lean.low_thrust, &bow = lean.thrust_bow, &rise = lean.thrust_rise;
    low.fill(Real(0));
    bow = rise = low;
    for (int b = 0; b < lean.struts; ++b) {
      if (!(way_[2].part > 0)) {
        lean.thrust.rows.prestrain[b] = 0;
        for (int k = 0; k < condensed.low.loads; ++k) lean.thrust.rows.load[k][b] = 0;
        for (int k = 0; k < condensed.low.segments; ++k) lean.thrust.rows.elongation[k][b] = 0;
      }
      const auto on_way = [&](std::size_t l) {
        const auto& at = way_[l];
        return at.part * (number_of(lean.thrust.rows, b, condensed.low, at.loads, at.e) +
                          stretched(lean.thrust, b, lean, condensed.low.segments, at.stretch));
      };
      low[b] = on_way(0);
      bow[b] = on_way(1);
      rise[b] = on_way(2);
      Curve{}.split(low[b], bow[b], rise[b]);
    }
  }
  /// Makes of the tensions at the three levels what Eq. (48) adds to the lowest.
  void split(Model& condensed) const {
    const auto& low = condensed.low;
    auto &bow = condensed.bow, &rise = condensed.rise;
    bow.rows.prestrain = middle_.prestrain;
    rise.rows.prestrain = high_.prestrain;
    bow.rows.load = middle_.load;
    rise.rows.load = high_.load;
    LevelCurveFit<Real> fit;
    for (int k = 0; k < low.segments; ++k)
      for (int i = 0; i < low.segments; ++i) {
        bow.rows.elongation[k][i] = middle_.coupling(i, k);
        rise.rows.elongation[k][i] = high_.coupling(i, k);
        fit.add(low.coupling(i, k), middle_.coupling(i, k), high_.coupling(i, k));
      }
    condensed.curve = fit.found();
    const auto& curve = condensed.curve;
    for (int i = 0; i < low.segments; ++i) {
      curve.split(low.prestrain[i], bow.rows.prestrain[i], rise.rows.prestrain[i]);
      for (int k = 0; k < low.loads; ++k)
        curve.split(low.load[k][i], bow.rows.load[k][i], rise.rows.load[k][i]);
      for (int k = 0; k < low.segments; ++k)
        curve.split(low.coupling(i, k), bow.rows.elongation[k][i], rise.rows.elongation[k][i]);
      condensed.lean.for_each_bar(0, [&](int bar) {
        const int b = bar - Cap::segments;
        curve.split(condensed.low_by_bar[b][i], bow.by_bar[b][i], rise.by_bar[b][i]);
      });
    }
  }
  /// The forces on the way to the target with the present geometry, as parts of what all tensions are there.
  /// Where the way ends earlier, the target comes nearer. False if that is nowhere: then what was stays.
  bool take_forces(const SceneType& scene, const Model& condensed, const Sample<Scalar, Cap>& target,
                   const typename Model::Struts& struts) {
    if (!tracker_.start(condensed).status) return false;
    std::array<Real, 3> sums{};
    Real reached = 0;  // a part of the way
    auto found = geometry_;
    auto way = way_;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      if (l == 0 || !(reached < levels[l - 1])) {
        reached += follow(part_of(scene, target, reach_ * levels[l])) * (levels[l] - reached);
      }
      sums[l] = take_state(scene, struts, found[l]);
      way[l].loads = tracker_.loads();
      way[l].e = tracker_.elongations();
      const auto& model = tracker_.model();
      way[l].stretch = model.leant_at(way[l].loads, way[l].e, model.level_at(way[l].loads, way[l].e)).stretch;
    }
    if (!(reached * reach_ > least_part && sums[2] > 0)) return false;
    const Real ended = reached > Curve::middle ? reached : Curve::middle;
    reach_ *= reached / ended;
    target_force_ = sums[2] / ended;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      const Real by = target_force_ / sums[l];
      way[l].part = by * levels[l];
      for (int i = 0; i < Cap::segments; ++i) found[l].segment_force[i] *= by;
      for (int i = 0; i < Cap::struts; ++i) found[l].strut_force[i] *= by;
      for (int i = 0; i < Cap::beams; ++i) found[l].beam_force[i] *= by;
    }
    geometry_ = found;
    way_ = way;
    return true;
  }
  /// The part of the way to a sample that can be gone.
  Real follow(const Sample<Scalar, Cap>& sample) {
    Real rest = 1;
    for (int call = 0; call < most_calls; ++call) {
      const auto progress = tracker_.advance(sample);
      rest *= 1 - static_cast<Real>(progress.fraction);
      // Else only the events of a call were spent.
      if (!progress.status || progress.fraction >= 1) break;
    }
    return 1 - rest;
  }
  Sample<Scalar, Cap> part_of(const SceneType& scene, const Sample<Scalar, Cap>& target, Real part) const {
    Sample<Scalar, Cap> sample = target;
    for (int k = 0; k < scene.loads; ++k) sample.factor[k] *= static_cast<Scalar>(part);
    for (int c = 0; c < scene.cables.size(); ++c)
      for (auto& jack : sample.jack[c]) jack.force *= static_cast<Scalar>(part);
    return sample;
  }
  /// The forces that the tracker has come to; gives the sum of all tensions [N].
  Real take_state(const SceneType& scene, const typename Model::Struts& struts, Geometry& geometry) const {
    const auto e = tracker_.elongations();
    Real sum = 0;
    for (int c = 0; c < scene.cables.size(); ++c)
      for (int k = 0; k < scene.cables[c].segments(); ++k) {
        const auto element = CableElement<Real, SceneType::dimension>::of(scene, c, k);
        const int i = scene.cables[c].first_segment + k;
        const Real T = static_cast<Real>(tracker_.tension(i));
        const Real longer = ((T - element.initial) / element.axial - e[i]) / element.line.length;
        geometry.segment_force[i] = T / (1 + longer);
        sum += T;
      }
    struts.evaluate(tracker_.model(), tracker_.loads(), e, geometry.strut_force);
    beams_.evaluate(tracker_.model(), tracker_.loads(), e, geometry.beam_force);
    return sum;
  }

  Condensation<Scalar, SceneType, Geometry> condensation_;
  typename Model::Linear middle_, high_;
  CondensedBeams<Scalar, Cap> beams_;
  Tracker<Model> tracker_;
  std::array<Geometry, 3> geometry_;  // of every level
  /// Where the way to the target was at every level, and by what its forces are those of the level.
  struct Waypoint {
    Drive<Real, Cap> loads;
    typename Model::AtLevel::Tensions e;
    typename Model::AtLevel::Stretches stretch;
    Real part = 0;
  };
  std::array<Waypoint, 3> way_;
  Real target_force_ = 0;     // of all segments together at the high level [N]
  Real reach_ = 1;            // the part of the target that is the high level
  bool is_by_loads_ = false;  // neither a jack nor prestrain has said yet how large forces are
};

}  // namespace taut
