// A scene condensed and a tracker started on it, in either precision; compiled once for the scenes that tests
// share.
#pragma once

#include <memory>
#include <vector>

#include "support/saddles.hpp"
#include "support/scenes.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"

namespace support {

template <class Scalar, class Given, class Cap>
taut::Sample<Scalar, Cap> rounded(const taut::Sample<Given, Cap>& sample) {
  taut::Sample<Scalar, Cap> copy;
  for (int i = 0; i < Cap::loads; ++i) copy.factor[i] = static_cast<Scalar>(sample.factor[i]);
  for (int c = 0; c < Cap::cables; ++c)
    for (std::size_t end = 0; end < 2; ++end)
      copy.jack[c][end] = {static_cast<Scalar>(sample.jack[c][end].force), sample.jack[c][end].locked};
  return copy;
}

/// What is given is filled: the forces of struts, and displacements.
template <class Scalar, class SceneType>
taut::Status condense(
    const SceneType& scene, taut::Condensed<Scalar, typename SceneType::Capacity>& model,
    taut::CondensedStruts<Scalar, typename SceneType::Capacity>* struts = nullptr,
    taut::CondensedDisplacements<Scalar, typename SceneType::Capacity>* displacements = nullptr);

/// A tracker with the condensed scene that it follows, somewhere on the heap.
template <class Scalar, class SceneType>
class Run {
 public:
  using Cap = typename SceneType::Capacity;
  using Sample = taut::Sample<double, Cap>;
  using Model = taut::Condensed<Scalar, Cap>;
  using Tracker = taut::Tracker<Model>;

  explicit Run(const SceneType& scene);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Of the condensation; the tracker was started if this is ok.
  taut::Status condensed() const { return condensed_; }
  /// How far the start came.
  taut::Progress<Scalar> started() const { return started_; }
  /// Of both.
  taut::Status status() const { return condensed_ ? started_.status : condensed_; }

  taut::Progress<Scalar> advance(const Sample& sample, int event_budget = Tracker::default_budget);

  /// Puts the state into a new tracker, as after a power failure: all caches are dropped. Fails unless the
  /// new one has the same state, compared whole.
  taut::Status replace_tracker();

  double tension(int segment) const;
  std::vector<double> tensions() const;
  /// The largest tension so far [N].
  double peak() const;
  /// The jack force reached [N].
  double jack_force(int cable, int end) const;
  /// The worst of verify().
  double verified() const;
  const Tracker& tracker() const { return *tracker_; }

  /// The state reached, with the forces of the struts.
  taut::Response<Scalar, Cap> response() const;
  /// Displacement of a node along an axis [m], if the capacity has room for those of all nodes.
  double displacement(int node, int axis) const;

 private:
  std::unique_ptr<Model> model_;
  std::unique_ptr<taut::CondensedStruts<Scalar, Cap>> struts_;
  std::unique_ptr<taut::CondensedDisplacements<Scalar, Cap>> displacements_;
  std::unique_ptr<Tracker> tracker_;
  taut::Status condensed_;
  taut::Progress<Scalar> started_;
};

// Outside the class, and so not inline: an instance that is declared extern is not compiled again.

template <class Scalar, class SceneType>
taut::Status condense(const SceneType& scene, taut::Condensed<Scalar, typename SceneType::Capacity>& model,
                      taut::CondensedStruts<Scalar, typename SceneType::Capacity>* struts,
                      taut::CondensedDisplacements<Scalar, typename SceneType::Capacity>* displacements) {
  const auto condensation = std::make_unique<taut::Condensation<Scalar, SceneType>>();
  return condensation->run(scene, model, struts, displacements);
}

template <class Scalar, class SceneType>
Run<Scalar, SceneType>::Run(const SceneType& scene)
    : model_(new Model),
      struts_(new taut::CondensedStruts<Scalar, Cap>),
      displacements_(new taut::CondensedDisplacements<Scalar, Cap>),
      tracker_(new Tracker) {
  if constexpr (Cap::displacements > 0) displacements_->add_all(scene);
  condensed_ = condense(scene, *model_, struts_.get(), displacements_.get());
  if (condensed_) started_ = tracker_->start(*model_);
}

template <class Scalar, class SceneType>
Run<Scalar, SceneType>::~Run() = default;

template <class Scalar, class SceneType>
taut::Status Run<Scalar, SceneType>::replace_tracker() {
  const auto state = std::make_unique<typename Tracker::State>(tracker_->save());
  tracker_.reset(new Tracker);
  const taut::Status restored = tracker_->restore(*model_, *state);
  if (restored && !(tracker_->save() == *state))
    return taut::Status::at(taut::Code::bad_sample, taut::Place::none, -1);
  return restored;
}

template <class Scalar, class SceneType>
taut::Progress<Scalar> Run<Scalar, SceneType>::advance(const Sample& sample, int event_budget) {
  return tracker_->advance(rounded<Scalar>(sample), event_budget);
}

template <class Scalar, class SceneType>
double Run<Scalar, SceneType>::tension(int segment) const {
  return static_cast<double>(tracker_->tension(segment));
}

template <class Scalar, class SceneType>
std::vector<double> Run<Scalar, SceneType>::tensions() const {
  std::vector<double> all;
  for (int i = 0; i < model_->segments; ++i) all.push_back(tension(i));
  return all;
}

template <class Scalar, class SceneType>
double Run<Scalar, SceneType>::peak() const {
  return static_cast<double>(tracker_->peak());
}

template <class Scalar, class SceneType>
double Run<Scalar, SceneType>::jack_force(int cable, int end) const {
  return static_cast<double>(tracker_->loads().jack[cable][static_cast<std::size_t>(end)].force);
}

template <class Scalar, class SceneType>
double Run<Scalar, SceneType>::verified() const {
  return static_cast<double>(taut::verify(*tracker_).worst());
}

template <class Scalar, class SceneType>
taut::Response<Scalar, typename SceneType::Capacity> Run<Scalar, SceneType>::response() const {
  taut::Response<Scalar, Cap> response;
  tracker_->respond(response, struts_.get());
  return response;
}

template <class Scalar, class SceneType>
double Run<Scalar, SceneType>::displacement(int node, int axis) const {
  taut::FixedArray<Scalar, Cap::displacements> all;
  displacements_->evaluate(*model_, tracker_->loads(), tracker_->elongations(), all);
  return static_cast<double>(all[node * SceneType::dimension + axis]);
}

template <class Scalar, class SceneType>
using Condense = taut::Status(const SceneType&, taut::Condensed<Scalar, typename SceneType::Capacity>&,
                              taut::CondensedStruts<Scalar, typename SceneType::Capacity>*,
                              taut::CondensedDisplacements<Scalar, typename SceneType::Capacity>*);
extern template Condense<double, Plane> condense<double, Plane>;
extern template Condense<float, Plane> condense<float, Plane>;
extern template Condense<double, Space> condense<double, Space>;
extern template Condense<float, Space> condense<float, Space>;
extern template Condense<double, Saddles> condense<double, Saddles>;
extern template Condense<float, Saddles> condense<float, Saddles>;

extern template class Run<double, Plane>;
extern template class Run<float, Plane>;
extern template class Run<double, Space>;
extern template class Run<float, Space>;
extern template class Run<double, Saddles>;
extern template class Run<float, Saddles>;

}  // namespace support

// Tests follow scenes by it without a Run, too.
extern template class taut::Tracker<taut::Condensed<double, support::PlaneCapacity>>;
