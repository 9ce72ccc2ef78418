#include "support/bench.hpp"

#include "support/equilibrium.hpp"
#include "support/run.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace support {

namespace {

template <class Scalar, class SceneType>
class ByStepwise final : public Engine<Scalar, SceneType> {
 public:
  using typename Engine<Scalar, SceneType>::Cap;

  taut::Status start(const SceneType& scene) override { return solver_.start(scene); }
  taut::Status advance(const taut::Sample<Scalar, Cap>& sample, int parts) override {
    return solver_.advance(sample, parts);
  }
  const taut::Response<Scalar, Cap>& response() const override { return solver_.response(); }
  Scalar displacement(int node, int axis) const override { return solver_.displacement(node, axis); }

 private:
  taut::Stepwise<Scalar, SceneType> solver_;
};

template <class Scalar, class SceneType>
class ByTracker final : public Engine<Scalar, SceneType> {
 public:
  using typename Engine<Scalar, SceneType>::Cap;
  using Sample = taut::Sample<Scalar, Cap>;

  taut::Status start(const SceneType& scene) override {
    run_ = std::make_unique<Run<Scalar, SceneType>>(scene);
    last_ = {};
    respond();
    return run_->status();
  }
  taut::Status advance(const Sample& sample, int parts) override {
    // A lock-off is one path: on part of it the wedge would draw in wholly.
    const int count = same_locks(sample) ? parts : 1;
    taut::Status status;
    for (int part = 1; part <= count && status.ok(); ++part)
      status = go(part < count ? between(sample, part, count) : sample);
    if (status.code != taut::Code::bad_sample) last_ = sample;
    respond();
    return status;
  }
  const taut::Response<Scalar, Cap>& response() const override { return response_; }
  Scalar displacement(int node, int axis) const override {
    return static_cast<Scalar>(run_->displacement(node, axis));
  }

 private:
  taut::Status go(const Sample& sample) {
    taut::Progress<Scalar> progress;
    do {
      progress = run_->advance(rounded<double>(sample));
    } while (progress.status.ok() && progress.fraction < 1);
    return progress.status;
  }
  bool same_locks(const Sample& sample) const {
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (sample.jack[c][end].locked != last_.jack[c][end].locked) return false;
    return true;
  }
  Sample between(const Sample& sample, int part, int count) const {
    const Scalar share = static_cast<Scalar>(part) / static_cast<Scalar>(count);
    const auto mix = [share](Scalar a, Scalar b) { return a + share * (b - a); };
    Sample made = sample;
    for (int i = 0; i < Cap::loads; ++i) made.factor[i] = mix(last_.factor[i], sample.factor[i]);
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end)
        made.jack[c][end].force = mix(last_.jack[c][end].force, sample.jack[c][end].force);
    return made;
  }
  void respond() {
    if (run_->condensed()) response_ = run_->response();
  }

  std::unique_ptr<Run<Scalar, SceneType>> run_;
  Sample last_{};
  taut::Response<Scalar, Cap> response_{};
};

template <class Scalar, class SceneType>
std::unique_ptr<Engine<Scalar, SceneType>> make_engine(Solver solver) {
  if (solver == Solver::tracker) return std::make_unique<ByTracker<Scalar, SceneType>>();
  return std::make_unique<ByStepwise<Scalar, SceneType>>();
}

}  // namespace

template <class Scalar, class SceneType>
struct Bench<Scalar, SceneType>::Check {
  explicit Check(const SceneType& scene) : watch(scene) {}
  Watch<SceneType, Scalar> watch;
};

template <class Scalar, class SceneType>
Bench<Scalar, SceneType>::Bench(const SceneType& scene, Solver solver)
    : scene_(scene), by_(solver), engine_(make_engine<Scalar, SceneType>(solver)), check_(new Check(scene)) {
  (void)restart();
}

template <class Scalar, class SceneType>
Bench<Scalar, SceneType>::~Bench() = default;

template <class Scalar, class SceneType>
taut::Status Bench<Scalar, SceneType>::restart() {
  check_->watch.restart();
  sample_ = {};
  started_ = engine_->start(scene_);
  if (started_) found_ = check_->watch.check(*engine_, sample_);
  return started_;
}

template <class Scalar, class SceneType>
taut::Status Bench<Scalar, SceneType>::go(int substeps) {
  const taut::Status status = engine_->advance(sample_, substeps);
  if (!status) return status;
  // On the way of the tracker joints may slide to and fro, or slide and come to rest.
  if (substeps > 1 || by_ == Solver::tracker) check_->watch.forget_slips();
  found_ = check_->watch.check(*engine_, sample_);
  return status;
}

template class Bench<double, Plane>;
template class Bench<float, Plane>;
template class Bench<double, Space>;
template class Bench<float, Space>;

}  // namespace support
