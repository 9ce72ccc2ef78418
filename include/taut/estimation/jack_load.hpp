// A jack and its load cell: what is known of its load, and how far the tracker has been driven to it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "taut/estimation/belief.hpp"
#include "taut/estimation/elongation_check.hpp"
#include "taut/estimation/jump_guard.hpp"
#include "taut/estimation/load_filter.hpp"
#include "taut/estimation/load_moves.hpp"
#include "taut/estimation/noise_level.hpp"
#include "taut/estimation/readings.hpp"
#include "taut/estimation/standing_cell.hpp"
#include "taut/estimation/turning_point.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/load_cell.hpp"
#include "taut/scene/sample.hpp"

namespace taut {

/// Where the path to a row has corners: a jack is locked, or its load has reversed since the row before.
template <class Scalar>
struct Corners {
  bool locks = false, reverses = false;
  bool loads = false;      ///< other loads begin to change, or cease to
  bool bends = false;      ///< no corner: a load goes on at another rate since a while
  Scalar times_noise = 1;  ///< by so many times readings scatter more, in variance, than they ever did
  bool any() const { return locks || reverses || loads; }
};

/// What the wedge of a locked end holds, for the jack that takes over from it.
template <class Scalar>
struct HeldByWedge {
  Scalar driven = 0;     ///< where the tracker is [N]
  Scalar load = 0;       ///< what the jack's cell will read of it, pulling, over LoadCell::up [N]
  Scalar deviation = 0;  ///< standard deviation of that [N]
};

/// A load cell's conditioned load, with the wedge of its end. A plain value: it can be saved and read back
/// byte by byte. `Reversals` is how many of its reversals are unknowns of a FrictionFilter.
template <class Scalar, int Reversals>
struct JackLoad {
  /// The part of what a cable can carry that a jack adds in a second, at most: a fifth of what it is used
  /// for.
  static constexpr Scalar fastest = Scalar(0.014);
  /// Readings in a row that show that the jack of a locked end pulls less than its wedge holds.
  static constexpr std::uint8_t confirmed_below = 3;
  /// A load that has come down to so much of the most that it was is let out: more than between two strokes
  /// of a hand pump.
  static constexpr Scalar let_out = Scalar(0.95);
  /// A reading that is still shown after that time, while the load goes on, is no old one: its cell does not
  /// live [s].
  static constexpr Scalar too_old = 10;
  /// A time without readings is so many times as long as the step before, or longer.
  static constexpr Scalar gap = 3;

  LoadFilter<Scalar> filter;
  JumpGuard<Scalar> guard;
  NoiseLevel<Scalar> noise;
  LoadMoves<Scalar> moves;
  StandingCell<Scalar> standing;
  Scalar fastest_seen = 0;  ///< that the load has surely gone [N/s]
  TurningPoint<Scalar> turning;
  ConditionedLoad<Scalar> at{};
  Jack<Scalar> driven{};  ///< where the tracker was driven to
  Scalar since = 0;       ///< time since the last reading
  Scalar turned = 0;      ///< load where it turned last [N], for a cell with two branches
  Scalar turned_sd = 0;   ///< and its standard deviation [N]
  bool pulls = false;     ///< the branch: since then the load has gone up
  bool erred_up =
      false;  ///< the branch whose error the tracker has: after a turn, while the load rests, the old one
  Scalar taken = 0;        ///< load at which it took over from a wedge [N], until it surely pulls more
  Scalar taken_least = 0;  ///< and what its reading says there at least, if it has not turned [N]
  Scalar raw = 0;          ///< the last reading [N]
  Scalar first = 0;      ///< the least load once there is one [N]: which way things slide shows from then on
  Scalar sd_before = 0;  ///< standard deviation of the load a sample ago [N]
  Scalar load_before = 0;                ///< best estimate of the load a row ago [N]
  Scalar farthest = 0, farthest_sd = 0;  ///< the one that went farthest since the load turned [N]
  Scalar turn_sd = 0, lock_sd = 0;       ///< standard deviation of the load where it turned, was locked [N]
  bool rises = false;                    ///< since it turned
  bool goes_on = false;                  ///< surely, in this row
  bool is_new = false;                   ///< `raw` is of this row, and was believed
  bool is_unread = false;                ///< its cell was not read in this row
  bool was_unread = false;               ///< until this row
  bool went_on = false;                  ///< surely, as it was read last
  bool pulls_surely = false;             ///< at a locked end: its last reading is believed
  bool locked_late = false;              ///< its wedge may have held before, see may_have_held_before()
  bool found_locked = false;             ///< in the first row: what its wedge holds is not known
  bool unlocked_early = false;  ///< its wedge holds, though rows have it unlocked: see wedge_holds_yet()
  Scalar most_pulled = 0;       ///< since then, by its readings [N]
  bool turned_unseen = false;   ///< once it has turned while it was not read
  Scalar missed_in = 0;         ///< if it had not come as far as at its pace, in what time [s]
  Scalar missed = 0;   ///< by how much it may have gone farther while it was not read, and come back [N]
  Scalar read_sd = 0;  ///< then the standard deviation of the load where it was last [N]
  Scalar step_by = 0, stride = 0;    ///< how far it had come since the reading before [N], in that time
  Scalar believed = 0, refused = 0;  ///< the last reading that was believed, and that was not [N]
  /// What the cell at the other end of the cable read with it, or with the first that was the same [N]; where
  /// they are read in turn, what it read before.
  Scalar beside = 0;
  std::int32_t taught = 0;    ///< readings of the line that it is on with which unknowns were learned
  bool teaches = false;       ///< those of this row were counted
  std::uint8_t refusals = 0;  ///< in a row
  bool locks_now = false, locked = false;
  bool turned_before = false;  ///< in this row, too, before it reversed: at `first_turn` [N], see below
  Scalar first_turn = 0, first_turn_sd = 0;  ///< known to a standard deviation [N]
  ElongationCheck<Scalar> elongation;        ///< of the leg that it is on
  std::uint8_t below = 0;  ///< locked: readings in a row that were confirmed to be below what the wedge holds
  /// Unknown errors of its load where it reversed, was locked or rested, or -1. The next one joins
  /// what matters least.
  std::array<std::int16_t, static_cast<std::size_t>(Reversals)> memory{};
  int oldest = 0;
  std::int16_t at_turn = 0;   ///< the one of `memory` that is its error where it reversed last, or -1
  Scalar turned_at = 0;       ///< where the tracker was then [N]
  std::int16_t seating = 0;   ///< the unknown of its wedge's draw-in, or -1
  Scalar come_sd = 0;         ///< standard deviation of the load where come_to_best() was [N]
  Scalar lasts = 0;           ///< what its readings are off by together, NoiseLevel::Found::lasting [N]
  std::int16_t at_rest = 0;   ///< the one of `memory` that its error is while other loads change, or -1
  bool rests_beside = false;  ///< other loads change, and friction comes to rest at the load that it has
  Scalar rested_at = 0;       ///< where the tracker was when they ceased to [N]

  /// A reading, or none if it is more than the cable can carry, `most` [N].
  static Scalar possible(Scalar reading, Scalar most) {
    return std::fabs(reading) <= most ? reading : std::numeric_limits<Scalar>::quiet_NaN();
  }

  /// What a reading is times the load, as the load goes at present.
  Scalar branch(const LoadCell<Scalar>& cell) const { return pulls ? cell.up : cell.down; }
  /// The load behind a conditioned reading of a cell with two branches: after a turn it rests until the
  /// reading has come to the other branch.
  ConditionedLoad<Scalar> behind_branches(const ConditionedLoad<Scalar>& reading,
                                          const LoadCell<Scalar>& cell) {
    ConditionedLoad<Scalar> load = reading;
    const auto on = [&](Scalar of_reading) {
      return pulls ? larger(turned, of_reading / cell.up) : -larger(-turned, -of_reading / cell.down);
    };
    if (reading.reversed) {
      load.reversal = turned = on(reading.reversal);
      load.reversal_sd = reading.reversal_sd / branch(cell);
      turned_sd = load.reversal_sd > 0 ? load.reversal_sd : sd_before;
      pulls = !pulls;
    }
    load.sd = reading.sd / branch(cell);
    load.confirmed = on(reading.confirmed);
    load.load = on(reading.load);
    load.come = on(reading.come);
    load.come_sd = reading.come_sd / branch(cell);
    // While it rests, no reading tells more of it.
    if (load.load == turned) load.sd = larger(load.sd, turned_sd);
    if (load.come == turned) load.come_sd = larger(load.come_sd, turned_sd);
    if (!reading.behind) return load;
    // If it has turned, it rests at first.
    const Scalar other = reading.load / (pulls ? cell.down : cell.up);
    load.load = pulls ? -larger(-load.confirmed, -other) : larger(load.confirmed, other);
    load.behind = load.load != load.confirmed;
    return load;
  }

  void start(const LoadCell<Scalar>& cell) {
    *this = JackLoad();
    pulls = erred_up = rises = true;
    at_turn = seating = at_rest = -1;
    rested_at = -1;
    filter.start(cell.noise());
    noise.start(cell.noise());
  }
  /// After take(): the new reading is that of a time ago [s], and the load may have gone on as it did before.
  void come_late(Scalar late) {
    const Scalar gone = step_by / stride * late;
    at.sd = std::sqrt(at.sd * at.sd + gone * gone);
  }
  /// The load has come down to what this first reading says [N].
  void come_down(Scalar reading, const LoadCell<Scalar>& cell) {
    filter.start_at(cell.noise(), reading, cell.noise(), false);
    guard.start(reading);
    at = {};
    at.load = at.come = at.confirmed = turned = reading / cell.down;
    at.sd = at.come_sd = cell.noise() / cell.down;
    pulls = erred_up = rises = false;
    farthest = at.load;
    farthest_sd = at.sd;
    first = Scalar(1e-3) * cell.sd;
  }
  /// A wedge holds its end from here on.
  void lie_locked() {
    locked = true;
    at.behind = false;
    filter.start(filter.sd());
    turning.clear();
    standing = {};
    elongation.begin_leg();
    below = 0;
  }
  /// The filter goes by the scatter that there is, not only by what was said. Returns by how many times the
  /// variance is larger than it was ever taken to be, or one.
  Scalar follow_noise(Scalar reading, const LoadCell<Scalar>& cell) {
    if (!(cell.sd > 0) || at.refused || !noise.take(reading, since)) return 1;
    const auto found = noise.found();
    lasts = found.lasting;
    const Scalar times = found.sd / filter.sd();
    if (!NoiseLevel<Scalar>::is_worth_it(times) || filter.has_waiting()) return 1;
    filter.change_sd(found.sd);
    return noise.rises_to(found.sd);
  }

  /// At which reading the load turned [N], if the last ones tell, and `line`, what the line that they were on
  /// says [N], is hardly another one; no force is below zero. Cost: that of TurningPoint::find().
  TurnedLoad<Scalar> turn_beside(Scalar line, bool is_highest) {
    auto turn = turning.find(filter.sd(), is_highest);
    turn.is_known &= !(std::fabs(turn.load - line) > 6 * filter.sd());
    turn.load = larger(turn.load, Scalar(0));
    turn.sd = larger(turn.sd, lasts);
    return turn;
  }
  /// The readings have reversed: at which, if the last ones tell. Beside other loads that change, friction
  /// has come to rest at the load that was taken for the farthest by then, and remembers the error of that
  /// one. Cost: that of turn_beside().
  void find_reversal(const LoadCell<Scalar>& cell) {
    if (at_rest >= 0 || driven.force == rested_at) return turning.clear();
    const bool was_highest = !filter.goes_up();
    auto turn = turn_beside(at.reversal, was_highest);
    if (!turn.is_known) return;
    // A load that rested may have come back too little to be seen, and was farther before.
    const Scalar left =
                     was_highest ? farthest * branch(cell) - turn.load : turn.load - farthest * branch(cell),
                 unseen = larger(left - farthest_sd * branch(cell), Scalar(0)) / 2;
    turn.load += was_highest ? unseen : -unseen;
    turn.sd = std::sqrt(turn.sd * turn.sd + unseen * unseen);
    // The load is confirmed to have been as far.
    at.reversal = was_highest ? larger(turn.load, at.confirmed) : -larger(-turn.load, -at.confirmed);
    at.reversal_sd = turn.sd;
  }
  /// Once the load of a row is known, of a cable that can carry `most` [N]. Where a ramp ends the estimate
  /// overshoots: it is farther than it was read by `beyond` at most [N], and known no better than that.
  void note_farthest(Scalar beyond, Scalar most) {
    constexpr Scalar surely = 6;
    Scalar come = at.load;
    if (at.alone) return;
    const Scalar hidden = gone_missed(2 * surely * beyond, most);
    goes_on = at.reversed || (filter.goes_on() && short_of_farthest(at.load) == 0);
    if (at.reversed) {
      // In rows that come as usual it may as well have turned where it was seen.
      const bool as_usual = hidden > 0 ? since <= gap * stride : missed_in > 0 && missed_in < gap * since;
      missed = larger(as_usual ? missed_at_pace_back() : missed, hidden);
      if (missed > 0) {
        const Scalar seen = at.reversal;
        at.reversal_sd =
            turn_beyond(seen, as_usual ? Scalar(0) : missed / 2, larger(at.reversal_sd, sd_before));
        if (turned == seen) rest_beyond(seen);
      }
      turn_sd = at.reversal_sd > 0 ? at.reversal_sd : larger(sd_before, back(at.reversal));
      rises = !rises;
    } else {
      come = rises ? -larger(-at.load, -raw - beyond) : larger(at.load, raw - beyond);
      const Scalar further = rises ? come - farthest : farthest - come;
      // If rows go on coming as slowly, there was no gap: they do so in a hold.
      if (missed_in > 0 && since > missed_in / 2) missed = 0;
      missed_in = hidden > 0 && !was_unread ? since : Scalar(0);
      missed = larger(hidden, missed - larger(further, Scalar(0)));
      if (at.refused || !(further > 0)) return;
      goes_on |= further > surely * beyond;
    }
    farthest = come;
    farthest_sd = larger(at.sd, beyond);
  }
  /// By how much the load may have gone farther since it was read last, and have come back, at the pace that
  /// it had, and to no more than `most` [N]: where it was on its way, and has not come as far by `least` [N].
  /// Half of that is the most likely.
  Scalar gone_missed(Scalar least, Scalar most) const {
    if (!went_on || was_stage() || !(stride > 0)) return 0;
    const Scalar left = step_by / stride * since - std::fabs(at.load - load_before),
                 room = larger(rises ? most - farthest : farthest, Scalar(0));
    return left > least ? -larger(-left / 2, -room) : Scalar(0);
  }
  /// It has turned, and comes back at a pace: if it did so at once, in a row that came as usual, it has not
  /// gone as much farther as `missed` has it, which is at the pace that it went on with [N].
  Scalar missed_at_pace_back() const {
    if (!(missed > 0)) return 0;
    const Scalar way = 2 * missed + step_by,
                 back = -larger(-way, -std::fabs(at.reversal - at.load) * missed_in / since);
    return missed * 2 * back / (way + back);
  }
  /// It has turned as much farther than `seen`, which is known to `sd`, and by `missed` at most. Returns the
  /// standard deviation of the turn [N].
  Scalar turn_beyond(Scalar seen, Scalar further, Scalar sd) {
    const Scalar left = missed - further;
    at.reversal = larger(rises ? seen + further : seen - further, Scalar(0));
    missed = 0;
    turned_unseen = true;
    return std::sqrt(sd * sd + left * left);
  }
  /// It has turned there, and not where it was seen: between the branches of a ram it rests there.
  void rest_beyond(Scalar seen) {
    turned = at.reversal;
    turned_sd = at.reversal_sd;
    if (at.load == seen) {
      at.load = turned;
      at.sd = larger(at.sd, turned_sd);
    }
    if (at.come == seen) {
      at.come = turned;
      at.come_sd = larger(at.come_sd, turned_sd);
    }
    if (at.confirmed == seen) at.confirmed = turned;
  }
  /// Whether the one reading that was refused before this one was a peak of the load: the load has come at
  /// least half-way there.
  bool was_peak(Scalar reading) const {
    if (at.is_sure() || refusals != 1) return false;
    const Scalar far = std::fabs(refused - believed), left = std::fabs(refused - reading),
                 come = std::fabs(reading - believed);
    return left > 5 * filter.sd() && left < come && come < far;
  }

  /// Whether it was read last so long ago that the row is a load stage, or comes after a pause: what the load
  /// has done since then is not known.
  bool is_stage() const { return JumpGuard<Scalar>::is_stage(since); }
  /// The same of the row in which it was read last.
  bool was_stage() const { return JumpGuard<Scalar>::is_stage(stride); }
  /// Whether a load that has left the line of those before is believed at once: rows are load stages, where
  /// every load is a decision, the last one was another than before, and it is between half and twice that.
  /// What is farther off, or off a hold, may have been misread.
  bool is_next_stage(Scalar load) const {
    constexpr Scalar surely = 5;
    return is_stage() && step_by > surely * filter.sd() && 2 * load >= load_before && load <= 2 * load_before;
  }
  /// Whether a load that is more than three times as high as any is left for the next row to tell: rows are
  /// load stages, of which there have been two, and a digit may have been misplaced.
  bool is_far_stage(Scalar load) const {
    constexpr Scalar far = 3, begun = Scalar(0.9);
    return filter.sd() > 0 && is_stage() && at.is_sure() && step_by < begun * load_before &&
           load > far * larger(farthest, load_before);
  }
  /// The jack took over from a wedge and does not surely pull more yet: nothing has slid, so that the tracker
  /// stays. Readings that are below what the wedge was taken to hold, by no more than may be, say no more
  /// than that it held less; but a load that has come down from there by a twentieth is let out.
  void stay_taken(Scalar up) {
    if (at.load < up * taken_least) {
      taken = 0;
      return;
    }
    if (at.is_sure()) taken_least = larger(taken_least, let_out * at.load / up);
    if (at.reversed) filter.start_at(filter.sd(), at.load, at.sd);
    at.reversed = at.behind = false;
    if (at.confirmed > up * taken && at.load > up * taken)
      taken = 0;
    else
      at.confirmed = up * taken;
  }

  /// That reading is believed after all; no force is below zero. If the load had gone the other way until
  /// then, it has turned before, where it was farthest.
  void come_to_refused(const LoadCell<Scalar>& cell) {
    const bool goes_up = refused > believed;
    if (goes_up != rises) {
      turned_before = true;
      first_turn = farthest;
      first_turn_sd = farthest_sd;
      rises = goes_up;
      if (cell.has_branches()) {
        turned = farthest;
        turned_sd = farthest_sd;
        pulls = goes_up;
      }
      turning.clear();
      turning.add(believed, 0, filter.sd());
    }
    filter.start_at(filter.sd(), larger(refused, Scalar(0)), filter.sd(), goes_up);
    turning.add(refused, 0, filter.sd());
    believed = refused;
    refusals = 0;
  }

  /// A reading was refused, or not. Returns whether one was surely wrong: it cannot be a force at all, it is
  /// not the only one and they do not go on as a load that begins to move, or the next one shows that the
  /// load did not go there. A single one at the end of a steep ramp lies between its neighbours. One that was
  /// believed, `was_alone`, may have been by chance where a load at rest looks like one that moves.
  [[nodiscard]] bool finds_outlier(Scalar reading, bool can_be, bool was_alone) {
    constexpr std::uint8_t many = 2;
    constexpr Scalar apart = 5, surely_apart = 8;
    if (!at.is_sure()) {
      const bool is_surely = (refusals > 0 && !was_alone && !guard.may_go_on()) || !can_be;
      refusals = is_surely ? many : 1;
      refused = reading;
      return is_surely;
    }
    const Scalar near = (was_alone ? surely_apart : apart) * filter.sd(),
                 least = -larger(-believed, -reading) - near, most = larger(believed, reading) + near;
    const bool was_wrong = refusals == 1 && !(refused >= least && refused <= most);
    refusals = 0;
    believed = reading;
    return was_wrong;
  }

  // Rows in which its cell is not read.

  /// The load stays where it was read last, and may have gone on as it went there: along its line, or by as
  /// much as from the reading before; or a pump may have begun to work, Eq. (79). By more than a reading
  /// scatters, it is in doubt; so it is after the first reading of all. (What a cell without noise does not
  /// say has not changed.)
  void go_unread(const LoadCell<Scalar>& cell) {
    constexpr Scalar steps = 4;
    if (!is_unread) read_sd = filter.run_length() > 0 ? at.sd : cell.noise();
    is_unread = true;
    // A load stage is one, however soon it comes; and what is not due yet is not lost.
    const bool is_due = since > Scalar(0.75) * stride;
    const Scalar lost = is_due ? -larger(-since, -stride) : Scalar(0),
                 times =
                     since >= steps * stride ? steps : larger(since / stride, Scalar(was_stage() ? 1 : 0)),
                 on = larger(filter.gone(since) / branch(cell), stride > 0 ? times * step_by : step_by),
                 begun = gone_from_rest(taken > 0 ? since : lost, filter.lasted()),
                 gone = std::sqrt(on * on + begun * begun);
    at.come = at.load;
    at.come_sd = at.sd = std::sqrt(read_sd * read_sd + gone * gone);
    at.refused |= gone > filter.sd() / branch(cell) || !filter.knows_pace();
  }
  /// How far the load may have gone in a time in which nobody saw it [s], after it had rested for so long: as
  /// a standard deviation [N], Eq. (79).
  Scalar gone_from_rest(Scalar time, Scalar rested) const {
    if (!(time > 0)) return 0;
    const Scalar pace = fastest_seen > 0 ? fastest_seen : guard.fastest(),
                 most = -larger(-pace * time, -farthest);
    return most * std::sqrt(time / (3 * (rested + time)));
  }
  /// Whether it rested when it was read last, and has not been read for so long that the pump may well have
  /// been worked meanwhile: of a load that was on its way bars have that.
  bool is_silent() const {
    return is_unread && !locked && !went_on && since > 2 * JumpGuard<Scalar>::far_apart && since > 8 * stride;
  }
  /// Another cell shows that it has gone on, by at least so much [N].
  void leave_unread(Scalar by) {
    at.sd = larger(at.sd, by);
    at.come_sd = larger(at.come_sd, by);
    at.refused = true;
  }
  /// The same; a load that rested goes on so, as long as nobody reads it.
  void go_on_unread(Scalar by) {
    leave_unread(by);
    if (went_on) return;
    step_by = by;
    stride = since;
  }
  /// It lies between these [N], by what another cell reads.
  void come_between(Scalar least, Scalar most, const LoadCell<Scalar>& cell) {
    const auto nearest = [&](Scalar load) { return larger(least, -larger(-most, -load)); };
    at.refused |= at.load != nearest(at.load);
    at.come = at.load = nearest(at.load);
    at.confirmed = nearest(at.confirmed);
    at.come_sd = at.sd = -larger(-at.sd, least - most);
    filter.come_to(at.confirmed * branch(cell));
  }

  /// The wedge holds from here on. What of a turn is not confirmed by now never will be: asked once, it need
  /// not be as sure.
  void lock(const LoadCell<Scalar>& cell, Corners<Scalar>& corners) {
    const Scalar come_back = back(at.load), fallen = rises ? at.come - at.load : at.load - at.come;
    const bool has_turned = come_back > (is_stage() ? Scalar(0) : 5 * filter.sd());
    at.reversed = has_turned || missed > 0 || fallen > 3 * at.come_sd;
    if (missed > 0) {
      turn_sd = turn_beyond(farthest, missed / 2, farthest_sd);
      corners.reverses = true;
    } else if (at.reversed) {
      at.reversal = has_turned ? farthest : at.come;
      turn_sd = has_turned ? farthest_sd : at.come_sd;
      const auto turn = has_turned ? turn_beside(farthest * branch(cell), rises) : TurnedLoad<Scalar>();
      if (turn.is_known) {
        at.reversal = turn.load / branch(cell);
        turn_sd = turn.sd / branch(cell);
      }
      corners.reverses = true;
    }
    lock_sd = at.reversed ? at.sd : larger(at.come_sd, larger(come_back, std::fabs(fallen)));
    if (!at.reversed) at.load = at.come;
    corners.locks = locks_now = true;
    lie_locked();
  }
  /// The jack pulls at an end that a wedge has held until now, and nothing slides: what slid back as the
  /// wedge was drawn in sticks, which shows a little further on. Its readings are those of the upper branch.
  void take_over(const HeldByWedge<Scalar>& held, const LoadCell<Scalar>& cell, Scalar dt) {
    taken = load_before = held.driven + Scalar(1e-3) * cell.sd;
    taken_least = held.load - 4 * held.deviation;
    farthest = held.load;
    filter.start_at(filter.sd(), cell.up * held.load, cell.up * held.deviation);
    farthest_sd = held.deviation;
    rises = true;
    at = {};
    missed = 0;
    turned = 0;
    pulls = true;
    locked = locked_late = unlocked_early = found_locked = false;
    since = dt;
  }

  /// The same in a row in which its cell is not read: the load is what the wedge held, until it has gone on.
  void take_over_unread(const HeldByWedge<Scalar>& held, const LoadCell<Scalar>& cell, Scalar dt) {
    take_over(held, cell, dt);
    at.load = at.come = held.load;
    at.sd = at.come_sd = held.deviation;
    at.confirmed = taken;
    is_unread = went_on = false;
  }

  /// Nobody else sees the load.
  struct Unseen {
    constexpr bool operator()() const { return false; }
  };
  /// Takes what a row says of the jack: whether it is locked, a reading of its load cell, and the time since
  /// the row before. `held` is what the wedge of a locked end holds; is_seen() says whether another cell has
  /// seen the load go where it is read: then it is shown there at once, and believed in the second row, in
  /// load stages in the first. Returns true if and only if a reading is now known to have been an outlier:
  /// this one or the one before. Cost: that of LoadFilter::take() twice, and at most two calls of is_seen().
  template <class Seen = Unseen>
  [[nodiscard]] bool take(bool locks, const EndReading<Scalar>& given, Scalar dt,
                          const LoadCell<Scalar>& cell, Scalar most, const HeldByWedge<Scalar>& held,
                          Corners<Scalar>& corners, const Seen& is_seen = Seen()) {
    is_new = locks_now = goes_on = teaches = turned_before = false;
    load_before = at.load;
    at.reversed = false;
    since += dt;
    if (locks) {
      sd_before = at.sd;
      if (!locked) lock(cell, corners);
      return false;
    }
    const bool rests = step_by <= filter.sd() / 2;
    const bool is_frozen = given.has_force && cell.sd > 0 && !locked && standing.take(given.force, dt, rests);
    if (!given.has_force || is_frozen) {
      if (cell.sd > 0) {
        if (locked) take_over_unread(held, cell, dt);
        go_unread(cell);
      }
      if (is_frozen) {
        const Scalar stood = standing.stood();
        leave_unread(gone_from_rest(stood, larger(filter.lasted() - stood, Scalar(0))));
      }
      return false;
    }
    was_unread = is_unread;
    is_unread = false;
    // This is the first reading since its end was released.
    const bool is_released = locked || (taken > 0 && was_unread && !filter.knows_pace());
    const bool was_read = locked && pulls_surely && since <= gap * dt;
    if (locked) take_over(held, cell, dt);
    if (!at.refused) sd_before = at.sd;
    // Placed there, not on the heap: a copy would read back at once what was just written in parts, and wait.
    Scalar reading = possible(given.force, most);
    // How far the jack pulled while the wedge held is not known; but not that it hardly pulls any more.
    if (is_released) {
      const bool is_above = was_read && reading > cell.up * (held.load + 4 * held.deviation);
      guard.start(larger(cell.up * (is_above ? held.load : taken_least), is_above ? raw : reading), dt);
    }
    const bool is_guarded = cell.sd > 0 && std::isfinite(reading) &&
                            guard.holds(reading, since, standing.stood(), filter.sd(), fastest * most),
               is_far = is_far_stage(reading / branch(cell));
    bool is_held = is_guarded || is_far;
    // What both cells read in a single row may be a fault of their supply: the load is taken to be there, and
    // friction to follow in the next row.
    const bool is_first = at.is_sure() && !is_stage();
    const Scalar shown = reading;
    bool is_shown = is_held && is_seen();
    if (is_shown && !is_first) {
      if (is_guarded) guard.believe(reading);
      is_held = is_shown = false;
    }
    if (is_held) reading = std::numeric_limits<Scalar>::quiet_NaN();
    if (guard.has_moved()) filter.lose();
    if (was_peak(reading)) come_to_refused(cell);
    const int run_length = filter.run_length();
    const bool was_alone = at.alone && refusals == 1;
    new (&at) ConditionedLoad<Scalar>(filter.take(reading, since));
    const bool goes_there = is_next_stage(reading / branch(cell));
    if (std::isfinite(reading) && ((at.refused && is_seen()) || (goes_there && !at.is_sure()))) {
      is_shown = is_first && !goes_there;
      if (!is_shown) {
        filter.lose();
        at = filter.take(reading, since);
      }
    }
    if (is_shown) {
      at.load = shown;
      at.refused = false;
      at.alone = true;
    }
    if (taken > 0) stay_taken(cell.up);
    if (filter.run_length() < run_length) {
      noise.bend();
      corners.bends = true;
    }
    corners.times_noise = larger(corners.times_noise, follow_noise(given.force, cell));
    at.sd = larger(at.sd, lasts);
    at.come_sd = larger(at.come_sd, lasts);
    // Two standard deviations are as far as the load can have gone.
    if (is_held)
      at.sd = larger(at.sd, is_far ? std::fabs(shown / branch(cell) - load_before) : guard.reach() / 2);
    if (at.is_sure()) {
      // The load has gone where one reading alone had left its line; else it is back on that.
      if (was_alone && filter.run_length() <= 2) turning.add(refused, 0, filter.sd());
      turning.add(reading, since, filter.sd());
    } else {
      turning.miss(since);
      // A single reading far off may well be a load that begins to move, or a mistake; one that is refused in
      // a row a load stage says that the jack may have gone as far again.
      const Scalar from = at.alone ? load_before * branch(cell) : at.load;
      if (std::isfinite(reading) || is_shown)
        at.sd = larger(at.sd, std::fabs(shown - from) / (at.refused && is_stage() ? 1 : 2));
      // Friction stands where the load is, perhaps elsewhere.
      at.come = at.load;
      at.come_sd = at.sd;
    }
    if (at.reversed) find_reversal(cell);
    raw = given.force;
    if (cell.has_branches()) {
      at = behind_branches(at, cell);
      raw /= branch(cell);
    }
    note_farthest(filter.sd() / branch(cell) / 2, most);
    if (first == 0 && at.load > 0) first = Scalar(1e-3) * cell.sd;
    step_by = std::fabs(at.load - load_before);
    stride = since;
    constexpr int few = 3;
    if (!at.alone && filter.goes_on() && filter.run_length() > few && stride > 0 &&
        step_by > fastest_seen * stride)
      fastest_seen = step_by / stride;
    // What is not believed yet may have begun to move.
    if (!at.is_sure() && std::isfinite(shown) && (!is_held || guard.may_begin_to_move()))
      step_by = larger(step_by, std::fabs(shown / branch(cell) - load_before));
    since = 0;
    is_new = at.is_sure();
    went_on = goes_on && filter.sd() > 0 && filter.knows_pace();
    if (taught > filter.run_length()) taught = filter.run_length();
    corners.reverses |= at.reversed || turned_before;
    if (at.reversed || turned_before) elongation.begin_leg();
    return finds_outlier(given.force, std::isfinite(possible(given.force, most)), was_alone);
  }
  /// Unknowns were learned with so many of its readings, the one of this row among them.
  void teach(int readings) {
    if (is_new && !teaches) taught += readings;
    teaches = true;
  }
  /// The part of the readings behind its best estimate with which unknowns were learned, Eq. (66).
  Scalar taught_part() const {
    const int readings = filter.run_length();
    return taught < readings ? static_cast<Scalar>(taught) / static_cast<Scalar>(readings) : Scalar(1);
  }
  /// Other loads change: where friction comes to rest, it remembers the load as far as it has probably come,
  /// not as far as it is confirmed to have come.
  void come_to_best(const LoadCell<Scalar>& cell) {
    come_sd = at.behind ? larger(at.come_sd, std::fabs(at.come - at.confirmed)) : at.come_sd;
    if (!is_new || (at.behind && at_rest < 0)) return;
    // Where a ramp ends, the estimate overshoots at first.
    const bool goes_up = at.come > at.confirmed;
    const Scalar noise_sd = filter.sd() / branch(cell), most = goes_up ? raw + noise_sd : raw - noise_sd;
    const bool overshoots = goes_up ? at.come > most : at.come < most;
    const Scalar to = overshoots ? most : at.come, further = goes_up ? to - at.confirmed : at.confirmed - to;
    if (overshoots) come_sd = larger(at.come_sd, noise_sd);
    if (!(further > (at_rest < 0 ? Scalar(0) : at.come_sd))) return;
    filter.come_to(to * branch(cell));
    at.confirmed = to;
  }
  /// Another jack turns in this row: this one has been as far as it surely was by then, whether it goes on or
  /// has turned as well, which shows later.
  void come_to_farthest(const LoadCell<Scalar>& cell) {
    come_sd = larger(at.sd, farthest_sd);
    if (rises ? farthest > at.confirmed : farthest < at.confirmed) {
      filter.come_to(farthest * branch(cell));
      at.confirmed = farthest;
    }
    load_before = at.confirmed;
  }
  /// Beside other jacks: whether friction may have come to rest at its load. Where it goes on, it has not;
  /// but it may have turned, and where another jack has, until it surely goes on.
  bool may_rest() const { return !moves.is_fast() || may_be_back() || (at_rest >= 0 && !moves.has_gone()); }
  /// Beside other jacks: after take(), whether it goes on.
  void follow_moves(Scalar dt, const LoadCell<Scalar>& cell) {
    if (is_new)
      moves.follow(at.load, filter.sd() / branch(cell), JumpGuard<Scalar>::is_stage(dt));
    else
      moves.rest();
  }
  /// Whether its readings could be those of a jack that does not pull.
  bool may_idle() const { return !locked && at.load < 5 * filter.sd(); }
  /// Whether it begins to rest beside other loads in this row, or ceases to.
  bool changes_rest() const { return rests_beside != (at_rest >= 0); }
  /// Whether the load went up until it reversed in this row.
  bool had_risen() const { return locks_now ? rises : !rises; }
  /// Whether it went up where it is locked in this row.
  bool locks_rising() const { return rises != at.reversed; }
  bool has_reversed() const { return (!locked || locks_now) && at.reversed; }
  /// The same until it turned before that.
  bool had_risen_before() const { return at.reversed ? rises : !rises; }
  /// Whether all sticks that its wedge let slide back, at whatever load it may have taken over.
  bool stays_taken() const { return taken > 0 && !(at.load > taken); }
  /// Whether its cable is where the best estimate of its load is: the load is read, has not perhaps turned,
  /// and does not just take over.
  bool leads() const { return !locked && !at.behind && !stays_taken(); }
  /// What slides and what sticks in its cable is in doubt: the load may have reversed, or the reading of this
  /// row was none, and the load is where it was last read, or elsewhere.
  bool is_in_doubt() const { return at.behind || (!locked && !at.is_sure()); }
  /// How far a load may have come back to `from` without being confirmed to have turned: the forces that
  /// friction holds did not follow. Zero within three standard deviations, as it is by chance [N].
  Scalar back(Scalar from) const {
    const Scalar off = short_of_farthest(from);
    return off > 2 * farthest_sd ? off : Scalar(0);
  }
  /// How far `from` is short of the farthest place where the load has surely been, within one standard
  /// deviation of that [N].
  Scalar short_of_farthest(Scalar from) const {
    return larger((rises ? farthest - from : from - farthest) - farthest_sd, Scalar(0));
  }
  bool may_be_back() const { return at.behind || back(at.load) > 0; }
  /// By how much the load may be off if it is in doubt [N], or may have come back from where it was farthest,
  /// too little to be seen: joints stick then that are taken to slide, Eq. (64).
  Scalar doubt() const {
    if (is_in_doubt()) return larger(at.sd, back(at.load));
    if (locked || (goes_on && missed == 0)) return 0;
    return larger(rises ? farthest - at.load : at.load - farthest, Scalar(0)) + farthest_sd + missed;
  }
  /// Where the tracker is driven to for a row [N].
  Scalar target() const { return larger(at.confirmed, first); }
  /// Where it was a row ago, between where the tracker is by then and where it is driven to: other loads
  /// change from there on.
  Scalar corner() const {
    const Scalar from = at.reversed ? at.reversal : driven.locked ? load_before : driven.force, to = target();
    return to > from ? -larger(-to, -larger(from, load_before)) : larger(to, -larger(-from, -load_before));
  }
  /// Whether the error of a cell with two branches is another one from here on: the load leaves the place of
  /// its last turn.
  bool changes_branch() const { return erred_up != pulls && !locked && target() != turned; }
  /// The best estimate of the load, not below the least one [N].
  Scalar best() const { return larger(at.load, first); }
  /// From where the tracker was driven to, to the best estimate of the load [N].
  Scalar beyond() const { return locked ? Scalar(0) : best() - driven.force; }
  /// The same to where the load has probably come, for what friction holds of it.
  Scalar come_beyond() const { return locked ? Scalar(0) : larger(at.come, first) - driven.force; }
  /// The load as a measurement of the row sees it: the raw reading if there is one, so that errors are
  /// independent from row to row.
  JackReading<Scalar> reading(const LoadCell<Scalar>& cell) const {
    if (locked) return {};
    const Scalar sd = says_load(cell) ? filter.sd() / branch(cell) : at.sd;
    return {seen(cell) - driven.force, sd * sd};
  }
  /// The part of its standard deviation that readings of several rows have in common [N]: all of it, where
  /// its cell is not read.
  Scalar lasting(const LoadCell<Scalar>& cell) const {
    return locked ? Scalar(0) : is_unread ? at.sd : lasts / branch(cell);
  }
  /// The same load itself [N].
  Scalar seen(const LoadCell<Scalar>& cell) const {
    return locked ? driven.force : says_load(cell) ? raw : at.load;
  }
  /// Whether there is a reading in this row that says something of the load: between branches none does.
  bool says_load(const LoadCell<Scalar>& cell) const {
    return is_new && !(cell.has_branches() && at.load == turned);
  }

  /// While the end is locked, its load cell is that of a jack put back on it, which pulls. Returns true if
  /// and only if the jack, confirmed to pull less for `confirmed_below` readings, comes to pull what the end
  /// segment has: the wedge is free. `held` is its reading then [N], deviation() the standard deviation.
  /// Cost: that of LoadFilter::take(), and at most one call of deviation().
  template <class Deviation>
  [[nodiscard]] bool lifts_off(Scalar reading, Scalar most, Scalar held, const Deviation& deviation) {
    const ConditionedLoad<Scalar> pull = filter.take(possible(reading, most), since);
    since = 0;
    pulls_surely = pull.is_sure();
    if (!pulls_surely) return false;
    raw = reading;
    if (below == confirmed_below) {
      if (pull.load < held) return false;
      below = 0;
      return true;
    }
    const Scalar missing = held - pull.load;
    const bool is_below = missing > Scalar(0.01) * held && missing > 4 * (pull.sd + deviation());
    below = static_cast<std::uint8_t>(is_below ? below + 1 : 0);
    return false;
  }
};

}  // namespace taut
