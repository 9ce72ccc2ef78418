// The method `tracker` as a Model.
#pragma once

#include <memory>

#include "lib/kinds/condense_scene.hpp"
#include "lib/kinds/model.hpp"
#include "lib/kinds/solver_values.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut::host {

template <class Scalar, class Cap>
class TrackerModel : public Model {
 public:
  explicit TrackerModel(const SceneDescription& scene)
      : scene_(scene), condensed_(new CondensedType), struts_(new StrutRows), tracker_(new TrackerType) {}

  Followed start(int) override {
    const Condensing condensing = scene_.dimension == 2
                                      ? condense_scene<Scalar, 2, Cap>(scene_, *condensed_, *struts_)
                                      : condense_scene<Scalar, 3, Cap>(scene_, *condensed_, *struts_);
    if (!condensing.status) return {condensing.status, 0};
    return go_on(tracker_->start(*condensed_), {});
  }
  Followed advance(const LogRow& row, int) override {
    const auto sample = sample_of<Scalar, Cap>(row, scene_);
    return go_on(tracker_->advance(sample), sample);
  }
  void read(Answer& answer) const override {
    Response<Scalar, Cap> response;
    tracker_->respond(response, struts_.get());
    read_response(response, scene_, answer);
  }

 private:
  using CondensedType = CondensedOf<Scalar, Cap>;
  using StrutRows = StrutsOf<Scalar, Cap>;
  using TrackerType = Tracker<CondensedType>;
  static constexpr int most_calls = 64;

  /// Calls again while nothing but the event budget of a call ended the path.
  Followed go_on(Progress<Scalar> progress, const Sample<Scalar, Cap>& sample) {
    double rest = 1;
    for (int call = 1;; ++call) {
      rest *= 1 - static_cast<double>(progress.fraction);
      if (!progress.status || progress.fraction >= 1 || call == most_calls)
        return {progress.status, 1 - rest};
      progress = tracker_->advance(sample);
    }
  }

  const SceneDescription& scene_;
  std::unique_ptr<CondensedType> condensed_;
  std::unique_ptr<StrutRows> struts_;
  std::unique_ptr<TrackerType> tracker_;
};

}  // namespace taut::host
