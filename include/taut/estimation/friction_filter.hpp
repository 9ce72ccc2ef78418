// Friction from measurements: the unknowns, on which joints they act, and the iterated update.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "taut/estimation/belief.hpp"
#include "taut/estimation/drawn_lines.hpp"
#include "taut/estimation/friction_prior.hpp"
#include "taut/estimation/friction_scatter.hpp"
#include "taut/estimation/instruments.hpp"
#include "taut/estimation/lasting_error.hpp"
#include "taut/estimation/prediction.hpp"
#include "taut/estimation/sliding_check.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/status.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// What became of a reading.
enum class Update : std::uint8_t {
  updated,         ///< it is known from here on
  waits,           ///< it is taken into account later, with others
  no_information,  ///< joints stick that matter to it: nothing is learned
  contradiction,   ///< its innovation is outside of the gate: nothing is learned
};

/// An extended Kalman filter on the unknowns of friction around a tracker that carries their sensitivities.
///
/// The unknowns: one factor a cable on the nominal mu if the cable shares it, else one mu a joint, with the
/// prior of the scene; then errors of the loads at which jacks last reversed or were locked, which friction
/// remembers. The tracker always has the friction at which the filter is linearized.
template <class CondensedType, int Parameters, int Further>
class FrictionFilter {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  using Linear = typename CondensedType::Linear;
  using TrackerType = Tracker<CondensedType, Parameters>;
  using PriorType = FrictionPrior<Scalar, Cap>;
  /// Of what is known not to be above zero: one for two jacks, and in second-order theory one for every
  /// unknown that may be friction.
  static constexpr int jack_bounds = max_jacks<Cap> / 2,
                       bounds = jack_bounds + (TrackerType::Model::has_level ? Parameters : 0);
  /// Whether there may be unknowns on which readings alone depend, as the zero of a far end.
  static constexpr bool has_further = Further > 0;
  using BeliefType = Belief<Scalar, Parameters + Further, max_jacks<Cap>, bounds>;
  using Values = typename BeliefType::Values;
  using PredictionType = typename BeliefType::PredictionType;
  using JackReadings = typename BeliefType::JackReadings;
  using LinesType = DrawnLines<Scalar, Further, max_jacks<Cap>>;
  struct State {
    typename BeliefType::State belief;
    typename LinesType::State lines;
  };
  /// Friction of a cable whose prior moves a measured number by less than this part of the standard deviation
  /// of its reading does not matter to the reading.
  static constexpr Scalar negligible = Scalar(0.2);
  /// Iterations of one update: the state of the tracker settles in two or three.
  static constexpr int most_iterations = 4;

  /// Begins with the prior, which must outlive the filter. Fails with
  /// `capacity_exceeded` if and only if there are more unknown mu than Parameters; the amount is what is
  /// missing. Cost: two passes over the joints.
  Status start(const Linear& model, const PriorType& prior) {
    prior_ = &prior;
    belief_.clear();
    unknown_of_.fill(-1);
    sliding_.start(model);
    scatter_.clear();
    int missing = 0;
    const auto add = [&](Scalar sd) {
      const int p = belief_.size() < Parameters ? belief_.add(sd) : -1;
      if (p < 0) ++missing;
      return p;
    };
    for (int c = 0; c < model.cables.size(); ++c) {
      const Scalar sd = prior.mu_sd[c];
      const auto& cable = model.cables[c];
      const auto free = FreeJoints<Real>::of(model, prior, cable);
      if (!(sd > 0) || free.count == 0) continue;
      const bool shared = prior.shared[c];
      const int common = shared ? add(sd) : -1;
      for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
        if (model.is_self_locking(j)) continue;
        const int p = shared ? common : add(sd);
        if (p < 0) continue;
        const Real weight = shared ? free.weight(prior.mu[j]) : Real(1);
        depend(c, j, p, static_cast<Scalar>(weight));
      }
      if (shared && common >= 0 && prior_->scatter[c] > 0) {
        scatters(c, cable, common, static_cast<Scalar>(free.mu) / static_cast<Scalar>(free.count));
      }
    }
    belief_.end_friction();
    instruments_.clear();
    lines_.clear();
    cell_zeros_.clear();
    missing += add_instruments(model, End::jacked, Parameters);
    belief_.end_loads();
    if (missing > 0) return Status::at(Code::capacity_exceeded, Place::none, Parameters, missing);
    return Status::success();
  }
  /// After start(): room for the error of a load that friction will remember, or for the strain of a locked
  /// cable. Returns its number, or -1 if there is none.
  int add_load_error() { return belief_.size() < Parameters ? belief_.add(Scalar(0)) : -1; }
  /// The same for how much further than `seating` [m] a wedge will be drawn in: none comes out.
  int add_draw_in(Scalar seating) {
    const int p = add_load_error();
    if (p >= 0) belief_.bound(p, -seating, (std::numeric_limits<Scalar>::max)());
    return p;
  }

  /// After the last of them: the unknowns of cells at anchored ends, on which no force depends, and those
  /// that add_gauges(add) adds, which returns how many found no room. Fails with `capacity_exceeded` if and
  /// only if there are more of them than Further.
  template <class AddGauges>
  Status end(const Linear& model, const AddGauges& add_gauges) {
    belief_.end_carried();
    int missing = add_instruments(model, End::anchored, Parameters + Further);
    missing += add_gauges([this](Scalar sd) { return belief_.add(sd); });
    belief_.end();
    if (missing > 0) return Status::at(Code::capacity_exceeded, Place::none, Further, missing);
    return Status::success();
  }

  State save() const { return {belief_.save(), lines_.save()}; }
  /// Goes on where save() was called; after start().
  void restore(const State& state) {
    belief_.restore(state.belief);
    lines_.restore(state.lines);
  }
  /// The friction at which the filter is linearized, for Tracker::start() and Tracker::restore(): a function
  /// of the joint.
  auto friction(const Linear& model) const {
    return [this, &model](int joint) { return friction_of(model, joint, belief_.save().linearized_at); };
  }
  /// The friction at the best estimate, in the same way.
  auto best_friction(const Linear& model) const {
    return [this, &model](int joint) { return friction_of(model, joint, belief_.mean()); };
  }
  /// Brings a copy of the tracker to the best estimate of the unknowns. Fails as Tracker::adjust() does.
  /// Cost: that.
  Status bring(TrackerType& copy) const {
    return copy.adjust(best_friction(linear_part(copy.condensed())), belief_.off_line());
  }

  const BeliefType& belief() const { return belief_; }
  /// What mu that differs from joint to joint adds to the variance of a segment's force, relative to the
  /// square of its derivative by the unknown of its cable, Eq. (30); zero where no joints share one.
  Scalar scatter(int segment) const {
    const int p = scatter_.parameter(segment);
    return p < 0 ? Scalar(0) : scatter_.variance(segment, belief_.mean(p));
  }
  /// The same of the mean of friction from an end of cable `c` to each segment as far as this one, with so
  /// many joints between, Eq. (56).
  Scalar mean_scatter(int c, int segment, int joints) const {
    const int p = scatter_.parameter(segment);
    return p < 0 || joints == 0
               ? Scalar(0)
               : scatter_.variance_of_mean(segment, joints, prior_->scatter[c], belief_.mean(p));
  }
  /// What scatter adds to the variance of a number with the derivatives `H`: where it is so much, relative to
  /// the square of the derivative by the unknown of a segment's cable, and, at most, of any segment.
  Scalar scatter_by(const Values& H, int segment, Scalar relative) const {
    const int p = scatter_.parameter(segment);
    return p < 0 ? Scalar(0) : H[p] * H[p] * relative;
  }
  Scalar most_scatter(const Values& H) const {
    Scalar variance = 0;
    for (int p = 0; p < belief_.carried(); ++p) variance += H[p] * H[p] * most_scatter(p);
    return variance;
  }
  /// The largest of all segments that depend on unknown `p`. Cost: a pass over the segments.
  Scalar most_scatter(int p) const { return scatter_.most(p, belief_.mean(p)); }
  /// The unknown that the joints of a segment's cable share if it scatters, or -1.
  int scatters_about(int segment) const { return scatter_.parameter(segment); }
  const Instruments<Scalar, Cap>& instruments() const { return instruments_; }
  const PriorType& prior() const { return *prior_; }
  /// Where the caller predicts a number before is_informative() and update(). A member, so that what is not
  /// in use need not be cleared.
  PredictionType& prediction() { return prediction_; }
  const PredictionType& prediction() const { return prediction_; }
  /// The unknown that the mu of a joint depends on, or -1.
  int unknown_of(int joint) const { return unknown_of_[joint]; }
  /// How far the best estimate of a joint's mu is from its nominal value, with the unknown `p` >= 0 [-].
  Scalar mu_change(int joint, int p) const { return weight_[joint] * belief_.mean(p); }
  /// What mu of a joint varies by when its unknown does by one [-].
  Scalar weight(int joint) const { return weight_[joint]; }
  /// Friction coefficient of a joint [-].
  Scalar mu(int joint) const {
    const auto nominal = static_cast<Scalar>(prior_->mu[joint]);
    const int p = unknown_of_[joint];
    return p < 0 ? nominal : nominal + mu_change(joint, p);
  }
  /// Its standard deviation [-].
  Scalar mu_deviation(int joint) const {
    const int p = unknown_of_[joint];
    return p < 0 ? Scalar(0) : weight_[joint] * std::sqrt(belief_.variance(p));
  }

  /// Unknown `p` is known to be this, independent of all others.
  void know(int p, Scalar mean, Scalar sd) { belief_.know(p, mean, sd); }
  /// What is known of unknown `p` gives way to what is new, with this standard deviation.
  void renew(int p, Scalar sd) {
    belief_.renew(p, sd);
    if constexpr (Further > 0)
      if (belief_.further(p) >= 0) lines_.forget(belief_.further(p));
  }
  /// Readings scatter more than they were taken to, see Belief::inflate().
  void inflate(Scalar times) { belief_.inflate(times); }
  /// Begins a row: its measurements share the errors of the jacks' readings.
  void begin_row() { belief_.begin_row(); }
  /// Whether prediction() has a derivative to go by: with slides(c), all of `cable` must slide (-1: no cable
  /// does in particular), and every other one whose friction shows in a number read with the standard
  /// deviation `sd`. Cost: a pass over the joints, and a question for each of them.
  template <class Slides>
  bool is_informative(const TrackerType& tracker, int cable, Scalar sd, const Slides& slides) const {
    for (int c = 0; c < tracker.model().cables.size(); ++c)
      if (matters(tracker, c, cable, sd) && !slides(c)) return false;
    return true;
  }
  /// Whether friction of cable `c` matters to prediction(), read with `sd` at `cable` (-1: at none).
  bool matters(const TrackerType& tracker, int c, int cable, Scalar sd) const {
    return c == cable || shows(tracker.model().cables[c], c, sd);
  }
  /// Whether it is known of every joint of a cable whether it slides.
  bool slides_throughout(const TrackerType& tracker, int c) const {
    return sliding_.slides_throughout(tracker, c, [&](int j) { return holds_for_sure(tracker, j); });
  }
  /// Standard deviation of the mu of a cable by that mu, where it is largest [-].
  Scalar relative_deviation(const TrackerType& tracker, int c) const {
    const auto& cable = tracker.model().cables[c];
    Scalar largest = 0;
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
      if (mu(j) > 0) largest = larger(largest, mu_deviation(j) / mu(j));
    return largest;
  }
  /// After prediction(): the standard deviation with which a reading of an instrument that has `sd` counts,
  /// where all of its readings are off alike with the variance `lasting`, see counted_variance(); zero if it
  /// tells nothing more. Cost: the square of the unknowns.
  Scalar counted_deviation(Scalar sd, Scalar lasting, const JackReadings& jacks) const {
    if (!(lasting > 0)) return sd;
    Scalar of_jacks = 0;
    for (int k = 0; k < jacks.size(); ++k)
      of_jacks += prediction_.by_jack[k] * prediction_.by_jack[k] * jacks[k].variance;
    const Scalar counted =
        counted_variance(belief_.variance_of_reading(prediction_.H), sd * sd + of_jacks, lasting);
    return std::sqrt(larger(counted - of_jacks, Scalar(0)));
  }
  /// Takes a reading into account (iterated update; Gelb, Applied Optimal Estimation, 1974, 6.1).
  /// prediction() has what is expected of it, and predict(prediction) makes it anew after the tracker has
  /// been relinearized. Returns `contradiction` if and only if the innovation is outside of the gate. Cost:
  /// that of Belief::innovate(), and in the worst case four times that of Tracker::adjust().
  template <class Predict>
  [[nodiscard]] Update update(TrackerType& tracker, const Predict& predict, const JackReadings& jacks,
                              const Measured<Scalar>& measured) {
    return update_by(
        tracker, [&] { return belief_.is_nonlinear() && relinearize(tracker, belief_.updated_mean()); },
        predict, jacks, measured);
  }
  /// The same with another rule: comes_closer(), after Belief::innovate(), returns whether it has brought the
  /// tracker to the mean that would follow.
  template <class ComesCloser, class Predict>
  [[nodiscard]] Update update_by(const TrackerType& tracker, const ComesCloser& comes_closer,
                                 const Predict& predict, const JackReadings& jacks,
                                 const Measured<Scalar>& measured) {
    for (int iteration = 1;; ++iteration) {
      keep_line(tracker);
      if (!belief_.innovate(prediction_, jacks, measured)) return Update::contradiction;
      if (!comes_closer() || iteration == most_iterations) {
        belief_.update(jacks);
        return Update::updated;
      }
      predict(prediction_);
    }
  }
  /// The wedge at this end has been seated: from here on unknown `p` is by how much further it was drawn in
  /// than the model has it, with the standard deviation `sd` [m]. Cost: that of renew().
  void remember_seating(TrackerType& tracker, int p, int cable, std::size_t end, Scalar sd) {
    keep_what_is_known(tracker, p);
    tracker.draw_in(p, cable, end, still_in(p, sd));
    belief_.renew(p, sd);
  }
  /// A cable is held from this end on now: from here on unknown `p` is the strain that it takes on by itself,
  /// with the standard deviation of FrictionPrior::drift_sd. Cost: that of renew().
  Status remember_drift(TrackerType& tracker, int p, int cable, std::size_t end) {
    keep_what_is_known(tracker, p);
    belief_.renew(p, prior_->drift_sd[cable]);
    return tracker.strain(p, cable, end, prior_->length);
  }
  /// That strain goes on changing: within an hour, or 900 rows if those take less, to anything that it can
  /// be, Eq. (39). Cost: a few operations.
  void diffuse(int p, int cable, Scalar dt) {
    constexpr Scalar hour = 3600, rows = 900;
    const Scalar most = prior_->drift_sd[cable] * prior_->drift_sd[cable], room = most - belief_.variance(p),
                 grown = larger(most / rows, most * dt / hour);
    if (room > 0) belief_.diffuse(p, grown < room ? grown : room);
  }
  /// Takes a reading into account that prediction() foretells, for the unknowns with is_of(p) alone. Returns
  /// `contradiction` if and only if the innovation is outside of the gate. Cost: that of Belief::innovate().
  template <class IsOf>
  [[nodiscard]] Update update_alone(const IsOf& is_of, const JackReadings& jacks,
                                    const Measured<Scalar>& measured) {
    if (!belief_.innovate(prediction_, jacks, measured)) return Update::contradiction;
    belief_.update_alone(is_of);
    return Update::updated;
  }
  /// After update_alone(): by how much the reading moves by what these unknowns were found to be since the
  /// tracker was there.
  template <class IsOf>
  Scalar moved(const IsOf& is_of) const {
    Scalar moved = 0;
    for (int p = 0; p < belief_.carried(); ++p)
      if (is_of(p)) moved += prediction_.H[p] * (belief_.mean(p) - belief_.linearized_at(p));
    return std::fabs(moved);
  }
  /// Brings the tracker to the strain that unknown `p` was found to be: of a cable that this end holds. Cost:
  /// that of Tracker::strain() and Tracker::adjust().
  Status follow_drift(TrackerType& tracker, int p, int cable, std::size_t end) {
    const Status status = tracker.strain(p, cable, end, prior_->length);
    return status ? tracker.adjust(friction(linear_part(tracker.condensed())),
                                   belief_.linearize_at(belief_.mean()))
                  : status;
  }
  /// Other loads than that of a jack begin to change: from here on its unknown error, with the standard
  /// deviation `sd` [N], is remembered wherever friction comes to rest. Cost: that of renew().
  void remember_load(TrackerType& tracker, const JackError<Scalar>& error, Scalar sd) {
    const int p = error.parameter;
    renew(tracker, p, sd);
    tracker.begin_load_error(error);
  }
  /// Unknown `p` is not known better than to `sd`.
  void widen(int p, Scalar sd) {
    const Scalar missing = sd * sd - belief_.variance(p);
    if (missing > 0) belief_.diffuse(p, missing);
  }
  /// Brings the tracker to friction as it is known now, if that is elsewhere by more than a tenth of a
  /// standard deviation: where a jack reverses, when joints slide back depends on it, and not in proportion.
  /// Cost: at worst that of Tracker::adjust().
  void come_to_what_is_known(TrackerType& tracker) {
    bool is_elsewhere = false;
    for (int p = 0; p < belief_.friction(); ++p) {
      const Scalar off = belief_.mean(p) - belief_.linearized_at(p);
      is_elsewhere |= off * off > Scalar(0.01) * belief_.variance(p);
    }
    if (is_elsewhere) static_cast<void>(relinearize(tracker, belief_.mean()));
  }
  /// From here on unknown `p` is another one, with the standard deviation `sd`; what is remembered of what it
  /// was stays a part of it, and forces as uncertain. Cost: that of Tracker::weigh(), and at worst of
  /// Tracker::adjust().
  void renew(TrackerType& tracker, int p, Scalar sd) {
    keep_what_is_known(tracker, p);
    tracker.weigh(p, still_in(p, sd));
    belief_.renew(p, sd);
  }

  /// Adds to `H` the derivatives, by the unknowns, of the logarithm of what `joints` joints in a row leave of
  /// a force where they all slide, held_between(). Cost: a pass over them.
  void add_log_slopes(const TrackerType& tracker, int first_joint, int joints, Values& H) const {
    for (int j = first_joint; j < first_joint + joints; ++j) {
      const Real rho = tracker.rho(j);
      if (unknown_of_[j] >= 0 && rho > 0)
        H[unknown_of_[j]] += static_cast<Scalar>(tracker.rho_slope(j) / rho);
    }
  }
  /// A number that is `value` where the filter is linearized, with the derivatives `H` and an error of this
  /// variance, is known not to be above zero, see Belief::bring_below_zero(). Returns false if the best
  /// estimate obeys that within the error, if nothing that matters is unknown, and if it is beyond five
  /// sigma: then nothing has changed. Cost: that of Belief::bring_below_zero().
  [[nodiscard]] bool bring_below_zero(int bound, Scalar value, const Values& H, Scalar variance) {
    const auto expected = [&] {
      Scalar number = value;
      for (int p = 0; p < belief_.carried(); ++p)
        number += H[p] * (belief_.mean(p) - belief_.linearized_at(p));
      return number;
    };
    const Scalar now = expected();
    return now > 0 && now * now > variance && belief_.variance_of_reading(H) > 0 &&
           belief_.bring_below_zero(bound, H, variance, expected);
  }
  /// The bound below which unknown `p` of friction would let a strut run away.
  static int lower_bound_of(int p) { return jack_bounds + p; }
  /// Takes back what that bound has taught since it was `before`.
  void put_back_lower_bound(TrackerType& tracker, int p, const typename BeliefType::Bound& before) {
    belief_.put_back_bound(lower_bound_of(p), before);
    static_cast<void>(relinearize(tracker, belief_.mean()));
  }
  /// Brings the tracker to these values of the unknowns. False if it has no state there: then it stays.
  bool relinearize(TrackerType& tracker, const Values& values) {
    const Values before = belief_.save().linearized_at, change = belief_.linearize_at(values);
    if (tracker.adjust(friction(linear_part(tracker.condensed())), change).ok()) return true;
    static_cast<void>(belief_.linearize_at(before));
    static_cast<void>(tracker.stay(friction(linear_part(tracker.condensed()))).ok());
    return false;
  }
  /// For who brings the tracker there in another way: the model is linearized at these values from here on.
  /// Returns by how much each unknown moves, for Tracker::adjust().
  Values linearize_at(const Values& values) { return belief_.linearize_at(values); }
  /// Unknown `p` will have this standard deviation and mean something else; what friction remembers of it
  /// elsewhere stays as uncertain as it is if it goes on with this part.
  Scalar still_in(int p, Scalar sd) const {
    return sd > 0 ? std::sqrt(larger(belief_.variance(p), Scalar(0))) / sd : Scalar(0);
  }
  /// Unknown `p` will mean something else: what is known of it goes into the tracker.
  void keep_what_is_known(TrackerType& tracker, int p) {
    if (belief_.mean(p) != belief_.linearized_at(p)) static_cast<void>(relinearize(tracker, belief_.mean()));
  }

 private:
  /// Whether a joint that sticks would with every mu that is likely. Struts that the cable alone holds hardly
  /// ever let it slide: what they leave to friction follows from how they lean.
  bool holds_for_sure(const TrackerType& tracker, int joint) const {
    if constexpr (TrackerType::Model::has_level) {
      const Scalar least = mu(joint) - 2 * mu_deviation(joint);
      return tracker.friction_used(joint) * mu(joint) < larger(least, mu(joint) / 4);
    }
    return false;
  }

  /// The line that readings of the instrument with prediction() have drawn stays where it is, DrawnLines.
  void keep_line(const TrackerType& tracker) {
    if constexpr (Further > 0) {
      if (!prediction_.has_zero || cell_zeros_.empty()) return;
      std::uint32_t slides = 0;  // a hash, with the prime of Fowler, Noll and Vo
      for (int j = 0; j < tracker.model().joints; ++j)
        slides = slides * 16777619u + static_cast<std::uint32_t>(tracker.limit(j));
      lines_.keep(
          belief_.further(prediction_.zero), slides, cell_zeros_.size(),
          [&](int k) { return prediction_.H[cell_zeros_[k]]; },
          [&](int k, Scalar by) { belief_.shear(prediction_.zero, cell_zeros_[k], by); });
    }
  }

  void depend(int c, int j, int p, Scalar weight) {
    unknown_of_[j] = static_cast<std::int16_t>(p);
    weight_[j] = weight;
    if (!(weight > 0)) return;
    // mu >= 0, and never quite locked.
    const Real most_mu = (prior_->capstan[c] ? Real(6) : Real(0.98)) / prior_->contact_factor[j];
    const auto nominal = static_cast<Scalar>(prior_->mu[j]);
    belief_.bound(p, -nominal / weight, (static_cast<Scalar>(most_mu) - nominal) / weight);
  }
  /// Adds the unknowns of the cells at all ends of this kind, up to so many in all. Returns how many are
  /// missing.
  int add_instruments(const Linear& model, End kind, int most) {
    int missing = 0;
    for (int c = 0; c < model.cables.size(); ++c)
      for (std::size_t end = 0; end < 2 && !model.cables[c].closed; ++end) {
        const LoadCell<Scalar>& cell = prior_->cell[c][end];
        if (model.cables[c].ends[end] != kind || (kind == End::anchored && !(cell.sd > 0))) continue;
        missing += instruments_.at(c, end).add(
            cell, [&](Scalar sd) { return belief_.size() < most ? belief_.add(sd) : -1; });
        const int zero = instruments_.at(c, end).zero;
        if (kind == End::jacked && zero >= 0) cell_zeros_.add(static_cast<std::int16_t>(zero));
      }
    return missing;
  }
  template <class CableLayout>
  void scatters(int c, const CableLayout& cable, int parameter, Scalar nominal) {
    const auto contact_factor = [&](int j) {
      return unknown_of_[j] < 0 ? Scalar(0) : static_cast<Scalar>(prior_->contact_factor[j]);
    };
    scatter_.find(
        cable, parameter, nominal, [&](int j) { return contact_factor(j) * weight_[j]; },
        [&](int j) { return contact_factor(j) * prior_->scatter[c] * static_cast<Scalar>(prior_->mu[j]); });
  }
  JointFriction<Real> friction_of(const Linear& model, int j, const Values& unknowns) const {
    const int p = unknown_of_[j];
    if (p < 0 || !(weight_[j] > 0)) return {};
    int c = 0;
    while (j >= model.cables[c].first_joint + model.cables[c].joints()) ++c;
    const Scalar at = unknowns[p];
    const auto weight = static_cast<Real>(weight_[j]);
    // The bound of what is unknown is rounded: below zero friction would push, and no state obeys that.
    const Real mu = larger(prior_->mu[j] + weight * static_cast<Real>(at), Real(0));
    const auto limit = prior_->limit(c, j, mu);
    return {at == 0 ? model.rho[j] : limit.rho, p, weight * limit.slope};
  }
  /// Whether friction of cable `c` matters to the predicted number.
  template <class CableLayout>
  bool shows(const CableLayout& cable, int c, Scalar sd) const {
    Scalar square = 0;
    for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j) {
      const int p = unknown_of_[j];
      if (p < 0) continue;
      const Scalar part = prediction_.H[p] * prior_->mu_sd[c];
      square += part * part;
      if (prior_->shared[c]) break;
    }
    return square > negligible * sd * (negligible * sd);
  }

  const PriorType* prior_ = nullptr;
  BeliefType belief_;
  Instruments<Scalar, Cap> instruments_;
  FixedList<std::int16_t, max_jacks<Cap>> cell_zeros_;  // the unknowns of cells at jacks
  LinesType lines_;
  FrictionScatter<Scalar, Cap> scatter_;
  PredictionType prediction_;
  SlidingCheck<Cap> sliding_;
  FixedArray<std::int16_t, Cap::joints> unknown_of_;
  FixedArray<Scalar, Cap::joints> weight_;  // of the unknown in mu
};

}  // namespace taut
