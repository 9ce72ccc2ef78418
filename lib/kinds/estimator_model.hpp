// The method `estimate` as a Model.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "lib/kinds/condense_scene.hpp"
#include "lib/kinds/model.hpp"
#include "lib/kinds/scene_gauges.hpp"
#include "lib/kinds/solver_values.hpp"
#include "taut/estimation/estimator.hpp"

namespace taut::host {

template <class Scalar, class Cap>
class EstimatorModel : public Model {
 public:
  EstimatorModel(const SceneDescription& scene, const AlarmLimits<double>& limits)
      : scene_(scene),
        limits_(AlarmLimits<Scalar>::of(limits)),
        condensed_(new CondensedType),
        struts_(new StrutRows),
        knowledge_(new KnowledgeType),
        estimator_(new EstimatorType),
        readings_(new ReadingsType) {}

  Followed start(int) override {
    const Status known = know();
    if (!known) return {known, 0};
    const auto progress = estimator_->start(*condensed_, *knowledge_, limits_, cells_);
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
    const Status restored = estimator_->restore(*condensed_, *knowledge_, *state, limits_, cells_);
    time_ = time;
    has_row_ = true;
    return {restored, restored ? 1.0 : 0.0};
  }
  Followed advance(const LogRow& row, int) override {
    read_row(row, scene_, has_row_ && row.time > time_ ? row.time - time_ : 1, *readings_);
    check_strokes_from_their_marks();
    time_ = row.time;
    has_row_ = true;
    const auto progress = estimator_->advance(*readings_);
    if (progress.status && !(progress.fraction < 1)) take_gauges(row);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  void read(Answer& answer) const override {
    Response<Scalar, Cap> response;
    estimator_->respond(response, struts_.get());
    read_response(response, scene_, answer);
    read_certainty(*estimator_, scene_, answer);
  }

 private:
  using CondensedType = Condensed<Scalar, Cap>;
  using StrutRows = CondensedStruts<Scalar, Cap>;
  using KnowledgeType = Knowledge<Scalar, Cap>;
  // Of the jacks of more cables than these, turning points are taken for exact.
  static constexpr int noisy_cables = Cap::cables < 8 ? Cap::cables : 8;
  // Gain and zero of cells at anchored ends, and of a gauge a segment and a stroke a cable.
  static constexpr int further = 4 * noisy_cables + 2 * most_gauges<Cap>;
  using EstimatorType = Estimator<CondensedType, Cap::joints + 4 * noisy_cables, further>;
  using ReadingsType = Readings<Scalar, Cap>;
  using State = typename EstimatorType::State;
  static_assert(std::is_trivially_copyable_v<State>, "a file keeps bytes");

  template <int Dimension>
  Condensing condense() {
    know_scene<Scalar, Dimension, Cap>(scene_, *knowledge_);
    return condense_scene<Scalar, Dimension, Cap>(scene_, *condensed_, *struts_);
  }

  Status know() {
    const Condensing condensing = scene_.dimension == 2 ? condense<2>() : condense<3>();
    gauges_ = SceneGauges(scene_);
    cells_ = gauges_.template cells<Scalar>();
    // Noise of both of two readings is no elongation.
    limits_.least_elongation =
        std::max(limits_.least_elongation, static_cast<Scalar>(5 * gauges_.stroke_sd()));
    return condensing.status;
  }
  // What was not read from the start is compared with what is expected beyond its mark.
  void check_strokes_from_their_marks() {
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        auto& given = readings_->ends[static_cast<int>(c)][end];
        const Gauge gauge{gauges_.of_stroke(c, end)};
        if (!given.has_stroke || gauge.number < 0 || scene_.cables[c].stroke[end].is_assumed) continue;
        given.has_stroke = !estimator_->gauges().lacks_mark(gauge);
        given.stroke -= estimator_->zero(gauge);
      }
  }
  void take_gauges(const LogRow& row) {
    for (const MeasuredForce& force : row.forces) {
      const auto reading = static_cast<Scalar>(force.reading);
      if (force.of_strut) {
        estimator_->take_strut(*struts_, static_cast<int>(force.index), reading,
                               Gauge{gauges_.of_strut(force.index)});
      } else {
        const int segment = condensed_->cables[static_cast<int>(force.cable)].first_segment;
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
  std::unique_ptr<CondensedType> condensed_;
  std::unique_ptr<StrutRows> struts_;
  std::unique_ptr<KnowledgeType> knowledge_;
  std::unique_ptr<EstimatorType> estimator_;
  std::unique_ptr<ReadingsType> readings_;
  double time_ = 0;
  bool has_row_ = false;
};

}  // namespace taut::host
