// Where the condensed scenes of a session come from, and what is known of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "monitor/crc32.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/find_friction_prior.hpp"
#include "taut/estimation/gauges.hpp"
#include "taut/status.hpp"

namespace monitor {

/// The strokes that are measurements in a scene: a view of at most `Most`.
template <int Most>
struct Strokes {
  const taut::StrokeGauge<float>* first = nullptr;
  int count = 0;

  static constexpr int capacity() { return Most; }
  /// Zero at compile time where no scene has any, so that loops over them leave no code.
  constexpr int size() const { return Most == 0 ? 0 : count; }
  constexpr const taut::StrokeGauge<float>* begin() const { return first; }
  constexpr const taut::StrokeGauge<float>* end() const { return first + size(); }
};

/// Scenes that `taut export` has condensed, of one capacity and in one theory: constants in flash. Each has
/// Model, model(), prior(), struts(), strut_count, strokes(), stroke_count and, the same for all,
/// unknowns and reading_unknowns.
template <class First, class... Others>
class FromFlash {
 public:
  using Capacity = typename First::Capacity;
  using Model = typename First::Model;
  static constexpr int scenes = 1 + sizeof...(Others);
  static constexpr int unknowns = First::unknowns, reading_unknowns = First::reading_unknowns;

  /// Makes scene `number` the present one.
  taut::Status prepare(int number) {
    number_ = number;
    return taut::Status::success();
  }
  const Model& model() const { return *present().model; }
  const taut::FrictionPrior<float, Capacity>& prior() const { return *present().prior; }
  const typename Model::Struts* struts() const { return present().struts; }
  int strut_count() const { return present().strut_count; }
  using StrokesType = Strokes<std::max({First::stroke_count, Others::stroke_count...})>;
  StrokesType strokes() const { return {present().strokes, present().stroke_count}; }

 private:
  struct Parts {
    const Model* model;
    const taut::FrictionPrior<float, Capacity>* prior;
    const typename Model::Struts* struts;
    int strut_count;
    const taut::StrokeGauge<float>* strokes;
    int stroke_count;
  };
  template <class Exported>
  static constexpr Parts parts_of() {
    static_assert(std::is_same_v<typename Exported::Model, Model> && Exported::unknowns == unknowns &&
                      Exported::reading_unknowns == reading_unknowns,
                  "scenes that share their memory are exported together");
    return {&Exported::model(),    &Exported::prior(),  Exported::struts(),
            Exported::strut_count, Exported::strokes(), Exported::stroke_count};
  }
  static constexpr Parts parts[scenes] = {parts_of<First>(), parts_of<Others>()...};

  const Parts& present() const { return parts[scenes == 1 ? 0 : number_]; }

  int number_ = 0;
};

/// Room for what an Estimator of the scene does not know; self-locking joints have some too, for only
/// condensation tells which they are.
template <class SceneType>
constexpr taut::UnknownCounts most_unknowns(const SceneType& scene) {
  taut::FrictionPrior<float, typename SceneType::Capacity> known{};
  for (int c = 0; c < scene.cables.size(); ++c) {
    known.mu_sd[c] = static_cast<float>(scene.cables[c].mu_sd);
    known.shared[c] = scene.cables[c].shared_mu;
    known.seating_sd[c] = static_cast<float>(scene.cables[c].seating_sd);
    known.drift_sd[c] = static_cast<float>(taut::drift_sd(scene.cables[c]));
    for (std::size_t end = 0; end < 2; ++end)
      known.cell[c][end] = taut::LoadCell<float>::of(scene.cables[c].cell[end]);
  }
  taut::UnknownCounts count = taut::count_unknowns(
      scene.cables, [](int) { return false; }, known, scene.loads);
  if (count.carried == 0) count.carried = 1;
  return count;
}

/// A scene as it was drawn, in flash too, that the device condenses itself when it is chosen. None of its
/// strokes is a measurement.
template <const auto& scene>
class CondensedAtStartUp {
 public:
  using SceneType = std::decay_t<decltype(scene)>;
  using Capacity = typename SceneType::Capacity;
  using Model = taut::Condensed<float, Capacity>;
  static constexpr int scenes = 1;
  static constexpr int unknowns = most_unknowns(scene).carried,
                       reading_unknowns = most_unknowns(scene).further;

  taut::Status prepare(int) {
    const taut::Status status = condensation_.run(scene, condensed_, &struts_);
    if (status) taut::find_friction_prior(scene, prior_);
    return status;
  }
  const Model& model() const { return condensed_; }
  const taut::FrictionPrior<float, Capacity>& prior() const { return prior_; }
  const typename Model::Struts* struts() const { return &struts_; }
  static constexpr int strut_count() { return scene.struts.size(); }
  using StrokesType = Strokes<0>;
  static constexpr StrokesType strokes() { return {}; }

 private:
  taut::Condensation<float, SceneType> condensation_;
  Model condensed_;
  taut::FrictionPrior<float, Capacity> prior_;
  taut::CondensedStruts<float, Capacity> struts_;
};

/// Adds what answers depend on, but what lies between the fields.
template <class Capacity>
void add_scene(Crc32& crc, const taut::Condensed<float, Capacity>& model) {
  const auto add = [&crc](const auto& value) { crc.add(&value, sizeof value); };
  for (const auto& cable : model.cables) {
    add(cable.closed);
    add(cable.ends);
    add(cable.seating);
    add(cable.nodes);
    add(cable.first_segment);
    add(cable.first_joint);
  }
  add(model.segments);
  add(model.joints);
  add(model.loads);
  add(model.coupling);
  if constexpr (Capacity::segments > 0) add(model.prestrain);
  if constexpr (Capacity::loads > 0) add(model.load);
  if constexpr (Capacity::loads > 0) add(model.most_factor);
  add(model.most_force);
  if constexpr (Capacity::joints > 0) add(model.rho);
}
/// In second-order theory also what displacements change.
template <class Capacity>
void add_scene(Crc32& crc, const taut::SecondOrder<float, Capacity>& model) {
  add_scene(crc, model.low);
  const auto add = [&crc](const auto& value) { crc.add(&value, sizeof value); };
  const auto add_rows = [&](const auto& rows) {
    if constexpr (Capacity::loads > 0) add(rows.load);
    add(rows.prestrain);
    add(rows.elongation);
  };
  const auto add_leaning = [&](const auto& leaning) {
    add_rows(leaning.rows);
    if constexpr (Capacity::struts + Capacity::beams > 0) add(leaning.by_bar);
  };
  if constexpr (Capacity::struts + Capacity::beams > 0) add(model.low_by_bar);
  add_leaning(model.rise);
  add_leaning(model.bow);
  if constexpr (Capacity::joints > 0) {
    add_leaning(model.lean.bends);
    add(model.lean.kappa_by_bend);
  }
  add_rows(model.lean.aside);
  add(model.lean.by_own_lean);
  add(model.lean.own_aside);
  if constexpr (Capacity::struts > 0) {
    add_leaning(model.lean.thrust);
    add(model.lean.low_thrust);
    add(model.lean.thrust_rise);
    add(model.lean.thrust_bow);
    if constexpr (Capacity::joints > 0) add(model.lean.bends_by_push);
    add(model.lean.aside_by_push);
  }
  add(model.target_force);
  add(model.curve);
}

/// A number that changes with everything that the scene's answers depend on.
template <class Model, class PriorType, class StrokesType = Strokes<0>>
std::uint32_t fingerprint(const Model& model, const PriorType& prior, const StrokesType& strokes = {}) {
  Crc32 crc;
  const auto add = [&crc](const auto& value) { crc.add(&value, sizeof value); };
  add_scene(crc, model);
  if constexpr (Model::Capacity::joints > 0) {
    add(prior.mu);
    add(prior.contact_factor);
    add(prior.length);
  }
  const int cables = taut::linear_part(model).cables.size();
  for (int c = 0; c < cables; ++c) {
    add(prior.capstan[c]);
    add(prior.mu_sd[c]);
    add(prior.shared[c]);
    add(prior.scatter[c]);
    add(prior.seating_sd[c]);
    add(prior.drift_sd[c]);
    add(prior.cell[c]);
  }
  for (const auto& stroke : strokes) add(stroke);
  return crc.value();
}

}  // namespace monitor
