// Two jacks of one cable pull in turn while the valve of the other one is shut, as long cables are tensioned:
// strokes, which their forces leave open, against a closed form between rigid saddles.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "estimation/jacked_chain.hpp"
#include "taut/estimation/row_strokes.hpp"

namespace jacks_in_turn_test {
using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Estimator = CellEstimator;

enum class Strokes { none, of_start, of_both };

/// What is wrong on this site.
struct InTurn {
  double mu_sd = likely, gain_sd = 0.01, E_sd = 0.02;
  Strokes strokes = Strokes::of_both;
  bool has_free_zeros = true;
};
constexpr double force_sd = 2e-3 * full, stroke_sd = 5e-4;

struct Outcome {
  Score score;
  double square = 0, bars = 0;  ///< of errors, of deviations, relative to the full force
  int elongation_alarms = 0, rows = 0, refused = 0;
  double mu_sd = 0;  ///< at the end, of the last jacking
};

/// A cable between two jacks, with the truth beside it.
class Jacking {
 public:
  Jacking(const InTurn& site, std::uint64_t seed) : site_(site), random_(seed) {
    auto cable = support::steel_cable(mu, support::two_jacks);
    cable.law = taut::FrictionLaw::capstan;
    cable.mu_sd = site.mu_sd;
    cable.shared_mu = true;
    for (auto& cell : cable.cell) {
      cell.sd = force_sd;
      cell.gain_sd = site.gain_sd;
    }
    taut::LoadCell<double> stroke;
    stroke.sd = stroke_sd;
    stroke.gain_sd = site.E_sd;
    if (site.has_free_zeros) stroke.zero_sd = taut::free_zero<double>;
    gauges_ = {stroke, stroke};
    const auto scene = std::make_unique<Plane>();
    support::rigid_saddles(*scene, cable, support::chain_points(segments));
    taut::find_friction_prior(*scene, prior_);
    REQUIRE(support::condense(*scene, model_).ok());
    REQUIRE(estimator_.start(model_, prior_, {}, gauges_).status.ok());
    friction_ = std::max(0.02, mu + site.mu_sd * support::gaussian(random_));
    chain_ = Chain(friction_);
    for (double& gain : gain_) gain = 1 + site.gain_sd * support::gaussian(random_);
    EA_ = support::cable_E * support::cable_A * (1 + site.E_sd * support::gaussian(random_));
    for (double& mark : mark_) mark = site.has_free_zeros ? random_.between(0, 0.2) : 0;
  }

  /// In steps of a row, the valve at the other end shut. Returns whether every row had an answer.
  bool pull(Side side, double force, int rows, Outcome& outcome) {
    const int at = side == Side::start ? 0 : segments - 1;
    const std::size_t end = side == Side::start ? 0 : 1;
    const double from = chain_[at];
    for (int i = 1; i <= rows; ++i) {
      const double before = elongation();
      chain_.pull(from + (force - from) * i / rows, side);
      out_[end] += elongation() - before;
      if (!row(outcome)) return false;
    }
    return true;
  }
  /// Both at once, in steps of a row: the one at the start pulls so little that the way to it has this `part`
  /// of all friction. Returns whether every row had an answer.
  bool pull_both(double force, double part, int rows, Outcome& outcome) {
    double turn = 0;
    for (std::size_t j = 0; j + 1 < segments; ++j) turn += support::chain_turn.at(j);
    const double from = chain_[segments - 1], left = std::exp(-part * friction_ * turn);
    for (int i = 1; i <= rows; ++i) {
      const double at = from + (force - from) * i / rows;
      for (const Side side : {Side::end, Side::start}) {
        const double before = elongation();
        chain_.pull(side == Side::end ? at : left * at, side);
        out_[side == Side::end ? 1 : 0] += elongation() - before;
      }
      if (!row(outcome)) return false;
    }
    return true;
  }
  /// Each by a pump of its own, in steps of a row: that of the other jack begins once this one has come a
  /// `part` of its way, and goes on `rate` times as fast. Returns whether every row had an answer.
  bool pull_apart(Side side, double force, double part, double rate, int rows, Outcome& outcome) {
    const Side beside = side == Side::start ? Side::end : Side::start;
    const auto at = [&](Side end) { return chain_[end == Side::start ? 0 : segments - 1]; };
    const double from = at(side), other_from = at(beside);
    for (int i = 1; i <= rows; ++i) {
      const double way = static_cast<double>(i) / rows;
      chain_.pull(from + (force - from) * way, side);
      const double pumped = other_from + rate * (force - from) * (way - part);
      if (way > part && pumped > at(beside)) chain_.pull(pumped, beside);
      if (!row(outcome)) return false;
    }
    return true;
  }
  /// Of mu, in its standard deviations.
  double mu_error() const { return (estimator_.mu(0) - friction_) / estimator_.mu_deviation(0); }

 private:
  double elongation() const {
    double sum = 0;
    for (int i = 0; i < segments; ++i) sum += chain_[i] * support::chain_length(i) / EA_;
    return sum;
  }
  bool row(Outcome& outcome) {
    taut::Readings<double, PlaneCapacity> readings;
    for (std::size_t end = 0; end < 2; ++end) {
      const bool has_stroke =
          site_.strokes == Strokes::of_both || (site_.strokes == Strokes::of_start && end == 0);
      readings.ends[0][end] = {
          true, has_stroke,
          gain_[end] * chain_[end == 0 ? 0 : segments - 1] + force_sd * support::gaussian(random_),
          mark_[end] + out_[end] + stroke_sd * support::gaussian(random_)};
    }
    if (!estimator_.advance(readings).status) {
      ++outcome.refused;
      return false;
    }
    for (std::size_t end = 0; end < 2; ++end)
      if (readings.ends[0][end].has_stroke)
        estimator_.take_stroke(0, end, readings.ends[0][end].stroke, taut::Gauge{static_cast<int>(end)});
    ++outcome.rows;
    outcome.elongation_alarms += raised(estimator_.alarms(), taut::Alarm::Kind::elongation) > 0 ? 1 : 0;
    for (int i = 0; i < segments; ++i) {
      const auto found = estimator_.estimate(i);
      const double off = found.force - chain_[i];
      outcome.score.add(off / found.deviation);
      outcome.square += off * off / (full * full);
      outcome.bars += found.deviation * found.deviation / (full * full);
    }
    outcome.mu_sd = estimator_.mu_deviation(0);
    return true;
  }

  InTurn site_;
  support::Random random_;
  Model model_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  std::vector<taut::LoadCell<double>> gauges_;
  Estimator estimator_;
  Chain chain_{mu};
  double EA_ = 0, friction_ = 0;
  std::array<double, 2> gain_{}, mark_{}, out_{};  // of cells, of strokes; what each jack has come out by [m]
};

/// Each jack in its turn up to these parts of the load.
Outcome jack_in_turn(const InTurn& site, std::uint64_t seeds,
                     const std::vector<double>& parts = {0.33, 0.67, 1.0}) {
  Outcome outcome;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CAPTURE(seed);
    const auto jacking = std::make_unique<Jacking>(site, seed);
    bool goes_on = true;
    for (const double part : parts)
      for (const Side side : {Side::start, Side::end}) {
        goes_on = goes_on && jacking->pull(side, part * full, 50, outcome);
        goes_on = goes_on && jacking->pull(side, part * full, 10, outcome);
      }
  }
  outcome.square = std::sqrt(outcome.square / outcome.score.count);
  outcome.bars = std::sqrt(outcome.bars / outcome.score.count);
  MESSAGE("seeds from 1: ", 100 * outcome.score.share(), " % are held, worst ", outcome.score.worst,
          ", errors ", 100 * outcome.square, " % of the load, bars ", 100 * outcome.bars,
          ", rows with an alarm ", outcome.elongation_alarms, " of ", outcome.rows, ", refused ",
          outcome.refused);
  return outcome;
}

}  // namespace

TEST_CASE("strokes of two jacks that pull in turn make forces better, and no jacking is refused or false") {
  const std::vector<double> at_once = {1.0}, in_stages = {0.33, 0.67, 1.0};
  for (const auto& parts : {at_once, in_stages}) {
    CAPTURE(parts.size());
    InTurn site;
    const Outcome with = jack_in_turn(site, 60, parts);
    site.strokes = Strokes::none;
    const Outcome without = jack_in_turn(site, 60, parts);
    for (const Outcome* outcome : {&with, &without}) {
      CHECK(outcome->refused == 0);
      CHECK(outcome->score.share() > 0.93);
      CHECK(outcome->bars < 1.4 * outcome->square);
    }
    // In later stages a jack that follows has told as much.
    CHECK(with.square < (parts.size() == 1 ? 0.8 : 1.0) * without.square);
    CHECK(with.elongation_alarms == 0);
  }
}

TEST_CASE("so do strokes that are read from the first row on") {
  InTurn site;
  site.has_free_zeros = false;
  const Outcome with = jack_in_turn(site, 60);
  CHECK(with.refused == 0);
  CHECK(with.score.share() > 0.93);
  CHECK(with.elongation_alarms == 0);
}

TEST_CASE("the stroke of one of two jacks that pull teaches nothing, and is no alarm") {
  InTurn site;
  site.strokes = Strokes::of_start;
  const Outcome one = jack_in_turn(site, 20);
  site.strokes = Strokes::none;
  const Outcome none = jack_in_turn(site, 20);
  CHECK(one.elongation_alarms == 0);
  CHECK(one.mu_sd == none.mu_sd);
  CHECK(one.square == doctest::Approx(none.square));
}

TEST_CASE("strokes do not teach friction while the tracker is held back short of the jacks that it follows") {
  InTurn site;
  site.gain_sd = 0;
  site.E_sd = 1e-3;
  Outcome outcome;
  Score mu_errors;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const auto jacking = std::make_unique<Jacking>(site, seed);
    CHECK(jacking->pull_both(full, 0.95, 150, outcome));
    mu_errors.add(jacking->mu_error());
  }
  MESSAGE("seeds from 1: errors of mu ", mu_errors.rms(), " deviations, rms, worst ", mu_errors.worst,
          "; of forces ", 100 * outcome.score.share(), " % are held, rms ", outcome.score.rms());
  CHECK(mu_errors.rms() < 1.5);
  CHECK(outcome.score.share() > 0.93);
}

TEST_CASE("cells that differ by what their gains may do not pull a cable through whose friction is known") {
  InTurn site;
  site.mu_sd = 0.01 * mu;
  site.gain_sd = 0.02;
  const Outcome outcome = jack_in_turn(site, 60);
  CHECK(outcome.refused == 0);
  CHECK(outcome.score.share() > 0.93);
}

TEST_CASE("a jack whose valve is shut tells friction, as a load cell at a far end does") {
  InTurn site;
  site.strokes = Strokes::none;
  site.gain_sd = 0;
  const Outcome outcome = jack_in_turn(site, 60);
  CHECK(outcome.refused == 0);
  CHECK(outcome.score.share() > 0.93);
  CHECK(outcome.square < 0.013);
}

TEST_CASE(
    "a pump that begins later than the other one tells nothing of friction, at any rate and out of habit") {
  InTurn site;
  site.strokes = Strokes::none;
  site.gain_sd = 0;
  for (const bool is_habit : {false, true}) {
    CAPTURE(is_habit);
    Outcome outcome;
    Score mu_errors;
    support::Random random(7);
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      CAPTURE(seed);
      const auto jacking = std::make_unique<Jacking>(site, seed);
      const double always = random.between(0.05, 0.3);
      for (const double part : {0.33, 0.67, 1.0}) {
        // In each stage as late, in load, as in the one before, and about as fast; or anything else.
        const double begins = is_habit ? always : random.between(0.05, 0.6),
                     rate = is_habit ? random.between(0.95, 1.05) : random.between(0.3, 1.5);
        CHECK(jacking->pull_apart(Side::end, part * full, begins, rate, 100, outcome));
        CHECK(jacking->pull(Side::start, part * full, 30, outcome));
      }
      mu_errors.add(jacking->mu_error());
    }
    MESSAGE("seeds from 1: errors of mu ", mu_errors.rms(), " deviations, rms, worst ", mu_errors.worst,
            "; of forces ", 100 * outcome.score.share(), " % are held");
    CHECK(mu_errors.rms() < 1);
    CHECK(mu_errors.worst < 4);
    CHECK(outcome.score.share() > 0.93);
  }
}

TEST_CASE("of two jacks that pull a stroke waits for the other one in its row, and for none that is locked") {
  taut::RowStrokes<double, 2> strokes;
  const taut::StrokeReading<double> read = {0.1, 0, taut::Gauge{0}, true},
                                    other = {0.2, 0, taut::Gauge{1}, true};
  CHECK(strokes.take(1, 0, read, {true, false}).size() == 1);
  CHECK(strokes.take(1, 0, read, {true, true}).empty());
  // That of another cable, and one that was read in another way, is not the other one.
  CHECK(strokes.take(0, 1, other, {true, true}).empty());
  CHECK(strokes.take(1, 1, {0.2, 1e-3, {}, false}, {true, true}).empty());
  CHECK(strokes.take(1, 0, read, {true, true}).empty());
  const auto both = strokes.take(1, 1, other, {true, true});
  REQUIRE(both.size() == 2);
  CHECK(both[0].reading + both[1].reading == doctest::Approx(0.3));
  // They count once, and in one row.
  CHECK(strokes.take(1, 1, other, {true, true}).empty());
  strokes.begin_row();
  CHECK(strokes.take(1, 0, read, {true, true}).empty());
}

}  // namespace jacks_in_turn_test
