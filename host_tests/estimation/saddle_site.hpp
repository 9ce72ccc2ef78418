// A cable over rigid saddles whose truth is no tracker's: what each joint leaves is clamped, in closed form.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/ramp.hpp"
#include "estimation/score.hpp"

namespace estimation {

/// Jacked at its end, with a load cell there and perhaps one at the other end.
struct SaddleSite {
  using Model = taut::Condensed<double, PlaneCapacity>;
  static constexpr double nominal_mu = 0.2, turn = 0.3;

  int joints = 4;
  double mu_sd = 0.06;  ///< of mu beforehand
  double scatter = 0;   ///< of mu from joint to joint, relative
  double noise = 0.003 * full;
  double gain_sd = 0;  ///< of both cells
  bool has_far = true;

  Model model;
  taut::FrictionPrior<double, PlaneCapacity> prior;
  std::vector<double> mu;     ///< in truth
  std::vector<double> force;  ///< in truth [N]

  /// A true mu, and what is known of it.
  void begin(Random& random) {
    taut::Cable<double> cable = support::steel_cable(nominal_mu);
    cable.mu_sd = mu_sd;
    cable.shared_mu = true;
    cable.scatter = scatter;
    cable.cell[1].sd = noise;
    cable.cell[0].sd = has_far ? noise : 0;
    for (auto& cell : cable.cell) cell.gain_sd = gain_sd;
    Plane scene;
    std::vector<support::PlanePoint> points{{0, 0}};
    for (int i = 0; i <= joints; ++i) {
      const double angle = turn * (i - 0.5 * joints);
      points.push_back({points.back()[0] + 3 * std::cos(angle), points.back()[1] + 3 * std::sin(angle)});
    }
    support::rigid_saddles(scene, cable, points);
    REQUIRE(support::condense(scene, model).ok());
    taut::find_friction_prior(scene, prior);
    const double common = nominal_mu + mu_sd * gaussian(random);
    mu.clear();
    for (int j = 0; j < joints; ++j) mu.push_back(std::max(0.0, common * (1 + scatter * gaussian(random))));
    force.assign(static_cast<std::size_t>(joints) + 1, 0);
  }
  double mean_mu() const {
    double sum = 0;
    for (const double each : mu) sum += each;
    return sum / joints;
  }
  /// The jack pulls so much [N]: from it on every joint lets go what is more, or less, than it holds.
  void pull(double load) {
    force.back() = load;
    for (int j = joints; j-- > 0;) {
      const auto i = static_cast<std::size_t>(j);
      const double c = mu[i] * std::tan(turn / 2), held = (1 - c) / (1 + c);
      force[i] = std::clamp(force[i], held * force[i + 1], force[i + 1] / held);
    }
  }
  template <class EstimatorType>
  void add_to(Score& score, const EstimatorType& estimator) const {
    for (std::size_t i = 0; i < force.size(); ++i) {
      const auto found = estimator.estimate(static_cast<int>(i));
      score.add((found.force - force[i]) / found.deviation);
    }
  }
};

/// How many alarms blame a far end.
template <class Alarms>
int of_far_end(const Alarms& alarms) {
  int count = 0;
  for (const auto kind : {taut::Alarm::Kind::sensor, taut::Alarm::Kind::misfit, taut::Alarm::Kind::frozen})
    count += raised(alarms, kind);
  return count;
}

/// The site with an estimator beside it that is handed readings.
class ReadSite {
 public:
  using Estimator = taut::Estimator<SaddleSite::Model, most_unknowns>;

  ReadSite(const SaddleSite& given, std::uint64_t seed) : site(given), random_(seed) {
    site.begin(random_);
    REQUIRE(estimator_.start(site.model, site.prior).status.ok());
    for (double& gain : gain_)
      if (site.gain_sd > 0) gain = 1 + site.gain_sd * gaussian(random_);
  }
  ReadSite(const ReadSite&) = delete;
  ReadSite& operator=(const ReadSite&) = delete;
  ~ReadSite() = default;

  /// A row `dt` [s] after the one before.
  void row(double load, bool reads_jack = true, bool reads_far = true, double dt = 1) {
    site.pull(load);
    taut::Readings<double, PlaneCapacity> readings;
    readings.dt = dt;
    const double jack = gain_[1] * load + site.noise * gaussian(random_),
                 far = gain_[0] * site.force.front() + site.noise * gaussian(random_);
    if (reads_jack) readings.ends[0][1] = {true, false, jack, 0};
    if (reads_far && site.has_far) readings.ends[0][0] = {true, false, far, 0};
    REQUIRE(estimator_.advance(readings).status.ok());
    alarms += of_far_end(estimator_.alarms());
  }
  const Estimator& estimator() const { return estimator_; }
  /// By how many of its standard deviations mu is off.
  double mu_off() const { return (estimator_.mu(0) - site.mean_mu()) / estimator_.mu_deviation(0); }

  SaddleSite site;
  int alarms = 0;  ///< of the far end

 private:
  Random random_;
  std::array<double, 2> gain_{1, 1};
  Estimator estimator_;
};

}  // namespace estimation
