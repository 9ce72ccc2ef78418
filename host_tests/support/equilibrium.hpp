// Independent check of an answer, in long double: only the scene, the sample and the answer are used.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/violations.hpp"
#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"

namespace support {

/// Geometry and friction of a scene, afresh from its coordinates.
template <class SceneType>
class Anatomy {
 public:
  static constexpr int dimension = SceneType::dimension;
  using Vector = Eigen::Matrix<Exact, dimension, 1>;

  explicit Anatomy(const SceneType& scene) : scene_(scene) {}

  Vector span(int from, int to) const {
    Vector d;
    for (int axis = 0; axis < dimension; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      d[axis] = Exact(scene_.nodes[to].at[i]) - Exact(scene_.nodes[from].at[i]);
    }
    return d;
  }
  Exact length(int from, int to) const { return span(from, to).norm(); }
  Vector direction(int from, int to) const { return span(from, to) / length(from, to); }

  /// The unit vectors from joint `j` of cable `c` to its neighbours.
  struct Arms {
    Vector e1, e2;
    Exact cos_alpha() const { return (e1 + e2).norm() / 2; }
    Exact sin_alpha() const { return (e2 - e1).norm() / 2; }
  };
  Arms arms(int c, int j) const {
    const auto at = scene_.joint_nodes(scene_.cables[c], j);
    return {direction(at.at, at.before), direction(at.at, at.after)};
  }

  /// Smallest T_small / T_big that friction holds at a joint; 0 if it never slides.
  Exact ratio(int c, int j) const {
    const auto& cable = scene_.cables[c];
    const Arms at = arms(c, j);
    const Exact mu = Exact(scene_.mu[cable.first_joint + j]);
    if (cable.law == taut::FrictionLaw::point) {
      const Exact kappa = mu * at.cos_alpha() / at.sin_alpha();
      return kappa < 1 ? (1 - kappa) / (1 + kappa) : 0;
    }
    const auto nodes = scene_.joint_nodes(cable, j);
    const Exact turning = 2 * std::atan2(at.cos_alpha(), at.sin_alpha());
    const Exact half_lengths = (length(nodes.before, nodes.at) + length(nodes.at, nodes.after)) / 2;
    return std::exp(-mu * (turning + Exact(cable.wobble) * half_lengths));
  }

 private:
  const SceneType& scene_;
};

/// Checks the answers of a solver one after the other. A solver has response() and displacement(node, axis).
template <class SceneType, class Scalar>
class Watch {
 public:
  using Cap = typename SceneType::Capacity;
  using Sample = taut::Sample<Scalar, Cap>;
  using Response = taut::Response<Scalar, Cap>;

  explicit Watch(const SceneType& scene) : scene_(scene), anatomy_(scene) {}

  /// The answer at the end of a path to `sample`. Slips are compared with those of the check before, at first
  /// with none: meaningful if the path in between was one load step. forget_slips() leaves that out.
  template <class Solver>
  Violations check(const Solver& solver, const Sample& sample) {
    now_ = solver.response();
    sample_ = sample;
    found_ = {};
    read_displacements(solver);
    find_forces();
    nodes();
    struts();
    for (int c = 0; c < scene_.cables.size(); ++c) {
      joints(c);
      segments(c);
      slack_runs(c);
      jacks(c);
    }
    before_ = now_;
    has_before_ = true;
    found_.largest_force = largest_;
    return found_;
  }

  void forget_slips() { has_before_ = false; }
  /// Forgets all answers so far, as at the start of a history.
  void restart() {
    before_ = {};
    has_before_ = true;
    largest_ = 0;
  }

 private:
  static constexpr int dimension = SceneType::dimension;
  using Vector = Eigen::Matrix<Exact, dimension, 1>;

  static void keep_worse(Exact& worst, Exact violation) {
    if (std::isnan(violation)) violation = std::numeric_limits<Exact>::infinity();
    worst = std::max(worst, violation);
  }
  Exact tension(int segment) const { return Exact(now_.tension[segment]); }
  Exact part(Exact force) const { return largest_ > 0 ? force / largest_ : force; }

  template <class Solver>
  void read_displacements(const Solver& solver) {
    u_.assign(static_cast<std::size_t>(scene_.nodes.size()), Vector::Zero());
    farthest_ = 0;
    for (int node = 0; node < scene_.nodes.size(); ++node)
      for (int axis = 0; axis < dimension; ++axis) {
        u(node)[axis] = Exact(solver.displacement(node, axis));
        farthest_ = std::max(farthest_, std::fabs(u(node)[axis]));
      }
  }
  Vector& u(int node) { return u_[static_cast<std::size_t>(node)]; }

  /// The largest force so far: of loads, segments, struts, and of prestrain and temperature.
  void find_forces() {
    const auto consider = [this](Exact force) { largest_ = std::max(largest_, std::fabs(force)); };
    for (int i = 0; i < scene_.prestrain.size(); ++i) consider(tension(i));
    for (int i = 0; i < scene_.struts.size(); ++i) consider(Exact(now_.strut[i]));
    for (const auto& given : scene_.forces)
      for (const double force : given.force) consider(Exact(force) * factor(given.load));
    for (int c = 0; c < scene_.cables.size(); ++c)
      for (int i = 0; i < scene_.cables[c].segments(); ++i) consider(locked_in(c, i));
  }
  Exact factor(int load) const { return Exact(sample_.factor[load]); }

  // Equilibrium.

  /// Force on every node, and the largest product it was summed from.
  struct NodeForce {
    Vector sum = Vector::Zero();
    Exact coarsest = 0;
  };

  void nodes() {
    std::vector<NodeForce> force(u_.size());
    const auto at = [&force](int node) -> NodeForce& { return force[static_cast<std::size_t>(node)]; };
    const auto pull = [&](int a, int b, Exact amount) {
      const Vector along = anatomy_.direction(a, b);
      at(a).sum += amount * along;
      at(b).sum -= amount * along;
    };
    for (int i = 0; i < scene_.struts.size(); ++i)
      pull(scene_.struts[i].nodes[0], scene_.struts[i].nodes[1], Exact(now_.strut[i]));
    for (const auto& cable : scene_.cables)
      for (int i = 0; i < cable.segments(); ++i) {
        const auto ends = scene_.segment_nodes(cable, i);
        pull(ends[0], ends[1], tension(cable.first_segment + i));
      }
    for (const auto& given : scene_.forces)
      for (int axis = 0; axis < dimension; ++axis)
        at(given.node).sum[axis] += Exact(given.force[static_cast<std::size_t>(axis)]) * factor(given.load);
    for (const auto& body : scene_.substructures) hold(body, at);
    for (int node = 0; node < scene_.nodes.size(); ++node)
      for (int axis = 0; axis < dimension; ++axis)
        if (!scene_.nodes[node].is_held(axis)) {
          const Exact scale = std::max(largest_, at(node).coarsest);
          keep_worse(found_.imbalance, scale > 0 ? std::fabs(at(node).sum[axis]) / scale : 0);
        }
  }

  template <class At>
  void hold(const taut::Substructure& body, At at) {
    const int size = body.nodes * dimension;
    const auto node = [&](int row) { return scene_.substructure_nodes[body.first_node + row / dimension]; };
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const Exact stiffness = Exact(scene_.substructure_entries[body.first_entry + row * size + column]);
        const Exact force = stiffness * u(node(column))[column % dimension];
        at(node(row)).sum[row % dimension] -= force;
        at(node(row)).coarsest = std::max(at(node(row)).coarsest, std::fabs(force));
      }
  }

  // Elongations.

  Exact stretch(int a, int b) { return anatomy_.direction(a, b).dot(u(b) - u(a)); }

  void struts() {
    for (int i = 0; i < scene_.struts.size(); ++i) {
      const auto& strut = scene_.struts[i];
      const Exact axial = Exact(strut.E) * Exact(strut.A) / anatomy_.length(strut.nodes[0], strut.nodes[1]);
      const Exact force = axial * stretch(strut.nodes[0], strut.nodes[1]);
      const Exact scale = std::max(largest_, axial * farthest_);
      if (scale > 0) keep_worse(found_.strut, std::fabs(force - Exact(now_.strut[i])) / scale);
    }
  }

  /// EA of a cable [N].
  Exact stiffness(int c) const { return Exact(scene_.cables[c].E) * Exact(scene_.cables[c].A); }
  Exact axial(int c, int i) const {
    const auto ends = scene_.segment_nodes(scene_.cables[c], i);
    return stiffness(c) / anatomy_.length(ends[0], ends[1]);
  }
  /// EA x prestrain - EA x alpha x warming [N].
  Exact locked_in(int c, int i) const {
    const auto& cable = scene_.cables[c];
    Exact warming = 0;
    for (const auto& change : scene_.temperatures)
      if (change.cable == c) warming += Exact(change.kelvin) * factor(change.load);
    return stiffness(c) * (Exact(scene_.prestrain[cable.first_segment + i]) - Exact(cable.alpha) * warming);
  }

  /// What a segment's force would be as a bar [N], and the largest of the products it was summed from.
  struct BarForce {
    Exact force = 0, coarsest = 0;
  };
  BarForce bar(int c, int i) {
    const auto& cable = scene_.cables[c];
    const auto ends = scene_.segment_nodes(cable, i);
    const auto joints = SceneType::segment_joints(cable, i);
    const auto& extension = now_.extension[c];
    // A cable end has an extension where a joint has a slip.
    const Exact out = joints[1] >= 0 ? Exact(now_.slip[joints[1]]) : Exact(extension[1]);
    const Exact in = joints[0] >= 0 ? Exact(now_.slip[joints[0]]) : -Exact(extension[0]);
    const Exact k = axial(c, i);
    return {k * (stretch(ends[0], ends[1]) + out - in) + locked_in(c, i),
            std::max(largest_, k * std::max({farthest_, std::fabs(out), std::fabs(in)}))};
  }

  bool locked(int c, int joint) const { return anatomy_.ratio(c, joint - scene_.cables[c].first_joint) <= 0; }

  void segments(int c) {
    const auto& cable = scene_.cables[c];
    for (int i = 0; i < cable.segments(); ++i) {
      const int segment = cable.first_segment + i;
      keep_worse(found_.pushing, part(-tension(segment)));
      const BarForce expected = bar(c, i);
      if (tension(segment) > 0 && expected.coarsest > 0)
        keep_worse(found_.incompatible, std::fabs(expected.force - tension(segment)) / expected.coarsest);
    }
  }

  /// Without tension only the sum over a run, from one anchor or self-locking joint to the next, means
  /// anything.
  void slack_runs(int c) {
    const auto& cable = scene_.cables[c];
    const int n = cable.segments();
    const auto ends_here = [&](int i) {
      const int joint = SceneType::segment_joints(cable, i)[1];
      return joint < 0 || locked(c, joint);
    };
    int first = 0;
    if (cable.closed)
      for (int i = 0; i < n; ++i)
        if (ends_here(i)) first = (i + 1) % n;
    Exact excess = 0, coarsest = 0, flexibility = 0;
    bool all_slack = true;
    for (int k = 0; k < n; ++k) {
      const int i = (first + k) % n;
      const BarForce expected = bar(c, i);
      excess += expected.force / axial(c, i);
      flexibility += 1 / axial(c, i);
      coarsest = std::max(coarsest, expected.coarsest);
      all_slack = all_slack && !(tension(cable.first_segment + i) > 0);
      if (!ends_here(i) && k + 1 < n) continue;
      if (all_slack && coarsest > 0) keep_worse(found_.stretched_but_slack, excess / flexibility / coarsest);
      excess = coarsest = flexibility = 0;
      all_slack = true;
    }
  }

  void jacks(int c) {
    const auto& cable = scene_.cables[c];
    if (cable.closed) return;
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& jack = sample_.jack[c][end];
      if (cable.ends[end] != taut::End::jacked || jack.locked) continue;
      const int segment = cable.first_segment + (end == 0 ? 0 : cable.segments() - 1);
      keep_worse(found_.jack, part(std::fabs(tension(segment) - Exact(jack.force))));
    }
  }

  // Friction.

  void joints(int c) {
    const auto& cable = scene_.cables[c];
    for (int j = 0; j < cable.joints(); ++j) {
      const int joint = cable.first_joint + j;
      const auto at = anatomy_.arms(c, j);
      const auto sides = SceneType::joint_segments(cable, j);
      const Exact T1 = tension(sides[0]), T2 = tension(sides[1]);
      const Exact N = (T1 + T2) * at.cos_alpha(), f = (T2 - T1) * at.sin_alpha();
      keep_worse(found_.contact, part(std::fabs(N - Exact(now_.contact[joint]))));
      keep_worse(found_.contact, part(std::fabs(f - Exact(now_.friction[joint]))));
      const Exact spare = std::min(T1, T2) - anatomy_.ratio(c, j) * std::max(T1, T2);
      keep_worse(found_.beyond_friction, part(-spare));
      const bool slides =
          now_.state[joint] == taut::JointState::forward || now_.state[joint] == taut::JointState::backward;
      const bool forward = now_.state[joint] == taut::JointState::forward;
      const Exact small = forward ? T1 : T2, big = forward ? T2 : T1;
      if (slides) keep_worse(found_.off_limit, part(std::fabs(small - anatomy_.ratio(c, j) * big)));
      if (has_before_) slip(c, j, T2 - T1, spare);
    }
  }

  /// A slip must go towards the larger tension, and only with all friction used up: of each pair of numbers
  /// one must be zero.
  void slip(int c, int j, Exact difference, Exact spare) {
    const int joint = scene_.cables[c].first_joint + j;
    if (before_.state[joint] == taut::JointState::open || now_.state[joint] == taut::JointState::open) return;
    const Exact moved = Exact(now_.slip[joint]) - Exact(before_.slip[joint]);
    const int n = scene_.cables[c].segments();
    const Exact softer = scene_.cables[c].closed ? std::min(axial(c, (j + n - 1) % n), axial(c, j))
                                                 : std::min(axial(c, j), axial(c, j + 1));
    const Exact scale = std::max(largest_, softer * std::fabs(Exact(now_.slip[joint])));
    if (!(scale > 0)) return;
    const Exact slid = softer * std::fabs(moved) / scale;
    const Exact against = (moved > 0 ? -difference : difference) / scale;
    keep_worse(found_.uphill, std::min(slid, against));
    keep_worse(found_.below_limit, std::min(slid, spare / scale));
  }

  const SceneType& scene_;
  Anatomy<SceneType> anatomy_;
  Sample sample_{};
  Response now_{}, before_{};
  bool has_before_ = true;
  Violations found_;
  std::vector<Vector> u_;
  Exact largest_ = 0;
  Exact farthest_ = 0;
};

/// Checks one answer by itself, whatever the path to it.
template <class SceneType, class Solver, class Scalar, class Cap>
Violations check_response(const SceneType& scene, const Solver& solver,
                          const taut::Sample<Scalar, Cap>& sample) {
  Watch<SceneType, Scalar> watch(scene);
  watch.forget_slips();
  return watch.check(solver, sample);
}

}  // namespace support
