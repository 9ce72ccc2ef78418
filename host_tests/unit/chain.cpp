// A jacked cable over rigid saddles, against hand calculations.
#include <algorithm>

#include "support/bench.hpp"
#include "support/status_check.hpp"
#include "unit/hand.hpp"

namespace chain_test {
using namespace support;
using hand::Chain;
using hand::EA;
using taut::Code;
using taut::JointState;

namespace {

constexpr double F = 2e5;           // [N]
constexpr double rounding = 1e-12;  // some hundred operations in double
using PlaneBench = Bench<double, Plane>;
Plane scene;

void make(const Chain& chain, std::array<taut::End, 2> ends = jacked_end) {
  rigid_saddles(scene, steel_cable(chain.mu, ends), chain_points(chain.segments));
}

template <class Expected>
void check_tensions(const PlaneBench& bench, const Expected& expected) {
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < scene.prestrain.size(); ++i) {
    CAPTURE(i);
    CHECK(close(bench.T(i), expected(i), rounding, bench.largest_force()));
  }
}

}  // namespace

SOLVER_TEST_CASE(
    "without friction every segment has the force of the jack, and the extension is F sum(L) / EA", solver) {
  const Chain chain{6, 0};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  check_tensions(bench, [](int) { return F; });
  CHECK(close(bench.extension(0, 1), F * chain.total_length() / EA, rounding));
}

SOLVER_TEST_CASE(
    "without friction the cable that slid over a joint is the elongation of all segments before it", solver) {
  const Chain chain{6, 0};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  double drawn = 0;
  for (int j = 0; j < 5; ++j) {
    drawn += F * chain.length(j) / EA;
    CHECK(close(bench.slip(j), drawn, rounding));
    CHECK(bench.response().state[j] == JointState::forward);
  }
}

SOLVER_TEST_CASE("while the jack pulls every joint keeps its part of the force", solver) {
  const Chain chain{8, 0.3};
  make(chain);
  PlaneBench bench(scene, solver);
  for (const double force : {0.1 * F, F, 3 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [&](int i) { return force * chain.reach(i); });
  }
}

SOLVER_TEST_CASE("the extension of a jack is the elongation of all segments", solver) {
  const Chain chain{7, 0.25};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  double elongation = 0;
  for (int i = 0; i < chain.segments; ++i) elongation += F * chain.reach(i) * chain.length(i) / EA;
  CHECK(close(bench.extension(0, 1), elongation, rounding));
  CHECK(bench.extension(0, 0) == 0);
}

SOLVER_TEST_CASE("a jack at the start pulls the cable backwards", solver) {
  const Chain chain{5, 0.3};
  make(chain, jacked_start);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 0, F).go().ok());
  check_tensions(bench, [&](int i) { return F * chain.reach_from_start(i); });
  double drawn = 0;
  for (int j = 3; j >= 0; --j) {
    drawn += bench.T(j + 1) * chain.length(j + 1) / EA;
    CHECK(close(bench.slip(j), -drawn, rounding));
    CHECK(bench.response().state[j] == JointState::backward);
    CHECK(bench.response().friction[j] < 0);
  }
}

SOLVER_TEST_CASE("while the jack gives way friction turns round from the jack inwards", solver) {
  const Chain chain{8, 0.3};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  for (const double force : {0.95 * F, 0.8 * F, 0.5 * F, 0.2 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [&](int i) { return std::min(F * chain.reach(i), force / chain.reach(i)); });
  }
}

SOLVER_TEST_CASE("pulling again takes another way than giving way and meets the first pull where it ended",
                 solver) {
  const Chain chain{8, 0.3};
  const double low = 0.5 * F;
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  REQUIRE(bench.jack(0, 1, low).go().ok());
  for (const double force : {0.6 * F, 0.8 * F, F, 1.2 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [&](int i) {
      const double released = std::min(F * chain.reach(i), low / chain.reach(i));
      return std::max(released, force * chain.reach(i));
    });
  }
}

SOLVER_TEST_CASE("a hundred load cycles end where the first one ended", solver) {
  const Chain chain{6, 0.2};
  make(chain);
  PlaneBench bench(scene, solver);
  for (int cycle = 0; cycle < 100; ++cycle) {
    REQUIRE(bench.jack(0, 1, F).go().ok());
    REQUIRE(bench.jack(0, 1, 0.4 * F).go().ok());
  }
  check_tensions(bench, [&](int i) { return std::min(F * chain.reach(i), 0.4 * F / chain.reach(i)); });
}

SOLVER_TEST_CASE("a full release leaves no tension and no extension", solver) {
  const Chain chain{6, 0.3};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  REQUIRE(bench.jack(0, 1, 0).go().ok());
  check_tensions(bench, [](int) { return 0.0; });
  CHECK(std::fabs(bench.extension(0, 1)) <= rounding * F * chain.total_length() / EA);
}

SOLVER_TEST_CASE("without friction the tensions follow the jack up and down", solver) {
  make({6, 0});
  PlaneBench bench(scene, solver);
  for (const double force : {F, 0.3 * F, 0.0, 2 * F, 0.1 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [force](int) { return force; });
  }
}

SOLVER_TEST_CASE("nothing passes a self-locking joint, and beyond it the chain is that of the other joints",
                 solver) {
  const Chain chain{6, 0.3};
  make(chain);
  scene.mu[2] = 1.01 / std::tan(chain_turn[2] / 2);  // mu cot(alpha) = 1.01
  PlaneBench bench(scene, solver);
  for (const double force : {F, 2 * F}) {
    REQUIRE(bench.jack(0, 1, force).go().ok());
    check_tensions(bench, [&](int i) { return i < 3 ? 0 : force * chain.reach(i); });
    CHECK(bench.slip(2) == 0);
  }
}

SOLVER_TEST_CASE("a joint just short of locked lets through hardly anything, but slides", solver) {
  make({3, 0});
  scene.mu[0] = 0.999 / std::tan(chain_turn[0] / 2);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  check_tensions(bench, [](int i) { return i == 0 ? F * 0.001 / 1.999 : F; });
  CHECK(bench.slip(0) > 0);
}

SOLVER_TEST_CASE("two jacks pull from both ends and the larger force wins in every segment", solver) {
  const Chain chain{8, 0.3};
  make(chain, two_jacks);
  for (const double other : {0.7 * F, F, 1.3 * F}) {
    PlaneBench bench(scene, solver);
    REQUIRE(bench.jack(0, 0, other).jack(0, 1, F).go().code == Code::ok);
    check_tensions(bench,
                   [&](int i) { return std::max(F * chain.reach(i), other * chain.reach_from_start(i)); });
  }
}

SOLVER_TEST_CASE("jacking one end after the other leaves both sides what they got", solver) {
  const Chain chain{6, 0.4};
  make(chain, two_jacks);
  PlaneBench bench(scene, solver);
  const double held = F * chain.reach(0);  // what the first jack needs to keep the cable from running
  REQUIRE(bench.jack(0, 0, held).jack(0, 1, F).go().code == Code::ok);
  REQUIRE(bench.jack(0, 0, F).go().code == Code::ok);
  check_tensions(bench, [&](int i) { return F * std::max(chain.reach(i), chain.reach_from_start(i)); });
}

SOLVER_TEST_CASE("a cable of one segment has the force of its only jack", solver) {
  for (const int end : {0, 1}) {
    make({1, 0}, end == 0 ? jacked_start : jacked_end);
    PlaneBench bench(scene, solver);
    REQUIRE(bench.jack(0, end, F).go().code == Code::ok);
    check_tensions(bench, [](int) { return F; });
    CHECK(close(bench.extension(0, end), F * chain_length(0) / EA, rounding));
  }
}

SOLVER_TEST_CASE("a segment that is not quite level is as good as a level one", solver) {
  for (const double rise : {0.0, 1e-4, 1e-6, 1e-8, 1e-12, 4e-16}) {
    CAPTURE(rise);
    rigid_saddles(scene, steel_cable(0.2), {{0, 0}, {3, rise}, {5, 1}});
    PlaneBench bench(scene, solver);
    REQUIRE(bench.started().code == Code::ok);
    REQUIRE(bench.jack(0, 1, F).go().code == Code::ok);
    const double turn = std::atan2(1 - rise, 2) - std::atan2(rise, 3);
    check_tensions(bench, [turn](int i) { return i == 0 ? F * hand::point_ratio(0.2, turn) : F; });
  }
}

SOLVER_TEST_CASE("two equal jacks on a cable of one segment share its elongation", solver) {
  make({1, 0}, two_jacks);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 0, F).jack(0, 1, F).go().code == Code::ok);
  check_tensions(bench, [](int) { return F; });
  CHECK(close(bench.extension(0, 0) + bench.extension(0, 1), F * chain_length(0) / EA, rounding));
}

SOLVER_TEST_CASE("along saddles the force falls by exp(-mu beta), along straight ducts by exp(-mu k s)",
                 solver) {
  const double mu = 0.25, k = 0.01;
  taut::Cable<double> cable = steel_cable(mu);
  cable.law = taut::FrictionLaw::capstan;
  rigid_saddles(scene, cable, chain_points(4));
  PlaneBench curved(scene, solver);
  REQUIRE(curved.jack(0, 1, F).go().ok());
  CHECK(close(curved.T(0), F * std::exp(-mu * (chain_turn[0] + chain_turn[1] + chain_turn[2])), rounding));
  CHECK_LAWFUL(curved, double);

  cable.wobble = k;
  rigid_saddles(scene, cable, {{0, 0}, {3, 0}, {10, 0}, {12, 0}});
  PlaneBench straight(scene, solver);
  REQUIRE(straight.jack(0, 1, F).go().ok());
  CHECK(close(straight.T(1), F * std::exp(-mu * k * 4.5), rounding));
  CHECK(close(straight.T(0), F * std::exp(-mu * k * (4.5 + 5)), rounding));
  CHECK(std::fabs(straight.response().contact[0]) <= 1e-15 * F);
  CHECK_LAWFUL(straight, double);
}

SOLVER_TEST_CASE("a saddle and a point contact of its mu_eff carry the same forces up and down", solver) {
  taut::Cable<double> cable = steel_cable(0.3);
  cable.law = taut::FrictionLaw::capstan;
  rigid_saddles(scene, cable, chain_points(6));
  static Plane points;
  rigid_saddles(points, steel_cable(0), chain_points(6));
  for (int j = 0; j < 5; ++j) points.mu[j] = std::tanh(0.3 * chain_turn[j] / 2) / std::tan(chain_turn[j] / 2);
  PlaneBench saddles(scene, solver), contacts(points, solver);
  for (const double force : {F, 0.6 * F, 0.9 * F}) {
    REQUIRE(saddles.jack(0, 1, force).go().ok());
    REQUIRE(contacts.jack(0, 1, force).go().ok());
    for (int i = 0; i < 6; ++i) CHECK(close(saddles.T(i), contacts.T(i), rounding, F));
  }
}

SOLVER_TEST_CASE("on a path that only pulls the number of load steps does not matter", solver) {
  make({7, 0.35});
  PlaneBench at_once(scene, solver), in_steps(scene, solver);
  REQUIRE(at_once.jack(0, 1, F).go(1).ok());
  REQUIRE(in_steps.jack(0, 1, F).go(37).ok());
  check_tensions(in_steps, [&](int i) { return at_once.T(i); });
}

SOLVER_TEST_CASE("a cable that nobody pulls has no tension and all joints stick", solver) {
  make({5, 0.2});
  PlaneBench bench(scene, solver);
  REQUIRE(bench.started().ok());
  REQUIRE(bench.go().ok());
  check_tensions(bench, [](int) { return 0.0; });
  for (int j = 0; j < 4; ++j) CHECK(bench.response().state[j] == JointState::stick);
}

SOLVER_TEST_CASE("friction that holds the difference keeps the tensions of uneven prestrain", solver) {
  make({3, 0.5}, anchored);
  const double strain[] = {1.0e-3, 1.05e-3, 1.0e-3};
  for (int i = 0; i < 3; ++i) scene.prestrain[i] = strain[i];
  PlaneBench bench(scene, solver);
  check_tensions(bench, [&](int i) { return EA * strain[i]; });
  CHECK(bench.slip(0) == 0);
}

SOLVER_TEST_CASE("friction that does not hold the difference lets uneven prestrain even out to its limit",
                 solver) {
  const Chain chain{2, 0.2};
  make(chain, anchored);
  scene.prestrain[1] = 2e-3;
  PlaneBench bench(scene, solver);
  // T1 L1 + T2 L2 = EA x 2e-3 x L2, for the joint only moves cable; and T1 = rho T2.
  const double rho = hand::point_ratio(0.2, chain_turn[0]);
  const double T2 = EA * 2e-3 * chain.length(1) / (rho * chain.length(0) + chain.length(1));
  check_tensions(bench, [&](int i) { return i == 0 ? rho * T2 : T2; });
}

SOLVER_TEST_CASE("contact and friction forces are those of the two tensions", solver) {
  const Chain chain{4, 0.3};
  make(chain);
  PlaneBench bench(scene, solver);
  REQUIRE(bench.jack(0, 1, F).go().ok());
  for (int j = 0; j < 3; ++j) {
    const double half = chain_turn[j] / 2;  // pi/2 - alpha
    CHECK(close(bench.response().contact[j], (bench.T(j) + bench.T(j + 1)) * std::sin(half), rounding));
    CHECK(close(bench.response().friction[j], (bench.T(j + 1) - bench.T(j)) * std::cos(half), rounding, F));
    CHECK(close(bench.response().friction[j], 0.3 * bench.response().contact[j], 1e-11));
  }
}

}  // namespace chain_test
