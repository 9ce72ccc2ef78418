// The method `stepwise` as a Model.
#pragma once

#include <memory>

#include "lib/kinds/model.hpp"
#include "lib/kinds/solver_values.hpp"
#include "lib/kinds/valid_scene.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace taut::host {

template <class Scalar, int Dimension, class Cap>
class StepwiseModel : public Model {
 public:
  explicit StepwiseModel(const SceneDescription& described)
      : described_(described), scene_(make_valid_scene<Dimension, Cap>(described)), solver_(new Solver) {}

  Followed start(int substeps) override { return followed(solver_->start(*scene_, substeps)); }
  Followed advance(const LogRow& row, int substeps) override {
    return followed(solver_->advance(sample_of<Scalar, Cap>(row, described_), substeps));
  }
  void read(Answer& answer) const override { read_response(solver_->response(), described_, answer); }

 private:
  using Solver = Stepwise<Scalar, Scene<double, Dimension, Cap>>;

  static Followed followed(const Status& status) { return {status, status ? 1.0 : 0.0}; }

  const SceneDescription& described_;
  std::unique_ptr<Scene<double, Dimension, Cap>> scene_;
  std::unique_ptr<Solver> solver_;
};

}  // namespace taut::host
