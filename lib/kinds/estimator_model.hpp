// The method `estimate` as a Model.
#pragma once

#include <memory>
#include <string>

#include "lib/kinds/condense_scene.hpp"
#include "lib/kinds/model.hpp"
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
    const Condensing condensing = scene_.dimension == 2 ? condense<2>() : condense<3>();
    if (!condensing.status) return {condensing.status, 0};
    const auto progress = estimator_->start(*condensed_, *knowledge_, limits_);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  Followed advance(const LogRow& row, int) override {
    read_row(row, scene_, has_row_ ? row.time - time_ : 1, *readings_);
    time_ = row.time;
    has_row_ = true;
    const auto progress = estimator_->advance(*readings_);
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
