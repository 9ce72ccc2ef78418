// A site that is simulated: a tendon with friction that nobody knows, and load cells that lie. The truth
// comes from load steps (taut::Stepwise), which share no code with what follows the readings.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <utility>

#include "taut/scene/scene.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace monitor::host {

struct TendonCapacity : taut::Capacity {
  static constexpr int nodes = 6, segments = 5, joints = 4, jacks = 1;
};
using TendonScene = taut::Scene<double, 2, TendonCapacity>;

inline constexpr double full_force = 3.85e6;  // N, what the tendon is jacked to
inline constexpr double noise = 0.002 * full_force;

/// What the device is told: the tendon of data/rigid_saddles.json, with ordinary load cells at both ends.
constexpr TendonScene make_tendon() {
  TendonScene scene;
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 2.85e-3;
  cable.law = taut::FrictionLaw::capstan;
  cable.mu = 0.12;
  cable.mu_sd = 0.03;
  cable.shared_mu = true;
  cable.scatter = 0.1;
  cable.seating = 0.006;
  cable.seating_sd = 0.0015;
  for (auto& cell : cable.cell) {
    cell.sd = noise;
    cell.gain_sd = 0.005;
    cell.zero_sd = 0.001 * full_force;
  }
  cable.ends[1] = taut::End::jacked;
  const int anchor = scene.add_node({0, 1.9}, taut::held_xy);
  const int pier_1 = scene.add_node({12, 2.6}, taut::held_xy);
  const int deviator_1 = scene.add_node({30, 0.5}, taut::held_xy);
  const int deviator_2 = scene.add_node({52, 0.5}, taut::held_xy);
  const int pier_2 = scene.add_node({72, 2.6}, taut::held_xy);
  const int jack = scene.add_node({84, 1.9}, taut::held_xy);
  scene.add_cable(cable, {anchor, pier_1, deviator_1, deviator_2, pier_2, jack});
  return scene;
}
inline constexpr TendonScene tendon = make_tendon();

/// A load cell that is off in its own way: what it shows is (1 + gain) F + zero, and noise.
struct LyingCell {
  double gain = 0, zero = 0;
};

/// What it is like in reality.
struct Reality {
  std::array<double, TendonCapacity::joints> mu;
  double seating;  ///< draw-in of the wedge [m]
  LyingCell jack, far_end;
};
inline constexpr Reality shown_reality = {
    {0.171, 0.148, 0.166, 0.155}, 0.0072, {0.006, -0.0005 * full_force}, {-0.004, 0.001 * full_force}};

/// Random numbers that are the same in every library.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  /// Nearly normal, of mean 0 and deviation 1: the sum of twelve numbers between 0 and 1.
  double normal() {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_()) / 4294967296.0;
    return sum - 6;
  }

 private:
  std::mt19937 random_;
};

/// Another reality, as likely as what the device is told makes it.
inline Reality draw_reality(Chance& chance) {
  const auto& told = tendon.cables[0];
  Reality drawn;
  const double common = std::max(told.mu + told.mu_sd * chance.normal(), 0.02);
  for (double& mu : drawn.mu) mu = std::max(common * (1 + told.scatter * chance.normal()), 0.01);
  drawn.seating = std::max(told.seating + told.seating_sd * chance.normal(), 0.0);
  for (auto [cell, said] : {std::pair{&drawn.far_end, told.cell[0]}, std::pair{&drawn.jack, told.cell[1]}})
    *cell = {said.gain_sd * chance.normal(), said.zero_sd * chance.normal()};
  return drawn;
}

/// What jack and crew do in a row of the log, a row a second.
struct Deed {
  const char* words;
  double force;  ///< of the jack at the end [N]
  int rows;
  bool locked = false;
};
inline constexpr std::array<Deed, 8> deeds = {{{"pulled to 50 %", 0.5 * full_force, 60},
                                               {"held", 0.5 * full_force, 20},
                                               {"pulled to 104 %", 1.04 * full_force, 60},
                                               {"held", 1.04 * full_force, 20},
                                               {"let out to 97 %", 0.97 * full_force, 15},
                                               {"held", 0.97 * full_force, 20},
                                               {"locked off", 0.97 * full_force, 1, true},
                                               {"jack taken off", 0, 20, true}}};

/// What both load cells read at one instant [N], and the true forces.
struct SiteRow {
  double jack = 0, far_end = 0;
  bool locked = false;
  taut::FixedArray<double, TendonCapacity::segments> force;
};

/// One tendon, jacked once.
class Site {
 public:
  Site(const Reality& reality, const Chance& chance) : reality_(reality), chance_(chance) {
    for (int j = 0; j < TendonCapacity::joints; ++j) scene_.mu[j] = reality.mu[static_cast<std::size_t>(j)];
    scene_.cables[0].seating = reality.seating;
  }
  taut::Status start() { return truth_.start(scene_); }
  /// Moves the jack there, and reads.
  taut::Status go_to(double force, bool locked, SiteRow& row) {
    taut::Sample<double, TendonCapacity> sample;
    sample.jack[0][1] = {force, locked};
    const taut::Status status = truth_.advance(sample, 16);
    row.force = truth_.response().tension;
    row.locked = locked;
    row.jack = read(reality_.jack, force);
    row.far_end = read(reality_.far_end, row.force[0]);
    return status;
  }

 private:
  double read(const LyingCell& cell, double force) {
    return (1 + cell.gain) * force + cell.zero + noise * chance_.normal();
  }

  Reality reality_;
  Chance chance_;
  TendonScene scene_ = tendon;
  taut::Stepwise<double, TendonScene> truth_;
};

}  // namespace monitor::host
