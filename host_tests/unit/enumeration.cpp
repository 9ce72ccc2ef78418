// A reference that knows nothing of the paper's element: all joint states are tried, each with one dense
// system.
#include <Eigen/LU>
#include <string>

#include "support/bench.hpp"
#include "support/equilibrium.hpp"
#include "support/status_check.hpp"

namespace enumeration_test {
using namespace support;

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// One open cable on a plane structure, one load step from rest: unknowns are the displacements, all
/// tensions, the slips and the extension of the jack.
class Enumeration {
 public:
  Enumeration(const Plane& scene, const taut::Sample<double, PlaneCapacity>& sample)
      : scene_(scene), sample_(sample), anatomy_(scene), cable_(scene.cables[0]) {
    number();
    assemble();
  }

  /// The tensions of every combination of states whose solution contradicts nothing.
  std::vector<Vector> solutions() {
    std::vector<Vector> found;
    int combinations = 1;
    for (int j = 0; j < joints(); ++j) combinations *= 3;
    for (int code = 0; code < combinations; ++code) {
      std::vector<int> states;
      for (int j = 0, rest = code; j < joints(); ++j, rest /= 3) states.push_back(rest % 3 - 1);
      const Vector x = solve(states);
      if (agrees(states, x)) found.emplace_back(x.segment(T0_, segments()));
    }
    return found;
  }

 private:
  int joints() const { return cable_.joints(); }
  int segments() const { return cable_.segments(); }
  double ratio(int j) const { return static_cast<double>(anatomy_.ratio(0, j)); }

  void number() {
    for (int i = 0; i < scene_.nodes.size(); ++i)
      for (int axis = 0; axis < 2; ++axis) place_.push_back(scene_.nodes[i].is_held(axis) ? -1 : free_++);
    T0_ = free_;
    slip0_ = T0_ + segments();
    extension_ = slip0_ + joints();
    size_ = extension_ + 1;
  }
  int place(int node, int axis) const { return place_[static_cast<std::size_t>(2 * node + axis)]; }

  /// The elongation of a bar as a row on the displacements.
  Vector elongation(int a, int b) const {
    Vector row = Vector::Zero(size_);
    for (int axis = 0; axis < 2; ++axis) {
      const double along = static_cast<double>(anatomy_.direction(a, b)[axis]);
      if (place(a, axis) >= 0) row[place(a, axis)] -= along;
      if (place(b, axis) >= 0) row[place(b, axis)] += along;
    }
    return row;
  }

  /// Everything but the joint states: equilibrium of the free axes, and the law of every segment.
  void assemble() {
    A_ = Matrix::Zero(size_, size_);
    b_ = Vector::Zero(size_);
    for (const auto& strut : scene_.struts) {
      const Vector row = elongation(strut.nodes[0], strut.nodes[1]);
      const double axial =
          strut.E * strut.A / static_cast<double>(anatomy_.length(strut.nodes[0], strut.nodes[1]));
      A_ += axial * row * row.transpose();
    }
    for (const auto& force : scene_.forces)
      for (int axis = 0; axis < 2; ++axis)
        if (place(force.node, axis) >= 0)
          b_[place(force.node, axis)] +=
              force.force[static_cast<std::size_t>(axis)] * sample_.factor[force.load];
    for (int i = 0; i < segments(); ++i) add_segment(i);
    const bool has_jack = cable_.ends[1] == taut::End::jacked;
    A_(extension_, has_jack ? T0_ + segments() - 1 : extension_) = 1;
    b_[extension_] = has_jack ? sample_.jack[0][1].force : 0;
  }
  void add_segment(int i) {
    const auto ends = scene_.segment_nodes(cable_, i);
    const Vector row = elongation(ends[0], ends[1]);
    const double axial = cable_.E * cable_.A / static_cast<double>(anatomy_.length(ends[0], ends[1]));
    A_.col(T0_ + i) += row;  // pulls on its nodes
    A_.row(T0_ + i) = axial * row.transpose();
    A_(T0_ + i, T0_ + i) = -1;
    if (i < joints()) A_(T0_ + i, slip0_ + i) = axial;
    if (i > 0) A_(T0_ + i, slip0_ + i - 1) = -axial;
    if (i + 1 == segments()) A_(T0_ + i, extension_) = axial;
    b_[T0_ + i] = -cable_.E * cable_.A * scene_.prestrain[i];
  }

  /// 0 sticks, +1 slides forwards (rho T_j+1 = T_j), -1 backwards.
  Vector solve(const std::vector<int>& states) const {
    Matrix A = A_;
    for (int j = 0; j < joints(); ++j) {
      const int state = states[static_cast<std::size_t>(j)];
      if (state == 0) {
        A(slip0_ + j, slip0_ + j) = 1;
      } else {
        A(slip0_ + j, T0_ + j) = state > 0 ? 1 : -ratio(j);
        A(slip0_ + j, T0_ + j + 1) = state > 0 ? -ratio(j) : 1;
      }
    }
    // Displacements, forces and slips differ by orders of magnitude: scale columns, then rows.
    Vector columns = A.cwiseAbs().colwise().maxCoeff().transpose().cwiseInverse();
    A = A * columns.asDiagonal();
    const Vector rows = A.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
    A = rows.asDiagonal() * A;
    return columns.asDiagonal() * A.fullPivLu().solve(rows.asDiagonal() * b_);
  }

  bool agrees(const std::vector<int>& states, const Vector& x) const {
    const double scale = x.segment(T0_, segments()).lpNorm<Eigen::Infinity>();
    const double slip_scale = x.segment(slip0_, joints() + 1).lpNorm<Eigen::Infinity>();
    if (!(x.segment(T0_, segments()).minCoeff() >= -1e-9 * scale)) return false;
    for (int j = 0; j < joints(); ++j) {
      const double T1 = x[T0_ + j], T2 = x[T0_ + j + 1];
      if (std::min(T1, T2) < ratio(j) * std::max(T1, T2) - 1e-9 * scale) return false;
      if (states[static_cast<std::size_t>(j)] * x[slip0_ + j] < -1e-9 * slip_scale) return false;
    }
    return true;
  }

  const Plane& scene_;
  const taut::Sample<double, PlaneCapacity>& sample_;
  Anatomy<Plane> anatomy_;
  const taut::Cable<double>& cable_;
  std::vector<int> place_;
  int free_ = 0, T0_ = 0, slip0_ = 0, extension_ = 0, size_ = 0;
  Matrix A_;
  Vector b_;
};

/// Of several solutions with the same tensions (a joint exactly at its limit) one is meant.
std::vector<Vector> distinct(const std::vector<Vector>& all) {
  std::vector<Vector> kept;
  for (const Vector& one : all) {
    bool known = false;
    for (const Vector& other : kept) known = known || (one - other).norm() <= 1e-7 * other.norm();
    if (!known) kept.push_back(one);
  }
  return kept;
}

/// Compares where the enumeration finds exactly one answer; returns whether it did.
bool compare(const Plane& scene, const taut::Sample<double, PlaneCapacity>& sample, Solver solver,
             bool from_prestrain) {
  const auto found = distinct(Enumeration(scene, sample).solutions());
  REQUIRE(!found.empty());
  if (found.size() > 1) return false;
  Bench<double, Plane> bench(scene, solver);
  REQUIRE(bench.started().code == taut::Code::ok);
  if (!from_prestrain) {
    bench.load(0, sample.factor[0]).load(1, sample.factor[1]).jack(0, 1, sample.jack[0][1].force);
    REQUIRE(bench.go().code == taut::Code::ok);
  }
  CHECK_LAWFUL(bench, double);
  for (int i = 0; i < scene.prestrain.size(); ++i) {
    CAPTURE(i);
    // The dense reference loses digits by the condition number of the structure.
    CHECK(close(bench.T(i), found[0][i], 1e-8, found[0].lpNorm<Eigen::Infinity>()));
  }
  return true;
}

Plane scene;

}  // namespace

SOLVER_TEST_CASE(
    "of all joint states those that contradict nothing are found, for a jack on a loaded structure", solver) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    truss_string(scene, steel_cable(random.between(0.02, 0.8)), 3 + random.below(3), Variation(random));
    taut::Sample<double, PlaneCapacity> sample;
    sample.factor[0] = random.between(-0.5, 2);
    sample.factor[1] = random.between(-0.5, 2);
    sample.jack[0][1].force = random.between(5e4, 3e5);
    compared += compare(scene, sample, solver, false) ? 1 : 0;
  }
  CHECK(compared >= 50);  // the others have more than one answer
}

SOLVER_TEST_CASE("of all joint states those that contradict nothing are found, for uneven prestrain",
                 solver) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(500 + seed);
    truss_string(scene, steel_cable(random.between(0.02, 0.8), anchored), 3 + random.below(3),
                 Variation(random));
    for (double& prestrain : scene.prestrain) prestrain = random.between(1e-3, 3e-3);
    compared += compare(scene, {}, solver, true) ? 1 : 0;
  }
  CHECK(compared >= 50);
}

TEST_CASE("of all joint states those that contradict nothing are found, for a chain over rigid saddles") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(900 + seed);
    rigid_saddles(scene, steel_cable(0.4), chain_points(2 + random.below(4)));
    vary_friction(scene, Variation(random));
    for (double& prestrain : scene.prestrain) prestrain = random.between(0, 1e-3);
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1].force = random.between(5e4, 3e5);
    const auto found = distinct(Enumeration(scene, sample).solutions());
    CHECK(found.size() == 1);  // from rest and in one step the reference has one answer
  }
}

}  // namespace enumeration_test
