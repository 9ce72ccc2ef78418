// A site with a known truth: a jacking simulated with the true friction, its instruments with their noise,
// and an estimator that knows neither.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace estimation {

using support::Plane;
using support::PlaneCapacity;
using support::Random;

/// Standard normal numbers, the same on every platform but for the rounding of log and cos.
inline double gaussian(Random& random) {
  const double radius = std::sqrt(-2 * std::log(random.between(1e-300, 1)));
  return radius * std::cos(2 * support::pi * random.between(0, 1));
}

/// How well the site's instruments read, as parts of the full jack force.
struct Instruments {
  double jack = 0.005, cell = 0.005;  ///< standard deviations of the noise
  double step = 0;                    ///< of the digits
  double outliers = 0;                ///< part of the jack's readings that are wrong altogether
  bool has_cell = true;               ///< at the anchored end
};

/// The scene as it is known and as it is. One cable, anchored at its start and jacked at its end.
struct Ground {
  Plane known, actual;

  void set_true_mu(const std::vector<double>& mu) {
    actual = known;
    for (int j = 0; j < actual.mu.size(); ++j) actual.mu[j] = mu[static_cast<std::size_t>(j)];
  }
};

/// Follows a jacking: the truth in double, the estimate in Scalar.
template <class Scalar>
class Site {
 public:
  using Model = taut::Condensed<Scalar, PlaneCapacity>;
  using Truth = taut::Condensed<double, PlaneCapacity>;
  using Estimator = taut::Estimator<Model, PlaneCapacity::joints + 4>;

  Site(const Ground& ground, const Instruments& instruments, double full, std::uint64_t seed)
      : full_(full), instruments_(instruments), random_(seed) {
    known_ = ground.known;
    auto& sd = known_.cables[0].sensor_sd;
    sd[0] = with_digits(instruments.cell);
    sd[1] = with_digits(instruments.jack);
    taut::find_knowledge(known_, knowledge_);
    const auto condensing = std::make_unique<taut::Condensation<Scalar, Plane>>();
    const auto condensing_truth = std::make_unique<taut::Condensation<double, Plane>>();
    good_ = condensing->run(known_, model_).ok() && condensing_truth->run(known_, nominal_model_).ok() &&
            condensing_truth->run(ground.actual, truth_model_).ok() &&
            truth_.start(truth_model_).status.ok() && nominal_.start(nominal_model_).status.ok() &&
            estimator_.start(model_, knowledge_).status.ok();
  }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  /// A row of the log: the true jack force, or the end is locked.
  void advance(double force, bool locked = false) {
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1] = {force, locked};
    good_ = good_ && truth_.advance(sample).status.ok() && nominal_.advance(sample).status.ok();
    taut::Readings<Scalar, PlaneCapacity> readings;
    readings.sample.jack[0][1].locked = locked;
    jack_reading_ = read(force, instruments_.jack);
    if (random_.between(0, 1) < instruments_.outliers) jack_reading_ += random_.between(-0.5, 0.5) * full_;
    cell_reading_ = read(truth_.tension(0), instruments_.cell);
    auto& ends = readings.ends[0];
    ends[1].has_force = true;
    ends[1].force = static_cast<Scalar>(jack_reading_);
    ends[0].has_force = instruments_.has_cell;
    ends[0].force = static_cast<Scalar>(cell_reading_);
    good_ = good_ && estimator_.advance(readings).status.ok();
  }

  /// Puts another estimator in the place of the present one, from its saved state.
  void restart() {
    const auto state = estimator_.save();
    estimator_ = {};
    good_ = good_ && estimator_.restore(model_, knowledge_, state).ok();
  }

  bool good() const { return good_; }
  int segments() const { return truth_model_.segments; }
  double true_force(int segment) const { return truth_.tension(segment); }
  /// What the nominal friction foretells at the true load.
  double nominal_force(int segment) const { return nominal_.tension(segment); }
  double error(int segment) const {
    return static_cast<double>(estimator_.force(segment)) - truth_.tension(segment);
  }
  /// Whether the 95 % interval of a segment's force holds the truth.
  bool holds_truth(int segment) const {
    const double spread = static_cast<double>(estimator_.deviation(segment));
    const double rounding =
        1e-5 * full_ * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) / 1.2e-7;
    return std::fabs(error(segment)) <= 1.96 * spread + rounding;
  }
  double jack_reading() const { return jack_reading_; }
  double cell_reading() const { return cell_reading_; }
  const Estimator& estimator() const { return estimator_; }

 private:
  double with_digits(double noise) const {
    return full_ * std::sqrt(noise * noise + instruments_.step * instruments_.step / 12);
  }
  double read(double force, double noise) {
    const double reading = force + noise * full_ * gaussian(random_), step = instruments_.step * full_;
    return step > 0 ? step * std::round(reading / step) : reading;
  }

  double full_;
  Instruments instruments_;
  Random random_;
  Plane known_;
  taut::Knowledge<Scalar, PlaneCapacity> knowledge_;
  Model model_;
  Truth truth_model_, nominal_model_;
  taut::Tracker<Truth> truth_, nominal_;
  Estimator estimator_;
  double jack_reading_ = 0, cell_reading_ = 0;
  bool good_ = true;
};

}  // namespace estimation
