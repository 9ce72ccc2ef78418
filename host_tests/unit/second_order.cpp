// Second-order theory against closed forms at large displacements.
#include <doctest/doctest.h>
#include <cmath>
#include <memory>
#include <vector>

#include "taut/taut.hpp"

namespace second_order_test {
namespace {

using taut::End;

struct Cap : taut::Capacity {
  static constexpr int nodes = 4, struts = 2, segments = 3, joints = 2, loads = 1, forces = 1, normals = 1;
  static constexpr int displacements = 2;
};
struct TwoStruts : taut::Capacity {
  static constexpr int nodes = 6, struts = 2, segments = 3, joints = 2, loads = 1, forces = 2, normals = 1;
};
using Scene = taut::Scene<double, 2, Cap>;
using Model = taut::SecondOrder<double, Cap>;
using Tracker = taut::Tracker<Model>;
using Sample = taut::Sample<double, Cap>;
using Response = taut::Response<double, Cap>;

constexpr double EA = 8e8;     // of the cable [N]
constexpr int joint_node = 1;  // of both scenes

taut::Cable<double> cable_with(double mu, bool from_start = false) {
  taut::Cable<double> cable;
  cable.E = EA;
  cable.A = 1;
  cable.mu = mu;
  cable.ends[from_start ? 0 : 1] = End::jacked;
  return cable;
}

// A strut of 2 m that is pinned at its head; the cable comes up to both sides of its foot by 0.5 m in 10 m.
Scene pinned_strut(double mu, bool mirrored = false) {
  Scene scene;
  const double way = mirrored ? -1 : 1;
  const int l = scene.add_node({-10 * way, 0.5}, taut::held_xy), p = scene.add_node({0, 0});
  const int r = scene.add_node({10 * way, 0.5}, taut::held_xy), t = scene.add_node({0, 2}, taut::held_xy);
  scene.add_strut(p, t, 2e13, 1);
  if (mirrored)
    scene.add_cable(cable_with(mu, true), {r, p, l});
  else
    scene.add_cable(cable_with(mu), {l, p, r});
  return scene;
}

// The same with 100 kN hanging at the foot: it takes thrust out of the strut and leaves tensions alone.
Scene loaded_pinned_strut(double mu) {
  Scene scene = pinned_strut(mu);
  scene.add_force(scene.add_load(), joint_node, {0, -1e5});
  return scene;
}

// A joint that is guided upward and carries 200 kN, 1 m below both ends of its cable.
Scene guided_joint(double mu) {
  Scene scene;
  const int l = scene.add_node({-10, 0}, taut::held_xy), p = scene.add_node({0, -1}, taut::held_x);
  const int r = scene.add_node({10, 0}, taut::held_xy);
  scene.add_cable(cable_with(mu), {l, p, r});
  scene.add_force(scene.add_load(), p, {0, -2e5});
  return scene;
}

Sample pulled(double force, double factor = 0, std::size_t end = 1) {
  Sample sample;
  sample.jack[0][end].force = force;
  sample.factor[0] = factor;
  return sample;
}

struct Condensed {
  Model model;
  Model::Struts struts;
  taut::LevelDisplacements<double, Cap> displacements;

  Condensed(const Scene& scene, const Sample& target) {
    const auto condensation = std::make_unique<taut::SecondOrderCondensation<double, Scene>>();
    for (int axis = 0; axis < 2; ++axis) displacements.add(joint_node, axis);
    const taut::Status status = condensation->run(scene, target, model, struts, nullptr, &displacements);
    REQUIRE(status.ok());
  }
  // Of the joint's node.
  taut::FixedArray<double, 2> displaced(const Tracker& tracker) const {
    taut::FixedArray<double, 2> found;
    displacements.evaluate(tracker.model(), tracker.loads(), tracker.elongations(), found);
    return found;
  }
  Response at(const Tracker& tracker) const {
    Response response;
    tracker.respond(response, &struts);
    return response;
  }
};

bool near(double found, double expected, double part) {
  INFO("found ", found, ", expected ", expected);
  return std::fabs(found - expected) <= part * std::fabs(expected);
}

}  // namespace

TEST_CASE(
    "a strut pinned at both ends leans toward the jack as far as friction lets it, as in the closed form") {
  // The strut leans by theta when F = k theta: statics of the foot on its arc, cable law EA (l - L) / L of
  // what is left between foot and jack.
  const auto scene = pinned_strut(0.1);
  const auto condensed = std::make_unique<Condensed>(scene, pulled(2e6));
  auto tracker = std::make_unique<Tracker>();
  REQUIRE(tracker->start(condensed->model).status.ok());
  struct Expected {
    double F, T1, strut, extension;
  };
  for (const Expected& each :
       {Expected{797508, 797903, -79668, 0.0199501}, Expected{1991880, 1994345, -199017, 0.0497816}}) {
    REQUIRE(tracker->advance(pulled(each.F)).status.ok());
    const Response found = condensed->at(*tracker);
    CHECK(near(found.tension[0], each.T1, 1e-5));
    CHECK(near(found.strut[0], each.strut, 1e-3));
    CHECK(near(found.extension[0][1], each.extension, 1e-4));
    CHECK(found.state[0] == taut::JointState::stick);
    CHECK(verify(*tracker).worst() < 1e-10);
  }
}

TEST_CASE("the foot of a pinned strut goes along its arc, and friction is used by tan(lambda) / mu") {
  const double mu = 0.1;
  const auto condensed = std::make_unique<Condensed>(pinned_strut(mu), pulled(2e6));
  auto tracker = std::make_unique<Tracker>();
  REQUIRE(tracker->start(condensed->model).status.ok());
  struct Expected {
    double F, theta;
  };
  for (const Expected& each : {Expected{797508, 0.005}, Expected{1991880, 0.0125}}) {
    REQUIRE(tracker->advance(pulled(each.F)).status.ok());
    const auto found = condensed->displaced(*tracker);
    const double x = 2 * std::sin(each.theta), y = 2 - 2 * std::cos(each.theta);
    CHECK(near(found[0], x, 2e-4));
    CHECK(std::fabs(found[1] - y) <= 1e-7);
    // The angle between the strut and the bisector of the cable's two segments, where the foot is then.
    const double to_l = std::atan2(0.5 - y, 10 + x), to_r = std::atan2(0.5 - y, 10 - x);
    const double lambda = each.theta - (to_r - to_l) / 2;
    CHECK(near(tracker->friction_used(0), std::tan(lambda) / mu, 2e-3));
    CHECK(std::fabs(tracker->bend_change(0) - (std::tan((to_l + to_r) / 2) / 0.05 - 1)) <= 1e-3);
  }
}

TEST_CASE("a strut whose thrust does not go with the tensions leans as its moment about the head says") {
  const auto scene = loaded_pinned_strut(0.1);
  const auto condensed = std::make_unique<Condensed>(scene, pulled(2e6));
  auto tracker = std::make_unique<Tracker>();
  REQUIRE(tracker->start(condensed->model).status.ok());
  const double F = 1.6e6;
  for (const double part : {0.0, 0.3, 1.0, 0.5}) {
    REQUIRE(tracker->advance(pulled(F, part)).status.ok());
    const double load = part * 1e5;
    // Moment about the head of all forces at the foot, the joint stuck: T1 = EA (l1 - L1) / L1.
    double T1 = 0, thrust = 0;
    const auto moment = [&](double lean) {
      const double x = 2 * std::sin(lean), y = 2 - 2 * std::cos(lean);
      const double l1 = std::hypot(10 + x, 0.5 - y), l2 = std::hypot(10 - x, 0.5 - y);
      const double L1 = std::hypot(10, 0.5);
      T1 = EA * (l1 - L1) / L1;
      const double across = -T1 * (10 + x) / l1 + F * (10 - x) / l2;
      const double up = (T1 / l1 + F / l2) * (0.5 - y) - load;
      thrust = -(up * std::cos(lean) - across * std::sin(lean));
      return across * std::cos(lean) + up * std::sin(lean);
    };
    double least = 0, most = 0.05;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (least + most) / 2;
      (moment(middle) > 0 ? least : most) = middle;
    }
    const Response response = condensed->at(*tracker);
    INFO("load ", load);
    // What differs is what the strut's thrust does.
    CHECK(near(response.tension[0] - F, T1 - F, 0.01));
    CHECK(near(response.strut[0], thrust, 0.002));
    CHECK(near(condensed->displaced(*tracker)[0], 2 * std::sin(least), 0.001));
  }
}

TEST_CASE("what pushes of two struts do to each other's lean and thrust is reciprocal") {
  taut::Scene<double, 2, TwoStruts> roof;
  const int l = roof.add_node({0, 0}, taut::held_xy), p = roof.add_node({4, -1}),
            q = roof.add_node({9, -1.5});
  const int r = roof.add_node({14, 0}, taut::held_xy);
  const int t = roof.add_node({4, 1}, taut::held_xy), u = roof.add_node({8.5, 1.2}, taut::held_xy);
  roof.add_strut(p, t, 2.1e11, 1e-3);
  roof.add_strut(q, u, 2.1e11, 2e-3);
  roof.add_cable(cable_with(0.1), {l, p, q, r});
  taut::Sample<double, TwoStruts> target;
  target.jack[0][1].force = 1e6;
  using Roof = taut::SecondOrder<double, TwoStruts>;
  const auto model = std::make_unique<Roof>();
  const auto struts = std::make_unique<Roof::Struts>();
  const auto condensation =
      std::make_unique<taut::SecondOrderCondensation<double, taut::Scene<double, 2, TwoStruts>>>();
  REQUIRE(condensation->run(roof, target, *model, *struts).ok());
  const auto& lean = model->lean;
  const int first = TwoStruts::segments;
  // Maxwell: a unit push of one leans the other by what a unit push of that leans the one.
  CHECK(near(lean.aside_by_push[0][first + 1], lean.aside_by_push[1][first], 1e-9));
  CHECK(std::fabs(lean.aside_by_push[0][first + 1]) > 1e-3 * std::fabs(lean.aside_by_push[0][first]));
  // Betti: a push changes the thrust of its own strut by what lengthening that takes of its lean.
  for (int b = 0; b < 2; ++b) CHECK(near(struts->by_push[b][b], lean.own_aside[first + b], 1e-9));
}

TEST_CASE("displacements of a joint that slides, and how far its cable has straightened") {
  const double mu = 0.1, F = 1.05e6, y = 0.9660582;
  const auto condensed = std::make_unique<Condensed>(guided_joint(mu), pulled(F, 1));
  auto tracker = std::make_unique<Tracker>();
  REQUIRE(tracker->start(condensed->model).status.ok());
  REQUIRE(tracker->advance(pulled(F, 1)).status.ok());
  const auto found = condensed->displaced(*tracker);
  CHECK(found[0] == 0);
  CHECK(near(found[1], 1 - y, 0.01));
  CHECK(near(tracker->bend_change(0), y - 1, 0.05));
  CHECK(near(tracker->friction_used(0), 1, 1e-9));
}

TEST_CASE("a pinned strut runs away at the load where it leans by mu") {
  struct Expected {
    double mu, F;
  };
  for (const Expected& each : {Expected{0.005, 805531}, Expected{0.01, 1609993}}) {
    const auto condensed = std::make_unique<Condensed>(pinned_strut(each.mu), pulled(2e6));
    auto tracker = std::make_unique<Tracker>();
    REQUIRE(tracker->start(condensed->model).status.ok());
    REQUIRE(tracker->advance(pulled(0.98 * each.F)).status.ok());
    const auto progress = tracker->advance(pulled(1.02 * each.F));
    CHECK(progress.status.code == taut::Code::gives_way);
    CHECK(progress.status.place == taut::Place::joint);
    CHECK(progress.status.index == 0);
    CHECK(near(tracker->loads().jack[0][1].force, each.F, 0.005));
  }
}

TEST_CASE("a loaded joint that the cable lifts slides at its limit in the displaced geometry") {
  // 2 F / (1 + mu y / a) y / sqrt(a^2 + y^2) = P
  struct Expected {
    double mu, F, T1, extension, part;
  };
  for (const Expected& each : {Expected{0.1, 1.05e6, 1029906.9, 0.0327271, 0.001},
                               Expected{0.3, 1.1e6, 1039736.2, 0.0386376, 0.001}}) {
    const auto condensed = std::make_unique<Condensed>(guided_joint(each.mu), pulled(each.F, 1));
    auto tracker = std::make_unique<Tracker>();
    REQUIRE(tracker->start(condensed->model).status.ok());
    REQUIRE(tracker->advance(pulled(each.F, 1)).status.ok());
    const Response found = condensed->at(*tracker);
    CHECK(near(found.tension[0], each.T1, 1e-4));
    CHECK(near(found.extension[0][1], each.extension, each.part));
    CHECK(verify(*tracker).worst() < 1e-10);
  }
}

TEST_CASE("in second-order theory forces do not depend on how a straight path is cut") {
  const auto condensed = std::make_unique<Condensed>(pinned_strut(0.1), pulled(2e6));
  auto whole = std::make_unique<Tracker>(), cut = std::make_unique<Tracker>();
  REQUIRE(whole->start(condensed->model).status.ok());
  REQUIRE(cut->start(condensed->model).status.ok());
  for (const double to : {1.7e6, 0.4e6, 0.0, 2.1e6}) {
    const double from = whole->loads().jack[0][1].force;
    REQUIRE(whole->advance(pulled(to)).status.ok());
    for (int i = 1; i <= 37; ++i) REQUIRE(cut->advance(pulled(from + (to - from) * i / 37)).status.ok());
    for (int i = 0; i < 2; ++i) CHECK(std::fabs(whole->tension(i) - cut->tension(i)) <= 1e-9 * 2.1e6);
    CHECK(std::fabs(whole->slip_state().extension[0][1] - cut->slip_state().extension[0][1]) <= 1e-11);
  }
}

TEST_CASE("a mirrored scene in second-order theory has the same forces") {
  const auto one = std::make_unique<Condensed>(pinned_strut(0.1), pulled(2e6));
  const auto other = std::make_unique<Condensed>(pinned_strut(0.1, true), pulled(2e6, 0, 0));
  auto a = std::make_unique<Tracker>(), b = std::make_unique<Tracker>();
  REQUIRE(a->start(one->model).status.ok());
  REQUIRE(b->start(other->model).status.ok());
  for (const double F : {0.7e6, 2e6, 1e6}) {
    REQUIRE(a->advance(pulled(F)).status.ok());
    REQUIRE(b->advance(pulled(F, 0, 0)).status.ok());
    CHECK(near(b->tension(1), a->tension(0), 1e-12));
    CHECK(near(b->slip_state().extension[0][0], a->slip_state().extension[0][1], 1e-11));
  }
}

TEST_CASE("a saved state of second-order theory goes on with the same bits") {
  const auto condensed = std::make_unique<Condensed>(guided_joint(0.2), pulled(1.1e6, 1));
  auto first = std::make_unique<Tracker>(), second = std::make_unique<Tracker>();
  REQUIRE(first->start(condensed->model).status.ok());
  REQUIRE(first->advance(pulled(0.8e6, 0.75)).status.ok());
  REQUIRE(second->restore(condensed->model, first->save()).ok());
  for (const double part : {0.9, 1.0, 0.7}) {
    REQUIRE(first->advance(pulled(1.1e6 * part, part)).status.ok());
    REQUIRE(second->advance(pulled(1.1e6 * part, part)).status.ok());
    for (int i = 0; i < 2; ++i) CHECK(first->tension(i) == second->tension(i));
    CHECK(first->save().anchor.level == second->save().anchor.level);
  }
}

TEST_CASE(
    "derivatives with respect to an error of the jack are those of second-order theory, from zero tension "
    "on") {
  const auto condensed = std::make_unique<Condensed>(pinned_strut(0.1), pulled(2e6));
  const auto friction = [&](int) { return taut::JointFriction<double>{condensed->model.low.rho[0], -1, 0}; };
  const double d = 100;
  for (const auto& error : {taut::JackError<double>{0, 1, 1, 0}, taut::JackError<double>{0, 1, 0, 1}}) {
    auto tracker = std::make_unique<taut::Tracker<Model, 1>>();
    auto other = std::make_unique<Tracker>();
    REQUIRE(
        tracker->start(condensed->model, friction, std::vector<taut::JackError<double>>{error}).status.ok());
    REQUIRE(other->start(condensed->model).status.ok());
    for (const double F : {0.0, 1.2e6, 0.5e6, 1.9e6}) {
      const double by = d * (error.constant + error.proportional * F / 1e6);
      REQUIRE(tracker->advance(pulled(F)).status.ok());
      REQUIRE(other->advance(pulled(F + by)).status.ok());
      const double found = tracker->sensitivity(0, 0) * (error.proportional > 0 ? d / 1e6 : d);
      if (F > 0) CHECK(near(found, other->tension(0) - tracker->tension(0), 0.005));
    }
  }
}

TEST_CASE("a tracker with derivatives has the friction of the displaced geometry, known beforehand or not") {
  const auto condensed = std::make_unique<Condensed>(guided_joint(0.3), pulled(1.1e6, 1));
  auto plain = std::make_unique<Tracker>();
  REQUIRE(plain->start(condensed->model).status.ok());
  REQUIRE(plain->advance(pulled(1.1e6, 1)).status.ok());
  for (const int parameter : {-1, 0}) {
    const auto friction = [&](int) {
      return taut::JointFriction<double>{condensed->model.low.rho[0], parameter, -1};
    };
    auto tracker = std::make_unique<taut::Tracker<Model, 1>>();
    REQUIRE(tracker->start(condensed->model, friction).status.ok());
    REQUIRE(tracker->advance(pulled(1.1e6, 1)).status.ok());
    CHECK(near(tracker->tension(0), plain->tension(0), 1e-12));
    CHECK(near(tracker->rho(0), plain->rho(0), 1e-12));
  }
}

TEST_CASE("two jacks at work over a strut that only its cable holds are refused, for it would run away") {
  Scene scene;
  const int l = scene.add_node({-10, 0.5}, taut::held_xy), p = scene.add_node({0, 0});
  const int r = scene.add_node({10, 0.5}, taut::held_xy), t = scene.add_node({0, 2}, taut::held_xy);
  scene.add_strut(p, t, 2e13, 1);
  auto cable = cable_with(0.1);
  cable.ends = {End::jacked, End::jacked};
  scene.add_cable(cable, {l, p, r});
  Sample target = pulled(1e6);
  target.jack[0][0].force = 1e6;
  const auto condensed = std::make_unique<Condensed>(scene, target);
  auto tracker = std::make_unique<Tracker>();
  REQUIRE(tracker->start(condensed->model).status.ok());
  CHECK_FALSE(tracker->advance(target).status.ok());
  // With one of the strokes prescribed it stands.
  target.jack[0][0] = {0, true};
  REQUIRE(tracker->start(condensed->model).status.ok());
  REQUIRE(tracker->advance(target).status.ok());
  CHECK(verify(*tracker).worst() < 1e-10);
}

namespace {

struct TrussCap : taut::Capacity {
  static constexpr int nodes = 6, struts = 1, cables = 4, segments = 4, joints = 2, loads = 1, forces = 1;
  static constexpr int normals = 1;
};
using TrussModel = taut::SecondOrder<double, TrussCap>;

constexpr double half_span = 20, rise = 1.4, truss_EA = 1.6e8;

// A post between two cables that bulge away from each other, both with prestrain, and a load that lifts it.
// In one piece the cables have a joint on the post.
TrussModel cable_truss(double prestrain, bool in_one_piece) {
  taut::Scene<double, 2, TrussCap> scene;
  const int u = scene.add_node({0, 2 + rise}), d = scene.add_node({0, -2 - rise});
  scene.add_strut(u, d, 2.1e13, 1);
  taut::Cable<double> cable;
  cable.E = truss_EA;
  cable.A = 1;
  cable.mu = 0.1;
  for (const double way : {1.0, -1.0}) {
    const int post = way > 0 ? u : d;
    const int l = scene.add_node({-half_span, 2 * way}, taut::held_xy);
    const int r = scene.add_node({half_span, 2 * way}, taut::held_xy);
    if (in_one_piece) {
      scene.add_cable(cable, {l, post, r});
    } else {
      scene.add_cable(cable, {l, post});
      scene.add_cable(cable, {post, r});
    }
  }
  for (int i = 0; i < scene.prestrain.size(); ++i) scene.prestrain[i] = prestrain;
  scene.add_force(scene.add_load(), u, {0, 1});
  TrussModel model;
  TrussModel::Struts struts;
  const auto condensation =
      std::make_unique<taut::SecondOrderCondensation<double, taut::Scene<double, 2, TrussCap>>>();
  REQUIRE(condensation->run(scene, {}, model, struts).ok());
  return model;
}

// Of a segment over so much of height.
double tension_over(double height, double prestrain) {
  const double L = std::hypot(half_span, rise);
  return truss_EA / L * (std::hypot(half_span, height) - L * (1 - prestrain));
}

// Where the post is under a load.
double lift_of(double load, double prestrain) {
  const auto held = [&](double height) {
    return 2 * tension_over(height, prestrain) * height / std::hypot(half_span, height);
  };
  double least = 0, most = rise;
  for (int i = 0; i < 100; ++i) {
    const double lift = (least + most) / 2;
    (held(rise + lift) - held(rise - lift) < load ? least : most) = lift;
  }
  return least;
}

}  // namespace

TEST_CASE("of two cables that change alike in opposite ways second-order theory has the forces of both") {
  // The sum of all tensions, and that of all bends, hardly change.
  for (const double prestrain : {3e-4, 1e-3})
    for (const bool in_one_piece : {true, false}) {
      const auto model = std::make_unique<TrussModel>(cable_truss(prestrain, in_one_piece));
      const auto tracker = std::make_unique<taut::Tracker<TrussModel>>();
      REQUIRE(tracker->start(*model).status.ok());
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        taut::Sample<double, TrussCap> sample;
        sample.factor[0] = part * 4e7 * prestrain;
        REQUIRE(tracker->advance(sample).status.ok());
        const double lift = lift_of(sample.factor[0], prestrain);
        const double upper = tension_over(rise + lift, prestrain);
        INFO("prestrain ", prestrain, ", in one piece ", in_one_piece, ", load ", sample.factor[0], ", lift ",
             lift);
        CHECK(near(tracker->tension(0), upper, 1e-3));
        CHECK(std::fabs(tracker->tension(2) - tension_over(rise - lift, prestrain)) <= 1e-3 * upper);
        CHECK(verify(*tracker).worst() < 1e-10);
      }
    }
}

TEST_CASE("steps of geometry end at the same place in samples that no event meets and on one path") {
  const auto model = std::make_unique<TrussModel>(cable_truss(1e-3, true));
  const auto whole = std::make_unique<taut::Tracker<TrussModel>>();
  const auto cut = std::make_unique<taut::Tracker<TrussModel>>();
  REQUIRE(whole->start(*model).status.ok());
  REQUIRE(cut->start(*model).status.ok());
  taut::Sample<double, TrussCap> sample;
  constexpr int pieces = 1000;
  for (int i = 1; i <= pieces; ++i) {
    sample.factor[0] = 4e4 * i / pieces;
    REQUIRE(cut->advance(sample).status.ok());
  }
  REQUIRE(whole->advance(sample).status.ok());
  for (int i = 0; i < model->low.segments; ++i) CHECK(near(cut->tension(i), whole->tension(i), 1e-9));
}

}  // namespace second_order_test
