// The independent check sees every kind of spoiled answer.
#include "support/equilibrium.hpp"

#include "support/bench.hpp"

namespace equilibrium_test {
using namespace support;

namespace {

using Response = taut::Response<double, PlaneCapacity>;
using Sample = taut::Sample<double, PlaneCapacity>;

/// An answer that can be spoiled.
struct Spoiled {
  const Engine<double, Plane>* solver;
  Response answer;
  double lift = 0;  // of node 1, which does not belong to it [m]

  const Response& response() const { return answer; }
  double displacement(int node, int axis) const {
    return solver->displacement(node, axis) + (node == 1 && axis == 1 ? lift : 0);
  }
};

Plane scene;
constexpr double wrong = 1e-6;  // far above rounding, far below what anybody would notice

/// What the check says of a truss string structure under load, once as it is and once after `spoil`.
template <class Spoil>
Violations after(Spoil spoil) {
  truss_string(scene, steel_cable(0.3), 6);
  Bench<double, Plane> bench(scene, Solver::stepwise);
  REQUIRE(bench.load(0, 1).jack(0, 1, 2e5).go().ok());
  Sample sample;
  sample.factor[0] = 1;
  sample.jack[0][1].force = 2e5;
  Spoiled spoiled{&bench.solver(), bench.response()};
  Watch<Plane, double> watch(scene);
  REQUIRE(watch.check(spoiled, sample).worst() <= tolerance<double>());
  spoil(spoiled);
  watch.restart();
  return watch.check(spoiled, sample);
}

}  // namespace

TEST_CASE("a force that is off by a millionth upsets equilibrium") {
  CHECK(after([](Spoiled& s) { s.answer.strut[3] += wrong * 2e5; }).imbalance > wrong / 10);
  CHECK(after([](Spoiled& s) { s.answer.tension[2] *= 1 + wrong; }).imbalance > wrong / 100);
}

TEST_CASE("a force that does not follow from its elongation is incompatible") {
  // Measured by stiffness x displacement, which is a hundred times the force.
  CHECK(after([](Spoiled& s) { s.answer.strut[3] += wrong * 2e5; }).strut > wrong / 1000);
  CHECK(after([](Spoiled& s) { s.answer.tension[2] *= 1 + wrong; }).incompatible > wrong / 100);
  CHECK(after([](Spoiled& s) { s.answer.slip[2] *= 1 + wrong; }).incompatible > wrong / 100);
  CHECK(after([](Spoiled& s) { s.answer.extension[0][1] *= 1 + wrong; }).incompatible > wrong / 100);
  CHECK(after([](Spoiled& s) { s.lift = 1e-7; }).strut > 1e-8);
}

TEST_CASE("a tension below zero, or other than the jack's force, is seen") {
  CHECK(after([](Spoiled& s) { s.answer.tension[0] = -0.2; }).pushing > 1e-7);
  CHECK(after([](Spoiled& s) { s.answer.tension[5] *= 1 + wrong; }).jack > wrong / 10);
}

TEST_CASE("tensions further apart than friction can hold are seen") {
  CHECK(after([](Spoiled& s) { s.answer.tension[2] *= 0.5; }).beyond_friction > 1e-3);
}

TEST_CASE("a contact or friction force that is not that of the tensions is seen") {
  CHECK(after([](Spoiled& s) { s.answer.contact[1] += wrong * 2e5; }).contact > wrong / 10);
  CHECK(after([](Spoiled& s) { s.answer.friction[1] = -s.answer.friction[1]; }).contact > wrong);
}

TEST_CASE("a joint that slides without being at the limit that opposes it is seen") {
  CHECK(after([](Spoiled& s) { s.answer.tension[4] = s.answer.tension[5]; }).off_limit > 1e-3);
  CHECK(after([](Spoiled& s) { s.answer.state[4] = taut::JointState::backward; }).off_limit > 1e-3);
}

TEST_CASE("a slip against the pull, or one that friction could have held, is seen") {
  CHECK(after([](Spoiled& s) { s.answer.slip[4] = -s.answer.slip[4]; }).uphill > 1e-3);
  CHECK(after([](Spoiled& s) { s.answer.tension[4] = s.answer.tension[5]; }).below_limit > 1e-3);
}

TEST_CASE("a run without tension that is stretched is seen") {
  CHECK(after([](Spoiled& s) { s.answer.tension.fill(0); }).stretched_but_slack > 1e-3);
}

TEST_CASE("an answer that is no number is infinitely wrong") {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(after([=](Spoiled& s) { s.answer.tension[1] = not_a_number; }).worst() < 1);
  CHECK_FALSE(after([=](Spoiled& s) { s.answer.strut[1] = not_a_number; }).worst() < 1);
  CHECK_FALSE(after([=](Spoiled& s) { s.lift = not_a_number; }).worst() < 1);
}

}  // namespace equilibrium_test
