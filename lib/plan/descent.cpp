#include "lib/plan/descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/plan/linear_program.hpp"

namespace taut::host {
namespace {

// The piece that a plan lies on: rates of all that counts, by each open force.
struct Piece {
  CoursePlan at;
  std::vector<CourseOutcome> rate;
};

class Descent {
 public:
  Descent(Course& course, const PlanGoal& goal, double width, std::size_t most_legs)
      : course_(course), goal_(goal), width_(width), last_leg_(course.jacking().legs() + most_legs) {}

  CoursePlan run(std::vector<double> force) {
    const std::size_t n = force.size();
    for (std::size_t k = 0; k < n; ++k) force[k] = std::clamp(force[k], 0.0, course_.most(k));
    CoursePlan best{force, course_.at(force)};
    double radius = width_;
    while (radius > 1e-9 * width_ && has_legs()) {
      const double before = best.outcome.merit();
      CoursePlan next = best;
      look(best, best, radius, next);
      // The pieces at the sides of the box, only where that of the plan leads nowhere.
      if (!is_better(next, before)) {
        for (std::size_t k = 0; k < n && n <= most_sides; ++k)
          for (const double way : {-1.0, 1.0}) {
            CoursePlan side = best;
            side.force[k] = std::clamp(side.force[k] + way * radius, 0.0, course_.most(k));
            if (side.force[k] == best.force[k] || !has_legs()) continue;
            side.outcome = course_.at(side.force);
            if (side.outcome.whole) look(best, side, radius, next);
          }
      }
      if (is_better(next, before)) {
        best = next;
        radius = std::min(2 * radius, width_);
      } else {
        radius /= 4;
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t most_sides = 8;  // open forces
  static constexpr int most_hops = 4;

  bool has_legs() const { return course_.jacking().legs() < last_leg_; }
  static bool is_better(const CoursePlan& plan, double merit) {
    return plan.outcome.merit() < merit - 1e-12 * std::fabs(merit);
  }

  // Hops from piece to piece within the box around `centre`, beginning with that of `first`; keeps the best.
  void look(const CoursePlan& centre, const CoursePlan& first, double radius, CoursePlan& best) {
    CoursePlan at = first;
    for (int hop = 0; hop < most_hops && has_legs(); ++hop) {
      if (at.outcome.merit() < best.outcome.merit()) best = at;
      const auto piece = piece_at(at, radius);
      if (!piece) return;
      auto next = nearest(*piece, centre.force, radius);
      if (!next) return;
      CoursePlan plan{std::move(*next), {}};
      plan.outcome = course_.at(plan.force);
      const double found = plan.outcome.merit();
      const bool expected = std::fabs(found - expected_) <= 1e-9 * (1 + std::fabs(found));
      const bool other = is_better(plan, best.outcome.merit());
      if (other) best = plan;
      if (expected || !plan.outcome.whole) return;
      at = std::move(plan);
    }
  }

  // Exact but for rounding: between the two plans nothing happens that would not at the first.
  std::optional<Piece> piece_at(const CoursePlan& plan, double radius) {
    Piece piece{plan, std::vector<CourseOutcome>(plan.force.size())};
    const double step = std::max(1e-7 * width_, std::min(1e-5 * width_, 1e-2 * radius));
    for (std::size_t k = plan.force.size(); k-- > 0;) {
      std::vector<double> force = plan.force;
      const double by = force[k] + step <= course_.most(k) ? step : -step;
      force[k] += by;
      if (force[k] < 0) return std::nullopt;
      CourseOutcome moved = course_.at(force);
      if (!moved.whole) {
        force[k] = plan.force[k] - by;
        if (force[k] < 0 || force[k] > course_.most(k)) return std::nullopt;
        moved = course_.at(force);
        if (!moved.whole) return std::nullopt;
      }
      const double taken = force[k] - plan.force[k];
      for (std::size_t s = 0; s < moved.tension.size(); ++s) {
        for (std::size_t i = 0; i < moved.tension[s].size(); ++i)
          moved.tension[s][i] = (moved.tension[s][i] - plan.outcome.tension[s][i]) / taken;
        for (std::size_t j = 0; j < moved.stroke[s].size(); ++j)
          moved.stroke[s][j] = (moved.stroke[s][j] - plan.outcome.stroke[s][j]) / taken;
      }
      piece.rate[k] = std::move(moved);
    }
    return piece;
  }

  // Unknowns: how far each force is above the lower side of the box, of its width; then the error.
  std::optional<std::vector<double>> nearest(const Piece& piece, const std::vector<double>& centre,
                                             double radius) {
    const std::vector<double>& from = piece.at.force;
    const CourseOutcome& outcome = piece.at.outcome;
    const std::size_t n = from.size();
    std::vector<double> low(n), span(n);
    for (std::size_t k = 0; k < n; ++k) {
      low[k] = std::max(0.0, centre[k] - radius);
      span[k] = std::min(course_.most(k), centre[k] + radius) - low[k];
    }
    LinearProgram program;
    program.cost.assign(n + 1, 0);
    program.cost[n] = 1;
    const auto row = [&](double value, const auto& rate, double scale, double sign, double most,
                         bool counts) {
      std::vector<double> entries(n + 1, 0);
      double base = value;
      for (std::size_t k = 0; k < n; ++k) {
        base += rate(k) * (low[k] - from[k]);
        entries[k] = sign * rate(k) * span[k] / scale;
      }
      if (counts) entries[n] = -1;
      program.add(std::move(entries), sign * (most - base) / scale);
    };
    const std::size_t last = outcome.tension.size() - 1;
    for (std::size_t i = 0; i < goal_.target.size(); ++i) {
      if (!goal_.matters(i)) continue;
      const auto rate = [&](std::size_t k) { return piece.rate[k].tension[last][i]; };
      for (const double sign : {1.0, -1.0})
        row(outcome.tension[last][i], rate, goal_.target[i], sign, goal_.target[i], true);
    }
    for (std::size_t s = 0; s < outcome.tension.size(); ++s) {
      for (std::size_t i = 0; i < goal_.target.size(); ++i) {
        const double most = (1 - 2e-9) * goal_.most_segment[i];
        if (!std::isfinite(most)) continue;
        row(
            outcome.tension[s][i], [&](std::size_t k) { return piece.rate[k].tension[s][i]; }, most, 1, most,
            false);
      }
      for (std::size_t j = 0; j < outcome.stroke[s].size(); ++j) {
        const double most = (1 - 2e-9) * course_.jacking().jacks()[j].most_stroke;
        if (!std::isfinite(most)) continue;
        row(
            outcome.stroke[s][j], [&](std::size_t k) { return piece.rate[k].stroke[s][j]; }, most, 1, most,
            false);
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> entries(n + 1, 0);
      entries[k] = 1;
      program.add(std::move(entries), 1);
    }
    // Two jacks of a cable may not pull it through.
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double ratio = course_.least_ratio(k);
      if (ratio == 0) continue;
      for (const std::size_t big : {k, k + 1}) {
        const std::size_t small = 2 * k + 1 - big;
        std::vector<double> entries(n + 1, 0);
        entries[big] = ratio * span[big] / width_;
        entries[small] = -span[small] / width_;
        program.add(std::move(entries), (low[small] - ratio * low[big]) / width_);
      }
    }
    const auto x = solve(program);
    if (!x) return std::nullopt;
    expected_ = (*x)[n];
    std::vector<double> force(n);
    for (std::size_t k = 0; k < n; ++k)
      force[k] = std::clamp(low[k] + (*x)[k] * span[k], 0.0, course_.most(k));
    return force;
  }

  Course& course_;
  const PlanGoal& goal_;
  double width_;
  std::size_t last_leg_;
  double expected_ = 0;  // error of the plan found last, on its piece
};

}  // namespace

CoursePlan descend(Course& course, const PlanGoal& goal, const std::vector<double>& force, double width,
                   std::size_t most_legs) {
  return Descent(course, goal, width, most_legs).run(force);
}

}  // namespace taut::host
