// The planner of the core: against brute force, against the planner of the host, and on a site.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "lib/plan/find_plan.hpp"
#include "lib/plan/objective.hpp"
#include "plan/brute_force.hpp"
#include "plan/core_jack.hpp"
#include "plan/random_scene.hpp"
#include "taut/planning/turn_search.hpp"

using namespace taut::host;
using plan_test::CoreJack;
using plan_test::CoreMoves;
using plan_test::CoreQuestion;
using plan_test::Random;
using plan_test::SceneKind;
using plan_test::Site;

namespace {

// A jacking that went wrong: the first move of the plan, beyond it by a tenth, with another mu.
struct WentWrong {
  Site site;
  std::vector<PlanJack> jacks;
  PlanPast past;
  std::unique_ptr<CoreJack> jack;  // stands there

  WentWrong(Random& random, SceneKind kind, double mu_factor, bool lock = false)
      : site(plan_test::random_site(random, kind, false)) {
    site.goal.lock = lock;
    if (lock) site.scene.cables[0].seating = 0.004;
    const Plan plan = find_plan(site.scene, site.goal);
    jacks = plan.jacks;
    PlanStage rest = plan.stages[0], pulled = plan.stages[0];
    rest.force[0] = 0;
    pulled.force[0] *= 1.1;
    past.moves = {{rest, site.goal.factor}, {pulled, site.goal.factor}};
    past.rest = {plan.shape[0]};
    past.force = {plan.stages[0].force[0]};
    if (lock) past.rest.push_back(plan.shape.back());
    past.moves_left = 2;
    for (double& mu : site.scene.cables[0].mu) mu *= mu_factor;
    jack = plan_test::make_core_jack(site.scene);
    REQUIRE(jack->go(site.goal.factor, 0));
    REQUIRE(jack->go(site.goal.factor, pulled.force[0]));
  }
  // Does what was found, and says how far off the forces are.
  double done(const CoreMoves& moves) {
    for (int m = 0; m < moves.count; ++m)
      REQUIRE(jack->go(site.goal.factor, moves.force[static_cast<std::size_t>(m)]));
    if (site.goal.lock) REQUIRE(jack->go(site.goal.factor, 0, true));
    return off_target(jack->tension(), site.goal.target);
  }
};

SceneKind kind_of(int round) { return round % 2 == 0 ? SceneKind::saddles : SceneKind::truss; }
double factor_of(int round) { return round % 3 == 0 ? 1.3 : 0.7; }

}  // namespace

TEST_CASE("the next moves of the core are as near as brute force with two moves, and do what they say") {
  Random random(41);
  double of_core = 0, of_host = 0;
  for (int round = 0; round < 16; ++round) {
    CAPTURE(round);
    WentWrong site(random, kind_of(round), factor_of(round));
    const CoreMoves found = site.jack->plan(site.site.goal, {});
    REQUIRE(found.status.ok());
    CHECK(found.error <=
          plan_test::best_of_rest(site.site.scene, site.site.goal, site.jacks, site.past.moves, 2) + 1e-9);
    const double host = find_rest_of_plan(site.site.scene, site.site.goal, site.past).outcome.error;
    // 32 turns are looked at where the host has linear programs.
    CHECK(found.error <= host + 5e-4);
    of_core += found.error;
    of_host += host;
    CHECK(site.done(found) == doctest::Approx(found.error).epsilon(1e-7));
    const auto tension = site.jack->tension();
    for (std::size_t i = 0; i < tension.size(); ++i)
      CHECK(tension[i] == doctest::Approx(found.tension[i]).epsilon(1e-7));
  }
  CHECK(of_core <= of_host + 16 * 1e-5);
}

TEST_CASE("from the start the moves are as near as the plan of the host, which is proved between saddles") {
  Random random(43);
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    const Site site = plan_test::random_site(random, kind_of(round), false);
    const auto jack = plan_test::make_core_jack(site.scene);
    REQUIRE(jack->go(site.goal.factor, 0));
    const CoreMoves found = jack->plan(site.goal, {});
    CHECK(found.error <= find_plan(site.scene, site.goal).outcome.error + 5e-4);
  }
}

TEST_CASE("in second-order theory the next moves are as near as brute force, too") {
  Random random(47);
  WentWrong site(random, SceneKind::second_order, 0.7);
  const CoreMoves found = site.jack->plan(site.site.goal, {0, 40000, 40000});
  CHECK(found.error <=
        plan_test::best_of_rest(site.site.scene, site.site.goal, site.jacks, site.past.moves, 2, 16) + 1e-9);
  // Pieces do not quite meet where the geometry steps from level to level.
  CHECK(std::fabs(site.done(found) - found.error) <= 2e-4);
}

TEST_CASE("with a lock-off to come the moves are those whose forces after the seating are near") {
  Random random(53);
  double off = 0;
  for (int round = 0; round < 8; ++round) {
    CAPTURE(round);
    WentWrong site(random, kind_of(round), factor_of(round), true);
    const CoreMoves found = site.jack->plan(site.site.goal, {0, 20000, 20000});
    const double brute =
        plan_test::best_of_rest(site.site.scene, site.site.goal, site.jacks, site.past.moves, 2, 60);
    // Where a release and a pull are followed by the wedge, two turns are looked for at once, in 160 looks.
    CHECK(found.error <= brute + 6e-3);
    off += found.error - brute;
    CHECK(site.done(found) == doctest::Approx(found.error).epsilon(1e-7));
  }
  CHECK(off <= 0);
}

TEST_CASE("limits of jack, segments and stroke hold all the way, and change what is found") {
  Random random(59);
  for (int round = 0; round < 9; ++round) {
    CAPTURE(round);
    const Site site = plan_test::random_site(random, kind_of(round), false);
    const auto stand = [&] {
      auto jack = plan_test::make_core_jack(site.scene);
      REQUIRE(jack->go(site.goal.factor, 0));
      return jack;
    };
    const auto jack = stand();
    const CoreMoves without = jack->plan(site.goal, {});
    REQUIRE(without.count > 0);
    PlanGoal goal = site.goal;
    double most_stroke = 0, most_tension = 0;
    // What the first move has at its end.
    REQUIRE(jack->go(site.goal.factor, without.force[0]));
    most_stroke = jack->stroke();
    for (const double T : jack->tension()) most_tension = std::max(most_tension, T);
    if (round % 3 == 0) goal.most_force[0][1] = 0.98 * without.force[0];
    if (round % 3 == 1) goal.most_segment.assign(goal.most_segment.size(), 0.98 * most_tension);
    if (round % 3 == 2) goal.most_stroke[0][1] = 0.98 * most_stroke;
    const auto again = stand();
    const CoreMoves found = again->plan(goal, {});
    CHECK(found.error >= without.error);
    CHECK(found.count > 0);
    double at = 0;
    for (int m = 0; m < found.count; ++m) {
      const double to = found.force[static_cast<std::size_t>(m)];
      for (int step = 1; step <= 50; ++step) {
        REQUIRE(again->go(site.goal.factor, at + (to - at) * step / 50));
        CHECK(at + (to - at) * step / 50 <= goal.most_force[0][1]);
        CHECK(again->stroke() <= goal.most_stroke[0][1]);
        for (const double T : again->tension()) CHECK(T <= goal.most_segment[0]);
      }
      at = to;
    }
  }
}

TEST_CASE("there are no more events than were allowed, and what was found until then is good") {
  Random random(61);
  WentWrong site(random, SceneKind::truss, 0.7);
  double before = 1e9;
  int all = 0;
  for (const int budget : {1, 2, 5, 20, 60, 150, 400, 100000}) {
    CAPTURE(budget);
    WentWrong again = [&] {
      Random same(61);
      return WentWrong(same, SceneKind::truss, 0.7);
    }();
    const CoreMoves found = again.jack->plan(again.site.goal, {0, budget, 100000});
    CHECK(found.events <= budget);
    CHECK(found.error <= before);
    CHECK(again.done(found) == doctest::Approx(found.error).epsilon(1e-7));
    before = found.error;
    all = found.events;
  }
  CHECK(all < 100000);
}

TEST_CASE("it makes no difference in how many calls it looks") {
  Random random(67);
  for (int round = 0; round < 4; ++round) {
    CAPTURE(round);
    WentWrong site(random, kind_of(round), factor_of(round), round >= 2);
    const CoreMoves once = site.jack->plan(site.site.goal, {0, 20000, 20000});
    for (const int slice : {1, 3, 17}) {
      const CoreMoves found = site.jack->plan(site.site.goal, {0, 20000, slice});
      CHECK(found.count == once.count);
      CHECK(found.force == once.force);
      CHECK(found.error == once.error);
      CHECK(found.tension == once.tension);
      CHECK(found.events == once.events);
    }
  }
}

TEST_CASE("a move that brings less than it is worth is not asked for") {
  Random random(71);
  int fewer = 0;
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    WentWrong site(random, kind_of(round), factor_of(round));
    const CoreMoves nearest = site.jack->plan(site.site.goal, {});
    for (const double worth : {0.005, 0.02, 1.0}) {
      const CoreMoves found = site.jack->plan(site.site.goal, {worth, 20000, 20000});
      CHECK(found.count <= nearest.count);
      CHECK(found.error <= nearest.error + (nearest.count - found.count) * worth + 1e-5);
      fewer += found.count < nearest.count;
    }
    const CoreMoves none = site.jack->plan(site.site.goal, {1e3, 20000, 20000});
    CHECK(none.count == 0);
    CHECK(none.error == none.error_now);
  }
  CHECK(fewer > 12);
}

TEST_CASE("the turn search finds the least value of random piecewise linear functions") {
  Random random(73);
  int looks = 0, rounds = 300;
  double worst = 0;
  for (int round = 0; round < rounds; ++round) {
    CAPTURE(round);
    // Corners at random places, slopes of at most 3, a third of the pieces flat.
    std::vector<double> at{0}, value{random.between(2, 4)};
    const int pieces = random.whole(1, 7);
    for (int k = 0; k < pieces; ++k) {
      const double width = random.between(0.02, 1);
      const double slope = random.between(0, 1) < 0.33 ? 0 : random.between(-3, 3);
      at.push_back(at.back() + width);
      value.push_back(std::max(0.0, value.back() + slope * width));
    }
    const auto f = [&](double x) {
      std::size_t k = 1;
      while (k + 1 < at.size() && at[k] < x) ++k;
      return value[k - 1] + (value[k] - value[k - 1]) * (x - at[k - 1]) / (at[k] - at[k - 1]);
    };
    taut::TurnSearch<double, 32> search;
    search.begin(0, at.back(), 3, 1e-5);
    double x = 0, found = 1e9;
    int count = 0;
    while (search.next(x)) {
      REQUIRE(x >= 0);
      REQUIRE(x <= at.back());
      found = std::min(found, f(x));
      search.take(x, f(x));
      ++count;
    }
    CHECK(count <= 32);
    looks += count;
    CHECK(search.least() == found);
    const double least = *std::min_element(value.begin(), value.end());
    CHECK(found >= least - 1e-12);
    worst = std::max(worst, found - least);
  }
  // Of values that reach from 0 to 8.
  CHECK(worst <= 0.05);
  CHECK(looks < 25 * rounds);
}
