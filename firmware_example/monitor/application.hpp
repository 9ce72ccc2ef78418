// The application: frames in, frames out, the state kept, the watchdog fed, every trouble said.
//
// The folder's README has the frames. Portable: what it needs of a board is in host/memory_board.hpp, the
// shortest one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "instruments/of_board.hpp"
#include "monitor/alarms.hpp"
#include "monitor/frame.hpp"
#include "monitor/one_of.hpp"
#include "monitor/record.hpp"
#include "monitor/refusal.hpp"
#include "monitor/session.hpp"
#include "monitor/settings.hpp"
#include "monitor/start.hpp"

namespace monitor {

/// Holds all its storage: make it static. `Sources` hold the scenes, one after the other by the numbers of
/// the command C.
template <class Board, class Settings, class... Sources>
class Application {
 public:
  explicit Application(Board& board) : board_(board), records_(board, slot_size) {}

  static constexpr int scenes = (Sources::scenes + ...);
  /// Most numbers of a sample beside its time.
  static constexpr int most_numbers = std::max({Session<Sources, Settings>::most_numbers...});

  /// Takes up the work where the record left it, and says so.
  void begin() {
    board_.feed_watchdog();
    if (board_.start() != Start::commanded) raise(Alarm::restarted);
    const auto found = records_.find(header_);
    if (found != Found::record || !take_up()) {
      // The very first start has nothing to lose.
      if (found != Found::nothing) raise(Alarm::state_lost);
      choose(0);
    }
    last_sample_at_ = board_.milliseconds();
    answer_information();
  }

  /// One pass of the main loop: at most one frame, a bounded number of bytes.
  void step() {
    board_.feed_watchdog();
    char byte = 0;
    for (int i = 0; i < most_bytes_a_pass && board_.read(byte); ++i) {
      const auto event = reader_.take(byte);
      if (event == Reader::Event::none) continue;
      if (event == Reader::Event::frame) {
        handle(reader_.fields());
      } else {
        ++bad_frames_;
        raise(Alarm::bad_frame);
        refuse("frame");
      }
      break;
    }
    records_.idle();
    watch_records();
    watch_line();
  }

  // What the commands do, for whatever line they come on.

  /// What is kept beside the state of the session.
  struct Common {
    CellLimits limits;
    std::uint32_t last = 0;      ///< sequence number of the last sample
    std::uint32_t has_last = 0;  ///< whether there was one since the scene was chosen
    std::uint32_t latched = 0;   ///< alarms that were not acknowledged
    std::uint32_t restarts = 0;
  };

  /// Takes the sample that `read(session)` reads and says whether it fits; one with the number of the last is
  /// not taken again.
  template <class Read>
  Refusal take_sample(std::uint32_t sequence, Read read) {
    const std::uint32_t ahead = sequence - common_.last;
    const bool repeated = common_.has_last != 0 && ahead == 0;
    if (common_.has_last != 0 && ahead > 0x7FFFFFFF) return Refusal::sequence;
    Refusal refusal = Refusal::none;
    session_.visit([&](auto& session) {
      if (!session.usable()) {
        raise(Alarm::scene_refused);
        refusal = Refusal::no_scene;
        return;
      }
      if (!read(session)) {
        refusal = Refusal::fields;
        return;
      }
      last_sample_at_ = board_.milliseconds();
      silent_ = false;
      // Its answer was lost on the line: the model must not go there twice.
      if (repeated) return;
      if (common_.has_last != 0 && ahead != 1) raise(Alarm::sample_lost);
      if constexpr (instruments::HasInstruments<Board>::value) read_instruments(session);
      const Alarms found = session.take(common_.limits, [this] { board_.feed_watchdog(); });
      pending_.add(found);
      common_.latched |= found.bits();
      common_.last = sequence;
      common_.has_last = 1;
      // First kept, then said: what was said is never forgotten.
      keep(Keep::soon);
    });
    return refusal;
  }
  /// Begins anew with another scene.
  Refusal choose_scene(std::uint32_t scene) {
    if (scene >= scenes) return Refusal::scene;
    choose(static_cast<int>(scene));
    return Refusal::none;
  }
  /// Zeroes a cell with its last reading.
  Refusal zero(std::uint32_t cable, std::uint32_t end) {
    return change_cell(cable, end, false, [this](auto& cell) {
      // A zero far from zero would hide a force.
      if (!(cell.last >= common_.limits.least && cell.last <= -common_.limits.least)) return Refusal::zero;
      cell.zero = cell.last;
      return Refusal::none;
    });
  }
  /// Locks off, or jacks again.
  Refusal lock(std::uint32_t cable, std::uint32_t end, bool locked) {
    return change_cell(cable, end, true, [locked](auto& cell) {
      cell.locked = locked;
      return Refusal::none;
    });
  }
  Refusal set_limits(const CellLimits& limits) {
    // Within infinite ones an infinite reading were one like any other.
    const bool are_finite = std::isfinite(limits.least) && std::isfinite(limits.most);
    if (!(are_finite && limits.least <= 0 && limits.most > 0)) return Refusal::limits;
    common_.limits = limits;
    keep();
    return Refusal::none;
  }
  void acknowledge_alarms() {
    common_.latched = 0;
    keep();
  }
  void restart() { board_.restart(); }

  const Common& common() const { return common_; }
  int scene() const { return scene_; }
  Board& board() { return board_; }
  /// Calls `call` with the session of the scene that was chosen.
  template <class Call>
  void visit(Call&& call) {
    session_.visit(call);
  }

 private:
  template <class Source>
  using SessionOf = Session<Source, Settings>;
  static constexpr int most_bytes_a_pass = 64;
  static constexpr int most_information = 1 + 24 * 9;
  static constexpr int most_command = 32;
  static constexpr int most_in = std::max({most_command, SessionOf<Sources>::most_sample...});
  static constexpr int most_out = std::max({most_information, SessionOf<Sources>::most_answer...});
  using Reader = FrameReader<most_in>;
  using Writer = FrameWriter<most_out>;

  using RecordsType = typename RecordsOf<Board>::Type;
  static constexpr int slot_size =
      RecordsType::size_with(sizeof(Common) + std::max({SessionOf<Sources>::most_kept...}));
  static_assert(2 * slot_size <= Board::memory_size, "the non-volatile memory is too small for two records");

  void raise(Alarm alarm) {
    pending_.raise(alarm);
    common_.latched |= pending_.bits();
  }

  /// Begins a scene in place of the present one; whether it can be used.
  bool begin_scene(int scene) {
    constexpr int counts[] = {Sources::scenes...};
    scene_ = scene;
    int source = 0;
    while (scene >= counts[source]) scene -= counts[source++];
    session_.make(source);
    bool usable = false;
    session_.visit([&](auto& session) { usable = session.begin(scene).ok(); });
    return usable;
  }

  /// The board's own, where the line has no reading.
  template <class SessionType>
  void read_instruments(SessionType& session) {
    session.read_instruments(
        [this](int cable, std::size_t end, instruments::Quantity quantity) {
          return board_.instrument(cable, end, quantity);
        },
        [this](bool& has, float& value, const instruments::Reading& own) {
          instruments::fill(has, value, own, board_.milliseconds(), Settings::oldest_reading);
        });
  }

  // The record.

  /// From the record that was found.
  bool take_up() {
    if (header_.kind >= scenes || !begin_scene(static_cast<int>(header_.kind))) return false;
    bool done = false;
    session_.visit([&](auto& session) {
      using State = typename std::decay_t<decltype(session)>::State;
      constexpr std::size_t least = sizeof(Common) + sizeof(State);
      done = header_.maker == session.maker() && header_.length >= least;
      if (!done) return;
      records_.read(sizeof common_, &session.kept(), sizeof(State));
      const std::size_t further = session.above_size();
      done = header_.length == least + further;
      if (!done) return;
      const std::uint32_t raised = common_.latched;
      records_.read(0, &common_, sizeof common_);
      done = session.restore();
      records_.read(least, &session.kept().estimator, further);
      done = done && session.restore_past();
      common_.latched |= raised;
      ++common_.restarts;
    });
    return done;
  }
  void keep(Keep how_soon = Keep::at_once) {
    session_.visit([&](auto& session) {
      if (!session.usable()) return;
      const auto& state = session.save();
      RecordHeader header;
      const std::size_t further = session.above_size();
      header.length = static_cast<std::uint32_t>(sizeof common_ + sizeof state + further);
      header.kind = static_cast<std::uint32_t>(scene_);
      header.maker = session.maker();
      records_.begin(header);
      records_.add(&common_, sizeof common_);
      records_.add(&state, sizeof state);
      if (further > 0) records_.add(&session.save_above(), further);
      records_.finish(how_soon);
    });
    watch_records();
  }
  void watch_records() {
    if (records_.failures() == not_kept_) return;
    not_kept_ = records_.failures();
    raise(Alarm::not_kept);
  }

  // Frames.

  void handle(Fields fields) {
    char kind = 0;
    if (!fields.letter(kind)) return refuse("fields");
    switch (kind) {
      case 'S':
        return take_sample(fields);
      case 'I':
        return fields.done() ? answer_information() : refuse("fields");
      case 'P':
        return fields.done() ? answer_state() : refuse("fields");
      case 'C':
        return take_choice(fields);
      case 'Z':
      case 'L':
      case 'J':
        return take_cell_command(kind, fields);
      case 'G':
        return take_limits(fields);
      case 'Q':
        if (!fields.done()) return refuse("fields");
        acknowledge_alarms();
        return acknowledge(kind);
      case 'R':
        if (!fields.done()) return refuse("fields");
        acknowledge(kind);
        return restart();
      case 'H':
        if (!fields.done()) return refuse("fields");
        acknowledge(kind);
        return board_.hang();
      default:
        return refuse("command");
    }
  }

  void take_sample(Fields fields) {
    std::uint32_t sequence = 0;
    if (!fields.number(sequence)) return refuse("fields");
    const Refusal refusal = take_sample(sequence, [&](auto& session) { return session.read(fields); });
    if (refusal != Refusal::none && refusal != Refusal::no_scene) return refuse(word_of(refusal));
    answer_state();
  }

  void take_choice(Fields fields) {
    std::uint32_t scene = 0;
    if (!fields.number(scene) || !fields.done()) return refuse("fields");
    const Refusal refusal = choose_scene(scene);
    if (refusal != Refusal::none) return refuse(word_of(refusal));
    answer_information();
  }
  void choose(int scene) {
    common_.has_last = 0;
    if (!begin_scene(scene)) raise(Alarm::scene_refused);
    board_.feed_watchdog();
    keep();
  }

  /// Zero the load cell, lock off, jack again.
  void take_cell_command(char kind, Fields fields) {
    std::uint32_t cable = 0, end = 0;
    if (!fields.number(cable) || !fields.number(end) || !fields.done()) return refuse("fields");
    acknowledge(kind, kind == 'Z' ? zero(cable, end) : lock(cable, end, kind == 'L'));
  }
  template <class Change>
  Refusal change_cell(std::uint32_t cable, std::uint32_t end, bool needs_jack, Change change) {
    Refusal refusal = Refusal::cell;
    session_.visit([&](auto& session) {
      auto* const cell = session.cell(cable, end);
      if (cell == nullptr || (needs_jack && !session.is_jacked(cable, end))) return;
      refusal = change(*cell);
    });
    if (refusal == Refusal::none) keep();
    return refusal;
  }

  void take_limits(Fields fields) {
    CellLimits limits;
    if (!fields.real(limits.least) || !fields.real(limits.most) || !fields.number(limits.frozen_after) ||
        !fields.done())
      return refuse("fields");
    acknowledge('G', set_limits(limits));
  }

  // Answers.

  void acknowledge(char kind, Refusal refusal) {
    if (refusal != Refusal::none) return refuse(word_of(refusal));
    acknowledge(kind);
  }
  void acknowledge(char kind) {
    writer_.begin('K');
    writer_.letter(kind);
    send();
  }
  void refuse(const char* word) {
    writer_.begin('E');
    writer_.word(word);
    send();
  }
  /// Sequence number, quality and alarms, then what the session says.
  void answer_state() {
    session_.visit([&](auto& session) {
      writer_.begin('A');
      writer_.number(common_.last);
      writer_.letter(static_cast<char>(session.outcome().quality));
      writer_.number(pending_.bits());
      session.write(writer_);
    });
    pending_ = {};
    send();
  }
  void answer_information() {
    writer_.begin('I');
    writer_.number(protocol_version);
    writer_.number(scene_);
    writer_.number(scenes);
    session_.visit([&](auto& session) {
      const auto& status = session.outcome().status;
      const bool usable = session.usable();
      writer_.number(static_cast<int>(status.code));
      writer_.number(static_cast<int>(status.place));
      writer_.number(status.index);
      writer_.number(status.cable);
      writer_.number(usable ? session.model().cables.size() : 0);
      writer_.number(usable ? session.model().segments : 0);
      writer_.number(usable ? session.model().joints : 0);
      writer_.number(usable ? session.model().loads : 0);
      writer_.number(session.maker());
    });
    writer_.number(common_.has_last);
    writer_.number(common_.last);
    writer_.number(common_.latched);
    writer_.number(bad_frames_);
    writer_.number(board_.lost_bytes());
    writer_.number(common_.restarts);
    writer_.number(static_cast<std::uint32_t>(board_.start()));
    writer_.number(board_.stack_used());
    writer_.number(board_.stack_size());
    writer_.number(board_.milliseconds());
    send();
  }
  void send() {
    writer_.finish();
    board_.write(writer_.text(), writer_.size());
  }

  void watch_line() {
    if (board_.lost_bytes() != lost_bytes_) {
      lost_bytes_ = board_.lost_bytes();
      raise(Alarm::bytes_lost);
    }
    // A difference of times, so that the clock may pass zero.
    if (silent_ || board_.milliseconds() - last_sample_at_ < Settings::silence_after) return;
    silent_ = true;
    raise(Alarm::silence);
    writer_.begin('!');
    writer_.number(pending_.bits());
    send();
  }

  Board& board_;
  OneOf<SessionOf<Sources>...> session_;
  int scene_ = 0;
  RecordsType records_;
  RecordHeader header_;
  Common common_;
  Reader reader_;
  Writer writer_;
  Alarms pending_;  // since the last answer
  std::uint32_t bad_frames_ = 0;
  std::uint32_t lost_bytes_ = 0;
  std::uint32_t not_kept_ = 0;
  std::uint32_t last_sample_at_ = 0;
  bool silent_ = false;
};

}  // namespace monitor
