// The method `tracker` as a Model.
#pragma once

#include <cstring>
#include <memory>
#include <string>

#include "lib/kinds/condense_scene.hpp"
#include "lib/kinds/large_objects.hpp"
#include "lib/kinds/leg_model.hpp"
#include "lib/kinds/solver_values.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut::host {

template <class Scalar, class Cap>
class TrackerModel : public LegModel {
 public:
  explicit TrackerModel(const SceneDescription& scene)
      : scene_(scene),
        condensed_(make_zeroed<CondensedType>()),
        struts_(make_zeroed<StrutRows>()),
        displacements_(asks_for_displacements(scene) ? make_zeroed<Displacements>() : nullptr),
        tracker_(new TrackerType) {}

  Followed start(int) override {
    const Condensing condensing = scene_.dimension == 2 ? condense<2>() : condense<3>();
    if (!condensing.status) return {condensing.status, 0};
    return go_on(tracker_->start(*condensed_), {});
  }
  Followed advance(const LogRow& row, int) override {
    const auto sample = sample_of<Scalar, Cap>(row, scene_);
    return go_on(tracker_->advance(sample), sample);
  }
  Followed advance_to_event(const LogRow& row) override {
    const auto progress = tracker_->advance(sample_of<Scalar, Cap>(row, scene_), 1);
    return {progress.status, static_cast<double>(progress.fraction)};
  }
  std::string save() const override {
    const State state = tracker_->save();
    return {reinterpret_cast<const char*>(&state), sizeof(State)};
  }
  Followed go_to(const std::string& bytes) override {
    if (bytes.size() != sizeof(State)) return {Status::at(Code::bad_sample, Place::none, 0), 0};
    State state;
    std::memcpy(static_cast<void*>(&state), bytes.data(), sizeof(State));
    const Status restored = tracker_->restore(*condensed_, state);
    return {restored, restored ? 1.0 : 0.0};
  }
  void read(Answer& answer) const override {
    read(answer, struts_.get());
    read_displacements(displacements_.get(), *tracker_, 0, scene_.displaced.size(), answer.displacement);
  }
  std::vector<double> watched() const override {
    std::vector<double> found;
    read_displacements(displacements_.get(), *tracker_, scene_.displaced.size(), scene_.watched.size(),
                       found);
    return found;
  }
  void read_cables(Answer& answer) const override { read(answer, nullptr); }

 private:
  using CondensedType = CondensedOf<Scalar, Cap>;
  using Displacements = DisplacementsOf<Scalar, Cap>;
  using StrutRows = StrutsOf<Scalar, Cap>;
  using TrackerType = Tracker<CondensedType>;
  using State = typename TrackerType::State;
  static constexpr int most_calls = 64;

  template <int Dimension>
  Condensing condense() {
    return condense_scene<Scalar, Dimension, Cap>(scene_, *condensed_, *struts_, displacements_.get());
  }
  void read(Answer& answer, const StrutRows* struts) const {
    Response<Scalar, Cap> response;
    tracker_->respond(response, struts);
    read_response(response, scene_, answer);
    read_lean(*tracker_, scene_, answer);
  }
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
  Zeroed<CondensedType> condensed_;
  Zeroed<StrutRows> struts_;
  Zeroed<Displacements> displacements_;  // if the scene asks for any
  std::unique_ptr<TrackerType> tracker_;
};

}  // namespace taut::host
