// What is known of unknown constants, and what a measurement adds to it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "taut/estimation/prediction.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// A jack's load in a row.
template <class Scalar>
struct JackReading {
  Scalar beyond = 0;    ///< its best estimate less the force that the tracker was driven to [N]
  Scalar variance = 0;  ///< of that estimate before anything else has been measured [N^2]
};

/// What is expected of a reading.
template <class Scalar>
struct Expected {
  Scalar value = 0, variance = 0;
};

/// A reading of an instrument.
template <class Scalar>
struct Measured {
  Scalar reading = 0;  ///< or the mean of several
  Scalar sd = 0;       ///< its standard deviation
  /// If it is the mean of several: the variance of one of them about what was expected. The gate is as wide
  /// as it would be for one of them.
  Scalar scatter = 0;
};

/// An extended Kalman filter without dynamics: means and covariances of unknown constants, Gaussian, and
/// where the model is linearized. What several measurements of one row have in common, the errors of the
/// jacks' readings, are unknowns of that row alone.
///
/// The unknowns are added in this order: those of friction, whose bounds are kept; those that jacks' forces
/// depend on; errors that friction remembers, which are in use as soon as they have a variance; those that
/// readings alone depend on. The model is linearized anew for the first and the third.
template <class Scalar, int Parameters, int Jacks, int Bounds = Jacks / 2>
class Belief {
 public:
  using Values = FixedArray<Scalar, Parameters>;
  using Covariance = FixedArray<Values, Parameters>;
  using PredictionType = Prediction<Scalar, Parameters, Jacks>;
  using JackReadings = FixedList<JackReading<Scalar>, Jacks>;
  /// All that is known, between two rows.
  struct State {
    Values mean, linearized_at;
    Covariance covariance;
    /// Of the unknowns with the error that a jack's reading had, that the last one of them was learned with.
    FixedArray<Values, Jacks> with_load;
    /// What it has taught that a number is not above zero, as if it had been measured: the precision of that
    /// number, and its product with the number.
    struct Bound {
      Values H;
      Scalar precision = 0, pull = 0;
    };
    FixedArray<Bound, Bounds> bounds;
  };
  using Bound = typename State::Bound;
  /// The model is linearized anew where a predicted number would be off its line by more than half of this
  /// part of its standard deviation.
  static constexpr Scalar nonlinearity = Scalar(0.3);
  /// A reading is refused if the square of its innovation is beyond so many variances: five sigma.
  static constexpr Scalar gate = 25;

  void clear() {
    size_ = friction_ = loads_ = carried_ = in_use_ = 0;
    state_.mean.fill(Scalar(0));
    state_.linearized_at.fill(Scalar(0));
    state_.covariance = {};
    state_.with_load = {};
    state_.bounds = {};
    begin_row();
  }
  /// Adds an unknown with mean zero. Returns its number, or -1 if there is no room.
  int add(Scalar sd) {
    if (size_ == Parameters) return -1;
    const Scalar far = (std::numeric_limits<Scalar>::max)();
    state_.covariance[size_][size_] = most_variance_[size_] = sd * sd;
    least_[size_] = -far;
    most_[size_] = far;
    return size_++;
  }
  /// Keeps the mean of unknown `p` between these.
  void bound(int p, Scalar least, Scalar most) {
    least_[p] = larger(least_[p], least);
    most_[p] = -larger(-most_[p], -most);
  }
  /// A value of unknown `p`, or the nearest that it can have.
  Scalar bounded(int p, Scalar value) const { return larger(least_[p], -larger(-most_[p], -value)); }
  /// What is added from here on is not friction.
  void end_friction() { friction_ = loads_ = carried_ = in_use_ = size_; }
  /// What is added from here on are no constants of jacks' instruments.
  void end_loads() { loads_ = carried_ = in_use_ = size_; }
  /// What is added from here on changes no force.
  void end_carried() { carried_ = size_; }
  /// All have been added.
  void end() {
    if (size_ > carried_) in_use_ = size_;
  }
  /// Something new takes the place of unknown `p`, independent of all others.
  void renew(int p, Scalar sd) {
    in_use_ = larger(in_use_, p + 1);
    state_.linearized_at[p] = 0;
    know(p, 0, sd);
  }
  /// Unknown `p` is known to be this, independent of all others.
  void know(int p, Scalar mean, Scalar sd) {
    state_.mean[p] = mean;
    for (int q = 0; q < size_; ++q) state_.covariance[p][q] = state_.covariance[q][p] = 0;
    for (int k = 0; k < Jacks; ++k) state_.with_load[k][p] = 0;
    state_.covariance[p][p] = sd * sd;
  }
  /// Readings scatter more than they were taken to, their variance is so many `times` larger, above one: what
  /// they have taught is worth as much less. The covariance P becomes (P_0^-1 + (P^-1 - P_0^-1) / times)^-1,
  /// with P_0 the variances that add() was given, and of what was renewed since, those that it has now. What
  /// is known together stays known together: if variances grew one by one, each to that of its prior at most,
  /// a sum of unknowns would be taken for less known than it is, and its next reading for news of each of
  /// them. Cost: half the cube of the unknowns in use.
  void inflate(Scalar times) {
    Values R, column;  // of the prior, as readings of the unknowns themselves
    const Scalar part = times / (times - 1);
    auto& P = state_.covariance;
    for (int p = 0; p < in_use_; ++p) R[p] = part * larger(P[p][p], most_variance_[p]);
    for (int p = 0; p < in_use_; ++p)
      for (int q = 0; q < in_use_; ++q) P[p][q] *= times;
    for (int r = 0; r < in_use_; ++r) {
      if (!(P[r][r] > 0)) continue;
      const Scalar precision = 1 / (P[r][r] + R[r]);
      for (int p = 0; p < in_use_; ++p) column[p] = P[p][r];
      for (int p = 0; p < in_use_; ++p)
        for (int q = 0; q <= p; ++q) P[q][p] = P[p][q] = P[p][q] - column[p] * precision * column[q];
    }
  }
  /// Unknown `p` becomes what it was and so much `by` unknown `q`. Cost: a few operations an unknown in use.
  void shear(int p, int q, Scalar by) {
    auto& P = state_.covariance;
    state_.mean[p] += by * state_.mean[q];
    for (int k = 0; k < Jacks; ++k) state_.with_load[k][p] += by * state_.with_load[k][q];
    P[p][p] += by * (2 * P[p][q] + by * P[q][q]);
    for (int r = 0; r < in_use_; ++r)
      if (r != p) P[r][p] = P[p][r] = P[p][r] + by * P[q][r];
  }
  /// Unknown `p` may have changed since the last row: its variance grows by so much.
  void diffuse(int p, Scalar variance) { state_.covariance[p][p] += variance; }
  /// The model is linearized at `values` from here on. Returns by how much each unknown in use moves.
  Values linearize_at(const Values& values) {
    Values change;
    for (int p = 0; p < carried(); ++p) {
      if (!is_linearized(p)) continue;
      change[p] = values[p] - state_.linearized_at[p];
      state_.linearized_at[p] = values[p];
    }
    return change;
  }
  /// By how much each unknown in use is off where the model is linearized.
  Values off_line() const {
    Values off;
    for (int p = 0; p < carried(); ++p)
      if (is_linearized(p)) off[p] = state_.mean[p] - state_.linearized_at[p];
    return off;
  }
  const State& save() const { return state_; }
  void restore(const State& state) {
    state_ = state;
    for (int p = 0; p < size_; ++p)
      if (state_.covariance[p][p] > 0) in_use_ = larger(in_use_, p + 1);
  }

  int size() const { return size_; }
  int in_use() const { return in_use_; }
  /// Those in use that forces depend on: the first ones.
  int carried() const { return in_use_ < carried_ ? in_use_ : carried_; }
  /// The number of unknown `p` among those that readings alone depend on; below zero if forces do, too.
  int further(int p) const { return p - carried_; }
  bool has_friction() const { return friction_ > 0; }
  /// Those of friction: the first ones.
  int friction() const { return friction_; }
  const Values& mean() const { return state_.mean; }
  Scalar mean(int p) const { return state_.mean[p]; }
  Scalar linearized_at(int p) const { return state_.linearized_at[p]; }
  Scalar variance(int p) const { return state_.covariance[p][p]; }
  Scalar covariance(int p, int q) const { return state_.covariance[p][q]; }
  /// The covariance of unknown `p` with the error of jack `k`, its reading less its load [N], in the last row
  /// that taught anything, Eq. (66). As long as one row is like another it is that with the error of every
  /// row.
  Scalar with_load(int p, int k) const { return state_.with_load[k][p]; }
  /// Whether something of the row has taught it, so that with_load() is of this row: update_alone() does not.
  bool has_errors() const { return has_errors_; }
  /// Variance S P S^T, Eq. (20), of a force whose derivative by unknown `p` is derivative(p). Cost: half the
  /// square of the unknowns in use.
  template <class Derivatives>
  [[gnu::always_inline]] Scalar variance_of(const Derivatives& derivative) const {
    // Without zeros first; a FixedArray has them.
    std::array<Scalar, static_cast<std::size_t>(Parameters)> derivatives;
    const auto S = [&derivatives](int p) -> Scalar& { return derivatives[static_cast<std::size_t>(p)]; };
    Scalar variance = 0;
    for (int p = 0, n = carried(); p < n; ++p) {
      S(p) = derivative(p);
      Scalar sum = S(p) * state_.covariance[p][p];
      for (int q = 0; q < p; ++q) sum += 2 * S(q) * state_.covariance[p][q];
      variance += S(p) * sum;
    }
    return variance;
  }

  /// The same of a reading with the derivatives `H` by all unknowns in use.
  Scalar variance_of_reading(const Values& H) const {
    Scalar variance = 0;
    for (int p = 0; p < in_use_; ++p)
      for (int q = 0; q < in_use_; ++q) variance += H[p] * state_.covariance[p][q] * H[q];
    return variance;
  }

  /// A prediction at the best estimate of unknowns and loads, and its variance with the noise of a reading.
  Expected<Scalar> expect(const PredictionType& prediction, const JackReadings& jacks, Scalar sd) const {
    Expected<Scalar> y = {prediction.value, sd * sd + variance_of_reading(prediction.H)};
    for (int p = 0; p < in_use_; ++p) y.value += prediction.H[p] * (state_.mean[p] - state_.linearized_at[p]);
    for (int k = 0; k < jacks.size(); ++k) {
      y.value += prediction.by_jack[k] * jacks[k].beyond;
      y.variance += prediction.by_jack[k] * prediction.by_jack[k] * jacks[k].variance;
    }
    return y;
  }

  /// Begins a row: nothing of it has been measured yet.
  void begin_row() { has_errors_ = false; }
  /// Compares a reading with its prediction, Eqs. (21), (22), (24) and (75). Returns false if and only if the
  /// innovation is outside of the gate. Changes nothing that is known before update(). Cost: the square of
  /// the unknowns in use and jacks.
  [[nodiscard]] bool innovate(const PredictionType& prediction, const JackReadings& jacks,
                              const Measured<Scalar>& measured) {
    const Scalar sd = measured.sd;
    Innovation& innovation = innovation_;
    const auto& H = prediction.H;
    const auto& P = state_.covariance;
    const auto offset = [&](int p) { return state_.mean[p] - state_.linearized_at[p]; };
    // A jack pulls less than it reads by the error of the reading.
    const auto by_error = [&](int k) { return -prediction.by_jack[k]; };
    Scalar expected = prediction.value, variance = 0;
    for (int p = 0; p < in_use_; ++p) expected += H[p] * offset(p);
    for (int k = 0; k < jacks.size(); ++k) {
      expected += prediction.by_jack[k] * jacks[k].beyond;
      Scalar sum = by_error(k) * jacks[k].variance;
      if (has_errors_) {
        expected += by_error(k) * errors_.mean[k];
        sum = 0;
        for (int p = 0; p < in_use_; ++p) sum += state_.with_load[k][p] * H[p];
        for (int l = 0; l < jacks.size(); ++l) sum += errors_.with_error[k][l] * by_error(l);
      }
      innovation.with_error[k] = sum;
      variance += by_error(k) * sum;
    }
    Scalar of_friction = 0, through_friction = 0, of_cells = 0, of_both = 0, of_unknowns = 0,
           through_unknowns = 0;
    for (int p = 0; p < in_use_; ++p) {
      Scalar sum = 0;
      for (int q = 0; q < friction_; ++q) sum += P[p][q] * H[q];
      if (p < friction_) of_friction += H[p] * sum;
      if (p >= friction_ && p < loads_) {
        of_both += H[p] * sum;
        for (int q = friction_; q < loads_; ++q) of_cells += H[p] * P[p][q] * H[q];
      }
      for (int q = friction_; q < in_use_; ++q) sum += P[p][q] * H[q];
      of_unknowns += H[p] * sum;
      for (int k = 0; k < jacks.size() && has_errors_; ++k) sum += state_.with_load[k][p] * by_error(k);
      innovation.with_unknown[p] = sum;
      through_unknowns += H[p] * sum;
      if (p < friction_) through_friction += H[p] * sum;
    }
    variance += through_unknowns;
    // A load that is off times what friction leaves of it.
    const Scalar square = prediction.value * prediction.value;
    if (square > 0) variance += (of_friction * of_cells + of_both * of_both) / square;
    const Scalar S = sd * sd + variance;
    innovation.variance = variance;
    innovation.value = measured.reading - expected;
    if (!(innovation.value * innovation.value <= gate * larger(S, measured.scatter))) return false;
    innovation.precision = 1 / S;
    const Scalar pull = innovation.value * innovation.precision;
    Scalar shift = 0;
    for (int p = 0; p < in_use_; ++p) {
      innovation.updated_mean[p] = bounded(p, state_.mean[p] + innovation.with_unknown[p] * pull);
      if (p < friction_) shift += std::fabs(H[p] * (innovation.updated_mean[p] - state_.linearized_at[p]));
    }
    // A force is about exponential in mu: by shift^2 / 2T it is off the line.
    const auto left_of = [&](Scalar before, Scalar through) {
      return larger(before - through * through * innovation.precision, Scalar(0));
    };
    const Scalar left =
        -larger(-left_of(of_friction, through_friction), -left_of(of_unknowns, through_unknowns));
    const Scalar off = shift * shift, allowed = nonlinearity * larger(std::fabs(expected), sd);
    innovation.is_nonlinear = off * off > allowed * allowed * left;
    return true;
  }
  /// After innovate(): whether the mean that would follow is too far from where the model is linearized.
  bool is_nonlinear() const { return innovation_.is_nonlinear; }
  /// After innovate(): whether friction would be found farther from where the model is linearized than
  /// `nonlinearity` of its standard deviation. Cost: a few operations an unknown of friction.
  bool moves_friction() const {
    for (int p = 0; p < friction_; ++p) {
      const Scalar gain = innovation_.with_unknown[p] * innovation_.precision,
                   left = state_.covariance[p][p] - gain * innovation_.with_unknown[p],
                   off = innovation_.updated_mean[p] - state_.linearized_at[p];
      if (off * off > nonlinearity * nonlinearity * left) return true;
    }
    return false;
  }
  /// After innovate(): the mean that would follow.
  const Values& updated_mean() const { return innovation_.updated_mean; }
  /// After innovate(), or where that found a contradiction: how far the reading was off, and the variance of
  /// that which is due to unknowns and jacks.
  Scalar innovation() const { return innovation_.value; }
  Scalar innovation_variance() const { return innovation_.variance; }
  /// By how much that is off the mean before, but for the bounds of unknown `p`.
  Scalar change(int p) const {
    return innovation_.with_unknown[p] * innovation_.precision * innovation_.value;
  }
  /// After innovate(): the reading is known from here on, Eq. (23), and what it says of the jacks' errors.
  /// Cost: half the square of the unknowns in use, and the square of the jacks.
  void update(const JackReadings& jacks) {
    for (int p = 0; p < in_use_; ++p) {
      state_.mean[p] = innovation_.updated_mean[p];
      const Scalar gain = innovation_.with_unknown[p] * innovation_.precision;
      auto& P = state_.covariance;
      for (int q = 0; q < p; ++q) P[q][p] = P[p][q] = P[p][q] - gain * innovation_.with_unknown[q];
      P[p][p] -= gain * innovation_.with_unknown[p];
    }
    update_errors(jacks);
  }

  /// After innovate(): the same for some unknowns alone, those with is_of(p); what the reading says of the
  /// others is left aside, but not that they are uncertain (Schmidt, Application of state-space methods to
  /// navigation problems, 1966). Cost: the square of the unknowns in use.
  template <class IsOf>
  void update_alone(const IsOf& is_of) {
    for (int p = 0; p < in_use_; ++p) {
      if (!is_of(p)) continue;
      state_.mean[p] = innovation_.updated_mean[p];
      const Scalar gain = innovation_.with_unknown[p] * innovation_.precision;
      auto& P = state_.covariance;
      for (int q = 0; q < in_use_; ++q)
        if (q <= p || !is_of(q)) P[q][p] = P[p][q] = P[p][q] - gain * innovation_.with_unknown[q];
    }
  }

  /// It is known that a number is not above zero which has the derivatives `H`, an error of variance R, and
  /// is expected to be `value`: mean and covariance become those of what is left of the normal distribution
  /// (Simon and Simon, Constrained Kalman filtering via density function truncation, 2010). Bound `b` keeps
  /// what that has taught, and what it kept before is taken back first, for a bound that is narrower says
  /// all that the wider one did: expected() is asked for the number once it is (Minka, Expectation
  /// propagation for approximate Bayesian inference, 2001). Returns false if that is beyond five sigma; then
  /// nothing has changed. Cost: three times the square of the unknowns in use.
  template <class ExpectedNumber>
  [[nodiscard]] bool bring_below_zero(int b, const Values& H, Scalar R, const ExpectedNumber& expected) {
    constexpr Scalar pi = Scalar(3.14159265358979323846);
    Bound& bound = state_.bounds[b];
    if (!add_information({bound.H, -bound.precision, -bound.pull})) bound = {};
    const Scalar h = variance_of_reading(H), S = h + R, above = larger(expected() / std::sqrt(S), Scalar(0));
    if (above * above > gate) {
      static_cast<void>(add_information(bound));
      return false;
    }
    // The hazard phi/Q, within 1.2 % (Boyd, Inequalities for Mills' ratio, 1959).
    const Scalar hazard = ((pi - 1) * above + std::sqrt(above * above + 2 * pi)) / pi,
                 gone = hazard * (hazard - above) / S, left = 1 - gone * h;
    Scalar at = 0;
    for (int p = 0; p < in_use_; ++p) at += H[p] * state_.mean[p];
    bound = {H, gone / left, (gone * at - hazard / std::sqrt(S)) / left};
    return add_information(bound);
  }
  const Bound& bound_at(int b) const { return state_.bounds[b]; }
  /// Takes back what bound `b` has taught, for what it had taught before. Cost: twice the square of the
  /// unknowns in use.
  void put_back_bound(int b, const Bound& before) {
    Bound& bound = state_.bounds[b];
    static_cast<void>(add_information({bound.H, -bound.precision, -bound.pull}));
    bound = before;
    if (!add_information(bound)) bound = {};
  }

 private:
  /// Adds precision H H^T to the inverse of the covariance P, and H pull to that times the mean. False if
  /// that leaves none; then nothing has changed.
  bool add_information(const Bound& added) {
    auto& P = state_.covariance;
    Values with_number;  // P H^T
    Scalar h = 0, at = 0;
    for (int p = 0; p < in_use_; ++p) {
      for (int q = 0; q < in_use_; ++q) with_number[p] += P[p][q] * added.H[q];
      h += added.H[p] * with_number[p];
      at += added.H[p] * state_.mean[p];
    }
    const Scalar left = 1 + added.precision * h;
    if (!(left > Scalar(0.01))) return false;
    const Scalar gone = added.precision / left, by = (added.pull - added.precision * at) / left;
    for (int p = 0; p < in_use_; ++p) {
      state_.mean[p] = bounded(p, state_.mean[p] + with_number[p] * by);
      for (int q = 0; q <= p; ++q) P[q][p] = P[p][q] = P[p][q] - gone * with_number[p] * with_number[q];
    }
    return true;
  }
  /// What a measurement of the row says of the jacks' errors.
  void update_errors(const JackReadings& jacks) {
    auto& with_load = state_.with_load;
    for (int k = 0; k < jacks.size() && !has_errors_; ++k) {
      errors_.mean[k] = 0;
      for (int p = 0; p < in_use_; ++p) with_load[k][p] = 0;
      for (int l = 0; l < jacks.size(); ++l)
        errors_.with_error[k][l] = k == l ? jacks[k].variance : Scalar(0);
    }
    for (int k = 0; k < jacks.size(); ++k) {
      const Scalar gain = innovation_.with_error[k] * innovation_.precision;
      errors_.mean[k] += gain * innovation_.value;
      for (int p = 0; p < in_use_; ++p) with_load[k][p] -= gain * innovation_.with_unknown[p];
      for (int l = 0; l < jacks.size(); ++l) errors_.with_error[k][l] -= gain * innovation_.with_error[l];
    }
    has_errors_ = true;
  }
  bool is_linearized(int p) const { return p < friction_ || p >= loads_; }
  /// Of a reading, and what would follow from it.
  struct Innovation {
    Values with_unknown, updated_mean;     // P H^T; the mean after an update
    FixedArray<Scalar, Jacks> with_error;  // covariance of the predicted number with every jack's error
    Scalar precision = 0, value = 0;       // 1 / S, with S the variance of the innovation
    Scalar variance = 0;                   // S without the noise of the reading
    bool is_nonlinear = false;
  };
  /// Errors of the jacks' readings in this row, which all its measurements share.
  struct Errors {
    FixedArray<Scalar, Jacks> mean;
    FixedArray<FixedArray<Scalar, Jacks>, Jacks> with_error;  // covariances
  };

  int size_ = 0, friction_ = 0, loads_ = 0, carried_ = 0;
  int in_use_ = 0;  // the unknowns beyond have no variance yet
  State state_;
  Values least_, most_, most_variance_;
  // A member, so that what is not in use need not be cleared every time.
  Innovation innovation_;
  Errors errors_;  // once something of the row has been measured
  bool has_errors_ = false;
};

}  // namespace taut
