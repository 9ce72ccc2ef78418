// The elastic structure with every joint stuck: factored once, solved for loads and imposed elongations.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "taut/condensation/geometric_stiffness.hpp"
#include "taut/condensation/skyline.hpp"
#include "taut/elements/elements.hpp"
#include "taut/numerics/double_word.hpp"
#include "taut/scene/node_order.hpp"
#include "taut/status.hpp"

namespace taut {

/// Linear response, Eq. (7), of struts, beams, substructures and cable segments as bars between nodes.
///
/// Of a node, unknown are its displacements and then, where beams turn with it, the rotations as
/// BeamElement has them.
///
/// Displacements are kept in double words and corrected with residuals taken element by element, so that
/// forces come out to the last digits of Scalar although elongations cancel; a correction costs one
/// substitution.
///
/// `Geometry` is NoGeometry, or a GeometricStiffness: then second-order theory, Eq. (43), with the forces
/// that it holds.
template <class Scalar, class SceneType, class Geometry = NoGeometry>
class Structure {
 public:
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;
  static constexpr int per_node = SceneType::motions_of_node;
  /// Both ends of a beam may have rotations.
  static constexpr int max_unknowns =
      dimension * Cap::nodes +
      (per_node - dimension) * (Cap::nodes < 2 * Cap::beams ? Cap::nodes : 2 * Cap::beams);
  /// Entries of the factor: what the capacity says, or enough for any structure.
  static constexpr int max_profile = Cap::profile > 0 ? Cap::profile : max_unknowns*(max_unknowns + 1) / 2;

  /// Factors the stiffness of a valid scene. Fails with `mechanism`, `ill_conditioned` or, where members
  /// buckle under the forces of the geometric stiffness, `gives_way` (names the node that moves), or
  /// `capacity_exceeded` (Capacity::profile; the amount is what is missing).
  Status make(const SceneType& scene, const Geometry& geometry = {}) {
    scene_ = &scene;
    geometry_ = geometry;
    elements_.make(scene);
    number();
    const int missing = stiffness_.reset(count_, [this](int unknown) { return first_[unknown]; });
    if (missing > 0) return Status::at(Code::capacity_exceeded, Place::none, max_profile, missing);
    assemble();
    const int loose = stiffness_.factor();
    return loose < 0 ? Status::success() : loose_at(loose);
  }

  /// Solves for forces on the nodes [N], given by force(node, axis), and elongations imposed on the segments
  /// [m], given by imposed(segment). Fails with `ill_conditioned` if equilibrium is not reached.
  template <class Forces, class Elongations>
  Status solve(Forces force, Elongations imposed) {
    return solve(force, imposed, [](int) { return Scalar(0); });
  }
  /// And with elongations imposed on struts and, after them, on beams [m]: stretched(number).
  template <class Forces, class Elongations, class Stretches>
  Status solve(Forces force, Elongations imposed, Stretches stretched) {
    for (int i = 0; i < count_; ++i) u_[i] = Word{};
    Scalar before = std::numeric_limits<Scalar>::max();
    for (int round = 0; round < max_corrections; ++round) {
      const Scalar imbalance = residual(force, imposed, stretched);
      if (imbalance <= 2 * epsilon || (round > 2 && imbalance > before / 2)) return judge(imbalance);
      before = imbalance;
      stiffness_.solve(residual_);
      for (int i = 0; i < count_; ++i) u_[i] += Word{residual_[i], 0};
    }
    return judge(residual(force, imposed, stretched));
  }

  /// Force of a segment in the last solution, given its imposed elongation [N]. Exactly zero if nothing
  /// resists the elongations, as where the structure is statically determinate.
  Scalar tension(int segment, Scalar imposed) const {
    return is_unresisted() ? Scalar(0) : force_of(elements_.segments[segment], imposed);
  }
  /// Force of a strut in the last solution, given its imposed elongation [N].
  Scalar strut_force(int strut, Scalar imposed = 0) const {
    return is_unresisted() ? Scalar(0) : force_of(elements_.struts[strut], imposed);
  }
  /// Axial force of a beam in the last solution [N], tension positive.
  Scalar beam_force(int beam) const {
    return is_unresisted() ? Scalar(0) : force_of(elements_.beams[beam], Scalar(0));
  }
  /// Displacement of a node in the last solution [m].
  Scalar node_displacement(int node, int axis) const { return displacement(node, axis).value(); }
  /// Rotation of a node in the last solution [rad]: the one in the plane, in space about an axis. Zero where
  /// no beam turns with it.
  Scalar node_rotation(int node, int axis) const {
    return displacement(node, dimension + axis).value() / elements_.beams[0].arm;
  }

  const Elements<Scalar, SceneType>& elements() const { return elements_; }
  /// Digits lost in the factorization, as their inverse: ill-conditioned towards 1/epsilon.
  Scalar condition() const { return stiffness_.condition(); }

 private:
  using Word = DoubleWord<Scalar>;
  static constexpr bool has_geometry = !std::is_same<Geometry, NoGeometry>::value;
  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  static constexpr Scalar accepted = sizeof(Scalar) == sizeof(float) ? Scalar(2e-6) : Scalar(2e-12);
  static constexpr int max_corrections = 16;

  int segments() const { return scene_->prestrain.size(); }

  void number() {
    NodeOrder<SceneType>& order = order_;
    order.make(*scene_);
    count_ = 0;
    for (int place = 0; place < scene_->nodes.size(); ++place)
      for (int axis = 0; axis < per_node; ++axis) {
        const int node = order.node(place);
        unknown_[node * per_node + axis] = scene_->is_fixed(node, axis) ? -1 : count_++;
      }
    for (int node = 0; node < scene_->nodes.size(); ++node) {
      int leftmost = leftmost_of(node, count_);
      NodeOrder<SceneType>::for_each_neighbour(*scene_, node,
                                               [&](int other) { leftmost = leftmost_of(other, leftmost); });
      for (int axis = 0; axis < per_node; ++axis) {
        const int unknown = unknown_[node * per_node + axis];
        if (unknown >= 0) first_[unknown] = leftmost < unknown ? leftmost : unknown;
      }
    }
  }
  int leftmost_of(int node, int so_far) const {
    for (int axis = 0; axis < per_node; ++axis) {
      const int unknown = unknown_[node * per_node + axis];
      if (unknown >= 0 && unknown < so_far) so_far = unknown;
    }
    return so_far;
  }

  template <class Bar>
  void assemble_bar(const Bar& bar, Scalar tension) {
    auto K = bar.stiffness();
    if constexpr (has_geometry)
      K += lateral_stiffness<Scalar, dimension>(bar.line.direction, tension / bar.line.length);
    else
      static_cast<void>(tension);
    for (int i = 0; i < 2 * dimension; ++i)
      for (int k = 0; k < 2 * dimension; ++k)
        add(unknown_of(bar.nodes, i), unknown_of(bar.nodes, k), K(i, k));
  }
  /// A matrix on the unknowns of both nodes.
  template <class Beam, class Matrix>
  void assemble_beam(const Beam& beam, const Matrix& K) {
    for (int i = 0; i < 2 * per_node; ++i)
      for (int k = 0; k < 2 * per_node; ++k)
        add(unknown_[place_of(beam, i)], unknown_[place_of(beam, k)], K(i, k));
  }
  /// In unknown_, of unknown `i` of a beam.
  template <class Beam>
  static int place_of(const Beam& beam, int i) {
    return beam.nodes[static_cast<std::size_t>(i / per_node)] * per_node + i % per_node;
  }
  int unknown_of(const std::array<int, 2>& nodes, int i) const {
    return unknown_[nodes[static_cast<std::size_t>(i / dimension)] * per_node + i % dimension];
  }
  void add(int row, int column, Scalar value) {
    if (row >= 0 && column >= 0) stiffness_.add(row, column, value);
  }
  void assemble() {
    for (int i = 0; i < scene_->struts.size(); ++i) assemble_bar(elements_.struts[i], geometry_.strut(i));
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i) {
        assemble_beam(elements_.beams[i], elements_.beams[i].stiffness());
        if constexpr (has_geometry)
          assemble_beam(elements_.beams[i], elements_.beams[i].geometric(geometry_.beam(i)));
      }
    for (int i = 0; i < segments(); ++i) assemble_bar(elements_.segments[i], geometry_.segment(i));
    for (int i = 0; i < scene_->substructures.size(); ++i) {
      const SubstructureElement<SceneType> K(*scene_, i);
      for (int row = 0; row < K.size(); ++row)
        for (int column = 0; column < K.size(); ++column)
          add(unknown_[K.node(row) * per_node + K.axis(row)],
              unknown_[K.node(column) * per_node + K.axis(column)], entry(K, row, column));
    }
  }

  /// Of a substructure's matrix, with its own geometric stiffness.
  Scalar entry(const SubstructureElement<SceneType>& K, int row, int column) const {
    return static_cast<Scalar>(K(row, column)) + geometry_.substructure(K.entry(row, column));
  }

  Word displacement(int node, int axis) const {
    const int unknown = unknown_[node * per_node + axis];
    return unknown < 0 ? Word{} : u_[unknown];
  }
  Word elongation(const std::array<int, 2>& nodes, const Line<Scalar, dimension>& line) const {
    Word sum;
    for (int axis = 0; axis < dimension; ++axis)
      sum += line.direction[axis] * (displacement(nodes[1], axis) - displacement(nodes[0], axis));
    return sum;
  }

  template <class Bar>
  Scalar force_of(const Bar& bar, Scalar imposed) const {
    return (bar.axial * (elongation(bar.nodes, bar.line) + Word{imposed, 0})).value();
  }
  /// Whether all forces are rounding of what they were summed from.
  bool is_unresisted() const { return largest_ <= 16 * epsilon * epsilon * coarsest_; }

  void push(int node, int axis, Scalar force) {
    const int unknown = unknown_[node * per_node + axis];
    largest_ = std::fmax(largest_, std::fabs(force));
    if (unknown >= 0) residual_[unknown] += force;
  }
  /// What a bar under tension adds when it leans.
  template <class Bar>
  void pull_aside(const Bar& bar, Scalar tension) {
    const Word along = elongation(bar.nodes, bar.line);
    for (int axis = 0; axis < dimension; ++axis) {
      Word aside;
      aside += displacement(bar.nodes[1], axis) - displacement(bar.nodes[0], axis);
      aside += -bar.line.direction[axis] * along;
      const Scalar force = (tension / bar.line.length * aside).value();
      push(bar.nodes[0], axis, force);
      push(bar.nodes[1], axis, -force);
    }
  }
  template <class Bar>
  void pull(const Bar& bar, Scalar imposed, Scalar tension) {
    if constexpr (has_geometry)
      pull_aside(bar, tension);
    else
      static_cast<void>(tension);
    const Scalar force = force_of(bar, imposed);
    for (const int node : bar.nodes)
      for (int axis = 0; axis < dimension; ++axis)
        coarsest_ = std::fmax(coarsest_, bar.axial * std::fabs(displacement(node, axis).hi));
    for (int axis = 0; axis < dimension; ++axis) {
      push(bar.nodes[0], axis, bar.line.direction[axis] * force);
      push(bar.nodes[1], axis, -bar.line.direction[axis] * force);
    }
  }

  template <class Beam>
  auto displacements_of(const Beam& beam) const {
    return [this, &beam](int i) { return displacement(place_of(beam, i) / per_node, i % per_node); };
  }
  template <class Beam>
  void bend(const Beam& beam) {
    const auto forces = beam.end_forces(displacements_of(beam));
    for (int i = 0; i < 2 * per_node; ++i) {
      const int node = place_of(beam, i) / per_node, axis = i % per_node;
      coarsest_ = std::fmax(coarsest_, beam.stiffest * std::fabs(displacement(node, axis).hi));
      push(node, axis, -forces[static_cast<std::size_t>(i)]);
    }
  }

  /// An imposed elongation of a beam, in its axial force alone.
  template <class Beam>
  void push_apart(const Beam& beam, Scalar imposed) {
    for (int axis = 0; axis < dimension; ++axis) {
      const Scalar force = beam.axial * imposed * beam.line.direction[axis];
      push(beam.nodes[0], axis, force);
      push(beam.nodes[1], axis, -force);
    }
  }

  /// What a beam under tension adds when it leans and bends.
  template <class Beam>
  void bend_aside(const Beam& beam, Scalar tension) {
    const auto K = beam.geometric(tension);
    for (int i = 0; i < 2 * per_node; ++i) {
      Word force;
      for (int k = 0; k < 2 * per_node; ++k)
        force += K(i, k) * displacement(place_of(beam, k) / per_node, k % per_node);
      push(place_of(beam, i) / per_node, i % per_node, -force.value());
    }
  }

  /// Puts loads minus element forces into residual_; returns the largest part relative to the largest force,
  /// or zero if there is none but rounding.
  template <class Forces, class Elongations, class Stretches>
  Scalar residual(Forces force, Elongations imposed, Stretches stretched) {
    largest_ = coarsest_ = 0;
    for (int i = 0; i < count_; ++i) residual_[i] = 0;
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < dimension; ++axis) push(node, axis, force(node, axis));
    for (int i = 0; i < scene_->struts.size(); ++i)
      pull(elements_.struts[i], stretched(i), geometry_.strut(i));
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i) {
        bend(elements_.beams[i]);
        push_apart(elements_.beams[i], stretched(scene_->struts.size() + i));
        if constexpr (has_geometry) bend_aside(elements_.beams[i], geometry_.beam(i));
      }
    for (int i = 0; i < segments(); ++i) pull(elements_.segments[i], imposed(i), geometry_.segment(i));
    for (int i = 0; i < scene_->substructures.size(); ++i) {
      const SubstructureElement<SceneType> K(*scene_, i);
      for (int row = 0; row < K.size(); ++row) {
        Word held;
        for (int column = 0; column < K.size(); ++column)
          held += entry(K, row, column) * displacement(K.node(column), K.axis(column));
        push(K.node(row), K.axis(row), -held.value());
      }
    }
    Scalar most = 0;
    for (int i = 0; i < count_; ++i) most = std::fmax(most, std::fabs(residual_[i]));
    return most > 0 && !is_unresisted() ? most / largest_ : Scalar(0);
  }

  Status judge(Scalar imbalance) const {
    if (imbalance <= accepted) return Status::success();
    int worst = 0;
    Scalar most = 0;
    for (int i = 0; i < scene_->nodes.size() * per_node; ++i) {
      if (unknown_[i] < 0 || std::fabs(residual_[unknown_[i]]) <= most) continue;
      most = std::fabs(residual_[unknown_[i]]);
      worst = i / per_node;
    }
    return Status::at(Code::ill_conditioned, Place::node, worst);
  }

  /// Tells a node that nothing holds from one that the forces of the geometric stiffness push away, and from
  /// one that this scalar type cannot resolve: a mechanism strains nothing, and what is pushed away buckles
  /// members.
  Status loose_at(int unknown) {
    stiffness_.null_vector(unknown, residual_);
    for (int i = 0; i < count_; ++i) u_[i] = Word{residual_[i], 0};
    int mover = 0;
    Scalar most = 0, strained = 0;
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < per_node; ++axis)
        if (std::fabs(displacement(node, axis).hi) > most) {
          most = std::fabs(displacement(node, axis).hi);
          mover = node;
        }
    for (int i = 0; i < scene_->struts.size(); ++i) {
      const auto& bar = elements_.struts[i];
      strained = std::fmax(strained, std::fabs(elongation(bar.nodes, bar.line).value()));
    }
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i) {
        const auto& beam = elements_.beams[i];
        strained = std::fmax(strained, beam.largest_deformation(displacements_of(beam)));
      }
    for (int i = 0; i < segments(); ++i) {
      const auto& bar = elements_.segments[i];
      strained = std::fmax(strained, std::fabs(elongation(bar.nodes, bar.line).value()));
    }
    const auto moved = [this](int node, int axis) { return displacement(node, axis).hi; };
    strained = std::fmax(strained, static_cast<Scalar>(largest_strain(*scene_, moved)));
    const bool free = strained <= std::sqrt(epsilon) * most;
    const bool buckles = has_geometry && stiffness_.is_negative();
    return Status::at(free      ? Code::mechanism
                      : buckles ? Code::gives_way
                                : Code::ill_conditioned,
                      Place::node, mover);
  }

  const SceneType* scene_ = nullptr;
  Geometry geometry_;
  Elements<Scalar, SceneType> elements_;
  NodeOrder<SceneType> order_;
  Skyline<Scalar, max_unknowns, max_profile> stiffness_;
  FixedArray<int, per_node * Cap::nodes> unknown_;
  FixedArray<int, max_unknowns> first_;
  FixedArray<Word, max_unknowns> u_;
  FixedArray<Scalar, max_unknowns> residual_;
  Scalar largest_ = 0;   // force
  Scalar coarsest_ = 0;  // stiffness x displacement: of these, forces are small differences
  int count_ = 0;
};

}  // namespace taut
