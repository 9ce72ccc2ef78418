#include "lib/plan/up_and_back.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "lib/plan/course.hpp"
#include "lib/plan/linear_program.hpp"
#include "lib/plan/objective.hpp"

namespace taut::host {
namespace {

constexpr double unreachable = 1e12;
// Forces that a linear function fits so well are linear.
constexpr double fits = 1e-9;

double mix(double from, double to, double part) { return from + part * (to - from); }

// The way up, with a state kept at every event.
class Pull {
  static constexpr int most_rounds = 16;

 public:
  Pull(Jacking& jacking, const PlanGoal& goal, std::size_t jack, const std::string& start)
      : jacking_(jacking), goal_(goal), jack_(jack) {
    jacking_.go_to(start);
    PlanStage stage = jacking_.beginning();
    const double first = stage.force[jack];
    double most = std::max(first, jacking_.jacks()[jack].most_force);
    if (!jacking_.loads_are_on()) {
      most = farthest_with_loads(start, most);
      jacking_.go_to(start);
    }
    stage.force[jack] = most;
    leg_ = jacking_.follow(stage, &state_);
    for (const LegPoint& point : leg_.points) force_.push_back(mix(first, most, point.part));
    find_end();
  }

  /// Forces at events, and the last one that is worth a pull.
  const std::vector<double>& forces() const { return force_; }
  double begin() const { return force_.front(); }
  const LegPoint& point(std::size_t i) const { return leg_.points[i]; }
  double end() const { return end_; }
  /// The event at or below a force.
  std::size_t below(double force) const {
    std::size_t i = 0;
    while (i + 1 < force_.size() && force_[i + 1] <= force) ++i;
    return i;
  }
  /// Brings the model there, if it has an answer. Loads that come with a pull grow as it does: then every
  /// pull is a way of its own.
  [[nodiscard]] bool go_to(double force) {
    const bool is_one_way = jacking_.loads_are_on();
    const std::size_t i = is_one_way ? below(force) : 0;
    jacking_.go_to(state_[i]);
    if (is_one_way && force <= force_[i]) return true;
    PlanStage stage = jacking_.beginning();
    stage.force[jack_] = force;
    return jacking_.jump(stage).whole;
  }
  // How fast the segments that matter change on the way up at most, relative to their targets [1/N].
  double steepest() const {
    double most = 0;
    for (std::size_t k = 1; k < force_.size() && force_[k - 1] < end_; ++k) {
      const double by = force_[k] - force_[k - 1];
      if (!(by > 1e-9 * end_)) continue;
      for (std::size_t i = 0; i < goal_.target.size(); ++i)
        if (goal_.matters(i))
          most = std::max(most, std::fabs(leg_.points[k].tension[i] - leg_.points[k - 1].tension[i]) / by /
                                    goal_.target[i]);
    }
    return most;
  }

 private:
  // Where loads come with the pull a farther one has less of them at every force, and may lift the roof off:
  // the farthest that has an answer with all of them.
  double farthest_with_loads(const std::string& start, double most) {
    PlanStage stage = jacking_.beginning();
    double reached = 0, beyond = most, force = most;
    for (int round = 0; round < most_rounds && reached < most; ++round) {
      jacking_.go_to(start);
      stage.force[jack_] = force;
      (jacking_.jump(stage).whole ? reached : beyond) = force;
      force = (reached + beyond) / 2;
    }
    return reached > 0 ? reached : most;
  }
  // Up to the first limit; or to where all that matters has twice its target: what is lower after a release
  // has slid back then, and does not depend on the pull.
  void find_end() {
    end_ = force_.back();
    for (std::size_t k = 1; k < force_.size(); ++k) {
      const LegPoint &from = leg_.points[k - 1], &to = leg_.points[k];
      const double first = excess_at(from, goal_, jacking_.jacks());
      if (first > 0) {
        end_ = force_[k - 1];
        return;
      }
      if (excess_at(to, goal_, jacking_.jacks()) > 0) {
        double inside = 0, outside = 1;
        for (int round = 0; round < 60; ++round) {
          const double part = (inside + outside) / 2;
          (excess_between(from, to, part) > 0 ? outside : inside) = part;
        }
        end_ = mix(force_[k - 1], force_[k], inside);
      }
      bool is_ample = true;
      for (std::size_t i = 0; i < goal_.target.size(); ++i)
        is_ample = is_ample && (!goal_.matters(i) || from.tension[i] >= 2 * goal_.target[i]);
      if (is_ample) end_ = std::min(end_, force_[k - 1]);
      if (end_ < force_[k]) break;
      // Between events that are far apart, too.
      double ample = 0;
      for (std::size_t i = 0; i < goal_.target.size(); ++i) {
        if (!goal_.matters(i) || from.tension[i] >= 2 * goal_.target[i]) continue;
        const double rise = to.tension[i] - from.tension[i];
        ample = std::max(ample, rise > 0 ? (2 * goal_.target[i] - from.tension[i]) / rise : 2.0);
      }
      if (ample < 1) {
        end_ = mix(force_[k - 1], force_[k], ample);
        break;
      }
    }
  }
  double excess_between(const LegPoint& from, const LegPoint& to, double part) const {
    LegPoint point = from;
    for (std::size_t i = 0; i < point.tension.size(); ++i)
      point.tension[i] = mix(from.tension[i], to.tension[i], part);
    for (std::size_t j = 0; j < point.stroke.size(); ++j)
      point.stroke[j] = mix(from.stroke[j], to.stroke[j], part);
    return excess_at(point, goal_, jacking_.jacks());
  }

  Jacking& jacking_;
  const PlanGoal& goal_;
  std::size_t jack_;
  Leg leg_;
  std::vector<std::string> state_;
  std::vector<double> force_;
  double end_ = 0;
};

// All that can follow a pull.
struct Release {
  double up = 0;
  double stroke = 0;  // at its begin
  std::vector<double> force;
  std::vector<LegPoint> points;
  bool is_clean = true;  // no limit on the way
  double error = unreachable, back = 0;
  double drawn_from = 0;  // force at which the jack is locked, to end at `back`
};

class Search {
 public:
  Search(Jacking& jacking, const PlanGoal& goal, std::size_t jack, double seating, double steepness,
         const std::string& start, std::size_t most_legs)
      : jacking_(jacking),
        goal_(goal),
        jack_(jack),
        seating_(seating),
        last_leg_(jacking.legs() + most_legs),
        pull_(jacking, goal, jack, start),
        steepest_(steepness * pull_.steepest()) {}

  UpAndBack back_alone() {
    best_.bound = release(pull_.begin()).error;
    return best_;
  }

  UpAndBack run() {
    const double begin = pull_.begin(), end = pull_.end();
    release(begin);
    release(end);
    divide(begin, end);
    while (has_legs()) {
      const auto lowest = std::min_element(open_.begin(), open_.end(),
                                           [](const Part& a, const Part& b) { return a.bound < b.bound; });
      if (lowest == open_.end() || lowest->bound >= best_.error - 1e-10) break;
      const Part part = *lowest;
      open_.erase(lowest);
      look_into(part.from, part.to);
    }
    best_.bound = best_.error;
    for (const Part& part : open_) best_.bound = std::min(best_.bound, part.bound);
    return best_;
  }

 private:
  struct Part {
    double from, to, bound;
  };
  static constexpr int most_events = 2;  // of the pull, in a part whose cells are looked at

  bool has_legs() const { return jacking_.legs() < last_leg_; }

  const Release& release(double up) {
    const auto known = releases_.find(up);
    if (known != releases_.end()) return known->second;
    Release release;
    release.up = up;
    if (!pull_.go_to(up)) return releases_.emplace(up, std::move(release)).first->second;
    PlanStage let_out = jacking_.beginning();
    let_out.force[jack_] = 0;
    const Leg leg = jacking_.follow(let_out);
    release.stroke = leg.points.front().stroke[jack_];
    for (const LegPoint& point : leg.points) {
      if (excess_at(point, goal_, jacking_.jacks()) > 0) {
        release.is_clean = false;
        break;
      }
      release.force.push_back(up * (1 - point.part));
      release.points.push_back(point);
    }
    release.is_clean = release.is_clean && leg.whole;
    find_best(release);
    return releases_.emplace(up, std::move(release)).first->second;
  }

  // What a seating leaves of the leg between two points.
  double first_part(const Release& release, std::size_t k) const {
    const double from = release.points[k - 1].stroke[jack_], to = release.points[k].stroke[jack_];
    const double most = release.stroke - seating_;
    if (seating_ == 0 || from <= most) return 0;
    return to <= most && from > to ? (from - most) / (from - to) : 2;
  }
  void find_best(Release& release) {
    if (release.points.size() == 1 && seating_ == 0) {
      release.error = off_target(release.points[0].tension, goal_.target);
      release.back = release.drawn_from = release.up;
    }
    for (std::size_t k = 1; k < release.points.size(); ++k) {
      const double first = first_part(release, k);
      if (first > 1) continue;
      const NearestPart nearest =
          nearest_part(release.points[k - 1].tension, release.points[k].tension, goal_.target, first);
      if (nearest.error >= release.error) continue;
      release.error = nearest.error;
      release.back = release.drawn_from = mix(release.force[k - 1], release.force[k], nearest.part);
      if (seating_ > 0)
        release.drawn_from =
            force_at_stroke(release, seating_ + mix(release.points[k - 1].stroke[jack_],
                                                    release.points[k].stroke[jack_], nearest.part));
    }
    if (release.error >= best_.error && best_.found) return;
    best_.found = release.error < unreachable;
    best_.error = release.error;
    best_.up = release.up;
    best_.back = release.drawn_from;
  }
  double force_at_stroke(const Release& release, double stroke) const {
    for (std::size_t k = 1; k < release.points.size(); ++k) {
      const double from = release.points[k - 1].stroke[jack_], to = release.points[k].stroke[jack_];
      if (to <= stroke && from > to)
        return mix(release.force[k - 1], release.force[k],
                   std::clamp((from - stroke) / (from - to), 0.0, 1.0));
    }
    return release.up;
  }

  void divide(double from, double to) {
    const double first = release(from).error, second = release(to).error;
    // Where there is no answer at one end, nothing is known of what lies between but that it is near the
    // other.
    const double bound = first >= unreachable || second >= unreachable
                             ? std::min(first, second) - steepest_ * (to - from)
                             : (first + second - steepest_ * (to - from)) / 2;
    open_.push_back({from, to, std::max(0.0, first >= unreachable && second >= unreachable ? 0.0 : bound)});
  }

  void look_into(double from, double to) {
    if (!(to - from > 1e-13 * pull_.end())) return;
    // Where the lower bounds from both ends meet (Piyavskii and Shubert), not too near to either.
    double middle = (from + to) / 2;
    const double first = release(from).error, second = release(to).error;
    if (first < unreachable && second < unreachable && steepest_ > 0)
      middle =
          std::clamp(middle + (first - second) / (2 * steepest_), mix(from, to, 0.05), mix(from, to, 0.95));
    // The event of the pull that is nearest to it, where there are few.
    bool has_event = false;
    double nearest = 0;
    int events = 0;
    for (std::size_t k = 1; k < pull_.forces().size(); ++k) {
      const double force = pull_.forces()[k];
      // In second-order theory most events are steps of the level, where nothing begins to slide or to stick.
      if (!(force > from && force < to) || pull_.point(k).state == pull_.point(k - 1).state) continue;
      ++events;
      if (!has_event || std::fabs(force - middle) < std::fabs(nearest - middle)) nearest = force;
      has_event = true;
    }
    if (events > most_events) {
      divide(from, middle);
      divide(middle, to);
      return;
    }
    if (has_event) {
      middle = nearest;
    } else if (const auto cells = best_of_cells(release(from), release(to))) {
      if (cells->error >= best_.error - 1e-11) return;
      const double found = release(cells->up).error;
      if (found <= cells->error + fits) return;
      if (cells->up > from && cells->up < to) middle = cells->up;
    }
    divide(from, middle);
    divide(middle, to);
  }

  // The best between two releases whose cells are alike.
  struct CellBest {
    double up, error;
  };
  std::optional<CellBest> best_of_cells(const Release& a, const Release& b) const {
    if (!a.is_clean || !b.is_clean || a.points.size() != b.points.size()) return std::nullopt;
    for (std::size_t k = 1; k < a.points.size(); ++k)
      if (a.points[k].state != b.points[k].state) return std::nullopt;
    CellBest best{0, unreachable};
    for (std::size_t k = 1; k < a.points.size(); ++k) {
      const auto cell = best_of_cell(a, b, k);
      if (!cell) return std::nullopt;
      if (cell->error < best.error) best = *cell;
    }
    return best;
  }
  // Unknowns: how far the pull is from a to b, how far the release is from the lowest force of the cell to
  // its highest, and the error.
  std::optional<CellBest> best_of_cell(const Release& a, const Release& b, std::size_t k) const {
    const double width = b.up - a.up;
    const double low = std::min(a.force[k], b.force[k]);
    const double height = std::max(a.force[k - 1], b.force[k - 1]) - low;
    const double edge_a = a.force[k - 1] - a.force[k], edge_b = b.force[k - 1] - b.force[k];
    if (!(height > 0) || !(std::max(edge_a, edge_b) > 0)) return CellBest{a.up, unreachable};
    const bool at_a = edge_a >= edge_b;
    // Value of a linear function at the lower corner of a, and its slopes.
    struct Plane {
      double base, by_up, by_back;
      bool fits;
    };
    const auto plane = [&](double a_top, double a_bottom, double b_top, double b_bottom) {
      const double by_back = at_a ? (a_top - a_bottom) / edge_a : (b_top - b_bottom) / edge_b;
      const double by_up = (b_bottom - a_bottom - by_back * (b.force[k] - a.force[k])) / width;
      const double other = at_a ? b_bottom + by_back * edge_b - b_top : a_bottom + by_back * edge_a - a_top;
      const double size = std::fabs(a_top) + std::fabs(a_bottom) + std::fabs(b_top) + std::fabs(b_bottom);
      return Plane{a_bottom, by_up * width, by_back, std::fabs(other) <= fits * size};
    };
    LinearProgram program;
    program.cost = {0, 0, 1};
    const auto& a_top = a.points[k - 1];
    const auto& a_bottom = a.points[k];
    const auto& b_top = b.points[k - 1];
    const auto& b_bottom = b.points[k];
    for (std::size_t i = 0; i < goal_.target.size(); ++i) {
      if (!goal_.matters(i)) continue;
      const Plane T = plane(a_top.tension[i], a_bottom.tension[i], b_top.tension[i], b_bottom.tension[i]);
      if (!T.fits) return std::nullopt;
      const double scale = goal_.target[i], base = T.base + T.by_back * (low - a.force[k]);
      program.add({T.by_up / scale, T.by_back * height / scale, -1}, (goal_.target[i] - base) / scale);
      program.add({-T.by_up / scale, -T.by_back * height / scale, -1}, (base - goal_.target[i]) / scale);
    }
    // Between the two events.
    program.add({(b.force[k] - a.force[k]) / height, -1, 0}, (low - a.force[k]) / height);
    program.add({-(b.force[k - 1] - a.force[k - 1]) / height, 1, 0}, (a.force[k - 1] - low) / height);
    program.add({1, 0, 0}, 1);
    if (seating_ > 0) {
      const Plane p =
          plane(a_top.stroke[jack_], a_bottom.stroke[jack_], b_top.stroke[jack_], b_bottom.stroke[jack_]);
      if (!p.fits) return std::nullopt;
      const double scale = std::max(seating_, std::fabs(a.stroke) + std::fabs(b.stroke));
      program.add({(p.by_up - (b.stroke - a.stroke)) / scale, p.by_back * height / scale, 0},
                  (a.stroke - seating_ - p.base - p.by_back * (low - a.force[k])) / scale);
    }
    const auto x = solve(program);
    if (!x) return CellBest{a.up, unreachable};
    return CellBest{std::clamp(a.up + (*x)[0] * width, a.up, b.up), (*x)[2]};
  }

  Jacking& jacking_;
  const PlanGoal& goal_;
  std::size_t jack_;
  double seating_;
  std::size_t last_leg_;
  Pull pull_;
  double steepest_;
  std::map<double, Release> releases_;
  std::vector<Part> open_;
  UpAndBack best_;
};

}  // namespace

UpAndBack best_pull(Jacking& jacking, const PlanGoal& goal, std::size_t jack, const std::string& start) {
  const Pull pull(jacking, goal, jack, start);
  UpAndBack best;
  for (std::size_t k = 1; k < pull.forces().size() && pull.forces()[k - 1] < pull.end(); ++k) {
    const double from = pull.forces()[k - 1], to = pull.forces()[k];
    const double most = to > pull.end() ? (pull.end() - from) / (to - from) : 1;
    const NearestPart nearest =
        nearest_part(pull.point(k - 1).tension, pull.point(k).tension, goal.target, 0, most);
    if (best.found && nearest.error >= best.error) continue;
    best.found = true;
    best.up = best.back = mix(from, to, nearest.part);
    best.error = best.bound = nearest.error;
  }
  return best;
}

UpAndBack best_release(Jacking& jacking, const PlanGoal& goal, std::size_t jack, double seating,
                       const std::string& start) {
  return Search(jacking, goal, jack, seating, 1, start, 1).back_alone();
}

UpAndBack best_up_and_back(Jacking& jacking, const PlanGoal& goal, std::size_t jack, double seating,
                           double steepness, const std::string& start, std::size_t most_legs) {
  return Search(jacking, goal, jack, seating, steepness, start, most_legs).run();
}

}  // namespace taut::host
