// Jacks that turn, are locked or leave in the same row: friction remembers the load of each of them, and what
// it keeps is as uncertain as that was.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/followers.hpp"
#include "estimation/pumped.hpp"
#include "estimation/saddle_rows.hpp"

namespace turns_at_once_test {
using namespace estimation;

namespace {

/// Tries all forces at the end of `jacking`, many times: at least this share lies in the 95 % intervals.
template <class Jacking>
void check_bars(const Plane& scene, const Jacking& jacking, double least = 0.93, double most_rms = 1.1) {
  Score score;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto pumped = std::make_unique<Pumped>(scene, seed);
    jacking(*pumped);
    pumped->add_to(score);
  }
  MESSAGE("seeds 1 to 200: ", 100 * score.share(), " % are held, rms ", score.rms());
  CHECK(score.share() > least);
  CHECK(score.rms() < most_rms);
}

void hold_and_lock(Pumped& pumped) {
  pumped.go(1, 60);
  pumped.go(1, 30);
  pumped.go(1, 3, true);
}
/// Without a rest at the top of the ramp.
void turn_at_once(Pumped& pumped) {
  pumped.go(1, 60);
  pumped.go(0.9, 10);
  pumped.go(0.9, 5);
}
/// After a short rest.
void turn_soon(Pumped& pumped) {
  pumped.go(1, 50);
  pumped.go(1, 3);
  pumped.go(0.9, 20);
}
/// By no more than 0.8 deviations of the noise a row.
void turn_slowly(Pumped& pumped) {
  pumped.go(1, 100);
  pumped.go(0.9, 40);
}
void turn_back(Pumped& pumped) {
  pumped.go(1, 60);
  pumped.go(1, 10);
  pumped.go(0.9, 10);
  pumped.go(0.9, 30);
}

/// Two cables on the same struts, jacked at the same end or at both.
void two_below_truss(Plane& scene, bool from_both_ends) {
  const auto cable = known_cable(support::jacked_end);
  support::truss_string(scene, cable, 6);
  std::vector<int> path;
  for (int i = 0; i < scene.cables[0].nodes; ++i) path.push_back(scene.path[i]);
  if (from_both_ends) std::reverse(path.begin(), path.end());
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
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
    saddle_rows(scene, known_cable(support::jacked_end), count);
    check_bars(scene, hold_and_lock);
    check_bars(scene, turn_back);
  }
}

TEST_CASE("of two jacks of a cable that are locked in the same row each leaves the error of its load") {
  static Plane scene;
  saddle_rows(scene, known_cable(support::two_jacks), 1);
  check_bars(scene, hold_and_lock);
  check_bars(scene, turn_back);
}

TEST_CASE("jacks whose turn is confirmed later have been as far when the first one turned") {
  for (const bool from_both_ends : {false, true}) {
    CAPTURE(from_both_ends);
    static Plane scene;
    two_below_truss(scene, from_both_ends);
    check_bars(scene, turn_at_once);
    check_bars(scene, from_both_ends ? turn_back : turn_soon);
  }
}

TEST_CASE("of jacks that turn so slowly that noise hides it for ten rows four bars in five hold") {
  for (const bool from_both_ends : {false, true}) {
    CAPTURE(from_both_ends);
    static Plane scene;
    two_below_truss(scene, from_both_ends);
    check_bars(scene, turn_slowly, 0.8, 2);
  }
}

TEST_CASE("what friction holds of a load that a ram had is as uncertain as the load was when it turned") {
  static Plane scene;
  auto cable = known_cable(support::jacked_end);
  cable.cell[1].up = 1.03;
  cable.cell[1].down = 0.96;
  // An unknown that the load depends on in another way on each branch.
  cable.cell[1].gain_sd = 1e-6;
  saddle_rows(scene, cable, 1);
  for (const int rests : {1, 30}) {
    CAPTURE(rests);
    check_bars(scene, [&](Pumped& pumped) {
      pumped.go(1, 60);
      // Between the branches all rests, and then the load leaves the place where it turned.
      pumped.go(0.95, 5);
      pumped.go(0.95, rests);
      pumped.go(0.88, 10);
      pumped.go(0.88, 20);
    });
  }
}

}  // namespace turns_at_once_test
