// Load cells at anchored ends as measurements, one by one or gathered.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/between_readings.hpp"
#include "taut/estimation/cable_end.hpp"
#include "taut/estimation/cell_watch.hpp"
#include "taut/estimation/force_estimate.hpp"
#include "taut/estimation/friction_filter.hpp"
#include "taut/estimation/gathered.hpp"
#include "taut/estimation/since_lock_off.hpp"
#include "taut/estimation/zero_at_rest.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// Anchored ends whose load cell is known. A reading there is
///     y = T + dT/dF (raw - driven) + dT/dmu (mu - mu_0) + noise,
/// where the noise is that of the cell and, through dT/dF, of the raw jack readings: both independent from
/// row to row. With one jack and one such cell, readings between which only the load changes are gathered and
/// taken into account together.
template <class FilterType, class Jacks>
class FarEnds {
 public:
  using Scalar = typename FilterType::Scalar;
  using Cap = typename FilterType::Cap;
  using TrackerType = typename FilterType::TrackerType;
  using EndType = CableEnd<Cap>;
  /// What has been gathered so far.
  struct State {
    Gathered<Scalar> gathered;
    std::uint8_t learned = 0;                              ///< readings since something has happened
    FixedArray<CellWatch<Scalar>, 2 * Cap::cables> watch;  ///< over the cells in the order of ends()
    FixedArray<Scalar, 2 * Cap::cables> bent;  ///< variance that forces there have beside a line [N^2]
    FixedArray<BetweenReadings<Scalar>, 2 * Cap::cables> between;
    FixedArray<SinceLockOff<Scalar>, 2 * Cap::cables> since_lock_off;
  };

  /// Finds the ends; after FilterType::start() and Jacks::start().
  template <class CondensedType>
  void start(const CondensedType& model, const FilterType& filter, const Jacks& jacks) {
    ends_.clear();
    for (int c = 0; c < model.cables.size(); ++c)
      for (std::size_t end = 0; end < 2 && !model.cables[c].closed; ++end)
        if (model.cables[c].ends[end] == End::anchored && filter.prior().cell[c][end].sd > 0)
          state_.watch[ends_.add(EndType::of(c, end))].start(filter.prior().cell[c][end].noise());
    can_gather_ = ends_.size() == 1 && jacks.size() == 1 && filter.belief().has_friction();
    state_.gathered = {};
    state_.learned = 0;
    state_.bent.fill(Scalar(0));
    state_.between.fill({});
    state_.since_lock_off.fill({});
  }
  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }

  /// Two a cable at most.
  const FixedList<EndType, 2 * Cap::cables>& ends() const { return ends_; }
  /// The number of the cell at an end, or -1.
  int find(int cable, std::size_t end) const {
    for (int e = 0; e < ends_.size(); ++e)
      if (ends_[e].is(cable, end)) return e;
    return -1;
  }

  void begin_row() { has_gathered_ = false; }
  void begin_memory() { corrects_memory_ = false; }
  /// Since begin_memory(): whether a reading has corrected what friction remembers of loads.
  bool corrects_memory() const { return corrects_memory_; }
  /// Something has happened: what is read next is worth most, and none of it waits for long.
  void restart() { state_.learned = 0; }
  bool has_waiting() const { return state_.gathered.size > 0; }
  /// How many readings wait.
  int waiting() const { return state_.gathered.size; }
  /// Whether a reading of this row is among those that wait.
  bool has_waiting_of_row() const { return has_gathered_; }
  /// Whether readings of the only cell are gathered at present: with a load to go by; what has begun goes on.
  bool gathers(const Jacks& jacks) const {
    return (has_waiting() || (can_gather_ && room() > 1)) && (jacks[0].is_new || jacks[0].locked);
  }

  /// The load of a jack has left the line that it was on.
  void bend() {
    for (int e = 0; e < ends_.size(); ++e) {
      state_.watch[e].noise.bend();
      state_.between[e].drop();
    }
  }
  /// From here on forces at the ends of a cable differ by variance(segment) [N^2] from a straight line in
  /// friction: their cells teach no more than that leaves.
  template <class ModelType, class Variance>
  void set_bent(const ModelType& model, int cable, const Variance& variance) {
    for (int e = 0; e < ends_.size(); ++e)
      if (ends_[e].cable() == cable) state_.bent[e] = variance(ends_[e].segment(model));
  }
  BetweenReadings<Scalar>& between(int e) { return state_.between[e]; }
  CellWatch<Scalar>& watch(int e) { return state_.watch[e]; }
  const CellWatch<Scalar>& watch(int e) const { return state_.watch[e]; }
  SinceLockOff<Scalar>& since_lock_off(int e) { return state_.since_lock_off[e]; }
  /// By how much cell `e` is off the model, or what it was at lock-off, where that is more than chance allows
  /// [N]; else zero.
  Scalar misfit_of(int e) const {
    return larger(state_.watch[e].fit.misfit(), state_.since_lock_off[e].misfit());
  }
  /// Whether it is; asked in every row.
  bool misfits(int e) const {
    const auto& since = state_.since_lock_off[e];
    return state_.watch[e].fit.misfit() > 0 || (since.has_begun() && since.misfit() > 0);
  }
  /// Whether some cell is off the model by more than chance allows.
  bool misfits() const {
    for (int e = 0; e < ends_.size(); ++e)
      if (misfits(e)) return true;
    return false;
  }
  /// By how much the cells of a cable are off the model, where that is more than chance allows [N].
  Scalar misfit(int cable) const {
    Scalar largest = 0;
    for (int e = 0; e < ends_.size(); ++e)
      if (ends_[e].cable() == cable) largest = larger(largest, misfit_of(e));
    return largest;
  }
  /// Takes a reading [N] of cell `e` into account at once, if FilterType::is_informative() with slides(c).
  /// Cost: that of FilterType::update().
  template <class Slides>
  [[nodiscard]] Update measure(int e, Scalar reading, TrackerType& tracker, FilterType& filter,
                               const Jacks& jacks, const Slides& slides) {
    const EndType& end = ends_[e];
    const Scalar sd = state_.watch[e].sd;
    const auto predict = [&](auto& prediction) { predict_at(end, tracker, filter, jacks, prediction); };
    predict(filter.prediction());
    if (!filter.is_informative(tracker, end.cable(), sd, slides))
      return compare(e, reading, tracker, filter, jacks);
    const auto at_rest = zero_at_rest(e, tracker, filter, jacks);
    const auto loads = jacks.readings(filter.prior());
    if (at_rest.open_zero(reading,
                          [&] { return filter.belief().expect(filter.prediction(), loads, Scalar(0)); }))
      return Update::contradiction;
    const Scalar lasting = variance_that_lasts(e, filter, jacks);
    const Scalar counted = filter.counted_deviation(sd, lasting, loads);
    if (!(counted > 0)) return look(e, reading, tracker, filter, jacks);
    if (counts_learned() && !at_rest.tells_zero()) count_learned(1);
    const Update update = filter.update(tracker, predict, loads, {reading, counted, Scalar(0)});
    note(e, reading, lasting, filter);
    return update;
  }
  /// Compares a reading [N] of cell `e` with what is expected, and corrects with it what friction remembers
  /// of loads, or the zero of the cell where that is told. Cost: that of FilterType::update_alone().
  [[nodiscard]] Update compare(int e, Scalar reading, const TrackerType& tracker, FilterType& filter,
                               const Jacks& jacks) {
    compare(e, reading, false, tracker, filter, jacks);
    return Update::no_information;
  }
  /// The same where a load of the cable may have turned, so that its joints stick here: they may slide yet.
  void compare_in_doubt(int e, Scalar reading, const TrackerType& tracker, FilterType& filter,
                        const Jacks& jacks) {
    compare(e, reading, true, tracker, filter, jacks);
  }
  /// A reading [N] of cell `e` of a cable that is locked corrects what drifts there, the unknowns with
  /// is_of(p), through the elastic response; of friction nothing is learned. Cost: that of
  /// FilterType::update_alone().
  template <class IsOf>
  [[nodiscard]] Update correct(int e, Scalar reading, const TrackerType& tracker, FilterType& filter,
                               const Jacks& jacks, const IsOf& is_of) {
    const Scalar sd = state_.watch[e].sd;
    predict_at(ends_[e], tracker, filter, jacks, filter.prediction());
    const Scalar lasting = variance_that_lasts(e, filter, jacks);
    const auto loads = jacks.readings(filter.prior());
    const Scalar counted = filter.counted_deviation(sd, lasting, loads);
    if (!(counted > 0)) return look(e, reading, tracker, filter, jacks);
    const Update update = filter.update_alone(is_of, loads, {reading, counted, Scalar(0)});
    note(e, reading, lasting, filter);
    return update;
  }
  /// What cell `e` is expected to read, with the variance of that. Cost: that of Belief::expect().
  Expected<Scalar> expect(int e, const TrackerType& tracker, FilterType& filter, const Jacks& jacks) {
    const Scalar sd = state_.watch[e].sd;
    predict_at(ends_[e], tracker, filter, jacks, filter.prediction());
    auto reading = filter.belief().expect(filter.prediction(), jacks.readings(filter.prior()), sd);
    reading.variance += variance_that_lasts(e, filter, jacks);
    return reading;
  }
  /// What the mean of so many readings of cell `e` is expected to be, with its variance, were unknown `p`
  /// where the tracker is linearized. Cost: that of Belief::expect().
  Expected<Scalar> expect_without(int p, int e, int readings, const TrackerType& tracker, FilterType& filter,
                                  const Jacks& jacks) {
    auto& prediction = filter.prediction();
    predict_at(ends_[e], tracker, filter, jacks, prediction);
    prediction.H[p] = 0;
    auto mean = filter.belief().expect(prediction, jacks.readings(filter.prior()), Scalar(0));
    const Scalar sd = state_.watch[e].sd;
    mean.variance += sd * sd / static_cast<Scalar>(readings) + variance_that_lasts(e, filter, jacks);
    return mean;
  }
  /// Whether readings of this row are off by something in common and those that wait are not, or the other
  /// way round: together all of them would be.
  bool mixes(const FilterType& filter, const Jacks& jacks) const {
    return has_waiting() && (variance_in_common(filter, jacks) > 0) != (state_.gathered.lasting > 0);
  }
  /// Where gathers(): gathers a reading [N] of the only cell. Cost: a few operations; that of update() with
  /// the last one for which there is room.
  [[nodiscard]] Update gather(Scalar reading, TrackerType& tracker, FilterType& filter, const Jacks& jacks) {
    Gathered<Scalar>& gathered = state_.gathered;
    const Scalar driven = jacks[0].driven.force, load = jacks[0].seen(jacks.in(filter.prior().cell, 0));
    if (gathered.size == 0 && !begin_gathering(driven, tracker, filter, jacks))
      return compare(0, reading, tracker, filter, jacks);
    const Scalar off = gathered.off_line(load, reading), lasting = variance_in_common(filter, jacks);
    state_.watch[0].take(reading, reading - off, gathered.of_model + lasting,
                         gathered.spread - gathered.of_model);
    if (!(off * off <= FilterType::BeliefType::gate * (gathered.spread + lasting)))
      return Update::contradiction;
    gathered.lasting = larger(gathered.lasting, lasting);
    gathered.add(load, driven, off);
    has_gathered_ = true;
    return gathered.is_full() ? learn(tracker, filter, jacks) : Update::waits;
  }
  /// Takes what waits, if anything does, into account as one measurement. Cost: that of FilterType::update().
  [[nodiscard]] Update learn(TrackerType& tracker, FilterType& filter, const Jacks& jacks) {
    if (!has_waiting()) return Update::waits;
    const Gathered<Scalar> all = state_.gathered;
    state_.gathered.size = 0;
    if (counts_learned() && !zero_at_rest(0, tracker, filter, jacks).tells_zero()) count_learned(all.size);
    const Scalar driven = jacks[0].driven.force, back = all.driven() - driven;
    const auto predict = [&](auto& prediction) {
      predict_at(ends_[0], tracker, filter, jacks, prediction);
      if (back == 0) return;
      for (int p = 0; p < filter.belief().carried(); ++p)
        prediction.H[p] += back * sensitivity_slope(p, tracker);
      const int gain = filter.instruments().at(ends_[0].cable(), ends_[0].end).gain;
      if (gain >= 0) prediction.H[gain] += back * prediction.by_jack[0];
    };
    predict(filter.prediction());
    typename FilterType::JackReadings readings;
    readings.add({all.jack() - driven, all.jack_variance * all.share()});
    const Scalar sd = state_.watch[0].sd * std::sqrt(all.share()),
                 counted = filter.counted_deviation(sd, all.lasting, readings);
    if (!(counted > 0)) return Update::waits;
    return filter.update(tracker, predict, readings, {all.reading(), counted, all.spread});
  }

 private:
  /// The variance of what readings of cell `e`, and of the jacks at the same time, have in common from row to
  /// row, c of Eq. (54), and what its force is off a straight line by. `by_jack(k)` is its derivative.
  template <class ByJack>
  Scalar variance_that_lasts(int e, const FilterType& filter, const Jacks& jacks,
                             const ByJack& by_jack) const {
    const Scalar own = state_.watch[e].lasts;
    Scalar variance = own * own + state_.bent[e];
    for (int k = 0; k < jacks.size(); ++k) {
      const Scalar lasting = jacks[k].lasting(jacks.in(filter.prior().cell, k)), doubt = jacks[k].doubt(),
                   by = by_jack(k);
      variance += by * by * (lasting * lasting + doubt * doubt);
    }
    return variance;
  }
  /// The same after predict_at().
  Scalar variance_that_lasts(int e, const FilterType& filter, const Jacks& jacks) const {
    return variance_that_lasts(e, filter, jacks, [&](int k) { return filter.prediction().by_jack[k]; });
  }
  /// The same of the only cell, once its readings are gathered.
  Scalar variance_in_common(const FilterType& filter, const Jacks& jacks) const {
    return variance_that_lasts(0, filter, jacks, [&](int) { return state_.gathered.slope; });
  }
  /// The same after predict_at(), while joints stick: which ones do depends on friction, and what it holds is
  /// as uncertain.
  Scalar variance_while_stuck(int e, const TrackerType& tracker, const FilterType& filter,
                              const Jacks& jacks) const {
    const auto& cable = tracker.model().cables[ends_[e].cable()];
    const Scalar held = tracker.tension(cable.end_segment(0)) - tracker.tension(cable.end_segment(1)),
                 in_doubt = held * filter.relative_deviation(tracker, ends_[e].cable());
    return variance_that_lasts(e, filter, jacks) + in_doubt * in_doubt;
  }
  /// Both of these in one. Of friction a reading teaches nothing while joints stick, and of what it remembers
  /// of loads as much as does not last, Eq. (70). Before anything pulls it tells the zero of the cell, no
  /// better than it is known that the jack holds nothing.
  [[gnu::noinline]] void compare(int e, Scalar reading, bool in_doubt, const TrackerType& tracker,
                                 FilterType& filter, const Jacks& jacks) {
    auto& watch = state_.watch[e];
    predict_at(ends_[e], tracker, filter, jacks, filter.prediction());
    const auto at_rest = zero_at_rest(e, tracker, filter, jacks);
    const auto loads = jacks.readings(filter.prior());
    Scalar lasting = variance_while_stuck(e, tracker, filter, jacks);
    if (in_doubt) {
      for (int k = 0; k < jacks.size(); ++k) {
        const Scalar part =
            carried_over(tracker, jacks.end(k), ends_[e].segment(tracker.model())) * jacks[k].at.sd;
        lasting += part * part;
      }
    } else {
      const Expected<Scalar> force = filter.belief().expect(filter.prediction(), loads, Scalar(0));
      watch.take(reading, force.value, force.variance + lasting, watch.sd * watch.sd);
      if (at_rest.open_zero(reading, [&] { return force; })) return;
    }
    if (at_rest.tells_zero()) lasting += at_rest.variance_of_zeros();
    const Scalar counted = filter.counted_deviation(watch.sd, lasting, loads);
    if (!(counted > 0) || !watch.noise.is_other()) return;
    const auto is_told = [&](int p) { return at_rest.tells(p) || jacks.remember(p); };
    corrects_memory_ = filter.update_alone(is_told, loads, {reading, counted, Scalar(0)}) == Update::updated;
  }
  ZeroAtRest<FilterType, Jacks> zero_at_rest(int e, const TrackerType& tracker, FilterType& filter,
                                             const Jacks& jacks) const {
    return {ends_[e], state_.watch[e].sd, tracker, filter, jacks};
  }
  /// A reading that tells nothing new is compared all the same.
  Update look(int e, Scalar reading, const TrackerType& tracker, FilterType& filter, const Jacks& jacks) {
    static_cast<void>(compare(e, reading, tracker, filter, jacks));
    return Update::waits;
  }
  /// After an update: the innovation of cell `e`.
  void note(int e, Scalar reading, Scalar lasting, const FilterType& filter) {
    const auto& belief = filter.belief();
    const Scalar sd = state_.watch[e].sd;
    state_.watch[e].take(reading, reading - belief.innovation(), belief.innovation_variance() + lasting,
                         sd * sd);
  }
  template <class PredictionType>
  static void predict_at(const EndType& end, const TrackerType& tracker, const FilterType& filter,
                         const Jacks& jacks, PredictionType& prediction) {
    predict_tension(tracker, end.segment(tracker.model()), filter.belief(), jacks, prediction);
    const InstrumentUnknowns& own = filter.instruments().at(end.cable(), end.end);
    if (own.gain >= 0) prediction.H[own.gain] = prediction.value;
    depend_on_zero(own.zero, prediction);
  }
  Scalar sensitivity_slope(int p, const TrackerType& tracker) const {
    return tracker.sensitivity_slope(p, 0, ends_[0].segment(tracker.model()));
  }
  /// For readings that are gathered. Soon after something has happened little is known.
  int room() const { return state_.learned / 4; }
  /// Whether readings that teach of friction count yet: none does before anything pulls.
  bool counts_learned() const { return state_.learned < 4 * Gathered<Scalar>::capacity; }
  void count_learned(int readings) { state_.learned = static_cast<std::uint8_t>(state_.learned + readings); }
  /// Finds the line that readings are compared with. False if the cell says nothing at present.
  bool begin_gathering(Scalar driven, const TrackerType& tracker, FilterType& filter, const Jacks& jacks) {
    const auto& belief = filter.belief();
    auto& prediction = filter.prediction();
    const Scalar sd = state_.watch[0].sd;
    const auto jack = jacks[0].reading(jacks.in(filter.prior().cell, 0));
    predict_at(ends_[0], tracker, filter, jacks, prediction);
    if (!filter.is_informative(tracker, ends_[0].cable(), sd,
                               [&](int c) { return filter.slides_throughout(tracker, c); }))
      return false;
    Gathered<Scalar>& gathered = state_.gathered;
    gathered.begin(driven + jack.beyond, driven, room());
    const Scalar by_jack = prediction.by_jack[0];
    gathered.slope = by_jack;
    gathered.level = prediction.value + by_jack * jack.beyond;
    for (int p = 0; p < belief.in_use(); ++p) {
      const Scalar change = belief.mean(p) - belief.linearized_at(p);
      if (change == 0) continue;
      gathered.level += prediction.H[p] * change;
      if (p < belief.carried()) gathered.slope += sensitivity_slope(p, tracker) * change;
    }
    const int gain = filter.instruments().at(ends_[0].cable(), ends_[0].end).gain;
    if (gain >= 0) gathered.slope += by_jack * belief.mean(gain);
    gathered.jack_variance = jack.variance;
    gathered.of_model = belief.variance_of_reading(prediction.H);
    gathered.spread = sd * sd + by_jack * by_jack * jack.variance + gathered.of_model;
    return true;
  }

  FixedList<EndType, 2 * Cap::cables> ends_;
  State state_;
  bool can_gather_ = false;
  bool has_gathered_ = false;  // in this row
  bool corrects_memory_ = false;
};

}  // namespace taut
