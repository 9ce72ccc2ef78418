// A jacking as it happens: ramps, holds, overstress, release, lock-off and a second visit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "estimation_site/deed.hpp"
#include "estimation_site/site.hpp"
#include "estimation_site/truth.hpp"

namespace estimation_site {

/// What a case asks of the jacking.
struct JackingRules {
  bool stages = false;         ///< a row a load stage
  bool even = false;           ///< all of them at the same time from one another
  bool rests = false;          ///< the log begins before the pump runs
  double least_rate = 1;       ///< rows a second
  bool every_row = false;      ///< rows come at their rate, none is left out
  bool lock = false;           ///< always, not now and then
  bool visit = false;          ///< a second one, always
  bool swings = false;         ///< the load goes down and up again, some of it within the swing before
  bool loop = false;           ///< a ramp and a release, and no more
  bool in_turns = false;       ///< one cable after the other, in one round or two
  bool together = false;       ///< the same with all cables at once, by one pump
  bool jacks_in_turn = false;  ///< one of two jacks pulls while the valve of the other one is shut
  bool any_pace = false;       ///< the log begins before the pump runs; it is fast or slow, and so are rows
  bool dead_load = false;      ///< comes on while jacking, and changes in holds
  double warming = 0;  ///< sd of the temperature's way in the last hold, and of that after lock-off [K]
  double warming_locked = 0;             ///< sd of the temperature's way after lock-off [K]
  bool sized = false;                    ///< warming is as large as its sd, up or down
  int year_rows = 0;                     ///< a ramp, and a year after lock-off in so many rows
  double year_sd = 2;                    ///< of the logged temperature in that year [K]
  double relaxation = 0.025;             ///< of force in that year, part
  double ram = 0, ram_sd = 0;            ///< friction of the rams, part of the force, and how much it differs
  double ripple = 0;                     ///< of the pump, part of the force
  double least_leak = 0, most_leak = 0;  ///< of the force that the pump loses in a hold, part
  bool pumped_again = false;             ///< a few times in a hold, within a row

  auto all() const {
    return std::tie(stages, even, rests, least_rate, every_row, lock, visit, swings, loop, in_turns, together,
                    jacks_in_turn, any_pace, dead_load, warming, warming_locked, sized, year_rows, year_sd,
                    relaxation, ram, ram_sd, ripple, least_leak, most_leak, pumped_again);
  }
};

/// Random times and rows, driven through the true structure as they are made.
class Jacking {
 public:
  Jacking(const Ground& ground, const Reality& reality, const JackingRules& rules, Random& random,
          int fineness)
      : ground_(ground),
        rules_(rules),
        random_(random),
        truth_(true_structure(ground, reality), full_forces(ground), fineness * finer_by(rules)),
        rigs_(ground.cables.size()) {
    for (std::size_t c = 0; c < rigs_.size(); ++c) {
      if (ground.cables[c].two_jacks) rigs_[c].room = room_between_jacks(ground.cables[c], reality[c]);
      for (double& part : rigs_[c].ram)
        part = rules.ram > 0 ? std::fmax(0, rules.ram + rules.ram_sd * gaussian(random)) : 0;
    }
    rate_ = log_between(random, rules.least_rate, 50);
    stages_ = 5 + random.below(6);
    ripple_period_ = random.between(6, 20);
    if (rules.jacks_in_turn)
      run_jack_by_jack();
    else
      rules.in_turns || rules.together ? run_in_rounds() : run();
    good_ = good_ && truth_.follow(rows_);
  }
  /// False if the truth has no answer.
  bool good() const { return good_ && truth_.good(); }
  const std::vector<Deed>& rows() const { return rows_; }

 private:
  /// A jack whose valve is shut begins to hold more within a step, as no force does that is given.
  static int finer_by(const JackingRules& rules) { return rules.jacks_in_turn ? 4 : 1; }
  static std::vector<double> full_forces(const Ground& ground) {
    std::vector<double> full;
    for (const Cable& cable : ground.cables) full.push_back(cable.full);
    return full;
  }
  /// A part by which two jacks may surely differ before the cable is pulled through.
  double room_between_jacks(const Cable& cable, const CableReality& reality) const {
    double held = 0;
    for (int j = 0; j < cable.joints(); ++j)
      held += reality.mu[static_cast<std::size_t>(j)] * ground_.turning(cable, j);
    return 0.9 * std::fmin(0.15, 1 - std::exp(-held));
  }

  void run() {
    const int increments = rules_.loop || rules_.stages || rules_.year_rows > 0 ? 1 : 1 + random_.below(3);
    if (rules_.any_pace || rules_.rests) rest();
    for (int i = 1; i <= increments; ++i) {
      move(Phase::ramp, double(i) / increments);
      wait(Phase::hold, i == increments ? warming(rules_.warming) : 0);
      if (rules_.swings) swing(Phase::excursion);
    }
    if (rules_.loop) {
      move(Phase::excursion, random_.between(0.3, 0.6));
      wait(Phase::hold, 0);
      return;
    }
    if (rules_.year_rows > 0) {
      lock_for_a_year();
      return;
    }
    if (random_.coin()) {
      move(Phase::excursion, random_.between(1.03, 1.07));
      wait(Phase::excursion, 0);
      move(Phase::excursion, 1);
    }
    if (random_.coin()) {
      move(Phase::excursion, random_.between(0.5, 0.95));
      wait(Phase::hold, 0);
      if (random_.coin()) move(Phase::excursion, 1);
    }
    const bool locks = rules_.lock || rules_.visit || random_.below(5) < 3;
    if (!locks) return;
    lock(Phase::locked, warming(std::hypot(rules_.warming, rules_.warming_locked)));
    if (!rules_.visit && !random_.coin()) return;
    if (!unlock()) return;
    move(Phase::visit, std::fmax(random_.between(0.9, 1.1), level() + 0.03));
    wait(Phase::visit, 0);
    if (rules_.swings) swing(Phase::visit);
    lock(Phase::visit, 0);
  }
  /// Down and up again a few times, not always as far as before: turns within turns, and beyond them.
  void swing(Phase phase) {
    for (int left = random_.below(4); left > 0; --left) {
      move(phase, level() * random_.between(0.7, 0.98));
      wait(phase, 0);
      move(phase, std::fmin(level() * random_.between(1.01, 1.25), 1.07));
      wait(phase, 0);
    }
  }
  /// Round by round every cable is pulled and locked; now and then a jack keeps its load for the others.
  void run_in_rounds() {
    if (random_.coin()) rest();
    std::vector<std::size_t> order(rigs_.size());
    for (std::size_t c = 0; c < order.size(); ++c) {
      order[c] = c;
      std::swap(order[c], order[static_cast<std::size_t>(random_.below(static_cast<int>(c) + 1))]);
    }
    std::vector<std::vector<std::size_t>> groups;
    for (const std::size_t c : order) groups.push_back({c});
    if (rules_.together) groups = {order};
    const int rounds = 1 + random_.below(2);
    for (int round = 1; round <= rounds; ++round)
      for (const auto& group : groups) {
        active_ = group;
        if (!rows_.empty() && pull().locked[1] && !unlock()) return;
        const double part = std::fmax(double(round) / rounds, level() + 0.03);
        const Phase phase = round == 1 ? Phase::ramp : Phase::visit;
        move(phase, part);
        wait(Phase::hold, 0);
        if (random_.coin()) {
          move(Phase::excursion, part * random_.between(1.03, 1.07));
          move(Phase::excursion, part);
        }
        if (random_.below(4) > 0) lock(Phase::locked, 0);
      }
  }

  /// In some stages, each of the two jacks in its turn.
  void run_jack_by_jack() {
    const int stages = 2 + random_.below(4);
    std::size_t end = random_.coin() ? 0 : 1;
    for (int i = 1; i <= 2 * stages; ++i, end = 1 - end)
      if (!pull_alone(end, double((i + 1) / 2) / stages)) return;
  }
  /// From where it holds; false if what goes before has no answer.
  bool pull_alone(std::size_t end, double to) {
    if (!truth_.follow(rows_)) return false;
    const double from = rows_.empty() ? 0 : tension_at(last(), ground_.cables[0], end) / cable().full;
    if (from > to) return true;
    const Pace moving = pace(std::fmax(to - from, 0.05)), waiting = pace(random_.between(0.2, 0.5));
    for (int i = 1; i <= moving.rows + waiting.rows; ++i) {
      const bool moves = i <= moving.rows;
      Deed deed = moves ? next(Phase::ramp, i, moving) : next(Phase::hold, i - moving.rows, waiting);
      Pull& pull = deed.pulls[0];
      pull.shut[end] = false;
      pull.shut[1 - end] = true;
      pull.level = pull.force[end] = pull.gauge[end] =
          cable().full * (moves ? from + (to - from) * i / moving.rows : to);
      rows_.push_back(deed);
    }
    return true;
  }

  const Deed& last() const { return rows_.back(); }
  /// The first one of those that are pulled.
  const Cable& cable() const { return ground_.cables[active_.front()]; }
  const Pull& pull() const { return last().pulls[active_.front()]; }
  /// What the pump aims at, as a part of the full force; the most of several.
  double level() const {
    double most = 0;
    for (const std::size_t c : active_)
      if (!rows_.empty()) most = std::fmax(most, last().pulls[c].level / ground_.cables[c].full);
    return most;
  }
  Deed untouched() const {
    Deed deed;
    deed.pulls.resize(rigs_.size());
    return deed;
  }
  double warming(double size) {
    const double drawn = gaussian(random_);
    return size * (rules_.sized ? std::copysign(1.0, drawn) : drawn);
  }
  /// Where a quantity is that changes on a straight line in a window of its own.
  struct Way {
    double from = 0, to = 0, begin = 0, end = 1;
    double at(double part) const {
      return from + (to - from) * std::fmin(std::fmax((part - begin) / (end - begin), 0), 1);
    }
  };
  Way some_window(double from, double to) {
    const double begin = random_.between(0, 0.7);
    return {from, to, begin, begin + random_.between(0.1, 0.3)};
  }
  /// How the second jack of each cable compares with the first.
  std::vector<Way> next_lags() {
    std::vector<Way> ways;
    for (const std::size_t c : active_)
      ways.push_back({rigs_[c].lag, 1 + rigs_[c].room * random_.between(-1, 1), 0, 1});
    return ways;
  }

  /// How many rows something takes, and the seconds between them.
  struct Pace {
    int rows;
    double step;
  };
  /// Of a move by a part of the full force, or of a wait that is as long.
  Pace pace(double part) {
    if (rules_.stages) return {std::max(1, static_cast<int>(std::lround(part * stages_))), 0};
    if (rules_.any_pace) {
      const double length = std::fmax(log_between(random_, 5, 300) * part, 0.1),
                   step = 1 / log_between(random_, 0.25, 20), rows = std::ceil(length / step);
      return {static_cast<int>(std::fmin(rows, 110)), std::fmax(length / 110, step)};
    }
    const double length = log_between(random_, 10, 300) * std::fmax(part, 0.2);
    const double rows = std::fmin(std::fmax(length * rate_, 20), 110);
    const bool thinned = !rules_.every_row && length * rate_ > rows;
    return {static_cast<int>(rows), thinned ? length / rows : 1 / rate_};
  }

  /// Before anything pulls.
  void rest() {
    const Pace pace{8 + random_.below(40), 1 / log_between(random_, 0.25, 20)};
    for (int i = 1; i <= pace.rows; ++i) add(next(Phase::ramp, i, pace), false);
  }
  void move(Phase phase, double to) {
    const Deed from = rows_.empty() ? untouched() : last();
    const bool loads = rules_.dead_load && phase == Phase::ramp;
    const Way dead_way = some_window(from.factor[dead], loads ? to : from.factor[dead]);
    const std::vector<Way> lag_ways = next_lags();
    const Pace pace = this->pace(std::fabs(to - level()));
    for (int i = 1; i <= pace.rows; ++i) {
      Deed deed = next(phase, i, pace);
      const double part = double(i) / pace.rows;
      deed.factor[dead] = dead_way.at(part);
      for (std::size_t a = 0; a < active_.size(); ++a) {
        const std::size_t c = active_[a];
        const double full = ground_.cables[c].full, begin = from.pulls[c].level / full;
        deed.pulls[c].level = full * (begin + part * (to - begin));
        rigs_[c].lag = lag_ways[a].at(part);
      }
      add(deed, true);
    }
  }
  void wait(Phase phase, double warming) {
    const Pace pace = rules_.stages ? Pace{1 + random_.below(3), 0} : this->pace(random_.between(0.2, 0.8));
    const Deed from = last();
    const bool loads = rules_.dead_load && phase == Phase::hold && random_.coin();
    const double change = loads ? random_.between(-0.2, 0.3) : 0;
    const Way dead_way = some_window(from.factor[dead], from.factor[dead] + change);
    const double leak = rules_.most_leak > 0 ? log_between(random_, rules_.least_leak, rules_.most_leak) : 0;
    const int between = rules_.pumped_again ? std::max(4, pace.rows / (2 + random_.below(5))) : pace.rows;
    for (int i = 1; i <= pace.rows; ++i) {
      Deed deed = next(phase, i, pace);
      const double part = double(i) / pace.rows,
                   lost = rules_.pumped_again ? double(i % between) / between : part;
      deed.factor[sun] = from.factor[sun] + warming * part;
      deed.factor[dead] = dead_way.at(part);
      for (const std::size_t c : active_) deed.pulls[c].level = from.pulls[c].level * (1 - leak * lost);
      add(deed, true);
    }
  }
  /// Seasons, days and relaxation, which is to forces as warming is; the logged temperature drifts by itself.
  void lock_for_a_year() {
    const double year = 365.25 * 86400, day = 86400, step = year / rules_.year_rows;
    const double relaxed = rules_.relaxation * cable().full / (cable().E * cable().A * cable().alpha);
    const double kept = std::exp(-step / day), begin = last().time;
    const double level = pull().level;
    double error = rules_.year_sd * gaussian(random_);
    const double first_error = error;
    for (int i = 1; i <= rules_.year_rows; ++i) {
      Deed deed = next(Phase::locked, i, {rules_.year_rows, step});
      Pull& pull = deed.pulls[active_.front()];
      pull.fresh = false;
      pull.locked = {false, true};
      pull.level = i == 1 ? level : 0;
      const double t = deed.time - begin;
      error = kept * error + std::sqrt(1 - kept * kept) * rules_.year_sd * gaussian(random_);
      const double air = 12 * std::sin(2 * support::pi * t / year) + 5 * std::sin(2 * support::pi * t / day);
      deed.factor[sun] = air + relaxed * std::log1p(t / 3600) / std::log1p(year / 3600);
      deed.logged_sun = air + error - first_error;
      add(deed, false);
    }
  }
  /// The wedges hold, and the pressure is let out.
  void lock(Phase phase, double warming) {
    const Pace pace = rules_.stages ? Pace{2 + random_.below(3), 0} : this->pace(0.5);
    const Deed from = last();
    const int bleeding = rules_.stages ? 1 : 6;
    for (int i = 1; i <= pace.rows; ++i) {
      Deed deed = next(phase, i, pace);
      for (const std::size_t c : active_) {
        Pull& pull = deed.pulls[c];
        pull.fresh = false;
        pull.locked = {ground_.cables[c].two_jacks, true};
        pull.level = from.pulls[c].level * std::fmax(0, 1 - double(i - 1) / bleeding);
      }
      deed.factor[sun] = from.factor[sun] + warming * i / pace.rows;
      add(deed, false);
    }
  }
  /// The jacks are put back on and pull until they hold what the wedges held; false if that has no answer.
  bool unlock() {
    if (!truth_.follow(rows_)) return false;
    std::vector<double> wedge(rigs_.size());
    for (const std::size_t c : active_) {
      const auto first = last().tension.begin() + ground_.cables[c].first_segment;
      wedge[c] = *(first + ground_.cables[c].segments() - 1);
      if (ground_.cables[c].two_jacks) rigs_[c].lag = *first / wedge[c];
    }
    const Pace pace{rules_.stages ? 3 : 30, rules_.stages ? 0 : std::fmax(1 / rate_, 0.5)};
    for (int i = 1; i <= pace.rows; ++i) {
      Deed deed = next(Phase::visit, i, pace);
      const bool holds = i < pace.rows;
      for (const std::size_t c : active_) {
        Pull& pull = deed.pulls[c];
        pull.fresh = false;
        pull.locked = {ground_.cables[c].two_jacks && holds, holds};
        pull.level = (1 + rigs_[c].ram[1]) * wedge[c] * (holds ? 0.99 * i / pace.rows : 1.005);
      }
      add(deed, false);
    }
    return true;
  }

  Deed next(Phase phase, int i, const Pace& pace) {
    Deed deed = rows_.empty() ? untouched() : last();
    for (Pull& pull : deed.pulls) pull.fresh = false;
    for (const std::size_t c : active_) {
      deed.pulls[c].phase = phase;
      deed.pulls[c].fresh = !rules_.stages && i <= 12;
    }
    deed.time += rules_.even ? 60 : rules_.stages ? log_between(random_, 10, 600) : pace.step;
    return deed;
  }
  void add(Deed deed, bool pumping) {
    const double turn = 2 * support::pi * double(rows_.size()) / ripple_period_;
    for (const std::size_t c : active_) {
      Pull& pull = deed.pulls[c];
      const Rig& rig = rigs_[c];
      pull.gauge[1] = pull.level * (1 + (pumping ? rules_.ripple * std::sin(turn) : 0));
      if (ground_.cables[c].two_jacks) pull.gauge[0] = rig.lag * pull.gauge[1];
      for (std::size_t end = 0; end < 2; ++end) {
        // The ram holds its force until the pressure has turned round.
        const double held = rows_.empty() ? 0 : last().pulls[c].force[end], gauge = pull.gauge[end];
        pull.force[end] = std::fmin(std::fmax(held, gauge / (1 + rig.ram[end])), gauge / (1 - rig.ram[end]));
      }
    }
    if (rules_.year_rows == 0) deed.logged_sun = deed.factor[sun];
    rows_.push_back(deed);
  }

  const Ground& ground_;
  const JackingRules& rules_;
  Random& random_;
  Truth truth_;
  /// The jacks of a cable.
  struct Rig {
    std::array<double, 2> ram{};  ///< their rams' friction, part
    double lag = 1;               ///< of the first one's gauge to the second's
    double room = 0;              ///< by which they may differ, part
  };
  std::vector<Rig> rigs_;
  std::vector<std::size_t> active_{0};  ///< the cables that are pulled
  double rate_ = 1, ripple_period_ = 10;
  int stages_ = 8;
  std::vector<Deed> rows_;
  bool good_ = true;
};

}  // namespace estimation_site
