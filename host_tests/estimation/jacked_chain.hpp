// A chain of rigid saddles with a jack at its end: its forces in closed form, beside the estimator of it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "estimation/score.hpp"

namespace estimation {

constexpr int segments = 8;
constexpr double mu = 0.25, likely = 0.3 * mu, jack_sd = 1e-5 * full;

/// Where a jack pulls.
enum class Side { start, end };

/// The forces of the chain from start to end, with capstan friction: from each step of a jack to the next
/// every joint either sticks, or slides to the edge of its cone.
class Chain {
 public:
  explicit Chain(double friction) : Chain(std::vector<double>(segments - 1, friction)) {}
  /// Each joint has its own.
  explicit Chain(const std::vector<double>& friction) : mu_(friction), T_(friction.size() + 1, 0) {}
  double operator[](int segment) const { return T_[static_cast<std::size_t>(segment)]; }

  void pull(double force, Side side = Side::end) { T_ = pulled_by(force, side); }
  /// The wedge is drawn in by so much [m].
  void lock(double seating, Side side = Side::end) {
    double least = 0, most = side == Side::end ? T_.back() : T_.front();
    for (int i = 0; i < 200; ++i) {
      const double force = (least + most) / 2;
      (shortened_by(pulled_by(force, side)) < seating ? most : least) = force;
    }
    T_ = pulled_by(most, side);
  }

 private:
  double rho(std::size_t joint) const { return std::exp(-mu_[joint] * support::chain_turn[joint]); }
  std::vector<double> pulled_by(double force, Side side) const {
    std::vector<double> T = T_;
    const auto follow = [&](std::size_t i, std::size_t pulled, double rho) {
      T[i] = std::clamp(T[i], T[pulled] * rho, T[pulled] / rho);
    };
    if (side == Side::end) {
      T.back() = force;
      for (std::size_t i = T.size() - 1; i-- > 0;) follow(i, i + 1, rho(i));
    } else {
      T.front() = force;
      for (std::size_t i = 1; i < T.size(); ++i) follow(i, i - 1, rho(i - 1));
    }
    return T;
  }
  double shortened_by(const std::vector<double>& T) const {
    double sum = 0;
    for (std::size_t i = 0; i < T.size(); ++i)
      sum +=
          (T_[i] - T[i]) * support::chain_length(static_cast<int>(i)) / (support::cable_E * support::cable_A);
    return sum;
  }

  std::vector<double> mu_, T_;
};

/// What is said of the cable beside its seating; `seating_sd` is that of a part of it.
struct Said {
  double mu_sd = likely, jack_sd = estimation::jack_sd, far_sd = 0, scatter = 0, gain_sd = 0, seating_sd = 0,
         lag = 0;
  double wrong = 0;  ///< part of the readings of the far end while locked that are of anything
  bool has_two_jacks = false;

  /// What a wedge is really drawn in by [m].
  double drawn_in(double seating, support::Random& random) const {
    return seating * (seating_sd > 0 ? std::max(0.0, 1 + seating_sd * support::gaussian(random)) : 1);
  }
};

/// The estimator of the chain: a jack at its end, perhaps one at its start, and friction that is known to
/// some part.
class Jacked {
 public:
  using Model = taut::Condensed<double, PlaneCapacity>;
  using Estimator = taut::Estimator<Model, most_unknowns>;

  Jacked(double seating, const Said& said) {
    auto cable = support::steel_cable(mu, said.has_two_jacks ? support::two_jacks : support::jacked_end);
    cable.law = taut::FrictionLaw::capstan;
    cable.mu_sd = said.mu_sd;
    cable.shared_mu = true;
    cable.scatter = said.scatter;
    cable.cell[1].sd = said.jack_sd;
    cable.cell[1].gain_sd = said.gain_sd;
    cable.cell[0].sd = said.has_two_jacks ? said.jack_sd : said.far_sd;
    cable.cell[0].lag = cable.cell[1].lag = said.lag;
    cable.seating = seating;
    cable.seating_sd = said.seating_sd * seating;
    const auto scene = std::make_unique<Plane>();
    support::rigid_saddles(*scene, cable, support::chain_points(segments));
    taut::find_friction_prior(*scene, prior_);
    REQUIRE(support::condense(*scene, model_).ok());
    REQUIRE(estimator_.start(model_, prior_).status.ok());
  }
  void go(double from, double to, int rows) {
    for (int i = 1; i <= rows; ++i) row(from + (to - from) * i / rows, false);
  }
  /// A load stage.
  void stage(double reading) { row(reading, false, 60); }
  void lock() { row(0, true); }
  /// A row with the far end's reading, below zero if it is not read; the jack's is no number then.
  void row(double force, bool locked, double dt, double far) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.dt = dt;
    readings.sample.jack[0][1].locked = locked;
    readings.ends[0][1].has_force = !locked && std::isfinite(force);
    readings.ends[0][1].force = force;
    readings.ends[0][0].has_force = far >= 0;
    readings.ends[0][0].force = far;
    REQUIRE(estimator_.advance(readings).status.ok());
  }
  /// A row in which the jack's cell is read, locked or not.
  void row_of_jack(double force, bool locked, double dt) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.dt = dt;
    readings.sample.jack[0][1].locked = locked;
    readings.ends[0][1].has_force = true;
    readings.ends[0][1].force = force;
    REQUIRE(estimator_.advance(readings).status.ok());
  }
  /// A row in which the wedge still holds the end, and the jack pulls so much.
  void pull_locked(double force) { row_of_jack(force, true, 1); }
  /// Goes on from what was saved, as after a power failure.
  void reload() {
    const auto saved = std::make_unique<Estimator::State>(estimator_.save());
    REQUIRE(estimator_.restore(model_, prior_, *saved).ok());
  }
  /// A row of two jacks.
  void row_of_both(double start, double end, bool locked) { row_of_both(start, locked, end, locked); }
  void row_of_both(double start, bool start_locked, double end, bool end_locked) {
    taut::Readings<double, PlaneCapacity> readings;
    readings.dt = 1;
    readings.sample.jack[0][0].locked = start_locked;
    readings.sample.jack[0][1].locked = end_locked;
    readings.ends[0][0] = {!start_locked, false, start, 0};
    readings.ends[0][1] = {!end_locked, false, end, 0};
    REQUIRE(estimator_.advance(readings).status.ok());
  }
  taut::ForceEstimate<double> operator[](int segment) const { return estimator_.estimate(segment); }
  bool raises(taut::Alarm::Kind kind) const { return raised(estimator_.alarms(), kind) > 0; }

 private:
  void row(double force, bool locked, double dt = 1) { row(force, locked, dt, -1); }

  Model model_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  Estimator estimator_;
};

/// Adds all forces of the chain.
inline void add_to(Score& score, const Jacked& jacked, const Chain& chain) {
  for (int i = 0; i < segments; ++i) score.add((jacked[i].force - chain[i]) / jacked[i].deviation);
}
/// How all of them are held in the present row.
inline Score score_of(const Jacked& jacked, const Chain& chain) {
  Score score;
  add_to(score, jacked, chain);
  return score;
}
/// The largest error of one of them, as a part of what it is.
inline double largest_error(const Jacked& jacked, const Chain& chain) {
  double most = 0;
  for (int i = 0; i < segments; ++i) most = std::max(most, std::fabs(jacked[i].force - chain[i]) / chain[i]);
  return most;
}

/// A ramp, a hold, half of the time a release, and lock-off, perhaps with a cell at the far end: what is
/// shown of segments once the wedge is drawn in, after so many rows more, when the jack has taken hold again,
/// and once the wedge is drawn in a second time.
struct Locked {
  Score at_once, later, again, second;
};
template <class Drawn>
Locked lock_off(const Said& said, int rows, const Drawn& drawn) {
  Locked scores;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    support::Random random(seed);
    const double seating = 1e-3 * std::pow(30, random.between(0, 1));
    const auto jacked = std::make_unique<Jacked>(seating, said);
    Chain chain(drawn(random));
    const double gain = 1 + said.gain_sd * support::gaussian(random);
    const auto far_end = [&] {
      return said.far_sd > 0 ? chain[0] + said.far_sd * support::gaussian(random) : -1;
    };
    double at = 0;
    const auto go = [&](double to, int steps) {
      for (int i = 1; i <= steps; ++i) {
        const double force = at + (to - at) * i / steps;
        chain.pull(force);
        const double far = far_end();
        jacked->row(gain * (force + said.jack_sd * support::gaussian(random)), false, 1, far);
      }
      at = to;
    };
    go(full, 80);
    go(full, 40);
    if (random.coin()) {
      go(random.between(0.8, 0.97) * full, 30);
      go(at, 40);
    }
    chain.lock(said.drawn_in(seating, random));
    const auto stay = [&](int steps) {
      for (int i = 0; i < steps; ++i) {
        const bool is_wrong = said.wrong > 0 && random.between(0, 1) < said.wrong;
        jacked->row(0, true, 1, is_wrong ? random.between(0, 1.5) * full : far_end());
      }
    };
    stay(1);
    add_to(scores.at_once, *jacked, chain);
    stay(rows);
    add_to(scores.later, *jacked, chain);
    go(1.002 * chain[segments - 1], 1);
    go(std::max(at, random.between(0.9, 1.05) * full), 40);
    go(at, 40);
    add_to(scores.again, *jacked, chain);
    chain.lock(said.drawn_in(seating, random));
    stay(1);
    add_to(scores.second, *jacked, chain);
  }
  MESSAGE("seeds from 1: ", 100 * scores.at_once.share(), " % are held once locked, rms ",
          scores.at_once.rms(), "; later ", 100 * scores.later.share(), " %, rms ", scores.later.rms(),
          "; again ", 100 * scores.again.share(), " %, rms ", scores.again.rms(), "; locked again ",
          100 * scores.second.share(), " %, rms ", scores.second.rms(), "; worst ",
          std::max({scores.at_once.worst, scores.later.worst, scores.again.worst, scores.second.worst}));
  return scores;
}

}  // namespace estimation
