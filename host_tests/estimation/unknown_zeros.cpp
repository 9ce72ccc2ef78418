// Zeros of several cells that nobody knows, and friction that is not known either: what their readings tell
// of a zero, against least squares by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/jacked_chain.hpp"
#include "taut/estimation/drawn_lines.hpp"

namespace unknown_zeros_test {
using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Estimator = CellEstimator;

constexpr double zero_sd = 0.01 * full;

struct Cells {
  bool far_end = true;
  std::vector<int> segments;
  double noise = zero_sd / 50;
};

class Jacking {
 public:
  Jacking(const Cells& cells, std::uint64_t seed) : cells_(cells), random_(seed) {
    auto cable = support::steel_cable(mu, support::jacked_end);
    cable.law = taut::FrictionLaw::capstan;
    cable.mu_sd = likely;
    cable.shared_mu = true;
    taut::LoadCell<double> cell;
    cell.sd = cells.noise;
    cell.zero_sd = zero_sd;
    cable.cell[1] = cell;
    if (cells.far_end) cable.cell[0] = cell;
    const auto scene = std::make_unique<Plane>();
    support::rigid_saddles(*scene, cable, support::chain_points(segments));
    taut::find_friction_prior(*scene, prior_);
    REQUIRE(support::condense(*scene, model_).ok());
    REQUIRE(
        estimator_.start(model_, prior_, {}, std::vector<taut::LoadCell<double>>(cells.segments.size(), cell))
            .status.ok());
    friction_ = std::max(0.02, mu + likely * support::gaussian(random_));
    chain_ = Chain(friction_);
    for (double* zero : {&zero_of_jack_, &zero_of_far_end_}) *zero = zero_sd * support::gaussian(random_);
    for (std::size_t i = 0; i < cells.segments.size(); ++i)
      zeros_.push_back(zero_sd * support::gaussian(random_));
  }
  void ramp(double from, double to, int rows) {
    for (int i = 1; i <= rows; ++i) {
      chain_.pull(from + (to - from) * i / rows);
      taut::Readings<double, PlaneCapacity> readings;
      readings.dt = 1;
      readings.ends[0][1].has_force = true;
      readings.ends[0][1].force = read(segments - 1, zero_of_jack_);
      readings.ends[0][0].has_force = cells_.far_end;
      readings.ends[0][0].force = read(0, zero_of_far_end_);
      REQUIRE(estimator_.advance(readings).status.ok());
      for (std::size_t g = 0; g < zeros_.size(); ++g)
        estimator_.take_segment(cells_.segments[g], read(cells_.segments[g], zeros_[g]),
                                taut::Gauge{static_cast<int>(g)});
    }
  }
  void add_to(Score& score) const {
    for (int i = 0; i < segments; ++i) {
      const auto found = estimator_.estimate(i);
      score.add((found.force - chain_[i]) / found.deviation);
    }
  }
  double friction() const { return friction_; }
  double deviation() const { return estimator_.estimate(segments - 1).deviation; }
  /// What the force at the jack is known to once all lines are known exactly: each of them says
  /// z_i - r_i z = something, with r_i what `friction` leaves of the jack's load. Least squares with the
  /// priors.
  double deviation_by_hand(double friction) const {
    double precision = 1;
    const auto add = [&](int segment) {
      double turn = 0;
      for (int j = segment; j < segments - 1; ++j)
        turn += support::chain_turn.at(static_cast<std::size_t>(j));
      precision += std::exp(-2 * friction * turn);
    };
    if (cells_.far_end) add(0);
    for (const int segment : cells_.segments) add(segment);
    return zero_sd / std::sqrt(precision);
  }

 private:
  double read(int segment, double zero) {
    return chain_[segment] + zero + cells_.noise * support::gaussian(random_);
  }

  Cells cells_;
  support::Random random_;
  Model model_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  Estimator estimator_;
  Chain chain_{mu};
  double friction_ = 0, zero_of_jack_ = 0, zero_of_far_end_ = 0;
  std::vector<double> zeros_;
};

}  // namespace

TEST_CASE("zeros of several cells are not told apart by a ramp whose friction is found as it goes") {
  for (const double noise : {zero_sd / 50, zero_sd / 1e5})
    for (const std::vector<int>& gauges : {std::vector<int>{}, {3}, {2, 5}, {1, 4, 6}}) {
      const Cells cells{gauges.size() % 2 == 0, gauges, noise};
      CAPTURE(noise);
      CAPTURE(gauges.size());
      Score score;
      double below = 0, above = 0;
      for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const auto jacking = std::make_unique<Jacking>(cells, seed);
        jacking->ramp(0, full, 100);
        jacking->add_to(score);
        // A line is weighed with the friction at which its first reading was taken.
        const double by_prior = jacking->deviation_by_hand(mu),
                     by_truth = jacking->deviation_by_hand(jacking->friction());
        below = std::max(below, std::min(by_prior, by_truth) / jacking->deviation());
        above = std::max(above, jacking->deviation() / std::max(by_prior, by_truth));
      }
      MESSAGE("seeds from 1: ", 100 * score.share(), " % are held, rms ", score.rms(), "; deviations are ",
              1 / below, " to ", above, " times those by hand");
      CHECK(score.share() > 0.93);
      CHECK(score.rms() < 1.1);
      CHECK(score.rms() > 0.9);
      CHECK(below < 1.01);
      CHECK(above < 1.01);
    }
}

TEST_CASE("a line stays while the same joints slide, and begins anew with another zero or other joints") {
  taut::DrawnLines<double, 2, 2> lines;
  lines.clear();
  std::vector<double> by;
  const auto keep = [&](int i, std::uint32_t slides, double first, double second) {
    by.clear();
    lines.keep(
        i, slides, 2, [&](int k) { return k == 0 ? first : second; },
        [&](int k, double change) { by.push_back(10 * k + change); });
  };
  keep(0, 7, -0.5, -0.25);
  CHECK(by.empty());
  keep(1, 7, -0.75, 0);
  CHECK(by.empty());
  keep(0, 7, -0.625, -0.5);
  CHECK(by == std::vector<double>{0.125, 10.25});
  keep(0, 7, -0.625, -0.5);
  CHECK(by.empty());
  const auto saved = lines.save();
  keep(0, 8, -0.5, -0.5);
  CHECK(by.empty());
  keep(0, 8, -0.25, -0.5);
  CHECK(by == std::vector<double>{-0.25});
  lines.restore(saved);
  keep(0, 7, -0.5, -0.5);
  CHECK(by == std::vector<double>{-0.125});
  lines.forget(0);
  keep(0, 7, -0.25, -0.5);
  CHECK(by.empty());
}

}  // namespace unknown_zeros_test
