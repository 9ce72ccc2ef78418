// What is known of unknown constants, and what a measurement adds to it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "taut/numerics/larger.hpp"
#include "taut/scene/fixed_list.hpp"

namespace taut {

/// A measured number where the model is, and its derivatives.
template <class Scalar, int Parameters, int Jacks>
struct Expected {
  Scalar at = 0;
  FixedArray<Scalar, Parameters> by_unknown;
  FixedArray<Scalar, Jacks> by_jack;  ///< with respect to the forces of unlocked jacks
};

/// Means and covariances of unknown constants, Gaussian: an extended Kalman filter without dynamics. What
/// several measurements of one row have in common, the errors of the jacks' readings, are unknowns of that
/// row alone.
///
/// First the unknowns of friction are added, whose bounds are kept, then others, which count as soon as they
/// have a variance.
template <class Scalar, int Parameters, int Jacks>
class Belief {
 public:
  using Values = FixedArray<Scalar, Parameters>;
  using Covariance = FixedArray<Values, Parameters>;
  using ExpectedType = Expected<Scalar, Parameters, Jacks>;
  /// A jack's reading in a row: how far the best estimate of its force is from where the model was led [N],
  /// and the variance of that estimate before anything else has been measured.
  struct JackReading {
    Scalar beyond = 0, variance = 0;
  };
  using JackReadings = FixedList<JackReading, Jacks>;
  /// A mean so far from where the model is linearized that a measured number is off its line by half of this
  /// part of its standard deviation is too far.
  static constexpr Scalar bent = Scalar(0.3);
  /// A reading whose square distance from what is expected is beyond so many variances contradicts it.
  static constexpr Scalar impossible = 25;

  void clear() {
    size_ = friction_ = in_use_ = 0;
    mean_.fill(Scalar(0));
    covariance_ = {};
    begin_row();
  }
  /// Adds an unknown with mean zero. Returns its number, or -1 if there is no room.
  int add(Scalar sd) {
    if (size_ == Parameters) return -1;
    const Scalar far = std::numeric_limits<Scalar>::max();
    covariance_[size_][size_] = sd * sd;
    least_[size_] = -far;
    most_[size_] = far;
    return size_++;
  }
  /// Its mean stays between these.
  void bound(int p, Scalar least, Scalar most) {
    least_[p] = larger(least_[p], least);
    most_[p] = -larger(-most_[p], -most);
  }
  /// What follows is not friction.
  void end_friction() { friction_ = in_use_ = size_; }
  /// Something new takes the place of unknown `p`, independent of all others.
  void renew(int p, Scalar sd) {
    in_use_ = larger(in_use_, p + 1);
    mean_[p] = 0;
    for (int q = 0; q < size_; ++q) covariance_[p][q] = covariance_[q][p] = 0;
    covariance_[p][p] = sd * sd;
  }
  void restore(const Values& mean, const Covariance& covariance) {
    mean_ = mean;
    covariance_ = covariance;
    for (int p = 0; p < size_; ++p)
      if (covariance_[p][p] > 0) in_use_ = larger(in_use_, p + 1);
  }

  int size() const { return size_; }
  int in_use() const { return in_use_; }
  bool has_friction() const { return friction_ > 0; }
  const Values& mean() const { return mean_; }
  Scalar mean(int p) const { return mean_[p]; }
  const Covariance& covariance() const { return covariance_; }
  Scalar variance(int p) const { return covariance_[p][p]; }
  /// Of a number with these derivatives.
  template <class Derivatives>
  Scalar variance_of(const Derivatives& derivative) const {
    // Without zeros first; a FixedArray has them.
    std::array<Scalar, static_cast<std::size_t>(Parameters)> derivatives;
    const auto S = [&derivatives](int p) -> Scalar& { return derivatives[static_cast<std::size_t>(p)]; };
    Scalar variance = 0;
    for (int p = 0; p < in_use_; ++p) {
      S(p) = derivative(p);
      Scalar sum = S(p) * covariance_[p][p];
      for (int q = 0; q < p; ++q) sum += 2 * S(q) * covariance_[p][q];
      variance += S(p) * sum;
    }
    return variance;
  }

  /// Nothing of this row has been measured yet.
  void begin_row() { has_errors_ = has_news_ = false; }
  /// Before another measurement of the same row: what the one before said of the errors that they share.
  void learn_errors(const JackReadings& jacks) {
    if (!has_news_) return;
    for (int k = 0; k < jacks.size() && !has_errors_; ++k) {
      errors_.mean[k] = 0;
      for (int p = 0; p < in_use_; ++p) errors_.with_unknown[k][p] = 0;
      for (int l = 0; l < jacks.size(); ++l)
        errors_.with_error[k][l] = k == l ? jacks[k].variance : Scalar(0);
    }
    for (int k = 0; k < jacks.size(); ++k) {
      const Scalar gain = update_.with_error[k] * update_.precision;
      errors_.mean[k] += gain * update_.innovation;
      for (int p = 0; p < in_use_; ++p) errors_.with_unknown[k][p] -= gain * update_.with_unknown[p];
      for (int l = 0; l < jacks.size(); ++l) errors_.with_error[k][l] -= gain * update_.with_error[l];
    }
    has_errors_ = true;
    has_news_ = false;
  }
  /// A reading with its standard deviation. As the mean of several it has the variance of one of them about
  /// what was expected too: it is not to be refused for less than one of them would be.
  struct Measured {
    Scalar reading, sd, scatter;
  };
  /// What a reading says of the unknowns, the model being linearized at `at`. False if it contradicts
  /// everything known by more than five sigma. Nothing is changed before apply().
  bool weigh(const ExpectedType& expected, const Values& at, const JackReadings& jacks,
             const Measured& measured) {
    const Scalar sd = measured.sd;
    Update& update = update_;
    const auto& H = expected.by_unknown;
    // A jack pulls less than it reads by the error of the reading.
    const auto by_error = [&](int k) { return -expected.by_jack[k]; };
    Scalar number = expected.at, variance = 0;
    for (int p = 0; p < in_use_; ++p) number += H[p] * (mean_[p] - at[p]);
    for (int k = 0; k < jacks.size(); ++k) {
      number += expected.by_jack[k] * jacks[k].beyond;
      Scalar sum = by_error(k) * jacks[k].variance;
      if (has_errors_) {
        number += by_error(k) * errors_.mean[k];
        sum = 0;
        for (int p = 0; p < in_use_; ++p) sum += errors_.with_unknown[k][p] * H[p];
        for (int l = 0; l < jacks.size(); ++l) sum += errors_.with_error[k][l] * by_error(l);
      }
      update.with_error[k] = sum;
      variance += by_error(k) * sum;
    }
    Scalar of_friction = 0, through_friction = 0;
    for (int p = 0; p < in_use_; ++p) {
      Scalar sum = 0;
      for (int q = 0; q < friction_; ++q) sum += covariance_[p][q] * H[q];
      if (p < friction_) of_friction += H[p] * sum;
      for (int q = friction_; q < in_use_; ++q) sum += covariance_[p][q] * H[q];
      for (int k = 0; k < jacks.size() && has_errors_; ++k) sum += errors_.with_unknown[k][p] * by_error(k);
      update.with_unknown[p] = sum;
      variance += H[p] * sum;
      if (p < friction_) through_friction += H[p] * sum;
    }
    const Scalar spread = sd * sd + variance;
    update.innovation = measured.reading - number;
    if (!(update.innovation * update.innovation <= impossible * larger(spread, measured.scatter)))
      return false;
    update.precision = 1 / spread;
    const Scalar pull = update.innovation * update.precision;
    Scalar shift = 0;
    for (int p = 0; p < in_use_; ++p) {
      const Scalar mean = mean_[p] + update.with_unknown[p] * pull;
      update.mean[p] = larger(least_[p], -larger(-most_[p], -mean));
      if (p < friction_) shift += std::fabs(H[p] * (update.mean[p] - at[p]));
    }
    // A force is about exponential in mu: by shift^2 / 2T it is off the line.
    const Scalar left = of_friction - through_friction * through_friction * update.precision;
    const Scalar off = shift * shift, allowed = bent * larger(std::fabs(number), sd);
    update.is_bent = off * off > allowed * allowed * larger(left, Scalar(0));
    return true;
  }
  /// After weigh(): whether the mean that follows is too far from where the model is linearized, and that
  /// mean.
  bool is_bent() const { return update_.is_bent; }
  const Values& mean_to_be() const { return update_.mean; }
  /// Takes what was weighed for known.
  void apply() {
    for (int p = 0; p < in_use_; ++p) {
      mean_[p] = update_.mean[p];
      const Scalar gain = update_.with_unknown[p] * update_.precision;
      for (int q = 0; q < p; ++q)
        covariance_[q][p] = covariance_[p][q] = covariance_[p][q] - gain * update_.with_unknown[q];
      covariance_[p][p] -= gain * update_.with_unknown[p];
    }
    has_news_ = true;
  }

 private:
  /// What a measurement adds to what is known.
  struct Update {
    Values with_unknown, mean;  // covariance with the number; what follows
    FixedArray<Scalar, Jacks> with_error;
    Scalar precision = 0, innovation = 0;  // 1 / variance of what was expected; how far off that was
    bool is_bent = false;
  };
  /// Errors of the jacks' readings in this row, which all its measurements share.
  struct Errors {
    FixedArray<Scalar, Jacks> mean;
    FixedArray<Values, Jacks> with_unknown;  // covariances
    FixedArray<FixedArray<Scalar, Jacks>, Jacks> with_error;
  };

  int size_ = 0, friction_ = 0;
  int in_use_ = 0;  // the unknowns beyond have no variance yet
  Values mean_, least_, most_;
  Covariance covariance_;
  // A member, so that what is not in use need not be cleared every time.
  Update update_;
  Errors errors_;  // once there is a second measurement
  bool has_news_ = false, has_errors_ = false;
};

}  // namespace taut
