// A scene at work: readings in, forces with their standard deviations out.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

#include "instruments/reading.hpp"
#include "monitor/alarms.hpp"
#include "monitor/estimator_alarm.hpp"
#include "monitor/frame.hpp"
#include "monitor/known_past.hpp"
#include "monitor/scene_sources.hpp"
#include "monitor/settings.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/unknown_past.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/sample.hpp"
#include "taut/tracking/verify.hpp"

namespace monitor {

/// How the last sample was answered.
struct Outcome {
  taut::Status status;
  Quality quality = Quality::none;
  float fraction = 1;  ///< of the path to the sample
  int events = 0;
};

/// How far an estimator has come on the path to a sample, in one call after the other.
struct Way {
  taut::Status status;
  float rest = 1;  ///< of the path
  int events = 0;

  void add(const taut::Progress<float>& progress) {
    status = progress.status;
    rest *= progress.fraction < 1 ? 1 - progress.fraction : 0;
    events += progress.events;
  }
  bool is_whole() const { return status.ok() && rest == 0; }
  bool is_over() const { return !status.ok() || rest == 0; }
};

/// Holds all its storage: make it static.
template <class Source, class Settings>
class Session {
 public:
  using Cap = typename Source::Capacity;
  using Model = typename Source::Model;
  using Estimator = taut::Estimator<Model, Source::unknowns, Source::reading_unknowns>;
  using Findings = typename Estimator::Alarms;
  using Past = std::conditional_t<Settings::doubts_past, taut::UnknownPast<Estimator>, KnownPast<Estimator>>;
  static_assert(Cap::cables <= most_coded_cables, "a code of an alarm has no room for the cable's number");

  /// The load cell of one end, and the wedge if it is jacked.
  struct Cell {
    float zero = 0;          ///< what the cell says without load [N]
    float last = 0;          ///< what it said last [N]
    std::uint32_t same = 0;  ///< how often in a row
    bool locked = false;
  };
  /// All that a power failure must not take.
  struct State {
    taut::FixedArray<std::array<Cell, 2>, Cap::cables> cells;
    Outcome outcome;
    float waited = 0;
    Findings findings;
    typename Past::Phase past;
    typename Estimator::State estimator;
  };
  static_assert(std::is_trivially_copyable_v<State>, "the record keeps bytes");

  /// Most numbers of a sample beside its time.
  static constexpr int most_numbers = Cap::loads + 4 * Cap::cables;
  /// Most things that the estimator finds odd in one sample.
  static constexpr int most_findings = Findings::capacity() + (Settings::doubts_past ? Cap::cables : 0);
  /// Longest bodies of the frames of a sample and of its answer.
  static constexpr int most_sample = 1 + 2 * 9 + 9 * most_numbers;
  static constexpr int most_answer =
      1 + 2 + 9 * 8 + 9 * (2 * Cap::segments + 5 * Cap::joints + 2 * Cap::cables + Cap::struts) +
      Cap::joints + 2 + 9 * most_findings;
  /// Most bytes that are kept: a State, and while the past is not known that of a second estimator.
  static constexpr std::size_t most_kept =
      sizeof(State) + (Settings::doubts_past ? sizeof(typename Estimator::State) : 0);

  /// Begins with one of the source's scenes, without load unless the first sample is under load. The answer
  /// says whether the scene can be used.
  taut::Status begin(int number) {
    cells_ = {};
    past_.reset();
    findings_.clear();
    waited_ = 0;
    outcome_ = {};
    outcome_.status = source_.prepare(number);
    if (outcome_.status)
      outcome_.status = estimator_.start(source_.model(), prior(), alarm_limits(), source_.strokes()).status;
    outcome_.quality = outcome_.status ? Quality::held : Quality::none;
    usable_ = outcome_.status.ok();
    return outcome_.status;
  }
  bool usable() const { return usable_; }
  /// The counts and the layout of its cables: what it says in whichever theory.
  const taut::Condensed<float, Cap>& model() const { return taut::linear_part(source_.model()); }
  const taut::FrictionPrior<float, Cap>& prior() const { return source_.prior(); }
  const Outcome& outcome() const { return outcome_; }

  /// What must be the same for a record to be read back.
  std::uint32_t maker() const {
    return usable_ ? fingerprint(source_.model(), prior(), source_.strokes()) : 0;
  }
  /// The state, until the next call; above_size() says whether there is more.
  const State& save() {
    kept_.cells = cells_;
    kept_.outcome = outcome_;
    kept_.waited = waited_;
    kept_.findings = findings_;
    kept_.past = past_.phase();
    // In its place: a copy on the way would need the stack.
    new (&kept_.estimator) typename Estimator::State(estimator_.save());
    return kept_;
  }
  /// Bytes of the second estimator's state that belongs to kept(), or 0.
  std::size_t above_size() const {
    return Past::has_above(kept_.past) ? sizeof(typename Estimator::State) : 0;
  }
  /// After save(), in the place of the first estimator's.
  const typename Estimator::State& save_above() {
    if constexpr (Settings::doubts_past) new (&kept_.estimator) typename Estimator::State(past_.save());
    return kept_.estimator;
  }
  /// Room for a state that restore() is to take, and then for that of the second estimator.
  State& kept() { return kept_; }
  bool restore() {
    cells_ = kept_.cells;
    outcome_ = kept_.outcome;
    waited_ = kept_.waited;
    findings_ = kept_.findings;
    return estimator_.restore(source_.model(), prior(), kept_.estimator, alarm_limits(), source_.strokes())
        .ok();
  }
  /// After restore(), whether there is a second estimator or not.
  bool restore_past() {
    if constexpr (Settings::doubts_past) {
      const taut::Status status = past_.restore(kept_.past, kept_.estimator, source_.model(), prior(),
                                                alarm_limits(), source_.strokes());
      return status.ok();
    }
    return true;
  }

  // Commands; `cable` and `end` are checked.

  /// Null if there is no such end.
  Cell* cell(std::uint32_t cable, std::uint32_t end) {
    if (!usable_ || cable >= static_cast<std::uint32_t>(model().cables.size()) || end > 1) return nullptr;
    if (model().cables[static_cast<int>(cable)].closed) return nullptr;
    return &cells_[static_cast<int>(cable)][end];
  }
  /// Of an end that there is.
  bool is_jacked(std::uint32_t cable, std::uint32_t end) const {
    return model().cables[static_cast<int>(cable)].ends[end] == taut::End::jacked;
  }

  /// Reads the numbers of a sample: the time since the last one, the factor of every load pattern, then what
  /// the instruments of every end say. Nothing but them is changed. `Numbers` is a Fields, or has its
  /// real(), reading() and done().
  template <class Numbers>
  bool read(Numbers& fields) {
    bool fits = usable_ && fields.real(readings_.dt) && readings_.dt > 0 && std::isfinite(readings_.dt);
    for (int i = 0; fits && i < model().loads; ++i) fits = fields.real(readings_.sample.factor[i]);
    for_each_end([&](int c, std::size_t end, bool jacked) {
      auto& given = readings_.ends[c][end];
      fits = fits && fields.reading(given.has_force, given.force) &&
             (!jacked || fields.reading(given.has_stroke, given.stroke));
    });
    return fits && fields.done();
  }
  /// How many numbers a sample has beside its time.
  int count_numbers() const {
    int count = model().loads;
    for_each_end([&](int, std::size_t, bool jacked) { count += jacked ? 2 : 1; });
    return count;
  }
  /// Asks `instrument(cable, end, quantity)` for what the sample that was read does not have; `fill` puts it
  /// there.
  template <class Instrument, class Fill>
  void read_instruments(Instrument instrument, Fill fill) {
    for_each_end([&](int c, std::size_t end, bool jacked) {
      auto& given = readings_.ends[c][end];
      fill(given.has_force, given.force, instrument(c, end, instruments::Quantity::force));
      if (jacked) fill(given.has_stroke, given.stroke, instrument(c, end, instruments::Quantity::stroke));
    });
  }
  /// Answers the sample that was read. `feed` is called between bounded pieces of work.
  template <class Feed>
  Alarms take(const CellLimits& limits, Feed feed) {
    Alarms alarms;
    const bool can_be_used = check_readings(limits, alarms);
    findings_.clear();
    outcome_ = {};
    if (!can_be_used) {
      outcome_.quality = Quality::held;
      waited_ += readings_.dt;
      return alarms;
    }
    readings_.dt += waited_;
    waited_ = 0;
    past_.look(source_.model(), prior(), readings_);
    keep_strokes();
    past_.withhold(source_.model(), readings_);
    Way below, above;
    if (!past_.is_unknown()) above.rest = 0;
    for (int call = 0; call < Settings::most_calls && !(below.is_over() && above.is_over()); ++call) {
      constexpr int budget =
          Settings::event_budget > 0 ? Settings::event_budget : Estimator::TrackerType::default_budget;
      if (!below.is_over()) {
        below.add(estimator_.advance(readings_, budget));
        feed();
      }
      if (!above.is_over()) {
        above.add(
            past_.advance(source_.model(), prior(), alarm_limits(), source_.strokes(), readings_, budget));
        feed();
      }
      // They are taken; what follows is the rest of the path.
      forget_readings();
    }
    if (below.is_whole() && above.is_whole()) finish_row();
    findings_ = estimator_.alarms();
    outcome_.status = below.status ? above.status : below.status;
    outcome_.fraction = 1 - (below.rest > above.rest ? below.rest : above.rest);
    outcome_.events = below.events + above.events;
    judge(alarms);
    return alarms;
  }

  /// Adds the answer to a frame, from the estimator as it is.
  template <class Writer>
  void write(Writer& frame) {
    frame.number(outcome_.events);
    frame.real(outcome_.fraction);
    frame.number(static_cast<int>(outcome_.status.code));
    frame.number(static_cast<int>(outcome_.status.place));
    frame.number(outcome_.status.index);
    frame.number(outcome_.status.cable);
    if (!usable_) return;
    respond();
    const int segments = model().segments, joints = model().joints;
    for (int i = 0; i < segments; ++i) frame.real(response_.tension[i]);
    for (int j = 0; j < joints; ++j) frame.real(response_.slip[j]);
    if (joints > 0) frame.letter(state_letter(0));
    for (int j = 1; j < joints; ++j) frame.more(state_letter(j));
    for (int j = 0; j < joints; ++j) frame.real(response_.contact[j]);
    for (int j = 0; j < joints; ++j) frame.real(response_.friction[j]);
    taut::for_each_jacked_end(model().cables,
                              [&](int c, std::size_t end) { frame.real(response_.extension[c][end]); });
    for (int i = 0; i < source_.strut_count(); ++i) frame.real(response_.strut[i]);
    for (int i = 0; i < segments; ++i) frame.real(deviation(i));
    for (int j = 0; j < joints; ++j) frame.real(estimator_.mu(j));
    for (int j = 0; j < joints; ++j) frame.real(estimator_.mu_deviation(j));
    for_each_finding([&](const taut::Alarm& finding) { frame.number(code_of(finding)); });
  }

  // The same answer, a number at a time.

  /// From the estimator as it is; needs a usable scene. What follows is of the last call.
  void respond() {
    estimator_.respond(response_, source_.struts());
    past_.respond(estimator_, response_);
  }
  const taut::Response<float, Cap>& response() const { return response_; }
  int strut_count() const { return source_.strut_count(); }
  /// Standard deviation of the tension of a segment [N].
  float deviation(int segment) const { return past_.estimate(estimator_, segment).deviation; }
  float mu(int joint) const { return estimator_.mu(joint); }
  float mu_deviation(int joint) const { return estimator_.mu_deviation(joint); }
  /// What the estimator finds odd in the last sample.
  template <class Call>
  void for_each_finding(Call call) const {
    for (const taut::Alarm& finding : findings_) call(finding);
    for (int c = 0; c < model().cables.size(); ++c)
      if (!past_.is_wiped_out(estimator_, model().cables[c]))
        call(taut::Alarm::of(taut::Alarm::Kind::unknown_past, c, 0));
  }

 private:
  using StrokesType = typename Source::StrokesType;

  /// Those of the site, with the largest noise of strokes.
  decltype(auto) alarm_limits() const {
    if constexpr (StrokesType::capacity() == 0) {
      return (Settings::alarm_limits);
    } else {
      float sd = 0;
      for (const auto& stroke : source_.strokes()) sd = taut::larger(sd, stroke.sd);
      return Settings::alarm_limits.with_stroke_noise(sd);
    }
  }

  char state_letter(int joint) const {
    switch (response_.state[joint]) {
      case taut::JointState::stick:
        return 's';
      case taut::JointState::forward:
        return 'f';
      case taut::JointState::backward:
        return 'b';
      case taut::JointState::open:
        return 'o';
    }
    return '?';
  }

  /// Every end of every open cable.
  template <class Call>
  void for_each_end(Call call) const {
    for (int c = 0; c < model().cables.size(); ++c)
      for (std::size_t end = 0; end < 2 && !model().cables[c].closed; ++end)
        call(c, end, model().cables[c].ends[end] == taut::End::jacked);
  }
  void forget_readings() {
    readings_.dt = 0;
    for_each_end(
        [this](int c, std::size_t end, bool) { readings_.ends[c][end] = taut::EndReading<float>(); });
  }

  /// From what was read to what is used; says what is wrong. False if the sample is of no use: a factor or a
  /// jack is out of range.
  bool check_readings(const CellLimits& limits, Alarms& alarms) {
    bool can_be_used = true;
    for (int i = 0; i < model().loads; ++i)
      can_be_used = can_be_used && std::fabs(readings_.sample.factor[i]) <= model().most_factor[i];
    for_each_end([&](int c, std::size_t end, bool jacked) {
      auto& given = readings_.ends[c][end];
      readings_.sample.jack[c][end].locked = cells_[c][end].locked;
      const bool good = check_cell(cells_[c][end], given, limits, alarms);
      if (!good && jacked) can_be_used = false;
      if (good && !(given.has_stroke && !std::isfinite(given.stroke))) return;
      alarms.raise(Alarm::sensor_range);
      given.has_force = given.has_force && good;
      given.has_stroke = given.has_stroke && std::isfinite(given.stroke);
    });
    if (!can_be_used) alarms.raise(Alarm::sensor_range);
    return can_be_used;
  }
  /// Whether its reading, if there is one, is within the limits.
  static bool check_cell(Cell& cell, taut::EndReading<float>& given, const CellLimits& limits,
                         Alarms& alarms) {
    if (!given.has_force) return true;
    const bool same = bits_of(given.force) == bits_of(cell.last);
    cell.same = same && !cell.locked ? (cell.same < 0xFFFFFFFF ? cell.same + 1 : cell.same) : 1;
    cell.last = given.force;
    given.force -= cell.zero;
    const bool in_range = given.force >= limits.least && given.force <= limits.most;
    // While the wedge holds, the jack may be anywhere.
    if (cell.locked) {
      given.has_force = in_range;
      return true;
    }
    if (!in_range) return false;
    // A cell at rest may well say the same all day.
    if (limits.frozen_after > 0 && given.force > 0 && cell.same >= limits.frozen_after)
      alarms.raise(Alarm::sensor_frozen);
    return true;
  }

  /// A row may take several calls: those after the first have no readings.
  void keep_strokes() {
    const StrokesType strokes = source_.strokes();
    for (int s = 0; s < strokes.size(); ++s) {
      const auto& stroke = strokes.first[s];
      strokes_[s] = readings_.ends[stroke.cable][static_cast<std::size_t>(stroke.end)];
    }
  }
  /// Once all have come to the end of the row: strokes teach only where no past is doubted.
  void finish_row() {
    if (past_.is_unknown()) return past_.settle(estimator_);
    const StrokesType strokes = source_.strokes();
    for (int s = 0; s < strokes.size(); ++s)
      if (strokes_[s].has_stroke)
        estimator_.take_stroke(strokes.first[s].cable, static_cast<std::size_t>(strokes.first[s].end),
                               strokes_[s].stroke, taut::Gauge{s});
  }
  bool is_consistent() const {
    // Written so that a NaN is doubtful.
    bool is_so = taut::verify(estimator_.tracker()).worst() <= Settings::most_violation;
    if constexpr (Settings::doubts_past)
      if (Past::has_above(past_.phase()))
        is_so = is_so && taut::verify(past_.above().tracker()).worst() <= Settings::most_violation;
    return is_so;
  }

  void judge(Alarms& alarms) {
    outcome_.quality = Quality::good;
    if (!outcome_.status) {
      outcome_.quality = Quality::held;
      alarms.raise(Alarm::no_answer);
    } else if (outcome_.fraction < 1) {
      outcome_.quality = Quality::behind;
      alarms.raise(Alarm::budget_exceeded);
    }
    since_verified_ = outcome_.events > 0 ? Settings::verify_every : since_verified_ + 1;
    if (since_verified_ < Settings::verify_every) return;
    since_verified_ = 0;
    if (is_consistent()) return;
    alarms.raise(Alarm::doubtful);
    if (outcome_.quality == Quality::good) outcome_.quality = Quality::doubtful;
  }

  Source source_;
  Estimator estimator_;
  taut::FixedArray<std::array<Cell, 2>, Cap::cables> cells_;
  taut::Readings<float, Cap> readings_;  // as they were read, then as they are used
  float waited_ = 0;                     // time of the samples that could not be used
  taut::FixedArray<taut::EndReading<float>, StrokesType::capacity()> strokes_;
  Outcome outcome_;
  Findings findings_;
  taut::Response<float, Cap> response_;
  State kept_;
  std::uint32_t since_verified_ = 0;
  Past past_;
  bool usable_ = false;
};

}  // namespace monitor
