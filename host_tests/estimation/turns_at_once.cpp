// Jacks that turn, are locked or leave in the same row: friction remembers the load of each of them, and what
// it keeps is as uncertain as that was.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "estimation/followers.hpp"
#include "estimation/ramp.hpp"

using namespace estimation;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
constexpr double noise = 0.003 * full;

/// Cables that feel nothing of each other: a row above another.
void add_cables(Plane& scene, const taut::Cable<double>& cable, int count) {
  const auto points = support::chain_points(5);
  support::rigid_saddles(scene, cable, points);
  for (int c = 1; c < count; ++c) {
    std::vector<int> path;
    for (const auto& point : points)
      path.push_back(scene.add_node({point[0], point[1] + 20 * c}, taut::held_xy));
    scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
  }
}

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

  /// The pressure goes to this part of the full one; forces follow where rams let them.
  void go(double to, int rows, bool locks = false) {
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
    }
  }
  template <class Add>
  void add_to(const Add& add) const {
    for (int i = 0; i < model_.segments; ++i) {
      const auto found = estimator_.estimate(i);
      add((found.force - truth_.tension(i)) / found.deviation);
    }
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

/// Of errors in their standard deviations.
struct Score {
  long held = 0, all = 0;
  double square = 0;
  void add(double z) {
    held += std::fabs(z) <= 1.96 ? 1 : 0;
    ++all;
    square += std::min(z * z, 1e4);
  }
  double share() const { return static_cast<double>(held) / static_cast<double>(all); }
  double rms() const { return std::sqrt(square / static_cast<double>(all)); }
};

/// Of all forces at the end of `jacking`, many times.
template <class Jacking>
Score score_of(const Plane& scene, const Jacking& jacking) {
  Score score;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto pumped = std::make_unique<Pumped>(scene, seed);
    jacking(*pumped);
    pumped->add_to([&](double z) { score.add(z); });
  }
  MESSAGE("seeds 1 to 200: ", 100 * score.share(), " % are held, rms ", score.rms());
  return score;
}

taut::Cable<double> known_cable(const std::array<taut::End, 2>& ends) {
  taut::Cable<double> cable = support::steel_cable(0.2, ends);
  cable.mu_sd = 1e-6;
  cable.shared_mu = true;
  cable.seating = 0.003;
  for (auto& cell : cable.cell) cell.sd = noise;
  return cable;
}

constexpr std::array<taut::End, 2> one_jack = support::jacked_end;

void hold_and_lock(Pumped& pumped) {
  pumped.go(1, 60);
  pumped.go(1, 30);
  pumped.go(1, 3, true);
}
void turn_back(Pumped& pumped) {
  pumped.go(1, 60);
  pumped.go(1, 10);
  pumped.go(0.9, 10);
  pumped.go(0.9, 30);
}

}  // namespace

TEST_CASE(
    "derivatives by the loads at which two jacks turn or are locked at once are those of two trackers") {
  for (const bool locks : {false, true})
    for (const bool elastic : {false, true})
      for (std::size_t off = 0; off < 2; ++off) {
        CAPTURE(locks);
        CAPTURE(elastic);
        CAPTURE(off);
        static Plane scene;
        static Model model;
        static taut::FrictionPrior<double, PlaneCapacity> known;
        scene = {};
        auto cable = support::steel_cable(0.2, support::two_jacks);
        cable.seating = 0.003;
        if (elastic)
          support::truss_string(scene, cable, 6);
        else
          support::rigid_saddles(scene, cable, support::chain_points(7));
        REQUIRE(support::condense(scene, model).ok());
        taut::find_friction_prior(scene, known);
        const auto trackers = three_followers(model, known);
        auto& [less, at, more] = *trackers;
        constexpr double h = 1e-2;
        taut::Sample<double, PlaneCapacity> row;
        const auto go = [&](const std::array<double, 2>& to, double by, bool locked) {
          for (int way = -1; way <= 1; ++way) {
            for (std::size_t end = 0; end < 2; ++end)
              row.jack[0][end] = {to[end] * full + (end == off ? way * by : 0), locked};
            REQUIRE((*trackers)[static_cast<std::size_t>(way + 1)].advance(row).is_complete());
          }
        };
        go({0.6, 0.63}, 0, false);
        go({0.97, 1}, h, false);
        at.turn([](int k) { return 2 + k; });
        go(locks ? std::array<double, 2>{0.97, 1} : std::array<double, 2>{0.95, 0.98}, locks ? h : 0, locks);
        double largest = 0;
        for (int i = 0; i < model.segments; ++i) {
          const double difference = (more.tension(i) - less.tension(i)) / (2 * h),
                       found = at.sensitivity(2 + static_cast<int>(off), i);
          CHECK(std::fabs(found - difference) < 1e-5);
          largest = std::max(largest, std::fabs(difference));
        }
        // Else nothing was tested.
        CHECK(largest > 0.2);
      }
}

TEST_CASE("of cables that are locked in the same row each has the error of its own load") {
  for (const int count : {1, 2}) {
    CAPTURE(count);
    static Plane scene;
    scene = {};
    add_cables(scene, known_cable(one_jack), count);
    const Score locked = score_of(scene, hold_and_lock), turned = score_of(scene, turn_back);
    CHECK(locked.share() > 0.93);
    CHECK(locked.rms() < 1.1);
    CHECK(turned.share() > 0.93);
    CHECK(turned.rms() < 1.1);
  }
}

TEST_CASE("of two jacks of a cable that are locked in the same row each leaves the error of its load") {
  static Plane scene;
  add_cables(scene, known_cable(support::two_jacks), 1);
  const Score locked = score_of(scene, hold_and_lock), turned = score_of(scene, turn_back);
  CHECK(locked.share() > 0.93);
  CHECK(locked.rms() < 1.1);
  CHECK(turned.share() > 0.93);
  CHECK(turned.rms() < 1.1);
}

TEST_CASE("what friction holds of a load that a ram had is as uncertain as the load was when it turned") {
  static Plane scene;
  auto cable = known_cable(one_jack);
  cable.cell[1].up = 1.03;
  cable.cell[1].down = 0.96;
  // An unknown that the load depends on in another way on each branch.
  cable.cell[1].gain_sd = 1e-6;
  add_cables(scene, cable, 1);
  for (const int rests : {1, 30}) {
    CAPTURE(rests);
    const Score score = score_of(scene, [&](Pumped& pumped) {
      pumped.go(1, 60);
      // Between the branches all rests, and then the load leaves the place where it turned.
      pumped.go(0.95, 5);
      pumped.go(0.95, rests);
      pumped.go(0.88, 10);
      pumped.go(0.88, 20);
    });
    CHECK(score.share() > 0.93);
    CHECK(score.rms() < 1.1);
  }
}
