// One scene at work: readings in, forces out.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

#include "monitor/alarms.hpp"
#include "monitor/frame.hpp"
#include "monitor/scene_sources.hpp"
#include "monitor/settings.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/sample.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"

namespace monitor {

/// How the last sample was answered.
struct Outcome {
  taut::Status status;
  Quality quality = Quality::none;
  float fraction = 1;  ///< of the path to the sample
  int events = 0;
};

/// Holds all its storage: make it static.
template <class Source>
class Session {
 public:
  using Cap = typename Source::Capacity;
  using Model = taut::Condensed<float, Cap>;
  using Tracker = taut::Tracker<Model>;

  /// The load cell and the wedge of one jacked end.
  struct Cell {
    float zero = 0;          ///< what the cell says without load [N]
    float last = 0;          ///< what it said last [N]
    std::uint32_t same = 0;  ///< how often in a row
    bool locked = false;
  };
  /// All that a power failure must not take.
  struct State {
    taut::FixedArray<std::array<Cell, 2>, Cap::cables> cells;
    taut::Sample<float, Cap> sample;
    Outcome outcome;
    typename Tracker::State tracker;
  };
  static_assert(std::is_trivially_copyable_v<State>, "the record keeps bytes");

  /// Longest bodies of the frames of a sample and of its answer.
  static constexpr int most_sample = 1 + 9 + 9 * (Cap::loads + 2 * Cap::cables);
  static constexpr int most_answer =
      1 + 2 + 9 * 8 + 9 * (Cap::segments + 3 * Cap::joints + 2 * Cap::cables + Cap::struts) + Cap::joints + 2;

  /// Begins without load. The answer says whether the scene can be used.
  taut::Status begin() {
    cells_ = {};
    sample_ = {};
    outcome_ = {};
    outcome_.status = source_.prepare();
    if (outcome_.status) outcome_.status = tracker_.start(source_.model()).status;
    outcome_.quality = outcome_.status ? Quality::held : Quality::none;
    usable_ = outcome_.status.ok();
    return outcome_.status;
  }
  bool usable() const { return usable_; }
  const Model& model() const { return source_.model(); }
  const Outcome& outcome() const { return outcome_; }

  /// What must be the same for a record to be read back.
  std::uint32_t maker() const { return usable_ ? fingerprint(model()) : 0; }
  /// The state, until the next call.
  const State& save() {
    kept_.cells = cells_;
    kept_.sample = sample_;
    kept_.outcome = outcome_;
    // In its place: a copy on the way would need the stack.
    new (&kept_.tracker) typename Tracker::State(tracker_.save());
    return kept_;
  }
  /// Room for a state that restore() is to take.
  State& kept() { return kept_; }
  bool restore() {
    cells_ = kept_.cells;
    sample_ = kept_.sample;
    outcome_ = kept_.outcome;
    return tracker_.restore(source_.model(), kept_.tracker).ok();
  }

  // Commands; `cable` and `end` are checked.

  Cell* cell(std::uint32_t cable, std::uint32_t end) {
    if (!usable_ || cable >= static_cast<std::uint32_t>(model().cables.size()) || end > 1) return nullptr;
    const auto& layout = model().cables[static_cast<int>(cable)];
    if (layout.closed || layout.ends[end] != taut::End::jacked) return nullptr;
    return &cells_[static_cast<int>(cable)][end];
  }

  /// Reads the numbers of a sample: the factor of every load pattern, the reading of every jacked end.
  /// Nothing is changed if they do not fit.
  bool read(Fields& fields) {
    bool fits = usable_;
    for (int i = 0; fits && i < model().loads; ++i) fits = fields.real(read_.factor[i]);
    taut::for_each_jacked_end(model().cables, [&](int c, std::size_t end) {
      fits = fits && fields.real(read_.jack[c][end].force);
    });
    return fits && fields.done();
  }
  /// Answers the sample that was read. `feed` is called between bounded pieces of work.
  template <class Settings, class Feed>
  Alarms take(const CellLimits& limits, Feed feed) {
    Alarms alarms = check_cells(limits);
    outcome_ = {};
    if (alarms.has(Alarm::sensor_range)) {
      outcome_.quality = Quality::held;
      return alarms;
    }
    sample_ = next_;
    outcome_.fraction = 0;
    float rest = 1;
    for (int call = 0; call < Settings::most_calls; ++call) {
      constexpr int budget = Settings::event_budget > 0 ? Settings::event_budget : Tracker::default_budget;
      const auto progress = tracker_.advance(sample_, budget);
      feed();
      rest *= 1 - progress.fraction;
      outcome_.events += progress.events;
      outcome_.status = progress.status;
      if (!progress.status || progress.fraction >= 1) break;
    }
    outcome_.fraction = 1 - rest;
    judge<Settings>(alarms);
    return alarms;
  }

  /// Adds the answer to a frame, from the tracker as it is.
  template <class Writer>
  void write(Writer& frame) {
    frame.number(outcome_.events);
    frame.real(outcome_.fraction);
    frame.number(static_cast<int>(outcome_.status.code));
    frame.number(static_cast<int>(outcome_.status.place));
    frame.number(outcome_.status.index);
    frame.number(outcome_.status.cable);
    if (!usable_) return;
    tracker_.respond(response_, source_.struts());
    const int segments = model().segments, joints = model().joints;
    for (int i = 0; i < segments; ++i) frame.real(response_.tension[i]);
    for (int j = 0; j < joints; ++j) frame.real(response_.slip[j]);
    if (joints > 0) frame.letter(state_letter(0));
    for (int j = 1; j < joints; ++j) frame.more(state_letter(j));
    for (int j = 0; j < joints; ++j) frame.real(response_.contact[j]);
    for (int j = 0; j < joints; ++j) frame.real(response_.friction[j]);
    taut::for_each_jacked_end(model().cables,
                              [&](int c, std::size_t end) { frame.real(response_.payout[c][end]); });
    for (int i = 0; i < Cap::struts; ++i) frame.real(response_.strut[i]);
  }

 private:
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

  /// From what was read to the next sample; says what is wrong with the cells.
  Alarms check_cells(const CellLimits& limits) {
    Alarms alarms;
    next_ = sample_;
    for (int i = 0; i < model().loads; ++i) {
      if (!std::isfinite(read_.factor[i])) alarms.raise(Alarm::sensor_range);
      next_.factor[i] = read_.factor[i];
    }
    taut::for_each_jacked_end(model().cables, [&](int c, std::size_t end) {
      Cell& cell = cells_[c][end];
      auto& jack = next_.jack[c][end];
      jack.locked = cell.locked;
      const float reading = read_.jack[c][end].force;
      const bool same = bits_of(reading) == bits_of(cell.last);
      cell.same = same && !cell.locked ? (cell.same < 0xFFFFFFFF ? cell.same + 1 : cell.same) : 1;
      cell.last = reading;
      // While the wedge holds, the jack may be anywhere.
      if (cell.locked) return;
      const float force = reading - cell.zero;
      if (!(force >= limits.least && force <= limits.most)) {
        alarms.raise(Alarm::sensor_range);
        return;
      }
      // A cell at rest may well say the same all day.
      if (limits.frozen_after > 0 && force > 0 && cell.same >= limits.frozen_after)
        alarms.raise(Alarm::sensor_frozen);
      jack.force = force > 0 ? force : 0;
    });
    return alarms;
  }

  template <class Settings>
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
    // Written so that a NaN is doubtful.
    if (taut::verify(tracker_).worst() <= Settings::most_violation) return;
    alarms.raise(Alarm::doubtful);
    if (outcome_.quality == Quality::good) outcome_.quality = Quality::doubtful;
  }

  Source source_;
  Tracker tracker_;
  taut::FixedArray<std::array<Cell, 2>, Cap::cables> cells_;
  taut::Sample<float, Cap> sample_, next_, read_;
  Outcome outcome_;
  taut::Response<float, Cap> response_;
  State kept_;
  std::uint32_t since_verified_ = 0;
  bool usable_ = false;
};

}  // namespace monitor
