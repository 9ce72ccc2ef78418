// Jacks by one pump with noisy load cells, of cables whose friction is known: what is not known is the load.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "estimation/followers.hpp"
#include "estimation/ramp.hpp"
#include "estimation/score.hpp"

namespace estimation {

using Model = taut::Condensed<double, PlaneCapacity>;
constexpr double noise = 0.003 * full;

/// Jacks by one pump, with load cells that are noisy and friction that is known: in truth, and estimated.
class Pumped {
 public:
  Pumped(const Plane& scene, std::uint64_t seed) : random_(seed) {
    taut::find_friction_prior(scene, prior_);
    REQUIRE(support::condense(scene, model_).ok());
    REQUIRE(truth_.start(model_).status.ok());
    REQUIRE(estimator_.start(model_, prior_).status.ok());
    taut::for_each_jacked_end(model_.cables, [&](int c, std::size_t end) {
      jacks_.emplace_back(c, end);
      cells_.push_back(scene.cables[c].cell[end]);
      force_.push_back(0);
    });
  }
  Pumped(const Pumped&) = delete;
  Pumped& operator=(const Pumped&) = delete;
  ~Pumped() = default;

  /// The pressure goes to this part of the full one; forces follow where rams let them. Calls after_row().
  template <class AfterRow>
  void go(double to, int rows, bool locks, const AfterRow& after_row) {
    const double from = pressure_;
    for (int i = 1; i <= rows; ++i) {
      pressure_ = from + (to - from) * i / rows;
      taut::Sample<double, PlaneCapacity> sample;
      taut::Readings<double, PlaneCapacity> readings;
      for (std::size_t k = 0; k < jacks_.size(); ++k) {
        const auto [c, end] = jacks_[k];
        const auto& cell = cells_[k];
        force_[k] = std::clamp(force_[k], full * pressure_ / cell.up, full * pressure_ / cell.down);
        sample.jack[c][end] = {force_[k], locks};
        readings.sample.jack[c][end].locked = locks;
        readings.ends[c][end] = {!locks, false, full * pressure_ + noise * gaussian(random_), 0};
      }
      REQUIRE(truth_.advance(sample).status.ok());
      REQUIRE(estimator_.advance(readings).status.ok());
      after_row();
    }
  }
  void go(double to, int rows, bool locks = false) {
    go(to, rows, locks, [] {});
  }
  int segments() const { return model_.segments; }
  /// By how many of its standard deviations a force is off.
  double off(int segment) const {
    const auto found = estimator_.estimate(segment);
    return (found.force - truth_.tension(segment)) / found.deviation;
  }
  /// The largest of those beside the jacks.
  double off_at_jacks() const {
    double most = 0;
    for (const auto& [c, end] : jacks_)
      most = std::max(most, std::fabs(off(model_.cables[c].end_segment(end))));
    return most;
  }
  void add_to(Score& score) const {
    for (int i = 0; i < model_.segments; ++i) score.add(off(i));
  }

 private:
  Random random_;
  Model model_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  taut::Tracker<Model> truth_;
  taut::Estimator<Model, most_unknowns> estimator_;
  std::vector<std::pair<int, std::size_t>> jacks_;
  std::vector<taut::LoadCell<double>> cells_;
  std::vector<double> force_;
  double pressure_ = 0;
};

inline taut::Cable<double> known_cable(const std::array<taut::End, 2>& ends) {
  taut::Cable<double> cable = support::steel_cable(0.2, ends);
  cable.mu_sd = 1e-6;
  cable.shared_mu = true;
  cable.seating = 0.003;
  for (auto& cell : cable.cell) cell.sd = noise;
  return cable;
}

}  // namespace estimation
