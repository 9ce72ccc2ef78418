// Checks of validate() for which it takes Eigen, once more for constant expressions.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "taut/elements/substructure.hpp"
#include "taut/numerics/constant.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/scene.hpp"
#include "taut/status.hpp"

namespace taut {
namespace detail {

/// The same answers as SceneCheck but for rounding.
template <class SceneType>
class ConstantCheck {
 public:
  using Real = typename SceneType::Scalar;
  static constexpr std::size_t dimension = SceneType::dimension;
  using Vector = std::array<Real, dimension>;

  constexpr explicit ConstantCheck(const SceneType& scene) : scene_(scene) {}

  /// sin(alpha) of a joint, |e32 - e31| / 2.
  constexpr Real sin_alpha(int before, int at, int after) const {
    const Vector e31 = direction(at, before), e32 = direction(at, after);
    Vector difference{};
    for (std::size_t axis = 0; axis < dimension; ++axis) difference[axis] = e32[axis] - e31[axis];
    return constant_norm(difference) / 2;
  }

  /// The sine of the angle between `up` and the line from one node to another.
  constexpr Real sin_to(const Vector& up, int from, int to) const {
    const Vector a = direction(from, to), b = constant_unit(up);
    return constant_norm(
        Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
  }

  /// Supports and substructures against the rigid motions of the whole.
  constexpr Status supports() const {
    if (scene_.nodes.empty()) return Status::at(Code::unsupported, Place::node, -1);
    Vector middle{};
    for (int i = 0; i < scene_.nodes.size(); ++i)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        middle[axis] += scene_.nodes[i].at[axis] / static_cast<Real>(scene_.nodes.size());
    Real size = epsilon;
    for (int i = 0; i < scene_.nodes.size(); ++i)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        size = larger(size, magnitude(scene_.nodes[i].at[axis] - middle[axis]));

    const auto found = Eigen::of(resistance(middle, size));
    Real largest = 1;
    for (const Real value : found.values) largest = larger(largest, value);
    for (std::size_t mode = 0; mode < motions; ++mode) {
      if (found.values[mode] > 64 * epsilon * largest) continue;
      int node = 0;
      Real most = 0;
      for (int i = 0; i < scene_.nodes.size(); ++i) {
        Vector motion{};
        for (std::size_t axis = 0; axis < dimension; ++axis) {
          const Row row = rigid_motion(i, axis, middle, size);
          for (std::size_t k = 0; k < motions; ++k) motion[axis] += row[k] * found.vectors[k][mode];
        }
        if (constant_norm(motion) > most) {
          most = constant_norm(motion);
          node = i;
        }
      }
      if (most > Real(1e-4)) return Status::at(Code::unsupported, Place::node, node);
    }
    return Status::success();
  }

 private:
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  /// Translations, and rotations about the middle scaled to displacements of order one.
  static constexpr std::size_t motions = dimension == 2 ? 3 : 6;
  using Row = std::array<Real, motions>;
  using Eigen = ConstantEigen<Real, motions>;

  constexpr Vector direction(int from, int to) const {
    Vector d{};
    for (std::size_t axis = 0; axis < dimension; ++axis)
      d[axis] = scene_.nodes[to].at[axis] - scene_.nodes[from].at[axis];
    return constant_unit(d);
  }

  /// What the rigid motions move a node along an axis.
  constexpr Row rigid_motion(int node, std::size_t axis, const Vector& middle, Real size) const {
    Vector x{};
    for (std::size_t i = 0; i < dimension; ++i) x[i] = (scene_.nodes[node].at[i] - middle[i]) / size;
    Row row{};
    row[axis] = 1;
    if constexpr (dimension == 2) {
      row[2] = axis == 0 ? -x[1] : x[0];
    } else {
      const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
      row[3 + next] = x[last];
      row[3 + last] = -x[next];
    }
    return row;
  }

  static constexpr void add(typename Eigen::Matrix& to, Real factor, const Row& a, const Row& b) {
    for (std::size_t i = 0; i < motions; ++i)
      for (std::size_t k = 0; k < motions; ++k) to[i][k] += factor * a[i] * b[k];
  }

  constexpr typename Eigen::Matrix resistance(const Vector& middle, Real size) const {
    typename Eigen::Matrix sum{};
    for (int i = 0; i < scene_.nodes.size(); ++i) {
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        if (!scene_.nodes[i].is_held(static_cast<int>(axis))) continue;
        const Row row = rigid_motion(i, axis, middle, size);
        add(sum, 1, row, row);
      }
      for (int k = 0; k < SceneType::motions_of_node - SceneType::dimension; ++k) {
        const std::size_t rotation = dimension + static_cast<std::size_t>(k);
        if (scene_.nodes[i].is_rotation_held(k) && scene_.can_turn(i)) sum[rotation][rotation] += 1;
      }
    }
    for (int index = 0; index < scene_.substructures.size(); ++index) {
      const SubstructureElement<SceneType> K(scene_, index);
      Real trace = 0;
      for (int i = 0; i < K.size(); ++i) trace += K(i, i);
      if (!(trace > 0)) continue;
      for (int i = 0; i < K.size(); ++i)
        for (int k = 0; k < K.size(); ++k)
          add(sum, K(i, k) / trace,
              rigid_motion(K.node(i), static_cast<std::size_t>(K.axis(i)), middle, size),
              rigid_motion(K.node(k), static_cast<std::size_t>(K.axis(k)), middle, size));
    }
    // Of a matrix that is symmetric to half the digits only, what is.
    for (std::size_t i = 0; i < motions; ++i)
      for (std::size_t k = 0; k < i; ++k) sum[k][i] = sum[i][k];
    return sum;
  }

  const SceneType& scene_;
};

}  // namespace detail
}  // namespace taut
