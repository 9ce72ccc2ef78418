// Plans against closed forms, and the parts that they are made of against other methods.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/kinds/make_model.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/friction_chain.hpp"
#include "lib/plan/linear_program.hpp"
#include "lib/plan/objective.hpp"
#include "lib/plan/plan_log.hpp"
#include "lib/plan/prior.hpp"
#include "plan/brute_force.hpp"
#include "plan/random_scene.hpp"

using namespace taut::host;
using plan_test::Random;

namespace {

// A cable over so many saddles on a polygon: every joint turns by the same angle.
SceneDescription arc(int joints, double mu) {
  SceneDescription scene;
  scene.name = "arc";
  CableDescription cable;
  cable.name = "C";
  cable.E = 2e11;
  cable.A = 1e-3;
  cable.law = taut::FrictionLaw::capstan;
  cable.ends = {taut::End::anchored, taut::End::jacked};
  double x = 0, y = 0, angle = 0;
  constexpr double turn = 0.2;
  for (int i = 0; i <= joints + 1; ++i) {
    scene.nodes.push_back({"n" + std::to_string(i), {x, y, 0}, taut::held_x | taut::held_y});
    cable.path.push_back(i);
    x += 5 * std::cos(angle);
    y += 5 * std::sin(angle);
    angle += turn;
  }
  cable.mu.assign(static_cast<std::size_t>(joints), mu);
  cable.prestrain.assign(static_cast<std::size_t>(joints) + 1, 0);
  cable.force.resize(static_cast<std::size_t>(joints) + 1);
  scene.cables.push_back(cable);
  return scene;
}
constexpr double arc_turn = 0.2, arc_pitch = 5;
double arc_rho(double mu) { return std::exp(-mu * arc_turn); }

PlanGoal goal_for(const SceneDescription& scene, double target, int stages) {
  PlanGoal goal;
  goal.file = "goal";
  goal.factor.assign(scene.loads.size(), 0);
  goal.target.assign(scene.cables[0].segments(), target);
  goal.most_segment.assign(scene.cables[0].segments(), no_limit);
  goal.most_force.assign(1, {no_limit, no_limit});
  goal.most_stroke = goal.most_force;
  goal.stages = stages;
  goal.has_stages = true;
  return goal;
}

}  // namespace

TEST_CASE("the nearest place on a line is that of a fine scan") {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> from, to, target;
    for (int i = 0; i < 6; ++i) {
      from.push_back(random.between(0, 3));
      to.push_back(random.between(0, 3));
      target.push_back(random.between(0, 1) < 0.2 ? 0 : random.between(1, 2));
    }
    target[0] = 1;
    const NearestPart found = nearest_part(from, to, target);
    double best = 1e300;
    for (int k = 0; k <= 20000; ++k) {
      std::vector<double> at;
      for (std::size_t i = 0; i < from.size(); ++i) at.push_back(from[i] + k / 20000.0 * (to[i] - from[i]));
      best = std::min(best, off_target(at, target));
    }
    CAPTURE(round);
    CHECK(found.error <= best + 1e-12);
    // The scan is coarse: no slope is above 3.
    CHECK(found.error >= best - 3.0 / 20000);
  }
}

TEST_CASE("a linear program in two unknowns has its solution at the best vertex") {
  Random random(12);
  for (int round = 0; round < 300; ++round) {
    LinearProgram program;
    program.cost = {random.between(-1, 1), random.between(-1, 1)};
    program.add({1, 0}, 3);
    program.add({0, 1}, 3);
    for (int k = 0; k < 5; ++k)
      program.add({random.between(-1, 1), random.between(-1, 1)}, random.between(-0.3, 1));
    // Every pair of lines, the axes too.
    std::vector<std::array<double, 3>> lines = {{1, 0, 0}, {0, 1, 0}};
    for (std::size_t r = 0; r < program.rows.size(); ++r)
      lines.push_back({program.rows[r][0], program.rows[r][1], program.bound[r]});
    double best = 1e300;
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double det = lines[i][0] * lines[k][1] - lines[i][1] * lines[k][0];
        if (std::fabs(det) < 1e-9) continue;
        const double x = (lines[i][2] * lines[k][1] - lines[i][1] * lines[k][2]) / det;
        const double y = (lines[i][0] * lines[k][2] - lines[i][2] * lines[k][0]) / det;
        bool inside = x >= -1e-9 && y >= -1e-9;
        for (std::size_t r = 0; r < program.rows.size(); ++r)
          inside = inside && program.rows[r][0] * x + program.rows[r][1] * y <= program.bound[r] + 1e-9;
        if (inside) best = std::min(best, program.cost[0] * x + program.cost[1] * y);
      }
    CAPTURE(round);
    const auto found = solve(program);
    REQUIRE(found.has_value() == (best < 1e299));
    if (found)
      CHECK(program.cost[0] * (*found)[0] + program.cost[1] * (*found)[1] ==
            doctest::Approx(best).epsilon(1e-8));
  }
}

TEST_CASE("friction bounds two neighbours by their cone, and names them") {
  // (1 + e) 1 = 0.8 x 2 (1 - e).
  const FrictionBound bound = friction_bound({{1, 2}, {no_limit, no_limit}, {0.8}});
  CHECK(bound.error == doctest::Approx(0.6 / 2.6).epsilon(1e-10));
  CHECK(bound.low + bound.high == 1);
  // What does not matter lies between: both joints hold.
  CHECK(friction_bound({{1, 0, 2}, {no_limit, no_limit, no_limit}, {0.8, 0.9}}).error ==
        doctest::Approx((2 * 0.72 - 1) / (1 + 2 * 0.72)).epsilon(1e-10));
  // A limit: 30 % below the target.
  const FrictionBound limited = friction_bound({{1, 1}, {no_limit, 0.7}, {0.5}});
  CHECK(limited.error == doctest::Approx(0.3).epsilon(1e-10));
  CHECK(limited.low == 1);
  CHECK(limited.high == 1);
}

TEST_CASE("over equal saddles with equal targets the error is that of the longest tooth") {
  // Of n + 1 segments in m runs one has at least (n + 1) / m, rounded up, and friction parts its ends.
  const double mu = 0.3, rho = arc_rho(mu);
  for (const int joints : {1, 4, 5, 8})
    for (const int moves : {1, 2, 3, 4, 5}) {
      const SceneDescription scene = arc(joints, mu);
      const Plan plan = find_plan(scene, goal_for(scene, 3e5, moves));
      const double ratio = std::pow(rho, std::ceil((joints + 1.0) / moves) - 1);
      CAPTURE(joints);
      CAPTURE(moves);
      CHECK(plan.outcome.error == doctest::Approx((1 - ratio) / (1 + ratio)).epsilon(1e-7).scale(1e-2));
      CHECK(plan.outcome.excess == 0);
      if (moves <= 2) CHECK(plan.certainty != Certainty::best_found);
    }
}

TEST_CASE("a pull of one segment with lock-off is its target and the seating") {
  SceneDescription scene = arc(0, 0);
  scene.cables[0].seating = 0.004;
  PlanGoal goal = goal_for(scene, 3e5, 1);
  goal.lock = true;
  const Plan plan = find_plan(scene, goal);
  CHECK(plan.outcome.error < 1e-9);
  CHECK(plan.stages[0].force[0] == doctest::Approx(3e5 + 2e11 * 1e-3 / arc_pitch * 0.004).epsilon(1e-9));
}

TEST_CASE("lock-off over one saddle that sticks takes from the near segment alone") {
  const double mu = 1, rho = arc_rho(mu), t = 3e5;
  SceneDescription scene = arc(1, mu);
  scene.cables[0].seating = 0.0005;
  PlanGoal goal = goal_for(scene, t, 1);
  goal.lock = true;
  const double drawn = 2e11 * 1e-3 / arc_pitch * 0.0005;
  // rho P and P - drawn lie as far below as above.
  const double P = (2 * t + drawn) / (1 + rho);
  const Plan plan = find_plan(scene, goal);
  CHECK(plan.stages[0].force[0] == doctest::Approx(P).epsilon(1e-8));
  CHECK(plan.outcome.error == doctest::Approx((P - drawn) / t - 1).epsilon(1e-8));
}

TEST_CASE("no force and no stroke passes its limit anywhere on the way") {
  for (int number = 0; number < 12; ++number) {
    Random random(static_cast<std::uint64_t>(100 + number));
    const auto kind = number % 2 == 0 ? plan_test::SceneKind::saddles : plan_test::SceneKind::truss;
    plan_test::Site site = plan_test::random_site(random, kind, number % 3 == 0);
    const Plan free = find_plan(site.scene, site.goal);
    REQUIRE(free.status().ok());
    PlanGoal limited = site.goal;
    double most = 0, most_stroke = 0;
    for (const auto& stage : free.outcome.tension)
      for (const double force : stage) most = std::max(most, force);
    for (const auto& stage : free.outcome.stroke) most_stroke = std::max(most_stroke, stage.back());
    limited.most_segment.assign(limited.target.size(), 0.97 * most);
    limited.most_stroke[0][1] = 0.99 * most_stroke;
    limited.lock = number % 4 == 1;
    site.scene.cables[0].seating = 0.002;
    limited.stages = 2 + number % 2;
    const Plan plan = find_plan(site.scene, limited);
    CAPTURE(number);
    REQUIRE(plan.outcome.whole);
    CHECK(plan.outcome.error < 1);
    // Load steps in place of events.
    const auto model = make_model(site.scene, Method::tracker, ScalarType::float64);
    REQUIRE(model->start(1).whole());
    LogRow row;
    row.factor = limited.factor;
    row.cables.resize(1);
    REQUIRE(model->advance(row, 1).whole());
    LogRow before = row;
    for (const PlanStage& stage : plan.stages) {
      LogRow after = before;
      for (std::size_t k = 0; k < plan.jacks.size(); ++k) {
        after.cables[0][plan.jacks[k].end].force = stage.force[k];
        after.cables[0][plan.jacks[k].end].locked = stage.locked[k] != 0;
      }
      for (int step = 1; step <= 50; ++step) {
        row = after;
        for (std::size_t end = 0; end < 2; ++end) {
          const double a = before.cables[0][end].force, b = after.cables[0][end].force;
          row.cables[0][end].force = a + step / 50.0 * (b - a);
        }
        REQUIRE(model->advance(row, 1).whole());
        Answer answer;
        model->read(answer);
        for (const double force : answer.tension) CHECK(force <= 0.97 * most);
        CHECK(answer.extension[0][1] <= 0.99 * most_stroke);
      }
      before = after;
    }
  }
}

TEST_CASE("what is expected over the prior of one mu is the integral over its normal distribution") {
  SceneDescription scene = arc(4, 0.3);
  CableDescription& cable = scene.cables[0];
  cable.mu_sd = 0.06;
  cable.has_mu_sd = cable.shared_mu = true;
  cable.scatter = 0;
  const PlanGoal goal = goal_for(scene, 3e5, 1);
  const Plan plan = find_plan(scene, goal);
  const PriorOutcome prior = outcome_over_prior(scene, goal, plan.jacks, plan.stages);
  // A straight pull: the jack has too much, the far end too little.
  const double P = plan.stages[0].force[0];
  const auto error = [&](double mu) {
    return std::max(P / 3e5 - 1, 1 - P / 3e5 * std::pow(arc_rho(std::max(mu, 0.0)), 4));
  };
  double sum = 0, weight = 0;
  for (int k = -4000; k <= 4000; ++k) {
    const double z = k / 1000.0, w = std::exp(-z * z / 2);
    sum += w * error(0.3 + 0.06 * z);
    weight += w;
  }
  CHECK(prior.failed == 0);
  CHECK(prior.expected == doctest::Approx(sum / weight).epsilon(0.01));
  CHECK(prior.at_95 == doctest::Approx(error(0.3 + 1.6449 * 0.06)).epsilon(0.03));
  // The stroke is the sum of what the segments stretch, less where there is more friction.
  const auto stroke = [&](double mu) {
    double all = 0;
    for (int i = 0; i < 5; ++i) all += P * std::pow(arc_rho(mu), i) * arc_pitch / (2e11 * 1e-3);
    return all;
  };
  CHECK(prior.stroke[0][0][0] == doctest::Approx(stroke(0.3 + 1.96 * 0.06)).epsilon(0.003));
  CHECK(prior.stroke[0][0][1] == doctest::Approx(stroke(0.3 - 1.96 * 0.06)).epsilon(0.003));
}

TEST_CASE("cables on one node are tensioned in turn, each with what the next one takes from it") {
  // Two cables without friction pull a common bearing: with jacks that hold, each has its own force.
  SceneDescription scene;
  scene.nodes = {{"a", {0, 0, 0}, taut::held_x | taut::held_y},
                 {"m", {4, 0, 0}, taut::held_y},
                 {"b", {8, 0, 0}, taut::held_x | taut::held_y},
                 {"c", {0, -3, 0}, taut::held_x | taut::held_y}};
  scene.struts.push_back({{1, 3}, 2e11, 1e-4, {}});
  for (const int from : {0, 2}) {
    CableDescription cable;
    cable.name = from == 0 ? "A" : "B";
    cable.path = {from, 1};
    cable.E = 2e11;
    cable.A = 1e-3;
    cable.ends = {taut::End::jacked, taut::End::anchored};
    cable.prestrain.assign(1, 0);
    cable.force.resize(1);
    cable.seating = 0.002;
    scene.cables.push_back(cable);
  }
  PlanGoal goal;
  goal.file = "goal";
  goal.target = {2e5, 1.9e5};
  goal.most_segment.assign(2, no_limit);
  goal.most_force.assign(2, {no_limit, no_limit});
  goal.most_stroke = goal.most_force;
  goal.lock = true;
  const Plan plan = find_plan(scene, goal);
  REQUIRE(plan.status().ok());
  CHECK(plan.outcome.error < 1e-8);
  // Locked, each is a spring k between its anchor and the node, which the strut holds with c. The second pull
  // moves the node; the first cable was pulled with what that and its own seating will take.
  const double k = 2e11 * 1e-3 / 4, length = 5, c = 2e11 * 1e-4 / length * 0.64;
  // Forces on the node, u to the right: B - A = c u. After A was locked with the extension eA: A = k (eA +
  // u).
  const double u = (1.9e5 - 2e5) / c, eA = 2e5 / k - u, eB = 1.9e5 / k + u;
  const auto pulled_first = [&](double e) { return k * c / (k + c) * e; };  // alone, by the jack
  REQUIRE(plan.stages.size() == 4);
  CHECK(plan.stages[0].force[0] == doctest::Approx(pulled_first(eA + 0.002)).epsilon(1e-6));
  // B pulled to eB + 0.002 against A locked: stiffness k and c side by side at the node.
  // B = k (eB + s - u), B - A = c u, A = k (eA + u).
  const double s = 0.002, u2 = (k * (eB + s) - k * eA) / (c + 2 * k);
  CHECK(plan.stages[2].force[1] == doctest::Approx(k * (eB + s - u2)).epsilon(1e-6));
}

TEST_CASE("the rest of a plan knows what was jacked: it goes on as planned, and brute force is no nearer") {
  const std::uint64_t seed = 31;
  CAPTURE(seed);
  Random random(seed);
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    const plan_test::Site site = plan_test::random_site(
        random, round % 2 == 0 ? plan_test::SceneKind::saddles : plan_test::SceneKind::truss, false);
    const Plan plan = find_plan(site.scene, site.goal);
    REQUIRE(plan.status().ok());
    if (plan.stages.size() < 2) continue;
    PlanStage rest = plan.stages[0];
    rest.force[0] = 0;
    PlanPast past;
    past.moves = {{rest, site.goal.factor}, {plan.stages[0], site.goal.factor}};
    past.rest = {plan.shape[1]};
    past.force = {plan.stages[1].force[0]};
    // After the first move the second one is left as it is.
    const Plan same = find_rest_of_plan(site.scene, site.goal, past);
    CHECK(same.is_as_before);
    CHECK(same.outcome.error == doctest::Approx(plan.outcome.error).epsilon(1e-9));
    // The pull has gone too far, and mu is another one: a release is left, or two moves.
    past.moves[1].stage.force[0] *= 1.1;
    SceneDescription other = site.scene;
    for (double& mu : other.cables[0].mu) mu *= 0.7;
    for (const int moves : {1, 2}) {
      CAPTURE(moves);
      past.moves_left = static_cast<std::size_t>(moves);
      const Plan found = find_rest_of_plan(other, site.goal, past);
      const double brute = plan_test::best_of_rest(other, site.goal, plan.jacks, past.moves, moves);
      // What is nearer by no more than worth_a_change is not asked of anybody.
      CHECK(found.outcome.error <= brute + worth_a_change + 1e-9);
      CHECK(found.outcome.excess == 0);
      // The plan as it was, on the structure as it is.
      past.stays = true;
      const Plan stays = find_rest_of_plan(other, site.goal, past);
      past.stays = false;
      CHECK(stays.stages.back().force == plan.stages[1].force);
      CHECK(found.outcome.error <= stays.outcome.error + 1e-12);
    }
  }
}

TEST_CASE("whoever needs a plan no more gets none, soon") {
  const SceneDescription scene = arc(8, 0.3);
  int asked = 0;
  CHECK_THROWS_AS(find_plan(scene, goal_for(scene, 3e5, 3), [&] { return ++asked > 20; }), GivenUp);
  CHECK(asked == 21);
}

TEST_CASE("a row of noise that no model has an answer for is left out of the past") {
  SceneDescription scene = arc(4, 0.1);
  scene.cables[0].ends = {taut::End::jacked, taut::End::jacked};
  const PlanGoal goal = goal_for(scene, 3e5, 2);
  const Plan plan = find_plan(scene, goal);
  const auto move = [&](double start, double end) { return PastMove{{{start, end}, {0, 0}}, goal.factor}; };
  Jacking with(scene, goal, plan.jacks), without(scene, goal, plan.jacks), ends(scene, goal, plan.jacks);
  REQUIRE(with.begin_after({move(0, 400), move(2e5, 2e5)}));  // pulled through
  REQUIRE(without.begin_after({move(2e5, 2e5)}));
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(with.here().tension[i] == doctest::Approx(without.here().tension[i]));
  CHECK_FALSE(ends.begin_after({move(2e5, 2e5), move(0, 400)}));
  CHECK_FALSE(ends.why().ok());
}

TEST_CASE("of two cables the first stays locked while the rest of the second one is found") {
  SceneDescription scene = arc(4, 0.3);
  SceneDescription second = arc(4, 0.3);
  for (NodeDescription node : second.nodes) {
    node.at[1] -= 100;
    scene.nodes.push_back(node);
  }
  CableDescription cable = second.cables[0];
  cable.name = "D";
  for (int& node : cable.path) node += 6;
  scene.cables.push_back(cable);
  PlanGoal goal = goal_for(scene, 3e5, 4);
  goal.target.assign(10, 3e5);
  goal.most_segment.assign(10, no_limit);
  goal.most_force.assign(2, {no_limit, no_limit});
  goal.most_stroke = goal.most_force;
  goal.lock = true;
  const Plan plan = find_plan(scene, goal);
  REQUIRE(plan.status().ok());
  PlanPast past;
  past.moves = {{{{0, 0}, {0, 0}}, goal.factor}};
  std::size_t s = 0;
  for (; s < plan.shape.size(); ++s) {
    past.moves.push_back({plan.stages[s], goal.factor});
    if (plan.shape[s].locks) break;
  }
  REQUIRE(s + 1 < plan.shape.size());
  past.rest.assign(plan.shape.begin() + static_cast<std::ptrdiff_t>(s) + 1, plan.shape.end());
  for (std::size_t r = s + 1; r < plan.shape.size(); ++r)
    if (!plan.shape[r].locks) past.force.push_back(plan.stages[r].force[1]);
  const Plan same = find_rest_of_plan(scene, goal, past);
  CHECK(same.is_as_before);
  CHECK(same.outcome.error == doctest::Approx(plan.outcome.error).epsilon(1e-9));
  // The second cable slides more easily than was thought. The first one is done: it does not count any more,
  // and two moves are left.
  past.moves_left = 2;
  for (double& mu : scene.cables[1].mu) mu = 0.15;
  for (std::size_t i = 0; i < 5; ++i) goal.target[i] = 0;
  const Plan found = find_rest_of_plan(scene, goal, past);
  CHECK_FALSE(found.is_as_before);
  for (const PlanStage& stage : found.stages) {
    CHECK(stage.locked[0] == 1);
    CHECK(stage.force[0] == plan.stages[s].force[0]);
  }
  CHECK(found.stages.back().locked[1] == 1);
  // As if it had been known from the start: five segments in two moves, in runs of three and two.
  const double ratio = std::pow(arc_rho(0.15), 2);
  CHECK(found.outcome.error == doctest::Approx((1 - ratio) / (1 + ratio)).epsilon(1e-6));
}
