// Says whether a scene can be used, and if not what is wrong with which part of it.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "taut/elements/substructure.hpp"
#include "taut/numerics/constant.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/support_check.hpp"
#include "taut/status.hpp"

namespace taut {
namespace detail {

/// One check after the other; the first failure is the answer.
template <class SceneType>
class SceneCheck {
 public:
  constexpr explicit SceneCheck(const SceneType& scene) : scene_(scene) {}

  constexpr Status run() const {
    Status status = capacities();
    if (status) status = nodes();
    if (status) status = struts();
    if constexpr (has_room_for_beams)
      if (status) status = beams();
    for (int c = 0; status && c < scene_.cables.size(); ++c) status = cable(c);
    for (int i = 0; status && i < scene_.substructures.size(); ++i) status = substructure(i);
    if (status) status = loads();
    if (status) status = SupportCheck<SceneType>(scene_).run();
    return status;
  }

 private:
  using Real = typename SceneType::Scalar;
  static constexpr std::size_t dimension = SceneType::dimension;
  using Vector = std::array<Real, dimension>;
  static constexpr int jacks = max_jacks<typename SceneType::Capacity>;
  static constexpr bool has_room_for_beams = SceneType::Capacity::beams > 0;
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

  constexpr Status capacities() const {
    const struct {
      int excess, capacity;
      Place place;
    } lists[] = {
        {scene_.nodes.excess(), scene_.nodes.capacity(), Place::node},
        {scene_.struts.excess(), scene_.struts.capacity(), Place::strut},
        {scene_.cables.excess(), scene_.cables.capacity(), Place::cable},
        {scene_.prestrain.excess(), scene_.prestrain.capacity(), Place::segment},
        {scene_.mu.excess(), scene_.mu.capacity(), Place::joint},
        {scene_.path.excess(), scene_.path.capacity(), Place::path},
        {scene_.substructures.excess(), scene_.substructures.capacity(), Place::substructure},
        {scene_.substructure_nodes.excess(), scene_.substructure_nodes.capacity(), Place::substructure_node},
        {scene_.substructure_entries.excess(), scene_.substructure_entries.capacity(),
         Place::substructure_entry},
        {jacked_ends() - jacks, jacks, Place::cable_end},
        {scene_.excess_loads, SceneType::Capacity::loads, Place::load},
        {scene_.forces.excess(), scene_.forces.capacity(), Place::force},
        {scene_.temperatures.excess(), scene_.temperatures.capacity(), Place::temperature},
    };
    for (const auto& list : lists)
      if (list.excess > 0) return Status::at(Code::capacity_exceeded, list.place, list.capacity, list.excess);
    if constexpr (has_room_for_beams)
      if (scene_.beams.excess() > 0)
        return Status::at(Code::capacity_exceeded, Place::beam, scene_.beams.capacity(),
                          scene_.beams.excess());
    return Status::success();
  }

  constexpr int jacked_ends() const {
    int count = 0;
    for (int c = 0; c < scene_.cables.size(); ++c)
      for (const End end : scene_.cables[c].ends)
        count += !scene_.cables[c].closed && end == End::jacked ? 1 : 0;
    return count;
  }

  constexpr Status nodes() const {
    for (int i = 0; i < scene_.nodes.size(); ++i) {
      for (const Real x : scene_.nodes[i].at)
        if (!is_finite(x)) return Status::at(Code::not_finite, Place::node, i);
      const unsigned held = has_room_for_beams ? scene_.nodes[i].held & ~rotations : scene_.nodes[i].held;
      if (held >> dimension != 0) return Status::at(Code::out_of_range, Place::node, i);
    }
    return Status::success();
  }
  static constexpr unsigned rotations = dimension == 2 ? held_r : held_rx | held_ry | held_rz;

  /// Finite and greater than zero, or the code that says which it is not.
  static constexpr Code positive(Real x) {
    if (!is_finite(x)) return Code::not_finite;
    return x > 0 ? Code::ok : Code::not_positive;
  }
  static constexpr Code not_negative(Real x) {
    if (!is_finite(x)) return Code::not_finite;
    return x >= 0 ? Code::ok : Code::negative;
  }
  static constexpr Code first_failure(Code a, Code b) { return a != Code::ok ? a : b; }

  constexpr bool is_node(int i) const { return i >= 0 && i < scene_.nodes.size(); }

  /// Closer than the coordinates can tell apart.
  constexpr bool coincide(int a, int b) const {
    Real size = 0, distance = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const Real p = scene_.nodes[a].at[axis], q = scene_.nodes[b].at[axis];
      size = larger(size, larger(magnitude(p), magnitude(q)));
      distance = larger(distance, magnitude(p - q));
    }
    return distance <= 8 * epsilon * size;
  }

  constexpr Status struts() const {
    for (int i = 0; i < scene_.struts.size(); ++i) {
      const Strut<Real>& strut = scene_.struts[i];
      for (const int node : strut.nodes)
        if (!is_node(node)) return Status::at(Code::unknown_node, Place::strut, i, node);
      if (strut.nodes[0] == strut.nodes[1])
        return Status::at(Code::repeated_node, Place::strut, i, strut.nodes[0]);
      if (coincide(strut.nodes[0], strut.nodes[1]))
        return Status::at(Code::coincident_nodes, Place::strut, i, strut.nodes[1]);
      const Code stiff = first_failure(positive(strut.E), positive(strut.A));
      if (stiff != Code::ok) return Status::at(stiff, Place::strut, i);
    }
    return Status::success();
  }

  constexpr Status beams() const {
    for (int i = 0; i < scene_.beams.size(); ++i) {
      const auto& beam = scene_.beams[i];
      for (const int node : beam.nodes)
        if (!is_node(node)) return Status::at(Code::unknown_node, Place::beam, i, node);
      if (beam.nodes[0] == beam.nodes[1])
        return Status::at(Code::repeated_node, Place::beam, i, beam.nodes[0]);
      if (coincide(beam.nodes[0], beam.nodes[1]))
        return Status::at(Code::coincident_nodes, Place::beam, i, beam.nodes[1]);
      const Code stiff = stiffness_of(beam.section);
      if (stiff != Code::ok) return Status::at(stiff, Place::beam, i);
      if constexpr (dimension == 3)
        if (!points_aside(beam)) return Status::at(Code::out_of_range, Place::beam, i);
    }
    return Status::success();
  }
  static constexpr Code stiffness_of(const BeamSection<Real, dimension>& section) {
    Code code = first_failure(positive(section.E), positive(section.A));
    if constexpr (dimension == 2) {
      code = first_failure(code, positive(section.I));
    } else {
      for (const Real x : {section.Iy, section.Iz, section.J, section.G})
        code = first_failure(code, positive(x));
      for (const Real x : section.up)
        if (!is_finite(x)) code = first_failure(code, Code::not_finite);
    }
    return code;
  }
  /// Whether `up` is there and not along the beam.
  constexpr bool points_aside(const Beam<Real, 3>& beam) const {
    constexpr Real least = Real(1e-6);
    const Vector a = direction(beam.nodes[0], beam.nodes[1]), b = constant_unit(beam.section.up);
    const Vector across = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return constant_norm(across) > least;
  }
  constexpr Vector direction(int from, int to) const {
    Vector d{};
    for (std::size_t axis = 0; axis < dimension; ++axis)
      d[axis] = scene_.nodes[to].at[axis] - scene_.nodes[from].at[axis];
    return constant_unit(d);
  }

  constexpr Status cable(int c) const {
    const Cable<Real>& cable = scene_.cables[c];
    if (cable.nodes < (cable.closed ? 3 : 2))
      return Status::at(Code::path_too_short, Place::cable, c, cable.nodes);
    Code code = first_failure(positive(cable.E), positive(cable.A));
    for (const Real x :
         {cable.wobble, cable.mu_sd, cable.scatter, cable.seating, cable.seating_sd, cable.temperature_sd})
      code = first_failure(code, not_negative(x));
    for (const LoadCell<Real>& cell : cable.cell) {
      for (const Real x : {cell.sd, cell.gain_sd, cell.zero_sd, cell.hysteresis_sd, cell.lag})
        code = first_failure(code, not_negative(x));
      code = first_failure(code, first_failure(positive(cell.up), positive(cell.down)));
    }
    if (!is_finite(cable.alpha)) code = first_failure(code, Code::not_finite);
    if (code != Code::ok) return Status::at(code, Place::cable, c);
    Status status = path(c);
    for (int i = 0; status && i < cable.segments(); ++i) status = segment(c, i);
    for (int j = 0; status && j < cable.joints(); ++j) status = joint(c, j);
    return status;
  }

  constexpr Status path(int c) const {
    const Cable<Real>& cable = scene_.cables[c];
    for (int i = 0; i < cable.nodes; ++i) {
      const int node = scene_.path[cable.first_path + i];
      if (!is_node(node)) return Status::along(Code::unknown_node, Place::path, c, i, node);
      for (int k = 0; k < i; ++k)
        if (scene_.path[cable.first_path + k] == node)
          return Status::along(Code::repeated_node, Place::path, c, i, node);
    }
    return Status::success();
  }

  constexpr Status segment(int c, int i) const {
    const Cable<Real>& cable = scene_.cables[c];
    const auto ends = scene_.segment_nodes(cable, i);
    if (coincide(ends[0], ends[1]))
      return Status::along(Code::coincident_nodes, Place::segment, c, i, ends[1]);
    const Real prestrain = scene_.prestrain[cable.first_segment + i];
    if (!is_finite(prestrain)) return Status::along(Code::not_finite, Place::segment, c, i);
    if (!(magnitude(prestrain) < 1)) return Status::along(Code::out_of_range, Place::segment, c, i);
    return Status::success();
  }

  constexpr Status joint(int c, int j) const {
    const Cable<Real>& cable = scene_.cables[c];
    const Code code = not_negative(scene_.mu[cable.first_joint + j]);
    if (code != Code::ok) return Status::along(code, Place::joint, c, j);
    // alpha below 64 units of rounding cannot be told from zero.
    if (!(sin_alpha(scene_.joint_nodes(cable, j)) > 64 * epsilon))
      return Status::along(Code::folded_cable, Place::joint, c, j);
    return Status::success();
  }

  /// |e32 - e31| / 2, with unit vectors from the joint to its neighbours.
  constexpr Real sin_alpha(const typename SceneType::JointNodes& joint) const {
    const Vector e31 = direction(joint.at, joint.before), e32 = direction(joint.at, joint.after);
    Vector difference{};
    for (std::size_t axis = 0; axis < dimension; ++axis) difference[axis] = e32[axis] - e31[axis];
    return constant_norm(difference) / 2;
  }

  constexpr Status substructure(int index) const {
    const Substructure& given = scene_.substructures[index];
    const SubstructureElement<SceneType> K(scene_, index);
    for (int i = 0; i < given.nodes; ++i) {
      const int node = scene_.substructure_nodes[given.first_node + i];
      if (!is_node(node)) return Status::at(Code::unknown_node, Place::substructure, index, node);
      for (int k = 0; k < i; ++k)
        if (scene_.substructure_nodes[given.first_node + k] == node)
          return Status::at(Code::repeated_node, Place::substructure, index, node);
    }
    Real largest = 0;
    for (int i = 0; i < K.size(); ++i)
      for (int k = 0; k < K.size(); ++k) {
        if (!is_finite(K(i, k))) return Status::at(Code::not_finite, Place::substructure, index, i);
        largest = larger(largest, magnitude(K(i, k)));
      }
    // As printed by another program, to half the digits.
    constexpr Real half_the_digits = constant_square_root(epsilon);
    const Real tolerance = half_the_digits * largest;
    for (int i = 0; i < K.size(); ++i)
      for (int k = 0; k < i; ++k)
        if (magnitude(K(i, k) - K(k, i)) > tolerance)
          return Status::at(Code::not_symmetric, Place::substructure, index, i);
    if (!semidefinite(K, tolerance)) return Status::at(Code::not_semidefinite, Place::substructure, index);
    return Status::success();
  }

  /// Elimination with the largest diagonal entry first: a negative one, or a column left over beside zeros,
  /// is proof.
  static constexpr bool semidefinite(const SubstructureElement<SceneType>& K, Real tolerance) {
    const int n = K.size();
    FixedArray<Real, SceneType::Capacity::substructure_entries> copy;
    const auto a = [&copy, n](int i, int k) -> Real& { return copy[i * n + k]; };
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) a(i, k) = K(i, k);
    for (int step = 0; step < n; ++step) {
      int pivot = 0;
      Real least = 0;
      for (int i = 0; i < n; ++i) {
        if (a(i, i) > a(pivot, pivot)) pivot = i;
        if (a(i, i) < least) least = a(i, i);
      }
      if (least < -tolerance) return false;
      if (a(pivot, pivot) <= tolerance) {
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k)
            if (magnitude(a(i, k)) > 2 * tolerance) return false;
        return true;
      }
      for (int i = 0; i < n; ++i) {
        if (i == pivot) continue;
        const Real factor = a(i, pivot) / a(pivot, pivot);
        for (int k = 0; k < n; ++k)
          if (k != pivot) a(i, k) -= factor * a(pivot, k);
      }
      for (int i = 0; i < n; ++i) a(i, pivot) = a(pivot, i) = 0;
    }
    return true;
  }

  constexpr Status loads() const {
    const auto is_load = [this](int i) { return i >= 0 && i < scene_.loads; };
    for (int i = 0; i < scene_.forces.size(); ++i) {
      const auto& given = scene_.forces[i];
      if (!is_load(given.load)) return Status::at(Code::out_of_range, Place::force, i, given.load);
      if (!is_node(given.node)) return Status::at(Code::unknown_node, Place::force, i, given.node);
      for (const Real x : given.force)
        if (!is_finite(x)) return Status::at(Code::not_finite, Place::force, i);
    }
    for (int i = 0; i < scene_.temperatures.size(); ++i) {
      const auto& given = scene_.temperatures[i];
      if (!is_load(given.load)) return Status::at(Code::out_of_range, Place::temperature, i, given.load);
      if (given.cable < 0 || given.cable >= scene_.cables.size())
        return Status::at(Code::out_of_range, Place::temperature, i, given.cable);
      if (!is_finite(given.kelvin)) return Status::at(Code::not_finite, Place::temperature, i);
    }
    return Status::success();
  }

  const SceneType& scene_;
};

}  // namespace detail

/// Checks everything about a scene that can be checked before it is loaded. A failure names the part; Place
/// and the numbers are explained at Code. For `capacity_exceeded` the index is the capacity and the amount
/// what is missing. In a constant expression too:
/// static_assert(validate(scene)) compiles only if the scene can be used.
template <class Scalar, int Dimension, class Cap>
constexpr Status validate(const Scene<Scalar, Dimension, Cap>& scene) {
  return detail::SceneCheck<Scene<Scalar, Dimension, Cap>>(scene).run();
}

}  // namespace taut
