// The method `estimate` as a Model.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "lib/kinds/capacities.hpp"
#include "lib/kinds/condense_scene.hpp"
#include "lib/kinds/large_objects.hpp"
#include "lib/kinds/learned_mu.hpp"
#include "lib/kinds/model.hpp"
#include "lib/kinds/scene_gauges.hpp"
#include "lib/kinds/solver_values.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/unknown_past.hpp"

namespace taut::host {

template <class Scalar, class Cap>
class EstimatorModel : public Model {
 public:
  EstimatorModel(const SceneDescription& scene, const AlarmLimits<double>& limits)
      : scene_(scene),
        limits_(AlarmLimits<Scalar>::of(limits)),
        condensed_(make_zeroed<CondensedType>()),
        struts_(make_zeroed<StrutRows>()),
        displacements_(asks_for_displacements(scene) ? make_zeroed<Displacements>() : nullptr),
        prior_(new PriorType),
        estimator_(new EstimatorType),
        readings_(new ReadingsType) {}

  Followed start(int) override {
    const Status known = know();
    if (!known) return {known, 0};
    const auto progress = estimator_->start(*condensed_, *prior_, limits_, cells_);
    before_ = FrictionBefore::of(*estimator_, linear_part(*condensed_).joints);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  std::string save() const override {
    const auto state = std::make_unique<State>(estimator_->save());
    return {reinterpret_cast<const char*>(state.get()), sizeof(State)};
  }
  Followed restore(const std::string& bytes, double time) override {
    const Status known = know();
    if (!known) return {known, 0};
    if (bytes.size() != sizeof(State)) return {Status::at(Code::bad_sample, Place::none, 0), 0};
    const auto state = std::make_unique<State>();
    std::memcpy(static_cast<void*>(state.get()), bytes.data(), sizeof(State));
    const Status restored = estimator_->restore(*condensed_, *prior_, *state, limits_, cells_);
    before_ = FrictionBefore::of(*estimator_, linear_part(*condensed_).joints);
    time_ = time;
    has_row_ = true;
    return {restored, restored ? 1.0 : 0.0};
  }
  Followed advance(const LogRow& row, int) override {
    read_row(row, scene_, has_row_ && row.time > time_ ? row.time - time_ : 1, *readings_);
    time_ = row.time;
    has_row_ = true;
    if (past_) {
      past_->look(*condensed_, *prior_, *readings_);
      if (!past_->is_unknown()) past_.reset();
    }
    if (past_) past_->withhold(*condensed_, *readings_);
    const auto progress = estimator_->advance(*readings_);
    const Followed below = {progress.status, static_cast<double>(progress.fraction)};
    if (!below.whole()) return below;
    if (past_) return advance_past();
    take_gauges(row);
    return below;
  }
  void forget_past() override {
    doubt_past();
    past_->forget();
  }
  void doubt_past() override { past_ = make_default<PastType>(); }
  void deny_past() override { past_.reset(); }
  bool has_unknown_past() const override { return past_ != nullptr; }
  std::vector<LearnedFriction> learned() const override {
    // Of a scene that cannot be condensed nothing is known.
    if (!is_known_) return {};
    return learned_mu(*estimator_, linear_part(*condensed_), *prior_, before_, scene_);
  }
  std::vector<StrutEstimate> struts() const override {
    if (!is_known_) return std::vector<StrutEstimate>(scene_.struts.size());
    std::vector<StrutEstimate> all;
    for (std::size_t i = 0; i < scene_.struts.size(); ++i) {
      const int strut = static_cast<int>(i);
      const auto found = past_ ? past_->estimate_strut(*estimator_, *struts_, strut)
                               : estimator_->estimate_strut(*struts_, strut);
      all.push_back({static_cast<double>(found.force), static_cast<double>(found.deviation)});
    }
    return all;
  }
  std::vector<double> watched() const override {
    std::vector<double> found;
    read_displacements(displacements_.get(), estimator_->tracker(), scene_.displaced.size(),
                       scene_.watched.size(), found);
    return found;
  }
  void read(Answer& answer) const override {
    Response<Scalar, Cap> response;
    estimator_->respond(response, struts_.get());
    if (past_) past_->respond(*estimator_, response);
    read_response(response, scene_, answer);
    read_certainty(*estimator_, scene_, answer);
    read_lean(estimator_->tracker(), scene_, answer);
    if (!past_) return;
    for (int i = 0; i < linear_part(*condensed_).segments; ++i)
      answer.deviation[static_cast<std::size_t>(i)] =
          static_cast<double>(past_->estimate(*estimator_, i).deviation);
    const auto& cables = linear_part(*condensed_).cables;
    for (int c = 0; c < cables.size(); ++c)
      if (!past_->is_wiped_out(*estimator_, cables[c]))
        add_alarm(Alarm::of(Alarm::Kind::unknown_past, c, 0), scene_, answer);
  }

 private:
  using CondensedType = CondensedOf<Scalar, Cap>;
  using Displacements = DisplacementsOf<Scalar, Cap>;
  using StrutRows = StrutsOf<Scalar, Cap>;
  using PriorType = FrictionPrior<Scalar, Cap>;
  static constexpr int cells = 2 * Cap::cables < most_unknown_cells ? 2 * Cap::cables : most_unknown_cells;
  // Gain, zero and hysteresis of a jack, its wedge's draw-in, three remembered loads and what its cable
  // drifts by; gain and zero of another cell, and of a gauge a segment and a stroke a cable.
  using EstimatorType = Estimator<CondensedType, Cap::joints + 8 * cells, 2 * cells + 2 * most_gauges<Cap>>;
  using ReadingsType = Readings<Scalar, Cap>;
  using PastType = UnknownPast<EstimatorType>;
  using State = typename EstimatorType::State;
  static_assert(std::is_trivially_copyable_v<State>, "a file keeps bytes");

  template <int Dimension>
  Condensing condense() {
    know_scene<Scalar, Dimension, Cap>(scene_, *prior_);
    return condense_scene<Scalar, Dimension, Cap>(scene_, *condensed_, *struts_, displacements_.get());
  }

  Status know() {
    const Condensing condensing = scene_.dimension == 2 ? condense<2>() : condense<3>();
    gauges_ = SceneGauges(scene_);
    cells_ = gauges_.template cells<Scalar>();
    limits_ = limits_.with_stroke_noise(static_cast<Scalar>(gauges_.stroke_sd()));
    is_known_ = condensing.status.ok();
    return condensing.status;
  }
  // Both estimators go on until they agree; where that has no answer neither has.
  Followed advance_past() {
    const auto progress = past_->advance(*condensed_, *prior_, limits_, cells_, *readings_);
    const Followed above = {progress.status, static_cast<double>(progress.fraction)};
    if (!above.whole()) return above;
    past_->settle(*estimator_);
    if (!past_->is_unknown()) past_.reset();
    return above;
  }
  void take_gauges(const LogRow& row) {
    for (const MeasuredForce& force : row.forces) {
      const auto reading = static_cast<Scalar>(force.reading);
      if (force.of_strut) {
        estimator_->take_strut(*struts_, static_cast<int>(force.index), reading,
                               Gauge{gauges_.of_strut(force.index)});
      } else {
        const int segment = linear_part(*condensed_).cables[static_cast<int>(force.cable)].first_segment;
        estimator_->take_segment(segment + static_cast<int>(force.index), reading,
                                 Gauge{gauges_.of_segment(force.cable, force.index)});
      }
    }
    for (std::size_t c = 0; c < row.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (const auto& stroke = row.cables[c][end].stroke)
          estimator_->take_stroke(static_cast<int>(c), end, static_cast<Scalar>(*stroke),
                                  Gauge{gauges_.of_stroke(c, end)});
  }

  const SceneDescription& scene_;
  SceneGauges gauges_;
  std::vector<LoadCell<Scalar>> cells_;
  AlarmLimits<Scalar> limits_;
  Zeroed<CondensedType> condensed_;
  Zeroed<StrutRows> struts_;
  Zeroed<Displacements> displacements_;  // if the scene watches any
  std::unique_ptr<PriorType> prior_;
  std::unique_ptr<EstimatorType> estimator_;
  FrictionBefore before_;
  std::unique_ptr<PastType> past_;  // while it is not known
  std::unique_ptr<ReadingsType> readings_;
  double time_ = 0;
  bool has_row_ = false, is_known_ = false;
};

}  // namespace taut::host
