// The method `estimate` as a Model.
#pragma once

#include <memory>
#include <string>

#include "lib/alarm_words.hpp"
#include "lib/condense_scene.hpp"
#include "lib/model.hpp"
#include "lib/solver_values.hpp"
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
    const Condensing condensing = scene_.dimension == 2 ? condense<2>() : condense<3>();
    if (!condensing.status) return {condensing.status, 0};
    const auto progress = estimator_->start(*condensed_, *knowledge_, limits_);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  Followed advance(const LogRow& row, int) override {
    ReadingsType& readings = *readings_;
    readings.sample = sample_of<Scalar, Cap>(row, scene_);
    readings.dt = has_row_ ? static_cast<Scalar>(row.time - time_) : Scalar(1);
    time_ = row.time;
    has_row_ = true;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const EndRow& given = row.cables[c][end];
        auto& reading = readings.ends[static_cast<int>(c)][end];
        reading = {given.reading.has_value(), given.stroke.has_value(),
                   static_cast<Scalar>(given.reading.value_or(0)),
                   static_cast<Scalar>(given.stroke.value_or(0))};
      }
    const auto progress = estimator_->advance(readings);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  void read(Answer& answer) const override {
    Response<Scalar, Cap> response;
    estimator_->respond(response, struts_.get());
    read_response(response, scene_, answer);
    answer.deviation.resize(answer.tension.size());
    for (std::size_t i = 0; i < answer.deviation.size(); ++i)
      answer.deviation[i] = static_cast<double>(estimator_->deviation(static_cast<int>(i)));
    answer.mu.resize(answer.slip.size());
    answer.mu_deviation.resize(answer.slip.size());
    for (std::size_t j = 0; j < answer.mu.size(); ++j) {
      answer.mu[j] = static_cast<double>(estimator_->mu(static_cast<int>(j)));
      answer.mu_deviation[j] = static_cast<double>(estimator_->mu_deviation(static_cast<int>(j)));
    }
    answer.alarms = alarm_words(estimator_->alarms(), scene_);
  }

 private:
  using CondensedType = Condensed<Scalar, Cap>;
  using StrutRows = CondensedStruts<Scalar, Cap>;
  using KnowledgeType = Knowledge<Scalar, Cap>;
  // Of the jacks of more cables than these, turning points are taken for exact.
  static constexpr int noisy_cables = Cap::cables < 8 ? Cap::cables : 8;
  using EstimatorType = Estimator<CondensedType, Cap::joints + 4 * noisy_cables>;
  using ReadingsType = Readings<Scalar, Cap>;

  template <int Dimension>
  Condensing condense() {
    know_scene<Scalar, Dimension, Cap>(scene_, *knowledge_);
    return condense_scene<Scalar, Dimension, Cap>(scene_, *condensed_, *struts_);
  }

  const SceneDescription& scene_;
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
