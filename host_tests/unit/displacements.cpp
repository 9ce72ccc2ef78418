// Displacements from the rows that condensation gives on request.
#include <cmath>
#include <memory>

#include "support/bench.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/tracking/tracker.hpp"

namespace displacements_test {
using namespace support;

namespace {

/// The capacity with room for displacements.
template <class Cap, int Count>
struct With : Cap {
  static constexpr int displacements = Count;
};

struct Foot : taut::Capacity {
  static constexpr int nodes = 4, struts = 2, segments = 2, joints = 1, loads = 1, forces = 1;
  static constexpr int displacements = 3;
};

Plane scene;

/// How close displacements are to be, relative to the largest.
template <class Scalar>
constexpr double rounding = sizeof(Scalar) == sizeof(float) ? 1e-6 : 1e-12;

// What is not asked for takes no room: not in flash, not while condensing, not in the tracker.
template <class Scalar, int Dimension, class Cap>
constexpr bool is_free_of_charge() {
  using Bare = taut::Condensed<Scalar, With<Cap, 0>>;
  using Full = taut::Condensed<Scalar, With<Cap, 40>>;
  using Condensing = taut::Condensation<Scalar, taut::Scene<double, Dimension, With<Cap, 0>>>;
  using CondensingFull = taut::Condensation<Scalar, taut::Scene<double, Dimension, With<Cap, 40>>>;
  return sizeof(Bare) == sizeof(Full) && sizeof(Condensing) == sizeof(CondensingFull) &&
         sizeof(taut::Tracker<Bare>) == sizeof(taut::Tracker<Full>);
}
static_assert(is_free_of_charge<float, 2, PlaneCapacity>(), "a structure in the plane");
static_assert(is_free_of_charge<double, 3, SpaceCapacity>(), "a structure in space");
static_assert(is_free_of_charge<float, 2, taut::Capacity>(), "rigid saddles");

template <class Cap>
constexpr std::size_t row_bytes = sizeof(taut::CondensedDisplacements<float, Cap>::rows);
static_assert(row_bytes<With<PlaneCapacity, 0>> < 4 * sizeof(double), "without a request there are no rows");
static_assert(row_bytes<With<taut::Capacity, 40>> == row_bytes<taut::Capacity>, "nor between rigid saddles");

/// Follows `scene` with the tracker, and with stepwise in load steps.
template <class Scalar>
class Pair {
 public:
  Pair() : tracker_(scene, Solver::tracker), stepwise_(scene, Solver::stepwise) {
    REQUIRE(tracker_.started().ok());
    REQUIRE(stepwise_.started().ok());
  }

  /// The largest difference of a displacement after this row, relative to the largest displacement.
  double follow(double down, double up_left, double jack, int substeps) {
    REQUIRE(tracker_.load(0, down).load(1, up_left).jack(0, 1, jack).go().ok());
    REQUIRE(stepwise_.load(0, down).load(1, up_left).jack(0, 1, jack).go(substeps).ok());
    double most = 0, off = 0;
    for (int node = 0; node < scene.nodes.size(); ++node)
      for (int axis = 0; axis < 2; ++axis) {
        const double expected = stepwise_.displacement(node, axis);
        most = std::fmax(most, std::fabs(expected));
        off = std::fmax(off, std::fabs(tracker_.displacement(node, axis) - expected));
      }
    REQUIRE(most > 0);
    return off / most;
  }
  double T(int segment) const { return stepwise_.T(segment); }
  double slip(int joint) const { return stepwise_.slip(joint); }

 private:
  Bench<Scalar, Plane> tracker_;
  Bench<double, Plane> stepwise_;
};

}  // namespace

TEST_CASE_TEMPLATE("a loaded foot moves as its bars let it", Scalar, float, double) {
  constexpr double k_x = steel * 1e-4 / 4, k_y = steel * 2e-4 / 2, k_cable = cable_E * cable_A / 2;
  taut::Scene<double, 2, Foot> hung;
  const int hinge = hung.add_node({1, 1}, taut::held_xy), roller = hung.add_node({0, 0}, taut::held_xy);
  const int wall = hung.add_node({-4, -2}, taut::held_xy), foot = hung.add_node({0, -2});
  hung.add_strut(wall, foot, steel, 1e-4);
  hung.add_strut(roller, foot, steel, 2e-4);
  taut::Cable<double> cable = steel_cable(0.2, anchored);
  cable.prestrain = 1e-4;
  hung.add_cable(cable, {hinge, roller, foot});
  hung.add_force(hung.add_load(), foot, {500, -1000});

  taut::CondensedDisplacements<Scalar, Foot> rows;
  CHECK(rows.add(foot, 1) == 0);
  CHECK(rows.add(foot, 0) == 1);
  CHECK(rows.add(roller, 1) == 2);
  taut::Condensation<Scalar, decltype(hung)> condensation;
  taut::Condensed<Scalar, Foot> model;
  REQUIRE(condensation.run(hung, model, nullptr, &rows).ok());

  taut::Drive<double, Foot> drive;
  taut::FixedArray<double, Foot::segments> e;
  taut::FixedArray<Scalar, Foot::displacements> u;
  for (const double factor : {0.0, 3.0, -2.0})
    for (const double prestrain : {0.0, 1.0})
      for (const double lengthened : {0.0, 1e-4}) {
        drive.factor[0] = factor;
        drive.prestrain = prestrain;
        e[0] = 5e-3;  // between two held nodes
        e[1] = lengthened;
        rows.evaluate(model, drive, e, u);
        const double up = k_cable * (lengthened + prestrain * cable.prestrain * 2) - 1000 * factor;
        const double tolerance = sizeof(Scalar) == sizeof(float) ? 1e-7 : 1e-14;
        CHECK(close(static_cast<double>(u[0]), up / (k_y + k_cable), tolerance, 1e-4));
        CHECK(close(static_cast<double>(u[1]), 500 * factor / k_x, tolerance, 1e-4));
        CHECK(u[2] == 0);
      }
}

TEST_CASE_TEMPLATE("nodes move as stepwise says while the joints slide to and fro", Scalar, float, double) {
  taut::Cable<double> cable = steel_cable(0.2);
  cable.prestrain = 2e-4;
  truss_string(scene, cable, 6);
  Pair<Scalar> pair;
  const double rows[][3] = {{0, 0, 1.5e5}, {1, 0, 2e5}, {1, 0.5, 1e5}, {0.5, 1, 2.4e5}};
  for (const auto& row : rows) {
    CAPTURE(row[2]);
    CHECK(pair.follow(row[0], row[1], row[2], 64) <= rounding<Scalar>);
    CHECK(pair.slip(4) != 0);
  }
}

TEST_CASE_TEMPLATE("nodes move as stepwise says while the cable is slack, and when it is taut again", Scalar,
                   float, double) {
  taut::Cable<double> cable = steel_cable(0, anchored);
  cable.prestrain = 2e-4;
  truss_string(scene, cable, 6);
  Pair<Scalar> pair;
  CHECK(pair.follow(0, 8, 0, 1) <= rounding<Scalar>);
  CHECK(pair.T(0) == 0);
  CHECK(pair.follow(1, 0, 0, 1) <= rounding<Scalar>);
  CHECK(pair.T(0) > 0);
}

TEST_CASE("between rigid saddles nothing moves") {
  using Cap = With<taut::Capacity, 4>;
  taut::Scene<double, 2, Cap> saddles;
  rigid_saddles(saddles, steel_cable(0.2), chain_points(4));
  taut::Condensation<double, decltype(saddles)> condensation;
  taut::Condensed<double, Cap> model;
  taut::CondensedDisplacements<double, Cap> rows;
  rows.add(2, 1);
  REQUIRE(condensation.run(saddles, model, nullptr, &rows).ok());
  taut::FixedArray<double, 4> u;
  u.fill(1);
  taut::FixedArray<double, Cap::segments> e;
  e.fill(1e-3);
  rows.evaluate(model, taut::Drive<double, Cap>{}, e, u);
  for (int i = 0; i < 4; ++i) CHECK(u[i] == 0);
}

TEST_CASE("a displacement that the scene does not have is refused by its node") {
  truss_string(scene, steel_cable(0.2), 6);
  const auto condensation = std::make_unique<taut::Condensation<double, Plane>>();
  const auto model = std::make_unique<taut::Condensed<double, PlaneCapacity>>();
  for (const taut::NodeAxis wrong : {taut::NodeAxis{3, 2}, {3, -1}, {scene.nodes.size(), 0}, {-1, 0}}) {
    taut::CondensedDisplacements<double, PlaneCapacity> rows;
    rows.add(wrong.node, wrong.axis);
    const taut::Status status = condensation->run(scene, *model, nullptr, &rows);
    CHECK(status.code == taut::Code::out_of_range);
    CHECK(status.place == taut::Place::node);
    CHECK(status.index == wrong.node);
  }
  taut::CondensedDisplacements<double, PlaneCapacity> rows;
  for (int i = 0; i < PlaneCapacity::displacements + 3; ++i) rows.add(0, 0);
  const taut::Status status = condensation->run(scene, *model, nullptr, &rows);
  CHECK(status.code == taut::Code::capacity_exceeded);
  CHECK(status.amount == 3);
}

}  // namespace displacements_test
