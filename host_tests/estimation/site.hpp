// A site with a known truth: a jacking simulated with the true friction, its instruments with their noise,
// and an estimator that knows neither.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "support/run.hpp"
#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace estimation {

using support::gaussian;
using support::Plane;
using support::PlaneCapacity;
using support::Random;

/// With nothing but friction to be found, and with gains and zeros of instruments, too.
constexpr int most_unknowns = PlaneCapacity::joints + 4, most_with_cells = PlaneCapacity::joints + 8;

/// The estimator for instruments that have a gain and a zero of their own to be found.
using CellEstimator = taut::Estimator<taut::Condensed<double, PlaneCapacity>, most_with_cells, 4>;

/// How well the site's instruments read, as parts of the full jack force.
struct Instruments {
  double jack = 0.005, cell = 0.005;  ///< standard deviations of the noise
  double step = 0;                    ///< of the digits
  double outliers = 0;                ///< part of the jack's readings that are wrong altogether
  bool has_cell = true;               ///< at the anchored end
  int strut = -1;                     ///< with a strain gauge; -1: none
  double gauge = 0.005;               ///< standard deviation of its noise
  double stroke = 0;  ///< standard deviation of strokes that are taken for measurements [m]; 0: none are
};

/// The scene as it is known and as it is. One cable, jacked at its end, anchored or jacked at its start.
struct Ground {
  Plane known, actual;

  void set_true_mu(const std::vector<double>& mu) {
    actual = known;
    for (int j = 0; j < actual.mu.size(); ++j) actual.mu[j] = mu[static_cast<std::size_t>(j)];
  }
};

/// A row of the log: true forces of the jacks [N], their wedges, and the factor of the last load pattern.
struct Deed {
  std::array<double, 2> force{};
  std::array<bool, 2> locked{};
  double factor = 0;
};

/// Follows a jacking: the truth in double, the estimate in Scalar.
template <class Scalar>
class Site {
 public:
  using Model = taut::Condensed<Scalar, PlaneCapacity>;
  using Truth = taut::Condensed<double, PlaneCapacity>;
  using Estimator = taut::Estimator<Model, most_unknowns>;

  Site(const Ground& ground, const Instruments& instruments, double full, std::uint64_t seed);
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  /// A row of the log: the true force of the jack at the end, and whether that is locked.
  void advance(double force, bool locked = false) { advance(Deed{{0, force}, {false, locked}, 0}); }
  void advance(const Deed& deed);

  /// Puts another estimator in the place of the present one, from its saved state.
  void restart();

  bool good() const { return good_; }
  int segments() const { return truth_model_.segments; }
  double true_force(int segment) const { return truth_.tension(segment); }
  /// What the nominal friction foretells at the true load.
  double nominal_force(int segment) const { return nominal_.tension(segment); }
  double error(int segment) const {
    return static_cast<double>(estimator_.force(segment)) - truth_.tension(segment);
  }
  /// Whether the 95 % interval of a segment's force holds the truth.
  bool holds_truth(int segment) const;
  double jack_reading() const { return jack_reading_; }
  double cell_reading() const { return cell_reading_; }
  const Estimator& estimator() const { return estimator_; }
  const Model& model() const { return model_; }
  const taut::CondensedStruts<Scalar, PlaneCapacity>& rows() const { return rows_; }
  double true_strut(int strut) const;
  double true_extension() const { return truth_.slip_state().extension[0][1]; }

 private:
  /// What has no column in the readings.
  void measure();
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
  taut::FrictionPrior<Scalar, PlaneCapacity> prior_;
  Model model_;
  Truth truth_model_, nominal_model_;
  taut::CondensedStruts<Scalar, PlaneCapacity> rows_;
  taut::CondensedStruts<double, PlaneCapacity> truth_rows_;
  bool jacked_ = false;  // at its start too
  taut::Tracker<Truth> truth_, nominal_;
  Estimator estimator_;
  double jack_reading_ = 0, cell_reading_ = 0;
  bool good_ = true;
};

// Outside the class, and so not inline: an instance that is declared extern is not compiled again.

template <class Scalar>
Site<Scalar>::Site(const Ground& ground, const Instruments& instruments, double full, std::uint64_t seed)
    : full_(full), instruments_(instruments), random_(seed) {
  known_ = ground.known;
  jacked_ = known_.cables[0].ends[0] == taut::End::jacked;
  auto& cell = known_.cables[0].cell;
  cell[0].sd = with_digits(jacked_ ? instruments.jack : instruments.cell);
  cell[1].sd = with_digits(instruments.jack);
  taut::find_friction_prior(known_, prior_);
  good_ = support::condense(known_, model_, &rows_).ok() && support::condense(known_, nominal_model_).ok() &&
          support::condense(ground.actual, truth_model_, &truth_rows_).ok() &&
          truth_.start(truth_model_).status.ok() && nominal_.start(nominal_model_).status.ok() &&
          estimator_.start(model_, prior_).status.ok();
}

template <class Scalar>
void Site<Scalar>::advance(const Deed& deed) {
  taut::Sample<double, PlaneCapacity> sample;
  taut::Readings<Scalar, PlaneCapacity> readings;
  for (std::size_t end = 0; end < 2; ++end) {
    sample.jack[0][end] = {deed.force[end], deed.locked[end]};
    readings.sample.jack[0][end].locked = deed.locked[end];
  }
  if (known_.loads > 0) {
    sample.factor[known_.loads - 1] = deed.factor;
    readings.sample.factor[known_.loads - 1] = static_cast<Scalar>(deed.factor);
  }
  good_ = good_ && truth_.advance(sample).status.ok() && nominal_.advance(sample).status.ok();
  jack_reading_ = read(deed.force[1], instruments_.jack);
  if (random_.between(0, 1) < instruments_.outliers) jack_reading_ += random_.between(-0.5, 0.5) * full_;
  cell_reading_ =
      jacked_ ? read(deed.force[0], instruments_.jack) : read(truth_.tension(0), instruments_.cell);
  auto& ends = readings.ends[0];
  ends[1].has_force = true;
  ends[1].force = static_cast<Scalar>(jack_reading_);
  ends[0].has_force = jacked_ || instruments_.has_cell;
  ends[0].force = static_cast<Scalar>(cell_reading_);
  good_ = good_ && estimator_.advance(readings).status.ok();
  if (good_) measure();
}

template <class Scalar>
void Site<Scalar>::restart() {
  const auto state = estimator_.save();
  estimator_ = {};
  good_ = good_ && estimator_.restore(model_, prior_, state).ok();
}

template <class Scalar>
bool Site<Scalar>::holds_truth(int segment) const {
  const double spread = static_cast<double>(estimator_.deviation(segment));
  const double rounding = 1e-5 * full_ * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) / 1.2e-7;
  return std::fabs(error(segment)) <= 1.96 * spread + rounding;
}

template <class Scalar>
double Site<Scalar>::true_strut(int strut) const {
  taut::Response<double, PlaneCapacity> response;
  truth_.respond(response, &truth_rows_);
  return response.strut[strut];
}

template <class Scalar>
void Site<Scalar>::measure() {
  if (instruments_.strut >= 0)
    estimator_.take_strut(rows_, instruments_.strut,
                          static_cast<Scalar>(read(true_strut(instruments_.strut), instruments_.gauge)),
                          static_cast<Scalar>(with_digits(instruments_.gauge)));
  if (instruments_.stroke > 0)
    estimator_.take_stroke(0, 1,
                           static_cast<Scalar>(true_extension() + instruments_.stroke * gaussian(random_)),
                           static_cast<Scalar>(instruments_.stroke));
}

// Compiled once for all tests.
extern template class Site<float>;
extern template class Site<double>;

}  // namespace estimation

// What a site is made of is used by itself, too.
extern template class taut::Tracker<estimation::Site<float>::Model, estimation::most_unknowns>;
extern template class taut::Tracker<estimation::Site<double>::Model, estimation::most_unknowns>;
extern template class taut::Estimator<estimation::Site<float>::Model, estimation::most_unknowns>;
extern template class taut::Estimator<estimation::Site<double>::Model, estimation::most_unknowns>;
extern template class taut::Tracker<estimation::Site<double>::Model, estimation::most_with_cells>;
extern template class taut::Estimator<estimation::Site<double>::Model, estimation::most_with_cells, 4>;
