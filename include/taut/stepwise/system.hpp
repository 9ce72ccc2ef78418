// The global saddle-point system of the paper: assembly, residual, solution.
#pragma once

#include <cmath>
#include <limits>

#include "taut/elements/elements.hpp"
#include "taut/numerics/band_lu.hpp"
#include "taut/numerics/double_word.hpp"
#include "taut/status.hpp"
#include "taut/stepwise/numbering.hpp"
#include "taut/stepwise/situation.hpp"

namespace taut {

/// Displacements of structure and cable and internal forces of the joints under a given situation.
///
/// Section 2.5 assembled with the bars. The solution is kept in double words and corrected with a residual
/// that is taken element by element, so that the forces are in equilibrium to the last digits of Scalar
/// however much the elongations cancel in the displacements; the factorization only needs a condition number
/// below 1/epsilon.
template <class Scalar, class SceneType>
class System {
 public:
  using Cap = typename SceneType::Capacity;
  using Word = DoubleWord<Scalar>;
  using Assumed = Situation<Scalar, Cap>;
  using Loads = Drive<Scalar, Cap>;
  static constexpr int dimension = SceneType::dimension;

  void make(const SceneType& scene) {
    scene_ = &scene;
    elements_.make(scene);
    numbering_.make(scene);
    peak_ = 0;
    stiffest_ = 0;
    for (int i = 0; i < scene.struts.size(); ++i) stiffest_ = std::fmax(stiffest_, elements_.struts[i].axial);
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene.beams.size(); ++i)
        stiffest_ = std::fmax(stiffest_, elements_.beams[i].stiffest);
    for (int i = 0; i < segments(); ++i) stiffest_ = std::fmax(stiffest_, elements_.segments[i].axial);
    for (const auto entry : scene.substructure_entries)
      stiffest_ = std::fmax(stiffest_, std::fabs(static_cast<Scalar>(entry)));
  }

  const Elements<Scalar, SceneType>& elements() const { return elements_; }
  /// A lower bound of the scaled condition number of the last system.
  Scalar condition() const { return lu_.pivot_ratio(); }

  /// Solves for one situation. Fails with `mechanism` (names the node that can move) or `ill_conditioned`.
  Status solve(const Assumed& assumed, const Loads& loads) {
    assemble(assumed, loads);
    const int singular = lu_.factor();
    if (singular >= 0) return singular_at(singular, assumed, loads);
    for (int i = 0; i < numbering_.count(); ++i) x_[i] = Word{};
    Scalar before = std::numeric_limits<Scalar>::max();
    for (int round = 0; round < max_corrections; ++round) {
      const Scalar imbalance = residual(assumed, loads);
      if (imbalance <= 2 * epsilon || (round > 2 && imbalance > before / 2)) return judge(imbalance);
      before = imbalance;
      lu_.solve(correction_);
      for (int i = 0; i < numbering_.count(); ++i) x_[i] += Word{correction_[i], 0};
    }
    return judge(residual(assumed, loads));
  }

  /// Takes the last solution as the state reached: forces below its rounding count as zero from now on.
  void accept() { peak_ = std::fmax(peak_, force_scale_); }

  // What a solution holds.

  /// The largest force in the structure, now or in a state accepted before [N].
  Scalar force_scale() const { return std::fmax(peak_, force_scale_); }
  /// Displacement of a node of the structure along an axis [m].
  Scalar node_displacement(int node, int axis) const { return displacement(node, axis).value(); }
  Scalar strut_force(int strut) const {
    const auto& bar = elements_.struts[strut];
    return (bar.axial * elongation(bar)).value();
  }
  /// Tension a segment would have as a bar, also if it is slack or its force prescribed [N].
  Scalar bar_force(int segment, const Loads& loads) const { return elastic_force(segment, loads).value(); }
  /// Elongation of a segment between its ends, from displacements alone [m].
  Scalar bar_elongation(int segment) const { return elongation(elements_.segments[segment]).value(); }
  Scalar internal_force(int joint, int i) const { return x_[numbering_.internal_force(joint, i)].value(); }
  /// v_s (paper, Eq. (8)) [m].
  Scalar tangential(int joint) const { return relative(joint, 1).value(); }
  /// Force in a segment under the situation: elastic, prescribed or none [N].
  Scalar tension(int segment, const Assumed& assumed, const Loads& loads) const {
    const SegmentLaw law = law_of(segment, assumed, loads);
    return law == SegmentLaw::elastic ? bar_force(segment, loads) : prescribed_force(segment, law, loads);
  }
  bool is_prescribed(int segment, const Loads& loads) const { return jack_of(segment, loads) != nullptr; }

 private:
  using Point = Eigen::Matrix<Scalar, dimension, 1>;
  static constexpr int per_node = SceneType::motions_of_node;
  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  static constexpr Scalar accepted = sizeof(Scalar) == sizeof(float) ? Scalar(2e-6) : Scalar(2e-12);
  static constexpr int max_corrections = 12;
  enum class SegmentLaw { elastic, prescribed, slack };

  int segments() const { return scene_->prestrain.size(); }
  int joints() const { return scene_->mu.size(); }

  // Forces of the elements.

  /// The unlocked jack at one end of a segment, if there is one.
  const typename Loads::JackedEnd* jack_of(int segment, const Loads& loads) const {
    const auto& element = elements_.segments[segment];
    const auto& cable = scene_->cables[element.cable];
    if (cable.closed) return nullptr;
    for (std::size_t end = 0; end < 2; ++end)
      if (element.joints[end] < 0 && cable.ends[end] == End::jacked && !loads.jack[element.cable][end].locked)
        return &loads.jack[element.cable][end];
    return nullptr;
  }

  SegmentLaw law_of(int segment, const Assumed& assumed, const Loads& loads) const {
    if (is_prescribed(segment, loads)) return SegmentLaw::prescribed;
    return assumed.slack[segment] ? SegmentLaw::slack : SegmentLaw::elastic;
  }
  Scalar prescribed_force(int segment, SegmentLaw law, const Loads& loads) const {
    return law == SegmentLaw::prescribed ? jack_of(segment, loads)->force : Scalar(0);
  }

  Word displacement(int node, int axis) const {
    const int unknown = numbering_.displacement(node, axis);
    return unknown < 0 ? Word{} : x_[unknown];
  }
  Word end_displacement(const StrutElement<Scalar, dimension>& bar, std::size_t end, int axis) const {
    return displacement(bar.nodes[end], axis);
  }
  Word end_displacement(const CableElement<Scalar, dimension>& bar, std::size_t end, int axis) const {
    return bar.joints[end] < 0 ? displacement(bar.nodes[end], axis)
                               : x_[numbering_.cable_point(bar.joints[end], axis)];
  }
  template <class Bar>
  Word elongation(const Bar& bar) const {
    Word sum;
    for (int axis = 0; axis < dimension; ++axis)
      sum += bar.line.direction[axis] * (end_displacement(bar, 1, axis) - end_displacement(bar, 0, axis));
    return sum;
  }
  Word elastic_force(int segment, const Loads& loads) const {
    const auto& bar = elements_.segments[segment];
    Word stretch = elongation(bar);
    for (std::size_t end = 0; end < 2; ++end)
      if (bar.joints[end] < 0) stretch += Word{loads.jack[bar.cable][end].extension, 0};
    return bar.axial * stretch + Word{locked_in_force(segment, loads), 0};
  }
  /// Force at zero elongation: prestrain and temperature [N].
  Scalar locked_in_force(int segment, const Loads& loads) const {
    const auto& bar = elements_.segments[segment];
    return bar.initial * loads.prestrain - bar.thermal * warming(bar.cable, loads);
  }
  Scalar warming(int cable, const Loads& loads) const {
    Scalar kelvin = 0;
    for (const auto& change : scene_->temperatures)
      if (change.cable == cable) kelvin += static_cast<Scalar>(change.kelvin) * loads.factor[change.load];
    return kelvin;
  }
  /// Relative displacement of node 4 to node 3 along element axis `i` (paper, Eq. (12)).
  Word relative(int joint, int i) const {
    const auto& element = elements_.joints[joint];
    const Point along = element.axis(i);
    Word sum;
    for (int axis = 0; axis < dimension; ++axis)
      sum += along[axis] * (displacement(element.node, axis) - x_[numbering_.cable_point(joint, axis)]);
    return sum;
  }

  // Assembly.

  int end_unknown(const StrutElement<Scalar, dimension>& bar, std::size_t end, int axis) const {
    return numbering_.displacement(bar.nodes[end], axis);
  }
  int end_unknown(const CableElement<Scalar, dimension>& bar, std::size_t end, int axis) const {
    return bar.joints[end] < 0 ? numbering_.displacement(bar.nodes[end], axis)
                               : numbering_.cable_point(bar.joints[end], axis);
  }
  void add(int row, int column, Scalar value) {
    if (row >= 0 && column >= 0 && value != 0) lu_.add(row, column, value);
  }
  template <class Bar>
  std::array<int, 2 * dimension> bar_unknowns(const Bar& bar) const {
    std::array<int, 2 * dimension> unknowns{};
    for (int i = 0; i < 2 * dimension; ++i)
      unknowns[static_cast<std::size_t>(i)] = end_unknown(bar, i < dimension ? 0 : 1, i % dimension);
    return unknowns;
  }
  template <class Beam>
  std::array<int, 2 * per_node> beam_unknowns(const Beam& beam) const {
    std::array<int, 2 * per_node> unknowns{};
    for (int i = 0; i < 2 * per_node; ++i)
      unknowns[static_cast<std::size_t>(i)] =
          numbering_.displacement(beam.nodes[static_cast<std::size_t>(i / per_node)], i % per_node);
    return unknowns;
  }
  template <class Beam>
  auto beam_displacements(const Beam& beam) const {
    return [this, unknowns = beam_unknowns(beam)](int i) {
      const int unknown = unknowns[static_cast<std::size_t>(i)];
      return unknown < 0 ? Word{} : x_[unknown];
    };
  }
  template <class Unknowns, class Matrix>
  void add_element(const Unknowns& unknowns, const Matrix& K) {
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      for (std::size_t k = 0; k < unknowns.size(); ++k)
        add(unknowns[i], unknowns[k], K(static_cast<int>(i), static_cast<int>(k)));
  }

  void assemble(const Assumed& assumed, const Loads& loads) {
    lu_.reset(numbering_.count(), numbering_.band());
    for (int i = 0; i < scene_->struts.size(); ++i)
      add_element(bar_unknowns(elements_.struts[i]), elements_.struts[i].stiffness());
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i)
        add_element(beam_unknowns(elements_.beams[i]), elements_.beams[i].stiffness());
    for (int i = 0; i < scene_->substructures.size(); ++i) {
      const SubstructureElement<SceneType> K(*scene_, i);
      for (int row = 0; row < K.size(); ++row)
        for (int column = 0; column < K.size(); ++column)
          add(numbering_.displacement(K.node(row), K.axis(row)),
              numbering_.displacement(K.node(column), K.axis(column)), static_cast<Scalar>(K(row, column)));
    }
    for (int i = 0; i < segments(); ++i)
      if (law_of(i, assumed, loads) == SegmentLaw::elastic)
        add_element(bar_unknowns(elements_.segments[i]), elements_.segments[i].stiffness());
    set_scales();
    for (int joint = 0; joint < joints(); ++joint) add_joint(joint, assumed, loads);
  }

  /// Columns are scaled to displacements that change forces by the same amount.
  void set_scales() {
    for (int node = 0; node < scene_->nodes.size(); ++node) {
      set_point_scale([this, node](int axis) { return numbering_.displacement(node, axis); });
      if constexpr (per_node > dimension)
        set_point_scale([this, node](int axis) {
          return dimension + axis < per_node ? numbering_.displacement(node, dimension + axis) : -1;
        });
    }
    for (int joint = 0; joint < joints(); ++joint) {
      const Scalar scale =
          set_point_scale([this, joint](int axis) { return numbering_.cable_point(joint, axis); });
      for (int i = 0; i < dimension; ++i)
        lu_.set_column_scale(numbering_.internal_force(joint, i), Scalar(1) / scale);
    }
  }
  /// One scale for all axes of a point: an axis without stiffness of its own may have some from rounding.
  template <class UnknownOf>
  Scalar set_point_scale(UnknownOf unknown_of) {
    Scalar stiffness = 0;
    for (int axis = 0; axis < dimension; ++axis)
      if (unknown_of(axis) >= 0) stiffness = std::fmax(stiffness, lu_.diagonal(unknown_of(axis)));
    const Scalar scale = Scalar(1) / std::sqrt(stiffness > 0 ? stiffness : stiffest_);
    for (int axis = 0; axis < dimension; ++axis)
      if (unknown_of(axis) >= 0) lu_.set_column_scale(unknown_of(axis), scale);
    return scale;
  }

  void add_joint(int joint, const Assumed& assumed, const Loads& loads) {
    const auto& element = elements_.joints[joint];
    std::array<int, FrictionElement<Scalar, dimension>::unknowns> unknowns{};
    for (int axis = 0; axis < dimension; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      unknowns[i] = numbering_.cable_point(joint, axis);
      unknowns[i + dimension] = numbering_.displacement(element.node, axis);
      unknowns[i + 2 * dimension] = numbering_.internal_force(joint, axis);
    }
    switch (assumed.contact[joint]) {
      case Contact::fixed:
        add_element(unknowns, element.fixed_stiffness());
        break;
      case Contact::sliding:
        if (element.law == FrictionLaw::point) {
          add_element(unknowns, element.sliding_stiffness_at_limit(assumed.direction[joint]));
        } else {
          add_element(unknowns, element.sliding_stiffness_at_limit(Scalar(0)));
          add_capstan_limit(joint, assumed, loads);
        }
        break;
      case Contact::separated:
        add_element(unknowns, element.separated_stiffness());
        // A slack cable's point has no place of its own: it goes with the node.
        for (int axis = 0; axis < dimension; ++axis) {
          const int point = numbering_.cable_point(joint, axis);
          add(point, point, stiffest_);
          add(point, numbering_.displacement(element.node, axis), -stiffest_);
        }
        break;
    }
  }

  /// Capstan: sigma_s = direction kappa sin(alpha) (T1 + T2), the tensions by their segments' displacements,
  /// since a straight duct with wobble has friction without sigma_n.
  void add_capstan_limit(int joint, const Assumed& assumed, const Loads& loads) {
    const auto& element = elements_.joints[joint];
    const int row = numbering_.internal_force(joint, 1);
    const Scalar limit = assumed.direction[joint] * element.limit.kappa * element.frame.sin_alpha;
    for (const int segment : element.segments) {
      if (law_of(segment, assumed, loads) != SegmentLaw::elastic) continue;
      const auto& bar = elements_.segments[segment];
      for (int axis = 0; axis < dimension; ++axis) {
        const Scalar change = limit * bar.axial * bar.line.direction[axis];
        add(row, end_unknown(bar, 0, axis), change);
        add(row, end_unknown(bar, 1, axis), -change);
      }
    }
  }

  // Residual.

  /// Puts right-hand side minus left-hand side into correction_; returns the largest part in units of
  /// force_scale_, which is at least the rounding of a plain Scalar: of the largest force so far, and of
  /// stiffness x displacement.
  Scalar residual(const Assumed& assumed, const Loads& loads) {
    for (int i = 0; i < numbering_.count(); ++i) correction_[i] = 0;
    force_scale_ = epsilon * std::fmax(peak_, stiffest_ * largest_displacement());
    for (const auto& given : scene_->forces)
      for (int axis = 0; axis < dimension; ++axis) {
        const Scalar force =
            static_cast<Scalar>(given.force[static_cast<std::size_t>(axis)]) * loads.factor[given.load];
        force_scale_ = std::fmax(force_scale_, std::fabs(force));
        push(numbering_.displacement(given.node, axis), force);
      }
    for (int i = 0; i < scene_->struts.size(); ++i) pull(elements_.struts[i], strut_force(i));
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i) bend(elements_.beams[i]);
    for (int i = 0; i < segments(); ++i) {
      pull(elements_.segments[i], tension(i, assumed, loads));
      force_scale_ = std::fmax(force_scale_, std::fabs(locked_in_force(i, loads)));
    }
    for (int i = 0; i < scene_->substructures.size(); ++i) hold(SubstructureElement<SceneType>(*scene_, i));
    Scalar gap = 0;
    for (int joint = 0; joint < joints(); ++joint) gap = std::fmax(gap, constrain(joint, assumed, loads));
    return worst(gap);
  }

  Scalar largest_displacement() const {
    Scalar most = 0;
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < per_node; ++axis)
        most = std::fmax(most, std::fabs(displacement(node, axis).hi));
    // A slack cable moves along its path, without a load that could be a measure.
    for (int joint = 0; joint < joints(); ++joint)
      for (int axis = 0; axis < dimension; ++axis)
        most = std::fmax(most, std::fabs(x_[numbering_.cable_point(joint, axis)].hi));
    return most;
  }
  void push(int unknown, Scalar force) {
    if (unknown >= 0) correction_[unknown] += force;
  }
  template <class Bar>
  void pull(const Bar& bar, Scalar force) {
    force_scale_ = std::fmax(force_scale_, std::fabs(force));
    for (int axis = 0; axis < dimension; ++axis) {
      push(end_unknown(bar, 0, axis), bar.line.direction[axis] * force);
      push(end_unknown(bar, 1, axis), -bar.line.direction[axis] * force);
    }
  }
  template <class Beam>
  void bend(const Beam& beam) {
    const auto unknowns = beam_unknowns(beam);
    const auto forces = beam.end_forces(beam_displacements(beam));
    for (std::size_t i = 0; i < forces.size(); ++i) {
      force_scale_ = std::fmax(force_scale_, std::fabs(forces[i]));
      push(unknowns[i], -forces[i]);
    }
  }
  void hold(const SubstructureElement<SceneType>& K) {
    for (int row = 0; row < K.size(); ++row) {
      Word force;
      for (int column = 0; column < K.size(); ++column)
        force += static_cast<Scalar>(K(row, column)) * displacement(K.node(column), K.axis(column));
      force_scale_ = std::fmax(force_scale_, std::fabs(force.value()));
      push(numbering_.displacement(K.node(row), K.axis(row)), -force.value());
    }
  }

  /// Internal forces on nodes 3 and 4 (paper, Eq. (4)), and the two constraints (paper, Eq. (15)); returns
  /// the violation as a force [N].
  Scalar constrain(int joint, const Assumed& assumed, const Loads& loads) {
    const auto& element = elements_.joints[joint];
    Scalar violation = 0;
    const bool open = assumed.contact[joint] == Contact::separated;
    for (int i = 0; i < dimension; ++i) {
      const Scalar sigma = internal_force(joint, i);
      force_scale_ = std::fmax(force_scale_, std::fabs(sigma));
      const int row = numbering_.internal_force(joint, i);
      if (open) {
        correction_[row] = -sigma;
        const int point = numbering_.cable_point(joint, i);
        const Scalar apart = (displacement(element.node, i) - x_[point]).value();
        correction_[point] = stiffest_ * apart;
        continue;
      }
      const Point along = element.axis(i);
      for (int axis = 0; axis < dimension; ++axis) {
        push(numbering_.cable_point(joint, axis), along[axis] * sigma);
        push(numbering_.displacement(element.node, axis), -along[axis] * sigma);
      }
      if (i == 1 && assumed.contact[joint] == Contact::sliding) {
        correction_[row] = limit_force(joint, assumed, loads) * assumed.direction[joint] - sigma;
        violation = std::fmax(violation, std::fabs(correction_[row]));
      } else {
        const Word rest{i == 1 ? assumed.v_s[joint] : Scalar(0), 0};
        correction_[row] = (rest - relative(joint, i)).value();
        violation = std::fmax(violation, std::fabs(correction_[row]) * softer_segment(joint));
      }
    }
    return violation;
  }

 public:
  /// Largest tangential force (paper, Eq. (24)) or the capstan's [N].
  Scalar limit_force(int joint, const Assumed& assumed, const Loads& loads) const {
    const auto& element = elements_.joints[joint];
    if (element.law == FrictionLaw::point) return -element.mu * internal_force(joint, 0);
    return element.limit.kappa * element.frame.sin_alpha *
           (tension(element.segments[0], assumed, loads) + tension(element.segments[1], assumed, loads));
  }

  /// EA/L of the softer neighbour [N/m]: turns a slip into a change of force.
  Scalar softer_segment(int joint) const {
    const auto& element = elements_.joints[joint];
    return std::fmin(elements_.segments[element.segments[0]].axial,
                     elements_.segments[element.segments[1]].axial);
  }

 private:
  Scalar worst(Scalar gap) {
    Scalar most = gap;
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < per_node; ++axis) {
        const int unknown = numbering_.displacement(node, axis);
        if (unknown < 0 || std::fabs(correction_[unknown]) <= most) continue;
        most = std::fabs(correction_[unknown]);
        worst_node_ = node;
      }
    for (int joint = 0; joint < joints(); ++joint)
      for (int axis = 0; axis < dimension; ++axis) {
        const Scalar imbalance = std::fabs(correction_[numbering_.cable_point(joint, axis)]);
        if (imbalance <= most) continue;
        most = imbalance;
        worst_node_ = elements_.joints[joint].node;
      }
    return most > 0 ? most / force_scale_ : Scalar(0);
  }

  Status judge(Scalar imbalance) const {
    return imbalance <= accepted ? Status::success()
                                 : Status::at(Code::ill_conditioned, Place::node, worst_node_);
  }

  /// Tells a node that nothing holds from one that this scalar type cannot resolve.
  Status singular_at(int column, const Assumed& assumed, const Loads& loads) {
    lu_.null_vector(column, correction_);
    for (int i = 0; i < numbering_.count(); ++i) x_[i] = Word{correction_[i], 0};
    int mover = 0;
    Scalar most = 0, strained = 0;
    const auto consider = [&mover, &most](int node, Scalar motion) {
      if (std::fabs(motion) <= most) return;
      most = std::fabs(motion);
      mover = node;
    };
    for (int node = 0; node < scene_->nodes.size(); ++node)
      for (int axis = 0; axis < per_node; ++axis) consider(node, displacement(node, axis).hi);
    for (int joint = 0; joint < joints(); ++joint)
      for (int axis = 0; axis < dimension; ++axis)
        consider(elements_.joints[joint].node, x_[numbering_.cable_point(joint, axis)].hi);
    for (int i = 0; i < scene_->struts.size(); ++i)
      strained = std::fmax(strained, std::fabs(elongation(elements_.struts[i]).value()));
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < scene_->beams.size(); ++i) {
        const auto& beam = elements_.beams[i];
        strained = std::fmax(strained, beam.largest_deformation(beam_displacements(beam)));
      }
    for (int i = 0; i < segments(); ++i)
      if (law_of(i, assumed, loads) == SegmentLaw::elastic)
        strained = std::fmax(strained, std::fabs(bar_elongation(i)));
    const auto moved = [this](int node, int axis) { return displacement(node, axis).hi; };
    strained = std::fmax(strained, static_cast<Scalar>(largest_strain(*scene_, moved)));
    const bool resolved = strained <= std::sqrt(epsilon) * most;
    return Status::at(resolved ? Code::mechanism : Code::ill_conditioned, Place::node, mover);
  }

  const SceneType* scene_ = nullptr;
  Elements<Scalar, SceneType> elements_;
  Numbering<SceneType> numbering_;
  BandLu<Scalar, Numbering<SceneType>::max_unknowns> lu_;
  FixedArray<Word, Numbering<SceneType>::max_unknowns> x_;
  FixedArray<Scalar, Numbering<SceneType>::max_unknowns> correction_;
  Scalar stiffest_ = 0;
  Scalar force_scale_ = 0;
  Scalar peak_ = 0;
  int worst_node_ = 0;
};

}  // namespace taut
